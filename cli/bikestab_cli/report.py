"""bikestab report: volumes → one interactive page."""

from __future__ import annotations

from contextlib import ExitStack

import click
from bikestab_cli.options import FILE, NAME, check_files
from bikestab_cli.output import tell_file
from bikestab_cli.progress import progress


@click.command("report")
@click.argument("volumes", type=NAME, nargs=-1, required=True, metavar="VOLUME...")
@click.option(
    "-o", "--output", type=FILE, metavar="FILE", default="report.html", show_default=True, help="The page."
)
@click.option("--quiet", is_flag=True, help="Tell nothing of the progress.")
def command(volumes: tuple[str, ...], output: str, quiet: bool) -> None:
    """Write one interactive page that needs no network.

    The page is one HTML file to be mailed, opened in class or put beside a paper. It shows the stable
    region to be turned, and for any tilt, trail and speed that are chosen the stable speeds, the
    eigenvalues, the machine to scale and its motion after a push, all computed in the page from
    the machine's equations. Several volumes are tabs of one page, and its table compares them; the axes of a
    sweep are sliders.

    Each VOLUME is a volume.h5 or its folder, over tilt and trail; of other parameters sweep a few values.
    Needs the extra: pip install "bikestab[report]".

    \b
    Examples:
      bikestab report out/quick -o report.html
      bikestab report out/quick out/quick/volume.h5 -o twice.html
    """
    from bikestab.report.page import save_page
    from bikestab.volume import Volume

    check_files(output)
    with ExitStack() as opened:
        show = opened.enter_context(progress(output, quiet, "machines", at_once=True))
        size = save_page([opened.enter_context(Volume(volume)) for volume in volumes], output, show)
    tell_file(output, f"{size / 1e6:.1f} MB, opens in any browser")
