"""How far two ways to the same zeros of a condition may be from each other, and how far they are."""

from __future__ import annotations

from math import comb
from typing import NamedTuple

import numpy as np

from bikestab.model import Floats
from bikestab.polynomials import taylor
from bikestab.rounding import CONDITION, NO_SIGN
from bikestab.routh import condition_polynomials, conditions

AGREEMENT = 1e-10  # m/s, between the exact speeds and any other way


class Agreement(NamedTuple):
    """How far the conditions' own zeros are from the exact speeds.

    ``largest`` [m/s] is over the roots that double precision fixes to AGREEMENT, and inf where one has no
    zero near it or the signs on the grid are others; of the ``loose`` others, close to a fold,
    ``largest_loose`` is the same. ``touching`` counts places that are neither: the condition is zero
    there to rounding, and which sign it has, if it changes it at all, cannot be told.
    """

    roots: int = 0
    largest: float = 0.0
    loose: int = 0
    largest_loose: float = 0.0
    touching: int = 0

    def combined(self, other: Agreement) -> Agreement:
        """Of both."""
        return Agreement(
            self.roots + other.roots,
            max(self.largest, other.largest),
            self.loose + other.loose,
            max(self.largest_loose, other.largest_loose),
            self.touching + other.touching,
        )


def by_rounding(table: Floats, name: str, V: Floats) -> tuple[Floats, Floats]:
    """How far [m/s] rounding moves simple roots of a condition at V, and any roots at most; of cells.

    The first is the rounding of the condition's terms divided by its slope.
    """
    size, series = size_of_terms(table, name, V), taylor(condition_polynomials(table)[name], V)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return CONDITION * size / np.abs(series[1]), _reach(series, NO_SIGN * size)


def size_of_terms(table: Floats, name: str, V: Floats) -> Floats:
    """The sum of the sizes of a condition's terms."""
    a = conditions(np.abs(table), V)
    return getattr(a, name) if name != "hurwitz3" else a.p1 * (a.p2 * a.p3 + a.p4 * a.p1) + a.p0 * a.p3**2


def _reach(series: Floats, zero: Floats) -> Floats:
    """How far from V a root may be of a polynomial whose value there is up to ``zero``.

    The root nearest to V in the complex plane is never farther: the k-th coefficient over the value is
    a sum of binom(n, k) products of k reciprocal roots.
    """
    n = len(series) - 1
    bounds = [(comb(n, k) * zero / np.abs(series[k])) ** (1 / k) for k in range(1, n + 1)]
    return np.fmin.reduce(bounds)
