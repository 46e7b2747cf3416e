"""(table, V) → growth rates in single precision, table → stable speeds in double, where C was compiled.

``spectrum`` and ``speeds`` are the references. The two factors that growth rates come from are followed along
the speeds from every START-th one, so that a value depends on its own and at most START − 1 lower speeds of
the grid. Where that does not settle, and where rounding might decide over an interval, the reference's value
is taken.
"""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import NDArray

from bikestab.entries import DAMPED
from bikestab.errors import InputError
from bikestab.kernels import address, library
from bikestab.model import Floats
from bikestab.polynomials import value_of_cubics
from bikestab.quartic import split
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of

START = 32  # speeds; divides those of a tile of a scan
_LANES = 16  # as in growth.c
_MOST = 4  # as in intervals.c
_CELLS = 1 << 12  # worked on at a time
_AGAIN = 1 << 14
_LARGEST = 2.0**60


def available() -> bool:
    """Whether it was compiled when this package was installed, and can be loaded."""
    return library() is not None


def check_available() -> None:
    """Raise InputError where it cannot be used."""
    if not available():
        problem = "the compiled kernel is not there"
        hint = "install bikestab where there is a C compiler, or leave fast out"
        raise InputError(problem, key=("fast",), hint=hint)


def growth_rates(table: Floats, V: Floats) -> NDArray[np.float32]:
    """The largest real part of the eigenvalues [s⁻¹] of a table (5, 4, cell) at ascending V [m/s]; (cell, V).

    Within 1e-7 of the reference's, and 1e-13 of the largest eigenvalue. Raises InputError where the kernel is
    not there.
    """
    check_available()
    if table.shape[1] > 4:  # V^−1 is the reference's alone
        return growth_rate_of(table[..., np.newaxis], V).astype(np.float32)
    out = np.empty((table.shape[-1], len(V)), np.float32)
    for i in range(0, len(out), _CELLS):
        part, rates = table[..., i : i + _CELLS], out[i : i + _CELLS]
        _follow(part, V, rates)
        cell, k = np.divmod(np.flatnonzero(np.isnan(rates)), len(V))
        with np.errstate(over="ignore"):  # what single precision cannot hold is inf
            for n in range(0, len(cell), _AGAIN):
                at = cell[n : n + _AGAIN], k[n : n + _AGAIN]
                rates[at] = growth_rate_of(part[..., at[0]], V[at[1]])
    return out


def stable_speeds(table: Floats) -> tuple[Floats, Floats]:
    """V1 and V2 [m/s] of the stable intervals of a table (5, 4, *shape); shape (*shape, interval).

    NaN behind the last. Within 1e-9 of the reference's, mostly 1e-15. Raises InputError without the kernel.
    """
    check_available()
    shape = table.shape[2:]
    if table.shape[1] > 4:
        found = intervals_of(table)
        return found.V1, found.V2
    table = np.ascontiguousarray(table.reshape(5, 4, -1))
    V1, V2 = np.empty((2, table.shape[-1], _MOST))
    sure = np.zeros(table.shape[-1], np.uint8)
    if not any(table[key].any() for key in np.ndindex(5, 4) if key not in DAMPED):
        library().intervals(
            address(table), ctypes.c_long(table.shape[-1]), address(V1), address(V2), address(sure)
        )
    size = np.abs(table).reshape(20, -1)
    in_range = ((size == 0) | ((size > 1 / _LARGEST) & (size < _LARGEST))).all(axis=0)  # products too
    poor = np.flatnonzero((sure == 0) | ~in_range)
    if len(poor):
        found = intervals_of(table[..., poor])
        V1[poor], V2[poor] = np.nan, np.nan
        V1[poor, : found.V1.shape[-1]], V2[poor, : found.V1.shape[-1]] = found.V1, found.V2
    most = max(1, int(np.count_nonzero(~np.isnan(V1).all(axis=0))))
    return V1[:, :most].reshape(*shape, most), V2[:, :most].reshape(*shape, most)


def _follow(table: Floats, V: Floats, out: NDArray[np.float32]) -> None:
    """Put the growth rates into ``out`` (cell, V), NaN where they are not good."""
    cells = -(-len(out) // _LANES) * _LANES
    whole = np.minimum(np.arange(cells), len(out) - 1)  # filled up with the last one
    rates = out if cells == len(out) else np.empty((cells, len(V)), np.float32)
    with np.errstate(all="ignore"):
        rows = np.ascontiguousarray(table[:4][..., whole] / table[4, 0][whole])  # p4 has no power of V
        starts = V[::START]
        p = [value_of_cubics(row[..., np.newaxis], starts, (cells, len(starts))) for row in rows]
        factors = np.array(split(*p[::-1]))  # (4, cell, start)
    degrees = np.array([np.flatnonzero(row.any(axis=-1)).max(initial=0) for row in rows], np.intc)
    weights = _weights(V)
    for n in range(0, len(V), START):
        some, start = slice(n, n + START), np.ascontiguousarray(factors[..., n // START])
        library().growth(
            *map(address, (rows, degrees, start, V[some], weights[some], rates[:, some])),
            *map(ctypes.c_long, (cells, len(V[some]), len(V))),
        )
    out[...] = rates[: len(out)]


def _weights(V: Floats) -> Floats:
    """Of the values at the last four speeds in that at each (V, 4), by Lagrange; of fewer near a start."""
    weights = np.zeros((len(V), 4))
    weights[:, 0] = 1
    number = np.arange(len(V)) % START  # of speeds since the start
    for points in (2, 3, 4):
        k = np.flatnonzero(number >= points if points == 4 else number == points)
        before = V[k[:, np.newaxis] - np.arange(1, points + 1)]
        for i in range(points):
            others = np.delete(before, i, axis=-1)
            weights[k, i] = ((V[k, np.newaxis] - others) / (before[:, [i]] - others)).prod(axis=-1)
    return weights
