"""bikestab design: the best tilt and trail by several criteria."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.options import (
    DESIGN_HEAD,
    SPEED_VALUE,
    QuantityEnds,
    design_columns,
    json_option,
    load_bicycle,
    machine_options,
    print_json,
    table,
)

from bikestab.units import ANGLE, PURE, SPEED

if TYPE_CHECKING:
    from bikestab.design.best import Best, Design
    from bikestab.design.criteria import Wanted

Ends = tuple[float, float]
SPEEDS = QuantityEnds("speed", SPEED)


@click.command("design")
@click.option(
    "--lam",
    type=QuantityEnds("angle", ANGLE),
    metavar="START:STOP",
    default="0:0.6",
    show_default=True,
    help="Tilts of the steering axis, such as 10deg:25deg; one value fixes the tilt.",
)
@click.option(
    "--sigma",
    type=QuantityEnds("number", PURE),
    metavar="START:STOP",
    default="0:0.3",
    show_default=True,
    help="Trails divided by the wheelbase; one value fixes the trail.",
)
@click.option(
    "--trail", type=QuantityEnds("number", PURE), metavar="START:STOP", help="Trails [m]; cuts --sigma."
)
@click.option(
    "--V",
    "judged",
    type=SPEEDS,
    metavar="SPEED|START:STOP",
    help="Where decay is judged, at the worst of a range.  [default: at the best speed of each design]",
)
@click.option(
    "--stable", type=SPEEDS, metavar="START:STOP", help="Only designs that are stable at all these speeds."
)
@click.option(
    "--V-max",
    "V_max",
    type=SPEED_VALUE,
    metavar="SPEED",
    default="30",
    show_default=True,
    help="Intervals count up to here [m/s]; those that start above do not.",
)
@machine_options
@click.option("-o", "--output", metavar="FILE", help="Draw the (λ, σ) plane as PNG, PDF or SVG.")
@click.option("--csv", "csv_file", metavar="FILE", help="Write the Pareto front at full precision.")
@json_option
def command(
    lam: Ends,
    sigma: Ends,
    trail: Ends | None,
    judged: Ends | None,
    stable: Ends | None,
    V_max: float,
    bicycle_name: str,
    model: Any,
    delta: float | None,
    output: str | None,
    csv_file: str | None,
    as_json: bool,
) -> None:
    """Find the best tilt and trail.

    The widest interval of stable speeds, the lowest V1, the fastest decay (the lowest growth rate), and the
    Pareto front: designs of which none has both a wider interval and a faster decay than another.

    The search starts from 161 × 161 designs, so a region of allowed designs that is narrower than 1/160 of
    the box can be missed; a smaller box looks closer. The last column says where an optimum lies: at an
    edge of the stable region the interval may shrink to a point, which --stable avoids; at a jump it
    breaks up, or loses its width at once, just beside the optimum.

    \b
    Examples:
      bikestab design --bicycle meijaard2007 --V 5
      bikestab design --lam 10deg:25deg --trail 0.05:0.12 --stable 16km/h:5
      bikestab design --sigma 0.08 --V 4:6 --json
      bikestab design --stable 4:6 --V 4:6 -o design.png --csv front.csv
    """
    from bikestab.design.best import best_designs
    from bikestab.design.criteria import Wanted
    from bikestab.errors import InputError
    from bikestab.export.tables import FRONT, front_blocks, save_csv
    from bikestab.family import Family

    bicycle = load_bicycle(bicycle_name, delta)
    try:
        wanted = Wanted(Family(bicycle, model), lam, sigma, trail, V_max, judged, stable)
    except InputError as error:
        option = {"judged": "--V", "V_max": "--V-max"}.get(str(error.key[0]), f"--{error.key[0]}")
        hint = error.hint.replace("V_max", "--V-max")
        raise click.BadParameter(f"{error.problem}; {hint}", param_hint=option) from None
    if output:
        _check_picture(output, lam, sigma)
    if csv_file and output and Path(csv_file).absolute() == Path(output).absolute():
        raise click.BadParameter(f"{csv_file!r} is the picture too", param_hint="--csv")
    for name in filter(None, (output, csv_file)):
        if not Path(name).absolute().parent.is_dir():
            raise InputError("cannot be written (No such file or directory)", place=name)
    best = best_designs(wanted)
    if not as_json:
        click.echo(_told(wanted, best))
    files = {}
    if csv_file:
        save_csv(FRONT, front_blocks(best.pareto), csv_file)
        files["front"] = csv_file
    if output:
        from bikestab.plot.designs import draw_designs
        from bikestab.plot.files import save
        from bikestab.region.curves import trace

        figure = draw_designs(wanted, best, trace(wanted.family, lam, sigma))
        save(figure, Path(output))
        files["picture"] = output
    if as_json:
        head = {"bicycle": bicycle.name, "model": model, "delta": bicycle.delta, "lam": lam, "sigma": sigma}
        head |= {"trail": trail, "V_max": V_max, "judged": judged, "stable": stable}
        print_json({**head, **best._asdict(), **files})
    else:
        for kind, name in files.items():
            click.echo(f"{kind}: {name}")


def _check_picture(output: str, lam: Ends, sigma: Ends) -> None:
    if Path(output).suffix.lower() not in (".png", ".pdf", ".svg"):
        raise click.BadParameter(f"{output!r} has no ending .png, .pdf or .svg", param_hint="--output")
    for name, ends in (("--lam", lam), ("--sigma", sigma)):
        if ends[0] == ends[1]:
            raise click.BadParameter(
                f"a picture needs a range, not {ends[0]:g} alone; leave --output out, or give START:STOP",
                param_hint=name,
            )


def _told(wanted: Wanted, best: Best) -> str:
    bicycle, (low, high) = wanted.family.bicycle, wanted.box
    parts = [
        f"{bicycle.name}, {wanted.family.model} model, damping {bicycle.delta:g} kg m²/s\n"
        f"searched: λ = {low[0]:.6g} ... {high[0]:.6g} rad, σ = {low[1]:.6g} ... {high[1]:.6g} "
        f"(trail {low[1] * bicycle.c:.4f} ... {high[1] * bicycle.c:.4f} m)"
        + (f", stable from {wanted.stable[0]:g} to {wanted.stable[1]:g} m/s" if wanted.stable else "")
        + f"\ndecay: growth rate {_where_judged(wanted)}"
    ]
    rows = {"own": best.own, "widest interval": best.widest, "lowest V1": best.lowest_V1}
    rows |= {"fastest decay": best.fastest_decay, "closest": best.closest}
    listed = {name: design for name, design in rows.items() if design}
    if best.closest:
        parts.append(_nothing(wanted, best.closest))
    if listed:
        parts.append(_table(wanted, "design", listed))
    if best.pareto:
        parts.append("width against decay, from the widest to the fastest:")
        parts.append(_table(wanted, "front", {str(i): d for i, d in enumerate(best.pareto, 1)}))
    parts += _notes(wanted, [*listed.values(), *best.pareto], best)
    return "\n\n".join(parts)


def _where_judged(wanted: Wanted) -> str:
    if not wanted.judged:
        return f"at each design's best stable speed up to {wanted.V_max:g} m/s"
    start, stop = wanted.judged
    return f"at {start:g} m/s" if start == stop else f"at the worst speed from {start:g} to {stop:g} m/s"


def _nothing(wanted: Wanted, closest: Design) -> str:
    """What there is where nothing is allowed, and what to loosen."""
    asked = f"with a stable speed below {wanted.V_max:g} m/s"
    if wanted.stable:
        asked = f"that is stable from {wanted.stable[0]:g} to {wanted.stable[1]:g} m/s"
    rate = closest["growth_rate"]
    worst = "at worst" if wanted.stable else "at best"
    how = "" if rate is None else f", which {worst} grows at {rate:.4g} 1/s, at {closest['V']:.4g} m/s"
    loosen = "a smaller --stable, " if wanted.stable else "a higher --V-max, "
    return (
        f"no design was found {asked}\n"
        f"closest: λ = {closest['lam']:.6g}, σ = {closest['sigma']:.6g}{how}\n"
        f"what may help: {loosen}a larger range of --lam or --sigma{' or --trail' if wanted.trail else ''}, "
        "or --delta"
    )


def _table(wanted: Wanted, first: str, designs: dict[str, Design]) -> str:
    head = [first, *DESIGN_HEAD, "V1 [m/s]", "V2 [m/s]", "width [m/s]", "growth [1/s]", "at [m/s]"]
    rows = []
    for name, d in designs.items():
        ends = [
            "unbounded" if kind == "unbounded" else f"{V:.6f} ({kind})" if V is not None else "none"
            for V, kind in ((d["V1"], d["lower"]), (d["V2"], d["upper"]))
        ]
        width = f"{d['width']:.6f}" + ("*" if _is_cut(wanted, d) else " ")
        rate = "inf" if d["growth_rate"] is None else f"{d['growth_rate']:z.6f}"
        columns = design_columns(d["lam"], d["sigma"], wanted.family.bicycle.c)
        rows.append([name, *columns, *ends, width, rate, f"{d['V']:.4f}"])
    places = ["where", *(design["at"] for design in designs.values())]  # words, aligned to the left
    lines = table(head, rows).split("\n")
    return "\n".join(f"{line}  {place}".rstrip() for line, place in zip(lines, places, strict=True))


def _is_cut(wanted: Wanted, design: Design) -> bool:
    V2 = math.inf if design["V2"] is None else design["V2"]
    return design["V1"] is not None and wanted.V_max < V2


def _notes(wanted: Wanted, designs: list[Design], best: Best) -> list[str]:
    notes = []
    if any(_is_cut(wanted, design) for design in designs):
        notes.append(f"* the interval goes on above {wanted.V_max:g} m/s, up to which widths count (--V-max)")
    lowest = best.lowest_V1
    if lowest and "shrinks" in lowest["at"]:
        notes.append(
            "the lowest V1 is a limit: towards that design V1 falls, but the interval vanishes; "
            "ask for --stable A:B to get one that can be used"
        )
    fastest = best.fastest_decay
    if fastest and (fastest["growth_rate"] is None or fastest["growth_rate"] >= 0):
        notes.append(f"no design that was found decays {_where_judged(wanted)}")
    return ["\n".join(notes)] if notes else []
