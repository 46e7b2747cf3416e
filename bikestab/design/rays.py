"""Rays along which a margin is positive at first → how far it stays so."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

FARTHEST = 100.0  # how far a ray goes
_MARCH, _PARTS = 24, 12  # steps of a ray to FARTHEST; into how many parts the last is cut
_SECANTS, _NARROW = 12, 1e-8  # steps by secants into that part, at most, and how narrow it becomes
Margin = Callable[[Floats, NDArray[np.intp]], Floats]  # at distances (point,) along rays of these numbers


def first_ends(margin: Margin, number: int) -> Floats:
    """The distance (number,) at which each ray loses its margin for the first time, FARTHEST at most.

    It is the last that is known to have one, 0 where there is none, and at most 1e-8 of it before one that
    has none (1e-14 where it is smaller than 1e-6).
    """
    steps = np.concatenate([[0.0], np.geomspace(0.02, FARTHEST, _MARCH)])
    low, high = np.zeros(number), np.full(number, FARTHEST)
    ray = np.arange(number)
    for share in (steps / FARTHEST, np.linspace(0, 1, _PARTS + 1)):
        far = low + (high - low) * share[:, np.newaxis]  # (part, ray)
        values = margin(far.ravel(), np.tile(ray, len(far))).reshape(far.shape)
        lost = values[1:] <= 0
        first = np.where(lost.any(axis=0), lost.argmax(axis=0), len(lost) - 1)
        low, high = far[first, ray], far[first + 1, ray]
    inside, outside = values[first, ray], values[first + 1, ray]
    low = np.where(outside > 0, high, low)  # not lost at all
    high = np.where(inside > 0, high, low)  # lost at once
    return _narrowed(margin, (low, high), (inside, outside))


def _narrowed(margin: Margin, ends: tuple[Floats, Floats], values: tuple[Floats, Floats]) -> Floats:
    """The last distance with a margin between ``ends``, by the Illinois method, and then by halving."""
    (low, high), (inside, outside) = (np.array(each) for each in (ends, values))
    stayed = np.zeros(len(low))  # 1 where the last step moved the lower end, −1 where it moved the upper
    step = 0
    while (open_ := np.flatnonzero(high - low > _NARROW * np.maximum(low, 1e-6))).size:
        a, b, f, g = low[open_], high[open_], inside[open_], outside[open_]
        share = np.clip(f / (f - g), 0.01, 0.99) if step < _SECANTS else 0.5
        at = a + (b - a) * share
        value = margin(at, open_)
        side = np.where(value > 0, 1, -1)
        again = np.where(stayed[open_] == side, 0.5, 1.0)  # of the end that stays a second time
        kept = side > 0
        low[open_], high[open_] = np.where(kept, at, a), np.where(kept, b, at)
        inside[open_], outside[open_] = np.where(kept, value, again * f), np.where(kept, again * g, value)
        stayed[open_] = side
        step += 1
    return low
