"""Rays along which a margin is positive at first → how far it stays so."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

FARTHEST = 100.0  # how far a ray goes
_MARCH, _PARTS = 24, 12  # steps of a ray to FARTHEST; into how many parts the last is cut
_NARROW = 1e-8  # of the distance: how narrow that part becomes
_EVEN = np.linspace(0, 1, 7)[1:-1, np.newaxis]
_CLOSE = np.array([-1e-2, -1e-4, -1e-6, 1e-6, 1e-4, 1e-2])[:, np.newaxis]  # to the zero, in shares
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
    """The last distance with a margin between ``ends``: by parts, small ones beside the secant's zero."""
    (low, high), (inside, outside) = (np.array(each) for each in (ends, values))
    while (open_ := np.flatnonzero(high - low > _NARROW * np.maximum(low, 1e-6))).size:
        a, b, f, g = low[open_], high[open_], inside[open_], outside[open_]
        share = np.vstack([np.tile(_EVEN, (1, len(a))), f / (f - g) + _CLOSE])
        share = np.sort(np.clip(share, 0.0, 1.0), axis=0)
        far = a + (b - a) * share
        found = margin(far.ravel(), np.tile(open_, len(far))).reshape(far.shape)
        far, found = np.vstack([a, far, b]), np.vstack([f, found, g])
        first = (found[1:] <= 0).argmax(axis=0)
        ray = np.arange(len(a))
        low[open_], high[open_] = far[first, ray], far[first + 1, ray]
        inside[open_], outside[open_] = found[first, ray], found[first + 1, ray]
    return low
