"""table → the exact intervals of stable speed, with bounds on their ends.

For fixed (λ, σ) each condition of (2.2) is a polynomial in V. The border of the stable set is reached
only where p0 or hurwitz3 changes sign, so these roots cut the speed axis into stretches that are
stable throughout or nowhere; no grid is involved, and no interval is too narrow.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.critical import Critical, critical
from bikestab.entries import Cells, cells_of
from bikestab.kinds import CAPSIZE as CAPSIZE
from bikestab.kinds import KINDS as KINDS
from bikestab.kinds import NONE as NONE
from bikestab.kinds import REASONS as REASONS
from bikestab.kinds import REST as REST
from bikestab.kinds import UNBOUNDED as UNBOUNDED
from bikestab.kinds import WEAVE as WEAVE
from bikestab.model import ExactTable, Floats
from bikestab.rounding import VALUE

_CAPSIZE_SPEED, _WEAVE_SPEEDS, _ORDER, _SIGNS, _WIDTH = range(1, 6)


@dataclass(frozen=True, eq=False)
class Intervals:
    """Stable speeds V1 < V < V2 [m/s] of each cell, ascending; shape ``(*shape, interval)``.

    V1 and V2 are NaN behind a cell's last interval; V2 is inf where it is unbounded above.
    ``lower`` and ``upper`` are indices into KINDS: what happens at either end. The true ends are within
    ``V1_error`` and ``V2_error`` [m/s]: those of exactly these inputs if the table came from
    ``exact_table``, of exactly this table if it did not. Where the number of intervals or the kind of an
    end is within rounding, the cell's first ``marginal`` is an index into REASONS, else 0; only there an
    error may be inf: no bound is known.
    Iteration gives V1, V2, lower and upper.

    >>> import bikestab as bs
    >>> found = bs.stable_intervals(bs.Bicycle.preset("meijaard2007"))
    >>> [bs.KINDS[kind] for kind in (*found.lower, *found.upper)]
    ['weave', 'capsize']
    """

    V1: Floats
    V2: Floats
    lower: NDArray[np.uint8]
    upper: NDArray[np.uint8]
    V1_error: Floats
    V2_error: Floats
    marginal: NDArray[np.uint8]

    def __iter__(self) -> Iterator[NDArray]:
        return iter((self.V1, self.V2, self.lower, self.upper))

    def arrays(self) -> dict[str, NDArray]:
        """All seven arrays, by name."""
        return dict(vars(self))

    @property
    def number(self) -> NDArray[np.intp]:
        """How many intervals each cell has."""
        return np.count_nonzero(self.upper, axis=-1)


def critical_speeds(table: Floats | ExactTable) -> dict[str, Floats]:
    """The positive speeds at which each condition changes sign; shape (root, *shape), NaN where none.

    Not every root of hurwitz3 or p0 is an edge of stability, and those of the others never are.
    """
    return critical(table).speeds


def intervals_of(table: Floats | ExactTable) -> Intervals:
    """Every interval of stable speeds of a table (5, 4, *shape), with bounds on its ends.

    An end is ``weave`` (hurwitz3 = 0), ``capsize`` (p0 = 0), ``rest`` (V = 0) or ``unbounded``.
    The last axis is as long as the largest number of intervals in any cell, and at least 1.
    """
    shape = table.shape[2:]
    cells = table.reshape(*table.shape[:2], -1)
    found = intervals_between(cells, critical(cells, ("p0", "hurwitz3")))
    return Intervals(*(field.reshape(*shape, field.shape[-1]) for field in found.arrays().values()))


class _Ends(NamedTuple):
    """What cuts the speed axis, ascending: V + rest (end, cell) within ``radius``, and what it is.

    inf behind a cell's last.
    """

    V: Floats
    rest: Floats
    radius: Floats
    kind: NDArray[np.uint8]


def intervals_between(table: Floats | ExactTable, critical: Critical) -> Intervals:
    """``intervals_of`` a table (5, 4, cell) whose critical speeds are known."""
    n = table.shape[-1]
    ends = _ends(critical, n)
    weave, capsize = critical.zeros["hurwitz3"], critical.zeros["p0"]
    marginal = np.where(~capsize.sure, _CAPSIZE_SPEED, np.where(~weave.sure, _WEAVE_SPEEDS, 0))
    V, rest, radius, kind = ends
    error = np.fmax(np.abs(rest) + radius, 0.0) * (1 + 2.0**-50)

    # stretch i lies between ends i and i + 1. The signs of p0 and hurwitz3 come from counting their
    # changes, which is right in however narrow a stretch; the others keep their sign throughout a stable
    # stretch, so any speed inside it will do
    good = V[:-1] < np.inf
    for name, which in (("p0", CAPSIZE), ("hurwitz3", WEAVE)):
        positive, sign = critical.sign[name] > 0, critical.sign[name] != 0
        good[0] &= positive
        for i in range(1, len(good)):
            positive = (positive ^ (kind[i] == which)) & sign
            good[i] &= positive
    found = np.flatnonzero(good.T)
    column = found // len(good)
    at = (found - column * len(good)) * n + column  # stretch and column in the arrays of ends as one row
    low, high = V.take(at), V.take(at + n)
    inside = np.where(high < np.inf, low + 0.5 * (high - low), 2 * low + 1)
    stable, clear = _others_positive(cells_of(table), column, inside)
    marginal[column[~clear]] = _SIGNS
    marginal[_out_of_order(ends)] = _ORDER
    marginal[column[stable & (low == high)]] = _WIDTH

    column, at = column[stable], at[stable]
    count = np.bincount(column, minlength=n)
    most = max(int(count.max(initial=0)), 1)
    nth = np.arange(len(column)) - (np.cumsum(count) - count)[column] if most > 1 else 0  # in its column
    place = column * most + nth

    def pick(values: NDArray, at: NDArray[np.intp], empty: float) -> NDArray:
        out = np.full(n * most, empty, values.dtype)
        out[place] = values.take(at)
        return out.reshape(n, most)

    first = np.zeros((n, most), np.uint8)
    first[:, 0] = marginal
    (V1, V2), (below, above), (V1_error, V2_error) = (
        (pick(values, at, empty), pick(values, at + n, empty))
        for values, empty in ((V, np.nan), (kind, NONE), (error, np.nan))
    )
    return Intervals(V1, V2, below, above, V1_error, V2_error, first)


def _ends(critical: Critical, n: int) -> _Ends:
    """Rest, the zeros of p0 and hurwitz3, and infinity, in one ascending order."""
    rows: list[_Row] = []
    for name, kind in (("hurwitz3", WEAVE), ("p0", CAPSIZE)):
        for V, rest, radius in zip(*critical.zeros[name][:3], strict=True):
            kinds = np.where(np.inf > V, np.uint8(kind), np.uint8(UNBOUNDED))
            rows.append((np.fmin(V, np.inf), rest, radius, kinds))
            for i in range(len(rows) - 1, 0, -1):
                if kind == CAPSIZE:  # those of one condition are in order
                    rows[i - 1 : i + 1] = _in_order(rows[i - 1], rows[i])
    zero = np.zeros(n)
    rows = [
        (zero, zero, zero, np.full(n, REST, np.uint8)),
        *rows,
        (zero + np.inf, zero, zero, np.full(n, UNBOUNDED, np.uint8)),
    ]
    return _Ends(*(np.array(values) for values in zip(*rows, strict=True)))


_Row = tuple[Floats, Floats, Floats, NDArray[np.uint8]]


def _in_order(a: _Row, b: _Row) -> tuple[_Row, _Row]:
    """Two rows of V, rest, radius and kind, by V + rest in each cell."""
    wrong = (a[0] > b[0]) | ((a[0] == b[0]) & (a[1] > b[1]))
    if not wrong.any():
        return a, b

    def chosen(x: _Row, y: _Row) -> _Row:
        V, rest, radius = (np.where(wrong, x[i], y[i]) for i in range(3))
        return V, rest, radius, np.where(wrong, x[3], y[3])

    return chosen(b, a), chosen(a, b)


def _out_of_order(ends: _Ends) -> NDArray[np.bool_]:
    """The cells in which two ends of different kinds may be the other way round."""
    V, rest, radius, kind = ends
    close = np.zeros(V.shape[1:], bool)
    for i, k in combinations(range(1, len(V) - 1), 2):
        with np.errstate(invalid="ignore"):
            gap = (V[k] - V[i]) + (rest[k] - rest[i])
        close |= (kind[k] != kind[i]) & (gap <= radius[k] + radius[i])
    return close


def _others_positive(
    table: Cells, cell: NDArray[np.intp], V: Floats
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Whether p1 … p4 are positive at speeds with p0, hurwitz3 > 0, and whether that is certain.

    There p1 (p2 p3 − p4 p1) > p0 p3² ≥ 0, so that with p3, p4 > 0 p1 and p2 have one sign: where one of
    them is near zero the other one tells.
    """
    rows = table.value if table.error is None else table.error
    powers = [1.0, V, square := V * V, square * V, 1 / V]
    sums = []
    for k in range(1, 5):
        p, bound = np.zeros((2, len(V)))
        for j in range(rows.shape[1]):
            if rows[k, j].any():
                term = table.value[k, j].take(cell)
                term *= powers[j]
                p += term
                bound += VALUE * np.abs(term)
                if table.error is not None:
                    bound += table.error[k, j].take(cell) * powers[j]
        sums.append((p, bound))
    (p1, _), (p2, _), (p3, _), (p4, _) = sums
    clear = [np.abs(p) > bound for p, bound in sums]
    zero = [bound == 0 for _, bound in sums]
    first = np.where(clear[0], p1, np.where(clear[1], p2, p1))
    stable = (first > 0) & (p3 > 0) & (p4 > 0)
    unstable = zero[0] | zero[2] | zero[3]
    for p, known in zip((p1, p2, p3, p4), clear, strict=True):
        unstable |= known & (p < 0)
    return stable, unstable | ((clear[0] | clear[1]) & clear[2] & clear[3])
