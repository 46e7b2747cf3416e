"""The points at which the skeleton's curves meet or end, to rounding, with names of bifurcation theory."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.polynomials import derivative, value
from bikestab.region.pieces import Curve
from bikestab.region.skeleton import in_units, speed_polynomials, units

_SAME = 1e-6  # of the box: ends that are one point
_NEAR = 2e-2  # of the box: how far the point may be from where the curves were seen to end
_NEAR_V = 0.5  # of the speed, which changes fast where a piece is cut short by the grid
_STEP = 1e-6  # of the box, for differences
_ROUNDS = 30
_DONE = 1e-13  # of the box
_NONE = ("box", "closed")
UNRESOLVED = "not resolved"

# conditions that vanish together at a speed: h is hurwitz3, and q = p2 p3 − p4 p1
WITHIN: dict[str, tuple[str, ...]] = {
    "zero-Hopf": ("p0", "q", "h'"),  # an eigenvalue 0 and a pair on the axis, where a fold begins
    "double zero": ("p0", "p1", "h'"),  # where a fold begins
    "triple zero": ("p0", "p1", "p2"),
    "double zero with a pair": ("p0", "p1", "p3"),
    "double Hopf": ("p1", "p3", "pairs"),  # two equal pairs on the axis
    "cusp of the fold": ("h", "h'", "h''"),
}
# leading or first coefficients that vanish together
AT_ENDS = (("p0", "h"), ("h", "next h"), ("h", "p1"))


class Point(NamedTuple):
    """A point where curves meet or end: its name, x and y of the family, V [m/s], and the curves' names.

    V is inf at infinity and 0 at rest.
    """

    name: str
    x: float
    y: float
    V: float
    curves: tuple[str, ...]


def points_of(
    family: Family, curves: Sequence[Curve], x: tuple[float, float], y: tuple[float, float]
) -> list[Point]:
    """The points at which curves traced in a box x × y meet or end, but for those on its sides.

    Each solves its conditions by Newton's method, from where the curves were traced to. An end of which no
    conditions are found, such as one at a singular inertia, or one cut short by the grid of the tracing, has
    the name UNRESOLVED and is where it was traced to.
    """
    box = np.array([x, y], dtype=float)
    size = box[:, 1] - box[:, 0]
    found: list[Point] = []
    for at, V, names in _ends(curves, size):
        point = _solved(family, at, V, names, size) or Point(UNRESOLVED, float(at[0]), float(at[1]), V, names)
        same = [k for k, other in enumerate(found) if _apart(point, other, size) < _SAME]
        if same:
            joined = tuple(dict.fromkeys([*found[same[0]].curves, *names]))
            found[same[0]] = found[same[0]]._replace(curves=joined)
        else:
            found.append(point)
    return found


def _apart(one: Point, other: Point, size: Floats) -> float:
    if one.name != other.name:
        return np.inf
    return float(np.abs((np.array([one.x, one.y]) - [other.x, other.y]) / size).max())


def _ends(curves: Sequence[Curve], size: Floats) -> list[tuple[Floats, float, tuple[str, ...]]]:
    """Where pieces end at others, and where the fold's second derivative changes its sign along one."""
    ends = []
    for curve in curves:
        for at, name in ((0, curve.ends[0]), (-1, curve.ends[1])):
            if name not in _NONE:
                place = np.array([curve.x[at], curve.y[at]])
                ends.append((place, float(curve.V[at]), tuple(dict.fromkeys((curve.name, name)))))
    return ends


def _solved(family: Family, at: Floats, V: float, names: tuple[str, ...], size: Floats) -> Point | None:
    """The nearest point at which the conditions of some name hold; None where there is none."""
    where = next((end for end in ("infinity", "rest") if any(name.endswith(end) for name in names)), "")
    if where:
        start, scale = at, size
        systems = [(f"ends at {where}", _at_end(family, pair, where)) for pair in AT_ENDS]
    elif 0 < V < np.inf:
        start, scale = np.append(at, V), np.append(size, V)
        systems = [(name, _within(family, together)) for name, together in WITHIN.items()]
    else:
        return None
    solved = [(name, _newton(conditions, start, scale)) for name, conditions in systems]
    found = [(float(np.abs((x - start) / scale).max()), name, x) for name, x in solved if x is not None]
    if not found:
        return None
    _, name, x = min(found, key=lambda each: each[0])
    speed = {"infinity": np.inf, "rest": 0.0}[where] if where else float(x[2])
    return Point(name, float(x[0]), float(x[1]), speed, names)


Conditions = Callable[[Floats], Floats]  # points (n, k) → values (n, k), each of middling size


def _within(family: Family, names: tuple[str, ...]) -> Conditions:
    """The conditions at points (x, y, V), each divided by the size of its terms at the first one."""

    def conditions(points: Floats) -> Floats:
        table = family.table(points[0], points[1])
        polynomials, power = speed_polynomials(table)
        V = points[2] ** power
        h, own = polynomials["hurwitz3"], {**polynomials}
        own |= {"h": h, "h'": derivative(h), "h''": derivative(derivative(h))}
        rows = []
        for name in names:
            if name == "pairs":
                p0, p2, p4 = (value(polynomials[k], V) for k in ("p0", "p2", "p4"))
                rows.append((p2 * p2 - 4 * p4 * p0) / (p2 * p2 + np.abs(4 * p4 * p0))[0])
            else:
                rows.append(value(own[name], V) / value(np.abs(own[name][:, 0]), np.abs(V[0])))
        return np.array(rows)

    return conditions


def _at_end(family: Family, names: tuple[str, str], where: str) -> Conditions:
    """The highest or lowest coefficients at points (x, y), in units in which they are of middling size."""
    index, following = (-1, -2) if where == "infinity" else (0, 1)

    def conditions(points: Floats) -> Floats:
        table = family.table(points[0], points[1])
        polynomials, _ = speed_polynomials(in_units(table, units(family.table(*points[:, :1]))))
        h = polynomials["hurwitz3"]
        own = {name: poly[index] for name, poly in polynomials.items()} | {"h": h[index]}
        own["next h"] = h[following] if len(h) > 1 else h[index]
        return np.array([own[name] for name in names])

    return conditions


def _newton(conditions: Conditions, start: Floats, size: Floats) -> Floats | None:
    """The zero near a start, by differences; None where there is none within _NEAR of it."""
    n = len(start)
    at = start.astype(float)
    steps = (
        np.concatenate([np.zeros((n, 1)), _STEP * np.eye(n), -_STEP * np.eye(n)], axis=1)
        * size[:, np.newaxis]
    )
    with np.errstate(all="ignore"):
        for _ in range(_ROUNDS):
            values = conditions(at[:, np.newaxis] + steps)
            slope = (values[:, 1 : n + 1] - values[:, n + 1 :]) / (2 * _STEP)
            row = np.abs(slope).max(axis=1)
            column = np.abs(slope / row[:, np.newaxis]).max(axis=0)
            slope = slope / row[:, np.newaxis] / column
            if not np.all(np.isfinite(slope)) or np.linalg.cond(slope) > 1e10:
                return None
            move = -np.linalg.solve(slope, values[:, 0] / row) / column
            at = at + move * size
            away = np.abs((at - start) / size)
            if away[:2].max() > _NEAR or away[2:].max(initial=0.0) > _NEAR_V:
                return None
            if np.abs(move).max() < _DONE:
                return at
    # V is known less well where it is large: there it changes much within rounding of the plane
    return at if np.abs(move[:2]).max() < 1e-11 and np.abs(move[2:]).max(initial=0.0) < 1e-6 else None
