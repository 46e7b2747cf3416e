"""Zeros of conditions found in double precision → their corrections with more digits, and bounds.

A condition as a polynomial in V has products of three entries of the table as coefficients. Double precision
is enough to count its zeros, to come near them and for its slope there. Its value there is formed in numbers
of 79 bits from the entries themselves, so that one step of Newton's method is as good as many; where these
are too few, in twice double precision. Cells for which that is not certain are left to ``certain``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.approached import Coefficients, zeros_near
from bikestab.certain import Zeros, signs
from bikestab.entries import Entries
from bikestab.halved import Halved, halved, halved_double, product, square
from bikestab.model import Floats
from bikestab.rounding import COEFFICIENT, CONDITION_AT, POLYNOMIAL
from bikestab.twofold import Double, Pair, Twofold, pair_difference, pair_product, pair_sum, two_product

_ENOUGH = 2.0**-55  # a bound relative to its speed, below the rounding of that
_MOST = 0.5  # of the cells: so many are worked on as quickly together with the others as by themselves
_STEPS = 4  # in twice double precision
_Cells = NDArray[np.bool_]
_Some = Any  # an index of cells


class Condition(NamedTuple):
    """A condition as a polynomial in V, from a table's entries.

    ``polynomial`` is made of the entries as ``Double``; ``near`` is its value at speeds of some cells, to
    CONDITION_AT of its terms' sizes, and ``at`` to COEFFICIENT of them.
    """

    polynomial: Callable[[dict[tuple[int, int], Double]], Coefficients]
    near: Callable[[Entries, Floats, _Some], Pair]
    at: Callable[[Entries, Floats], Pair]


def hurwitz3_near(entries: Entries, V: Floats, cell: _Some) -> Pair:
    """Hurwitz3 at speeds of cells, without damping divided by V²; to CONDITION_AT of its terms' sizes."""

    def entry(k: int, j: int) -> Halved:
        head, tail, whole = entries.halved(k, j)
        return head[cell], tail[cell], whole[cell]

    speed = halved_double(V)
    x = halved(square(speed))
    p0, p1, p2 = (
        halved(pair_sum(product(entry(k, j + 2), x), entries.pair(k, j, cell)))
        for k, j in ((0, 0), (1, 1), (2, 0))
    )
    p3, p4 = entry(3, 1), entry(4, 0)
    if (3, 0) in entries.numbers:
        p1 = halved(pair_sum(product(p1, speed), entries.pair(1, 0, cell)))
        p3 = halved(pair_sum(product(p3, speed), entries.pair(3, 0, cell)))
    inner = halved(pair_difference(product(p2, p3), product(p4, p1)))
    return pair_difference(product(p1, inner), product(p0, halved(square(p3))))


def p1_near(entries: Entries, V: Floats, cell: _Some) -> Pair:
    """P1 with damping, as ``hurwitz3_near``."""
    head, tail, whole = entries.halved(1, 3)
    speed = halved_double(V)
    x = halved(square(speed))
    odd = pair_sum(product((head[cell], tail[cell], whole[cell]), x), entries.pair(1, 1, cell))
    return pair_sum(product(halved(odd), speed), entries.pair(1, 0, cell))


def hurwitz3_at(entries: Entries, V: Floats) -> Pair:
    """Hurwitz3 at a speed of each cell, without damping divided by V²; to COEFFICIENT of its terms' sizes."""
    x = two_product(V, V)
    p0, p1, p2 = (
        pair_sum(entries.pair(k, j), pair_product(entries.pair(k, j + 2), x))
        for k, j in ((0, 0), (1, 1), (2, 0))
    )
    p3, p4 = entries.pair(3, 1), entries.pair(4, 0)
    if (3, 0) in entries.numbers:
        speed = V, np.zeros_like(V)
        p1 = pair_sum(pair_product(p1, speed), entries.pair(1, 0))
        p3 = pair_sum(pair_product(p3, speed), entries.pair(3, 0))
    inner = pair_difference(pair_product(p2, p3), pair_product(p4, p1))
    return pair_difference(pair_product(p1, inner), pair_product(pair_product(p3, p3), p0))


def p1_at(entries: Entries, V: Floats) -> Pair:
    """P1 with damping, as ``hurwitz3_at``."""
    speed = V, np.zeros_like(V)
    odd = pair_sum(entries.pair(1, 1), pair_product(entries.pair(1, 3), two_product(V, V)))
    return pair_sum(pair_product(odd, speed), entries.pair(1, 0))


def step(value: Pair, c: Coefficients, V: Floats, share: float) -> tuple[Floats, _Cells]:
    """Zeros near V (root,) as V, rest and radius (3, root), and for which these are certain.

    ``value`` is that of the polynomials at V, right to a ``share`` of their terms' sizes. The slope changes
    by less than a sixteenth on twice the way.
    """
    zero = np.zeros_like(V)
    slope, last, size, slope_size, bend = zero, zero, zero, zero, zero
    for a in c[::-1]:
        slope, bend, slope_size = slope * V + last, bend * V + 2 * slope_size, slope_size * V + size
        last, size = (last * V, size * V) if a is None else (last * V + a.value, size * V + a.size)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        steep, f, error = np.abs(slope), np.abs(total := value[0] + value[1]), share * size
        far = 1.25 * (f + error) / steep
        doubt = (4 * POLYNOMIAL * slope_size + 2 * far * bend) / steep
        radius = 1.25 * (error + (doubt + 2.0**-50) * f) / steep
        x = V - (move := total / slope)
        good = (doubt < 1 / 16) & (far <= V / 16) & (x > 0)
    return np.array([x, (V - x) - move, radius]), good


def _signs(a: Double) -> tuple[Floats, _Cells]:
    """The signs of coefficients, and whether they are certain; zero is where there are no terms."""
    return np.sign(a.value), (np.abs(a.value) > 2 * POLYNOMIAL * a.size) | (a.size == 0)


def zero_of_even(a: Twofold, b: Twofold, fine: bool) -> Zeros:
    """The positive zero V of a + b V², corrected where that is asked for."""
    (sign_a, sure_a), (sign_b, sure_b) = signs(a), signs(b)
    exists = sign_a * sign_b < 0
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        V = np.sqrt(np.where(exists, -a.value / b.value, np.nan))
        if not fine:  # four roundings, two of them below the root
            share = 2.0**-51 + COEFFICIENT * (a.size / np.abs(a.value) + 2 * b.size / np.abs(b.value))
            return Zeros(V[np.newaxis], np.zeros((1, len(V))), (share * V)[np.newaxis], sure_a & sure_b)
        square = two_product(V, V)
        value, rest = pair_sum((a.value, a.rest), pair_product((b.value, b.rest), square))
        steep = np.abs(b.value) * V
        move = 0.5 * (value + rest) / (b.value * V)
        error = COEFFICIENT * (a.size + b.size * square[0])
        doubt = 4 * COEFFICIENT * b.size / np.abs(b.value) + np.abs(move) / V + 2.0**-49
        x = V - move
        radius = 2 * error / steep + np.abs(move) * doubt
    return Zeros(x[np.newaxis], ((V - x) - move)[np.newaxis], radius[np.newaxis], sure_a & sure_b)


def zeros_of_quadratic(entries: Entries, condition: Condition, c: Sequence[Double]) -> Zeros:
    """The positive zeros V of hurwitz3 without damping, c0 + c1 V² + c2 V⁴; ``sure`` where they are good."""
    V, good, _ = _roots_of_quadratic(c)
    return corrected(entries, condition, (c[0], None, c[1], None, c[2]), V, good)


def rough_zeros_of_quadratic(c: Sequence[Double]) -> Zeros:
    """The same as double precision gives them, next to double zeros with as few digits as it leaves there."""
    V, good, root = _roots_of_quadratic(c)
    square = V * V
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        radius = (c[2].size * square + c[1].size) * square + c[0].size
        radius *= POLYNOMIAL / (root * V)  # the slope by V² is ± the root; half of it by V
    return Zeros(V, np.zeros_like(V), radius, good)


def _roots_of_quadratic(c: Sequence[Double]) -> tuple[Floats, _Cells, Floats]:
    """The positive V (2, cell), whether there are so many for certain, and the discriminant's root."""
    c0, c1, c2 = c
    product = c0 * c2
    square = c1 * c1 - Double(4 * product.value, 4 * product.size)
    (s0, sure0), (s1, sure1), (s2, sure2) = (_signs(a) for a in c)
    ends = s0 * s2
    # with ends of the same sign there are two zeros or none
    apart = (ends < 0) | (np.abs(square.value) > 4 * POLYNOMIAL * square.size) | (sure1 & (s1 * s2 >= 0))
    good = sure0 & sure2 & np.where(ends == 0, sure1, apart)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        root = np.sqrt(square.value)  # NaN without real zeros
        q = -0.5 * (c1.value + np.copysign(root, c1.value))
        one, other = (
            np.sqrt(np.where(good & (x > 0) & (x < np.inf), x, np.nan)) for x in (q / c2.value, c0.value / q)
        )
    return np.array([np.fmin(one, other), np.maximum(one, other)]), good, root


def zeros_between(entries: Entries, condition: Condition, c: Coefficients) -> Zeros:
    """The positive zeros V of p1 or hurwitz3 with damping; ``sure`` where they are good."""
    start, undecided = zeros_near(c, len(entries))
    return corrected(entries, condition, c, start, ~undecided)


def corrected(entries: Entries, condition: Condition, c: Coefficients, V: Floats, settled: _Cells) -> Zeros:
    """The zeros near V (rank, cell), NaN where there is none; ``sure`` where they are good.

    In ``settled`` cells it is certain that there are so many.
    """
    found = np.full((3, *V.shape), np.nan)
    missing = V > 0
    for i, exists in enumerate(missing.copy()):
        number = np.count_nonzero(exists)
        if number:
            cell = np.flatnonzero(exists) if number < _MOST * len(exists) else slice(None)
            start, some = V[i, cell], [None if a is None else a.at(cell) for a in c]
            found[:, i, cell], sure = step(condition.near(entries, start, cell), some, start, CONDITION_AT)
            missing[i, cell] &= ~(sure & (found[2, i, cell] <= _ENOUGH * start))
    rank, cell = np.nonzero(missing & settled)
    if len(rank):
        found[:, rank, cell], sure = _again(entries.at(cell), condition, V[rank, cell])
        missing[rank[sure], cell[sure]] = False
    good = settled & ~missing.any(axis=0)
    for (one, other), (rest, more), (near, far) in zip(*map(pairwise, found), strict=True):
        good &= ~((other - one) + (more - rest) <= near + far)  # it may be the same twice
    return Zeros(found[0], found[1], found[2], good)


def _again(entries: Entries, condition: Condition, V: Floats) -> tuple[Floats, _Cells]:
    """As ``step``, in twice double precision, and several times where that is needed."""
    c = condition.polynomial(entries.sized())
    for _ in range(_STEPS):
        found, sure = step(condition.at(entries, V), c, V, COEFFICIENT)
        x, rest, radius = found
        # a zero that is as good as its terms allow moves no more
        sure &= (radius <= _ENOUGH * V) | (np.abs((V - x) - rest) <= 6 * radius)
        todo = ~sure & (x > 0) & (x < np.inf)
        if not todo.any():
            break
        V = np.where(todo, x, V)
    return found, sure
