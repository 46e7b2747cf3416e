r"""The plane of designs cut into triangles of one structure: as many intervals with the same kinds of ends.

A-----A-----+-----B       A, B: points of structure A or B; +: a point of both, where a side passes from
\   / \   / \   /        one into the other, found by halving. Triangles get a structure that all of
A---+---B---B          their corners have.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.region.columns import Columns, Ends, ends_at, number_of
from bikestab.region.events import Box
from bikestab.region.patches import Partition
from bikestab.region.slivers import borrowed
from bikestab.region.triangulation import Index, sides_of, split

_BESIDE = 1e-12  # of the box: so close to a point that its column is that at the point
_SAME = 1e-10  # of the box: points so close are one
_SMALL = 1e-9  # of the box: triangles and sides that are not cut any more
_LONG = 1e-2  # of the box: sides across stripes, which are narrower than the distance of traced points
_TOUCH = 1e-4  # of the box's speeds: so close, ends over a point on a curve meet there
_HALVINGS = 48  # of a side, to find where its structure changes: to rounding
_AT_ONCE = 1024  # designs: fewer take as long
_ROUNDS = 100, 4  # at most, of cutting sides and triangles, and of parting what touches


def partitioned(box: Box, points: Floats, triangles: Index, traced: int) -> Partition:
    """The plane cut where structures change; the first ``traced`` points are on curves where they do."""
    columns = Columns(points.shape[1])
    plane = Partition(points, triangles, np.full(len(triangles), -1), columns)
    own = np.arange(traced, points.shape[1])
    columns.add(own, ends_at(box, points[:, own]), points[:, own])
    sides = sides_of(triangles)[0]
    for start, goal in (sides.T, sides.T[::-1]):
        on = start < traced
        _look(box, plane, start[on], goal[on])
    for _ in range(_ROUNDS[1]):
        _settle(box, plane)
        if not _part(box, plane):
            return plane
    _settle(box, plane)
    return plane


def _settle(box: Box, plane: Partition) -> None:
    """Give all triangles a structure, cutting those that pass from one into another."""
    for number in range(_ROUNDS[0] + 1):
        rest = np.flatnonzero(plane.structure < 0)
        triangles = plane.triangles[rest]
        sides, which = sides_of(triangles)
        length = plane.length(sides)
        structure, good = _structures(box, plane, triangles)
        open_ = (length > _SMALL) & ~_uniform(box, plane, sides)
        good &= ~np.logical_or.reduce(open_[which], axis=1)
        plane.structure[rest[good]] = structure[good]
        if good.all():
            return
        rest, triangles, which = rest[~good], triangles[~good], which[~good]
        if open_.any() and number < _ROUNDS[0]:
            _cut(plane, sides[open_], _crossings(box, plane, sides[open_]))
            continue
        long = length[which].max(axis=1)
        wide = (plane.area(triangles) > _SMALL * long) & (number < _ROUNDS[0])
        for i in np.flatnonzero(~wide):
            plane.structure[rest[i]] = borrowed(box, plane, triangles[i], _SMALL)
        _cut_inside(box, plane, rest[wide])


def _uniform(box: Box, plane: Partition, sides: Index) -> NDArray[np.bool_]:
    """Whether sides (n, 2) have a structure that both ends have, and so has the middle of long ones.

    It is looked at between two curves, where one structure is in common: with several it is a chord of one.
    """
    has, codes = plane.columns.has()[sides], plane.columns.codes
    common, curves = np.logical_and.reduce(has, axis=1), np.count_nonzero(has, axis=2) > 1
    number = np.count_nonzero(common, axis=1)
    between = (number == 1) & np.logical_and.reduce(curves, axis=1) & (plane.length(sides) > _LONG)
    found, looked = number > 0, np.flatnonzero(between)
    middle = ends_at(box, plane.points[:, sides[looked]].mean(axis=2))
    found[looked] = codes[np.argmax(common[looked], axis=1)] == middle.code
    return found


def _cut_inside(box: Box, plane: Partition, chosen: Index) -> None:
    """Cut triangles (n,) into three at a point in their middle."""
    triangles = plane.triangles[chosen]
    m = _middles(box, plane, triangles)
    a, b, c = triangles.T
    plane.triangles[chosen] = np.array([a, b, m]).T
    plane.triangles = np.concatenate([plane.triangles, *(np.array(p).T for p in ((b, c, m), (c, a, m)))])
    plane.structure = np.append(plane.structure, np.full(2 * len(m), -1))


def _middles(box: Box, plane: Partition, sides: Index) -> Index:
    """New points in the middle of sides or triangles (n, corner)."""
    points = plane.points[:, sides].mean(axis=2)
    m = plane.add(points)
    plane.columns.add(m, ends_at(box, points), points)
    return m


def _cut(plane: Partition, sides: Index, number: Index) -> None:
    """Cut all triangles that have sides (n, 2) at the points ``number`` (n,) in these, −1 = none."""
    n = plane.points.shape[1]
    sides, number = np.sort(sides[number >= 0], axis=1), number[number >= 0]
    if not len(sides):
        return
    order = np.lexsort(sides.T[::-1])
    key, number = (sides[:, 0] * n + sides[:, 1])[order], number[order]
    after = np.roll(plane.triangles, -1, axis=1)
    keys = np.minimum(plane.triangles, after) * n + np.maximum(plane.triangles, after)
    at = np.minimum(np.searchsorted(key, keys), len(key) - 1)
    cut = np.where(key[at] == keys, number[at], -1)
    old = np.flatnonzero((cut >= 0).any(axis=1))
    new, parent = split(plane.triangles[old], cut[old])
    structure = plane.structure[old][parent]
    structure[~plane.columns.has()[new, structure[:, np.newaxis]].all(axis=1)] = -1
    plane.triangles = np.concatenate([np.delete(plane.triangles, old, axis=0), new])
    plane.structure = np.append(np.delete(plane.structure, old), structure)


def _look(box: Box, plane: Partition, start: Index, goal: Index) -> None:
    """Note the structures of the points ``start`` just beside them, towards the points ``goal``."""
    way = plane.points[:, goal] - plane.points[:, start]
    places = plane.points[:, start] + way * (_BESIDE / np.hypot(*way))
    plane.columns.add(start, ends_at(box, places), places)


def _crossings(box: Box, plane: Partition, sides: Index) -> Index:
    """New points where the structure changes on sides whose ends have none in common; −1 = none is needed.

    A side may need more than one, then the rest follows in the next round.
    """
    number = np.full(len(sides), -1)
    code = _looked(box, plane, sides)
    open_ = np.flatnonzero(~_uniform(box, plane, sides))
    # between two curves the middle: their crossing is reached by halving, not by steps from curve to curve
    both = (np.count_nonzero(plane.columns.has()[sides[open_]], axis=2) > 1).all(axis=1)
    number[open_[both]] = _middles(box, plane, sides[open_[both]])
    open_ = open_[~both]
    if not len(open_):
        return number
    start, goal = plane.points[:, sides[open_].T].swapaxes(0, 1)
    way = goal - start
    length = np.hypot(*way)
    before, behind = _change(box, code[open_], start, way, _SAME / length)
    number[open_] = m = plane.add(start + behind * way)
    behind = np.minimum(behind + _BESIDE / length, 1 - _SAME / length)
    places = np.concatenate([start + before * way, start + behind * way], axis=1)
    plane.columns.add(np.tile(m, 2), ends_at(box, places), places)
    return number


def _looked(box: Box, plane: Partition, sides: Index) -> NDArray[np.int64]:
    """Note the structures just beside both ends of sides (n, 2), until they have one in common.

    Returns the last one seen at each first end.
    """
    start, goal = plane.points[:, sides.T].swapaxes(0, 1)
    way = (goal - start) / np.hypot(*(goal - start))
    places = np.array(
        [end + sign * far * way for far in (_BESIDE, _SAME) for end, sign in ((start, 1), (goal, -1))]
    )
    ends = ends_at(box, places.swapaxes(0, 1).reshape(2, -1))
    V, codes = ends.V.reshape(2, 4, len(sides), -1), ends.code.reshape(4, -1)
    shared = np.zeros(len(sides), bool)
    for i in (0, 2):
        still = ~shared
        for j in (0, 1):
            plane.columns.add(
                sides[still, j], Ends(V[:, i + j, still], codes[i + j, still]), places[i + j][:, still]
            )
        shared = plane.share(sides)
    return codes[2]


def _change(box: Box, code: Index, start: Floats, way: Floats, t: Floats) -> tuple[Floats, Floats]:
    """Before and behind the first change of a structure (n,), from start + t way to start + (1 − t) way."""
    n = len(code)
    low, high = t, 1 - t
    cuts = int(np.clip(_AT_ONCE // max(n, 1), 2, 256))
    part = np.arange(1, cuts)[:, np.newaxis] / cuts
    for _ in range(int(np.ceil(_HALVINGS / np.log2(cuts)))):
        inner = low + part * (high - low)
        found = ends_at(box, (start[:, np.newaxis] + inner * way[:, np.newaxis]).reshape(2, -1)).code
        same = np.vstack([found.reshape(cuts - 1, n) == code, np.zeros((1, n), bool)])
        first = np.argmin(same, axis=0)
        every = np.vstack([low, inner, high])
        low, high = every[first, np.arange(n)], every[first + 1, np.arange(n)]
    return low, high


def _structures(box: Box, plane: Partition, triangles: Index) -> tuple[Index, NDArray[np.bool_]]:
    """The structure of each triangle, and whether that will do.

    Where the corners have several in common, it is that of the middle.
    """
    columns = plane.columns
    common = np.logical_and.reduce(columns.has()[triangles], axis=1)
    number = np.count_nonzero(common, axis=1)
    structure = np.argmax(common, axis=1)
    good = number == 1
    several = np.flatnonzero(number > 1)
    middle = ends_at(box, plane.points[:, triangles[several]].mean(axis=2))
    fits = common[several] & (columns.codes[: common.shape[1]] == middle.code[:, np.newaxis])
    good[several] = fits.any(axis=1)
    structure[several[good[several]]] = np.argmax(fits, axis=1)[good[several]]
    return structure, good


def _part(box: Box, plane: Partition) -> bool:
    r"""Put a point between two on curves, where the ends of an interval would else touch across triangles.

    Returns whether some of these points have another structure than the triangles.

        +-------+           +-------+      + V1 = V2: without the point o an interval would be
       / \  A  / \   ->    / \ .o. / \       closed all along the side
      +---\---+---+       +---+---+---+
    """
    columns = plane.columns
    sides, which = sides_of(plane.triangles)
    several = np.count_nonzero(columns.has(), axis=1) > 1
    order = np.argsort(which.ravel(), kind="stable")
    count = np.bincount(which.ravel(), minlength=len(sides))
    first = np.cumsum(count) - count
    inside = np.flatnonzero((count == 2) & several[sides].all(axis=1) & (plane.length(sides) > _SMALL))
    beside = plane.structure[order[first[inside, np.newaxis] + [0, 1]] // 3]
    chosen = (beside[:, 0] == beside[:, 1]) & (number_of(columns.codes[beside[:, 0]]) > 0)
    inside, structure = inside[chosen], beside[chosen, 0]
    touching = columns.touching(sides[inside], structure, _TOUCH * (box.V[1] - box.V[0]))
    inside, structure = inside[touching], structure[touching]
    m = _middles(box, plane, sides[inside])
    _cut(plane, sides[inside], m)
    return bool((columns.record[m, structure] < 0).any())
