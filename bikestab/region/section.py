"""Planes through the space of λ, σ and V, and the exact curves in them on which a condition is zero."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from contourpy import contour_generator

from bikestab.bicycle import Bicycle
from bikestab.fields import Axis
from bikestab.model import Floats, Model, characteristic_table
from bikestab.routh import condition_polynomials, conditions

IN_PLANE: dict[Axis, tuple[Axis, Axis]] = {
    "lam": ("sigma", "V"),
    "sigma": ("lam", "V"),
    "V": ("lam", "sigma"),
}


@dataclass(frozen=True)
class Section:
    """A plane through the space of λ, σ and V: one axis fixed, the two others along x and y."""

    bicycle: Bicycle
    model: Model
    fixed: Axis
    value: float
    x: Axis
    y: Axis

    def table_and_speed(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Characteristic table and V at points of the plane; x and y broadcast together."""
        at: dict[Axis, Floats] = {self.fixed: np.array(self.value), self.x: x, self.y: y}
        table = characteristic_table(self.bicycle, at["lam"], at["sigma"], model=self.model)
        shape = np.broadcast_shapes(np.shape(at["lam"]), np.shape(at["sigma"]))
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
    return [_onto_zero(value, line[:, 0], line[:, 1], steps) for line in lines]


def _onto_zero(value: Any, x: Floats, y: Floats, steps: tuple[float, float]) -> tuple[Floats, Floats]:
    """Move points that are near a zero onto it, along the gradient in units of the sample steps."""
    dx, dy = steps
    for _ in range(3):
        f = value(x, y)
        h = 1e-4
        fx = (value(x + h * dx, y) - value(x - h * dx, y)) / (2 * h)
        fy = (value(x, y + h * dy) - value(x, y - h * dy)) / (2 * h)
        with np.errstate(divide="ignore", invalid="ignore"):
            move = f / (fx**2 + fy**2)
        move = np.where(np.abs(move) * np.hypot(fx, fy) < 1, move, 0)  # a sample step at most
        x, y = x - move * fx * dx, y - move * fy * dy
    return x, y
