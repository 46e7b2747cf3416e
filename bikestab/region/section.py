"""Planes through the space of designs and speeds, and the exact curves in them where a condition is zero."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from contourpy import contour_generator

from bikestab.family import Family
from bikestab.model import Floats, in_powers
from bikestab.rounding import POLYNOMIAL
from bikestab.routh import CONDITIONS, conditions, hurwitz3_of
from bikestab.twofold import Double

_ROUNDS = 3  # of Newton's method: from a grid's step to rounding
_SLOPE = 1e-4  # of a step: over which slopes are taken


@dataclass(frozen=True)
class Section:
    """A plane through the space of a family and V: ``fixed`` names the axis that has one value."""

    family: Family
    fixed: str
    value: float

    @property
    def axes(self) -> tuple[Any, Any]:  # Any: callers have literal types of their own for these names
        """The names of the two others, along x and along y."""
        x, y = (name for name in (self.family.x, self.family.y, "V") if name != self.fixed)
        return x, y

    def table_and_speed(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Characteristic table (in double precision) and V at points; x and y broadcast together."""
        at: dict[str, Floats] = {
            self.fixed: np.array(self.value),
            **dict(zip(self.axes, (x, y), strict=True)),
        }
        table = self.family.quick_table(at[self.family.x], at[self.family.y])
        shape = table.shape[2:]
        return table.reshape(*table.shape[:2], *(1,) * (at["V"].ndim - len(shape)), *shape), at["V"]


def edge_curves(
    section: Section, names: Sequence[str], X: Floats, Y: Floats
) -> dict[str, list[tuple[Floats, Floats]]]:
    """Of each condition the parts (x, y) of the curves on which it is zero that are edges of stability.

    X and Y are the samples (n,) among which curves are looked for; the points are exact.
    """
    parts: dict[str, list[tuple[Floats, Floats]]] = {}
    for name, curves in zero_curves(section, names, X, Y).items():
        parts[name] = []
        for x, y in curves:
            others = conditions(*section.table_and_speed(x, y))._asdict()
            edge = np.all([v > 0 for key, v in others.items() if key != name], axis=0)
            cuts = np.flatnonzero(np.diff(edge)) + 1
            stretches = np.split(np.arange(len(x)), cuts)
            parts[name].extend((x[part], y[part]) for part in stretches if edge[part[0]] and len(part) > 1)
    return parts


def zero_curves(
    section: Section, names: Sequence[str], X: Floats, Y: Floats
) -> dict[str, list[tuple[Floats, Floats]]]:
    """Of each condition the whole curves (x, y) on which it is zero, edges or not."""
    samples = _values(section, names, X[np.newaxis, :], Y[:, np.newaxis])
    lines = [cast("list[Floats]", contour_generator(X, Y, z).lines(0.0)) for z in samples]
    which = np.repeat(np.arange(len(names)), [sum(map(len, of)) for of in lines])
    every = [line for of in lines for line in of]
    if not every:
        return {name: [] for name in names}

    def value(points: Floats) -> Floats:
        return np.choose(which, _values(section, names, *points))

    moved = _onto(value, np.concatenate(every).T, (X[1] - X[0], Y[1] - Y[0]))
    curves = iter(np.split(moved, np.cumsum([len(line) for line in every])[:-1], axis=1))
    return {name: [tuple(next(curves)) for _ in of] for name, of in zip(names, lines, strict=True)}


def _values(section: Section, names: Sequence[str], x: Floats, y: Floats) -> list[Floats]:
    """The conditions at points of the plane, without their factors V^m, which are no boundary."""
    table, V = section.table_and_speed(x, y)
    rows = [[Double(a, np.abs(a)) if a.any() else None for a in row] for row in in_powers(table)]
    shape = np.broadcast_shapes(x.shape, y.shape)
    found = []
    for name in names:
        polynomial = hurwitz3_of(rows) if name == "hurwitz3" else rows[CONDITIONS.index(name)]
        coefficients = [0.0 if a is None else _settled(a) for a in polynomial]
        used = [j for j, a in enumerate(coefficients) if np.any(a)]
        result: Floats = np.ones(())
        if used:
            result = np.asarray(coefficients[used[-1]])
            for j in range(used[-1] - 1, used[0] - 1, -1):
                result = result * V + coefficients[j]
        found.append(np.broadcast_to(result, shape))
    return found


def _settled(a: Double) -> Floats:
    """Zero where no more than rounding is left."""
    return cast("Floats", np.where(np.abs(a.value) <= POLYNOMIAL * a.size, 0.0, a.value))


def _onto(function: Callable[[Floats], Floats], points: Floats, units: tuple[float, float]) -> Floats:
    """Points (2, n) near a curve moved onto it along the gradient, where x and y have these ``units``.

    A step is one unit at most.
    """
    size = np.array(units)[:, np.newaxis]
    aside = np.array([[[0.0], [1.0], [0.0]], [[0.0], [0.0], [1.0]]]) * _SLOPE * size[:, np.newaxis]
    for _ in range(_ROUNDS):
        here, *beside = function(points[:, np.newaxis] + aside)
        slope = (np.array(beside) - here) / _SLOPE
        with np.errstate(divide="ignore", invalid="ignore"):
            move = here / (slope**2).sum(axis=0)
        move = np.where(np.abs(move) * np.hypot(*slope) < 1, move, 0)
        points = points - move * slope * size
    return points
