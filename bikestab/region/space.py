"""The skeleton's curves at speeds V > 0 in space (x, y, V), where they are smooth: two conditions of each.

In the plane a fold has a cusp where three weave speeds meet, and a curve on which weave meets capsize runs
into a design with an eigenvalue 0 at every speed; in space both are as smooth as elsewhere. The third
coordinate is w = V/(V + V0), and the conditions are homogeneous in V and V0, so that V = 0 and infinity are
places like others.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats, in_powers
from bikestab.polynomials import value
from bikestab.region.events import Box
from bikestab.region.skeleton import CurveName, in_units, speed_polynomials

# the two conditions of each: which of h = hurwitz3, p0, q = p2 p3 − p4 p1, p1, p3, and which derivative of it
CONDITIONS: dict[CurveName, tuple[tuple[int, int], tuple[int, int]]] = {
    "fold": ((0, 0), (0, 1)), "crossing": ((3, 0), (4, 0)), "capsize fold": ((1, 0), (1, 1)),
    "meet": ((1, 0), (2, 0)), "slow meet": ((1, 0), (3, 0)),
}  # fmt: skip
SPATIAL = tuple(CONDITIONS)
Index = NDArray[np.intp]
_WHICH, _ORDER = np.array(list(CONDITIONS.values())).transpose(2, 1, 0)  # (condition, curve)
_STEP = 1e-6  # of the box, for differences
_ASIDE = np.array([[0, 1, -1, 0, 0], [0, 0, 0, 1, -1]])[..., np.newaxis] * _STEP
_FARTHEST = 0.02  # of the box, in a step of Newton's method
_CROSSED = 3e-3  # of their terms: so small p1 and p3 are zero where a fold is looked for by differences
_SAMPLES = 9  # of the box, per axis, to see which powers of V there are


class Space:
    """A box with coordinates (u, v, w) from 0 to 1; ``V0`` [m/s] is the speed at w = 1/2.

    Curves are numbered as in SPATIAL.
    """

    def __init__(self, box: Box, V0: float) -> None:
        self.box, self.V0 = box, V0

    def speed(self, w: Floats) -> Floats:
        """V [m/s] at values of w."""
        with np.errstate(divide="ignore"):
            return np.where(w < 1, self.V0 * w / (1 - w), np.inf)

    def place(self, V: Floats) -> Floats:
        """The coordinate w of speeds."""
        return V / (V + self.V0)

    def crossed(self, points: Floats) -> NDArray[np.bool_]:
        """Where, at points (3, n), p1 = p3 = 0 as far as differences tell: hurwitz3 has no slope there."""
        polynomials, power = speed_polynomials(self.box.table(points[:2]))
        V = self.speed(points[2]) ** power
        V = np.where(np.isfinite(V), V, np.nan)  # of which no fold is
        parts = [value(p, V) / value(np.abs(p), V) for p in (polynomials["p1"], polynomials["p3"])]
        return np.asarray(np.abs(parts).max(axis=0) < _CROSSED)

    def onto(
        self,
        curve: Index,
        points: Floats,
        across: Floats | None,
        rounds: int,
        *,
        exact: bool = False,
    ) -> tuple[Floats, Floats, Floats]:
        """Points (3, n) moved onto their curves (n,) by Newton's method.

        They move in the planes across the directions ``across`` (3, n); without, the shortest way. Returns
        them, their curves' directions there, and how far the last step was. ``exact`` takes tables that are
        right to rounding.
        """
        way, tangent, far = across, np.zeros_like(points), np.zeros(points.shape[1])
        with np.errstate(all="ignore"):
            for _ in range(rounds):
                (f, g), (a, b) = self._conditions(curve, points, exact=exact)
                tangent = _cross(a, b)
                way = tangent if across is None else across
                move = f * _cross(b, way) + g * _cross(way, a)
                move = -move / (way * tangent).sum(axis=0)
                far = np.abs(move).max(axis=0)
                points = points + np.where(far > 0, move * np.minimum(1, _FARTHEST / far), 0.0)
            return points, tangent / np.sqrt((tangent**2).sum(axis=0)), far

    def _conditions(self, curve: Index, points: Floats, *, exact: bool) -> tuple[Floats, Floats]:
        """The two conditions (2, n) at points (3, n), and their gradients (2, 3, n)."""
        places = (points[:2, np.newaxis] + _ASIDE).reshape(2, -1)
        table = self.box.family.quick_table(*self.box.real(places))
        table = table.reshape(*table.shape[:2], 5, points.shape[1])
        if exact:
            table[:, :, 0] = self.box.table(points[:2])
        jets = self._jets(table, points[2])
        each = np.arange(len(curve))
        values = jets[_WHICH[:, curve], _ORDER[:, curve], :, each]  # (2, n, 5)
        by_w = jets[_WHICH[:, curve], _ORDER[:, curve] + 1, 0, each]
        by_u, by_v = ((values[..., i] - values[..., i + 1]) / (2 * _STEP) for i in (1, 3))
        return values[..., 0], np.array([by_u, by_v, by_w]).swapaxes(0, 1)

    def _jets(self, table: Floats, w: Floats) -> Floats:
        """Those five with two derivatives by w: (5, 3, 5, n), at tables (5, power, 5, n)."""
        table = in_powers(in_units(table, self.box.units))
        p0, p1, p2, p3, p4 = np.einsum("dkjn,kjan->kdan", self._basis(w), table)
        d0, d1, d2, d3, d4 = self._degrees.tolist()
        q = _difference(w, (d2 + d3, _product(p2, p3)), (d4 + d1, _product(p4, p1)))
        first = d1 + max(d2 + d3, d4 + d1), _product(p1, q)
        h = _difference(w, first, (d0 + 2 * d3, _product(p0, _product(p3, p3))))
        return np.array([h, p0, q, p1, p3])

    def _basis(self, w: Floats) -> Floats:
        """V0^j w^j (1 − w)^(d − j) for each degree d with two derivatives by w: (3, degree, j, n)."""
        factors, i, m = self._factors
        powers = np.arange(factors.shape[-1] + 1)[:, np.newaxis]
        terms = factors[..., np.newaxis] * (w**powers)[i] * ((1 - w) ** powers)[m]
        return np.array([terms[0], terms[1] + terms[2], terms[3] + terms[4] + terms[5]])

    @cached_property
    def _factors(self) -> tuple[Floats, NDArray[np.intp], NDArray[np.intp]]:
        """Factors, powers of w and powers of 1 − w of the terms of these, (6, degree, j) each."""
        j = np.arange(self._columns)
        k = self._degrees[:, np.newaxis] - j
        V0 = float(np.ldexp(self.V0, -int(self.box.units[1])))
        whole = np.where(k < 0, 0.0, V0**j)
        rows = []
        for a, b, sign in ((0, 0, 1), (1, 0, 1), (0, 1, -1), (2, 0, 1), (1, 1, -2), (0, 2, 1)):
            taken = [j - n for n in range(a)] + [k - n for n in range(b)]
            factor = sign * whole
            for each in taken:
                factor = factor * each
            rows.append((factor, np.broadcast_to(np.maximum(j - a, 0), k.shape), np.maximum(k - b, 0)))
        factors, i, m = (np.array(each) for each in zip(*rows, strict=True))
        return factors, i, m

    @cached_property
    def _columns(self) -> int:
        return self.box.table(np.zeros((2, 1))).shape[1]

    @cached_property
    def _degrees(self) -> NDArray[np.intp]:
        """The highest powers of V that p0 … p4 have anywhere in the box."""
        nodes = np.linspace(0, 1, _SAMPLES)
        table = in_powers(self.box.table(np.array(np.meshgrid(nodes, nodes))))
        return np.array([np.flatnonzero(row.any(axis=(1, 2))).max(initial=0) for row in table])


def _cross(a: Floats, b: Floats) -> Floats:
    """The vector product of (3, n) and (3, n), which numpy's own takes ten times as long for."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _product(a: Floats, b: Floats) -> Floats:
    """Of two functions with two derivatives."""
    return np.array([a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2 * a[1] * b[1] + a[0] * b[2]])


def _difference(w: Floats, one: tuple[int, Floats], other: tuple[int, Floats]) -> Floats:
    """Of two functions that are homogeneous of some degree, in the higher one of these."""
    highest = max(one[0], other[0])
    a, b = (_raised(w, highest - degree, jet) for degree, jet in (one, other))
    return a - b


def _raised(w: Floats, by: int, jet: Floats) -> Floats:
    """Times a power of 1 − w."""
    if not by:
        return jet
    rest = 1 - w
    power = [rest**by, -by * rest ** (by - 1), by * (by - 1) * rest ** max(by - 2, 0)]
    return _product(np.array(power)[:, np.newaxis], jet)
