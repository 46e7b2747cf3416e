"""What stands over points of the plane: the stable intervals there, within the speeds of a box."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.region.events import Box
from bikestab.region.triangulation import Index
from bikestab.speeds import CAPSIZE, NONE, WEAVE, intervals_of


class Ends(NamedTuple):
    """The ends of the stable intervals within the box's speeds at some points, and their structure.

    ``V`` (2, point, interval): lower and upper ends [m/s], 0 behind the last. ``code`` (point,) tells how
    many there are and the kind of each end, weave or capsize, or NONE on a face of the box.
    """

    V: Floats
    code: NDArray[np.int64]


def ends_at(box: Box, points: Floats) -> Ends:
    """The intervals at points (2, point)."""
    found = intervals_of(box.table(points))
    low, high = box.V
    V = np.array([np.maximum(found.V1, low), np.minimum(found.V2, high)])
    inside = V[0] < V[1]  # False for NaN
    clipped = np.array([V[0] > found.V1, V[1] < found.V2])
    kind = np.array([found.lower, found.upper])
    kind = np.where(np.isin(kind, (WEAVE, CAPSIZE)) & ~clipped, kind, NONE)
    order = np.argsort(~inside, axis=1, kind="stable")
    V, kind = (
        np.take_along_axis(np.where(inside, values, 0), order[np.newaxis], axis=2) for values in (V, kind)
    )
    digits = (kind[0].astype(np.int64) * 3 + kind[1]) * 9 ** np.arange(inside.shape[1])
    return Ends(V, digits.sum(axis=1) * 10 + np.count_nonzero(inside, axis=1))


def number_of(code: NDArray[np.int64]) -> NDArray[np.int64]:
    """How many intervals a structure has."""
    return code % 10


def kind_of(code: NDArray[np.int64], interval: int, side: int) -> NDArray[np.int64]:
    """The kind of one end of one interval: side 0 is V1, 1 is V2."""
    digit = code // 10 // 9**interval % 9
    return digit % 3 if side else digit // 3


class Columns:
    """The intervals over points of the plane, for each structure that there is at or beside a point.

    A point off all curves has one structure, one on a curve those of both its sides, each with the ends of
    the intervals at a ``place`` (2, record) so close by that they are those at the point.
    """

    def __init__(self, count: int) -> None:
        """For ``count`` points that have no structure yet."""
        self.codes = np.empty(0, np.int64)  # (structure,)
        self.record = np.empty((count, 0), np.intp)  # (point, structure), −1 where a point has it not
        self.V = np.empty((2, 0, 1))  # (side, record, interval)
        self.place = np.empty((2, 0))

    def has(self) -> NDArray[np.bool_]:
        """Which points have which structures, (point, structure)."""
        return self.record >= 0

    def structure(self, code: NDArray[np.int64]) -> Index:
        """Numbers of structures, which become known by this."""
        new = np.setdiff1d(code, self.codes)
        self.codes = np.append(self.codes, new)
        self.record = np.pad(self.record, ((0, 0), (0, len(new))), constant_values=-1)
        order = np.argsort(self.codes)
        return order[np.searchsorted(self.codes, code, sorter=order)]

    def grow(self, count: int) -> None:
        """Make room for ``count`` further points."""
        self.record = np.pad(self.record, ((0, count), (0, 0)), constant_values=-1)

    def add(self, points: Index, ends: Ends, places: Floats) -> None:
        """Note what was found at places (2, n) for points (n,); what a point has already stays."""
        structure = self.structure(ends.code)
        _, first = np.unique(points * len(self.codes) + structure, return_index=True)
        first = first[self.record[points[first], structure[first]] < 0]
        self.record[points[first], structure[first]] = self.V.shape[1] + np.arange(len(first))
        most = max(self.V.shape[2], ends.V.shape[2])
        known, new = (np.pad(V, ((0, 0), (0, 0), (0, most - V.shape[2]))) for V in (self.V, ends.V[:, first]))
        self.V = np.concatenate([known, new], axis=1)
        self.place = np.concatenate([self.place, places[:, first]], axis=1)

    def alike(
        self, point: int, record: int, structure: int, most: float, *, beside: bool, any_kind: bool
    ) -> Floats:
        """The ends (2, interval) over a point nearest to a record's and of their kinds; NaN where too far.

        They may be ``most`` [m/s] away, or be on the same face of the box. Where there is none and the point
        is ``beside`` that of the record, it is the face that one of both is on and the other near to.
        With ``any_kind`` the nearest of all.
        """
        mine = self.record[point][self.record[point] >= 0]
        codes = self.codes[self.record[point] >= 0]
        V = self.V[:, record].copy()
        numbers = range(self.V.shape[2])
        for side in (0, 1):
            own = np.concatenate([self.V[side, mine[number_of(codes) > j], j] for j in numbers])
            kinds = np.concatenate([kind_of(codes, j, side)[number_of(codes) > j] for j in numbers])
            for k in range(number_of(self.codes[structure])):
                kind = kind_of(self.codes[structure], k, side)
                gap = np.abs(own - V[side, k])
                alike = (kinds == kind) & (gap <= (0.0 if kind == NONE else most))
                alike |= any_kind & (gap <= most)
                on_face = beside & ((kinds == NONE) | (kind == NONE)) & (gap <= most)
                if alike.any():
                    V[side, k] = own[np.argmin(np.where(alike, gap, np.inf))]
                elif not on_face.any():
                    V[side, k] = np.nan
                elif kind != NONE:
                    V[side, k] = own[np.argmin(np.where(on_face, gap, np.inf))]
        return V

    def touching(self, sides: Index, structure: Index, near: float) -> NDArray[np.bool_]:
        """Whether two successive ends of intervals are within ``near`` [m/s] at both ends of sides (n, 2)."""
        records = self.record[sides, structure[:, np.newaxis]]
        ends = self.V[:, records].transpose(1, 2, 3, 0).reshape(len(sides), 2, 2 * self.V.shape[2])
        gaps = np.diff(ends, axis=2)  # ascending, then zeros
        exist = np.arange(1, ends.shape[2]) < 2 * number_of(self.codes[structure])[:, np.newaxis]
        touch = np.logical_and.reduce(gaps < near, axis=1) & exist
        return np.logical_or.reduce(touch, axis=1)
