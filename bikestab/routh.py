"""(table, V) → the six Routh–Hurwitz conditions (2.2): which hold, and where all do."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.model import Floats

CONDITIONS = ("p0", "p1", "p2", "p3", "p4", "hurwitz3")  # bit k of ``violated`` is CONDITIONS[k]


class Conditions(NamedTuple):
    """Left sides of the six conditions; all are positive where rectilinear motion is stable."""

    p0: Floats
    p1: Floats
    p2: Floats
    p3: Floats
    p4: Floats
    hurwitz3: Floats


def coefficients_at(table: Floats, V: ArrayLike) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """p0 … p4, the coefficients of s^0 … s^4 at the speeds V [m/s].

    ``table`` has shape (5, 4, *shape) and V broadcasts against ``shape``.
    """
    V = np.asarray(V, dtype=float)
    powers = np.any(table, axis=tuple(range(2, table.ndim)))  # powers of V that each row has in any cell
    shape = np.broadcast_shapes(table.shape[2:], V.shape)
    p0, p1, p2, p3, p4 = (_polynomial(table[k], powers[k], V, shape) for k in range(5))
    return p0, p1, p2, p3, p4


def conditions(table: Floats, V: ArrayLike) -> Conditions:
    """The left sides of (2.2) at the speeds V [m/s]; shapes as in ``coefficients_at``."""
    p0, p1, p2, p3, p4 = coefficients_at(table, V)
    hurwitz3 = p2 * p3
    hurwitz3 -= p4 * p1
    hurwitz3 *= p1
    last = p0 * p3
    last *= p3
    hurwitz3 -= last
    return Conditions(p0, p1, p2, p3, p4, hurwitz3)


def condition(table: Floats, name: str, V: ArrayLike) -> Floats:
    """One of the left sides of (2.2), by its name; shapes as in ``coefficients_at``."""
    if name == "hurwitz3":
        return conditions(table, V).hurwitz3
    V, row = np.asarray(V, dtype=float), table[CONDITIONS.index(name)]
    powers = np.any(row, axis=tuple(range(1, row.ndim)))
    return _polynomial(row, powers, V, np.broadcast_shapes(row.shape[1:], V.shape))


def violated(values: Conditions) -> NDArray[np.uint8]:
    """A bit mask: bit k = p_k ≤ 0 for k = 0…4, bit 5 = hurwitz3 ≤ 0; 0 means stable."""
    holds = np.zeros(np.shape(values[0]), np.uint8)
    for bit, value in enumerate(values):  # NaN does not hold
        holds |= (value > 0).view(np.uint8) * np.uint8(1 << bit)  # numpy shifts five times slower
    return holds ^ np.uint8((1 << len(values)) - 1)


def stable(table: Floats, V: ArrayLike) -> NDArray[np.bool_]:
    """Where rectilinear motion is asymptotically stable: all six conditions hold."""
    return violated(conditions(table, V)) == 0


def condition_polynomials(table: Floats) -> dict[str, Floats]:
    """Each condition as a polynomial in V: coefficients of V^0, V^1, … along the first axis.

    The products behind hurwitz3 can cancel exactly; what is left of them is treated as in ``model``.
    """
    p0, p1, p2, p3, p4 = table
    first = product(p1, product(p2, p3))
    second = product(p4, product(p1, p1))
    third = product(p0, product(p3, p3))
    size = (
        product(abs(p1), product(abs(p2), abs(p3)))
        + product(abs(p4), product(abs(p1), abs(p1)))
        + product(abs(p0), product(abs(p3), abs(p3)))
    )
    hurwitz3 = first - second - third
    hurwitz3[np.abs(hurwitz3) <= 64 * np.finfo(float).eps * size] = 0.0
    return {"p0": p0, "p1": p1, "p2": p2, "p3": p3, "p4": p4, "hurwitz3": hurwitz3}


def _polynomial(row: Floats, powers: NDArray[np.bool_], V: Floats, shape: tuple[int, ...]) -> Floats:
    """Horner's scheme along the first axis of ``row``, over the powers that some cell has."""
    used = [j for j, some in enumerate(powers) if some] or [0]
    value = row[used[-1]]
    for high, low in pairwise(reversed(used)):
        value = value * V ** (high - low)
        value += row[low]
    if used[0] > 0 and len(used) > 1:
        value *= V ** used[0]
    elif used[0] > 0:
        value = value * V ** used[0]
    return value if np.shape(value) == shape else np.broadcast_to(value, shape)


def product(a: Floats, b: Floats) -> Floats:
    """The product of two polynomials along the first axis."""
    out = np.zeros((len(a) + len(b) - 1, *np.broadcast_shapes(a.shape[1:], b.shape[1:])))
    for i in _used(a):
        for j in _used(b):
            out[i + j] += a[i] * b[j]
    return out


def _used(row: Floats) -> list[int]:
    """The powers that some cell has; [0] where there are none."""
    some = np.logical_or.reduce(row.reshape(len(row), -1), axis=1)
    return np.flatnonzero(some).tolist() or [0]
