"""The stretches of a curve across which the stable intervals change, with their ends."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import pairwise

import numpy as np

from bikestab.model import Floats
from bikestab.region.contours import contours, refined
from bikestab.region.events import Box, event_at
from bikestab.region.onto import ROUNDS, Function, across
from bikestab.region.pieces import HOP, NAMES, Curve
from bikestab.region.skeleton import CurveName

NEAR_END = 4.0 * 1.5 ** np.arange(-9, 1)  # grid steps: where points are put towards an end of a curve
_SECTIONS = 64  # of a stretch of curve at a time, when an end is looked for in it
_ZERO = 1e-6  # of a curve's function at some distance: what is larger is not on the curve
_FINE = np.linspace(0, 1, _SECTIONS + 1)  # of a cell of the grid, where a curve turns within it
_SPARSE = 8  # every eighth of its points there is enough
_SAME = 1e-3  # of a cell: so close on its side, points are one


def stretches(box: Box, key: CurveName, points: Floats, step: float) -> Iterator[Curve]:
    """The stretches of a line across which the stable intervals change, all in the same way."""
    if points.shape[1] < 2:
        return
    closed = bool(np.abs(points[:, 0] - points[:, -1]).sum() < 1e-12)
    state = event_at(box, key, points).state
    if closed and len(np.unique(state)) > 1:  # start where something changes
        shift = int(np.flatnonzero(np.diff(state))[0]) + 1
        order = np.append(np.roll(np.arange(len(state) - 1), -shift), shift)
        points, state, closed = points[:, order], state[order], False
    for start, stop in pairwise([0, *(np.flatnonzero(np.diff(state)) + 1).tolist(), len(state)]):
        if not state[start]:
            continue
        run, ends = points[:, start:stop], ["closed", "closed"]
        left = [False, False]
        for side, (end, outside) in enumerate(((start, start - 1), (stop - 1, stop))):
            if 0 <= outside < len(state):
                ends[side], way = _end(box, key, points[:, [end, outside]], state[start], step)
                if np.abs(way[:, -1] - points[:, end]).max() > 1e-12:
                    run = np.column_stack([run, way] if side else [way[:, ::-1], run])
            elif not closed:
                left[side] = bool(((points[:, end] > 0) & (points[:, end] < 1)).all())
                ends[side] = _left(box, key, run, side) if left[side] else "box"
        if run.shape[1] > 1:
            run = _denser(box, key, run, (ends[0], ends[1]), step)
            V = event_at(box, key, run).V
            for met, at, inside in zip(ends, (0, -1), left, strict=True):
                if not inside:
                    V[at] = np.inf if met.endswith("infinity") else 0.0 if met.endswith("rest") else V[at]
            x, y = box.real(run)
            yield Curve(NAMES[key], x, y, V, bool(state[start] == 2), (ends[0], ends[1]))


def _left(box: Box, key: CurveName, run: Floats, side: int) -> str:
    """What a curve goes to whose speed leaves V > 0 within the last cell of the grid."""
    V = event_at(box, key, run[:, ::-1] if side else run).V
    own = "capsize" if "meet" in key else "weave"
    return f"{own} at infinity" if V[0] > V[min(2, len(V) - 1)] else f"{own} at rest"


def _end(box: Box, key: CurveName, pair: Floats, state: int, step: float) -> tuple[str, Floats]:
    """What a curve meets where, between two points (2, 2) of it, its event changes from ``state``.

    And the way there (2, n): more than its end where the curve turns within a cell of the grid.
    """
    way, value = pair[:, :0], partial(box.value, key)
    a = _change(box, key, pair, state)
    aside = np.array([[1.0], [-1.0]]) * np.diff(pair)[::-1]
    size = np.abs(value(np.column_stack([a, pair + aside, pair - aside])))
    if size[0] > _ZERO * size[1:].max():
        line = _in_cell(value, pair, step)
        same = event_at(box, key, line).state == state
        last = int(np.argmin(same)) - 1
        if last >= 0:
            a = _change(box, key, line[:, last : last + 2], state)
            way = line[:, last:0:-_SPARSE][:, ::-1]
        if np.any((a < 0) | (a > 1)):
            a = pair[:, 0]
    event = event_at(box, key, pair)
    way = np.column_stack([way, a])
    failing = np.flatnonzero(event.holds[:, 0] & ~event.holds[:, 1])
    if not len(failing):
        return "fold", way  # weave turns back on the curve, and what was closed no longer is
    met = event.ends[failing[0]]
    if met in ("weave", "capsize"):
        V = event_at(box, key, np.column_stack([a, pair[:, 0]])).V
        if 0.01 < V[0] / V[1] < 100:
            return HOP, way
        met += " at infinity" if V[0] > V[1] else " at rest"
    return NAMES.get(met, met), way


def _change(box: Box, key: CurveName, pair: Floats, state: int) -> Floats:
    """The place behind which, between two points (2, 2) of a curve, its event changes."""
    a, b = pair.T
    rounds = ROUNDS
    while np.abs(b - a).max() > 1e-15:
        points = a[:, np.newaxis] + (b - a)[:, np.newaxis] * np.linspace(0, 1, _SECTIONS + 1)
        points[:, 1:-1] = across(
            partial(box.value, key),
            points[:, 1:-1],
            (b - a)[:, np.newaxis],
            float(np.hypot(*(b - a))),
            rounds,
        )
        rounds = 1  # a chord of a section is by a factor of its square nearer to the curve
        same = event_at(box, key, points).state == state
        last = _SECTIONS - 1 if same.all() else max(int(np.argmin(same)) - 1, 0)
        if np.abs(points[:, last + 1] - points[:, last]).max() >= np.abs(b - a).max():
            break
        a, b = points[:, last], points[:, last + 1]
    return a


def _in_cell(value: Function, pair: Floats, step: float) -> Floats:
    """Points (2, n) of the curve that connects two (2, 2) on the sides of a cell of the grid within it.

    Those two alone where there is no such line.
    """
    low = np.floor(pair.min(axis=1) / step + 1e-6) * step
    nodes = low[0] + step * _FINE, low[1] + step * _FINE
    found = contours(nodes, value(np.array(np.meshgrid(*nodes, indexing="ij"))))
    for line in refined(lambda points, _: value(points), found, nodes):
        for way in (line, line[:, ::-1]):
            if np.abs(way[:, [0, -1]] - pair).max() < _SAME * step:
                return way
    return pair


def _denser(box: Box, key: CurveName, run: Floats, ends: tuple[str, str], step: float) -> Floats:
    """A run of points with more of them towards an end where it may touch another curve.

    They are at the same values of one coordinate on every curve that ends there, whose chords then do not
    cross each other; ``step`` is the grid's.
    """
    for side, end in enumerate(ends):
        if end in ("box", "closed", HOP):
            continue
        points = run[:, ::-1] if side else run
        away = points - points[:, :1]
        w = int(np.argmax(np.abs(away[:, 1])))
        way = away[w] * np.sign(away[w, 1])
        straight = int(np.argmin(np.append(np.diff(way) > 0, False)))  # as far as w goes on
        stations = NEAR_END * step
        stations = stations[stations <= 0.5 * way[straight]]  # the rest belongs to the other end
        last = int(np.argmax(way > stations[-1])) if len(stations) else 0
        new = np.empty((2, len(stations)))
        new[w] = points[w, 0] + stations * np.sign(away[w, 1])
        new[1 - w] = np.interp(stations, way[: straight + 1], points[1 - w, : straight + 1])
        along = np.zeros_like(new)
        along[w] = stations
        new = across(partial(box.value, key), new, along, step)
        run = np.column_stack([points[:, :1], new, points[:, max(last, 1) :]])
        run = run[:, ::-1] if side else run
    return run
