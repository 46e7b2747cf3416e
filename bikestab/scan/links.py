"""Roots in neighbouring cells of a plane (λ, σ) → which of them continue each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

Indices = NDArray[np.intp]

SPEED = 5.0  # m/s; roots are near each other in V/(V + SPEED), in which V → ∞ is a place like any other
NO_LINKS = np.empty((2, 0), np.intp)


def place_of(V: Floats) -> Floats:
    return V / (V + SPEED)


def links_of(V: Floats, axis: int) -> Indices:
    """Pairs (2, link) of roots (…, λ, σ, root), numbered as in V[isfinite(V)], that continue each other.

    They do so along λ (axis 0) or σ (1).

    Each is the other's nearest, so a pair born at a fold between two cells takes no root's partner away.
    """
    x, there = place_of(V), np.isfinite(V)
    if not there.any():
        return NO_LINKS
    number = np.cumsum(there.ravel()).reshape(V.shape) - 1
    a, b = (
        (np.s_[..., :-1, :, :], np.s_[..., 1:, :, :]), (np.s_[..., :-1, :], np.s_[..., 1:, :]),
    )[axis]  # fmt: skip
    one, other = (np.ascontiguousarray(np.moveaxis(x[part], -1, 0)) for part in (a, b))
    ahead, back = np.moveaxis(_nearest(one, other), 0, -1), np.moveaxis(_nearest(other, one), 0, -1)
    mutual = np.take_along_axis(back, ahead, axis=-1) == np.arange(V.shape[-1])
    mutual &= there[a] & np.take_along_axis(there[b], ahead, axis=-1)
    return np.array([number[a][mutual], np.take_along_axis(number[b], ahead, axis=-1)[mutual]])


def _nearest(x: Floats, others: Floats) -> Indices:
    """Which of the others (root, …) in its cell is nearest to each of x (root, …), the first if several are.

    numpy's argmin along a short axis takes three times as long.
    """
    nearest = np.zeros(x.shape, np.intp)
    for i, place in enumerate(x):
        least = np.full(place.shape, np.inf)
        for j, other in enumerate(others):
            far = np.abs(place - other)
            nearest[i][far < least] = j
            least = np.fmin(far, least)
    return nearest


def pairs(a: Indices, b: Indices) -> Indices:
    """The pairs (2, pair) of different sheets that a cell of ``a`` and the same one of ``b`` have."""
    one, other = (x.reshape(-1) for x in np.broadcast_arrays(a[..., :, np.newaxis], b[..., np.newaxis, :]))
    some = (one >= 0) & (other >= 0) & (one != other)
    one, other = one[some], other[some]
    number = int(other.max(initial=0)) + 1
    return np.array(np.divmod(np.unique(one * number + other), number))  # faster than by columns
