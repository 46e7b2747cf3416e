"""(table, V) → the six Routh–Hurwitz conditions (2.2): which hold, and where all do."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.model import Floats, in_powers
from bikestab.polynomials import difference_of, product_of, value_of_cubics
from bikestab.twofold import Double, Twofold

T = TypeVar("T", Twofold, Double)
_NOISE = 2.0**-90
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
    shape = np.broadcast_shapes(table.shape[2:], V.shape)
    p0, p1, p2, p3, p4 = (_at(row, V, shape) for row in table)
    return p0, p1, p2, p3, p4


def _at(row: Floats, V: Floats, shape: tuple[int, ...]) -> Floats:
    """One of them: a polynomial of degree three, and what is in proportion to 1/V."""
    out = value_of_cubics(row[:4], V, shape)
    if len(row) > 4 and row[4].any():
        with np.errstate(divide="ignore", invalid="ignore"):
            return out + np.where(row[4] == 0, 0.0, row[4] / V)  # infinite at rest
    return out


def conditions(table: Floats, V: ArrayLike) -> Conditions:
    """The left sides of (2.2) at the speeds V [m/s]; shapes as in ``coefficients_at``."""
    return _with_hurwitz3(*coefficients_at(table, V))


def _with_hurwitz3(p0: Floats, p1: Floats, p2: Floats, p3: Floats, p4: Floats) -> Conditions:
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
    return _at(row, V, np.broadcast_shapes(row.shape[1:], V.shape))


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

    Those of a table with V^−1 are multiplied by V, and hurwitz3 by V³, which changes no sign where V > 0.

    The products behind hurwitz3 are formed in twice double precision, so that what cancels is zero and what
    is left of it is right.
    """
    table = in_powers(table)
    p0, p1, p2, p3, p4 = table
    rows = [[Twofold(a) if a.any() else None for a in row] for row in table]
    found = hurwitz3_of(rows)
    if table.shape[1] > 4:
        found = without_noise(found)
    hurwitz3 = np.zeros((3 * table.shape[1] - 2, *table.shape[2:]))
    for j, a in enumerate(found):
        if a is not None:
            hurwitz3[j] = a.value
    return {"p0": p0, "p1": p1, "p2": p2, "p3": p3, "p4": p4, "hurwitz3": hurwitz3}


def without_noise(polynomial: list[Twofold | None]) -> list[Twofold | None]:
    """V³ hurwitz3 of a table with V^−1: its first three coefficients zero where rounding alone is left.

    They are made of k_phi k_deltadot − k_delta k_phidot, of gains in proportion to 1/V and constant ones (of
    which delta is one), which often cancels identically, and is else 2^−53 of its terms or so.
    """

    def settled(a: Twofold | None) -> Twofold | None:
        if a is None:
            return None
        some = np.abs(a.value) > _NOISE * a.size
        return Twofold(*(np.where(some, x, 0.0) for x in (a.value, a.rest, a.size)))

    return [*map(settled, polynomial[:3]), *polynomial[3:]]


def hurwitz3_of(rows: Sequence[list[T | None]]) -> list[T | None]:
    """p1 (p2 p3 − p4 p1) − p0 p3² as a polynomial in V, from p0 … p4 as such."""
    p0, p1, p2, p3, p4 = rows
    inner = difference_of(product_of(p2, p3), product_of(p4, p1))
    return difference_of(product_of(p1, inner), product_of(p0, product_of(p3, p3)))
