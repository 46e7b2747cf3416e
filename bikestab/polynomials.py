"""Many small polynomials at once: values, slopes, products, sums, and what rounding leaves of them.

A polynomial is an array of coefficients of x^0, x^1, … along the first axis, cells behind it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from bikestab.model import Floats
from bikestab.rounding import PRODUCTS
from bikestab.twofold import Double, Twofold

T = TypeVar("T", Twofold, Double)

Polynomial = list[Twofold | None]  # coefficients of V^0, V^1, …; None where it is zero in all cells


def value(c: Floats, x: Floats) -> Floats:
    """The polynomials (power, *shape) at x, by Horner's scheme; x broadcasts against ``shape``."""
    out = c[-1] + 0 * x  # NaN where x is
    for cj in c[-2::-1]:
        out = out * x + cj
    return out


def value_and_slopes(c: Floats, x: Floats) -> tuple[Floats, Floats, Floats]:
    """Value, first derivative and half of the second one at x of polynomials of degree 1 or more."""
    out, slope, bend = c[-1] * x + c[-2], c[-1], np.zeros_like(x)
    for cj in c[-3::-1]:
        bend = bend * x + slope
        slope = slope * x + out
        out = out * x + cj
    return out, slope, bend


def of_squares(w: Sequence[T]) -> list[T | None]:
    """A polynomial in V² as one in V."""
    out: list[T | None] = [None] * (2 * len(w) - 1)
    out[::2] = w
    return out


def product_of(a: list[T | None], b: list[T | None]) -> list[T | None]:
    """The product of polynomials of numbers with sizes; powers that none can have stay so."""
    out: list[T | None] = [None] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            if x is not None and y is not None:
                before = out[i + j]
                out[i + j] = x * y if before is None else before + x * y
    while len(out) > 1 and out[-1] is None:
        out.pop()
    return out


def difference_of(a: list[T | None], b: list[T | None]) -> list[T | None]:
    """A − b of polynomials of numbers with sizes."""
    out: list[T | None] = []
    for i in range(max(len(a), len(b))):
        x, y = (p[i] if i < len(p) else None for p in (a, b))
        out.append(x if y is None else -y if x is None else x - y)
    return out


def value_of_cubics(c: Floats, x: Floats, shape: tuple[int, ...]) -> Floats:
    """``value`` of polynomials of degree 3 as (c0 + c2 x²) + x (c1 + c3 x²), of the given shape.

    What no cell has is left out; to add zeros would not change a bit, so that no cell's value depends on
    others.
    """
    has = [bool(np.any(a)) for a in c]
    square = x * x if has[2] or has[3] else x
    even, odd = (_with_square(c[j], c[j + 2], has[j], has[j + 2], square) for j in (0, 1))
    if odd is None:
        out = np.zeros(()) if even is None else even
    else:
        out = odd * x
        if even is not None:
            out += even
    return out if np.shape(out) == shape else np.broadcast_to(out, shape)


def _with_square(a: Floats, b: Floats, has_a: bool, has_b: bool, square: Floats) -> Floats | None:
    """A + b x²."""
    if not has_b:
        return a if has_a else None
    out = b * square
    if has_a:
        out += a
    return out


def derivative(c: Floats) -> Floats:
    """The coefficients of the first derivatives; zero of constants."""
    return c * 0 if len(c) < 2 else c[1:] * np.arange(1, len(c)).reshape(-1, *(1,) * (c.ndim - 1))


def taylor(c: Floats, x: Floats) -> Floats:
    """The coefficients in powers of the distance from x."""
    out = c.copy()
    for k in range(len(out) - 1):
        for j in range(len(out) - 2, k - 1, -1):
            out[j] += out[j + 1] * x
    return out


def product(a: Floats, b: Floats) -> Floats:
    """The products of polynomials."""
    out = np.zeros((len(a) + len(b) - 1, *np.broadcast_shapes(a.shape[1:], b.shape[1:])))
    for i in used_powers(a) or [0]:
        for j in used_powers(b) or [0]:
            out[i + j] += a[i] * b[j]
    return out


def total(a: Floats, b: Floats) -> Floats:
    """The sums of polynomials, of whatever degrees."""
    n = max(len(a), len(b))
    a, b = (np.concatenate([p, np.zeros((n - len(p), *p.shape[1:]))]) for p in (a, b))
    return a + b


def settled(c: Floats, size: Floats, share: float = PRODUCTS) -> Floats:
    """Sums with zeros where they are no more than that share of the ``size`` of their terms."""
    return np.where(np.abs(c) <= share * size, 0.0, c)


def used_powers(c: Floats) -> list[int]:
    """The powers that some cell has."""
    some = np.logical_or.reduce(c.reshape(len(c), -1), axis=1)
    return np.flatnonzero(some).tolist()


def trimmed(c: Floats) -> Floats:
    """Without the powers that no cell has, below and above."""
    used = used_powers(c)
    return c[used[0] : used[-1] + 1] if used else c[:1]
