"""Angles → sines and cosines in twice double precision, or as doubles, with the same bits anywhere."""

from __future__ import annotations

from functools import cache
from math import factorial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.twofold import Twofold
from bikestab.unordered import Unordered

_BITS = 240  # of the fixed point in which they are tabulated


def sine_cosine(angle: ArrayLike) -> tuple[Twofold, Twofold]:
    """Sin and cos of angles [rad], |angle| ≤ 1.6, right to 64 u² of their sizes.

    The angle is a multiple of 1/16, whose sine and cosine stand in a table, and a rest of at most 1/32, whose
    series are short. One angle as a float gives floats, which are ten times as fast as numpy's scalars.
    """
    number: Any = np.rint(16 * np.asarray(angle, dtype=float))
    at: Any = np.abs(number).astype(int)
    constants, tails, nodes = _constants()
    values = nodes[:, :, at]
    if isinstance(angle, float):
        number, values = float(number), values.tolist()
    small = Unordered(angle - number / 16)  # exact
    y = small * small
    series = []
    for coefficients, tail in zip(constants, tails, strict=True):
        far: Any = tail[-1]
        for a in tail[-2::-1]:  # below 2^−50 of the sum
            far = far * y.value + a
        near = Unordered(far)
        for b in coefficients[::-1]:
            near = near * y + Unordered(b.value, b.rest)
        series.append(near)
    sine, cosine = series[0] * y * small + small, series[1] * y + 1.0
    sign = 1.0 - 2.0 * (number < 0)
    S, C = Unordered(sign * values[0][0], sign * values[0][1]), Unordered(*values[1])
    return (S * cosine + C * sine).ordered(), (C * cosine - S * sine).ordered()


def plain_sine_cosine(angle: ArrayLike) -> tuple[Any, Any]:
    """Sin and cos as doubles, to a unit of the last place, by one formula for one angle and for many."""
    angle = np.asarray(angle, dtype=float)
    number = np.rint(16 * angle)
    small = angle - number / 16
    y = small * small
    constants, tails, nodes = _constants()
    series = []
    for coefficients, tail in zip(constants, tails, strict=True):
        total: Any = tail[1]
        for a in (tail[0], *(b.value for b in coefficients[::-1])):
            total = total * y + a
        series.append(total)
    sine, less = small + series[0] * y * small, series[1] * y  # less = cos − 1
    at = np.abs(number).astype(int)
    S, C = nodes[0, 0][at] * np.where(number < 0, -1.0, 1.0), nodes[1, 0][at]
    return S + (S * less + C * sine), C + (C * less - S * sine)


@cache
def _constants() -> tuple[list[list[Twofold]], list[list[float]], NDArray[np.float64]]:
    """Coefficients of (sin x / x − 1)/x² and (cos x − 1)/x² in powers of x²; sin and cos of k/16, k ≤ 26."""
    constants, tails = [], []
    for first in (3, 2):
        series = [_quotient((-1) ** (n + 1), factorial(first + 2 * n)) for n in range(7)]
        constants.append(series[:3])
        tails.append([a.value for a in series[3:]])
    nodes = np.empty((2, 2, 27))
    for k in range(27):
        terms = [(k**n << _BITS) // (16**n * factorial(n)) for n in range(40)]  # 1.7^40/40! < 2^−128
        for row, first in ((0, 1), (1, 0)):
            number = sum((-1) ** (n // 2) * terms[n] for n in range(first, 40, 2))
            nodes[row, :, k] = (a := _quotient(number, 1 << _BITS)).value, a.rest
    return constants, tails, nodes


def _quotient(a: int, b: int) -> Twofold:
    """a/b of whole numbers: Python's division rounds to the nearest double."""
    value = a / b
    m, n = value.as_integer_ratio()
    return Twofold(value, (a * n - m * b) / (b * n))
