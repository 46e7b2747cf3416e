"""Triangles seen from a point, as the pixels of a picture: what is nearer hides, or tints, what is behind it.

matplotlib sorts whole triangles by their middles, which shows sheets that nearly touch in stripes, and paints
the seams of clear ones twice.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

_SIDE = 640  # pixels of the longer side
_SAME = 1e-12  # depth, of two triangles on their common side
_LAYERS = 6  # of clear surfaces in front of each other, at most


class Raster(NamedTuple):
    """Pixels (row, column, RGBA), the first row at the bottom, and how deep what is not clear is."""

    pixels: Floats
    depth: Floats
    extent: tuple[float, float, float, float]  # left, right, bottom, top

    def hides(self, x: Floats, y: Floats, depth: Floats) -> NDArray[np.bool_]:
        """Whether points on the surfaces, or beside them, are behind what is not clear."""
        left, right, bottom, top = self.extent
        rows, columns = self.depth.shape
        row = ((y - bottom) / (top - bottom) * rows).astype(int)
        column = ((x - left) / (right - left) * columns).astype(int)
        around = [
            self.depth[np.clip(row + i, 0, rows - 1), np.clip(column + j, 0, columns - 1)]
            for i in (-1, 0, 1)
            for j in (-1, 0, 1)
        ]
        return depth > np.max(around, axis=0)


def rasterize(corners: Floats, colours: Floats) -> Raster:
    """Triangles (n, 3 corners, 3) with x, y and the depth in the picture, each in a colour RGBA (n, 4)."""
    low, high = corners[..., :2].min(axis=(0, 1)), corners[..., :2].max(axis=(0, 1))
    size = float((high - low).max()) / _SIDE or 1.0  # all in one point
    columns, rows = np.ceil((high - low) / size).astype(int) + 1
    pixel, triangle, depth = _fragments(corners, low, size, int(columns))
    order = np.argsort(-depth)  # the nearest is written last
    pixel, triangle, depth = pixel[order], triangle[order], depth[order]
    seen = np.zeros((rows * columns, 4))
    solid, front = np.full((2, rows * columns), np.inf)
    for _ in range(_LAYERS):
        nearest = np.full(rows * columns, -1)
        nearest[pixel] = np.arange(len(pixel))
        there = np.flatnonzero(nearest >= 0)
        which = nearest[there]
        colour = colours[triangle[which]]
        left = (1 - seen[there, 3]) * colour[:, 3]
        seen[there, :3] += left[:, np.newaxis] * colour[:, :3]
        seen[there, 3] += left
        ends = colour[:, 3] == 1
        solid[there[ends]] = depth[which[ends]]
        front[there] = depth[which]
        behind = np.isinf(solid[pixel]) & (depth > front[pixel] + _SAME)  # neighbours share pixels on a side
        pixel, triangle, depth = pixel[behind], triangle[behind], depth[behind]
        if not len(pixel):
            break
    seen[:, :3] /= np.maximum(seen[:, 3:], 1e-9)
    left_low = (float(low[0]), float(low[0] + columns * size), float(low[1]), float(low[1] + rows * size))
    return Raster(seen.reshape(rows, columns, 4), solid.reshape(rows, columns), left_low)


def _fragments(
    corners: Floats, low: Floats, size: float, columns: int
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
    """The pixels whose middle is in a triangle, which triangle that is, and how deep it is there."""
    at = (corners[..., :2] - low) / size - 0.5
    first = np.ceil(at.min(axis=1)).astype(int)
    span = np.maximum(np.floor(at.max(axis=1)).astype(int) - first + 1, 0)
    (ax, ay), (bx, by), (cx, cy) = (at[:, i].T for i in range(3))
    area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    number = np.where(area == 0, 0, span.prod(axis=1))  # none of those seen edge-on
    triangle = np.repeat(np.arange(len(at)), number)
    place = np.arange(len(triangle)) - np.repeat(np.cumsum(number) - number, number)
    width = span[triangle, 0]
    column = first[triangle, 0] + place % width
    row = first[triangle, 1] + place // width
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = np.stack([by - cy, cx - bx, cy - ay, ax - cx]) / area
    x, y = column - cx[triangle], row - cy[triangle]
    u = slopes[0, triangle] * x + slopes[1, triangle] * y
    v = slopes[2, triangle] * x + slopes[3, triangle] * y
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    triangle, u, v = triangle[inside], u[inside], v[inside]
    za, zb, zc = corners[..., 2].T
    depth = zc[triangle] + u * (za - zc)[triangle] + v * (zb - zc)[triangle]
    return row[inside] * columns + column[inside], triangle, depth
