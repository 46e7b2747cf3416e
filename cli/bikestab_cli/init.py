"""bikestab init: a commented config to start from."""

from __future__ import annotations

from pathlib import Path

import click
from bikestab_cli.options import BICYCLE, DEFAULT_BICYCLE, FILE


@click.command("init")
@click.argument("path", type=FILE, default="bikestab.yaml")
@click.option(
    "--bicycle",
    "name",
    type=BICYCLE,
    metavar="NAME|FILE",
    default=DEFAULT_BICYCLE,
    show_default=True,
    help="A bicycle that comes with bikestab, or a file of one.",
)
@click.option(
    "--uncertain",
    is_flag=True,
    help="Draw machines at random, by the standard deviations that the bicycle's file gives.",
)
@click.option("--force", is_flag=True, help="Replace an existing file.")
def command(path: str, name: str, uncertain: bool, force: bool) -> None:
    """Write a commented scan config to PATH (bikestab.yaml).

    \b
    Examples:
      bikestab init
      bikestab init mine.yaml --bicycle meijaard2007
      bikestab init study.yaml --bicycle examples/measured.txt --uncertain
    """
    from bikestab.config.template import starting_config
    from bikestab.errors import InputError
    from bikestab.files import check_writable, to_stdout, unwritable, written

    text = starting_config(name, path, uncertain=uncertain)
    try:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise unwritable(path, error) from None
    check_writable(path)
    if Path(path).is_file() and not force:
        raise InputError("exists already", place=path, hint="--force replaces it")
    with written(path) as part:
        part.write_text(text, "utf-8")
    click.echo(f"{path}; now 'bikestab scan {path}'", err=to_stdout(path))
