"""bikestab eigen: eigenvalues against speed, with the names of their modes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from bikestab_cli.chosen import Given, design_chosen, design_options
from bikestab_cli.options import (
    FILE,
    SPEEDS,
    check_files,
    json_option,
    load_bicycle,
    machine_options,
    told_as_options,
)
from bikestab_cli.output import print_json, tell_file

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
@machine_options
@click.option(
    "-o",
    "--output",
    type=FILE,
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
    bicycle_name: str,
    model: Model,
    delta: float | None,
    output: str | None,
    csv_file: str | None,
    as_json: bool,
) -> None:
    """Print or draw the eigenvalues against speed.

    At one tilt and trail, the bicycle's own where none is given. Each mode is followed continuously.
    Files are written in place of the table, and named on stdout. JSON is an object with what vrange says of
    one design and, at the speeds V, four branches with name, re and im at each.

    The pair that crosses the imaginary axis at an end of the stable speeds is weave, the real eigenvalue that
    crosses zero at one is capsize, and each keeps its name to where it meets another. What makes no end is
    named after the highest speeds that have exactly one pair: the pair is weave, and of the two real
    eigenvalues beside it castering is the faster and capsize the slower. What is neither is called real pair
    where the two of weave are real (real if only one is), pair 2 if it oscillates, and weave 2 or capsize 2
    beside another of that name.

    \b
    Examples:
      bikestab eigen --bicycle meijaard2007
      bikestab eigen --lam 0.2 --sigma 0.08 --V 0:10:11
      bikestab eigen --head-angle 71deg --offset 45mm --V 0:20mph:5
      bikestab eigen --bicycle meijaard2007 --V 0:36km/h:361 -o modes.png --csv modes.csv
      bikestab eigen --lam 11deg --sigma 0.08 --delta 1 --V 5 --json
    """
    from bikestab_cli.eigen_words import told

    from bikestab.export.tables import MODES, modes_blocks, save_csv
    from bikestab.records import design_record, interval_records, modes_record, verdict_record
    from bikestab.stability import modes, stable_intervals

    if output and min(speeds) == max(speeds):
        raise click.BadParameter("a picture needs a range, for example 0:10:21", param_hint="--V")
    if output and not Path(output).suffix:
        raise click.BadParameter(
            f"{output!r} has no ending, such as .png, .pdf or .svg", param_hint="--output"
        )
    check_files(csv_file, output)
    bicycle = load_bicycle(bicycle_name, delta)
    tilt, trail = design_chosen(bicycle, given)
    with told_as_options():
        found = modes(bicycle, speeds, tilt, trail, model=model)
    design = design_record(tilt, trail, bicycle)
    stable = stable_intervals(bicycle, tilt, trail, model=model)
    intervals, verdict = interval_records(stable), verdict_record(stable)
    files = {}
    if csv_file:
        save_csv(MODES, modes_blocks(found), csv_file)
        files["csv"] = csv_file
    if output:
        from bikestab.plot.files import save
        from bikestab.plot.modes import draw_modes

        save(draw_modes(bicycle, tilt, trail, min(speeds), max(speeds), model=model), Path(output))
        files["picture"] = output
    if as_json:
        head = {"bicycle": bicycle.name, "model": model, "delta": bicycle.delta}
        print_json({**head, **design, "intervals": intervals, **verdict, **modes_record(found), **files})
        return
    for name in files.values():
        tell_file(name)
    if not files:
        click.echo(told(bicycle, model, design, intervals, verdict, found))
