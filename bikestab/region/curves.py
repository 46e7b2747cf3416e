"""The skeleton's curves traced through a box of the plane of designs: pieces with their ends."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.region.events import Box
from bikestab.region.onto import Function, between
from bikestab.region.pieces import NAMES, Curve, met, rejoined
from bikestab.region.stretches import stretches
from bikestab.routh import conditions

__all__ = ["NAMES", "Curve", "trace"]

_SAMPLES = 401  # per axis of the grid whose sign changes are followed
_ZERO = 1e-6  # of a function's largest value: more is a jump, not a zero


def trace(
    family: Family,
    x: tuple[float, float],
    y: tuple[float, float],
    V: tuple[float, float] = (0.0, np.inf),
    *,
    samples: int = _SAMPLES,
) -> list[Curve]:
    """Every piece of every curve in a box x × y × V [m/s] of a family.

    Sign changes of the curve functions between the nodes of a grid (``samples`` per axis) are refined
    along its lines, so a closed piece smaller than a cell of this grid is not seen.
    """
    box = Box(family, np.array([x, y], dtype=float), V)
    nodes = np.linspace(0, 1, samples)
    functions = box.values(np.array(np.meshgrid(nodes, nodes, indexing="ij")))
    found: list[Curve] = []
    for key, values in functions.items():
        scale = np.abs(values).max()
        if scale > 0:
            lines = contour_generator(nodes, nodes, (values / scale).T).lines(0.0)
            pieces: list[Curve] = []
            for line in _refined(partial(box.value, key), lines, nodes):
                for stretch in _without_jumps(np.abs(box.value(key, line)) <= _ZERO * scale, line):
                    pieces.extend(stretches(box, key, stretch, float(nodes[1])))
            found.extend(rejoined(pieces))
    return met(found, box.ends[:, 1] - box.ends[:, 0])


def leaving(box: Box, *, samples: int) -> list[Floats]:
    """Lines (2, point), in units of the box, over which ends of stable intervals pass the box's speeds.

    Where they come to V = 0 there are curves of the skeleton instead. Lines are found as in ``trace``.
    """
    nodes = np.linspace(0, 1, samples)
    grid = np.array(np.meshgrid(nodes, nodes, indexing="ij"))
    table = box.family.quick_table(*box.real(grid))
    found = []
    for V in box.V:
        for name in ("hurwitz3", "p0") if 0 < V < np.inf else ():

            def value(points: Floats, name: str = name, V: float = V) -> Floats:
                return getattr(conditions(box.table(points), V), name)

            lines = contour_generator(nodes, nodes, getattr(conditions(table, V), name).T).lines(0.0)
            for line in _refined(value, lines, nodes):
                p = conditions(box.table(line), V)
                others = [values for other, values in p._asdict().items() if other != name]
                found.append(line[:, np.min(others, axis=0) > 0])
    return found


def _refined(value: Function, found: Sequence[Any], nodes: Floats) -> list[Floats]:
    """Contour vertices (n, 2), each on a line of the grid, moved along it onto the zero: lines (2, n)."""
    if not found:
        return []
    lines = [np.asarray(line).T for line in found]
    points = np.concatenate(lines, axis=1)
    index = points * (len(nodes) - 1)
    on_node = np.abs(index - np.rint(index)) < 1e-9
    low = nodes[np.where(on_node, np.rint(index), np.floor(index)).astype(int)]
    high = nodes[np.where(on_node, np.rint(index), np.floor(index) + 1).astype(int)]
    changes = (np.sign(value(low)) * np.sign(value(high)) < 0) & ~on_node.all(axis=0)
    moved = np.where(on_node, low, points)
    moved[:, changes] = between(value, low[:, changes], high[:, changes])
    new = np.split(moved, np.cumsum([line.shape[1] for line in lines])[:-1], axis=1)
    return [line[:, np.append(True, np.abs(np.diff(line, axis=1)).sum(axis=0) > 0)] for line in new]


def _without_jumps(zero: NDArray[np.bool_], line: Floats) -> list[Floats]:
    """The stretches of a line (2, point) on which its function is zero, and does not jump."""
    cuts = np.flatnonzero(np.diff(zero)) + 1
    parts = np.split(np.arange(len(zero)), cuts)
    return [line[:, part] for part in parts if zero[part[0]]]
