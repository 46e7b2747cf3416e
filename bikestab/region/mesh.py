"""The boundary of the stable region in (x, y, V) as triangles, without holes and without a ragged rim.

Over the plane of designs the boundary consists of sheets V1 and V2. A triangulation of the plane that is cut
exactly along the curves where sheets meet or end is lifted to each sheet; sheets that meet share
their points there, so the surface is open only at the faces of the box.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.errors import ScanError
from bikestab.family import Family
from bikestab.model import Floats
from bikestab.region.curves import trace
from bikestab.region.events import Box, event_at
from bikestab.region.skeleton import CurveName, speed_polynomials
from bikestab.region.triangulation import FACES, Index, Plane, halved, triangulated
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import CAPSIZE, NONE, WEAVE, critical_speeds, intervals_of

_CLOSE = 1e-3  # of a speed: how far rounding may move one that is known to be a root
# where the stable intervals of a triangle are looked for beside a corner on a curve: towards its inner
# point (None) or the next corners, and how far; where a curve bulges across a side the last ones are needed
_INWARD = [
    *((to, part) for part in (0.0, 1e-4, 1e-3, 1e-2, 0.1) for to in (None, 1, 2)),
    (None, 0.5),
    (None, 1.0),
]
_TRACED = (2, 4, 8)  # samples of the curves in a cell: a short piece of curve needs more
_SAMPLES = 33  # speeds in an interval, for its lowest growth rate


class Mesh(NamedTuple):
    """A triangulated boundary; corners of a triangle run anticlockwise seen from the unstable side.

    ``points`` (point, 3) are x and y of the family and V [m/s]; ``triangles`` (triangle, 3) index them;
    ``kind`` (triangle,) is WEAVE or CAPSIZE; ``upper`` (triangle,) tells whether it is an upper end V2.
    ``decay`` (point,) is the lowest growth rate [s⁻¹] in the stable interval of which the point is an end.
    """

    points: Floats
    triangles: Index
    kind: NDArray[np.uint8]
    upper: NDArray[np.bool_]
    decay: Floats

    def open_edges(self, box: Box) -> Index:
        """Edges (edge, 2) of one triangle only that are not in a face of the box, or of more than two."""
        return self.open_within(np.vstack([box.ends, box.V]))

    def open_within(self, ends: Floats) -> Index:
        """The same for a box with these ends (3, 2) of x, y and V."""
        sides = np.sort(self.triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=-1).reshape(-1, 2)
        edges, count = np.unique(sides, axis=0, return_counts=True)
        a, b = self.points[edges].swapaxes(0, 1)
        on_face = [(a == face) & (b == face) for face in ends.T]
        return edges[(count > 2) | ((count == 1) & ~np.any(on_face, axis=(0, 2)))]


def region_mesh(
    family: Family,
    x: tuple[float, float],
    y: tuple[float, float],
    V: tuple[float, float],
    *,
    cells: int = 100,
    whole: bool = True,
) -> Mesh:
    """The boundary of the stable region within a box x × y × V [m/s] of a family.

    ``cells`` is the number of triangles along x and along y; what is smaller than a cell and bounded by
    no traced curve is not seen. Raises ScanError if the surface has holes or vertical walls; without
    ``whole`` these are left open, and the mesh is there sooner.
    """
    box = Box(family, np.array([x, y], dtype=float), V)
    if whole and _has_walls(box):
        raise ScanError(
            "p0 does not depend on the speed, so capsize starts at all speeds at once: the boundary has a "
            "vertical wall there, which a mesh of sheets V1 and V2 cannot show"
        )
    for finer in _TRACED:
        curves = trace(family, x, y, V, samples=finer * cells + 1)
        mesh = _lifted(box, _parted(box, triangulated(box, curves, cells)))
        holes = mesh.open_edges(box)
        if not whole or not len(holes):
            return mesh
    at = mesh.points[holes[0, 0]]
    raise ScanError(
        f"the boundary near {family.x} = {at[0]:.6g}, {family.y} = {at[1]:.6g}, V = {at[2]:.6g} m/s is "
        f"too fine for this mesh: {len(holes)} open edges; another number of cells or a smaller box may help"
    )


def _has_walls(box: Box) -> bool:
    p0 = speed_polynomials(box.table(np.random.default_rng(0).uniform(size=(2, 10_000)))).polynomials["p0"]
    return len(p0) == 1 and bool(p0.min() < 0 < p0.max())


class _Ends(NamedTuple):
    """The ends of the stable intervals within the box's speeds, (point, interval); kind NONE on a face."""

    V: tuple[Floats, Floats]
    kind: tuple[NDArray[np.uint8], NDArray[np.uint8]]
    code: NDArray[np.int64]


def _ends(box: Box, points: Floats) -> _Ends:
    found = intervals_of(box.table(points))
    low, high = box.V
    V1, V2 = np.maximum(found.V1, low), np.minimum(found.V2, high)
    inside = V1 < V2  # False for NaN
    first = np.argsort(~inside, axis=1, kind="stable")
    sheets = np.array([WEAVE, CAPSIZE])
    kinds = [
        np.where(np.isin(kind, sheets) & ~clipped, kind, NONE).astype(np.uint8)
        for kind, clipped in ((found.lower, V1 > found.V1), (found.upper, V2 < found.V2))
    ]

    def packed(values: NDArray) -> NDArray:
        return np.take_along_axis(np.where(inside, values, 0), first, axis=1)

    number = np.count_nonzero(inside, axis=1)
    V1, V2, lower, upper = (packed(values) for values in (V1, V2, *kinds))
    code = ((lower * np.int64(3) + upper) * 9 ** np.arange(inside.shape[1])).sum(axis=1)
    return _Ends((V1, V2), (lower, upper), code * 10 + number)


def _parted(box: Box, plane: Plane) -> Plane:
    """The plane with a point between two on curves, where V1 and V2 would else touch across a region."""
    code = _ends(box, _inner(plane)).code

    def chosen(middle: Floats, beside: Index) -> NDArray[np.bool_]:
        here = code[beside]
        return (here[:, 0] % 10 > 0) & (here == _ends(box, middle).code[:, np.newaxis]).all(axis=1)

    return halved(plane, chosen)


def _lifted(box: Box, plane: Plane) -> Mesh:
    inner = _inner(plane)
    ends = _ends(box, inner)
    stable = ends.code % 10 > 0
    if not stable.any():
        none = np.empty(0)
        return Mesh(none.reshape(0, 3), np.empty((0, 3), np.intp), none.astype(np.uint8), none > 0, none)
    triangles, ends = plane.triangles[stable], _chosen(ends, stable)
    corner_ends = _corners(box, plane, triangles, inner[:, stable], ends.code)
    speeds = _speeds(box, plane)
    parts = [
        _sheet(triangles, ends, corner_ends, speeds, k, side)
        for k in range(ends.V[0].shape[1])
        for side in (0, 1)
    ]
    row, V, kind, k, upper = (np.concatenate(values) for values in zip(*parts, strict=True))

    where = np.column_stack([triangles[row].ravel(), V.ravel()])
    unique, first, index = np.unique(where, axis=0, return_index=True, return_inverse=True)
    faces = np.where(upper[:, np.newaxis], index.reshape(-1, 3), index.reshape(-1, 3)[:, ::-1])
    x, y = box.real(plane.points[:, unique[:, 0].astype(int)])
    part, corner = np.unravel_index(first, V.shape)
    V1, V2 = (values[row[part], corner, k[part]] for values in corner_ends.V)
    decay = _lowest(box, plane.points[:, triangles[row[part], corner]], V1, V2)
    # where all corners are on the rim, the sheets above and below are the same triangle
    _, same, number = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True, return_counts=True)
    kept = number[same.ravel()] == 1
    points = np.column_stack([x, y, unique[:, 1]])
    return Mesh(points, faces[kept], kind[kept], upper[kept].astype(bool), decay)


def _inner(plane: Plane) -> Floats:
    """A point (2, triangle) of each triangle that is not on a curve.

    A corner, or else the middle of its shortest side that does not follow a curve: between two curves that
    touch, the middle of the triangle may be beyond one of them.
    """
    corners, on = plane.points[:, plane.triangles], np.array(list(plane.on.values()))[:, plane.triangles]
    off = ~np.logical_or.reduce(on)
    first = np.argmax(off, axis=1)
    each = np.arange(len(first))
    after = [1, 2, 0]
    length = np.hypot(*(corners - corners[:, :, after]))
    length[np.logical_or.reduce(on & on[:, :, after])] = np.inf
    side = np.argmin(length, axis=1)
    across = 0.5 * (corners[:, each, side] + corners[:, each, (side + 1) % 3])
    middle = np.where(np.isfinite(length.min(axis=1)), across, corners.mean(axis=2))
    return np.where(off.any(axis=1), corners[:, each, first], middle)


def _sheet(
    triangles: Index, ends: _Ends, corner_ends: _Ends, speeds: dict[int, Floats], k: int, side: int
) -> tuple[Index, Floats, NDArray[np.uint8], Index, Index]:
    """Triangles that have a sheet at one end of interval k: which, V (n, 3) there, kind, k and side."""
    kind = ends.kind[side][:, k]
    row = np.flatnonzero(kind != NONE)
    V = corner_ends.V[side][row, :, k]
    for each in (WEAVE, CAPSIZE):
        chosen = kind[row] == each
        candidates = speeds[each][:, triangles[row[chosen]]]
        if candidates.size:
            gap = np.abs(candidates - V[chosen])
            best = np.argmin(np.where(np.isnan(gap), np.inf, gap), axis=0)
            V[chosen] = np.take_along_axis(candidates, best[np.newaxis], axis=0)[0]
    return row, V, kind[row], np.full(len(row), k), np.full(len(row), side)


def _corners(box: Box, plane: Plane, triangles: Index, inner: Floats, code: NDArray[np.int64]) -> _Ends:
    """The intervals at the corners of triangles, or so little inside that they are those of the triangle.

    Shapes are (triangle, 3, interval).
    """
    corners = plane.points[:, triangles]
    onto = np.logical_or.reduce(list(plane.on.values()))[triangles]
    found = _ends(box, corners.reshape(2, -1))
    done = (found.code.reshape(onto.shape) == code[:, np.newaxis]) & ~onto
    V = [values.reshape(*onto.shape, -1).copy() for values in found.V]
    for target, part in _INWARD:
        row, corner = np.nonzero(~done)
        if not len(row):
            break
        start = corners[:, row, corner]
        goal = inner[:, row] if target is None else plane.points[:, triangles[row, (corner + target) % 3]]
        here = _ends(box, start + part * (goal - start))
        good = here.code == code[row]
        row, corner = row[good], corner[good]
        for values, new in zip(V, here.V, strict=True):
            n = min(values.shape[-1], new.shape[-1])
            values[row, corner, :n] = new[good][:, :n]
        done[row, corner] = True
    return _Ends((V[0], V[1]), found.kind, code)


def _chosen(ends: _Ends, which: NDArray[np.bool_]) -> _Ends:
    return _Ends(
        (ends.V[0][which], ends.V[1][which]), (ends.kind[0][which], ends.kind[1][which]), ends.code[which]
    )


def _speeds(box: Box, plane: Plane) -> dict[int, Floats]:
    """Critical speeds (root, point) of weave and capsize; those that meet on a curve are one number."""
    found = critical_speeds(box.table(plane.points))
    missing = np.full((1, plane.points.shape[1]), np.nan)
    speeds = {
        kind: np.concatenate([found[name], missing]) for kind, name in ((WEAVE, "hurwitz3"), (CAPSIZE, "p0"))
    }
    names: tuple[CurveName, ...] = ("fold", "crossing", "meet", "slow meet")
    for name in names:  # where a fold touches capsize, the latter's speed is the better known
        on = np.flatnonzero(plane.on[name])
        V = event_at(box, name, plane.points[:, on]).V if len(on) else np.empty(0)
        if name in ("fold", "crossing"):  # rounding parts its two roots, or takes them away
            weave = speeds[WEAVE][:, on]
            speeds[WEAVE][:-1, on] = np.where(np.abs(weave - V) < _CLOSE * V, np.nan, weave)[:-1]
            speeds[WEAVE][-1, on] = V
        else:
            for values in speeds.values():
                _replace_nearest(values, on, V)
    for condition, side in FACES:
        on = np.flatnonzero(plane.on[f"{condition} {side}"])
        _replace_nearest(
            speeds[WEAVE if condition == "hurwitz3" else CAPSIZE], on, np.full(len(on), box.V[side])
        )
    return speeds


def _replace_nearest(values: Floats, on: Index, V: Floats) -> None:
    """Put V (n,) at the points ``on`` (n,) in place of the nearest of ``values`` (root, point)."""
    gap = np.abs(values[:, on] - V)
    nearest = np.argmin(np.where(np.isnan(gap), np.inf, gap), axis=0)
    here = gap[nearest, np.arange(len(on))]
    values[np.where(here < _CLOSE * np.maximum(V, 1e-3), nearest, -1), on] = V


def _lowest(box: Box, points: Floats, V1: Floats, V2: Floats) -> Floats:
    """The lowest growth rate [s⁻¹] (point,) of evenly spaced speeds in an interval."""
    V = V1 + (V2 - V1) * np.linspace(0, 1, _SAMPLES)[:, np.newaxis]
    rate = growth_rate_of(box.table(points)[:, :, np.newaxis], V).min(axis=0)
    return np.minimum(rate, 0.0)  # which it is at either end
