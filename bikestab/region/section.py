"""Planes through the space of designs and speeds, and the exact curves in them where a condition is zero."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from contourpy import contour_generator

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.region.onto import downhill
from bikestab.routh import condition_polynomials, conditions


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
        """Characteristic table and V at points of the plane; x and y broadcast together."""
        at: dict[str, Floats] = {
            self.fixed: np.array(self.value),
            **dict(zip(self.axes, (x, y), strict=True)),
        }
        table = self.family.table(at[self.family.x], at[self.family.y])
        shape = table.shape[2:]
        return table.reshape(5, 4, *(1,) * (at["V"].ndim - len(shape)), *shape), at["V"]


def edge_curves(section: Section, name: str, X: Floats, Y: Floats) -> list[tuple[Floats, Floats]]:
    """The parts (x, y) of the curve on which a condition is zero that are edges of stability.

    X and Y are the samples (n,) among which curves are looked for; the points are exact.
    """
    parts: list[tuple[Floats, Floats]] = []
    for x, y in zero_curves(section, name, X, Y):
        others = conditions(*section.table_and_speed(x, y))._asdict()
        edge = np.all([v > 0 for key, v in others.items() if key != name], axis=0)
        cuts = np.flatnonzero(np.diff(edge)) + 1
        stretches = np.split(np.arange(len(x)), cuts)
        parts.extend((x[part], y[part]) for part in stretches if edge[part[0]] and len(part) > 1)
    return parts


def zero_curves(section: Section, name: str, X: Floats, Y: Floats) -> list[tuple[Floats, Floats]]:
    """The whole curves (x, y) on which a condition is zero, edges or not."""

    def value(x: Floats, y: Floats) -> Floats:
        table, V = section.table_and_speed(x, y)
        polynomial = condition_polynomials(table)[name]
        used = np.flatnonzero(polynomial.any(axis=tuple(range(1, polynomial.ndim))))
        if not len(used):
            return np.ones(np.broadcast_shapes(x.shape, y.shape))
        result = polynomial[used[-1]]
        for j in range(used[-1] - 1, used[0] - 1, -1):  # without the factor V^m, which is no boundary
            result = result * V + polynomial[j]
        return np.broadcast_to(result, np.broadcast_shapes(x.shape, y.shape))

    samples = value(X[np.newaxis, :], Y[:, np.newaxis])
    lines = cast("list[Floats]", contour_generator(X, Y, samples).lines(0.0))
    steps = (X[1] - X[0], Y[1] - Y[0])
    moved = (downhill(lambda points: value(*points), line.T, steps) for line in lines)
    return [(x, y) for x, y in moved]
