"""bikestab compare: what moved from one bicycle, config or volume to another."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.chosen import Given, design_options
from bikestab_cli.compare_sides import Asked, check_used, opened, paired
from bikestab_cli.options import (
    BICYCLE,
    PICTURE,
    at_option,
    check_files,
    equation_options,
    json_option,
)
from bikestab_cli.output import print_json, tell_file

if TYPE_CHECKING:
    from bikestab.model import Model


class _Tolerance(click.ParamType):
    """A speed, or per cent."""

    name = "tolerance"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        from pydantic_core import PydanticCustomError

        from bikestab.config.tolerance import tolerance

        try:
            return tolerance(value)
        except PydanticCustomError as error:
            known = error.context or {}
            self.fail(f"{known['problem']}; {known['hint']}, or 1%", param, ctx)


@click.command("compare")
@click.argument("one", type=BICYCLE, metavar="A")
@click.argument("others", type=BICYCLE, metavar="B...", nargs=-1, required=True)
@click.option(
    "--within", type=_Tolerance(), metavar="PERCENT|SPEED",
    help="Exit with 1 if an end, the growth rate or the stable region moved by more: 1%, or 0.05 (m/s).",
)  # fmt: skip
@design_options()
@equation_options
@at_option
@click.option("-o", "--output", type=PICTURE, metavar="FILE", help="Draw them as PNG, PDF or SVG.")
@json_option
def command(
    one: str,
    others: tuple[str, ...],
    within: float | str | None,
    given: Given,
    model: Model,
    delta: float | None,
    machine: dict[str, float],
    output: str | None,
    as_json: bool,
) -> None:
    """Compare bicycles, configs or volumes: the first with each of the others.

    Each of them is a bicycle, or a file of one, a scan's config, or a volume or its folder. Compared are
    their parameters, the stable speeds of their designs, or of the one given, what happens at their ends, and
    the growth rate in the middle; and over the grid's two parameters, or else tilt and trail, and speeds the
    volume of the symmetric difference of their stable regions, as a share of their union. It is exact along
    the speed and a sum over designs: those of the grids if they are the same, else 81 × 81 in what both have
    of a box, for bicycles λ to 0.6, σ to 0.3, 30 m/s. Of several each is compared as it would be alone.

    --at chooses of a sweep, in each of them that has its axis. --model, --delta and --rider are for
    bicycles: configs and volumes say these themselves.

    --within is per cent of each end and growth rate of the first, and of the union; as a speed it is the
    distance of each end, and the mean distance of the regions' speeds, and growth rates are not judged. Other
    ends, or another number of intervals, are always beyond it. Exit code 1 if something is.

    \b
    Examples:
      bikestab compare meijaard2007 sharp1971
      bikestab compare configs/quick.yaml configs/dikarev1981.yaml --within 1%
      bikestab compare meijaard2007 meijaard2007 --trail 55mm --within 0.01
      bikestab compare meijaard2007 kooijman2011 -o both.png
      bikestab compare meijaard2007 sharp1971 kooijman2011 -o three.png
    """
    from bikestab_cli.compare_words import told, told_all

    from bikestab.changes import compare, parameters

    check_files(output)
    asked = Asked(given, model, delta, machine)
    found = [opened(name, asked) for name in (one, *others)]
    check_used(asked, found)
    pairs = [compare(*paired(found[0], other), within) for other in found[1:]]
    records = [record for record, _ in pairs]
    sides = [each.side for each in found]
    files = {}
    if output:
        from bikestab.plot.compared import draw_compared
        from bikestab.plot.files import save

        save(draw_compared(sides, [region for _, region in pairs]), Path(output))
        files["picture"] = output
    if as_json:
        print_json({"results": records, **({"files": files} if files else {})})
    else:
        click.echo(told(records[0]) if len(records) == 1 else told_all(records, parameters(sides)))
        if output:
            tell_file(output)
    click.get_current_context().exit(1 if any(record["holds"] is False for record in records) else 0)
