"""The fork offset b, the distance of the front wheel's centre from the steering axis."""

from __future__ import annotations

from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.machines import Machines


def offset(bicycle: Bicycle | Machines, lam: Any, sigma: Any) -> Any:
    """The fork offset b [m] = R2 sin λ − c1 of designs, c1 = σ c cos λ; positive = bent forwards."""
    return bicycle.R2 * np.sin(lam) - sigma * bicycle.c * np.cos(lam)


def bent_forwards(bicycle: Bicycle | Machines, lam: Any, sigma: Any) -> Any:
    """Whether b >= 0, that is, σ <= (R2/c) tan λ."""
    return offset(bicycle, lam, sigma) >= 0


def least_tilt(bicycle: Bicycle, sigma: Any) -> Any:
    """The λ [rad] from which on the fork is bent forwards, at given σ."""
    return np.arctan2(sigma * bicycle.c, bicycle.R2)
