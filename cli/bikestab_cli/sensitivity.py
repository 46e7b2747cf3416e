"""bikestab sensitivity: which parameter moves the stable speeds, and by how much."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.chosen import Given, design_chosen, design_options
from bikestab_cli.options import (
    FILE,
    PICTURE,
    check_files,
    json_option,
    sd_option,
    tell_once,
    tell_which,
    told_as_options,
)
from bikestab_cli.output import print_json, prose, tell_file
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
      bikestab sensitivity --bicycle meijaard2007 --hold offset --csv benchmark.csv
      bikestab sensitivity --lam 0.2 --sigma 0.08 --json
      bikestab sensitivity --bicycle meijaard2007 --head-angle 71deg --trail 55mm
      bikestab sensitivity --lam 0.1 --sigma 0.08 --of sigma_min
      bikestab sensitivity --bicycle meijaard2007 -o tornado.png
      bikestab sensitivity --bicycle meijaard2007 --of growth -o growth.png
      bikestab sensitivity --bicycle meijaard2007 --bicycle sharp1971
      bikestab sensitivity --bicycle meijaard2007 --set mB=60,85,110
      bikestab sensitivity --bicycle meijaard2007 --sd c=10mm --sd lam=1.5deg
    """
    from bikestab_cli.sensitivity_more import MOVED, told_of
    from bikestab_cli.sensitivity_picture import draw_moved, draw_speeds
    from bikestab_cli.sensitivity_words import opening, side_by_side, told
    from bikestab_cli.spread_words import tell_rider, told_spread

    from bikestab.design.effects import sensitivity_record, without_interval
    from bikestab.design.sensitivity import sensitivity, two_parts
    from bikestab.design.spread import own_spread, plain
    from bikestab.export.effects import SENSITIVITY, sensitivity_blocks
    from bikestab.export.tables import of_machines, save_csv
    from bikestab.plausible import deviation_doubts
    from bikestab.region.first_sigma import first_sigma, first_sigma_record

    machines = machines_chosen(bicycle_name, delta, changes, given)
    bicycles = [each.bicycle for each in machines]
    check_files(csv_file, output)
    if len({bicycle.bodies is None for bicycle in bicycles}) > 1:
        # c is the trail in one notation, and the wheelbase in the other
        bicycles = [two_parts(bicycle) for bicycle in bicycles]
    with told_as_options():
        found = [
            sensitivity(bicycle, *design_chosen(bicycle, given), hold=hold, model=model)
            for bicycle in bicycles
        ]
        firsts = [first_sigma(each.bicycle, each.lam, each.sigma, model=model) for each in found]
    for bicycle in bicycles:
        tell_which(bicycle, deviations[1])
        tell_rider(bicycle, {**bicycle.deviations, **deviations[1]})
        for text in deviation_doubts(bicycle, deviations[1]):
            tell_once(f"warning: {bicycle.name}: {text}")
    with told_as_options():
        spreads = [own_spread(each, of_file=True, given=deviations[1]) for each in found]
    records = [
        {**sensitivity_record(each), "sigma_min": first_sigma_record(first), "spread": known and plain(known)}
        for each, first, known in zip(found, firsts, spreads, strict=True)
    ]
    if csv_file:
        blocks = [
            (each.bicycle.name, each.changes, sensitivity_blocks(r, without_interval(own)))
            for each, own, r in zip(machines, found, records, strict=True)
        ]
        save_csv(*of_machines(SENSITIVITY, blocks), csv_file)
    if output:
        if what == "speeds":
            draw_speeds(machines, records, output)
        else:
            draw_moved(machines, found, list(map(MOVED[what], found, firsts)), output)
    files = {kind: name for kind, name in (("csv", csv_file), ("picture", output)) if name}
    if as_json:
        print_json(record_of(machines, model, [[_result(record)] for record in records], files))
        return
    if what != "speeds":
        shown = zip(machines, found, firsts, strict=True)
        texts = [told_of(opening(of, each.changes), of, MOVED[what](of, first)) for each, of, first in shown]
        click.echo("\n\n".join(texts))
    elif len(found) == 1:
        click.echo(told(found[0], firsts[0], records[0], machines[0].changes))
    else:
        click.echo(side_by_side(found, records, machines))
    for each, known in zip(found, spreads, strict=True):
        if known:
            click.echo(prose(f"\n{each.bicycle.name}, {told_spread(known)}"))
    for name in files.values():
        tell_file(name)


def _result(record: Mapping[str, Any]) -> dict[str, Any]:
    """What is of one result; the rest is said of all."""
    return {key: value for key, value in record.items() if key not in ("bicycle", "model", "delta")}
