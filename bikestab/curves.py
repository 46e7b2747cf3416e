"""The skeleton's curves traced through a box of the (λ, σ) plane: pieces with their ends."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple, get_args

import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray
from scipy.optimize import elementwise

from bikestab.bicycle import Bicycle
from bikestab.model import Floats, Model, characteristic_table
from bikestab.roots import positive_roots
from bikestab.routh import conditions
from bikestab.skeleton import CurveName, Skeleton, curve_functions, reduced
from bikestab.speeds import stable_intervals

NAMES: dict[CurveName, str] = {name: name for name in get_args(CurveName)} | {
    "crossing": "fold",  # of two weave speeds, by the weave surface crossing itself
    "meet": "weave meets capsize",
    "slow meet": "weave meets capsize",  # at zero frequency
}
_SAMPLES = 401  # per axis of the grid whose sign changes are followed
_SAME = 1e-6  # of the box: the uncertainty of a point where curves touch
_SECTIONS = 64  # of a stretch of curve at a time, when an end is looked for in it


class Curve(NamedTuple):
    """One connected piece of a curve across which the stable intervals change.

    ``name`` is a value of NAMES. ``lam`` [rad], ``sigma`` [1] and ``V`` [m/s], shape (point,), are on
    the curve to rounding; V is where it happens: inf for a root that leaves upwards, NaN where p4 = 0.
    ``closes`` tells whether V1 = V2 there, so that an interval ends to exist. ``ends`` says what
    stops the piece at its first and last point: ``box``, ``closed``, or the name of another curve.
    """

    name: str
    lam: Floats
    sigma: Floats
    V: Floats
    closes: bool
    ends: tuple[str, str]


def trace(
    bicycle: Bicycle,
    lam: tuple[float, float],
    sigma: tuple[float, float],
    *,
    model: Model = "refined",
    samples: int = _SAMPLES,
) -> list[Curve]:
    """Every piece of every curve in a box λ [rad] × σ [1].

    Sign changes of the curve functions between the nodes of a grid (``samples`` per axis) are refined
    along its lines, so a closed piece smaller than a cell of this grid is not seen.
    """
    box = _Box(bicycle, model, np.array([lam, sigma], dtype=float))
    nodes = np.linspace(0, 1, samples)
    functions = curve_functions(box.table(np.array(np.meshgrid(nodes, nodes, indexing="ij"))))
    found: list[Curve] = []
    for key, values in functions.items():
        scale = np.abs(values).max()
        if scale > 0:
            lines = contour_generator(nodes, nodes, (values / scale).T).lines(0.0)
            for line in _refined(box, key, [np.asarray(line).T for line in lines], nodes):
                found.extend(_pieces(box, key, line))
    return _meeting(found, box)


class _Box(NamedTuple):
    """The box with coordinates (u, v) from 0 to 1; ``ends`` are its λ and σ, shape (2, 2)."""

    bicycle: Bicycle
    model: Model
    ends: Floats

    def real(self, points: Floats) -> Floats:
        low, high = self.ends.T.reshape(2, 2, *(1,) * (points.ndim - 1))
        return low + (high - low) * points

    def table(self, points: Floats) -> Floats:
        return characteristic_table(self.bicycle, *self.real(points), model=self.model)

    def value(self, key: CurveName, points: Floats) -> Floats:
        return curve_functions(self.table(points), [key])[key]


def _refined(box: _Box, key: CurveName, lines: list[Floats], nodes: Floats) -> list[Floats]:
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
    moving = (value(zero, *low, *high) * value(one, *low, *high) < 0) & ~on_node.all(axis=0)
    root = elementwise.find_root(
        value, (zero[moving], one[moving]), args=(*low[:, moving], *high[:, moving]),
        tolerances={"xatol": 1e-16, "xrtol": 1e-15},
    )  # fmt: skip
    t = (points - low)[np.argmax(high - low, axis=0), np.arange(len(zero))] * (len(nodes) - 1)
    t[moving] = root.x
    moved = np.split(low + t * (high - low), np.cumsum([line.shape[1] for line in lines])[:-1], axis=1)
    return [line[:, np.append(True, np.abs(np.diff(line, axis=1)).sum(axis=0) > 0)] for line in moved]


class _Event(NamedTuple):
    """What happens at points of a curve: where, and which other conditions must hold to matter.

    ``V`` (point,); ``holds`` and ``ends`` name, for each of these conditions, whether it does (condition,
    point) and which curve a piece meets where it ceases to; ``closes`` (point,).
    """

    V: Floats
    holds: NDArray[np.bool_]
    ends: tuple[str, ...]
    closes: NDArray[np.bool_]

    @property
    def matters(self) -> NDArray[np.bool_]:
        return np.logical_and.reduce(self.holds)


def _event(box: _Box, key: CurveName, points: Floats) -> _Event:
    table = box.table(points)
    found = reduced(table)
    if key.endswith(("infinity", "rest")):
        return _event_at_an_end(key, found)
    if key == "singular inertia":
        return _event_of_inertia(box, points)
    V = _speed(key, found)
    exists = np.isfinite(V)
    with np.errstate(invalid="ignore"):
        p = conditions(table, V)
        slopes = [
            getattr(conditions(table, V * (1 + 1e-6)), name)
            - getattr(conditions(table, V * (1 - 1e-6)), name)
            for name in ("p0", "hurwitz3")
        ]
        needed = {
            "fold": {"weave": exists, "meet": (p.p0 > 0) & (p.p1 > 0), "crossing": p.p3 > 0},
            "crossing": {"weave": exists, "meet": p.p0 > 0, "fold": (p.p2 > 0) & (p.p2**2 > 4 * p.p4 * p.p0)},
            "meet": {"capsize": exists, "slow meet": p.p1 > 0, "crossing": p.p3 > 0},
            "slow meet": {"capsize": exists, "meet": p.p2 > 0, "crossing": p.p3 > 0},
        }[key] | {"singular inertia": p.p4 > 0}
        closes = np.full(len(V), True) if key in ("fold", "crossing") else slopes[0] * slopes[1] < 0
    return _Event(V, np.array(list(needed.values())), tuple(needed), closes)


def _event_at_an_end(key: CurveName, found: Skeleton) -> _Event:
    """A root of p0 or hurwitz3 leaves to infinity or to rest: the others must be positive there."""
    infinite = key.endswith("infinity")
    at = -1 if infinite else 0
    own = "p0" if key.startswith("capsize") else "hurwitz3"
    names = [name for name in ("p0", "p1", "p2", "p3", "p4", "hurwitz3") if name != own]
    values = np.array([found.polynomials[name][at] for name in names])
    # p1 is a factor of hurwitz3's coefficient, and then zero but for rounding
    allowed = np.array(
        [1e-9 * np.abs(v).max() if name == "p1" else 0.0 for name, v in zip(names, values, strict=True)]
    )
    where = key.split(" ", 1)[1]
    ends = {
        "p0": f"capsize {where}",
        "hurwitz3": f"weave {where}",
        "p1": f"weave {where}",
        "p4": "singular inertia",
    }
    V = np.full(values.shape[1], np.inf if infinite else 0.0)
    return _Event(
        V, values > -allowed[:, np.newaxis], tuple(ends.get(name, "crossing") for name in names), V < 0
    )


def _event_of_inertia(box: _Box, points: Floats) -> _Event:
    """All motion becomes unstable where p4 changes sign."""
    along = np.gradient(points, axis=1) if points.shape[1] > 1 else np.ones_like(points)
    aside = np.array([-along[1], along[0]]) / np.maximum(np.hypot(*along), 1e-300) * 1e-7
    number = [stable_intervals(box.table(points + sign * aside)).number for sign in (1, -1)]
    V = np.full(points.shape[1], np.nan)
    return _Event(V, (number[0] != number[1])[np.newaxis], ("weave",), np.zeros(len(V), bool))


def _speed(key: CurveName, found: Skeleton) -> Floats:
    """The speed [m/s] (point,) at which two of the conditions vanish together; NaN where none is."""
    weave, p0, p1, p3, q = (found.polynomials[name] for name in ("hurwitz3", "p0", "p1", "p3", "q"))
    j = np.arange(len(weave))[:, np.newaxis]
    candidates, other = {
        "fold": ((j * weave)[1:], weave),
        "crossing": (p1, p3),
        "meet": (p0, q),
        "slow meet": (p0, p1),
    }[key]
    signs = np.where(np.arange(len(candidates)) % 2, -1.0, 1.0)[:, np.newaxis]
    x = np.concatenate([positive_roots(candidates), -positive_roots(candidates * signs)])
    if not len(x):
        return np.full(p0.shape[1], np.nan)
    j = np.arange(len(other)).reshape(-1, 1, 1)
    with np.errstate(invalid="ignore"):
        terms = other[:, np.newaxis] * x**j
        residual = np.abs(terms.sum(axis=0)) / np.abs(terms).sum(axis=0)
    common = np.argmin(np.where(np.isnan(residual), np.inf, residual), axis=0)
    x = x[common, np.arange(x.shape[1])]
    return np.where(x > 0, x, np.nan) ** (1 / found.power)


def _pieces(box: _Box, key: CurveName, points: Floats) -> Iterator[Curve]:
    """The stretches of a line across which the stable intervals change, all in the same way."""
    if points.shape[1] < 2:
        return
    closed = bool(np.abs(points[:, 0] - points[:, -1]).sum() < 1e-12)
    event = _event(box, key, points)
    state = np.where(event.matters, 1 + event.closes, 0)
    if closed and len(np.unique(state)) > 1:  # start where something changes
        shift = int(np.flatnonzero(np.diff(state))[0]) + 1
        order = np.append(np.roll(np.arange(len(state) - 1), -shift), shift)
        points, state, closed = points[:, order], state[order], False
    for start, stop in pairwise([0, *(np.flatnonzero(np.diff(state)) + 1).tolist(), len(state)]):
        if not state[start]:
            continue
        run, ends = points[:, start:stop], ["closed", "closed"]
        for side, (end, outside) in enumerate(((start, start - 1), (stop - 1, stop))):
            if 0 <= outside < len(state):
                ends[side], point = _end(box, key, points[:, end], points[:, outside], state[start])
                if np.abs(point - points[:, end]).max() > 1e-12:
                    run = np.column_stack([run, point] if side else [point, run])
            elif not closed:
                ends[side] = "box"
        if run.shape[1] > 1:
            V = _event(box, key, run).V
            for met, at in zip(ends, (0, -1), strict=True):
                V[at] = np.inf if met.endswith("infinity") else 0.0 if met.endswith("rest") else V[at]
            lam, sigma = box.real(run)
            yield Curve(NAMES[key], lam, sigma, V, bool(state[start] == 2), (ends[0], ends[1]))


def _end(box: _Box, key: CurveName, inside: Floats, outside: Floats, state: int) -> tuple[str, Floats]:
    """Where, between two points of a curve, its event changes from ``state``; and what it meets there."""
    a, b = inside, outside
    while np.abs(b - a).max() > 1e-15:
        points = a[:, np.newaxis] + (b - a)[:, np.newaxis] * np.linspace(0, 1, _SECTIONS + 1)
        points[:, 1:-1] = _onto(box, key, points[:, 1:-1], b - a)
        event = _event(box, key, points)
        same = np.where(event.matters, 1 + event.closes, 0) == state
        last = _SECTIONS - 1 if same.all() else max(int(np.argmin(same)) - 1, 0)
        if np.abs(points[:, last + 1] - points[:, last]).max() >= np.abs(b - a).max():
            break
        a, b = points[:, last], points[:, last + 1]
    event = _event(box, key, np.column_stack([inside, outside]))
    failing = np.flatnonzero(event.holds[:, 0] & ~event.holds[:, 1])
    if not len(failing):
        return "fold", a  # weave turns back on the curve, and what was closed no longer is
    met = event.ends[failing[0]]
    if met in ("weave", "capsize"):
        V = _event(box, key, np.column_stack([a, inside])).V
        met += " at infinity" if V[0] > V[1] else " at rest"
    return NAMES.get(met, met), a


def _onto(box: _Box, key: CurveName, points: Floats, along: Floats) -> Floats:
    """Points (2, n) near a curve, moved onto it across the direction ``along``."""
    length = float(np.hypot(*along))
    across = np.array([-along[1], along[0]])[:, np.newaxis] / length
    for _ in range(3):
        h = 1e-3 * length
        here, above, below = (box.value(key, points + e * across) for e in (0.0, h, -h))
        with np.errstate(divide="ignore", invalid="ignore"):
            move = 2 * h * here / (above - below)
        points = points - np.where(np.abs(move) < length, move, 0.0) * across
    return points


def _meeting(curves: list[Curve], box: _Box) -> list[Curve]:
    """Curves that meet get one common point there.

    Where they touch, rounding leaves its place along them uncertain; curves at infinity or rest cross.
    """
    ends = [(i, at) for i, curve in enumerate(curves) for at in (0, -1)]
    ends.sort(key=lambda end: not curves[end[0]].name.endswith(("infinity", "rest")))
    size = box.ends[:, 1] - box.ends[:, 0]
    common: list[Floats] = []
    for i, at in ends:
        lam, sigma = curves[i].lam, curves[i].sigma
        here = np.array([lam[at], sigma[at]])
        near = [point for point in common if np.abs((point - here) / size).max() < _SAME]
        lam[at], sigma[at] = near[0] if near else here
        if not near:
            common.append(here)
    return curves
