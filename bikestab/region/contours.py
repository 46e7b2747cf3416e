"""Lines of the plane on which functions are zero: contours of a grid, moved onto the zero along its lines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from contourpy import contour_generator

from bikestab.model import Floats
from bikestab.region.onto import Several, between


def contours(nodes: tuple[Floats, Floats], values: Floats) -> list[Any]:
    """Lines (n, 2) on which ``values`` (u, v), interpolated in a grid, are zero, vertices on its lines."""
    return list(contour_generator(*nodes, values.T).lines(0.0))


def refined(value: Several, found: Sequence[Any], nodes: tuple[Floats, Floats]) -> list[Floats]:
    """Contours (n, 2) of evenly spaced ``nodes`` with each vertex moved onto the zero: lines (2, n)."""
    if not found:
        return []
    lines = [np.asarray(line).T for line in found]
    points = np.concatenate(lines, axis=1)
    which = np.repeat(np.arange(len(lines)), [line.shape[1] for line in lines])
    low, high = np.empty_like(points), np.empty_like(points)
    on_node = np.empty(points.shape, bool)
    for i, axis in enumerate(nodes):
        index = (points[i] - axis[0]) / (axis[-1] - axis[0]) * (len(axis) - 1)
        on_node[i] = np.abs(index - np.rint(index)) < 1e-9
        low[i] = axis[np.where(on_node[i], np.rint(index), np.floor(index)).astype(int)]
        high[i] = axis[np.where(on_node[i], np.rint(index), np.floor(index) + 1).astype(int)]
    changes = (np.sign(value(low, which)) * np.sign(value(high, which)) < 0) & ~on_node.all(axis=0)
    own = which[changes]
    moved = np.where(on_node, low, points)
    moved[:, changes] = between(lambda at, i: value(at, own[i]), low[:, changes], high[:, changes])
    new = np.split(moved, np.flatnonzero(np.diff(which)) + 1, axis=1)
    return [line[:, np.append(True, np.abs(np.diff(line, axis=1)).sum(axis=0) > 0)] for line in new]
