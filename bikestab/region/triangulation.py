"""A triangulation of a box of the plane of designs, with points on the curves where intervals change."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from bikestab.lean import lean_numpy
from bikestab.model import Floats
from bikestab.region.curves import Curve
from bikestab.region.events import Box
from bikestab.region.neighbours import near

Index = NDArray[np.intp]
Delaunay = Callable[[Floats], NDArray[np.integer]]  # points (2, n) → triangles (m, 3)
_LAYERS = np.array([1, 4, 9, 16]) / 16  # of a cell, beside a fold, where V goes as the square root
_FLAT = 1e-14  # area of a triangle, in boxes, that Delaunay's method makes of points on one line


def triangulated(
    box: Box, curves: Sequence[Curve], lines: Sequence[Floats], cells: int, delaunay: Delaunay
) -> tuple[Floats, Index, int]:
    """Points (2, point) in units of the box and triangles (triangle, 3) of them, anticlockwise.

    There are ``cells`` triangles along each side; the first points are those of the curves and lines
    (2, point), as many as the third result tells. They are those of ``delaunay``.
    """
    traced, others = _points(box, curves, lines, 1 / cells)
    points = np.concatenate([traced, others], axis=1)
    triangles: Index = delaunay(points).astype(np.intp)
    a, b, c = points[:, triangles.T].swapaxes(0, 1)
    area = (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    return points, triangles[np.abs(area) > _FLAT], traced.shape[1]


def by_scipy(points: Floats) -> NDArray[np.integer]:
    """Delaunay's triangles."""
    with lean_numpy():
        from scipy.spatial import Delaunay as Method  # takes longer to import than most meshes to make

    return np.asarray(Method(points.T).simplices)


def _points(box: Box, curves: Sequence[Curve], lines: Sequence[Floats], step: float) -> tuple[Floats, Floats]:
    """Points of curves and lines, and of a triangular grid with layers beside folds, none close to another.

    o   o   o   o
      o  : : : .o     o the grid, x a fold, : its layers
    o  : x-x-x-x
      o : : : : o
    """
    low, high = box.ends.T[..., np.newaxis]
    chosen, layers = [np.empty((2, 0)), *lines], [np.empty((2, 0))]
    for curve in curves:
        points = (np.array([curve.x, curve.y]) - low) / (high - low)
        chosen.append(points)
        if curve.name == "fold":
            layers.append(_layers(curve, points, step))
    traced = np.unique(np.concatenate(chosen, axis=1), axis=1)
    beside = np.concatenate(layers, axis=1)
    beside = beside[:, ((beside > 0.02 * step) & (beside < 1 - 0.02 * step)).all(axis=0)]
    grid = _grid(step)
    if traced.size:
        beside = beside[:, ~near(beside, traced, 0.05 * step)]
        corner = np.isin(grid, (0.0, 1.0)).all(axis=0)
        grid = grid[:, corner | ~near(grid, traced, 0.4 * step)]
    if beside.size:
        rim = np.isin(grid, (0.0, 1.0)).any(axis=0)
        grid = grid[:, rim | ~near(grid, beside, 0.4 * step)]
    return traced, np.concatenate([beside, grid], axis=1)


def _layers(curve: Curve, points: Floats, step: float) -> Floats:
    """Points on both sides of a curve, but for a step at its ends where it meets another."""
    walked = np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=1))))
    away = [np.full(len(walked), np.inf) if end in ("box", "closed") else way
            for end, way in zip(curve.ends, (walked, walked[-1] - walked), strict=True)]  # fmt: skip
    along = np.gradient(points, axis=1) if points.shape[1] > 1 else points
    aside = np.array([-along[1], along[0]]) / np.maximum(np.hypot(*along), 1e-300) * step
    free = np.minimum(*away) > step
    return np.concatenate(
        [(points + d * aside)[:, free] for d in np.concatenate([-_LAYERS, _LAYERS])], axis=1
    )


def _grid(step: float) -> Floats:
    n = round(1 / step)
    rows = []
    for j in range(n + 1):
        u = np.arange(n + 1) * step if j % 2 == 0 else np.concatenate([[0], (np.arange(n) + 0.5) * step, [1]])
        u[-1] = 1.0
        rows.append(np.array([u, np.full(len(u), min(j * step, 1.0) if j < n else 1.0)]))
    return np.concatenate(rows, axis=1)


def sides_of(triangles: Index) -> tuple[Index, Index]:
    """The sides (side, 2) of triangles, and which of them are the sides 01, 12, 20 of each (triangle, 3)."""
    after = np.roll(triangles, -1, axis=1)
    low, high = np.minimum(triangles, after), np.maximum(triangles, after)
    n = triangles.max(initial=0) + 1
    key, which = np.unique((low * n + high).ravel(), return_inverse=True)  # faster than by rows
    return np.array(np.divmod(key, n)).T, which.reshape(-1, 3)


def split(triangles: Index, cut: Index) -> tuple[Index, Index]:
    r"""Triangles (n, 3) cut at points ``cut`` (n, 3) in their sides 01, 12, 20, −1 = none.

    Returns the parts and which triangle each is of.

             C                C                C               C
            / \              / \             / \             / \
           /   \            / | \           q---p           r---q
          /     \          /  |  \         / \  \         / \ / \
         A-------B         A---p---B       A---\---B        A---p---B
    """
    count = np.count_nonzero(cut >= 0, axis=1)
    rows = [np.flatnonzero(count == 0)]
    parts = [triangles[rows[0]]]

    def add(row: Index, *corners: tuple[Index, Index, Index]) -> None:
        rows.extend([row] * len(corners))
        parts.extend(np.array(part).T for part in corners)

    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        one = np.flatnonzero((count == 1) & (cut[:, i] >= 0))
        A, B, C = triangles[one][:, [i, j, k]].T
        p = cut[one, i]
        add(one, (A, p, C), (p, B, C))
        two = np.flatnonzero((count == 2) & (cut[:, i] < 0))  # the sides at C are cut
        A, B, C = triangles[two][:, [i, j, k]].T
        p, q = cut[two, j], cut[two, k]
        add(two, (C, q, p), (q, A, p), (A, B, p))
    three = np.flatnonzero(count == 3)
    A, B, C = triangles[three].T
    p, q, r = cut[three].T
    add(three, (A, p, r), (p, B, q), (r, q, C), (p, q, r))
    return np.concatenate(parts), np.concatenate(rows)
