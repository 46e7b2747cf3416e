"""(table, its course along the speed) → the name of each branch on each stretch.

A mode bears the name of the edge that it makes. The complex pair that crosses the imaginary axis at an end
of the stable speeds is weave, the real eigenvalue that crosses zero at one is capsize, and each keeps that
name up and down to where it meets another eigenvalue.

What makes no edge is named after the highest speeds that have exactly one complex pair. There the pair is
weave, capsize the slower and castering the faster of the two real eigenvalues beside it, and the names
stay with their branches. Where the two branches of weave are real they are called ``real pair`` (``real``
if only one is), and any other pair that oscillates, such as one of capsize with castering, ``pair 2``.

Where two motions with one name exist at one speed, the one that makes no edge there has a 2 behind its name;
if both do, the one with the higher edge.
"""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np

from bikestab.model import ExactTable, Floats
from bikestab.spectrum import eigenvalues_of
from bikestab.speeds import KINDS, intervals_of
from bikestab.stretches import Course, Stretch, in_slots

BRANCHES = ("weave", "weave", "capsize", "castering")  # the rows, each called after its own name
NAMES = ("weave", "capsize", "castering", "real pair", "real", "pair 2", "weave 2", "capsize 2")
OSCILLATING = ("weave", "weave 2", "pair 2")


class _Crossing(NamedTuple):
    """Branches that cross the imaginary axis at an end of the stable speeds, and on which stretch."""

    name: str
    stretch: int
    branches: tuple[int, ...]


def names_of(table: Floats | ExactTable, course: Course, rows: list[int]) -> list[list[str]]:
    """The names of the rows on each stretch; each is one of NAMES."""
    own = [dict(zip(rows, _names(stretch, rows), strict=True)) for stretch in course.stretches]
    made: list[dict[int, str]] = [{} for _ in own]  # on each stretch the branches that make an edge somewhere
    crossings = _crossings(table, course)
    for crossing in crossings:
        for i in _lifetime(course, crossing):
            made[i] |= dict.fromkeys(crossing.branches, crossing.name)
    for one, other in combinations(crossings, 2):
        if one.name == other.name and one.branches != other.branches:
            both = set(_lifetime(course, one)) & set(_lifetime(course, other))
            second = one if other.stretch in both and one.stretch not in both else other
            for i in both:
                made[i] |= dict.fromkeys(second.branches, second.name + " 2")
    return [_merged(edge, rest, rows) for edge, rest in zip(made, own, strict=True)]


def rows_of(table: Floats | ExactTable, course: Course) -> list[int]:
    """The branches of weave, capsize and castering, from the highest speeds with exactly one pair."""
    events, stretches = course.events, course.stretches
    last = len(stretches) - 1
    i = next((i for i in range(last, -1, -1) if stretches[i].real == 2), last)
    low = events[i - 1] if i else 0.0
    # far up, capsize falls with 1/V and castering grows with V
    V = 0.5 * (low + events[i]) if i < last else 1e3 * max(low, 1.0)
    real, _, slots = stretches[i]
    s = _in_slots_at(table, stretches[i], V)
    pairs, others = list(slots[: 4 - real]), sorted(range(4 - real, 4), key=lambda k: abs(s[k]))
    if real == 2:
        return [*pairs, *(slots[k] for k in others)]
    if real == 0:  # two pairs: weave is the faster
        return pairs if abs(s[0].imag) >= abs(s[2].imag) else [*pairs[2:], *pairs[:2]]
    slow, fast = others[0], others[-1]
    return [*(slots[k] for k in range(4) if k not in (slow, fast)), slots[slow], slots[fast]]


def _names(stretch: Stretch, rows: list[int]) -> list[str]:
    """The name of each row on a stretch, after the highest speeds that have exactly one pair."""
    complex_ = [rows.index(branch) for branch in stretch.slots[: 4 - stretch.real]]
    names = ["", "", "capsize", "castering"]
    names[0] = names[1] = "real" if {0, 1} & set(complex_) else "real pair"
    for a, b in zip(complex_[::2], complex_[1::2], strict=True):
        names[a] = names[b] = "weave" if {a, b} == {0, 1} else "pair 2"
    return names


def _merged(edge: dict[int, str], rest: dict[int, str], rows: list[int]) -> list[str]:
    """The names on a stretch: those of what makes an edge, and beside them those of the rest."""
    names = {b: name + " 2" * (name in edge.values()) for b, name in rest.items()} | edge
    if list(names.values()).count("real pair") == 1:
        names = {b: "real" if name == "real pair" else name for b, name in names.items()}
    return [names[b] for b in rows]


def _crossings(table: Floats | ExactTable, course: Course) -> list[_Crossing]:
    """What crosses the axis at each end of the stable speeds."""
    intervals = intervals_of(table)
    ends = {
        (float(V), KINDS[kind])
        for speeds, kinds in ((intervals.V1, intervals.lower), (intervals.V2, intervals.upper))
        for V, kind in zip(speeds, kinds, strict=True)
    }
    found = (_crossing(table, course, V, kind) for V, kind in sorted(ends) if kind in ("weave", "capsize"))
    return [crossing for crossing in found if crossing]


def _crossing(table: Floats | ExactTable, course: Course, V: float, kind: str) -> _Crossing | None:
    """The pair or the real eigenvalue that crosses at an end; None where rounding hides it."""
    at = int(np.searchsorted(course.events, V))
    near = sorted(range(max(at - 1, 0), min(at + 2, len(course.stretches))), key=lambda i: abs(i - at))
    for i in near:
        stretch = course.stretches[i]
        if stretch.real == (4 if kind == "weave" else 0):
            continue  # an end that is within rounding of an event
        s = _in_slots_at(table, stretch, V)
        slots = range(0, 4 - stretch.real, 2) if kind == "weave" else range(4 - stretch.real, 4)
        k = min(slots, key=lambda k: abs(s[k].real) if kind == "weave" else abs(s[k]))
        return _Crossing(kind, i, stretch.slots[k : k + 2] if kind == "weave" else (stretch.slots[k],))
    return None


def _lifetime(course: Course, crossing: _Crossing) -> range:
    """The stretches up and down to where one of the branches meets another."""

    def met(event: int) -> bool:
        return any(b in pair for pair in course.meeting[event] for b in crossing.branches)

    first = last = crossing.stretch
    while first > 0 and not met(first - 1):
        first -= 1
    while last < len(course.meeting) and not met(last):
        last += 1
    return range(first, last + 1)


def _in_slots_at(table: Floats | ExactTable, stretch: Stretch, V: float) -> np.ndarray:
    """The eigenvalues at a speed in the slots of a stretch."""
    return in_slots(eigenvalues_of(table, np.array([V])), stretch.real, stretch.tilt)[:, 0]
