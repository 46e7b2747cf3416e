"""bikestab eigen: eigenvalues against speed, with the names of their modes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from bikestab_cli.chosen import Given, design_options
from bikestab_cli.designless import end_of_all, lacking, results_of_all
from bikestab_cli.eigen_along import along
from bikestab_cli.eigen_view_options import View, view_options
from bikestab_cli.eigen_views import viewed
from bikestab_cli.options import FILE, PICTURE, check_curves, check_files, json_option
from bikestab_cli.output import print_json, tell_file
from bikestab_cli.over import check_meanings, curves_of
from bikestab_cli.quantities import SPEEDS
from bikestab_cli.several import Values, check_varied, machines_chosen, record_of, several_machines

if TYPE_CHECKING:
    from bikestab.model import Model


@click.command("eigen")
@design_options()
@click.option(
    "--V",
    "speeds",
    type=SPEEDS,
    metavar="SPEED|RANGE",
    default="0:10:21",
    show_default=True,
    help="Speeds [m/s] of the table: START:STOP:NUM, such as 0:36km/h:11, or one.",
)
@several_machines
@view_options
@click.option("--locus", is_flag=True, help="Let -o draw the eigenvalues in the complex plane.")
@click.option(
    "-o",
    "--output",
    type=PICTURE,
    metavar="FILE",
    help="Draw a PNG, PDF or SVG from START to STOP, however coarse NUM.",
)
@click.option(
    "--csv", "csv_file", type=FILE, metavar="FILE", help="Write V, branch, name, re, im at full precision."
)
@json_option
def command(
    given: Given,
    speeds: list[float],
    bicycle_name: tuple[str, ...],
    changes: Values,
    model: Model,
    delta: float | None,
    view: View,
    locus: bool,
    output: str | None,
    csv_file: str | None,
    as_json: bool,
) -> None:
    """Print or draw the eigenvalues against speed.

    At one tilt and trail, the bicycle's own where none is given. Each mode is followed continuously.
    Files are written in place of the table, and named on stdout. Several --bicycle and several values of
    --set are one table, and one picture, a curve each: of their growth rates, or with --locus or --push.
    JSON has for each what vrange says of a design and, at the speeds V, four branches with name, re and im
    at each.

    The pair that crosses the imaginary axis at an end of the stable speeds is weave, the real eigenvalue that
    crosses zero at one is capsize, and each keeps its name to where it meets another. What makes no end is
    named after the highest speeds that have exactly one pair: the pair is weave, and of the two real
    eigenvalues beside it castering is the faster and capsize the slower. What is neither is called real pair
    where the two of weave are real (real if only one is), pair 2 if it oscillates, and weave 2 or capsize 2
    beside another of that name.

    --shapes tells roll and steer in each mode, as phasors; --push the exact motion after a push, the sum of
    the modes, with the path of the wheels on the road; --over the eigenvalues at one speed against any one
    or two parameters of the bicycle, or lam, head_angle, sigma, trail, offset: against the one with more
    values, for each of the other's. Signs are those of Meijaard et al.
    (2007): positive to the right.

    \b
    Examples:
      bikestab eigen --bicycle meijaard2007
      bikestab eigen --lam 0.2 --sigma 0.08 --V 0:10:11
      bikestab eigen --head-angle 71deg --offset 45mm --V 0:20mph:5
      bikestab eigen --bicycle meijaard2007 --V 0:36km/h:361 --csv modes.csv
      bikestab eigen --bicycle meijaard2007 --set mB=60,85,110 -o growth.png
      bikestab eigen --bicycle meijaard2007 --locus -o locus.png
      bikestab eigen --bicycle meijaard2007 --shapes --at 5
      bikestab eigen --bicycle meijaard2007 --push roll_rate=0.5 -o push.png
      bikestab eigen --bicycle meijaard2007 --over delta=0:8:9 --at 5
      bikestab eigen --bicycle meijaard2007 --over mB=60:110:11 --over delta=0:5:3
      bikestab eigen --lam 11deg --sigma 0.08 --delta 1 --V 5 --json
    """
    _check_picture(view, speeds, locus, output)
    check_files(csv_file, output)
    machines = machines_chosen(bicycle_name, delta, changes, given)
    for machine in machines:
        check_varied(machine.bicycle, view.over, changes, delta)
    check_meanings(machines, view.over)
    lacks = lacking(machines, [*given, *view.over])
    check_curves(output, lacks.count("") * curves_of(view.over))
    if view.kind:
        answer = viewed(machines, lacks, given, view, model)
    else:
        answer = along(machines, lacks, given, speeds, model, locus=locus)
    if csv_file:
        from bikestab.export.tables import save_csv

        save_csv(*answer.rows(), csv_file)
    if output:
        from bikestab.plot.files import save

        save(answer.draw(), Path(output))
    files = {kind: name for kind, name in (("csv", csv_file), ("picture", output)) if name}
    if as_json:
        results = results_of_all(machines, lacks, answer.results)
        print_json(record_of(machines, model, results, files, answer.ranges))
    else:
        for name in files.values():
            tell_file(name)
        if not files:
            click.echo(answer.text)
    end_of_all(machines, lacks)


def _check_picture(view: View, speeds: list[float], locus: bool, output: str | None) -> None:
    """Refuse pictures that cannot be drawn."""
    if output and min(speeds) == max(speeds) and not view.kind:
        raise click.BadParameter("a picture needs a range, for example 0:10:21", param_hint="--V")
    if locus and view.kind:
        problem = f"it is a picture of its own, and so is that of --{view.kind}: give one of them"
        raise click.BadParameter(problem, param_hint="--locus")
    if locus and not output:
        raise click.BadParameter("it is a picture: give -o FILE", param_hint="--locus")
