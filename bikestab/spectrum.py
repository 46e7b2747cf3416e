"""(table, V) → eigenvalues and growth rate, without a matrix per point.

The quartic is split into two real quadratics by closed formulas and one step of Newton's method. Where that
is not enough, because eigenvalues nearly meet, it is done again in twice double precision; hardly any
points of a usual map are such.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.bairstow import polished, settled
from bikestab.coalescing import coalescing_quadratics
from bikestab.model import ExactTable, Floats
from bikestab.quartic import Factors, Quadratic, quadratic, split
from bikestab.routh import coefficients_at


def growth_rate_of(table: Floats | ExactTable, V: ArrayLike) -> Floats:
    """The largest real part of the eigenvalues [s⁻¹] at the speeds V [m/s].

    ``table`` has shape (5, 4, *shape) and V broadcasts against ``shape``. inf where p4 = 0, since
    an eigenvalue is then infinite. Where two eigenvalues meet, a table's rounding to doubles moves them by
    1e-8 of their size; that of an ExactTable does not.
    """
    one, other = quadratics(table, V)
    with np.errstate(all="ignore"):
        growth = np.maximum(_largest_real_part(one), _largest_real_part(other))
    return np.where(np.isnan(growth), np.inf, growth)


def eigenvalues_of(table: Floats | ExactTable, V: ArrayLike) -> NDArray[np.complex128]:
    """The four eigenvalues [s⁻¹] at the speeds V [m/s], in no particular order; shape (4, *shape)."""
    one, other = quadratics(table, V)
    with np.errstate(all="ignore"):
        return np.array([*_roots(one), *_roots(other)])


def quadratics(table: Floats | ExactTable, V: ArrayLike) -> tuple[Quadratic, Quadratic]:
    """Two real quadratics whose product is the characteristic polynomial divided by p4.

    NaN where p4 = 0.
    """
    table, rest = (table.value, table.rest) if isinstance(table, ExactTable) else (table, None)
    with np.errstate(all="ignore"):
        np.setbufsize(16)  # numpy else copies a broadcast array into its buffer for every operation
        p0, p1, p2, p3, _ = coefficients_at(table / table[4, 0], V)  # p4 has no power of V
        a, b, c, d = (np.atleast_1d(p) for p in (p3, p2, p1, p0))
        f, good = polished(split(a, b, c, d), a, b, c, d)
        if not np.all(good):
            poor = ~good
            rough = Factors(*(x[poor] for x in f))
            fine, _ = polished(rough, a[poor], b[poor], c[poor], d[poor])
            good[poor] = settled(rough, fine)
            _put(f, poor, fine)
        one, apart = quadratic(f.p, f.q)
        good &= apart
        other, apart = quadratic(f.r, f.t)
        good &= apart
    if not np.all(good):
        poor = ~good
        cells = _chosen(table, poor), None if rest is None else _chosen(rest, poor)
        _put((*one, *other), poor, coalescing_quadratics(*cells, np.broadcast_to(V, good.shape)[poor]))
    shape = np.shape(p0)
    return Quadratic(*(x.reshape(shape) for x in one)), Quadratic(*(x.reshape(shape) for x in other))


def _chosen(table: Floats, cells: NDArray[np.bool_]) -> Floats:
    """The tables (5, 4, cell) of some cells of the shape that table and speeds have together."""
    size, own = table.shape[:2], table.shape[2:]
    padded = table.reshape(*size, *(1,) * (cells.ndim - len(own)), *own)
    return np.broadcast_to(padded, (*size, *cells.shape))[:, :, cells]


def _put(arrays: Iterable[Floats], cells: NDArray[np.bool_], values: Iterable[Floats]) -> None:
    for out, new in zip(arrays, values, strict=True):
        out[cells] = new


def _largest_real_part(f: Quadratic) -> Floats:
    root = np.sqrt(np.maximum(f.square, 0))
    root -= f.half
    return root


def _roots(f: Quadratic) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    half, square, q = f
    root = np.sqrt(np.abs(square))
    # real: the larger one in size first, the other as q divided by it
    large = -(half + np.copysign(root, half))
    small = np.where(large == 0, 0, q / large)
    real = square >= 0
    return (
        np.where(real, large, -half + 1j * root),
        np.where(real, small, -half - 1j * root),
    )
