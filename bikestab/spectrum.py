"""(table, V) → eigenvalues and growth rate, without a matrix per point.

The quartic is split into two real quadratics by closed formulas and one step of Newton's method. Where
one step is not enough (three eigenvalues nearly meet, or two pairs do) a matrix's eigenvalues are used
after all; none of the points of a usual map are such.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.model import Floats
from bikestab.quartic import Factors, polished, split
from bikestab.routh import coefficients_at


def growth_rate_of(table: Floats, V: ArrayLike) -> Floats:
    """The largest real part of the eigenvalues [s⁻¹] at the speeds V [m/s].

    ``table`` has shape (5, 4, *shape) and V broadcasts against ``shape``. inf where p4 = 0, since
    an eigenvalue is then infinite. Where two eigenvalues meet, rounding of the coefficients moves
    them by the square root of itself, and so does this: by some 1e-8 of their size.
    """
    p, q, r, t = quadratic_factors(table, V)
    with np.errstate(all="ignore"):
        growth = np.maximum(_largest_real_part(p, q), _largest_real_part(r, t))
    return np.where(np.isnan(growth), np.inf, growth)


def eigenvalues_of(table: Floats, V: ArrayLike) -> NDArray[np.complex128]:
    """The four eigenvalues [s⁻¹] at the speeds V [m/s], in no particular order; shape (4, *shape)."""
    p, q, r, t = quadratic_factors(table, V)
    with np.errstate(all="ignore"):
        return np.array([*_roots(p, q), *_roots(r, t)])


def quadratic_factors(table: Floats, V: ArrayLike) -> Factors:
    """Two real quadratics whose product is the characteristic polynomial divided by p4.

    NaN where p4 = 0.
    """
    with np.errstate(all="ignore"):
        np.setbufsize(16)  # numpy else copies a broadcast array into its buffer for every operation
        p0, p1, p2, p3, _ = coefficients_at(table / table[4, 0], V)  # p4 has no power of V
        a, b, c, d = (np.atleast_1d(p) for p in (p3, p2, p1, p0))
        f, good = polished(split(a, b, c, d), a, b, c, d)
    if not np.all(good):
        _replace(f, ~good, *(x[~good] for x in (a, b, c, d)))
    return Factors(*(x.reshape(np.shape(p0)) for x in f))


def _replace(f: Factors, poor: NDArray[np.bool_], a: Floats, b: Floats, c: Floats, d: Floats) -> None:
    """Put the factors that a matrix's eigenvalues give where the split was poor.

    That is where three or four eigenvalues nearly meet, or differ greatly in size.
    """
    known = np.isfinite(a) & np.isfinite(b) & np.isfinite(c) & np.isfinite(d)
    companion = np.zeros((len(a), 4, 4))
    companion[:, [1, 2, 3], [0, 1, 2]] = 1
    companion[:, 0] = -np.stack([a, b, c, d], axis=1)
    companion[~known] = 0
    z = np.linalg.eigvals(companion).astype(complex).T
    z = np.take_along_axis(z, np.lexsort((z.real, np.abs(z.imag)), axis=0), axis=0)  # pairs side by side
    with np.errstate(all="ignore"):
        pairs = Factors(-(z[0] + z[1]).real, (z[0] * z[1]).real, -(z[2] + z[3]).real, (z[2] * z[3]).real)
        stepped, good = polished(pairs, a, b, c, d)
    for out, rough, fine in zip(f, pairs, stepped, strict=True):
        out[poor] = np.where(known, np.where(good, fine, rough), np.nan)


def _largest_real_part(p: Floats, q: Floats) -> Floats:
    half = 0.5 * p
    root = half * half
    root -= q
    root = np.sqrt(np.maximum(root, 0))
    root -= half
    return root


def _roots(p: Floats, q: Floats) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    half = 0.5 * p
    square = half * half - q
    root = np.sqrt(np.abs(square))
    # real: the larger one in size first, the other as q divided by it
    large = -(half + np.copysign(root, half))
    with np.errstate(all="ignore"):
        small = np.where(large == 0, 0, q / large)
    real = square >= 0
    return (
        np.where(real, large, -half + 1j * root),
        np.where(real, small, -half - 1j * root),
    )
