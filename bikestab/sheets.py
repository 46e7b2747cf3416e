"""Exact critical speeds over a plane (λ, σ) → sheets: the surfaces of (2.2) as functions V(λ, σ).

A simple root moves continuously with (λ, σ), keeps its direction (with V the condition rises through
zero there, or falls) and meets only roots of the other direction: both end there, at a fold. So each
sheet has one direction, and one with at most one root per cell is a sheet as it stands. Damping gives
hurwitz3 several of a direction, which are linked from cell to cell.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, dijkstra

from bikestab.model import Floats
from bikestab.roots import sign_near_zero
from bikestab.routh import CONDITIONS, condition_polynomials
from bikestab.speeds import CAPSIZE, WEAVE, Intervals, critical_speeds

Indices = NDArray[np.intp]

EDGES = {"p0": CAPSIZE, "hurwitz3": WEAVE}  # the kind of end where a condition can be an edge of stability
SPEED = 5.0  # m/s; roots are near each other in V/(V + SPEED), in which V → ∞ is a place like any other


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
    speeds, polynomials = critical_speeds(table), condition_polynomials(table)
    return {
        name: Roots(np.moveaxis(speeds[name], 0, -1), sign_near_zero(polynomials[name])[..., np.newaxis] < 0)
        for name in CONDITIONS
    }


def sheets(name: str, roots: Roots, intervals: Intervals) -> Sheets:
    """Arrange a condition's roots into sheets and tell which are ends of ``intervals`` (λ, σ, interval).

    Roots of neighbouring cells share a slot if they are of one sheet, and only then. Slots are in the
    order of their median speeds; a slot's roots all have one direction.
    """
    shape = roots.V.shape[:2]
    parts: list[tuple[float, Floats, NDArray[np.bool_]]] = []  # per slot: its median, and a plane of each
    for rising, ends, kinds in (
        (roots.rising, intervals.V1, intervals.lower),  # stability begins where the condition rises
        (~roots.rising, intervals.V2, intervals.upper),
    ):
        V = _every_other(roots.V, rising)
        edge = _is_end(V, ends, kinds == EDGES.get(name))
        slot = _slots(V)
        for k in range(int(slot.max(initial=-1)) + 1):
            plane = np.full(shape, np.nan), np.zeros(shape, bool)
            at = slot == k
            cell = at.any(axis=-1)
            plane[0][cell], plane[1][cell] = V[at], edge[at]
            parts.append((float(np.median(V[at])), *plane))
    parts.sort(key=lambda part: part[0])  # stable: of two equal medians the rising one is first
    out = Sheets(np.empty((*shape, len(parts))), np.empty((*shape, len(parts)), np.uint8))
    for k, (_, plane_V, plane_edge) in enumerate(parts):
        out.V[..., k], out.edge[..., k] = plane_V, plane_edge
    return out


def _every_other(V: Floats, first: NDArray[np.bool_]) -> Floats:
    """The first, third … of the last axis where ``first``, else the second, fourth … otherwise."""
    odd = np.full(V[..., 0::2].shape, np.nan)
    odd[..., : V.shape[-1] // 2] = V[..., 1::2]
    return np.where(first, V[..., 0::2], odd)


def _is_end(V: Floats, ends: Floats, kind: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which roots are the ends (λ, σ, interval) of that kind: the nearest, however the ends are rounded."""
    end = np.zeros(V.shape, bool)
    for k in np.flatnonzero(kind.any(axis=(0, 1))):
        far = np.abs(V - ends[..., k, np.newaxis])
        nearest = np.argmin(np.where(np.isnan(far), np.inf, far), axis=-1, keepdims=True)
        end |= (np.arange(V.shape[-1]) == nearest) & kind[..., k, np.newaxis]
    return end


def _slots(V: Floats) -> Indices:
    """The slot of each root of one direction, V (λ, σ, root) ascending; −1 for NaN."""
    there = np.isfinite(V)
    slot = np.where(there, 0, -1)
    if np.count_nonzero(there, axis=-1).max(initial=0) > 1:  # else there is nothing to tell apart
        cell = np.repeat(np.arange(V.shape[0] * V.shape[1]), np.count_nonzero(there, axis=-1).ravel())
        sheet = _single_valued(_links(V), cell)
        slot[there] = _first_free(sheet, cell, V.shape[:2])
    return slot


def _links(V: Floats) -> Indices:
    """Pairs (2, link) of roots, numbered as in V[isfinite(V)], that continue each other in the next cell.

    Each is the other's nearest, so a pair born at a fold between two cells takes no root's partner away.
    """
    x, there = V / (V + SPEED), np.isfinite(V)
    number = np.cumsum(there.ravel()).reshape(V.shape) - 1
    links = []
    for a, b in ((np.s_[:-1], np.s_[1:]), (np.s_[:, :-1], np.s_[:, 1:])):
        far = np.abs(x[a][..., :, np.newaxis] - x[b][..., np.newaxis, :])
        far[np.isnan(far)] = np.inf
        ahead, back = far.argmin(axis=-1), far.argmin(axis=-2)
        mutual = np.take_along_axis(back, ahead, axis=-1) == np.arange(V.shape[-1])
        mutual &= there[a] & np.take_along_axis(there[b], ahead, axis=-1)
        links.append([number[a][mutual], np.take_along_axis(number[b], ahead, axis=-1)[mutual]])
    return np.concatenate(links, axis=1)


def _single_valued(links: Indices, cell: Indices) -> Indices:
    """The sheet of each root, none with two roots in one cell.

    What the links connect may lie over itself, as around a cusp, where one can walk from the upper root
    to the lower without crossing a fold. The cut goes through the part that does not: each root there is
    given to the layer with the fewest steps to it. So a sheet may go on in another slot at the same
    speed, but it does not jump. Only layers that lie over themselves in turn do: they are cut by the
    order of their roots.
    """
    sheet = _connected(links, len(cell))
    _, over_itself = _rank(sheet, cell)
    if not over_itself.any():
        return sheet
    inner = links[:, over_itself[links].all(axis=0)]
    rank, still = _rank(_connected(inner, len(cell)), cell)
    rank[~still] = 0
    layer = _connected(inner[:, rank[inner[0]] == rank[inner[1]]], len(cell))
    source = dijkstra(
        _graph(links, len(cell)), directed=False, indices=np.flatnonzero(over_itself), unweighted=True,
        return_predecessors=True, min_only=True,
    )[2]  # fmt: skip
    layer = np.where(
        source >= 0, layer[np.maximum(source, 0)], -1
    )  # −1: a sheet that lies nowhere over itself
    return _connected(links[:, layer[links[0]] == layer[links[1]]], len(cell))


def _rank(sheet: Indices, cell: Indices) -> tuple[Indices, NDArray[np.bool_]]:
    """Which root of its sheet in its cell each is, from 0, and whether there are several."""
    order = np.lexsort((sheet, cell))
    new = np.diff(sheet[order], prepend=-1).astype(bool) | np.diff(cell[order], prepend=-1).astype(bool)
    start = np.flatnonzero(new)
    count = np.diff(start, append=len(cell))
    rank, several = np.empty(len(cell), np.intp), np.empty(len(cell), bool)
    rank[order] = np.arange(len(cell)) - np.repeat(start, count)
    several[order] = np.repeat(count > 1, count)
    return rank, several


def _first_free(sheet: Indices, cell: Indices, shape: tuple[int, ...]) -> Indices:
    """The slot of each root: sheets, largest first, go into the lowest slot that is free.

    It must be free in the neighbouring cells, too: neighbours in one slot are then of one sheet.
    """
    _, first, count = np.unique(sheet, return_index=True, return_counts=True)
    members = np.split(np.argsort(sheet, kind="stable"), np.cumsum(count)[:-1])
    slot = np.empty(len(sheet), np.intp)
    taken: list[NDArray[np.bool_]] = []  # per slot: its cells and their neighbours, in a plane with a margin
    for k in np.lexsort((first, -count)):
        i, j = (index + 1 for index in np.unravel_index(cell[members[k]], shape))
        free = (s for s, plane in enumerate(taken) if not plane[i, j].any())
        slot[members[k]] = s = next(free, len(taken))
        if s == len(taken):
            taken.append(np.zeros((shape[0] + 2, shape[1] + 2), bool))
        for di, dj in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)):
            taken[s][i + di, j + dj] = True
    return slot


def _connected(links: Indices, number: int) -> Indices:
    return connected_components(_graph(links, number), directed=False)[1]


def _graph(links: Indices, number: int) -> coo_array:
    return coo_array((np.ones(links.shape[1], np.int8), tuple(links)), shape=(number, number))
