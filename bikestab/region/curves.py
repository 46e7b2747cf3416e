"""The skeleton's curves traced through a box of the plane of designs: pieces with their ends."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple, get_args

import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray
from scipy.optimize import elementwise

from bikestab.errors import ScanError
from bikestab.family import Family
from bikestab.model import Floats
from bikestab.region.events import Box, event_at
from bikestab.region.skeleton import CurveName

NAMES: dict[CurveName, str] = {name: name for name in get_args(CurveName)} | {
    "crossing": "fold",  # of two weave speeds, by the weave surface crossing itself
    "meet": "weave meets capsize",
    "slow meet": "weave meets capsize",  # at zero frequency
}
_SAMPLES = 401  # per axis of the grid whose sign changes are followed
_NEAR_END = 4.0 * 1.5 ** np.arange(-9, 1)  # grid steps: where points are put towards an end of a curve
_HOP = "hop"  # the end of a piece whose line went on along another branch of the same function
_ZERO = 1e-6  # of a function's largest value: more is a jump, not a zero
_SAME = 1e-6  # of the box: the uncertainty of a point where curves touch
_SECTIONS = 64  # of a stretch of curve at a time, when an end is looked for in it


class Curve(NamedTuple):
    """One connected piece of a curve across which the stable intervals change.

    ``name`` is a value of NAMES. ``x`` and ``y`` of the family and ``V`` [m/s], shape (point,), are on
    the curve to rounding; V is where it happens: inf for a root that leaves upwards, NaN where p4 = 0.
    ``closes`` tells whether an interval closes there, V1 = V2; else two meet, or one gets another end.
    ``ends`` says what stops the piece at its first and last point: ``box``, ``closed``, or the name of
    another curve.
    """

    name: str
    x: Floats
    y: Floats
    V: Floats
    closes: bool
    ends: tuple[str, str]

    def reversed(self) -> Curve:
        """The same from its other end."""
        x, y, V = (values[::-1].copy() for values in (self.x, self.y, self.V))
        return Curve(self.name, x, y, V, self.closes, (self.ends[1], self.ends[0]))


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
    along its lines, so a closed piece smaller than a cell of this grid is not seen. Raises ScanError if
    a zero cannot be refined.
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
            for line in _refined(box, key, [np.asarray(line).T for line in lines], nodes):
                for stretch in _without_jumps(np.abs(box.value(key, line)) <= _ZERO * scale, line):
                    pieces.extend(_pieces(box, key, stretch, float(nodes[1])))
            found.extend(_rejoined(pieces))
    return _meeting(found, box)


def _refined(box: Box, key: CurveName, lines: list[Floats], nodes: Floats) -> list[Floats]:
    """Contour vertices (2, n), each on a line of the grid, moved along it onto the zero."""

    def value(t: Floats, *ends: Floats) -> Floats:
        low, high = np.array(ends).reshape(2, 2, -1)
        return box.value(key, low + t * (high - low))

    if not lines:
        return []
    points = np.concatenate(lines, axis=1)
    index = points * (len(nodes) - 1)
    on_node = np.abs(index - np.rint(index)) < 1e-9
    low = nodes[np.where(on_node, np.rint(index), np.floor(index)).astype(int)]
    high = nodes[np.where(on_node, np.rint(index), np.floor(index) + 1).astype(int)]
    zero, one = np.zeros(points.shape[1]), np.ones(points.shape[1])
    moving = np.sign(value(zero, *low, *high)) * np.sign(value(one, *low, *high)) < 0
    moving &= ~on_node.all(axis=0)
    root = elementwise.find_root(
        value, (zero[moving], one[moving]), args=(*low[:, moving], *high[:, moving]),
        tolerances={"xatol": 1e-16, "xrtol": 1e-15},
    )  # fmt: skip
    t = (points - low)[np.argmax(high - low, axis=0), np.arange(len(zero))] * (len(nodes) - 1)
    if not root.success.all():
        raise ScanError(f"the curve {key!r} could not be refined everywhere; please report this")
    t[moving] = root.x
    moved = np.split(low + t * (high - low), np.cumsum([line.shape[1] for line in lines])[:-1], axis=1)
    return [line[:, np.append(True, np.abs(np.diff(line, axis=1)).sum(axis=0) > 0)] for line in moved]


def _without_jumps(zero: NDArray[np.bool_], line: Floats) -> list[Floats]:
    """The stretches of a line (2, point) on which its function is zero, and does not jump."""
    cuts = np.flatnonzero(np.diff(zero)) + 1
    parts = np.split(np.arange(len(zero)), cuts)
    return [line[:, part] for part in parts if zero[part[0]]]


def _pieces(box: Box, key: CurveName, points: Floats, step: float) -> Iterator[Curve]:
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
    while np.abs(b - a).max() > 1e-15:
        points = a[:, np.newaxis] + (b - a)[:, np.newaxis] * np.linspace(0, 1, _SECTIONS + 1)
        points[:, 1:-1] = _onto(box, key, points[:, 1:-1], (b - a)[:, np.newaxis], float(np.hypot(*(b - a))))
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
            return _HOP, a
        met += " at infinity" if V[0] > V[1] else " at rest"
    return NAMES.get(met, met), a


def _rejoined(pieces: list[Curve]) -> list[Curve]:
    """Pieces put together again where their line hopped to a branch of negative speeds that crosses them."""
    whole = [piece for piece in pieces if _HOP not in piece.ends]
    broken = [piece for piece in pieces if _HOP in piece.ends]
    while broken:
        first = broken.pop(0)
        if first.ends[1] != _HOP:
            first = first.reversed()
        last = np.array([first.x[-1], first.y[-1]])
        others = [
            (other, i)
            for i, piece in enumerate(broken)
            for other in (piece, piece.reversed())
            if other.ends[0] == _HOP
        ]
        if not others:
            start = first.name if first.ends[0] == _HOP else first.ends[0]
            whole.append(first._replace(ends=(start, first.name)))
            continue
        second, i = min(others, key=lambda pair: np.hypot(pair[0].x[0] - last[0], pair[0].y[0] - last[1]))
        broken.pop(i)
        x, y, V = (
            np.append(a[:-1], b[1:])
            for a, b in ((first.x, second.x), (first.y, second.y), (first.V, second.V))
        )
        joined = Curve(first.name, x, y, V, first.closes, (first.ends[0], second.ends[1]))
        (broken if _HOP in joined.ends else whole).append(joined)
    return whole


def _denser(box: Box, key: CurveName, run: Floats, ends: tuple[str, str], step: float) -> Floats:
    """A run of points with more of them towards an end where it may touch another curve.

    They are at the same values of one coordinate on every curve that ends there, whose chords then do not
    cross each other; ``step`` is the grid's.
    """
    for side, end in enumerate(ends):
        if end in ("box", "closed", _HOP):
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
        run = np.column_stack([points[:, :1], _onto(box, key, new, along, step), points[:, max(last, 1) :]])
        run = run[:, ::-1] if side else run
    return run


def _onto(box: Box, key: CurveName, points: Floats, along: Floats, most: float) -> Floats:
    """Points (2, n) near a curve, moved onto it across the directions ``along``, by no more than ``most``."""
    length = np.hypot(*along)
    across = np.array([-along[1], along[0]]) / length
    for _ in range(4):
        h = 1e-3 * length
        here, above, below = (box.value(key, points + e * across) for e in (0.0, h, -h))
        with np.errstate(divide="ignore", invalid="ignore"):
            move = 2 * h * here / (above - below)
        points = points - np.where(np.abs(move) < most, move, 0.0) * across
    return points


def _meeting(curves: list[Curve], box: Box) -> list[Curve]:
    """Curves that meet get one common point there.

    Where they touch, rounding leaves its place along them uncertain; curves at infinity or rest cross.
    """
    ends = [(i, at) for i, curve in enumerate(curves) for at in (0, -1)]
    ends.sort(key=lambda end: not curves[end[0]].name.endswith(("infinity", "rest")))
    size = box.ends[:, 1] - box.ends[:, 0]
    common: list[Floats] = []
    for i, at in ends:
        x, y = curves[i].x, curves[i].y
        here = np.array([x[at], y[at]])
        near = [point for point in common if np.abs((point - here) / size).max() < _SAME]
        x[at], y[at] = near[0] if near else here
        if not near:
            common.append(here)
    return curves
