"""The spans of a curve followed in space across which the stable intervals change, with their ends."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import cast

import numpy as np
from numpy.typing import NDArray

from bikestab.limits import MOST_SPEED
from bikestab.model import Floats
from bikestab.region.events import Event, event_at
from bikestab.region.following import Line
from bikestab.region.pieces import LOST, NAMES, Curve
from bikestab.region.skeleton import CurveName
from bikestab.region.space import SPATIAL, Space
from bikestab.region.stretches import NEAR_END

_BESIDE = 1e-2  # of a step: so far from an end of a line its event is looked at, for rounding at V = 0 and ∞
_SECTIONS = 64  # of a step at a time, where an event changes in it
_TOLD = 2e4  # m/s: at higher speeds rounding of the slopes by V would tell whether an interval closes
_ROUNDS = 3  # of Newton's method: from a section's chord to rounding


def spans(space: Space, line: Line, step: float) -> Iterator[Curve]:
    """The parts of a line across which the stable intervals change, all in the same way."""
    points, closed = line.points, bool((line.points[:, 0] == line.points[:, -1]).all())
    told = np.inf if (points[2, [0, -1]] == 1).any() else _TOLD  # what goes on to infinity is told there
    beside = _beside(space, line.curve, points)
    state = _as_told(space.speed(beside[2]), _event(space, line.curve, beside).state, told)
    if closed and len(np.unique(state)) > 1:  # start where something changes
        shift = int(np.flatnonzero(np.diff(state))[0]) + 1
        order = np.append(np.roll(np.arange(len(state) - 1), -shift), shift)
        points, state, closed = points[:, order], state[order], False
        beside = points
    for start, stop in pairwise([0, *(np.flatnonzero(np.diff(state)) + 1).tolist(), len(state)]):
        if not state[start]:
            continue
        run, ends = points[:, start:stop], ["closed", "closed"]
        for side, (end, outside) in enumerate(((start, start - 1), (stop - 1, stop))):
            if 0 <= outside < len(state):
                ends[side], last = _end(space, line.curve, beside[:, [end, outside]], state[start], told)
                run = np.column_stack([run, last] if side else [last, run])
            elif not closed:
                ends[side] = _left(space, line.curve, points[:, end])
        run = _denser(space, line.curve, run, (ends[0], ends[1]), step)
        if run.shape[1] > 1 and space.speed(run[2]).min() <= MOST_SPEED:
            x, y = space.box.real(run[:2])
            closes = bool(state[start] == 2)
            yield Curve(NAMES[SPATIAL[line.curve]], x, y, space.speed(run[2]), closes, (ends[0], ends[1]))


def _beside(space: Space, curve: int, points: Floats) -> Floats:
    """Points of a line, and just beside its ends instead of these, which may be at V = 0 or infinity."""
    way = points[:, [1, -2]] - points[:, [0, -1]]
    start = points[:, [0, -1]] + _BESIDE * way
    beside, _, moved = space.onto(np.full(2, curve), start, way, _ROUNDS, exact=True)
    points = points.copy()
    points[:, [0, -1]] = np.where(moved < _BESIDE, beside, points[:, [1, -2]])
    return points


def _as_told(V: Floats, state: NDArray[np.intp], told: float) -> NDArray[np.intp]:
    """States at points of a line at speeds V: beyond ``told`` those of the nearest below it, or of most."""
    known = np.flatnonzero(told >= V)
    if len(known):
        nearest = known[np.abs(np.arange(len(V))[:, np.newaxis] - known).argmin(axis=1)]
        state = state[nearest]
    else:
        state = np.full(len(V), np.bincount(state).argmax())
    return np.where((told < V) & (MOST_SPEED < V), 0, state)


def _event(space: Space, curve: int, points: Floats) -> Event:
    event = event_at(space.box, SPATIAL[curve], points[:2], space.speed(points[2]))
    if SPATIAL[curve] != "fold":
        return event
    # a crossing has a double root of hurwitz3, too; a fold becomes one where two pairs are equal
    alone = ~space.crossed(points)
    return event._replace(holds=np.vstack([alone, event.holds]), ends=("crossing", *event.ends))


def _left(space: Space, curve: int, point: Floats) -> str:
    """What a line goes to where it leaves the box, or has no direction any more: a fold at a crossing."""
    if ((point > 0) & (point < 1)).all():
        crossing = SPATIAL[curve] == "fold" and space.crossed(point[:, np.newaxis])[0]
        return NAMES["crossing"] if crossing else LOST
    own = "capsize" if "meet" in SPATIAL[curve] else "weave"
    return {0.0: f"{own} at rest", 1.0: f"{own} at infinity"}.get(float(point[2]), "box")


def _end(space: Space, curve: int, pair: Floats, state: int, told: float) -> tuple[str, Floats]:
    """What a curve meets where, between two points (3, 2) of it, its event changes from ``state``."""
    a, b = pair.T
    which, rounds = np.full(_SECTIONS + 1, curve), _ROUNDS
    across = np.repeat((b - a)[:, np.newaxis], _SECTIONS + 1, axis=1)
    while np.abs(b - a).max() > 1e-15:
        chord = a[:, np.newaxis] + (b - a)[:, np.newaxis] * np.linspace(0, 1, _SECTIONS + 1)
        points, _, _ = space.onto(which, chord, across, rounds, exact=True)
        points = np.where(np.isfinite(points).all(axis=0), points, chord)
        rounds = 1  # a chord of a section is by a factor of its square nearer to the curve
        V = space.speed(points[2])
        same = np.where(told < V, MOST_SPEED >= V, _event(space, curve, points).state == state)
        last = _SECTIONS - 1 if same.all() else max(int(np.argmin(same)) - 1, 0)
        if np.abs(points[:, last + 1] - points[:, last]).max() >= np.abs(b - a).max():
            break
        a, b = points[:, last], points[:, last + 1]
    if space.speed(pair[2, 1]) > told:
        return "box", a
    event = _event(space, curve, pair)
    failing = np.flatnonzero(event.holds[:, 0] & ~event.holds[:, 1])
    met = event.ends[failing[0]] if len(failing) else "fold"  # where weave turns back on the curve
    return NAMES.get(cast("CurveName", met), met), a


def _denser(space: Space, curve: int, run: Floats, ends: tuple[str, str], step: float) -> Floats:
    """A run of points with more of them towards an end where it may touch another curve.

    They are at the same values of one coordinate on every curve that ends there, whose chords then do not
    cross each other; ``step`` is the grid's.
    """
    for side, end in enumerate(ends):
        if end in ("box", "closed", LOST) or run.shape[1] < 3:
            continue
        points = run[:, ::-1] if side else run
        away = points[:2] - points[:2, :1]
        axis = int(np.argmax(np.abs(away[:, 1])))
        way = away[axis] * np.sign(away[axis, 1])
        straight = int(np.argmin(np.append(np.diff(way) > 0, False)))  # as far as it goes on
        stations = NEAR_END * step
        stations = stations[stations <= 0.5 * way[straight]]  # the rest belongs to the other end
        if not len(stations):
            continue
        last = int(np.argmax(way > stations[-1]))
        root = np.sqrt(way[: straight + 1])  # at a cusp V goes with it
        new = np.array([np.interp(np.sqrt(stations), root, each[: straight + 1]) for each in points])
        new[axis] = points[axis, 0] + stations * np.sign(away[axis, 1])
        across = np.repeat(np.eye(3)[:, [axis]], len(stations), axis=1)
        start = new.copy()
        new, _, moved = space.onto(np.full(len(stations), curve), new, across, 2 * _ROUNDS, exact=True)
        new = new[:, (moved < 1e-9) & (np.abs(new - start).max(axis=0) < step)]
        run = np.column_stack([points[:, :1], new, points[:, max(last, 1) :]])
        run = run[:, ::-1] if side else run
    return run
