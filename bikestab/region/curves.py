"""The skeleton's curves traced through a box of the plane of designs: pieces with their ends."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from bikestab.family import Family
from bikestab.limits import MOST_SPEED
from bikestab.model import Floats
from bikestab.region.contours import contours, refined
from bikestab.region.events import Box, event_at
from bikestab.region.following import followed
from bikestab.region.pieces import NAMES, Curve, met, rejoined
from bikestab.region.skeleton import CurveName
from bikestab.region.space import SPATIAL, Space
from bikestab.region.spans import spans
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
    along its lines, so a closed piece smaller than a cell of this grid is not seen. Where damping or gains
    mix odd and even powers of V, curves at speeds between 0 and infinity are followed from there in space.
    """
    box = Box(family, np.array([x, y], dtype=float), V)
    nodes = np.linspace(0, 1, samples)
    keys, scales, found = [], [], []
    seeds: list[tuple[CurveName, Floats]] = []
    for key, values in box.values(np.array(np.meshgrid(nodes, nodes, indexing="ij"))).items():
        scale = np.abs(values).max()
        lines = contours((nodes, nodes), values / scale) if scale > 0 else []
        if key in SPATIAL and box.mixed:
            seeds += [(key, line.T) for line in lines]
            continue
        keys += [key] * len(lines)
        scales += [scale] * len(lines)
        found += lines
    spatial = _in_space(box, seeds, float(nodes[1]))
    lines = refined(partial(box.value_of_each, keys), found, (nodes, nodes))
    pieces: dict[CurveName, list[Curve]] = {}
    for key, line, zero in zip(keys, lines, _zeros(box, keys, scales, lines), strict=True):
        for stretch in _without_jumps(zero, line):
            pieces.setdefault(key, []).extend(stretches(box, key, stretch, float(nodes[1])))
    curves = [*spatial, *(curve for some in pieces.values() for curve in rejoined(some))]
    return met(curves, box.ends[:, 1] - box.ends[:, 0])


def _in_space(box: Box, seeds: list[tuple[CurveName, Floats]], step: float) -> list[Curve]:
    """The pieces of the curves of which there are points (2, n) near them."""
    found = [(key, points, event_at(box, key, points).V) for key, points in seeds]
    speeds = np.concatenate([V[V <= MOST_SPEED] for _, _, V in found]) if found else np.empty(0)
    if not len(speeds):
        return []
    space = Space(box, float(np.median(speeds)))
    points = np.concatenate([np.vstack([points, space.place(V)]) for _, points, V in found], axis=1)
    number = np.repeat(np.arange(len(found)), [len(V) for _, _, V in found])
    curve = np.array([SPATIAL.index(key) for key, _, _ in found])[number]
    some = np.concatenate([V <= MOST_SPEED for _, _, V in found])
    lines = followed(space, curve[some], points[:, some], number[some], step)
    return [piece for line in lines for piece in spans(space, line, step)]


def _zeros(
    box: Box, keys: list[CurveName], scales: list[float], lines: list[Floats]
) -> list[NDArray[np.bool_]]:
    """Where on lines (2, n) the functions of their curves are zero, relative to ``scales``."""
    if not lines:
        return []
    which = np.repeat(np.arange(len(lines)), [line.shape[1] for line in lines])
    values = box.value_of_each(keys, np.concatenate(lines, axis=1), which)
    zero = np.abs(values) <= _ZERO * np.array(scales)[which]
    return np.split(zero, np.flatnonzero(np.diff(which)) + 1)


def leaving(box: Box, *, samples: int) -> list[Floats]:
    """Lines (2, point), in units of the box, over which ends of stable intervals pass the box's speeds.

    Where they come to V = 0 there are curves of the skeleton instead. Lines are found as in ``trace``.
    """
    nodes = np.linspace(0, 1, samples)
    table = box.family.quick_table(*box.real(np.array(np.meshgrid(nodes, nodes, indexing="ij"))))
    speeds, names, found = [], [], []
    for V in box.V:
        for name in ("hurwitz3", "p0") if 0 < V < np.inf else ():
            lines = contours((nodes, nodes), getattr(conditions(table, V), name))
            speeds += [V] * len(lines)
            names += [name] * len(lines)
            found += lines
    weave = np.array(names) == "hurwitz3"

    def value(points: Floats, which: NDArray[np.intp]) -> Floats:
        p = conditions(box.table(points), np.array(speeds)[which])
        return np.where(weave[which], p.hurwitz3, p.p0)

    lines = []
    for line, V, name in zip(refined(value, found, (nodes, nodes)), speeds, names, strict=True):
        p = conditions(box.table(line), V)
        others = [values for other, values in p._asdict().items() if other != name]
        lines.append(line[:, np.min(others, axis=0) > 0])
    return lines


def _without_jumps(zero: NDArray[np.bool_], line: Floats) -> list[Floats]:
    """The stretches of a line (2, point) on which its function is zero, and does not jump."""
    cuts = np.flatnonzero(np.diff(zero)) + 1
    parts = np.split(np.arange(len(zero)), cuts)
    return [line[:, part] for part in parts if zero[part[0]]]
