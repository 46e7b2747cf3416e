"""How far up an axis of speeds goes, and what of curves leaves it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from bikestab.model import Floats

_BEYOND = 1.25  # the axis ends there, of the largest end
_MOST = 4.0  # or there, of the end that half of them are below
_NONE = 10.0  # m/s, where there are no ends


def top_of(ends: ArrayLike, weights: ArrayLike) -> float:
    """Where an axis of speeds ends, so that those most of the axis has can be read.

    ``ends`` are NaN where there are none; ``weights`` say how much of the other axis each is of.
    """
    V, w = np.asarray(ends, dtype=float), np.asarray(weights, dtype=float)
    V, w = V[np.isfinite(V)], w[np.isfinite(V)]
    if not V.size:
        return _NONE
    order = np.argsort(V)
    parts = np.cumsum(w[order])
    middle = float(V[order][np.searchsorted(parts, 0.5 * parts[-1])])
    largest = _BEYOND * float(V.max())
    return min(largest, _MOST * middle) if middle > 0 else largest


def inside(x: Floats, V: Floats, top: float) -> tuple[Floats, Floats]:
    """A curve as far as it is below ``top``, and up to there; NaN above."""
    above = top < V
    crosses = np.flatnonzero((above[1:] != above[:-1]) & np.isfinite(V[1:]) & np.isfinite(V[:-1])) + 1
    part = (top - V[crosses - 1]) / (V[crosses] - V[crosses - 1])
    at = x[crosses - 1] + part * (x[crosses] - x[crosses - 1])
    return np.insert(x, crosses, at), np.insert(np.where(above, np.nan, V), crosses, top)


def largest_told(x: Floats, V: Floats, top: float, range_: Sequence[float]) -> float:
    """The largest of a curve that leaves the axis; NaN where it does not, or rises without limit.

    That it does where it ends within the ``range_`` at its largest.
    """
    finite = np.isfinite(V)
    if not finite.any() or np.nanmax(V) <= top:
        return np.nan
    k = int(np.nanargmax(V))
    there = [finite[j] if 0 <= j < len(V) else x[k] in range_ for j in (k - 1, k + 1)]
    return float(V[k]) if all(there) else np.nan
