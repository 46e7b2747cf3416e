"""Steps onto the zero of a function of two coordinates: within brackets, and by Newton's method."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import elementwise

from bikestab.model import Floats

Function = Callable[[Floats], Floats]  # points (2, n) → values (n,)
ROUNDS = 4  # of Newton's method: from a grid's step to rounding
_HALVINGS = 60


def between(function: Function, low: Floats, high: Floats) -> Floats:
    """The points (2, n) between low and high (2, n) where a function changes its sign; it may jump there."""

    def along(t: Floats, *ends: Floats) -> Floats:
        a, b = np.array(ends).reshape(2, 2, -1)
        return function(a + t * (b - a))

    if not low.shape[1]:
        return low
    zero, one = np.zeros(low.shape[1]), np.ones(low.shape[1])
    root = elementwise.find_root(
        along, (zero, one), args=(*low, *high), tolerances={"xatol": 1e-16, "xrtol": 1e-15}
    )
    t = np.array(root.x)
    poor = ~(root.success & np.isfinite(root.f_x))  # a NaN at one end counts as success
    if poor.any():
        a, b = low[:, poor], high[:, poor]
        t[poor] = _halved(lambda t: function(a + t * (b - a)), zero[poor], one[poor])
    return low + t * (high - low)


def _halved(function: Function, a: Floats, b: Floats) -> Floats:
    """Where a function changes its sign from a to b, by that alone."""
    below = np.sign(function(a))
    for _ in range(_HALVINGS):
        middle = 0.5 * (a + b)
        left = np.sign(function(middle)) == below
        a, b = np.where(left, middle, a), np.where(left, b, middle)
    return b


def across(function: Function, points: Floats, along: Floats, most: float, rounds: int = ROUNDS) -> Floats:
    """Points (2, n) near a curve moved onto it, across the directions ``along`` and by ``most`` in a step.

    Lengths are measured by those directions' own: a slope is taken over a thousandth of them.
    """
    length = np.hypot(*along)
    aside = np.array([-along[1], along[0]]) / length
    h = np.broadcast_to(1e-3 * length, points.shape[1:])
    steps = np.array([np.zeros_like(h), h, -h])
    for _ in range(rounds):
        places = points[:, np.newaxis] + steps * aside[:, np.newaxis]
        here, above, below = function(places.reshape(2, -1)).reshape(steps.shape)
        with np.errstate(divide="ignore", invalid="ignore"):
            move = 2 * h * here / (above - below)
        points = points - np.where(np.abs(move) < most, move, 0.0) * aside
    return points
