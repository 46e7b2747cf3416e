"""Intervals that hold exactly one positive zero of a polynomial each, proved by signs.

Descartes' rule for the Bernstein coefficients of an interval: as many sign changes as there are zeros in
it, or an even number more; no change proves that there is none, one that there is one. Intervals with more
are cut (de Casteljau), which takes means alone, so that errors do not grow. The positive axis is V = M x and
V = M/x with 0 < x ≤ 1. First in double precision; what that cannot tell, in twice double precision.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb, lcm
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.rounding import CUT
from bikestab.twofold import Twofold

_Indices = NDArray[np.intp]
_Flags = NDArray[np.bool_]
_MIDDLE = 1.375  # M, where the axis is cut first: no root of a polynomial that somebody wrote down
_MANY = 16  # intervals of a cell that are undecided at a time: it is zero to rounding in a whole range
_DEPTH = 100  # cuts: an eighth of what begins at zero, half of other intervals
_NARROW = 2.0**-20, 2.0**-49  # relative width at which double, and twice double precision gives up


class _Work(NamedTuple):
    """Intervals low … high of x, and their Bernstein coefficients (power, interval)."""

    cell: _Indices
    inverse: _Flags
    low: Floats
    high: Floats
    b: Twofold

    def chosen(self, which: _Flags) -> _Work:
        b = self.b.at((slice(None), which))
        return _Work(self.cell[which], self.inverse[which], self.low[which], self.high[which], b)


class Brackets(NamedTuple):
    """Cells, lower and upper ends (0 and inf are possible) and the signs at the upper ends."""

    cell: _Indices
    low: Floats
    high: Floats
    sign: Floats


def brackets(coefficients: Sequence[Twofold | None], number: int, error: float) -> tuple[Brackets, _Flags]:
    """Intervals with one zero each, and for each of the ``number`` cells whether they hold all of its zeros.

    A coefficient's ``error`` is relative to its size.
    """
    first, undecided = _isolated(coefficients, np.arange(number), error, plain=True)
    sure = np.ones(number, bool)
    if not undecided.any():
        return first, sure
    again = np.flatnonzero(undecided)
    some = [None if a is None else a.at(again) for a in coefficients]
    second, unsure = _isolated(some, np.arange(len(again)), error, plain=False)
    sure[again] = ~unsure
    kept = ~undecided[first.cell]
    second = second._replace(cell=again[second.cell])
    return Brackets(*(np.concatenate([a[kept], b]) for a, b in zip(first, second, strict=True))), sure


def _isolated(
    coefficients: Sequence[Twofold | None], cells: _Indices, error: float, *, plain: bool
) -> tuple[Brackets, _Flags]:
    """The intervals, and which cells are undecided."""
    share, narrow = (CUT, _NARROW[0]) if plain else (16 * error, _NARROW[1])
    work = _halves(coefficients, cells, error / CUT if plain else None)
    undecided = np.zeros(len(cells), bool)
    found = []
    for _ in range(_DEPTH):
        changes, clear, end = _sign_changes(work, share)
        one = clear & (changes == 1)
        found.append(_bracket_of(work.chosen(one), end[one]))
        open_ = ~clear | (changes > 1)
        undecided[work.cell[open_ & (work.high - work.low <= narrow * work.high)]] = True
        undecided |= np.bincount(work.cell[open_], minlength=len(cells)) > _MANY
        open_ &= ~undecided[work.cell]
        if not open_.any():
            break
        work = _cut(work.chosen(open_), share)
    else:
        undecided[work.cell] = True
    return Brackets(*(np.concatenate(each) for each in zip(*found, strict=True))), undecided


def _halves(coefficients: Sequence[Twofold | None], cells: _Indices, least: float | None) -> _Work:
    """0 < x ≤ 1 of V = M x and of V = M/x; in double precision where a ``least`` share of sizes is given."""
    if least is not None:
        coefficients = [c and Twofold(c.value, 0.0, np.abs(c.value) + least * c.size) for c in coefficients]
    n = len(coefficients) - 1
    rows, zeros = [], np.zeros(len(cells))
    multiple = lcm(*(comb(n, j) for j in range(n + 1)))
    for inverse in (False, True):
        a = [c and _multiple(c, _MIDDLE**j, least) for j, c in enumerate(coefficients)]
        a = a[::-1] if inverse else a
        for i in range(n + 1):
            total = Twofold(zeros, 0.0, zeros)
            for j, x in enumerate(a[: i + 1]):
                if x is not None:
                    term = _multiple(x, float(comb(i, j) * multiple // comb(n, j)), least)
                    total = _total(total, term, least)
            rows.append(total)
    whole = [Twofold(*(getattr(row, name) + zeros for name in ("value", "rest", "size"))) for row in rows]
    b = _beside([_stacked(whole[: n + 1]), _stacked(whole[n + 1 :])])
    if least is not None:
        b = Twofold(b.value, None, b.size)
    both = np.concatenate([cells, cells])
    ends = np.zeros(len(both)), np.ones(len(both))
    return _Work(both, np.arange(len(both)) >= len(cells), *ends, b)


def _multiple(a: Twofold, factor: float, least: float | None) -> Twofold:
    return a * factor if least is None else Twofold(a.value * factor, 0.0, a.size * factor)


def _total(a: Twofold, b: Twofold, least: float | None) -> Twofold:
    return a + b if least is None else Twofold(a.value + b.value, 0.0, a.size + b.size)


def _sign_changes(work: _Work, share: float) -> tuple[_Indices, _Flags, Floats]:
    """How often the coefficients change their sign, whether that is certain, and the sign at the upper V."""
    b = work.b
    uncertain = (np.abs(b.value) <= share * b.size) & (b.size > 0)
    sign = np.where(uncertain, 0.0, np.sign(b.value))
    changes = np.zeros(sign.shape[1], np.intp)
    before, after = np.zeros_like(sign), np.zeros_like(sign)
    for i in range(1, len(sign)):  # the nearest sign that is known
        before[i] = np.where(sign[i - 1] == 0, before[i - 1], sign[i - 1])
        changes += before[i] * sign[i] < 0
        after[-1 - i] = np.where(sign[-i] == 0, after[-i], sign[-i])
    # between different signs there is one change, whatever an uncertain coefficient is
    clear = ~np.any(uncertain & (before * after >= 0), axis=0)
    first, last = np.where(sign[0] == 0, after[0], sign[0]), np.where(sign[-1] == 0, before[-1], sign[-1])
    return changes, clear, np.where(work.inverse, first, last)


def _bracket_of(work: _Work, sign: Floats) -> Brackets:
    with np.errstate(divide="ignore"):
        low = np.where(work.inverse, _MIDDLE / work.high, _MIDDLE * work.low)
        high = np.where(work.inverse, _MIDDLE / work.low, _MIDDLE * work.high)
    return Brackets(work.cell, low, high, sign)


def _cut(work: _Work, share: float) -> _Work:
    """Both parts of each interval; the cut is moved where a zero may lie on it."""
    at = np.where(work.low == 0, 0.125, 0.5)
    left, right = _parts(work.b, at)
    there = left.at(-1)
    zero = np.abs(there.value) <= share * there.size
    if zero.any():
        at = np.where(zero, 0.75 * at, at)
        left, right = _parts(work.b, at)
    middle = work.low + at * (work.high - work.low)
    number = np.concatenate([work.cell, work.cell])
    inverse = np.concatenate([work.inverse, work.inverse])
    low, high = np.concatenate([work.low, middle]), np.concatenate([middle, work.high])
    return _Work(number, inverse, low, high, _beside([left, right]))


def _parts(b: Twofold, at: Floats) -> tuple[Twofold, Twofold]:
    """The Bernstein coefficients left and right of the place ``at`` (interval,) by de Casteljau's means."""
    left, right = [b.at(0)], [b.at(-1)]
    while len(b.value) > 1:
        b = _mean(b.at(slice(None, -1)), b.at(slice(1, None)), at)
        left.append(b.at(0))
        right.append(b.at(-1))
    return _stacked(left), _stacked(right[::-1])


def _mean(a: Twofold, b: Twofold, at: Floats) -> Twofold:
    size = a.size + at * (b.size - a.size)
    if a.rest is None:
        return Twofold(a.value + at * (b.value - a.value), None, size)
    moved = (b - a) * at + a
    return Twofold(moved.value, moved.rest, size)


def _stacked(rows: list[Twofold]) -> Twofold:
    value, rest, size = (
        None if getattr(rows[0], name) is None else np.array([getattr(row, name) for row in rows])
        for name in ("value", "rest", "size")
    )
    return Twofold(value, rest, size)


def _beside(parts: list[Twofold]) -> Twofold:
    value, size = (
        np.concatenate([getattr(part, name) for part in parts], axis=1) for name in ("value", "size")
    )
    rest = None if parts[0].rest is None else np.concatenate([part.rest for part in parts], axis=1)
    return Twofold(value, rest, size)
