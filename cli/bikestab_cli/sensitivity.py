"""bikestab sensitivity: which parameter moves the stable speeds, and by how much."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click
from bikestab_cli.chosen import Given, design_options
from bikestab_cli.designless import end_of_all, lacking, results_of_all, told_without, with_design
from bikestab_cli.options import FILE, PICTURE, check_curves, check_files, json_option, sd_option
from bikestab_cli.output import print_json, prose, tell, tell_file
from bikestab_cli.sensitivity_found import Found, found_of
from bikestab_cli.several import Values, machines_chosen, record_of, several_machines

if TYPE_CHECKING:
    from bikestab.design.sensitivity import Hold
    from bikestab.model import Model


@click.command("sensitivity")
@design_options()
@click.option(
    "--hold", type=click.Choice(["trail", "offset", "sigma"]),
    help="What stays where tilt, wheelbase or front radius vary.  [default: the trail of the 25 parameters, "
    "σ in the paper's notation]",
)  # fmt: skip
@click.option(
    "--of", "what", type=click.Choice(["speeds", "growth", "sigma_min"]), default="speeds", show_default=True,
    help="What the table shows: V1 and V2, the lowest growth rate, or the smallest stable σ at this tilt.",
)  # fmt: skip
@several_machines
@sd_option
@click.option(
    "-o", "--output", type=PICTURE, metavar="FILE", help="Draw the effects as bars: PNG, PDF or SVG."
)
@click.option("--csv", "csv_file", type=FILE, metavar="FILE", help="Write all rows at full precision.")
@json_option
def command(
    given: Given,
    hold: Hold | None,
    what: str,
    bicycle_name: tuple[str, ...],
    changes: Values,
    model: Model,
    delta: float | None,
    deviations: tuple[bool, dict[str, float]],
    output: str | None,
    csv_file: str | None,
    as_json: bool,
) -> None:
    """Print which parameter moves V1 and V2, and by how much.

    The derivatives are exact: of the condition that is zero at the end of the stable interval, by forward
    propagation through the equations. Rows are sorted by the larger elasticity, per cent of a speed for one
    per cent of the parameter. Several --bicycle, and several values of --set, are put side by side by these,
    in the paper's notation where theirs differ.

    --hold says which frame is meant: with the trail held a steeper head angle needs another fork; with the
    offset held the fork stays, and the trail follows tilt and front wheel; σ held is a trail that
    grows with the wheelbase.

    --of growth and --of sigma_min give the derivatives of the lowest growth rate up to 30 m/s, and of the
    smallest σ that has a stable speed at this tilt: in the range of these around the design, or in the next
    range above it. JSON and CSV always have both.

    Standard deviations, those in the bicycle's file and --sd, give V1 and V2 their own: by the linear rule
    from the derivatives, and by 20 000 machines drawn at random, which tell how many of them are stable at
    all. Where the two disagree the reason is told, and the drawn machines are right. They do not depend on
    --hold: what was measured is the trail, or σ in the paper's notation, or an offset that is uncertain.

    \b
    Examples:
      bikestab sensitivity --bicycle meijaard2007
      bikestab sensitivity --bicycle meijaard2007 --hold offset --csv all.csv
      bikestab sensitivity --lam 0.2 --sigma 0.08 --json
      bikestab sensitivity --bicycle meijaard2007 --head-angle 71deg --trail 55mm
      bikestab sensitivity --lam 0.1 --sigma 0.08 --of sigma_min
      bikestab sensitivity --bicycle meijaard2007 -o tornado.png
      bikestab sensitivity --bicycle meijaard2007 --of growth -o growth.png
      bikestab sensitivity --bicycle meijaard2007 --bicycle sharp1971
      bikestab sensitivity --bicycle meijaard2007 --set mB=60,85,110
      bikestab sensitivity --bicycle meijaard2007 --sd c=10mm --sd lam=1.5deg
    """
    machines = machines_chosen(bicycle_name, delta, changes, given)
    check_files(csv_file, output)
    lacks = lacking(machines, given)
    check_curves(output, lacks.count(""))
    found = found_of(with_design(machines, lacks), given, hold, model, deviations[1])
    if csv_file:
        _save(found, csv_file)
    if output:
        from bikestab_cli.sensitivity_picture import draw

        draw(found, what, output)
    files = {kind: name for kind, name in (("csv", csv_file), ("picture", output)) if name}
    if as_json:
        results = results_of_all(machines, lacks, [[each.result()] for each in found])
        print_json(record_of(machines, model, results, files))
    else:
        tell(_told(found, what, told_without(machines, lacks)), csv_file, output)
        for name in files.values():
            tell_file(name)
    end_of_all(machines, lacks)


def _told(found: Sequence[Found], what: str, left_out: Sequence[str]) -> str:
    from bikestab_cli.sensitivity_compared import side_by_side
    from bikestab_cli.sensitivity_more import MOVED, told_of
    from bikestab_cli.sensitivity_words import opening, told
    from bikestab_cli.spread_words import told_spread

    (one, *others) = found
    if others or left_out:
        first = side_by_side(found, what)
    elif what == "speeds":
        first = told(one.of, one.first, one.record, one.machine.changes)
    else:
        first = told_of(opening(one.of, one.machine.changes), one.of, MOVED[what](one.of, one.first))
    spreads = [f"{each.machine.words}, {told_spread(each.spread)}" for each in found if each.spread]
    return "\n\n".join([first, *map(prose, [*spreads, *left_out])])


def _save(found: Sequence[Found], name: str) -> None:
    from bikestab.design.effects import without_interval
    from bikestab.export.effects import SENSITIVITY, sensitivity_blocks
    from bikestab.export.tables import of_machines, save_csv

    blocks = [
        (
            each.of.bicycle.name,
            each.machine.changes,
            sensitivity_blocks(each.record, without_interval(each.of)),
        )
        for each in found
    ]
    save_csv(*of_machines(SENSITIVITY, blocks), name)
