"""bikestab sensitivity: which parameter moves the stable speeds, and by how much."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.chosen import Given, design_chosen, design_options
from bikestab_cli.options import (
    DEFAULT_BICYCLE,
    FILE,
    NAME,
    check_files,
    equation_options,
    json_option,
    load_bicycle,
    sd_option,
    told_as_options,
)
from bikestab_cli.output import print_json

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
    "--bicycle", "bicycle_names", type=NAME, metavar="NAME|FILE", multiple=True,
    help="A bicycle that comes with bikestab, or a file of one; several side by side."
    f"  [default: {DEFAULT_BICYCLE}]",
)  # fmt: skip
@equation_options
@sd_option
@click.option("-o", "--output", type=FILE, metavar="FILE", help="Draw the effects as bars: PNG, PDF or SVG.")
@click.option("--csv", "csv_file", type=FILE, metavar="FILE", help="Write all rows at full precision.")
@json_option
def command(
    given: Given,
    hold: Hold | None,
    bicycle_names: tuple[str, ...],
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
    per cent of the parameter. Several --bicycle are put side by side by these, in the paper's notation where
    theirs differ.

    --hold says which frame is meant: with the trail held a steeper head angle needs another fork; with the
    offset held the fork stays, and the trail follows tilt and front wheel; σ held is a trail that
    grows with the wheelbase.

    Standard deviations, those in the bicycle's file and --sd, give V1 and V2 their own: by the linear rule
    from the derivatives, and by 20 000 machines drawn at random, which tell how many of them are stable at
    all. Where the two disagree the reason is told, and the drawn machines are right.

    \b
    Examples:
      bikestab sensitivity --bicycle meijaard2007
      bikestab sensitivity --bicycle meijaard2007 --hold offset --csv benchmark.csv
      bikestab sensitivity --lam 0.2 --sigma 0.08 --json
      bikestab sensitivity --bicycle meijaard2007 --head-angle 71deg --trail 55mm
      bikestab sensitivity --bicycle meijaard2007 -o tornado.png
      bikestab sensitivity --bicycle meijaard2007 --bicycle sharp1971
      bikestab sensitivity --bicycle meijaard2007 --sd c=10mm --sd lam=1.5deg
    """
    from bikestab_cli.sensitivity_words import side_by_side, told
    from bikestab_cli.spread_words import told_spread

    from bikestab.design.effects import sensitivity_record
    from bikestab.design.sensitivity import sensitivity, two_parts
    from bikestab.design.spread import own_spread, plain
    from bikestab.export.tables import SENSITIVITY, save_csv, sensitivity_blocks

    bicycles = [load_bicycle(name, delta) for name in bicycle_names or (DEFAULT_BICYCLE,)]
    check_files(csv_file, output)
    if (
        len({bicycle.bodies is None for bicycle in bicycles}) > 1
    ):  # c is the trail in one, the wheelbase in the other
        bicycles = [two_parts(bicycle) for bicycle in bicycles]
    with told_as_options():
        found = [
            sensitivity(bicycle, *design_chosen(bicycle, given), hold=hold, model=model)
            for bicycle in bicycles
        ]
    with told_as_options():
        spreads = [own_spread(each, of_file=True, given=deviations[1]) for each in found]
    records = [
        {**sensitivity_record(each), "spread": known and plain(known)}
        for each, known in zip(found, spreads, strict=True)
    ]
    if csv_file:
        save_csv(SENSITIVITY, sensitivity_blocks(records), csv_file)
    if output:
        _draw(records, output)
    files = {kind: name for kind, name in (("table", csv_file), ("picture", output)) if name}
    if as_json:
        print_json({"results": records, **files})
        return
    click.echo(told(found[0], records[0]) if len(found) == 1 else side_by_side(found, records))
    for each, known in zip(found, spreads, strict=True):
        if known:
            click.echo(f"\n{each.bicycle.name}, {told_spread(known)}")
    for kind, name in files.items():
        click.echo(f"{kind}: {name}")


def _draw(records: Sequence[Mapping[str, Any]], output: str) -> None:
    """The effects on each machine's widest stable interval."""
    from bikestab.design.effects import width
    from bikestab.plot.files import save
    from bikestab.plot.tornado import draw_tornado

    machines = []
    for record in records:
        widest: Any = max(record["intervals"], key=width, default={"parameters": []})
        machines.append((record["bicycle"], widest["parameters"]))
    save(draw_tornado(machines), Path(output))
