"""bikestab vrange: the stable speed intervals, exact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click
from bikestab_cli.options import ANGLES, TRAILS, json_option, load_bicycle, machine_options, told_as_options
from bikestab_cli.output import DESIGN_HEAD, design_columns, heading, print_json, table

if TYPE_CHECKING:
    from bikestab.model import Model
    from bikestab.region.answers import Answer
    from bikestab.region.nearest import Nearest


@click.command("vrange")
@click.option(
    "--lam", type=ANGLES, metavar="ANGLE|RANGE", help="Tilt of the steering axis: 0.1, 18deg or 0.05:0.3:6."
)
@click.option(
    "--sigma", type=TRAILS, metavar="NUMBER|RANGE", help="Trail divided by the wheelbase: 0.08 or 0:0.15:16."
)
@machine_options
@json_option
def command(
    lam: list[float] | None,
    sigma: list[float] | None,
    bicycle_name: str,
    model: Model,
    delta: float | None,
    as_json: bool,
) -> None:
    """Print the stable speeds V1 < V < V2.

    The ends are exact roots, not read off a grid, and each is named: weave (an oscillation starts), capsize
    (a slow fall starts), rest (V = 0) or unbounded. Without --lam or --sigma the bicycle's own are
    taken. A range START:STOP:NUM gives a table.

    Where there is no stable speed the answer says what would help: the smallest larger σ and the nearest λ
    that give one (searched over 0 ≤ λ ≤ 0.6 rad and 0 ≤ σ ≤ 0.5), and the speed up to 50 m/s at which
    the motion is least unstable.

    \b
    Examples:
      bikestab vrange --lam 0.2 --sigma 0.08
      bikestab vrange --lam 0.05:0.3:6 --sigma 0.1
      bikestab vrange --bicycle meijaard2007
      bikestab vrange --bicycle meijaard2007 --lam 20deg --json
      bikestab vrange --lam 0.1 --sigma 0.08 --delta 1
    """
    from bikestab.region.answers import stable_speeds

    bicycle = load_bicycle(bicycle_name, delta)
    single = all(values is None or len(values) == 1 for values in (lam, sigma))
    with told_as_options():  # a table has no room for what is nearest
        answers = stable_speeds(bicycle, lam, sigma, model=model, nearest=as_json or single)
    if as_json:
        print_json({"bicycle": bicycle.name, "model": model, "delta": bicycle.delta, "results": answers})
        return
    click.echo(heading(bicycle, model) + "\n")
    click.echo(table([*DESIGN_HEAD, "V1 [m/s]", "V2 [m/s]"], _rows(answers, bicycle.c)))
    if single and (nearest := answers[0]["nearest"]):
        click.echo("\n" + _advice(nearest, bicycle.c))


def _rows(answers: list[Answer], wheelbase: float) -> list[list[str]]:
    rows = []
    for result in answers:
        design = design_columns(result["lam"], result["sigma"], wheelbase)
        for interval in result["intervals"]:
            V2 = "unbounded" if interval["V2"] is None else f"{interval['V2']:.12f} ({interval['upper']})"
            rows.append([*design, f"{interval['V1']:.12f} ({interval['lower']})", V2])
            design = [""] * len(design)
        if not result["intervals"]:
            rows.append([*design, "no stable speed", ""])
    return rows


def _advice(nearest: Nearest, wheelbase: float) -> str:
    lines = []  # rounded to the stable side, so that what is printed can be typed in
    if nearest["sigma_min"] is not None:
        sigma = math.ceil(nearest["sigma_min"] * 1e6) / 1e6
        lines.append(
            f"at this λ a stable speed first appears at σ = {sigma:.6f} (trail {sigma * wheelbase:.4f} m)"
        )
    elif nearest["lam_min"] is not None:
        lines.append("no larger σ up to 0.5 gives a stable speed at this λ")
    if nearest["lam_min"] is not None and nearest["lam_max"] is not None:
        low, high = math.ceil(nearest["lam_min"] * 1e6) / 1e6, math.floor(nearest["lam_max"] * 1e6) / 1e6
        lines.append(
            f"at this σ there is one for λ = {low:.6f} ... {high:.6f} rad (head angle "
            f"{90 - math.degrees(low):.2f} ... {90 - math.degrees(high):.2f}°), of 0 ... 0.6 rad searched"
        )
    if not lines:
        lines.append(
            "no larger σ up to 0.5 at this λ, and no λ from 0 to 0.6 rad at this σ, gives a stable speed"
        )
    if nearest["V"] is not None:
        lines.append(
            f"least unstable at {nearest['V']:.3f} m/s of 0 ... 50 m/s searched, "
            f"where it grows at {nearest['growth_rate']:.4g} 1/s"
        )
    return "\n".join(lines)
