"""Conclusion 3: how well a torque at the steering reaches every mode of a design."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import Floats, characteristic_table, coefficients
from bikestab.paper1981.box import LAM, SIGMA, middles
from bikestab.routh import stable

SPEEDS = (4.0, 5.0, 6.0)  # m/s


@dataclass(frozen=True)
class Ranked:
    """A design's modal controllability, and the share of the designs stable at that speed that have less.

    Both are None where the design is not stable at that speed.
    """

    design: str
    lam: float
    sigma: float
    controllability: float | None
    better_than: float | None


@dataclass(frozen=True)
class Controllability:
    """At one speed [m/s]: the best of the stable designs of a grid, and the designs of greatest margin."""

    V: float
    designs: int
    lam: float
    sigma: float
    controllability: float
    of_margins: list[Ranked]


def controllability(
    bicycle: Bicycle, n: int, margins: Mapping[str, tuple[float, float]]
) -> list[Controllability]:
    """From n × n designs; ``margins`` are the designs (λ, σ) of greatest margin by name."""
    x, y = np.broadcast_arrays(middles(LAM, n)[:, np.newaxis], middles(SIGMA, n))
    table = characteristic_table(bicycle, x, y)
    result = []
    for V in SPEEDS:
        values = modal_controllability(bicycle, x, y, V)[stable(table, V)]
        all_values = np.where(stable(table, V), modal_controllability(bicycle, x, y, V), -1)
        best = np.unravel_index(np.argmax(all_values), x.shape)
        ranked = []
        for name, (lam, sigma) in margins.items():
            value = float(modal_controllability(bicycle, lam, sigma, V))
            rank = value, float(np.mean(values < value))
            steady = bool(stable(characteristic_table(bicycle, lam, sigma), V))
            ranked.append(Ranked(name, lam, sigma, *(rank if steady else (None, None))))
        result.append(
            Controllability(V, len(values), float(x[best]), float(y[best]), float(all_values[best]), ranked)
        )
    return result


def modal_controllability(bicycle: Bicycle, lam: Any, sigma: Any, V: float) -> Floats:
    """The least of |w·B|/(|w| |B|) over the left eigenvectors w of x' = A x + B T, T a torque that steers.

    x = (lean, steer, their rates) in rad and rad/s, so the measure depends on these units; it is zero where a
    mode cannot be reached at all, and 1 at most.
    """
    A, torque = _first_order(bicycle, lam, sigma, V)
    _, right = np.linalg.eig(A)
    left = np.linalg.inv(right)
    reached = np.abs((left @ torque[..., np.newaxis])[..., 0])
    size = np.linalg.norm(left, axis=-1) * np.linalg.norm(torque, axis=-1)[..., np.newaxis]
    return np.asarray((reached / size).min(axis=-1))


def _first_order(bicycle: Bicycle, lam: Any, sigma: Any, V: float) -> tuple[Floats, Floats]:
    """A (…, 4, 4) and B (…, 4) of the equations (1.5), divided by c."""
    values = [term.value / bicycle.c for term in coefficients(bicycle, lam, sigma)]
    a0, a1, a2, a3, a4, a5, b0, b1, b2, b3, b4, b5, b6 = np.broadcast_arrays(*values)
    zero, one = np.zeros_like(a0), np.ones_like(a0)
    damping = V * b1 + bicycle.delta
    stiffness = np.array([[-a1, a4 - V**2 * a5], [b6, V**2 * b2 - b3]])
    rates = np.array([[zero, -V * a3], [V * b5, damping]])
    inertia = np.moveaxis(np.array([[a0, -a2], [-b4, b0]]), (0, 1), (-2, -1))
    right = np.moveaxis(np.concatenate([stiffness, rates], axis=1), (0, 1), (-2, -1))
    lower = -np.linalg.solve(inertia, right)
    upper = np.broadcast_to(np.array([[0, 0, 1.0, 0], [0, 0, 0, 1.0]]), lower.shape)
    steer = np.moveaxis(np.array([[zero], [one]]), (0, 1), (-2, -1))
    torque = np.linalg.solve(inertia, steer)[..., 0]
    return np.concatenate([upper, lower], axis=-2), np.concatenate([0 * torque, torque], axis=-1)
