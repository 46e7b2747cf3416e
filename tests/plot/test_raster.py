"""Triangles as pixels: what is hidden, and colours behind clear ones."""

import numpy as np
import pytest
from matplotlib.path import Path

from bikestab.plot.raster import rasterize

RED, CLEAR_BLUE = (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.5)


def square(depth, side=1.0):
    """Two triangles of a square."""
    a, b, c, d = (np.array([x * side, y * side, depth]) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return [[a, b, c], [a, c, d]]


def middle(*parts):
    corners = np.array([triangle for square_, _ in parts for triangle in square_])
    colours = np.array([colour for square_, colour in parts for _ in square_])
    raster = rasterize(corners, colours)
    rows, columns = raster.depth.shape
    return raster, raster.pixels[rows // 2, columns // 3]


def test_what_is_nearer_hides():
    for order in (1, -1):
        raster, seen = middle(*[(square(2.0), CLEAR_BLUE), (square(1.0), RED)][::order])
        assert seen.tolist() == list(RED)
    x = y = np.array([0.5, 0.5])
    assert raster.hides(x, y, np.array([1.5, 0.5])).tolist() == [True, False]


def test_what_is_clear_tints():
    _, seen = middle((square(2.0), RED), (square(1.0), CLEAR_BLUE))
    assert seen == pytest.approx([0.5, 0, 0.5, 1])
    _, seen = middle((square(2.0), CLEAR_BLUE), (square(1.0), CLEAR_BLUE))
    assert seen == pytest.approx([0, 0, 1, 0.75])
    raster, _ = middle((square(1.0), CLEAR_BLUE))
    assert not raster.hides(np.array([0.5]), np.array([0.5]), np.array([9.0])).any()


def test_no_seams():
    raster, _ = middle((square(1.0), CLEAR_BLUE))
    assert set(raster.pixels[1:-2, 1:-2, 3].ravel()) == {0.5}  # on the diagonal too


def test_pixels_are_those_matplotlib_finds_inside():
    rng = np.random.default_rng(3)
    corners = np.column_stack([rng.random((3, 2)), [0.0, 1.0, 4.0]])[np.newaxis]
    raster = rasterize(corners, np.array([RED]))
    left, right, bottom, top = raster.extent
    rows, columns = raster.depth.shape
    x = left + (np.arange(columns) + 0.5) * (right - left) / columns
    y = bottom + (np.arange(rows) + 0.5) * (top - bottom) / rows
    points = np.stack(np.meshgrid(x, y), axis=-1)
    inside = Path(corners[0, :, :2]).contains_points(points.reshape(-1, 2)).reshape(rows, columns)
    assert np.count_nonzero(inside != np.isfinite(raster.depth)) <= 2
    plane = np.linalg.solve(np.column_stack([corners[0, :, :2], np.ones(3)]), corners[0, :, 2])
    both = inside & np.isfinite(raster.depth)
    assert raster.depth[both] == pytest.approx((points @ plane[:2] + plane[2])[both], abs=1e-9)


@pytest.mark.filterwarnings("error")
def test_what_is_seen_edge_on_is_not_there():
    """A triangle whose corners are in one line of the picture covers no pixel, one point none at all."""
    edge_on = [[[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.5, 0.5, -1.0]]]
    alone, _ = middle((square(1.0), RED))
    both, _ = middle((square(1.0), RED), (edge_on, CLEAR_BLUE))
    assert np.array_equal(both.pixels, alone.pixels)
    assert np.array_equal(both.depth, alone.depth)
    point = rasterize(np.ones((2, 3, 3)), np.array([RED, RED]))
    assert not point.pixels.any()
    assert np.isinf(point.depth).all()
    assert not point.hides(np.ones(1), np.ones(1), np.ones(1)).any()
