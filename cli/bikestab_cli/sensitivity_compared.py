"""Sensitivities of several machines in one table: a column for each, or a row where there are many."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from bikestab_cli.output import WIDTH, heading_of_all, prose, table
from bikestab_cli.sensitivity_found import Found
from bikestab_cli.sensitivity_more import MOVED, effects_of
from bikestab_cli.sensitivity_words import HELD, ends_of, share, widest_of

from bikestab.records import letter_of
from bikestab.widths import columns

Effects = Mapping[str, tuple[float | None, ...]]


class Compared(NamedTuple):
    """What is told of one machine, and by parameter the effects of one per cent more of it; empty: none."""

    words: str
    effects: Effects


def compared(each: Found, what: str) -> Compared:
    """Of the ends of the widest stable interval, or of the lowest growth rate or the smallest stable σ."""
    if what != "speeds":
        moved = MOVED[what](each.of, each.first)
        effects = {
            name: (effect if math.isfinite(effect) else None,)
            for name, effect in effects_of(each.of, moved).items()
        }
        return Compared(moved.words, effects)
    widest: Any = widest_of(each.record["intervals"])
    if widest is None:
        return Compared("no stable speed", {})
    rows = widest["parameters"]
    both = {row["name"]: (row["elasticity_V1"], row["elasticity_V2"]) for row in rows}
    return Compared(f"stable from {ends_of(widest)}", both)


def by_size(machines: Sequence[Effects]) -> list[str]:
    """The parameters of all, those with the largest effect on any first."""
    sizes: dict[str, float] = {}
    for effects in machines:
        for name, values in effects.items():
            sizes[name] = max(sizes.get(name, 0.0), *(abs(value or 0.0) for value in values))
    return sorted(sizes, key=lambda name: -sizes[name])


def side_by_side(found: Sequence[Found], what: str) -> str:
    """Who they are, and one table of all of them, what matters most to any of them first."""
    machines = [compared(each, what) for each in found]
    heads = [
        f"{letter_of(i)}: {each.machine.words}: {one.words}"
        for i, (each, one) in enumerate(zip(found, machines, strict=True))
    ]
    first = found[0].of
    top = [heading_of_all([each.of.bicycle for each in found], first.model, found[0].machine.set)]
    top += dict.fromkeys(HELD[each.of.hold] for each in found)
    effects = [one.effects for one in machines]
    names = by_size(effects)
    shown = _beside(effects, names, what)
    notes = []
    if max(map(columns, shown.split("\n"))) > WIDTH:
        shown, left = _below(effects, names, what)
        notes = [f"{left} more parameters have less effect; --json and --csv have them"] if left else []
    unit = "" if what == "speeds" else MOVED[what](first, found[0].first).unit
    share_of = "%/%: per cent of the speed for one per cent of the parameter"
    change = f"1 % more: the change with one per cent more of the parameter{f', in{unit}' if unit else ''}"
    notes.insert(0, share_of if what == "speeds" else change)
    return "\n\n".join(["\n".join(map(prose, [*top, "", *heads])), shown, "\n".join(map(prose, notes))])


def _beside(machines: Sequence[Effects], names: Sequence[str], what: str) -> str:
    """A row for each parameter."""
    head = ["%/%" if what == "speeds" else "1 % more"]
    for i in range(len(machines)):
        head += [f"{letter_of(i)}: V1", "V2"] if what == "speeds" else [letter_of(i)]
    rows = [
        [name, *(cell for effects in machines for cell in _cells(effects.get(name), what))] for name in names
    ]
    return table(head, rows)


def _below(machines: Sequence[Effects], names: Sequence[str], what: str) -> tuple[str, int]:
    """A row for each machine, and columns of as many parameters as fit; how many are left out."""
    ends = ["V1", "V2"] if what == "speeds" else []
    first = [
        " ".join([letter_of(i), *ends[:1]]) + "".join(f"\n{end}" for end in ends[1:])
        for i in range(len(machines))
    ]
    for number in range(len(names), 0, -1):
        rows = [
            [own, *("\n".join(_cells(effects.get(name), what)) for name in names[:number])]
            for own, effects in zip(first, machines, strict=True)
        ]
        shown = table(["%/%" if ends else "1 % more", *names[:number]], rows)
        if max(map(columns, shown.split("\n"))) <= WIDTH:
            break
    return shown, len(names) - number


def _cells(values: tuple[float | None, ...] | None, what: str) -> list[str]:
    if values is None:
        return ["", ""] if what == "speeds" else [""]
    if what == "speeds":
        return [share(value) for value in values]
    return ["-" if value is None else f"{value:+.2e}" if value else "0" for value in values]
