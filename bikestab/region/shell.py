"""The boundary of the solid that stands on a partition of the plane: sheets above and below, walls beside.

Over each triangle the solid is one prism for each stable interval, whose ends are those over the corners. The
boundary of a solid has no edge: where neighbours have other structures, their sides in part cover each other
and the rest is a wall.

    V            _______
    |    A _____/ B    |       over a side p-q between triangles of structures A (before it) and B (behind):
    |     |=====|______|       only what one of both has (=) is a wall; on a curve where an interval closes,
    |     |  p  |  q           its ends are one, and there is none
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.region.columns import kind_of, number_of
from bikestab.region.events import Box
from bikestab.region.heights import ON, Heights, distance
from bikestab.region.neighbours import connected
from bikestab.region.patches import Partition
from bikestab.region.triangulation import Index, sides_of
from bikestab.speeds import CAPSIZE, NONE, WEAVE

LOWER, UPPER, WALL = range(3)
_TURNS = 8  # other pairs that are tried


class Faces(NamedTuple):
    """Triangles (face, 3) of heights, anticlockwise seen from outside, with ``kind`` and ``side`` (face,)."""

    corners: Index
    kind: NDArray[np.int64]
    side: NDArray[np.int64]

    def chosen(self, which: Index | NDArray[np.bool_]) -> Faces:
        return Faces(*(values[which] for values in self))


def shell(box: Box, plane: Partition, high: Heights) -> Faces:
    """The boundary of the solid, open only where it goes on beyond the box."""
    parts = [*_sheets(box, plane, high), *_walls(box, plane, high)]
    return _without_pairs(Faces(*(np.concatenate(values) for values in zip(*parts, strict=True))))


def _sheets(box: Box, plane: Partition, high: Heights) -> list[Faces]:
    """The ends of the prisms, but for those in a face of the box."""
    columns = plane.columns
    code = columns.codes[plane.structure]
    parts = []
    for k in range(columns.V.shape[2]):
        for side in (LOWER, UPPER):
            kind = kind_of(code, k, side)
            row = np.flatnonzero(number_of(code) > k)
            ids = high.at[side, columns.record[plane.triangles[row], plane.structure[row, np.newaxis]], k]
            sheet = (kind[row] != NONE) | (high.V[ids] != box.V[side]).any(axis=1)
            row, ids = row[sheet], ids[sheet]
            parts.append(Faces(ids if side else ids[:, ::-1], kind[row], np.full(len(row), side)))
    return parts


class _Strips(NamedTuple):
    """Quads that stand on sides p-q of the plane: heights at both ends, below and above.

    ``outwards`` is 1 where the solid is on the left of the way from p to q, else −1.
    """

    p: Index  # (2, strip): below, above
    q: Index
    outwards: Index


def _walls(box: Box, plane: Partition, high: Heights) -> list[Faces]:
    strips = _strips(plane, high)
    size = (np.abs(strips.p[1] - strips.p[0]) + np.abs(strips.q[1] - strips.q[0])) > 0
    strips = _Strips(*(values[..., size] for values in strips))
    parts = []
    for chain, apex, at_q in ((strips.p, strips.q[0], False), (strips.q, strips.p[1], True)):
        steps = chain[1] - chain[0]
        strip = np.repeat(np.arange(len(steps)), np.abs(steps))
        way = np.sign(steps)[strip]
        first = np.cumsum(np.abs(steps)) - np.abs(steps)
        a = chain[0][strip] + way * (np.arange(len(strip)) - first[strip])
        corners = np.array([apex[strip], a, a + way]).T if at_q else np.array([a, apex[strip], a + way]).T
        corners[strips.outwards[strip] < 0] = corners[strips.outwards[strip] < 0][:, ::-1]
        parts.append(Faces(corners, _kind_of_walls(box, plane, high, corners), np.full(len(strip), WALL)))
    return parts


def _strips(plane: Partition, high: Heights) -> _Strips:
    """What only one of two neighbours of different structures has over their common side."""
    columns = plane.columns
    p, q, left, right = _seams(plane)
    ends = []
    for each, structure in enumerate((left, right)):
        code = columns.codes[structure]
        records = columns.record[[p, q], structure]
        for k in range(columns.V.shape[2]):
            row = np.flatnonzero(number_of(code) > k)
            ends += [(row, *high.at[end, records[:, row], k], np.full(len(row), each)) for end in (0, 1)]
    row, at_p, at_q, who = map(np.concatenate, zip(*ends, strict=True))
    order = np.lexsort((high.V[at_p] + high.V[at_q], row))
    row, at_p, at_q, who = (values[order] for values in (row, at_p, at_q, who))
    first = np.searchsorted(row, row)  # of the ends over the same side
    within = []
    for each in (0, 1):
        passed = np.append(0, np.cumsum(who == each))
        within.append((passed[1:] - passed[first]) % 2 == 1)
    only = np.flatnonzero((within[0] != within[1])[:-1] & (row[1:] == row[:-1]))
    over_p, over_q = (np.array([at[only], at[only + 1]]) for at in (at_p, at_q))
    return _Strips(over_p, over_q, np.where(within[0][only], 1, -1))


def _seams(plane: Partition) -> tuple[Index, Index, Index, Index]:
    """Sides between triangles of two structures: ends p and q, structures on the left and right."""
    sides, which = sides_of(plane.triangles)
    start = plane.triangles.ravel()
    forwards = sides[which.ravel(), 0] == start
    beside = np.full((2, len(sides)), -1)  # left, right
    triangle = np.repeat(np.arange(len(plane.triangles)), 3)
    beside[np.where(forwards, 0, 1), which.ravel()] = triangle
    inner = np.flatnonzero((beside >= 0).all(axis=0))
    left, right = plane.structure[beside[:, inner]]
    seam = left != right
    inner = inner[seam]
    return sides[inner, 0], sides[inner, 1], left[seam], right[seam]


def _kind_of_walls(box: Box, plane: Partition, high: Heights, corners: Index) -> NDArray[np.int64]:
    """The condition that is zero at all corners of upright triangles (n, 3): WEAVE or CAPSIZE, else NONE."""
    points, V = plane.points[:, high.point[corners]], high.V[corners]
    kind = np.full(len(corners), NONE)
    for each, name in ((WEAVE, "hurwitz3"), (CAPSIZE, "p0")):
        kind[(distance(box, name, points, V) < ON).all(axis=1)] = each
    return kind


def _without_pairs(faces: Faces) -> Faces:
    """Without triangles that have no area, and those that cover each other from both sides."""
    a, b, c = faces.corners.T
    faces = faces.chosen((a != b) & (b != c) & (c != a))
    least = np.argmin(faces.corners, axis=1)
    turned = np.take_along_axis(faces.corners, (least[:, np.newaxis] + [0, 1, 2]) % 3, axis=1)
    way = np.where(turned[:, 1] < turned[:, 2], 1, -1)
    _, same = np.unique(np.sort(turned, axis=1), axis=0, return_inverse=True)
    net = np.bincount(same.ravel(), way).astype(int)[same.ravel()]
    order = np.lexsort((way, same.ravel()))
    nth = np.empty(len(way), int)
    nth[order] = _nth(same.ravel()[order] * 2 + (way[order] > 0))
    return faces.chosen((np.sign(net) == way) & (nth < np.abs(net)))


def parted(corners: Index) -> tuple[Index, Index]:
    """Corners (face, 3) with points of their own for sheets that only touch; and the old number of each.

    Along an edge of more than two triangles those of opposite ways are joined in pairs; where that leaves
    such an edge, in other pairs.
    """
    old = corners.ravel()
    corner = np.arange(len(old))
    after = corner + np.where(corner % 3 == 2, -2, 1)
    sides, which = sides_of(corners)
    side = which.ravel()
    forwards = sides[side, 0] == old
    order = np.lexsort((forwards, side))
    nth = np.empty(len(old), int)  # of those along its side that run the same way
    nth[order] = _nth(side[order] * 2 + forwards[order])
    pairs = np.minimum(*(np.bincount(side[way], minlength=len(sides)) for way in (forwards, ~forwards)))
    at_low, at_high = np.where(forwards, corner, after), np.where(forwards, after, corner)
    one, two = np.flatnonzero(forwards & (nth < pairs[side])), np.flatnonzero(~forwards & (nth < pairs[side]))
    one = one[np.lexsort((nth[one], side[one]))]
    turn = np.zeros(len(sides), int)
    for _ in range(_TURNS):
        turned = (nth[two] + turn[side[two]]) % pairs[side[two]]
        other = two[np.lexsort((turned, side[two]))]
        a, b = np.concatenate([[at_low[one], at_low[other]], [at_high[one], at_high[other]]], axis=1)
        unique, number = np.unique(old * len(old) + connected(a, b, len(old)), return_inverse=True)
        new = number.reshape(-1, 3)
        crowded = np.bincount(sides_of(new)[1].ravel())[sides_of(new)[1].ravel()] > 2
        if not crowded.any():
            break
        turn[np.unique(side[crowded])] += 1
    return new, unique // len(old)


def _nth(group: Index) -> Index:
    """The number of each within its group, for groups in order."""
    return np.arange(len(group)) - np.searchsorted(group, group)
