"""Steps onto the zero of a function of two coordinates: within brackets, and by Newton's method."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from bikestab.model import Floats

Function = Callable[[Floats], Floats]  # points (2, n) → values (n,)
ROUNDS = 4  # of Newton's method: from a grid's step to rounding
_STEPS = 15  # within a bracket, which is enough but where a function jumps
_SECTIONS = 16  # into which what is left of a bracket is cut at a time
_CLOSE = 2.0**-53


def between(function: Function, low: Floats, high: Floats) -> Floats:
    """The points (2, n) between low and high (2, n) where a function changes its sign; it may jump there.

    By the Illinois method (Dowell and Jarratt 1971): the bracket's line, with half the value at an end that
    has stayed. What is no number counts as beyond the change.
    """
    if not low.shape[1]:
        return low
    a, b = np.zeros(low.shape[1]), np.ones(low.shape[1])
    at_a, at_b = function(low), function(high)
    last, found = np.full(len(a), 0.5), np.full(len(a), 0.5)
    busy = np.arange(len(a))
    for step in range(_STEPS):
        with np.errstate(all="ignore"):
            t = (a * at_b - b * at_a) / (at_b - at_a) if step % 3 != 2 else 0.5 * (a + b)
        t = np.where((a < t) & (t < b), t, 0.5 * (a + b))
        value = function(low[:, busy] + t * (high - low)[:, busy])
        left = np.sign(value) == np.sign(at_a)
        at_a, at_b = np.where(left, value, 0.5 * at_a), np.where(left, 0.5 * at_b, value)
        a, b = np.where(left, t, a), np.where(left, b, t)
        found[busy] = t
        on = (value != 0) & (np.abs(t - last) > _CLOSE) & (b - a > _CLOSE)
        busy, a, b, at_a, at_b, last = (each[on] for each in (busy, a, b, at_a, at_b, t))
        if not len(busy):
            break
    else:
        found[busy] = _cut(function, low[:, busy], high[:, busy], a, b, np.sign(at_a))
    return low + found * (high - low)


def _cut(function: Function, low: Floats, high: Floats, a: Floats, b: Floats, sign: Floats) -> Floats:
    """Where, of the way from low to high, a function loses its sign between a and b (n,), by that alone."""
    places = np.arange(1, _SECTIONS) / _SECTIONS
    each = np.arange(len(a))
    while (b - a > _CLOSE).any():
        t = a[:, np.newaxis] + (b - a)[:, np.newaxis] * places
        points = low[..., np.newaxis] + t * (high - low)[..., np.newaxis]
        left = np.sign(function(points.reshape(2, -1)).reshape(t.shape)) == sign[:, np.newaxis]
        ends = np.column_stack([a, t, b])
        first = np.argmin(np.column_stack([left, np.zeros(len(a), bool)]), axis=1)
        a, b = ends[each, first], ends[each, first + 1]
        if not (places[0] * (b - a) > np.spacing(a)).any():
            break
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
