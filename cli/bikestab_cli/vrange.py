"""bikestab vrange: the stable speed intervals, exact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.options import (
    ANGLES,
    DESIGN_HEAD,
    TRAILS,
    design_columns,
    json_option,
    load_bicycle,
    machine_options,
    print_json,
    table,
)

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle


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
    model: str,
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
    from bikestab.errors import InputError
    from bikestab.limits import check_tilt, check_trail

    bicycle = load_bicycle(bicycle_name, delta)
    lams = _given("lam", lam, bicycle.lam, bicycle)
    sigmas = _given("sigma", sigma, bicycle.sigma, bicycle)
    for name, check, values in (("--lam", check_tilt, lams), ("--sigma", check_trail, sigmas)):
        for value in values:
            try:
                check(value, ())
            except InputError as error:
                raise click.BadParameter(f"{error.problem}; {error.hint}", param_hint=name) from None
    with_nearest = as_json or len(lams) == len(sigmas) == 1  # a table has no room for it
    results = _results(bicycle, lams, sigmas, model, with_nearest)
    if as_json:
        print_json({"bicycle": bicycle.name, "model": model, "delta": bicycle.delta, "results": results})
    else:
        click.echo(f"{bicycle.name}, {model} model, damping {bicycle.delta:g} kg m²/s\n")
        click.echo(table([*DESIGN_HEAD, "V1 [m/s]", "V2 [m/s]"], _rows(results, bicycle.c)))
        for result in results if len(results) == 1 else []:
            if result["nearest"]:
                click.echo("\n" + _advice(result["nearest"], bicycle.c))


def _given(name: str, values: list[float] | None, own: float | None, bicycle: Bicycle) -> list[float]:
    if values is None and own is None:
        raise click.UsageError(
            f"the bicycle {bicycle.name!r} has no {name} of its own: give --{name}, "
            f"for example --{name} {'0.2' if name == 'lam' else '0.08'}",
            click.get_current_context(),
        )
    return [own] if values is None else values  # type: ignore[list-item]  # one of the two is there


def _results(
    bicycle: Bicycle, lams: list[float], sigmas: list[float], model: Any, with_nearest: bool
) -> list[dict[str, Any]]:
    import numpy as np

    from bikestab.model import characteristic_table
    from bikestab.speeds import KINDS, intervals_of

    found = intervals_of(characteristic_table(bicycle, np.array(lams)[:, None], sigmas, model=model))
    results = []
    for (i, j), number in np.ndenumerate(found.number):
        intervals = [
            {
                "V1": float(found.V1[i, j, k]),
                "V2": None if math.isinf(found.V2[i, j, k]) else float(found.V2[i, j, k]),
                "lower": KINDS[found.lower[i, j, k]],
                "upper": KINDS[found.upper[i, j, k]],
            }
            for k in range(number)
        ]
        results.append(
            {
                "lam": lams[i],
                "sigma": sigmas[j],
                "head_angle_deg": 90 - math.degrees(lams[i]),
                "trail": sigmas[j] * bicycle.c,
                "intervals": intervals,
                "nearest": _nearest(bicycle, lams[i], sigmas[j], model)
                if with_nearest and not number
                else None,
            }
        )
    return results


def _nearest(bicycle: Bicycle, lam: float, sigma: float, model: Any) -> Any:
    from bikestab.family import Family
    from bikestab.region.nearest import nearest_stable

    return nearest_stable(Family(bicycle, model), lam, sigma)


def _rows(results: list[dict[str, Any]], wheelbase: float) -> list[list[str]]:
    rows = []
    for result in results:
        design = design_columns(result["lam"], result["sigma"], wheelbase)
        for interval in result["intervals"]:
            V2 = "unbounded" if interval["V2"] is None else f"{interval['V2']:.12f} ({interval['upper']})"
            rows.append([*design, f"{interval['V1']:.12f} ({interval['lower']})", V2])
            design = [""] * len(design)
        if not result["intervals"]:
            rows.append([*design, "no stable speed", ""])
    return rows


def _advice(nearest: dict[str, Any], wheelbase: float) -> str:
    lines = []  # rounded to the stable side, so that what is printed can be typed in
    if nearest["sigma_min"] is not None:
        sigma = math.ceil(nearest["sigma_min"] * 1e6) / 1e6
        lines.append(
            f"at this λ a stable speed first appears at σ = {sigma:.6f} (trail {sigma * wheelbase:.4f} m)"
        )
    elif nearest["lam_min"] is not None:
        lines.append("no larger σ up to 0.5 gives a stable speed at this λ")
    if nearest["lam_min"] is not None:
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
