"""The stretches of a curve across which the stable intervals change, with their ends."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import pairwise

import numpy as np

from bikestab.model import Floats
from bikestab.region.events import Box, event_at
from bikestab.region.onto import ROUNDS, across
from bikestab.region.pieces import HOP, NAMES, Curve
from bikestab.region.skeleton import CurveName

_NEAR_END = 4.0 * 1.5 ** np.arange(-9, 1)  # grid steps: where points are put towards an end of a curve
_SECTIONS = 64  # of a stretch of curve at a time, when an end is looked for in it


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
                ends[side], point = _end(box, key, points[:, end], points[:, outside], state[start])
                if np.abs(point - points[:, end]).max() > 1e-12:
                    run = np.column_stack([run, point] if side else [point, run])
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


def _end(box: Box, key: CurveName, inside: Floats, outside: Floats, state: int) -> tuple[str, Floats]:
    """Where, between two points of a curve, its event changes from ``state``; and what it meets there."""
    a, b = inside, outside
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
    event = event_at(box, key, np.column_stack([inside, outside]))
    failing = np.flatnonzero(event.holds[:, 0] & ~event.holds[:, 1])
    if not len(failing):
        return "fold", a  # weave turns back on the curve, and what was closed no longer is
    met = event.ends[failing[0]]
    if met in ("weave", "capsize"):
        V = event_at(box, key, np.column_stack([a, inside])).V
        if 0.01 < V[0] / V[1] < 100:
            return HOP, a
        met += " at infinity" if V[0] > V[1] else " at rest"
    return NAMES.get(met, met), a


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
        stations = _NEAR_END * step
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
