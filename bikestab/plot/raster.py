"""Triangles seen from a point, as the pixels of a picture: what is nearer hides what is behind it.

Between the stripes of those that are striped, what is behind is seen in its own colours. matplotlib sorts
whole triangles by their middles, which shows sheets that nearly touch in pieces.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

_SIDE = 900  # pixels of the longer side
_EVERY, _WIDE = 24, 9  # pixels from stripe to stripe along a row, and of each stripe


class Raster(NamedTuple):
    """Pixels (row, column, RGBA), the first row at the bottom, and how deep what is not striped is."""

    pixels: Floats
    depth: Floats
    extent: tuple[float, float, float, float]  # left, right, bottom, top

    def hides(self, x: Floats, y: Floats, depth: Floats) -> NDArray[np.bool_]:
        """Whether points on the surfaces, or beside them, are behind what is not striped."""
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


def rasterize(corners: Floats, colours: Floats, stripes: NDArray[np.integer]) -> Raster:
    """Triangles (n, 3 corners, 3) with x, y and the depth in the picture, each in a colour RGB (n, 3).

    ``stripes`` (n,) is 0 for a triangle that is whole, 1 and −1 for one of stripes that rise and fall to the
    right.
    """
    low, high = corners[..., :2].min(axis=(0, 1)), corners[..., :2].max(axis=(0, 1))
    size = float((high - low).max()) / _SIDE or 1.0  # all in one point
    columns, rows = np.ceil((high - low) / size).astype(int) + 1
    pixel, triangle, depth = _fragments(corners, low, size, int(columns))
    kind = stripes[triangle]
    there = (kind == 0) | ((pixel % columns - kind * (pixel // columns)) % _EVERY < _WIDE)
    pixel, triangle, depth, kind = pixel[there], triangle[there], depth[there], kind[there]
    order = np.argsort(-depth)  # the nearest is written last
    seen = np.zeros((rows * columns, 4))
    seen[pixel[order], :3] = colours[triangle[order]]
    seen[pixel, 3] = 1
    whole = order[kind[order] == 0]
    solid = np.full(rows * columns, np.inf)
    solid[pixel[whole]] = depth[whole]
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
