"""bikestab eigen: eigenvalues against speed, with the names of their modes."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.options import (
    ANGLE_VALUE,
    DESIGN_HEAD,
    TRAIL_VALUE,
    QuantityRange,
    design_columns,
    json_option,
    load_bicycle,
    machine_options,
    print_json,
    table,
)

from bikestab.units import SPEED

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.branches import Modes

SPEEDS = QuantityRange("speed", SPEED)


@click.command("eigen")
@click.option("--lam", type=ANGLE_VALUE, metavar="ANGLE", help="Tilt of the steering axis: 0.1 or 18deg.")
@click.option("--sigma", type=TRAIL_VALUE, metavar="NUMBER", help="Trail divided by the wheelbase: 0.08.")
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
    "-o", "--output", metavar="FILE", help="Draw a PNG, PDF or SVG from START to STOP, however coarse NUM."
)
@click.option("--csv", "csv_file", metavar="FILE", help="Write V, branch, name, re, im at full precision.")
@json_option
def command(
    lam: float | None,
    sigma: float | None,
    speeds: list[float],
    bicycle_name: str,
    model: Any,
    delta: float | None,
    output: str | None,
    csv_file: str | None,
    as_json: bool,
) -> None:
    """Print or draw the eigenvalues against speed.

    At one tilt and trail, the bicycle's own without --lam or --sigma. Each mode is followed continuously.
    Files are written in place of the table, and named on stdout. JSON is an object with what vrange says of
    one design and, at the speeds V, four branches with name, re and im at each.

    Weave is the complex pair at the highest speeds that have exactly one, and of the two real eigenvalues
    beside it castering is the faster and capsize the slower; each keeps its name at lower speeds. Where the
    two of weave are real they are called a real pair ('real' if only one is), and any other pair that
    oscillates pair 2.

    \b
    Examples:
      bikestab eigen --bicycle meijaard2007
      bikestab eigen --lam 0.2 --sigma 0.08 --V 0:10:11
      bikestab eigen --bicycle meijaard2007 --V 0:36km/h:361 -o modes.png --csv modes.csv
      bikestab eigen --lam 11deg --sigma 0.08 --delta 1 --V 5 --json
    """
    from bikestab.branches import follow
    from bikestab.export.tables import MODES, modes_blocks, save_csv
    from bikestab.model import characteristic_table

    if min(speeds) < 0:
        raise click.BadParameter(f"{min(speeds):g} m/s is negative; allowed: 0 and above", param_hint="--V")
    if output and min(speeds) == max(speeds):
        raise click.BadParameter("a picture needs a range, for example 0:10:21", param_hint="--V")
    if output and not Path(output).suffix:
        raise click.BadParameter(
            f"{output!r} has no ending, such as .png, .pdf or .svg", param_hint="--output"
        )
    bicycle = load_bicycle(bicycle_name, delta)
    lam, sigma = _design(bicycle, lam, sigma)
    coefficients = characteristic_table(bicycle, lam, sigma, model=model)
    modes = follow(coefficients, speeds)
    intervals = _intervals(coefficients)
    files = {}
    if csv_file:
        save_csv(MODES, modes_blocks(modes), csv_file)
        files["csv"] = csv_file
    if output:
        from bikestab.plot.files import save
        from bikestab.plot.modes import draw_modes

        figure = draw_modes(bicycle, lam, sigma, min(speeds), max(speeds), model=model)
        save(figure, Path(output))
        files["picture"] = output
    if as_json:
        head = {"bicycle": bicycle.name, "model": model, "delta": bicycle.delta, "lam": lam, "sigma": sigma}
        head |= {"head_angle_deg": 90 - math.degrees(lam), "trail": sigma * bicycle.c}
        print_json({**head, "intervals": intervals, **_plain(modes), **files})
    elif files:
        click.echo("\n".join(files.values()))
    else:
        click.echo(f"{bicycle.name}, {model} model, damping {bicycle.delta:g} kg m²/s\n")
        click.echo(table(DESIGN_HEAD, [design_columns(lam, sigma, bicycle.c)]) + "\n")
        click.echo("\n".join([*map(_told, intervals)] or ["no stable speed"]))
        click.echo("".join(line + "\n" for line in _meetings(modes, max(speeds))))
        click.echo(table(["V [m/s]", "weave [1/s]", "capsize [1/s]", "castering [1/s]"], _rows(modes)))


def _design(bicycle: Bicycle, lam: float | None, sigma: float | None) -> tuple[float, float]:
    """The tilt and trail asked for, or the bicycle's own."""
    from bikestab.errors import InputError
    from bikestab.limits import check_tilt, check_trail

    lam = bicycle.lam if lam is None else lam
    sigma = bicycle.sigma if sigma is None else sigma
    if lam is None or sigma is None:
        name, example = ("lam", "0.2") if lam is None else ("sigma", "0.08")
        raise click.UsageError(
            f"the bicycle {bicycle.name!r} has no {name} of its own: give --{name}, "
            f"for example --{name} {example}",
            click.get_current_context(),
        )
    for option, check, value in (("--lam", check_tilt, lam), ("--sigma", check_trail, sigma)):
        try:
            check(value, ())
        except InputError as error:
            raise click.BadParameter(f"{error.problem}; {error.hint}", param_hint=option) from None
    return lam, sigma


def _intervals(coefficients: Any) -> list[dict[str, Any]]:
    """As in vrange --json; null is unbounded."""
    from bikestab.speeds import KINDS, intervals_of

    found = intervals_of(coefficients)
    return [
        {
            "V1": float(V1),
            "V2": None if math.isinf(V2) else float(V2),
            "lower": KINDS[lower],
            "upper": KINDS[upper],
        }
        for V1, V2, lower, upper in zip(*(values[: found.number] for values in found), strict=True)
    ]


def _plain(modes: Modes) -> dict[str, Any]:
    """Modes as lists; a branch has one name for each speed, since it can change where two meet."""
    from bikestab.branches import BRANCHES

    return {
        "coalescences": [
            {"V": float(V), "branches": list(pair)}
            for V, pair in zip(modes.coalescences, modes.meeting, strict=True)
        ],
        "V": modes.V.tolist(),
        "branches": [
            {"branch": branch, "name": names.tolist(), "re": s.real.tolist(), "im": s.imag.tolist()}
            for branch, names, s in zip(BRANCHES, modes.names, modes.eigenvalues, strict=True)
        ],
    }


def _told(interval: dict[str, Any]) -> str:
    lower = f"{interval['V1']:.6f} m/s ({interval['lower']})"
    if interval["V2"] is None:
        return f"stable from {lower} on, without upper limit"
    return f"stable from {lower} to {interval['V2']:.6f} m/s ({interval['upper']})"


def _meetings(modes: Modes, up_to: float) -> list[str]:
    from bikestab.branches import BRANCHES

    return [
        f"{' and '.join(dict.fromkeys(BRANCHES[row] for row in pair))}: "
        f"a complex pair on one side of {V:.6f} m/s, two real eigenvalues on the other"
        for V, pair in zip(modes.coalescences, modes.meeting, strict=True)
        if up_to >= V
    ]


def _rows(modes: Modes) -> list[list[str]]:
    return [
        [f"{V:.6g}", _couple(s[:2], names[:2]), _cell(s[2], names[2]), _cell(s[3], names[3])]
        for V, s, names in zip(modes.V, modes.eigenvalues.T, modes.names.T, strict=True)
    ]


def _couple(s: Any, names: Any) -> str:
    """The two branches of weave in one cell."""
    if names[0] == "weave":
        return f"{s[0].real:z.6f} ± {abs(s[0].imag):z.6f}i"
    if names[0] == names[1] == "real pair":
        return f"{s[0].real:z.6f}, {s[1].real:z.6f} (real pair)"
    return ", ".join(_cell(value, name) for value, name in zip(s, names, strict=True))


def _cell(s: complex, name: str) -> str:
    if name in ("capsize", "castering"):
        return f"{s.real:z.6f}"
    if name == "pair 2":
        return f"{s.real:z.6f} {'-' if s.imag < 0 else '+'} {abs(s.imag):z.6f}i (pair 2)"
    return f"{s.real:z.6f} ({name})"
