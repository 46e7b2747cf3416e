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
        f, good = _polished(_split(a, b, c, d), a, b, c, d)
    if not np.all(good):
        _replace(f, ~good, *(x[~good] for x in (a, b, c, d)))
    return Factors(*(x.reshape(np.shape(p0)) for x in f))


def _split(a: Floats, b: Floats, c: Floats, d: Floats) -> Factors:
    """Factors of s⁴ + a s³ + b s² + c s + d, before polishing."""
    # s = y − a/4: y⁴ + P y² + Q y + R
    e = 0.25 * a
    ee = e * e
    P = -6 * ee
    P += b
    Q = 4 * ee  # Q = c + 2 e (4 e² − b)
    Q -= b
    Q *= e
    Q += Q
    Q += c
    R = -3 * ee  # R = d + e (e (b − 3 e²) − c)
    R += b
    R *= e
    R -= c
    R *= e
    R += d
    # y² ± k y + …: u = k² is the largest root of u³ + 2P u² + (P² − 4R) u − Q² = 0, never negative
    R4 = 4 * R
    u = _largest_resolvent_root(P, Q, R4)
    k = np.sqrt(u)
    total = P + u  # sum of the two constant terms; their difference is Q/k, and its square total² − 4R
    square = total * total
    square -= R4
    np.maximum(square, 0, out=square)
    size = np.sqrt(np.abs(R, out=R), out=R)
    size += np.abs(P, out=P)
    size *= u
    safe = size > square  # then the quotient is the better of the two
    difference = np.copysign(np.sqrt(square, out=square), Q, out=square)
    np.divide(Q, k, out=difference, where=safe)
    # back to s: y² + k y + q → s² + (k + 2e) s + …
    q, t = total - difference, total + difference
    q *= 0.5
    t *= 0.5
    p, r = k + e, e - k
    q += e * p
    t += e * r
    p += e
    r += e
    return Factors(p, q, r, t)


def _polished(f: Factors, a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Factors, NDArray[np.bool_]]:
    """One step of Newton's method on the equations that the product's coefficients give.

    Also where its result is good: where the equations' second-order terms are within rounding.
    """
    p, q, r, t = f
    pr, pt, qr, qt = p * r, p * t, q * r, q * t
    w = np.empty_like(p)  # holds each product until it is subtracted
    m, n = p - r, q - t
    ea = a - p
    ea -= r
    # Solve dp + dr = ea, dq + dt + r dp + p dr = eb, t dp + r dq + q dr + p dt = ec, t dq + q dt = ed
    g1 = b - q  # g1 = eb − p ea
    g1 -= t
    g1 -= pr
    g1 -= np.multiply(p, ea, out=w)
    g2 = c - pt  # g2 = ec − q ea − p g1
    g2 -= qr
    g2 -= np.multiply(q, ea, out=w)
    g2 -= np.multiply(p, g1, out=w)
    g3 = d - qt  # g3 = ed − q g1
    g3 -= np.multiply(q, g1, out=w)
    # unknowns dp, dq after dr = ea − dp, dt = g1 + m dp − dq
    #   (p m − n) dp − m dq = g2,   q m dp − n dq = g3, with the resultant of the two as determinant
    x11, x21 = p * m, q * m
    x11 -= n
    det = m * x21
    det -= np.multiply(n, x11, out=w)
    n *= g2
    dp = m * g3
    dp -= n
    dp /= det
    x11 *= g3
    x21 *= g2
    dq = np.subtract(x11, x21, out=x11)
    dq /= det
    dr = np.subtract(ea, dp, out=ea)
    m *= dp
    dt = np.add(g1, m, out=g1)
    dt -= dq
    # the second-order terms against the sums that they are left out of
    for x in (pr, pt, qr, qt):
        np.abs(x, out=x)
    pr += np.abs(q, out=w)
    pr += np.abs(t, out=w)
    pt += qr
    second = dp * dt
    second += np.multiply(dq, dr, out=w)
    good = _small(np.multiply(dp, dr, out=w), pr)
    good &= _small(second, pt)
    good &= _small(np.multiply(dq, dt, out=w), qt)
    dp += p
    dq += q
    dr += r
    dt += t
    return Factors(dp, dq, dr, dt), good


def _small(x: Floats, size: Floats) -> NDArray[np.bool_]:
    """Where |x| is within rounding of ``size``; both are overwritten."""
    size *= ROUNDING
    return np.abs(x, out=x) <= size


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


def _largest_resolvent_root(P: Floats, Q: Floats, R4: Floats) -> Floats:
    """The largest root of u³ + 2P u² + (P² − 4R) u − Q² = 0, which is not negative."""
    # w³ − 3 f w − 2 h = 0 with u = w − 2P/3, f = P²/9 + 4R/3, h = P/3 (P²/9 − 4R) + Q²/2
    third = P * (1 / 3)
    f = third * third
    h = f - R4
    h *= third
    w = R4 * (1 / 3)
    f += w
    np.multiply(Q, Q, out=w)
    w *= 0.5
    h += w
    fff = f * f
    fff *= f
    inside = np.multiply(h, h, out=w)
    inside -= fff
    several = inside <= 0
    # one real root: Cardano, without subtracting nearly equal numbers
    root = np.sqrt(np.maximum(inside, 0, out=w), out=w)
    np.copysign(root, h, out=root)
    root += h
    np.cbrt(root, out=root)
    root += np.divide(f, root, out=fff)
    # three: Viète
    f, h = f[several], h[several]
    angle = np.arccos(np.clip(h / np.sqrt(f * f * f), -1, 1))
    root[several] = 2 * np.sqrt(np.maximum(f, 0)) * np.cos(angle * (1 / 3))
    third += third
    root -= third
    return np.maximum(root, 0, out=root)


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
