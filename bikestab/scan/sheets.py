"""Exact critical speeds over a plane (λ, σ) → sheets: the surfaces of (2.2) as functions V(λ, σ).

A simple root moves continuously with (λ, σ), keeps its direction (with V the condition rises through
zero there, or falls) and meets only roots of the other direction: both end there, at a fold. So each
sheet has one direction, and one with at most one root per cell is a sheet as it stands. Damping gives
hurwitz3 several of a direction, which are linked from cell to cell.

A plane may come in tiles: a sheet is put together from the tiles' own, so that no more than two rows
of tiles are ever needed at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.critical import critical
from bikestab.model import Floats
from bikestab.routh import CONDITIONS
from bikestab.scan.linking import Direction
from bikestab.speeds import CAPSIZE, WEAVE, Intervals

EDGES = {"p0": CAPSIZE, "hurwitz3": WEAVE}  # the kind of end where a condition can be an edge of stability


class Roots(NamedTuple):
    """Every positive root of one condition over a plane, as it comes: ascending in each cell.

    ``V`` [m/s] has shape (λ, σ, root), NaN behind the last; ``rising``, shape (λ, σ, 1), tells whether the
    condition is negative below its first root. From root to root the direction alternates.
    """

    V: Floats
    rising: NDArray[np.bool_]


class Sheets(NamedTuple):
    """The same roots, a sheet in each slot: ``V`` [m/s], shape (λ, σ, slot), NaN where it has no root.

    ``edge`` is 1 where the root is an end of a stable interval.
    """

    V: Floats
    edge: NDArray[np.uint8]


def critical_roots(table: Floats) -> dict[str, Roots]:
    """The roots of each condition of a table (5, 4, λ, σ)."""
    speeds, sign, _ = critical(table)
    return {
        name: Roots(np.moveaxis(speeds[name], 0, -1), sign[name][..., np.newaxis] < 0) for name in CONDITIONS
    }


def sheets(name: str, roots: Roots, intervals: Intervals) -> Sheets:
    """Arrange a condition's roots into sheets and tell which are ends of ``intervals`` (λ, σ, interval).

    Roots of neighbouring cells share a slot if they are of one sheet, and only then. Slots are in the
    order of their mean speeds, as the mean of V/(V + SPEED); a slot's roots all have one direction.
    """
    atlas = Atlas(name, most_roots(roots))
    atlas.add((0, 0), roots)
    atlas.finish()
    return atlas.sheets((0, 0), roots, intervals)


def most_roots(roots: Roots) -> tuple[int, int]:
    """How many roots a cell has at most at which the condition rises, and at which it falls."""
    rising, falling = (int(np.count_nonzero(V > 0, axis=-1).max(initial=0)) for V in directed(roots))
    return rising, falling


class Atlas:
    """The sheets of a condition over a plane that comes in tiles.

    ``most`` is ``most_roots`` of the whole plane. Every tile is given to ``add``, row by row; after
    ``finish`` each can be had back from ``sheets``, and ``width`` is the number of slots.
    """

    def __init__(self, name: str, most: tuple[int, int]) -> None:
        self.name, self.width = name, 0
        self._directions = tuple(Direction(n) for n in most)  # in which the condition rises, and falls

    def add(self, place: tuple[int, int], roots: Roots) -> None:
        """Take in the tile that begins at ``place``, an index of λ and one of σ."""
        for direction, V in zip(self._directions, directed(roots), strict=True):
            direction.add(place, _plane(V))

    def finish(self) -> None:
        """Give each sheet its slot."""
        order = []  # of two slots with equal means the rising one is first
        for k, direction in enumerate(self._directions):
            order += [(mean, k, slot) for slot, mean in enumerate(direction.finish())]
        self._order = [(k, slot) for _, k, slot in sorted(order)]
        self.width = len(order)

    def sheets(self, place: tuple[int, int], roots: Roots, intervals: Intervals) -> Sheets:
        """The sheets of a tile, and which of their roots are ends of its ``intervals``."""
        shape = (*roots.V.shape[:-1], self.width)
        out = Sheets(np.full(shape, np.nan), np.zeros(shape, np.uint8))
        ends = (intervals.V1, intervals.lower), (intervals.V2, intervals.upper)  # stability begins rising
        for k, V in enumerate(directed(roots)):
            edge = is_end(V, ends[k][0], ends[k][1] == EDGES.get(self.name))
            direction = self._directions[k]
            slots = [(i, number) for i, (of, number) in enumerate(self._order) if of == k]
            if not direction.linked:  # one root at most
                for i, _ in slots if V.shape[-1] else ():
                    out.V[..., i], out.edge[..., i] = V[..., 0], edge[..., 0]
                continue
            slot = direction.slots(place, _plane(V)).reshape(V.shape)
            for i, number in slots:
                at = slot == number
                cell = at.any(axis=-1)
                out.V[cell, i], out.edge[cell, i] = V[at], edge[at]
        return out


def _plane(values: Floats) -> Floats:
    """Without the axes of a sweep, of which a plane has one value."""
    return values.reshape(values.shape[-3:])


def directed(roots: Roots) -> tuple[Floats, Floats]:
    """The roots at which the condition rises, and those at which it falls, NaN behind the last."""
    return _every_other(roots.V, roots.rising), _every_other(roots.V, ~roots.rising)


def _every_other(V: Floats, first: NDArray[np.bool_]) -> Floats:
    """The first, third … of the last axis where ``first``, else the second, fourth … otherwise."""
    odd = np.full(V[..., 0::2].shape, np.nan)
    odd[..., : V.shape[-1] // 2] = V[..., 1::2]
    return np.where(first, V[..., 0::2], odd)


def is_end(V: Floats, ends: Floats, kind: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which roots are the ends (…, interval) of that kind: the nearest, however the ends are rounded."""
    end = np.zeros(V.shape, bool)
    for k in np.flatnonzero(kind.reshape(-1, kind.shape[-1]).any(axis=0)):
        far = np.abs(V - ends[..., k, np.newaxis])
        nearest = np.argmin(np.where(np.isnan(far), np.inf, far), axis=-1, keepdims=True)
        end |= (np.arange(V.shape[-1]) == nearest) & kind[..., k, np.newaxis]
    return end
