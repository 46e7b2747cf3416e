"""Pictures of what each parameter moves, machines side by side."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bikestab_cli.sensitivity_more import MOVED, panel, title
from bikestab_cli.sensitivity_words import ends_of, widest_of
from bikestab_cli.several import told_apart

if TYPE_CHECKING:
    from bikestab_cli.sensitivity_found import Found

_LETTERS = 48  # beneath bars


def draw(found: Sequence[Found], what: str, output: str) -> None:
    """The effects on the speeds, the lowest growth rate, or the smallest stable σ."""
    from bikestab.plot.files import save

    if len(found) > 1:
        figure = _side_by_side(found, what)
    else:
        figure = _speeds(found[0]) if what == "speeds" else _moved(found[0], what)
    save(figure, Path(output))


def _side_by_side(found: Sequence[Found], what: str) -> Any:
    """A mark of each machine for each parameter."""
    from bikestab_cli.sensitivity_compared import by_size, compared

    from bikestab.plot.effects import Machine, draw_effects

    common, names = told_apart([each.machine for each in found])
    machines = []
    for name, each in zip(names, found, strict=True):
        told, effects = compared(each, what)
        none = ("stable from rest", "no upper limit") if effects and what == "speeds" else (told, told)
        machines.append(Machine(name, effects, none))
    of, what_moves = MOVED[what](found[0].of, found[0].first) if what != "speeds" else None, "stable speeds"
    if of is None:
        results = ["V₁ [%]\nwider interval: ←", "V₂ [%]\nwider interval: →"]
    else:
        results = [f"change{of.unit and f' [{of.unit.strip()}]'}\n← better: {of.lower}"]
        what_moves = of.what
    heading = f"{what_moves}: change with 1 % more of a parameter"
    heading = f"{common}: {heading}" if common else f"{heading[0].upper()}{heading[1:]}"
    heading += f"\n{_designs(found)}"
    return draw_effects(machines, by_size([machine.effects for machine in machines]), heading, results)


def _designs(found: Sequence[Found]) -> str:
    """At which designs, and what is held."""
    words = list(dict.fromkeys(title(each.of, "")[1] for each in found))
    held = list(dict.fromkeys(each.rpartition(", ")[2] for each in words))
    return words[0] if len(words) == 1 else f"each at its own design, {', '.join(held)}"


def _speeds(found: Found) -> Any:
    """The effects on the ends of a machine's widest stable interval."""
    from bikestab.plot.tornado import draw_tornado

    widest: Any = widest_of(found.record["intervals"])
    lines = title(found.of, found.machine.words)
    if not widest:
        return draw_tornado(lines, [])
    return draw_tornado([*lines, f"stable from {ends_of(widest)}"], widest["parameters"])


def _moved(found: Found, what: str) -> Any:
    from bikestab.plot.tornado import draw_bars

    of = MOVED[what](found.of, found.first)
    unit = of.unit.strip()
    words = f"change of the {of.what} with 1 % more{f' [{unit}]' if unit else ''}"
    words = "\n".join([*textwrap.wrap(words, _LETTERS), f"← better: {of.lower}"])
    return draw_bars(panel(found.of, of, found.machine.words), words, unit=unit)
