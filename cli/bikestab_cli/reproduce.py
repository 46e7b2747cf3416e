"""bikestab reproduce: the 1981 paper, computed again and judged."""

from __future__ import annotations

import sys
from pathlib import Path

import click
from bikestab_cli.options import NAME


@click.command("reproduce")
@click.option(
    "-o",
    "--output",
    type=NAME,
    metavar="FOLDER",
    default="out/reproduce",
    show_default=True,
    help="Where the report goes.",
)
@click.option(
    "--quick",
    is_flag=True,
    help="Coarser grids: the same questions, asked of fewer designs and random machines.",
)
def command(output: str, quick: bool) -> None:
    """Compute the 1981 paper again and judge it.

    Draws its figure 3, compares its refined equations with the unrefined ones, judges each of its four
    conclusions by numbers, for all designs and for forks bent forwards, tries other readings of its doubtful
    values, and a motorcycle.

    Writes figures, report.md for readers and report.json for programs. The exit code is 0 whatever the
    verdicts are.

    \b
    Example:
      bikestab reproduce --quick -o out/quick-report
    """
    from bikestab.paper1981.box import FULL, QUICK
    from bikestab.paper1981.report import decisive_numbers
    from bikestab.paper1981.reproduce import reproduce

    def progress(words: str) -> None:
        if sys.stderr.isatty():
            click.echo(f"{words} ...", err=True)

    study = reproduce(output, sampling=QUICK if quick else FULL, progress=progress)
    for number, judged in study.conclusions.by_number().items():
        verdicts = f"{judged.verdict} (forks bent forwards: {judged.verdict_forwards})"
        click.echo(f"conclusion {number}: {verdicts}: {decisive_numbers(study, number)}")
    click.echo(f"report: {Path(output) / 'report.md'}")
