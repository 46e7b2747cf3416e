"""The best designs in words and tables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from bikestab_cli.output import (
    DESIGN_HEAD,
    as_read,
    design_columns,
    heading,
    prose,
    span_read,
    table,
    within,
)

from bikestab.records import letter_of
from bikestab.variants import parameter_of

if TYPE_CHECKING:
    from bikestab_cli.several import Chosen

    from bikestab.design.best import Best
    from bikestab.design.optimum import JudgedDesign
    from bikestab.design.wanted import Wanted


VANISHES = (
    "the lowest V1 is a limit: towards that design V1 falls, but the interval vanishes; "
    "ask for --stable A:B to get one that can be used"
)


def told_of_all(found: Sequence[tuple[Chosen, Wanted, Best]], left_out: Sequence[str]) -> str:
    """All that was found of one machine, or of several their optima, and who is left out."""
    (machine, wanted, best), *others = found
    text = told_all(found) if others or left_out else told(wanted, best, machine.changes)
    return "\n\n".join([text, *map(prose, left_out)])


def told(wanted: Wanted, best: Best, changes: str) -> str:
    """All that was found, in the order of the questions: what was searched, the optima, the front, notes."""
    changed = f" ({changes})" if changes else ""
    parts = [
        f"{heading(wanted.family.bicycle, wanted.family.model)}{changed}\n{_searched(wanted, trail=True)}"
    ]
    listed = _optima(best)
    if best.closest:
        parts.append(_nothing(wanted, best.closest))
    if listed:
        parts.append(_table([(wanted, name, design) for name, design in listed.items()], "design"))
    if best.pareto:
        parts.append("width against decay, from the widest to the fastest:")
        parts.append(_table([(wanted, str(i), design) for i, design in enumerate(best.pareto, 1)], "front"))
    parts += _notes(wanted, [*listed.values(), *best.pareto], best)
    return "\n\n".join(map(prose, parts))


def told_all(found: Sequence[tuple[Chosen, Wanted, Best]]) -> str:
    """One table of the optima of several machines, each with a letter."""
    heads, parts, rows = [], [], []
    for i, (machine, wanted, best) in enumerate(found):
        letter = letter_of(i)
        heads.append(f"{letter}: {machine.words}, damping {machine.bicycle.delta:g} kg m²/s")
        if best.closest:
            parts.append(f"{letter}: {_nothing(wanted, best.closest)}")
        rows += [(wanted, f"{letter} {name}", design) for name, design in _optima(best).items()]
    wanted = found[0][1]
    heads.append(f"{wanted.family.model} model\n{_searched(wanted, trail=False)}")
    if rows:
        parts.append(_table(rows, "design"))
    if any(_is_cut(wanted, design) for wanted, _, design in rows):
        parts.append(_cut_note(wanted))
    return "\n\n".join(map(prose, ["\n".join(heads), *parts]))


def _searched(wanted: Wanted, *, trail: bool) -> str:
    bicycle, (low, high) = wanted.family.bicycle, wanted.box
    if not wanted.family.of_front:
        ranges = (
            f"{p.symbol} = {span_read(p.name, a, b, p.unit)}"
            for p, a, b in zip(wanted.family.parameters, low, high, strict=True)
        )
        return f"searched: {', '.join(ranges)}{_asked(wanted)}"
    return (
        f"searched: λ = {low[0]:.6g} ... {high[0]:.6g} rad, σ = {low[1]:.6g} ... {high[1]:.6g}"
        + (f" (trail {low[1] * bicycle.c:.4f} ... {high[1] * bicycle.c:.4f} m)" if trail else "")
        + (", offset {:g} ... {:g} m".format(*wanted.offset) if wanted.offset else "")
        + _asked(wanted)
    )


def _asked(wanted: Wanted) -> str:
    from bikestab.design.wanted import where_judged

    stable = f", stable from {wanted.stable[0]:g} to {wanted.stable[1]:g} m/s" if wanted.stable else ""
    return f"{stable}\ndecay: growth rate {where_judged(wanted)}"


def _optima(best: Best) -> dict[str, JudgedDesign]:
    rows = {"own": best.own, "widest interval": best.widest, "lowest V1": best.lowest_V1}
    rows |= {"fastest decay": best.fastest_decay, "closest": best.closest}
    return {name: design for name, design in rows.items() if design}


def _nothing(wanted: Wanted, closest: JudgedDesign) -> str:
    """What there is where nothing is allowed, and what to loosen."""
    asked = f"with a stable speed below {wanted.V_max:g} m/s"
    if wanted.stable:
        asked = f"that is stable from {wanted.stable[0]:g} to {wanted.stable[1]:g} m/s"
    rate = closest["growth_rate"]
    worst = "at worst" if wanted.stable else "at best"
    how = "" if rate is None else f", which {worst} grows at {rate:.4g} 1/s, at {closest['V']:.4g} m/s"
    loosen = "a smaller --stable, " if wanted.stable else "a higher --V-max, "
    if "over" in closest:
        values = ", ".join(f"{name} = {value:.6g}" for name, value in closest["over"].items())
        return (
            f"no design was found {asked}\nclosest: {values}{how}\n"
            f"what may help: {loosen}larger ranges of --over, or --delta"
        )
    return (
        f"no design was found {asked}\n"
        f"closest: λ = {closest['lam']:.6g}, σ = {closest['sigma']:.6g}{how}\n"
        f"what may help: {loosen}a larger range of --lam or --sigma{' or --trail' if wanted.trail else ''}"
        f"{' or --offset' if wanted.offset else ''}, "
        "or --delta"
    )


def _table(designs: Sequence[tuple[Wanted, str, JudgedDesign]], first: str) -> str:
    """The designs, and where those lie that are not inside the box."""
    named, offset = DESIGN_HEAD[:2], DESIGN_HEAD[2]
    if over := list(designs[0][2].get("over", {})):
        bicycle = designs[0][0].family.bicycle
        units = [as_read(name, 0.0, parameter_of(bicycle, name).unit)[1] for name in over]
        named = [f"{name}\n[{unit}]".removesuffix("\n[1]") for name, unit in zip(over, units, strict=True)]
    head = [first, *named, f"width [m/s]{offset}", "V1 [m/s]", "V2 [m/s]", "growth [1/s]\nat [m/s]"]
    rows = []
    for wanted, name, d in designs:
        ends = [
            "unbounded" if kind == "unbounded" else f"{V:.5f}\n{kind}" if V is not None else "none"
            for V, kind in ((d["V1"], d["lower"]), (d["V2"], d["upper"]))
        ]
        width = f"{d['width']:.5f}" + ("*" if _is_cut(wanted, d) else " ")
        rate = "inf" if d["growth_rate"] is None else f"{d['growth_rate']:z.6f}"
        columns = design_columns(d)
        values = [within(as_read(n, x, "")[0], 9) for n, x in d.get("over", {}).items()] or columns[:2]
        rows.append([name, *values, width + columns[2], *ends, f"{rate}\n{d['V']:.4f}"])
    places = [f"{name}: {d['at']}" for _, name, d in designs if d["at"] not in ("", "interior")]
    return "\n".join([table(head, rows, fold=0), *places])


def _cut_note(wanted: Wanted) -> str:
    return f"* the interval goes on above {wanted.V_max:g} m/s, up to which widths count (--V-max)"


def _is_cut(wanted: Wanted, design: JudgedDesign) -> bool:
    V2 = math.inf if design["V2"] is None else design["V2"]
    return design["V1"] is not None and wanted.V_max < V2


def _notes(wanted: Wanted, designs: list[JudgedDesign], best: Best) -> list[str]:
    from bikestab.design.wanted import where_judged

    notes = []
    if any(_is_cut(wanted, design) for design in designs):
        notes.append(_cut_note(wanted))
    lowest = best.lowest_V1
    if lowest and "shrinks" in lowest["at"]:
        notes.append(VANISHES)
    fastest = best.fastest_decay
    if fastest and (fastest["growth_rate"] is None or fastest["growth_rate"] >= 0):
        notes.append(f"no design that was found decays {where_judged(wanted)}")
    return ["\n".join(notes)] if notes else []
