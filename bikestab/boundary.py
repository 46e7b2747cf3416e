"""A check of the critical speeds: sign changes of the conditions (2.2) on the grid, refined.

A second way to them, independent of the polynomials in ``speeds``: the conditions themselves are
evaluated at the grid's speeds, and each sign change is refined by scipy.
"""

from __future__ import annotations

from math import comb
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import elementwise

from bikestab.errors import ScanError
from bikestab.model import Floats
from bikestab.routh import CONDITIONS, condition_polynomials, conditions

AGREEMENT = 1e-10  # m/s, between this way and the exact one
_ROUNDING = 16 * np.finfo(float).eps  # of a condition, relative to the sum of its terms' sizes
_ZERO = 128 * np.finfo(float).eps  # below it a condition is no number: ``routh`` drops what is below half


class Brackets(NamedTuple):
    """Sign changes of one condition: in which cell, and between which two speeds [m/s]."""

    cell: NDArray[np.intp]
    low: Floats
    high: Floats


class Agreement(NamedTuple):
    """How far the refined roots are from the exact speeds.

    ``largest`` [m/s] is over the roots that double precision fixes to AGREEMENT, and inf if one of them
    is no exact speed at all; of the ``loose`` others, close to a fold, ``largest_loose`` is the same.
    ``touching`` counts roots that are neither: the condition is zero there to rounding, and which sign
    it has, if it changes it at all, cannot be told.
    """

    roots: int = 0
    largest: float = 0.0
    loose: int = 0
    largest_loose: float = 0.0
    touching: int = 0

    def joined(self, other: Agreement) -> Agreement:
        return Agreement(
            self.roots + other.roots,
            max(self.largest, other.largest),
            self.loose + other.loose,
            max(self.largest_loose, other.largest_loose),
            self.touching + other.touching,
        )


def sign_changes(mask: NDArray[np.uint8], V: Floats) -> dict[str, Brackets]:
    """Where each bit of ``violated``, shape (cell, len(V)), changes from one speed to the next."""
    change = mask[:, 1:] ^ mask[:, :-1]
    found = {}
    for bit, name in enumerate(CONDITIONS):
        cell, i = np.nonzero(change & (1 << bit))
        found[name] = Brackets(cell, V[i], V[i + 1])
    return found


def refine(table: Floats, name: str, brackets: Brackets) -> Brackets:
    """The roots in the brackets as ``low`` = ``high``; those at V = 0 are dropped.

    ``table`` has shape (5, 4, cell). Raises ScanError if a root is not found.
    """

    def value(V: Floats, *entries: Floats) -> Floats:
        return getattr(conditions(np.array(entries).reshape(5, 4, -1), V), name)

    cell, low, high = brackets
    entries = tuple(table[..., cell].reshape(20, -1))
    if len(cell):  # at rest every odd coefficient is zero, which is no crossing of the surface
        at_rest = (low == 0) & (value(low, *entries) == 0)
        cell, low, high = cell[~at_rest], low[~at_rest], high[~at_rest]
        entries = tuple(table[..., cell].reshape(20, -1))
    if not len(cell):
        return Brackets(cell, low, high)
    found = elementwise.find_root(
        value, (low, high), args=entries, tolerances={"xrtol": 1e-15, "xatol": 1e-15}
    )
    if not found.success.all():
        worst = int(np.argmin(found.success))
        raise ScanError(
            f"{name}: {np.count_nonzero(~found.success)} of {len(cell)} sign changes could not be refined, "
            f"the first between {low[worst]:.9g} and {high[worst]:.9g} m/s (status {found.status[worst]})"
        )
    return Brackets(cell, found.x, found.x)


def agreement(table: Floats, name: str, roots: Brackets, exact: Floats) -> Agreement:
    """Compare refined roots with the exact speeds (root, cell) of the same condition.

    A root is as uncertain as the rounding of the condition's terms divided by its slope; where that
    is more than AGREEMENT neither way can tell better. There the two may differ by what the rounding
    allows, or one of them may see two roots and the other none.
    """
    cell, V, _ = roots
    if not len(cell):
        return Agreement()
    padded = np.concatenate([exact[:, cell], np.full((1, len(cell)), np.inf)])
    difference = np.nanmin(np.abs(padded - V), axis=0)
    a = conditions(np.abs(table[..., cell]), V)
    size = getattr(a, name) if name != "hurwitz3" else a.p1 * (a.p2 * a.p3 + a.p4 * a.p1) + a.p0 * a.p3**2
    taylor = _taylor(condition_polynomials(table[..., cell])[name], V)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        sharp = _ROUNDING * size / np.abs(taylor[1]) < AGREEMENT
        near = difference <= _reach(taylor, _ZERO * size)
    loose = ~sharp & near
    touching = ~sharp & ~near & (np.abs(taylor[0]) <= _ZERO * size)
    alone = ~(sharp | loose | touching)
    return Agreement(
        len(cell),
        np.inf if alone.any() else float(difference[sharp].max(initial=0)),
        int(np.count_nonzero(loose)),
        float(difference[loose].max(initial=0)),
        int(np.count_nonzero(touching)),
    )


def _taylor(polynomial: Floats, V: Floats) -> Floats:
    """The coefficients of the polynomials in powers of the distance from V."""
    a = polynomial.copy()
    for k in range(len(a) - 1):
        for j in range(len(a) - 2, k - 1, -1):
            a[j] += a[j + 1] * V
    return a


def _reach(taylor: Floats, zero: Floats) -> Floats:
    """How far from V a root may be of a polynomial whose value there is up to ``zero``.

    The root nearest to V in the complex plane is never farther: the k-th coefficient over the value is
    a sum of binom(n, k) products of k reciprocal roots.
    """
    n = len(taylor) - 1
    bounds = [(comb(n, k) * zero / np.abs(taylor[k])) ** (1 / k) for k in range(1, n + 1)]
    return np.fmin.reduce(bounds)
