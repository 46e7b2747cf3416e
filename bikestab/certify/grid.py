"""The box of a proof: its axes cut into cells, and where these lie on its sides, rounded outwards."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from bikestab.certify.bernstein import SPEED, Floats
from bikestab.sines import sine_cosine

_OUTWARD = 2.0**-50  # more than the four roundings of a place on a side


class Side(NamedTuple):
    """One side of the box: its ends, and what the cells along it reach from and to, from 0 to 1."""

    ends: tuple[Fraction, Fraction]
    low: Floats
    high: Floats


class Grid(NamedTuple):
    """A box cut into cells by ``edges`` in λ [rad], σ, V [m/s] and what varies.

    ``sides`` are those in t = tan(λ/2), σ, V and what varies; ``squared`` is that in V².
    """

    edges: tuple[Floats, ...]
    sides: tuple[Side, ...]
    squared: Side

    @property
    def cells(self) -> tuple[int, ...]:
        """How many cells there are along each axis."""
        return tuple(len(edges) - 1 for edges in self.edges)

    def places(self, squared: bool) -> list[Side]:
        """The sides of a polynomial in V or in V²."""
        return [self.squared if squared and i == SPEED else side for i, side in enumerate(self.sides)]


def grid_of(edges: Sequence[Floats]) -> Grid:
    """Cells between edges, each axis ascending; of an axis with one value both edges are that value."""
    lam, sigma, V, *others = (np.asarray(each, dtype=float) for each in edges)
    V2 = V * V
    sides = [_side(*_half_angles(lam)), *(_side(each, each) for each in (sigma, V, *others))]
    return Grid((lam, sigma, V, *others), tuple(sides), _side(V2 * (1 - 2.0**-52), V2 * (1 + 2.0**-52)))


def _half_angles(lam: Floats) -> tuple[Floats, Floats]:
    """Doubles below and above tan(λ/2) = sin λ/(1 + cos λ), which is known to twice their precision."""
    sin, cos = sine_cosine(lam)
    t = (sin / (cos + 1.0)).value
    aside = np.where(lam == 0, 0.0, np.spacing(np.abs(t)))
    return t - aside, t + aside


def _side(low: Floats, high: Floats) -> Side:
    """The side between the lowest and the highest of edges that are somewhere from ``low`` to ``high``."""
    width = high[-1] - low[0]
    if width == 0:
        places = np.zeros(len(low) - 1), np.ones(len(low) - 1)
    else:
        places = (
            np.clip((low[:-1] - low[0]) / width * (1 - _OUTWARD), 0, 1),
            np.clip((high[1:] - low[0]) / width * (1 + _OUTWARD), 0, 1),
        )
    return Side((Fraction(low[0]), Fraction(high[-1])), *places)
