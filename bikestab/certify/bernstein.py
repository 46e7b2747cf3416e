"""Polynomials in Bernstein form: their coefficients bound their values from both sides.

On a box the values of a polynomial lie between the smallest and the largest of its Bernstein coefficients.
The coefficients on a part of the box are averages of those on the whole, with weights that are products
and sums of numbers between 0 and 1. Nothing cancels there, so a bound on the rounding is short: with
u = 2^−53 and a degree of n, a weight takes at most 3 n roundings and the average n + 1 more, so that after
all axes a coefficient is right to K u of the average of sizes, K = Σ (4 n + 4) + 2 (docs/trust.md).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import comb, lcm
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.algebra import Polynomial

Floats = NDArray[np.float64]
SPEED = 2  # the axis of V or V²: sizes differ most along it
_UNIT = 2.0**-53
_SMALLEST = 1e-280  # what is not above is not told from zero, for products of smaller numbers underflow


class Bernstein(NamedTuple):
    """Coefficients on a whole box, one axis for each variable, and K u."""

    coefficients: Floats
    rounding: float


def bernstein(polynomial: Polynomial, box: Sequence[tuple[Fraction, Fraction]]) -> Bernstein:
    """The Bernstein coefficients of a polynomial on a box, to the nearest doubles."""
    shape = [polynomial.degree(i) + 1 for i in range(polynomial.number)]
    below = lcm(*(value.denominator for value in polynomial.terms.values()))
    exact = np.zeros(shape, dtype=object)  # whole numbers: fractions would be cancelled at each step
    for powers, value in polynomial.terms.items():
        exact[powers] = int(value * below)
    for axis, (low, high) in enumerate(box):
        change, scale = _change(shape[axis] - 1, low, high)
        exact, below = np.moveaxis(np.tensordot(change, exact, axes=(1, axis)), 0, axis), below * scale
    nearest = [value / below for value in exact.ravel().tolist()]
    return Bernstein(np.reshape(nearest, shape), (4 * sum(shape) + 2) * _UNIT)


def _change(degree: int, low: Fraction, high: Fraction) -> tuple[NDArray[np.object_], int]:
    """Coefficients of powers on a line → Bernstein coefficients between low and high, times the number given.

    Coefficient i is the polar form at i times ``high`` and degree − i times ``low``.
    """
    q = lcm(low.denominator, high.denominator)
    a, b, combs = int(low * q), int(high * q), [comb(degree, k) for k in range(degree + 1)]
    multiple = lcm(*combs)
    change = np.zeros((degree + 1, degree + 1), dtype=object)
    for i in range(degree + 1):
        # Σ_k x^k/comb(degree, k) [z^k] (1 + high z)^i (1 + low z)^(degree − i)
        row = [1] + [0] * degree
        for value in [b] * i + [a] * (degree - i):
            row = [row[0]] + [row[k] + value * row[k - 1] for k in range(1, degree + 1)]
        change[i] = [row[k] * q ** (degree - k) * (multiple // combs[k]) for k in range(degree + 1)]
    return change, multiple * q**degree


def bounds(whole: Bernstein, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Lower and upper bounds of the polynomial on parts of the box, for certain.

    ``low`` and ``high`` (part, axis) are the parts' ends, from 0 to 1 on each side of the box.
    """
    shape, parts = whole.coefficients.shape, len(low)
    weights = [_weights(length - 1, low[:, axis], high[:, axis]) for axis, length in enumerate(shape)]
    # not as one product of large matrices, for which threads of the linear algebra would wait for each other
    values: Floats = np.matmul(weights[0], whole.coefficients.reshape(shape[0], -1))
    for length, weight in zip(shape[1:], weights[1:], strict=True):
        values = values.swapaxes(1, 2).reshape(parts, length, -1)  # the next axis comes first
        values = np.matmul(weight, values)
    values = values.reshape(parts, -1)
    others = tuple(axis for axis in range(len(shape)) if axis != SPEED)
    size = np.matmul(weights[SPEED], np.abs(whole.coefficients).max(axis=others)).max(axis=1)
    error = 1.01 * whole.rounding * size + _SMALLEST
    return values.min(axis=1) - error, values.max(axis=1) + error


def _weights(degree: int, low: Floats, high: Floats) -> Floats:
    """Coefficients on the whole side → those between low and high; shape (part, degree + 1, degree + 1).

    Row i has the coefficients of (1 − low + low z)^(degree − i) (1 − high + high z)^i.
    """
    weights: Floats = np.zeros((len(low), degree + 1, degree + 1))
    weights[:, :, 0] = 1
    number = np.arange(degree + 1)
    for step in range(degree):  # row i takes ``high`` in its last i steps
        factor = np.where(number >= degree - step, high[:, np.newaxis], low[:, np.newaxis])[..., np.newaxis]
        kept = (1 - factor) * weights
        kept[:, :, 1:] += factor * weights[:, :, :-1]
        weights = kept
    return weights
