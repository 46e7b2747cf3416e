"""table → critical speeds and the exact intervals of stable speed.

For fixed (λ, σ) each condition of (2.2) is a polynomial in V. The border of the stable set is reached
only where p0 or hurwitz3 changes sign, so these roots cut the speed axis into stretches that are
stable throughout or nowhere; no grid is involved, and no interval is too narrow.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.roots import positive_roots, sign_near_zero
from bikestab.routh import CONDITIONS, condition_polynomials, conditions

KINDS = ("none", "weave", "capsize", "rest", "unbounded")  # value k of ``lower`` and ``upper``
NONE, WEAVE, CAPSIZE, REST, UNBOUNDED = range(5)
_EMPTY = (np.nan, np.nan, NONE, NONE)  # what stands in Intervals behind a cell's last one
_CHUNK = 1 << 14


class Intervals(NamedTuple):
    """Stable speeds V1 < V < V2 [m/s] of each cell, ascending; shape ``(*shape, interval)``.

    V1 and V2 are NaN behind a cell's last interval; V2 is inf where it is unbounded above.
    ``lower`` and ``upper`` are indices into KINDS: what happens at either end.

    >>> import bikestab as bs
    >>> found = bs.stable_intervals(bs.Bicycle.preset("meijaard2007"))
    >>> [bs.KINDS[kind] for kind in (*found.lower, *found.upper)]
    ['weave', 'capsize']
    """

    V1: Floats
    V2: Floats
    lower: NDArray[np.uint8]
    upper: NDArray[np.uint8]

    @property
    def number(self) -> NDArray[np.intp]:
        """How many intervals each cell has."""
        return np.count_nonzero(self.upper, axis=-1)


class Critical(NamedTuple):
    """Where each condition is zero, and its sign before: by the conditions' names.

    ``speeds`` [m/s], shape (root, *shape), are the positive speeds at which it changes its sign,
    ascending, NaN behind the last; ``sign`` (*shape) is that just above V = 0: −1, 1, or 0 if it is
    zero at every speed.
    """

    speeds: dict[str, Floats]
    sign: dict[str, Floats]


def critical(table: Floats, names: tuple[str, ...] = CONDITIONS) -> Critical:
    """The critical speeds and the signs before them of a table (5, 4, *shape)."""
    polynomials = condition_polynomials(table)
    return Critical(
        {name: positive_roots(polynomials[name]) for name in names},
        {name: sign_near_zero(polynomials[name]) for name in names},
    )


def critical_speeds(table: Floats) -> dict[str, Floats]:
    """The positive speeds at which each condition changes sign; shape (root, *shape), NaN where none.

    Not every root of hurwitz3 or p0 is an edge of stability, and those of the others never are.
    """
    return critical(table).speeds


def intervals_of(table: Floats) -> Intervals:
    """Every interval of stable speeds of a table (5, 4, *shape), exact to rounding.

    An end is ``weave`` (hurwitz3 = 0), ``capsize`` (p0 = 0), ``rest`` (V = 0) or ``unbounded``.
    The last axis is as long as the largest number of intervals in any cell, and at least 1.
    """
    shape = table.shape[2:]
    cells = table.reshape(5, 4, -1)
    parts = []
    for start in range(0, max(cells.shape[-1], 1), _CHUNK):
        part = cells[..., start : start + _CHUNK]
        parts.append(intervals_between(part, critical(part, ("p0", "hurwitz3"))))
    fields = [
        joined([list(field)], empty) for field, empty in zip(zip(*parts, strict=True), _EMPTY, strict=True)
    ]
    return Intervals(*(field.reshape(*shape, field.shape[-1]) for field in fields))


def intervals_between(table: Floats, critical: Critical) -> Intervals:
    """The stable intervals of a table (5, 4, cell) whose critical speeds are known."""
    capsize, weave = critical.speeds["p0"], critical.speeds["hurwitz3"]
    n = table.shape[-1]

    V = np.concatenate([weave, capsize])
    kind = np.repeat(np.array([WEAVE, CAPSIZE], np.uint8), [len(weave), len(capsize)])
    V, kind_at = _ascending(V, np.where(np.isfinite(V), kind[:, np.newaxis], NONE).astype(np.uint8))
    exists = kind_at != NONE

    # stretch i lies between ends i and i + 1 of: rest, the critical speeds, infinity
    rest, infinity = np.zeros((1, n)), np.full((1, n), np.inf)
    lower_V = np.concatenate([rest, V])
    upper_V = np.concatenate([V, infinity])
    lower = np.concatenate([np.full((1, n), REST, np.uint8), kind_at])
    upper = np.concatenate([np.where(exists, kind_at, UNBOUNDED), np.full((1, n), UNBOUNDED)])
    upper = upper.astype(np.uint8)

    # p0 and hurwitz3 by counting their sign changes, which is right in however narrow a stretch;
    # the others keep their sign throughout a stable stretch, so any speed inside it will do
    crossed = [np.concatenate([rest, np.cumsum(kind_at == k, axis=0)]) % 2 for k in (CAPSIZE, WEAVE)]
    good = np.ones_like(lower_V, dtype=bool)
    for name, odd in zip(("p0", "hurwitz3"), crossed, strict=True):
        good &= critical.sign[name] * (1 - 2 * odd) > 0
    good &= lower_V < upper_V
    column, stretch = np.nonzero(good.T)
    low, high = lower_V[stretch, column], upper_V[stretch, column]
    inside = np.where(np.isfinite(high), low + 0.5 * (high - low), 2 * low + 1)
    values = conditions(table[..., column], inside)
    good[stretch, column] = np.all([values.p1 > 0, values.p2 > 0, values.p3 > 0, values.p4 > 0], axis=0)

    column, stretch = np.nonzero(good.T)
    count = np.bincount(column, minlength=n)
    nth = np.arange(len(column)) - (np.cumsum(count) - count)[column]  # in its column
    most = max(int(count.max(initial=0)), 1)

    def pick(values: NDArray, empty: float) -> NDArray:
        out = np.full((n, most), empty, values.dtype)
        out[column, nth] = values[stretch, column]
        return out

    return Intervals(pick(lower_V, np.nan), pick(upper_V, np.nan), pick(lower, NONE), pick(upper, NONE))


def _ascending(V: Floats, kind: NDArray[np.uint8]) -> tuple[Floats, NDArray[np.uint8]]:
    """Both in the order of the few V along the first axis, equal ones as they were; inf for NaN, last.

    numpy sorts each column by itself, which takes ten times as long.
    """
    V = np.where(np.isnan(V), np.inf, V)
    for last in range(len(V) - 1, 0, -1):
        for i in range(last):
            wrong = V[i] > V[i + 1]
            for values in (V, kind):
                values[i], values[i + 1] = (
                    np.where(wrong, values[i + 1], values[i]),
                    np.where(wrong, values[i], values[i + 1]),
                )
    return V, kind


def joined(blocks: list[list[NDArray]], empty: float) -> NDArray:
    """Blocks (row, column, …, item) of a plane as one array, short ones filled up with ``empty``."""
    most = max((block.shape[-1] for row in blocks for block in row), default=1)
    return np.concatenate(
        [np.concatenate([widened(block, most, empty) for block in row], axis=-2) for row in blocks]
    )


def widened(values: NDArray, most: int, empty: float) -> NDArray:
    """The array with its last axis filled up to the length ``most``."""
    missing = most - values.shape[-1]
    return np.concatenate([values, np.full((*values.shape[:-1], missing), empty, values.dtype)], axis=-1)
