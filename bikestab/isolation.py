"""Intervals that hold exactly one positive zero of a polynomial each, proved by signs.

Descartes' rule for the Bernstein coefficients of an interval: as many sign changes as there are zeros in
it, or an even number more; no change proves that there is none, one that there is one. Intervals with more
are cut (de Casteljau), which takes means alone, so that errors do not grow. The positive axis is V = M x and
V = M/x with 0 < x ≤ 1. First in double precision; what that cannot tell, in twice double precision.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb, lcm
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.casteljau import beside, extremes, parts, stacked
from bikestab.model import Floats
from bikestab.rounding import COEFFICIENT, CUT, POLYNOMIAL
from bikestab.signchanges import sign_changes
from bikestab.twofold import Double, Twofold

_Indices = NDArray[np.intp]
_Flags = NDArray[np.bool_]
MIDDLES = 1.375, 1.28125  # M, where the axis is cut first; the second one where a zero lies on the first
MANY = 16  # intervals of a cell that are undecided at a time: it is zero to rounding in a whole range
DEPTH = 100  # cuts: an eighth of what begins at zero, half of others, or next to an extreme value
NARROW = 2.0**-20, 2.0**-49  # relative width at which double, and twice double precision gives up


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
    size = [None if a is None else Double(a.value, a.size) for a in coefficients]
    found, undecided = isolated(size, number)
    for middle in MIDDLES:
        again = np.flatnonzero(undecided)
        if not len(again):
            break
        some = [a and a.at(again) for a in coefficients]
        work = _halves(some, len(again), middle)
        more, unsure = _isolated(work, len(again), middle, 16 * error, NARROW[1])
        kept = ~undecided[found.cell]
        more = more._replace(cell=again[more.cell])
        found = Brackets(*(np.concatenate([a[kept], b]) for a, b in zip(found, more, strict=True)))
        undecided[again] = unsure
    return found, ~undecided


def guessed(coefficients: Sequence[Twofold | None], number: int) -> tuple[Brackets, _Flags]:
    """As ``brackets``, by the coefficients' signs as they are, without double zeros; no cell is sure."""
    work = _halves(coefficients, number, MIDDLES[0])
    return _isolated(work, number, MIDDLES[0], 0.0, 0.0)[0], np.zeros(number, bool)


def isolated(coefficients: Sequence[Double | None], number: int) -> tuple[Brackets, _Flags]:
    """As ``brackets``, in double precision: and which cells it leaves undecided."""
    work = _plain_halves(over_binomials(coefficients, number))
    return _isolated(work, number, MIDDLES[0], CUT, NARROW[0])


def _isolated(
    work: _Work, number: int, middle: float, share: float, narrow: float
) -> tuple[Brackets, _Flags]:
    """The intervals, and which cells are undecided."""
    undecided = np.zeros(number, bool)
    found = []
    for _ in range(DEPTH):
        changes, clear, end = _sign_changes(work, share)
        one = clear & (changes == 1)
        found.append(_bracket_of(work, one, end, middle))
        open_ = ~clear | (changes > 1)
        undecided[work.cell[open_ & (work.high - work.low <= narrow * work.high)]] = True
        undecided |= np.bincount(work.cell[open_], minlength=number) > MANY
        open_ &= ~undecided[work.cell]
        if not open_.any():
            break
        work, changes = work.chosen(open_), changes[open_]
        at = np.where(work.low == 0, 0.125, 0.5)
        if work.b.rest is not None:
            pair = np.flatnonzero(changes == 2)
            some, close = work.b.at((slice(None), pair)), share or 16 * COEFFICIENT
            at[pair], double = extremes(some, at[pair], close, alone=not share)
            undecided[work.cell[pair[double]]] |= share > 0
            apart = np.ones(len(at), bool)
            apart[pair[double]] = False
            work, at = work.chosen(apart), at[apart]
        work = _cut(work, at, share)
    else:
        undecided[work.cell] = True
    return Brackets(*(np.concatenate(each) for each in zip(*found, strict=True))), undecided


def _factors(n: int, i: int) -> list[float]:
    """Of the powers in the i-th Bernstein coefficient of 0 … 1, times what makes whole numbers of all."""
    multiple = lcm(*(comb(n, j) for j in range(n + 1)))
    return [float(comb(i, j) * multiple // comb(n, j)) for j in range(i + 1)]


def _halves(coefficients: Sequence[Twofold | None], number: int, middle: float) -> _Work:
    """0 < x ≤ 1 of V = M x and of V = M/x."""
    n = len(coefficients) - 1
    rows, zeros = [], np.zeros(number)
    for inverse in (False, True):
        a = [c and c * middle**j for j, c in enumerate(coefficients)][:: -1 if inverse else 1]
        for i in range(n + 1):
            total = Twofold(zeros, zeros, zeros)
            for x, factor in zip(a, _factors(n, i), strict=False):
                if x is not None:
                    total = total + x * factor
            rows.append(total)
    b = beside([stacked(rows[: n + 1]), stacked(rows[n + 1 :])])
    return _whole(b, number)


def over_binomials(coefficients: Sequence[Double | None], number: int) -> Floats:
    """Of V = M x: values and sizes (2, power, number) of which Bernstein coefficients are sums.

    Sizes are such that CUT of them covers the coefficients' errors too.
    """
    n = len(coefficients) - 1
    a = np.zeros((2, n + 1, number))
    for j, c in enumerate(coefficients):
        if c is not None:
            factor = MIDDLES[0] ** j / comb(n, j)
            a[0, j] = c.value * factor
            a[1, j] = (np.abs(c.value) + POLYNOMIAL / CUT * c.size) * factor
    return a


def _plain_halves(a: Floats) -> _Work:
    """``_halves`` in double precision, of what is ``over_binomials``.

    The sum over j of binomials (i, j) times a number is the first one after i times adding to each its next.
    """
    n, number = a.shape[1] - 1, a.shape[2]
    b = np.empty((2, n + 1, 2 * number))
    for sums, here in ((a, slice(number)), (a[:, ::-1], slice(number, None))):
        for i in range(n + 1):
            b[:, i, here] = sums[:, 0]
            sums = sums[:, :-1] + sums[:, 1:]
    return _whole(Twofold(b[0], None, b[1]), number)


def _whole(b: Twofold, number: int) -> _Work:
    """The intervals 0 … 1 of x, of all cells and both ways round."""
    each, ends = np.arange(2 * number), (np.zeros(2 * number), np.ones(2 * number))
    return _Work(each % max(number, 1), each >= number, *ends, b)


def _sign_changes(work: _Work, share: float) -> tuple[NDArray[Any], _Flags, Floats]:
    """How often the coefficients change their sign, whether that is certain, and the sign at the upper V."""
    bound = share * work.b.size
    changes, clear, first, last = sign_changes(work.b.value > -bound, work.b.value < bound)
    return changes, clear, np.where(work.inverse, first, last)


def _bracket_of(work: _Work, which: _Flags, sign: Floats, middle: float) -> Brackets:
    inverse, x_low, x_high = work.inverse[which], work.low[which], work.high[which]
    with np.errstate(divide="ignore"):
        low = np.where(inverse, middle / x_high, middle * x_low)
        high = np.where(inverse, middle / x_low, middle * x_high)
    return Brackets(work.cell[which], low, high, sign[which])


def _cut(work: _Work, at: Floats, share: float) -> _Work:
    """Both parts of each interval, ``at`` so much of it; the cut is moved where a zero may lie on it."""
    left, right = parts(work.b, at)
    there = left.at(-1)
    zero = np.abs(there.value) <= share * there.size
    if zero.any():
        at = np.where(zero, 0.75 * at, at)
        left, right = parts(work.b, at)
    middle = work.low + at * (work.high - work.low)
    number = np.concatenate([work.cell, work.cell])
    inverse = np.concatenate([work.inverse, work.inverse])
    low, high = np.concatenate([work.low, middle]), np.concatenate([middle, work.high])
    return _Work(number, inverse, low, high, beside([left, right]))
