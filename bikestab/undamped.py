"""table without damping → stable speeds in double precision, for searches over many designs.

``speeds.intervals_of`` is the reference, with bounds on every end: it takes over where rounding might decide
here, and for all tables with damping. One call of it takes as long as five of these.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.entries import EVEN
from bikestab.kinds import CAPSIZE, NONE, REST, UNBOUNDED, WEAVE
from bikestab.model import Floats
from bikestab.speeds import intervals_of

_KINDS = np.array([REST, WEAVE, WEAVE, CAPSIZE, UNBOUNDED], np.uint8)
_ODD = [key for key in np.ndindex(5, 4) if key not in EVEN]
_CANCELLED = 1e-5  # of its terms: a smaller sum is not known well enough
_CLOSE = 1e-5  # relative: so close, two ends may be the other way round


class StableSpeeds(NamedTuple):
    """Stable speeds V1 < V < V2 [m/s], shape (*shape, interval), and the kinds of their ends.

    As those of ``speeds.Intervals``, whose ends they have to 1e-9 and mostly to rounding.
    """

    V1: Floats
    V2: Floats
    lower: NDArray[np.uint8]
    upper: NDArray[np.uint8]

    def reshaped(self, shape: tuple[int, ...]) -> StableSpeeds:
        """The same for cells of another shape."""
        parts: list[Any] = [values.reshape(*shape, values.shape[-1]) for values in self]
        return StableSpeeds(*parts)


def stable_speeds(table: Floats) -> StableSpeeds:
    """The stable speeds of a table (5, 4, *shape)."""
    shape = table.shape[2:]
    if table.shape[1] > 4 or any(table[key].any() for key in _ODD):
        return StableSpeeds(*intervals_of(table))
    cells = table.reshape(5, 4, -1)
    found, sure = _closed_form(cells)
    poor = np.flatnonzero(~sure)
    if len(poor):
        again = intervals_of(cells[..., poor])
        found = StableSpeeds(*map(_replaced, found, again, (np.nan, np.nan, NONE, NONE), [poor] * 4))
    return found.reshaped(shape)


def _replaced(values: Any, new: Any, empty: Any, cells: NDArray[np.intp]) -> Any:
    """Values (cell, interval) with those of some cells replaced."""
    most = max(values.shape[-1] if len(cells) < len(values) else 1, new.shape[-1])
    out = np.full((len(values), most), empty, values.dtype)
    some = min(most, values.shape[-1])
    out[:, :some] = values[:, :some]
    out[cells] = empty
    out[cells, : new.shape[-1]] = new
    return out


def _closed_form(table: Floats) -> tuple[StableSpeeds, NDArray[np.bool_]]:
    """The stable speeds of a table (5, 4, cell), and which of them are certain.

    In x = V² p0 is linear and hurwitz3/x quadratic. Where both, p3 and p4 are positive, p1 and p2 have one
    sign: see ``speeds``.
    """
    f0, f, e0, e, q0, q, k, m = (table[key] for key in EVEN)
    with np.errstate(all="ignore"):
        slow, slow_sure = _difference(q0 * k, m * e0)
        fast, fast_sure = _difference(q * k, m * e)
        w0, sure0 = _difference(e0 * slow, f0 * k * k)
        w1, sure1 = _difference(e0 * fast, f * k * k, e * slow)
        w2 = e * fast
        sure = slow_sure & fast_sure & sure0 & sure1
        root = w1 * w1 - 4 * w0 * w2
        sure &= np.abs(root) > _CANCELLED * (w1 * w1 + np.abs(4 * w0 * w2))
        big = -0.5 * (w1 + np.copysign(np.sqrt(root), w1))
        ends = np.array([np.zeros_like(f), big / w2, w0 / big, -f0 / f, np.full(f.shape, np.inf)])
    ends[1:4][~(ends[1:4] > 0)] = np.inf  # no number where the root is none
    order = np.argsort(ends, axis=0, kind="stable")
    x = np.take_along_axis(ends, order, axis=0)
    low, high = x[:-1], x[1:]
    there = low < np.inf
    with np.errstate(all="ignore"):
        sure &= ~(there & (high - low <= _CLOSE * high) & (high < np.inf)).any(axis=0)
        at = np.where(high < np.inf, 0.5 * (low + high), 2 * low + 1)
        p0, p1, p2 = f0 + at * f, e0 + at * e, q0 + at * q
        weave = w0 + at * (w1 + at * w2)
        good = there & (p0 > 0) & (weave > 0) & (k > 0) & (m > 0) & (p1 + p2 > 0)
    return _packed(x, _KINDS[order], good), sure


def _difference(a: Floats, b: Floats, more: Floats | float = 0.0) -> tuple[Floats, NDArray[np.bool_]]:
    """A − b + more, and where it is well known."""
    value, size = a - b + more, np.abs(a) + np.abs(b) + np.abs(more)
    return value, (np.abs(value) > _CANCELLED * size) | (size == 0)


def _packed(x: Floats, kind: NDArray[np.uint8], good: NDArray[np.bool_]) -> StableSpeeds:
    """The good ones of the stretches (4, cell) between ends x = V² (5, cell), in order in each cell."""
    cell, stretch = np.nonzero(good.T)
    count = np.count_nonzero(good, axis=0)
    shape = len(count), max(int(count.max(initial=0)), 1)
    at = cell, np.arange(len(cell)) - (np.cumsum(count) - count)[cell]
    V1, V2 = np.full((2, *shape), np.nan)
    lower, upper = np.full((2, *shape), NONE, np.uint8)
    V1[at], V2[at] = np.sqrt(x[stretch, cell]), np.sqrt(x[stretch + 1, cell])
    lower[at] = kind[stretch, cell]
    upper[at] = np.where(np.isinf(V2[at]), UNBOUNDED, kind[stretch + 1, cell])
    return StableSpeeds(V1, V2, lower, upper)
