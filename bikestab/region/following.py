"""Curves followed in space, all at once, from points near them to where they leave the box or close."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.region.space import Space

Index = NDArray[np.intp]
_BEND = 0.3  # rad: by more a direction may not change in a step
_STRAIGHT = 0.1  # by less, the next step may be longer
_LEAST = 1e-5  # of the longest step: a curve that needs a shorter one ends
_ON = 0.05  # of a step: so short the last of Newton's method must be
_ROUNDS = 6  # of Newton's method to a curve,
_FEW = 2  # and of a step, which begins beside it
_SEEN = 1.5  # longest steps: a seed may be so far off its curve
_SAME = 0.1  # of a longest step: so near to a curve, a seed is on it
_LONGEST = 40  # sides of the box
_AGAIN = 20  # rounds of seeds that no curve has come by


class Line(NamedTuple):
    """A curve by its number, and its points (3, n); one that closes ends with its first point."""

    curve: int
    points: Floats


def followed(space: Space, curve: Index, seeds: Floats, group: Index, step: float) -> list[Line]:
    """The curves numbered ``curve`` (n,) that pass near points (3, n) of the unit box.

    They are followed by steps of that length at most; of each ``group`` (n,) of seeds, which may lie on one
    curve, one at a time.
    """
    start, _, moved = space.onto(curve, seeds, None, _ROUNDS)
    good = (moved < 1e-9) & (np.abs(start - seeds).max(axis=0) < _SEEN * step)
    good &= ((start >= 0) & (start <= 1)).all(axis=0)
    curve, seeds, group = curve[good], start[:, good], group[good]
    lines: list[Line] = []
    for _ in range(_AGAIN):
        if not len(curve):
            break
        chosen = _middles(group)
        rest = np.ones(len(curve), bool)
        for i, points in zip(
            chosen.tolist(), _lines(space, curve[chosen], seeds[:, chosen], step), strict=True
        ):
            if not rest[i] or points.shape[1] < 2:
                rest[i] = False
                continue
            lines.append(Line(int(curve[i]), _settled(space, int(curve[i]), points)))
            same = np.flatnonzero(rest & (curve == curve[i]))
            rest[same[_near(seeds[:, same], points, _SAME * step)]] = False
            rest[i] = False
        curve, seeds, group = curve[rest], seeds[:, rest], group[rest]
    return lines


def _middles(group: Index) -> Index:
    """The seed in the middle of each group."""
    order = np.argsort(group, kind="stable")
    _, first, count = np.unique(group[order], return_index=True, return_counts=True)
    return np.asarray(order[first + count // 2])


def _near(points: Floats, line: Floats, distance: float) -> NDArray[np.bool_]:
    """Which points (3, n) are so near to the segments of a line (3, m)."""
    a, way = line[:, :-1], np.diff(line, axis=1)
    found = np.zeros(points.shape[1], bool)
    for i, point in enumerate(points.T):
        off = point[:, np.newaxis] - a
        t = np.clip((off * way).sum(axis=0) / np.maximum((way**2).sum(axis=0), 1e-300), 0, 1)
        found[i] = ((off - t * way) ** 2).sum(axis=0).min() < distance**2
    return found


def _lines(space: Space, curve: Index, start: Floats, step: float) -> list[Floats]:
    """Curves (3, m) from seeds on them, both ways."""
    n = len(curve)
    _, along, _ = space.onto(curve, start, None, 1)
    both = np.tile(curve, 2)
    ways = _ways(space, both, np.tile(start, 2), np.concatenate([along, -along], axis=1), step)
    lines = []
    for ahead, behind in zip(ways[:n], ways[n:], strict=True):
        closed = ahead.shape[1] > 2 and bool((ahead[:, -1] == ahead[:, 0]).all())
        lines.append(ahead if closed else np.concatenate([behind[:, :0:-1], ahead], axis=1))
    return lines


def _ways(space: Space, curve: Index, start: Floats, along: Floats, longest: float) -> list[Floats]:
    """Each curve (3, m) from its start in a direction (3, n) to where it leaves the box or closes."""
    n = len(curve)
    parts: list[list[Floats]] = [[start[:, [i]]] for i in range(n)]
    at, step, gone = start.copy(), np.full(n, longest), np.zeros(n)
    busy = np.flatnonzero(np.isfinite(along).all(axis=0))
    while len(busy):
        ahead = at[:, busy] + step[busy] * along[:, busy]
        new, way, moved = space.onto(curve[busy], ahead, along[:, busy], _FEW)
        turn = (way * along[:, busy]).sum(axis=0)
        way = way * np.where(turn < 0, -1.0, 1.0)
        bend = np.arccos(np.clip(np.abs(turn), 0, 1))
        good = (moved < _ON * step[busy]) & (bend < _BEND) & np.isfinite(new).all(axis=0)
        inside = ((new >= 0) & (new <= 1)).all(axis=0)
        home = good & (gone[busy] > 2 * longest) & _passed(at[:, busy], new, start[:, busy])
        out = np.flatnonzero(good & ~inside & ~home)
        if len(out):  # where no face is met the curve turns before it: so short a step tells
            faces = _on_face(space, curve[busy[out]], at[:, busy[out]], new[:, out])
            leaves = np.isfinite(faces).all(axis=0)
            good[out[~leaves]] = False
            for k, last in zip(out[leaves], faces.T[leaves], strict=True):
                parts[busy[k]].append(last[:, np.newaxis])
        step[busy[~good]] *= 0.5
        stuck = step[busy] < _LEAST * longest
        for k in np.flatnonzero(good & inside & ~home):
            parts[busy[k]].append(new[:, [k]])
        for k in np.flatnonzero(home):
            parts[busy[k]].append(start[:, [busy[k]]])
        taken = busy[good]
        gone[taken] += step[taken]
        at[:, taken], along[:, taken] = new[:, good], way[:, good]
        step[taken] = np.where(bend[good] < _STRAIGHT, np.minimum(1.5 * step[taken], longest), step[taken])
        busy = busy[~(stuck | home | (good & ~inside)) & (gone[busy] < _LONGEST)]
    return [np.concatenate(each, axis=1) for each in parts]


def _settled(space: Space, curve: int, points: Floats) -> Floats:
    """A line's points to rounding; its ends stay in their planes."""
    settled, _, moved = space.onto(np.full(points.shape[1], curve), points, None, 2, exact=True)
    off = ~(moved < 1e-9)
    settled[:, off] = points[:, off]
    settled[:, [0, -1]] = points[:, [0, -1]]
    return settled


def _passed(before: Floats, after: Floats, point: Floats) -> NDArray[np.bool_]:
    """Whether steps come by points, in their direction."""
    way = after - before
    length = (way**2).sum(axis=0)
    t = ((point - before) * way).sum(axis=0) / length
    aside = point - before - t * way
    return (t >= 0) & (t <= 1) & ((aside**2).sum(axis=0) < 0.05 * length)


def _on_face(space: Space, curve: Index, inner: Floats, outer: Floats) -> Floats:
    """Where curves leave the unit box between two points: (3, n); NaN where that is not found."""
    way = outer - inner
    with np.errstate(all="ignore"):
        t = np.where(outer > 1, (1 - inner) / way, np.where(outer < 0, -inner / way, np.inf))
    axis = np.argmin(t, axis=0)
    each = np.arange(len(axis))
    t = t[axis, each]
    across = np.eye(3)[:, axis]
    found, _, moved = space.onto(curve, inner + t * way, across, _ROUNDS, exact=True)
    found[axis, each] = np.where(outer[axis, each] > 1, 1.0, 0.0)
    wrong = (moved > 1e-9) | ((found < -1e-12) | (found > 1 + 1e-12)).any(axis=0)
    found[:, wrong] = np.nan
    return np.clip(found, 0, 1)
