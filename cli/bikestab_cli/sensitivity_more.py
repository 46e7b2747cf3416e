"""The lowest growth rate and the smallest stable σ, and their derivatives: a line of each, or a table."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from bikestab_cli.output import prose, table

from bikestab.units import BUILDERS

if TYPE_CHECKING:
    from bikestab.design.sensitivity import Sensitivity
    from bikestab.plot.tornado import Panel
    from bikestab.region.first_sigma import FirstSigma

_NAMES = 6  # named in the line


class Moved(NamedTuple):
    """What parameters move, with and without its value; its sign, unit and derivatives: empty for none.

    ``lower`` says why it is better where it is less.
    """

    words: str
    what: str
    lower: str
    symbol: str
    unit: str
    slope: Mapping[str, float]


def growth_moved(found: Sensitivity) -> Moved:
    """The lowest growth rate of a design."""
    best = found.best
    words = f"lowest growth rate: {best.value:.6g} 1/s at {best.V:.6g} m/s"
    return Moved(words, "lowest growth rate", "decays faster", "growth", " 1/s", best.slope)


def sigma_moved(first: FirstSigma) -> Moved:
    """The smallest σ with a stable speed at a design's λ."""
    words = "smallest σ with a stable speed at this λ: "
    words += "none begins" if first.value is None else f"{first.value:.6g}"
    if first.kind:
        at = "" if first.V in (None, 0.0) else f" at {first.V:.6g} m/s"
        words += f" ({first.kind}{at})"
    words += f"; {first.reason}" if first.reason else ""
    return Moved(words, "smallest σ with a stable speed", "less trail is enough", "σ", "", first.slope)


MOVED: dict[str, Callable[[Sensitivity, FirstSigma], Moved]] = {
    "growth": lambda found, first: growth_moved(found),
    "sigma_min": lambda found, first: sigma_moved(first),
}


def line(found: Sensitivity, moved: Moved) -> str:
    """What it is, and which parameters of the notation move it most."""
    effects = {name: effect for name, effect in effects_of(found, moved).items() if _of_notation(found, name)}
    names = [name for name in _sorted(effects) if effects[name]][:_NAMES]
    shown = ", ".join(f"{name} {effects[name]:+.2g}" for name in names)
    return f"{moved.words}; it changes with 1 % more of\n{shown}{moved.unit}" if names else moved.words


def tables(found: Sensitivity, moved: Moved) -> list[str]:
    """What it is, and its derivatives: by the parameters of the notation, and by measures of the front."""
    if not moved.slope:
        return [moved.words]
    effects = effects_of(found, moved)
    parts = [moved.words]
    for first, of in (("parameter", True), ("front", False)):
        names = [name for name in _sorted(effects) if _of_notation(found, name) == of]
        parts.append(
            table([first, "value", "unit", f"d{moved.symbol}/dp", "1 % more"], _rows(found, moved, names))
        )
    return [*parts, f"1 % more: the change with one per cent more of the parameter{_in(moved.unit)}"]


def _in(unit: str) -> str:
    return f", in{unit}" if unit else ""


def _rows(found: Sensitivity, moved: Moved, names: Sequence[str]) -> list[list[str]]:
    rows = []
    for name in names:
        unit, size = BUILDERS.get(found.units[name], (found.units[name], 1.0))
        slope, value = moved.slope[name], found.values[name]
        effect = 0.01 * slope * abs(value)
        shown = [f"{slope / size:.6g}", f"{effect:+.2e}" if effect else "0"]
        shown = shown if math.isfinite(slope) else ["-", "-"]
        rows.append([name, f"{value * size:.5g}", unit, *shown])
    return rows


def effects_of(found: Sensitivity, moved: Moved) -> dict[str, float]:
    """The change with one per cent more of each parameter."""
    return {name: 0.01 * slope * abs(found.values[name]) for name, slope in moved.slope.items()}


def _sorted(effects: Mapping[str, float]) -> list[str]:
    """The largest first; what has none comes last."""
    return sorted(effects, key=lambda name: -abs(effects[name]) if math.isfinite(effects[name]) else 1.0)


def _of_notation(found: Sensitivity, name: str) -> bool:
    return name in found.bicycle.notation and name != "trail"  # which stands for σ there


def told_of(opening: str, found: Sensitivity, moved: Moved) -> str:
    """One machine and the tables of what was asked for."""
    return "\n\n".join(map(prose, [opening, *tables(found, moved)]))


def panel(found: Sensitivity, moved: Moved, name: str) -> Panel:
    """What a picture shows of one machine: its design and value, and the effects of 1 % more."""
    from bikestab.plot.tornado import Bar, Panel

    effects = effects_of(found, moved)
    shown = [
        Bar(name, found.values[name], found.units[name], (effects[name],), (moved.slope[name],), front)
        for front in (False, True)
        for name in _sorted(effects)
        if _of_notation(found, name) != front and math.isfinite(effects[name])
    ]
    return Panel([*title(found, name), moved.words], shown, f"no {moved.what}")


def title(found: Sensitivity, name: str) -> list[str]:
    """A picture's: whose design it is, and what is held."""
    from bikestab.plot.axes import remarks
    from bikestab.plot.headings import short

    design = (
        f"λ = {found.lam:.4g} rad (head angle {90 - math.degrees(found.lam):.2f}°), σ = {found.sigma:.4g}"
    )
    held = {"sigma": "σ"}.get(found.hold, found.hold)
    return [f"{short(name)}{remarks(found.bicycle, found.model)}", f"{design}, {held} held"]
