"""Functions that tell on which side of a curve a design is, of events at speeds V > 0 alone.

A discriminant or resultant in V vanishes for events at V < 0 as well. Without damping both fall together,
and all is a polynomial in V²; with little damping the two curves are so close that a function has no sign
change left between the nodes of a grid. The functions here take the positive roots only.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.polynomials import derivative, product, total, value
from bikestab.region.skeleton import CurveName, SpeedPolynomials, curve_functions, speed_polynomials
from bikestab.roots import positive_roots, sign_near_zero


def sides(table: Floats, names: Sequence[CurveName]) -> dict[CurveName, Floats]:
    """The functions of ``curve_functions``, (*shape), which may also jump where a root leaves V > 0."""
    return _sides(table, names, speed_polynomials(table))


def side_of_each(table: Floats, names: Sequence[CurveName], which: NDArray[np.intp]) -> Floats:
    """At each of some designs (5, 4, n) the function of its own curve, names[which] (n,)."""
    polynomials, power = speed_polynomials(table)
    values = np.empty(len(which))
    for name in dict.fromkeys(names):
        some = np.flatnonzero(np.array([each == name for each in names])[which])
        if len(some):
            own = SpeedPolynomials({key: poly[:, some] for key, poly in polynomials.items()}, power)
            values[some] = _sides(table[..., some], [name], own)[name]
    return values


def _sides(table: Floats, names: Sequence[CurveName], found: SpeedPolynomials) -> dict[CurveName, Floats]:
    polynomials, power = found
    if power == 2 or table.shape[1] > 4 or table[0, 1::2].any():  # p0 has odd powers with some gains alone
        return curve_functions(table, names, polynomials)
    p0, p1, p2, p3, p4 = table
    weave = polynomials["hurwitz3"]
    damped: dict[CurveName, Callable[[], Floats]] = {
        "fold": lambda: _folded(weave),
        "crossing": lambda: _crossed(p1, p3),
        "meet": lambda: _at_capsize(total(product(p2, p3), -product(p4, p1)), p0),
        "slow meet": lambda: _at_capsize(p1, p0),
    }
    plain = [name for name in names if name not in damped]
    values = curve_functions(table, plain, polynomials) if plain else {}
    return {name: damped[name]() if name in damped else values[name] for name in names}


def _folded(weave: Floats) -> Floats:
    """The smallest extremum at V > 0 relative to its terms, with a sign that alters where two roots meet.

    The sign is that of half the number of positive roots, without those that came in from infinity or rest:
    where the outermost coefficient becomes negative one comes or goes, as the next one's sign says.
    """
    size, number = np.ones(weave.shape[1:]), np.zeros(weave.shape[1:], np.intp)
    sign = sign_near_zero(weave)
    for V in positive_roots(derivative(weave)):
        with np.errstate(invalid="ignore"):
            f = value(weave, V)
            size = np.fmin(size, np.abs(f) / value(np.abs(weave), V))
        number += sign * f < 0
        sign = np.where(np.abs(f) > 0, np.sign(f), sign)
    number += sign * sign_near_zero(weave[::-1]) < 0
    for outer, next_one in ((weave[-1], weave[-2]), (weave[0], weave[1])):
        number = number - np.where(outer < 0, np.where(next_one > 0, 1, -1), 0)
    return np.where(number // 2 % 2, -size, size)


def _crossed(p1: Floats, p3: Floats) -> Floats:
    """The product of p3 at the positive roots of p1."""
    result = np.ones(p1.shape[1:])
    for V in positive_roots(p1):
        result = result * np.where(np.isfinite(V), value(p3, V) / (1 + V), 1.0)
    return result


def _at_capsize(f: Floats, p0: Floats) -> Floats:
    """A polynomial f of degree 3 at the capsize speed V = √(a/b), where p0 is a − b V², times b^{3/2}.

    Where a/b < 0 there is none: |f| at V = i √|a/b|, which is no zero, with the sign that makes it continuous
    where b changes its own. So a curve can be followed to where it leaves to infinity.
    """
    a, b = p0[0], -p0[2]
    sign = np.where(b < 0, -1.0, 1.0)
    a, b = sign * a, np.abs(b)
    V, root = np.sqrt(np.abs(a)), np.sqrt(b)
    even, odd = root * (f[0] * b + f[2] * a), V * (f[1] * b + f[3] * a)
    return sign * np.where(a < 0, -np.copysign(np.hypot(even, odd), f[3]), even + odd)
