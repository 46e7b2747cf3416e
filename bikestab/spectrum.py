"""(table, V) → eigenvalues and growth rate, without a matrix per point.

The quartic is split into two real quadratics by the largest root of its resolvent cubic (Ferrari,
Euler), and the split is polished by Newton's method on the coefficients themselves (Bairstow).
Where one step is not enough (three eigenvalues nearly meet, or two pairs do) a matrix's eigenvalues
are used after all; none of the points of a usual map are such.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.model import Floats
from bikestab.routh import coefficients_at

# What Newton's step leaves of the product's coefficients is the second-order terms of that step; the
# split is good where these are no more than the rounding of a few operations.
ROUNDING = 8 * np.finfo(float).eps


class Factors(NamedTuple):
    """s⁴ + … = (s² + p s + q)(s² + r s + t), all real."""

    p: Floats
    q: Floats
    r: Floats
    t: Floats


def growth_rate(table: Floats, V: ArrayLike) -> Floats:
    """The largest real part of the eigenvalues [s⁻¹] at the speeds V [m/s].

    ``table`` has shape (5, 4, *shape) and V broadcasts against ``shape``. inf where p4 = 0, since
    an eigenvalue is then infinite. Where two eigenvalues meet, rounding of the coefficients moves
    them by the square root of itself, and so does this: by some 1e-8 of their size.
    """
    p, q, r, t = quadratic_factors(table, V)
    with np.errstate(all="ignore"):
        growth = np.maximum(_largest_real_part(p, q), _largest_real_part(r, t))
    return np.where(np.isnan(growth), np.inf, growth)


def eigenvalues(table: Floats, V: ArrayLike) -> NDArray[np.complex128]:
    """The four eigenvalues [s⁻¹] at the speeds V [m/s], in no particular order; shape (4, *shape)."""
    p, q, r, t = quadratic_factors(table, V)
    with np.errstate(all="ignore"):
        return np.array([*_roots(p, q), *_roots(r, t)])


def quadratic_factors(table: Floats, V: ArrayLike) -> Factors:
    """Two real quadratics whose product is the characteristic polynomial divided by p4.

    NaN where p4 = 0.
    """
    p0, p1, p2, p3, p4 = coefficients_at(table, V)
    with np.errstate(all="ignore"):
        scale = 1 / p4
        a, b, c, d = p3 * scale, p2 * scale, p1 * scale, p0 * scale
        f, good = _polished(_split(a, b, c, d), a, b, c, d)
    if not np.all(good):
        f = Factors(*(np.atleast_1d(x) for x in f))
        poor = np.atleast_1d(~good)
        _replace(f, poor, *(np.atleast_1d(x)[poor] for x in (a, b, c, d)))
        f = Factors(*(x.reshape(np.shape(a)) for x in f))
    return f


def _split(a: Floats, b: Floats, c: Floats, d: Floats) -> Factors:
    """Factors of s⁴ + a s³ + b s² + c s + d, before polishing."""
    # s = y − a/4: y⁴ + P y² + Q y + R
    e = 0.25 * a
    ee = e * e
    P = b - 6 * ee
    Q = c + 2 * e * (4 * ee - b)
    R = d + e * (e * (b - 3 * ee) - c)
    # y² ± k y + …: u = k² is the largest root of u³ + 2P u² + (P² − 4R) u − Q² = 0, never negative
    R4 = 4 * R
    u = np.maximum(_largest_cubic_root(2 * P, P * P - R4, -Q * Q), 0)
    k = np.sqrt(u)
    total = P + u  # sum of the two constant terms; their difference is Q/k, and its square total² − 4R
    square = np.maximum(total * total - R4, 0)
    safe = u * (np.abs(P) + np.sqrt(np.abs(R))) > square  # then the quotient is the better of the two
    difference = np.where(safe, Q / np.where(safe, k, 1), np.copysign(np.sqrt(square), Q))
    # back to s: y² + k y + q → s² + (k + 2e) s + …
    half_a = 2 * e
    q, t = 0.5 * (total - difference) + e * (k + e), 0.5 * (total + difference) + e * (e - k)
    return Factors(half_a + k, q, half_a - k, t)


def _polished(f: Factors, a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Factors, NDArray[np.bool_]]:
    """One step of Newton's method on the equations that the product's coefficients give.

    Also where its result is good: where the equations' second-order terms are within rounding.
    """
    p, q, r, t = f
    pr, pt, qr, qt = p * r, p * t, q * r, q * t
    ea = a - (p + r)
    eb = b - (q + t + pr)
    ec = c - (pt + qr)
    ed = d - qt
    # Solve dp + dr = ea, dq + dt + r dp + p dr = eb, t dp + r dq + q dr + p dt = ec, t dq + q dt = ed
    m, n = p - r, q - t
    g1 = eb - p * ea
    g2 = ec - q * ea - p * g1
    g3 = ed - q * g1
    # unknowns dp, dq after dr = ea − dp, dt = g1 + m dp − dq
    #   (p m − n) dp − m dq = g2,   q m dp − n dq = g3, with the resultant of the two as determinant
    x11, x21 = p * m - n, q * m
    det = m * x21 - n * x11
    dp = (m * g3 - n * g2) / det
    dq = (x11 * g3 - x21 * g2) / det
    dr = ea - dp
    dt = g1 + m * dp - dq
    good = np.abs(dp * dr) <= ROUNDING * (np.abs(q) + np.abs(t) + np.abs(pr))
    good &= np.abs(dp * dt + dq * dr) <= ROUNDING * (np.abs(pt) + np.abs(qr))
    good &= np.abs(dq * dt) <= ROUNDING * np.abs(qt)
    return Factors(p + dp, q + dq, r + dr, t + dt), good


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
        polished, good = _polished(pairs, a, b, c, d)
    for out, rough, fine in zip(f, pairs, polished, strict=True):
        out[poor] = np.where(known, np.where(good, fine, rough), np.nan)


def _largest_cubic_root(a: Floats, b: Floats, c: Floats) -> Floats:
    """The largest real root of u³ + a u² + b u + c."""
    third = a * (1 / 3)
    f = third * third - b * (1 / 3)  # w³ − 3 f w − 2 h = 0 with u = w − a/3
    h = 0.5 * (third * b - c) - third * third * third
    fff = f * f * f
    inside = h * h - fff
    root = np.sqrt(np.maximum(inside, 0))
    one = np.cbrt(h + np.copysign(root, h))
    one = one + f / one
    three = 2 * np.sqrt(np.maximum(f, 0)) * np.cos(np.arccos(np.clip(h / np.sqrt(fff), -1, 1)) * (1 / 3))
    return np.where(inside > 0, one, three) - third


def _largest_real_part(p: Floats, q: Floats) -> Floats:
    half = 0.5 * p
    return np.sqrt(np.maximum(half * half - q, 0)) - half


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
