"""A triangulation of a box of the plane of designs that follows the curves where stable intervals change."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import elementwise
from scipy.spatial import Delaunay, cKDTree

from bikestab import polynomials
from bikestab.errors import ScanError
from bikestab.model import Floats
from bikestab.region.curves import Curve
from bikestab.region.events import Box, event_at
from bikestab.region.skeleton import CurveName, speed_polynomials
from bikestab.routh import conditions

Index = NDArray[np.intp]
Function = Callable[[Floats], Floats]
Relevant = Callable[[Floats], NDArray[np.bool_]]
CUTS: tuple[CurveName, ...] = ("fold", "crossing", "meet", "slow meet", "singular inertia")
FACES = (("hurwitz3", 0), ("hurwitz3", 1), ("p0", 0), ("p0", 1))  # where a surface leaves the box's speeds
_LAYERS = np.array([1, 4, 9, 16]) / 16  # of a cell, beside a fold, where V goes as the square root
_ON = 1e-12  # of the box: a point so close to a curve is on it


@dataclass
class Plane:
    """Points (2, point) in units of the box, triangles (triangle, 3) of them, and which lie on which cut.

    ``cuts`` are the functions whose zeros these are.
    """

    points: Floats
    triangles: Index
    on: dict[str, NDArray[np.bool_]]
    cuts: dict[str, Function]


def triangulated(box: Box, curves: Sequence[Curve], cells: int) -> Plane:
    """The box with ``cells`` triangles along each side, cut along the curves and the faces V = const."""
    points, traced = _points(box, curves, 1 / cells)
    triangles: Index = Delaunay(points.T).simplices.astype(np.intp)
    a, b, c = points[:, triangles.T].swapaxes(0, 1)
    area = (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    plane = Plane(points, triangles[np.abs(area) > 1e-14], {}, {})
    for name in CUTS:
        relevant = None if name == "singular inertia" else partial(_matters, box, name)
        plane = _cut(plane, name, partial(box.value, name), relevant, traced)
    for condition, side in FACES:
        plane = _cut(
            plane, f"{condition} {side}", partial(_on_face, box, condition, side),
            partial(_edge_on_face, box, condition, side), traced,
        )  # fmt: skip
    return plane


def _points(box: Box, curves: Sequence[Curve], step: float) -> tuple[Floats, Index]:
    """Points of a triangular grid and of the curves, with layers beside folds; and which are the curves'."""
    low, high = box.ends.T[..., np.newaxis]
    chosen, layers = [np.empty((2, 0))], [np.empty((2, 0))]
    for curve in curves:
        points = (np.array([curve.x, curve.y]) - low) / (high - low)
        walked = np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=1))))
        away = [np.full(len(walked), np.inf) if end in ("box", "closed") else way
                for end, way in zip(curve.ends, (walked, walked[-1] - walked), strict=True)]  # fmt: skip
        away_from_end = np.minimum(*away)
        chosen.append(points)
        if curve.name == "fold":
            along = np.gradient(points, axis=1) if points.shape[1] > 1 else points
            aside = np.array([-along[1], along[0]]) / np.maximum(np.hypot(*along), 1e-300) * step
            free = away_from_end > step
            layers += [(points + d * aside)[:, free] for d in np.concatenate([-_LAYERS, _LAYERS])]
    traced = np.unique(np.concatenate(chosen, axis=1), axis=1)
    beside = np.concatenate(layers, axis=1)
    beside = beside[:, ((beside > 0.02 * step) & (beside < 1 - 0.02 * step)).all(axis=0)]
    grid = _grid(step)
    if traced.size:
        tree = cKDTree(traced.T)
        beside = beside[:, tree.query(beside.T)[0] > 0.05 * step] if beside.size else beside
        corner = np.isin(grid, (0.0, 1.0)).all(axis=0)
        grid = grid[:, corner | (tree.query(grid.T)[0] > 0.4 * step)]
    if beside.size:
        grid = grid[
            :, np.isin(grid, (0.0, 1.0)).any(axis=0) | (cKDTree(beside.T).query(grid.T)[0] > 0.4 * step)
        ]
    new = np.concatenate([beside, grid], axis=1)
    return np.concatenate([traced, new], axis=1), np.arange(traced.shape[1])


def _grid(step: float) -> Floats:
    n = round(1 / step)
    rows = []
    for j in range(n + 1):
        u = np.arange(n + 1) * step if j % 2 == 0 else np.concatenate([[0], (np.arange(n) + 0.5) * step, [1]])
        u[-1] = 1.0
        rows.append(np.array([u, np.full(len(u), min(j * step, 1.0) if j < n else 1.0)]))
    return np.concatenate(rows, axis=1)


def _cut(plane: Plane, name: str, value: Function, relevant: Relevant | None, traced: Index) -> Plane:
    """Cut triangles along a function's zero where it is relevant; the new points are exactly on it."""
    points, triangles = plane.points, plane.triangles
    f = value(points)
    on = np.zeros(len(f), bool)
    on[traced] = _close(value, points[:, traced])
    sign = np.where(on, 0.0, np.sign(f))
    edges, which = _edges(triangles)
    crossed = np.flatnonzero(sign[edges[:, 0]] * sign[edges[:, 1]] < 0)
    a, b = points[:, edges[crossed, 0]], points[:, edges[crossed, 1]]

    def along(t: Floats, *ends: Floats) -> Floats:
        low, high = np.array(ends).reshape(2, 2, -1)
        return value(low + t * (high - low))

    t = np.empty(0)
    if len(crossed):
        root = elementwise.find_root(
            along, (np.zeros(len(crossed)), np.ones(len(crossed))), args=(*a, *b),
            tolerances={"xatol": 1e-16, "xrtol": 1e-15},
        )  # fmt: skip
        if not root.success.all():
            raise ScanError(f"the cut along {name!r} could not be refined everywhere; please report this")
        t = root.x
    new = a + t * (b - a)
    both = {other: np.zeros(len(crossed), bool) for other in plane.on}
    for other, function in plane.cuts.items():  # along a chord of another curve: to where the curves cross
        chord = np.flatnonzero(np.logical_and(*plane.on[other][edges[crossed]].T))
        if not len(chord):
            continue
        moved = _crossing(value, function, new[:, chord])
        near = np.hypot(*(moved - new[:, chord])) < 0.25 * np.hypot(*(b - a)[:, chord])
        near &= ((moved >= 0) & (moved <= 1)).all(axis=0)
        new[:, chord[near]] = moved[:, near]
        both[other][chord[near]] = True
    kept = np.ones(len(t), bool) if relevant is None or not len(t) else relevant(new)
    for near, end in ((t == 0, 0), (t == 1, 1)):
        on[edges[crossed[kept & near], end]] = True
        kept &= ~near
    number = np.full(len(edges), -1)
    number[crossed[kept]] = points.shape[1] + np.arange(np.count_nonzero(kept))
    tags = {other: np.append(flag, both[other][kept]) for other, flag in plane.on.items()}
    tags[name] = np.append(on, np.ones(np.count_nonzero(kept), bool))
    cut = number[which.reshape(-1, 3)]
    points = np.concatenate([points, new[:, kept]], axis=1)
    return Plane(points, _split(triangles, cut), tags, plane.cuts | {name: value})


def _crossing(f: Function, g: Function, points: Floats) -> Floats:
    """Points (2, n) near a crossing of two curves moved onto it, by Newton's method."""
    h = 1e-7
    u, v = (np.array([[h], [0.0]]), np.array([[0.0], [h]]))
    for _ in range(4):
        (fu, fv), (gu, gv) = (
            (
                (value(points + u) - value(points - u)) / (2 * h),
                (value(points + v) - value(points - v)) / (2 * h),
            )
            for value in (f, g)
        )
        F, G = f(points), g(points)
        det = fu * gv - fv * gu
        with np.errstate(divide="ignore", invalid="ignore"):
            move = np.array([F * gv - G * fv, G * fu - F * gu]) / det
        points = points - np.where(np.hypot(*move) < 1e-2, move, 0.0)
    return points


def _split(triangles: Index, cut: Index) -> Index:
    """Triangles (n, 3) whose sides 01, 12, 20 have the points ``cut`` (n, 3) in them, −1 = none."""
    count = np.count_nonzero(cut >= 0, axis=1)
    parts = [triangles[count == 0]]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        one = (count == 1) & (cut[:, i] >= 0)
        A, B, C = triangles[one][:, [i, j, k]].T
        p = cut[one, i]
        parts += [np.array([A, p, C]).T, np.array([p, B, C]).T]
        two = (count == 2) & (cut[:, i] < 0)  # the sides at C are cut
        A, B, C = triangles[two][:, [i, j, k]].T
        p, q = cut[two, j], cut[two, k]
        parts += [np.array([C, q, p]).T, np.array([q, A, p]).T, np.array([A, B, p]).T]
    A, B, C = triangles[count == 3].T
    p, q, r = cut[count == 3].T
    parts += [np.array(corners).T for corners in ((A, p, r), (p, B, q), (r, q, C), (p, q, r))]
    return np.concatenate(parts)


def halved(plane: Plane, chosen: Callable[[Floats, Index], NDArray[np.bool_]]) -> Plane:
    """The plane with new points in the middle of sides between two points on curves.

    ``chosen`` tells which, from the middles (2, side) and their triangles (side, 2); sides on the rim of
    the box and those between neighbours on one curve stay whole where it says so.
    """
    edges, which = _edges(plane.triangles)
    onto = np.logical_or.reduce(list(plane.on.values()))
    order = np.argsort(which, kind="stable")
    count = np.bincount(which, minlength=len(edges))
    first = np.cumsum(count) - count
    inside = np.flatnonzero((count == 2) & onto[edges].all(axis=1))
    beside = order[first[inside, np.newaxis] + [0, 1]] // 3
    middle = plane.points[:, edges[inside]].mean(axis=2)
    some = chosen(middle, beside)
    number = np.full(len(edges), -1)
    number[inside[some]] = plane.points.shape[1] + np.arange(np.count_nonzero(some))
    none = np.zeros(np.count_nonzero(some), bool)
    return Plane(
        np.concatenate([plane.points, middle[:, some]], axis=1),
        _split(plane.triangles, number[which.reshape(-1, 3)]),
        {name: np.append(on, none) for name, on in plane.on.items()},
        plane.cuts,
    )


def _edges(triangles: Index) -> tuple[Index, Index]:
    """The sides (edge, 2) of triangles, and which of them are the sides 01, 12, 20 of each, flat."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=-1)
    edges, which = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
    return edges, which.ravel()


def _close(value: Function, points: Floats) -> NDArray[np.bool_]:
    """Which points are on the zero of a function, judged by its slope."""
    h = 1e-6
    u, v = (np.array([[h], [0.0]]), np.array([[0.0], [h]]))
    slope = np.hypot(value(points + u) - value(points - u), value(points + v) - value(points - v)) / (2 * h)
    return np.abs(value(points)) <= _ON * slope


def _matters(box: Box, name: CurveName, points: Floats) -> NDArray[np.bool_]:
    return event_at(box, name, points).state > 0


def _on_face(box: Box, condition: str, side: int, points: Floats) -> Floats:
    found = speed_polynomials(box.table(points))
    return polynomials.value(
        found.polynomials[condition], np.full(points.shape[1], box.V[side] ** found.power)
    )


def _edge_on_face(box: Box, condition: str, side: int, points: Floats) -> NDArray[np.bool_]:
    if box.V[side] == 0:
        return _matters(box, "weave at rest" if condition == "hurwitz3" else "capsize at rest", points)
    values = conditions(box.table(points), box.V[side])._asdict()
    return np.logical_and.reduce([value > 0 for name, value in values.items() if name != condition])
