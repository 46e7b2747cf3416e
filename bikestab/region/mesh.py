"""The boundary of the stable region over a plane of designs as triangles, open only at the box's faces."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.region.curves import leaving, trace
from bikestab.region.events import Box
from bikestab.region.heights import Heights, heights
from bikestab.region.partition import partitioned
from bikestab.region.patches import Partition
from bikestab.region.shell import UPPER, WALL, parted, shell
from bikestab.region.triangulation import Delaunay, Index, by_scipy, triangulated
from bikestab.spectrum import growth_rate_of

_TRACED = 2  # samples of the curves in a cell
_SAMPLES = 33  # speeds in an interval, for its lowest growth rate


class Mesh(NamedTuple):
    """A triangulated boundary; corners of a triangle run anticlockwise seen from the unstable side.

    ``points`` (point, 3) are x and y of the family and V [m/s]; ``triangles`` (triangle, 3) index them;
    ``kind`` (triangle,) is WEAVE or CAPSIZE, or NONE for what closes a gap between them that is too fine to
    be cut, or where the inertia is singular. ``upper`` and ``wall``
    (triangle,) tell what is an upper end V2, and what stands upright on a line in the plane. ``decay``
    (point,) is the lowest growth rate [s⁻¹] in the stable intervals of which the point is an end.
    """

    points: Floats
    triangles: Index
    kind: NDArray[np.uint8]
    upper: NDArray[np.bool_]
    wall: NDArray[np.bool_]
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
    delaunay: Delaunay = by_scipy,
) -> Mesh:
    """The boundary of the stable region within a box x × y × V [m/s] of a family.

    ``cells`` is the number of triangles along x and along y; what is smaller than a cell and bounded by
    no traced curve is not seen. ``delaunay`` makes triangles of points.
    """
    box = Box(family, np.array([x, y], dtype=float), V)
    samples = _TRACED * cells + 1
    curves, lines = trace(family, x, y, V, samples=samples), leaving(box, samples=samples)
    plane = partitioned(box, *triangulated(box, curves, lines, cells, delaunay))
    high = heights(box, plane)
    faces = shell(box, plane, high)
    corners, height = parted(faces.corners)
    return Mesh(
        np.column_stack([*box.real(plane.points[:, high.point[height]]), high.V[height]]),
        corners,
        faces.kind.astype(np.uint8),
        faces.side == UPPER,
        faces.side == WALL,
        _decay(box, plane, high)[height],
    )


def _decay(box: Box, plane: Partition, high: Heights) -> Floats:
    """The lowest growth rate [s⁻¹] (height,) of evenly spaced speeds in the intervals that end there."""
    record, interval = np.nonzero(high.at[0] >= 0)
    low, top = high.at[:, record, interval]
    V1, V2 = high.V[low], high.V[top]
    V = V1 + (V2 - V1) * np.linspace(0, 1, _SAMPLES)[:, np.newaxis]
    table = box.table(plane.points[:, high.owner[record]])
    rate = growth_rate_of(table[:, :, np.newaxis], V).min(axis=0)
    lowest = np.zeros(len(high.V))  # which it is at either end
    np.minimum.at(lowest, low, rate)
    np.minimum.at(lowest, top, rate)
    return lowest
