"""Roots of one direction over a plane (λ, σ) → the sheets that they form, tile by tile."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.scan.links import NO_LINKS, Indices, links_of, pairs, place_of


class Direction:
    """The sheets of one direction, put together from those of the tiles."""

    def __init__(self, most: int) -> None:
        self.linked = most > 1  # else there is nothing to tell apart
        self._count: list[int] = []  # roots of each tile's sheet, and the sum of their places
        self._sum: list[float] = []
        self._first: dict[tuple[int, int], int] = {}  # the number of a tile's first sheet
        self._overlap: list[Indices] = []  # pairs (2, …) of sheets that share a cell,
        self._touch: list[Indices] = []  # of those that share one or have neighbours,
        self._joint: list[Indices] = []  # and of those that continue each other in the next tile
        self._borders: dict[str, tuple[Floats, Indices]] = {}  # last rows of tiles, last column

    def add(self, place: tuple[int, int], V: Floats) -> None:
        """Take in the roots (λ, σ, root) of the tile that begins at ``place``; tiles come row by row."""
        sheet, number = self._local(V)
        first = self._first[place] = len(self._count)
        there = sheet >= 0
        self._count += np.bincount(sheet[there], minlength=number).tolist()
        self._sum += np.bincount(sheet[there], place_of(V[there]), minlength=number).tolist()
        if self.linked:
            sheet = np.where(there, sheet + first, -1)
            self._note_within(sheet)
            self._note_across(place[1], V, sheet)

    def _note_within(self, sheet: Indices) -> None:
        """Which sheets of a tile share a cell, and which have neighbours."""
        shared = pairs(sheet, sheet)
        self._overlap.append(shared)
        self._touch += [shared, pairs(sheet[1:], sheet[:-1]), pairs(sheet[:, 1:], sheet[:, :-1])]

    def _note_across(self, column: int, V: Floats, sheet: Indices) -> None:
        """Which sheets touch or continue those of the tiles above and to the left.

                row      the last cells of the tiles above, kept until the tile below comes
        column  tile     the last cells of the tile before, kept until the next one of its row
        """
        if column == 0:
            self._borders.pop("column", None)  # a new row of tiles: none is before this one
        ours = {f"row {column}": (V[-1:], sheet[-1:]), "column": (V[:, -1:], sheet[:, -1:])}
        for axis, key, edge in ((0, f"row {column}", np.s_[:1]), (1, "column", np.s_[:, :1])):
            if key in self._borders:
                strips = zip(self._borders[key], (V[edge], sheet[edge]), strict=True)
                strip_V, strip = (_side_by_side(pair, axis) for pair in strips)
                self._touch.append(pairs(*np.split(strip, 2, axis=axis)))
                self._joint.append(strip[np.isfinite(strip_V)][links_of(strip_V, axis)])
        self._borders |= ours

    def finish(self) -> list[float]:
        """Join what continues each other and give each sheet a slot; the mean place of each slot."""
        number = len(self._count)
        self._slot = np.zeros(number, np.intp)
        if self.linked:
            sheet = self._merged(number)
            self._slot = first_free(sheet, np.array(self._count), sheet[np.concatenate(self._touch, axis=1)])
        count = np.bincount(self._slot, self._count)
        return (np.bincount(self._slot, self._sum)[count > 0] / count[count > 0]).tolist()

    def _merged(self, number: int) -> Indices:
        """Which sheets of tiles are one: all that continue each other, unless they then share a cell."""
        sheet = list(range(number))
        apart: list[set[int]] = [set() for _ in sheet]
        for a, b in np.concatenate(self._overlap, axis=1).T.tolist():
            if a != b:
                apart[a].add(b)
                apart[b].add(a)

        def root(a: int) -> int:
            while sheet[a] != a:
                sheet[a] = a = sheet[sheet[a]]
            return a

        joint = np.concatenate([NO_LINKS, *self._joint], axis=1)
        links, times = np.unique(joint, axis=1, return_counts=True)
        for k in np.argsort(-times, kind="stable"):
            a, b = sorted(root(end) for end in links[:, k].tolist())
            if a != b and not any(root(other) == b for other in apart[a]):
                sheet[b] = a
                apart[a] |= apart[b]
        return np.array([root(a) for a in range(number)], np.intp)

    def slots(self, place: tuple[int, int], V: Floats) -> Indices:
        """The slot of each root of a tile, −1 for NaN."""
        sheet = self._local(V)[0]
        known = np.append(self._slot[self._first[place] :], -1)
        return known[np.where(sheet >= 0, sheet, len(known) - 1)]

    def _local(self, V: Floats) -> tuple[Indices, int]:
        """The sheet within the tile of each root, V (λ, σ, root) ascending, −1 for NaN; and their number."""
        there = np.isfinite(V)
        sheet = np.where(there, 0, -1)
        if self.linked:
            cell = np.repeat(np.arange(V.shape[0] * V.shape[1]), np.count_nonzero(there, axis=-1).ravel())
            links = np.concatenate([links_of(V, axis) for axis in (0, 1)], axis=1)
            sheet[there] = _single_valued(links, cell)
        return sheet, int(sheet.max(initial=-1)) + 1


def _side_by_side(pair: tuple[NDArray, NDArray], axis: int) -> NDArray:
    """Two strips of roots beside each other, the shorter last axis filled up."""
    most = max(strip.shape[-1] for strip in pair)
    empty = np.nan if pair[0].dtype == float else -1
    return np.concatenate([widened(strip, most, empty) for strip in pair], axis=axis)


def _single_valued(links: Indices, cell: Indices) -> Indices:
    """The sheet of each root, none with two roots in one cell.

    What the links connect may lie over itself, as around a cusp, where one can walk from the upper root
    to the lower without crossing a fold. The cut goes through the part that does not: each root there is
    given to the layer with the fewest steps to it. So a sheet may go on in another slot at the same
    speed, but it does not jump. Only layers that lie over themselves in turn do: they are cut by the
    order of their roots.

        ──────╮ upper layer
               )·····  lies nowhere over itself: cut where both layers are equally many steps away
        ──────╯ lower layer
    """
    sheet = connected(links, len(cell))
    _, over_itself = rank_of(sheet, cell)
    if not over_itself.any():
        return sheet
    layer = _layers(links[:, over_itself[links].all(axis=0)], cell)
    layer = _spread(layer, over_itself, links)
    return connected(links[:, layer[links[0]] == layer[links[1]]], len(cell))


def _layers(links: Indices, cell: Indices) -> Indices:
    """The layer of each root that the links reach, none with two roots in one cell."""
    rank, still = rank_of(connected(links, len(cell)), cell)
    rank[~still] = 0
    return connected(links[:, rank[links[0]] == rank[links[1]]], len(cell))


def _spread(layer: Indices, known: NDArray[np.bool_], links: Indices) -> Indices:
    """The layer of the known root with the fewest steps to each; −1 where none can be reached."""
    from scipy.sparse.csgraph import dijkstra

    source = dijkstra(
        _graph(links, len(layer)), directed=False, indices=np.flatnonzero(known), unweighted=True,
        return_predecessors=True, min_only=True,
    )[2]  # fmt: skip
    return np.where(source >= 0, layer[np.maximum(source, 0)], -1)


def rank_of(sheet: Indices, cell: Indices) -> tuple[Indices, NDArray[np.bool_]]:
    """Which root of its sheet in its cell each is, from 0, and whether there are several."""
    order = np.lexsort((sheet, cell))
    new = np.diff(sheet[order], prepend=-1).astype(bool) | np.diff(cell[order], prepend=-1).astype(bool)
    start = np.flatnonzero(new)
    count = np.diff(start, append=len(cell))
    rank, several = np.empty(len(cell), np.intp), np.empty(len(cell), bool)
    rank[order] = np.arange(len(cell)) - np.repeat(start, count)
    several[order] = np.repeat(count > 1, count)
    return rank, several


def first_free(sheet: Indices, count: Indices, touch: Indices) -> Indices:
    """The slot of each tile's sheet: whole sheets, largest first, go into the lowest slot that is free.

    No other that they touch may be in it: neighbours in one slot are then of one sheet.
    """
    size = np.bincount(sheet, count, minlength=len(sheet))
    near: dict[int, set[int]] = {}
    for a, b in touch.T.tolist():
        near.setdefault(a, set()).add(b)
        near.setdefault(b, set()).add(a)
    slot: dict[int, int] = {}
    for k in sorted(set(sheet.tolist()), key=lambda k: (-size[k], k)):
        taken = {slot[other] for other in near.get(k, set()) - {k} if other in slot}
        slot[k] = next(i for i in range(len(taken) + 1) if i not in taken)
    return np.array([slot[k] for k in sheet.tolist()], np.intp)


def connected(links: Indices, number: int) -> Indices:
    from scipy.sparse.csgraph import connected_components  # only damping needs it

    return connected_components(_graph(links, number), directed=False)[1]


def _graph(links: Indices, number: int) -> Any:
    from scipy.sparse import coo_array

    return coo_array((np.ones(links.shape[1], np.int8), tuple(links)), shape=(number, number))


def widened(values: NDArray, most: int, empty: float) -> NDArray:
    """The array with its last axis filled up to the length ``most``."""
    missing = most - values.shape[-1]
    return np.concatenate([values, np.full((*values.shape[:-1], missing), empty, values.dtype)], axis=-1)
