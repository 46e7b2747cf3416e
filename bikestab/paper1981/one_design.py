"""Single designs: their stable intervals, and their eigenvalues by a general solver."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import canonical_matrices, characteristic_table
from bikestab.speeds import KINDS, intervals_of


@dataclass(frozen=True)
class Interval:
    """Stable speeds V1 < V < V2 [m/s], and what ends them; without an upper limit V2 is None."""

    V1: float
    V2: float | None
    lower: str
    upper: str


def intervals(bicycle: Bicycle, lam: float, sigma: float) -> list[Interval]:
    """The stable intervals of one design."""
    ends = intervals_of(characteristic_table(bicycle, lam, sigma))
    return [
        Interval(V1, V2 if math.isfinite(V2) else None, KINDS[lower], KINDS[upper])
        for V1, V2, lower, upper in zip(*(values.tolist() for values in ends), strict=True)
        if upper
    ]


def eigenvalues(bicycle: Bicycle, lam: float, sigma: float, speed: float) -> list[list[float]]:
    """[real, imaginary] of the eigenvalues [1/s] of the equations of motion, the fastest growing first.

    From the matrices and a general solver, so that neither the polynomial nor Routh–Hurwitz is involved.
    """
    M, C1, K0, K2 = canonical_matrices(bicycle, lam, sigma)
    C = speed * C1 + np.diag([0.0, bicycle.delta])
    inverse = np.linalg.inv(M)
    first_order = np.block(
        [[np.zeros((2, 2)), np.eye(2)], [-inverse @ (bicycle.g * K0 + speed**2 * K2), -inverse @ C]]
    )
    values = np.linalg.eigvals(first_order)
    return [[float(s.real), float(s.imag)] for s in sorted(values, key=lambda s: (-s.real, -s.imag))]
