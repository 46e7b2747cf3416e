"""The best designs in words and tables."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bikestab_cli.output import DESIGN_HEAD, design_columns, heading, table

if TYPE_CHECKING:
    from bikestab.design.best import Best
    from bikestab.design.criteria import Wanted
    from bikestab.design.optimum import JudgedDesign


def told(wanted: Wanted, best: Best) -> str:
    """All that was found, in the order of the questions: what was searched, the optima, the front, notes."""
    bicycle, (low, high) = wanted.family.bicycle, wanted.box
    parts = [
        f"{heading(bicycle, wanted.family.model)}\n"
        f"searched: λ = {low[0]:.6g} ... {high[0]:.6g} rad, σ = {low[1]:.6g} ... {high[1]:.6g} "
        f"(trail {low[1] * bicycle.c:.4f} ... {high[1] * bicycle.c:.4f} m)"
        + (", offset {:g} ... {:g} m".format(*wanted.offset) if wanted.offset else "")
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


def _nothing(wanted: Wanted, closest: JudgedDesign) -> str:
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
        f"what may help: {loosen}a larger range of --lam or --sigma{' or --trail' if wanted.trail else ''}"
        f"{' or --offset' if wanted.offset else ''}, "
        "or --delta"
    )


def _table(wanted: Wanted, first: str, designs: dict[str, JudgedDesign]) -> str:
    head = [first, *DESIGN_HEAD, "V1 [m/s]", "V2 [m/s]", "width [m/s]", "growth [1/s]", "at [m/s]"]
    rows = []
    for name, d in designs.items():
        ends = [
            "unbounded" if kind == "unbounded" else f"{V:.6f} ({kind})" if V is not None else "none"
            for V, kind in ((d["V1"], d["lower"]), (d["V2"], d["upper"]))
        ]
        width = f"{d['width']:.6f}" + ("*" if _is_cut(wanted, d) else " ")
        rate = "inf" if d["growth_rate"] is None else f"{d['growth_rate']:z.6f}"
        columns = design_columns(d)
        rows.append([name, *columns, *ends, width, rate, f"{d['V']:.4f}"])
    places = ["where", *(design["at"] for design in designs.values())]  # words, aligned to the left
    lines = table(head, rows).split("\n")
    return "\n".join(f"{line}  {place}".rstrip() for line, place in zip(lines, places, strict=True))


def _is_cut(wanted: Wanted, design: JudgedDesign) -> bool:
    V2 = math.inf if design["V2"] is None else design["V2"]
    return design["V1"] is not None and wanted.V_max < V2


def _notes(wanted: Wanted, designs: list[JudgedDesign], best: Best) -> list[str]:
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
