"""Triangles as pixels: what is hidden, and what is seen between stripes."""

import numpy as np
import pytest
from matplotlib.path import Path

from bikestab.plot.raster import rasterize

RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
WHOLE, RISING, FALLING = 0, 1, -1


def square(depth, side=1.0):
    """Two triangles of a square."""
    a, b, c, d = (np.array([x * side, y * side, depth]) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return [[a, b, c], [a, c, d]]


def seen(*parts):
    corners = np.array([triangle for square_, _, _ in parts for triangle in square_])
    colours = np.array([colour for square_, colour, _ in parts for _ in square_])
    stripes = np.array([way for square_, _, way in parts for _ in square_])
    return rasterize(corners, colours, stripes)


def inner(raster):
    return raster.pixels[1:-2, 1:-2]


def test_what_is_nearer_hides():
    for order in (1, -1):
        raster = seen(*[(square(2.0), BLUE, WHOLE), (square(1.0), RED, WHOLE)][::order])
        assert np.all(inner(raster) == [*RED, 1])
    x = y = np.array([0.5, 0.5])
    assert raster.hides(x, y, np.array([1.5, 0.5])).tolist() == [True, False]


def test_between_stripes_what_is_behind_is_seen_in_its_own_colour():
    raster = seen((square(2.0), RED, WHOLE), (square(1.0), BLUE, RISING))
    pixels = inner(raster)
    blue, red = (np.all(pixels == [*colour, 1], axis=-1) for colour in (BLUE, RED))
    assert np.all(blue | red)
    assert 0.3 < blue.mean() < 0.45
    assert np.array_equal(blue[1:, 1:], blue[:-1, :-1])  # they rise to the right
    x = y = np.array([0.5])
    assert raster.hides(x, y, np.array([2.5]))
    assert not raster.hides(x, y, np.array([1.5]))


def test_stripes_that_fall_cross_those_that_rise():
    pixels = inner(seen((square(1.0), BLUE, FALLING), (square(2.0), RED, RISING)))
    blue, nothing = np.all(pixels == [*BLUE, 1], axis=-1), pixels[..., 3] == 0
    assert np.array_equal(blue[:-1, 1:], blue[1:, :-1])
    assert 0.3 < nothing.mean() < 0.45
    raster = seen((square(1.0), BLUE, FALLING))
    assert not raster.hides(np.array([0.5]), np.array([0.5]), np.array([9.0])).any()


def test_no_seams():
    pixels = inner(seen((square(1.0), BLUE, RISING)))
    there = pixels[..., 3] == 1
    assert np.array_equal(there[1:, 1:], there[:-1, :-1])  # on the diagonal too


def test_pixels_are_those_matplotlib_finds_inside():
    rng = np.random.default_rng(3)
    corners = np.column_stack([rng.random((3, 2)), [0.0, 1.0, 4.0]])[np.newaxis]
    raster = rasterize(corners, np.array([RED]), np.array([WHOLE]))
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
    alone = seen((square(1.0), RED, WHOLE))
    both = seen((square(1.0), RED, WHOLE), (edge_on, BLUE, WHOLE))
    assert np.array_equal(both.pixels, alone.pixels)
    assert np.array_equal(both.depth, alone.depth)
    point = rasterize(np.ones((2, 3, 3)), np.array([RED, RED]), np.array([WHOLE, RISING]))
    assert not point.pixels.any()
    assert np.isinf(point.depth).all()
    assert not point.hides(np.ones(1), np.ones(1), np.ones(1)).any()
