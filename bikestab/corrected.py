"""Zeros of conditions found in double precision → their corrections in twice double precision, with bounds.

A condition as a polynomial in V has products of three entries of the table as coefficients. Double precision
is enough to count its zeros, to come near them and for its slope there. Its value there is formed in twice
double precision from the entries themselves, so that one step of Newton's method is as good as many.
Cells for which that is not certain are left to ``certain``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bikestab.certain import Zeros, collected, signs
from bikestab.entries import Entries
from bikestab.isolation import isolated
from bikestab.model import Floats
from bikestab.roots import bracketed_root
from bikestab.rounding import COEFFICIENT, CONDITION_AT, POLYNOMIAL
from bikestab.twofold import Double, Pair, Twofold, pair_product, pair_sum, two_product

_ENOUGH = 2.0**-60  # a bound relative to its speed, far below the rounding of that
_MOST = 0.5  # of the cells: so many are worked on as quickly together with the others as by themselves
_Cells = NDArray[np.bool_]


ValueAt = Callable[[Entries, Floats], Pair]
Coefficients = Sequence[Double | None]  # of V^0, V^1, …; None where it is zero in all cells


def hurwitz3_at(entries: Entries, V: Floats) -> Pair:
    """Hurwitz3 at speeds (cell,), without damping divided by V²; to CONDITION_AT of its terms' sizes."""
    square = two_product(V, V)
    p0, p1, p2 = (
        pair_sum(entries.pair(k, j), pair_product(entries.pair(k, j + 2), square))
        for k, j in ((0, 0), (1, 1), (2, 0))
    )
    p3, p4 = entries.pair(3, 1), entries.pair(4, 0)
    if (3, 0) in entries.numbers:
        speed = V, np.zeros_like(V)
        p1 = pair_sum(pair_product(p1, speed), entries.pair(1, 0))
        p3 = pair_sum(pair_product(p3, speed), entries.pair(3, 0))
    a, b = pair_product(p4, p1)
    inner = pair_sum(pair_product(p2, p3), (-a, -b))
    a, b = pair_product(pair_product(p3, p3), p0)
    return pair_sum(pair_product(p1, inner), (-a, -b))


def p1_at(entries: Entries, V: Floats) -> Pair:
    """P1 with damping at speeds (cell,)."""
    speed = V, np.zeros_like(V)
    odd = pair_sum(entries.pair(1, 1), pair_product(entries.pair(1, 3), two_product(V, V)))
    return pair_sum(pair_product(odd, speed), entries.pair(1, 0))


def step(value: Pair, c: Coefficients, V: Floats) -> tuple[Twofold, Floats, _Cells]:
    """Zeros near V (cell,), bounds on their errors, and for which these are certain and small.

    ``value`` is that of the polynomials at V. The slope changes by less than a sixteenth on twice the way.
    """
    zero = np.zeros_like(V)
    slope, last, size, slope_size, bend = zero, zero, zero, zero, zero
    for a in c[::-1]:
        slope, bend, slope_size = slope * V + last, bend * V + 2 * slope_size, slope_size * V + size
        last, size = (last * V, size * V) if a is None else (last * V + a.value, size * V + a.size)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        steep, f, error = np.abs(slope), np.abs(value[0] + value[1]), CONDITION_AT * size
        far = 1.25 * (f + error) / steep
        doubt = (4 * POLYNOMIAL * slope_size + 2 * far * bend) / steep
        radius = 1.25 * (error + (doubt + 2.0**-50) * f) / steep
        x = V - (rest := (value[0] + value[1]) / slope)
        good = (doubt < 1 / 16) & (far <= V / 16) & (radius <= _ENOUGH * V) & (x > 0)
    return Twofold(x, (V - x) - rest), radius, good


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


def zeros_of_quadratic(entries: Entries, c: Sequence[Double]) -> Zeros:
    """The positive zeros V of hurwitz3 without damping, c0 + c1 V² + c2 V⁴; ``sure`` where they are good."""
    c0, c1, c2 = c
    product = c0 * c2
    square = c1 * c1 - Double(4 * product.value, 4 * product.size)
    (s0, sure0), (s1, sure1), (s2, sure2) = (_signs(a) for a in c)
    ends = s0 * s2
    # with ends of the same sign there are two zeros or none
    apart = (ends < 0) | (np.abs(square.value) > 4 * POLYNOMIAL * square.size) | (sure1 & (s1 * s2 >= 0))
    good = sure0 & sure2 & np.where(ends == 0, sure1, apart)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        q = -0.5 * (c1.value + np.copysign(np.sqrt(square.value), c1.value))  # NaN without real zeros
        one, other = (
            np.sqrt(np.where(good & (x > 0) & (x < np.inf), x, np.nan)) for x in (q / c2.value, c0.value / q)
        )
    polynomial = c0, None, c1, None, c2
    out = np.full((3, 2, len(good)), np.nan)
    for i, V in enumerate((np.fmin(one, other), np.maximum(one, other))):
        exists = V > 0
        number = np.count_nonzero(exists)
        if number:
            cell = np.flatnonzero(exists) if number < _MOST * len(V) else slice(None)
            out[:, i, cell], sure = _corrected(entries, polynomial, cell, V[cell])
            good[cell] &= sure | ~exists[cell]
    good &= ~(out[0, 1] - out[0, 0] <= out[2, 1] + out[2, 0])  # twice the same
    return Zeros(out[0], out[1], out[2], good)


def zeros_between(entries: Entries, c: Coefficients, value_at: ValueAt) -> Zeros:
    """The positive zeros V of p1 or hurwitz3 with damping; ``sure`` where they are good."""
    (cell, low, high, sign), undecided = isolated(c, len(entries))
    plain = np.array([np.zeros(len(cell)) if a is None else a.value[cell] for a in c])
    start = bracketed_root(plain, low, high, sign)
    found, sure = _corrected(entries, c, cell, start, value_at)
    good = ~undecided
    good[cell[~sure]] = False
    zeros = collected(cell, found, len(entries))
    for one, other in pairwise(zip(zeros.V, zeros.radius, strict=True)):
        good &= ~(other[0] - one[0] <= other[1] + one[1])
    return zeros._replace(sure=good)


def _corrected(
    entries: Entries, c: Coefficients, cell: Any, V: Floats, value_at: ValueAt = hurwitz3_at
) -> tuple[Floats, _Cells]:
    """V, rest and radius (3, root) of zeros near V (root,) in these cells, and for which they are certain."""
    some = [None if a is None else a.at(cell) for a in c]
    zero, radius, sure = step(value_at(entries.at(cell), V), some, V)
    return np.array([zero.value, zero.rest, radius]), sure
