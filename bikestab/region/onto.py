"""Steps onto the zero of a function of two coordinates: within brackets, and by Newton's method."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

Function = Callable[[Floats], Floats]  # points (2, n) → values (n,)
Several = Callable[[Floats, NDArray[np.intp]], Floats]  # points (2, n), of the functions of these numbers
ROUNDS = 4  # of Newton's method: from a grid's step to rounding
_STEPS = 12  # within a bracket, which is enough but where a function jumps
_SECTIONS = 16  # into which what is left of a bracket is cut at a time
_CLOSE = 2.0**-46  # of a bracket, of a hundredth of the box: its coordinates are no finer


def between(function: Several, low: Floats, high: Floats) -> Floats:
    """The points (2, n) between low and high (2, n) where a function changes its sign; it may jump there.

    Each bracket has a function of its own: ``function`` gets the number of each point's.

    By inverse quadratic interpolation where it may be trusted and halving elsewhere (Chandrupatla 1997). What
    is no number counts as beyond the change.
    """
    if not low.shape[1]:
        return low
    busy = np.arange(low.shape[1])
    b, at_b = np.zeros(len(busy)), function(low, busy)
    a, at_a = np.ones(len(busy)), function(high, busy)
    first = np.sign(at_b)
    t, found = np.full(len(a), 0.5), np.full(len(a), 0.5)
    for _ in range(_STEPS):
        x = b + t * (a - b)
        value = function(low[:, busy] + x * (high - low)[:, busy], busy)
        left = np.sign(value) == np.sign(at_b)
        c, at_c = np.where(left, b, a), np.where(left, at_b, at_a)
        a, at_a = np.where(left, a, b), np.where(left, at_a, at_b)
        b, at_b = x, value
        found[busy] = np.where(np.abs(at_a) < np.abs(at_b), a, b)
        least = _CLOSE / np.abs(a - b)
        on = (value != 0) & (least < 0.5)
        busy, a, b, c, at_a, at_b, at_c, least = (
            each[on] for each in (busy, a, b, c, at_a, at_b, at_c, least)
        )
        if not len(busy):
            break
        t = np.clip(_part(a, b, c, at_a, at_b, at_c), least, 1 - least)
    else:
        beyond = np.sign(at_b) != first[busy]
        inner, outer = np.where(beyond, a, b), np.where(beyond, b, a)
        found[busy] = _cut(function, busy, low[:, busy], high[:, busy], inner, outer, first[busy])
    return low + found * (high - low)


def _part(a: Floats, b: Floats, c: Floats, at_a: Floats, at_b: Floats, at_c: Floats) -> Floats:
    """How far of the way from b to a the change is, by the values there and at c, one of the ends before."""
    with np.errstate(all="ignore"):
        x, y = (b - a) / (c - a), (at_b - at_a) / (at_c - at_a)
        t = at_b / (at_a - at_b) * at_c / (at_a - at_c)
        t = t + (c - b) / (a - b) * at_b / (at_c - at_b) * at_a / (at_c - at_a)
    return np.where((y * y < x) & ((1 - y) ** 2 < 1 - x) & np.isfinite(t), t, 0.5)


def _cut(
    function: Several, busy: NDArray[np.intp], low: Floats, high: Floats, a: Floats, b: Floats, sign: Floats
) -> Floats:
    """Where, of the way from low to high, functions lose their signs between a and b (n,), by that alone.

    ``busy`` are their numbers.
    """
    places = np.arange(1, _SECTIONS) / _SECTIONS
    each = np.arange(len(a))
    which = np.repeat(busy, len(places))
    while (b - a > _CLOSE).any():
        t = a[:, np.newaxis] + (b - a)[:, np.newaxis] * places
        points = low[..., np.newaxis] + t * (high - low)[..., np.newaxis]
        left = np.sign(function(points.reshape(2, -1), which).reshape(t.shape)) == sign[:, np.newaxis]
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
