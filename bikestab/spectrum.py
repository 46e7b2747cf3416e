"""(table, V) → eigenvalues and growth rate, without a matrix per point.

The quartic is split into two real quadratics by the largest root of its resolvent cubic (Ferrari,
Euler), and the split is polished by Newton's method on the coefficients themselves (Bairstow).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.model import Floats
from bikestab.routh import coefficients_at


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
    return np.maximum(_largest_real_part(p, q), _largest_real_part(r, t))


def eigenvalues(table: Floats, V: ArrayLike) -> NDArray[np.complex128]:
    """The four eigenvalues [s⁻¹] at the speeds V [m/s], in no particular order; shape (4, *shape)."""
    p, q, r, t = quadratic_factors(table, V)
    return np.array([*_roots(p, q), *_roots(r, t)])


def quadratic_factors(table: Floats, V: ArrayLike) -> Factors:
    """Two real quadratics whose product is the characteristic polynomial divided by p4."""
    p0, p1, p2, p3, p4 = coefficients_at(table, V)
    with np.errstate(all="ignore"):
        scale = 1 / p4
        return _factors(p3 * scale, p2 * scale, p1 * scale, p0 * scale)


def _factors(a: Floats, b: Floats, c: Floats, d: Floats) -> Factors:
    """Factors of s⁴ + a s³ + b s² + c s + d."""
    # s = y − a/4: y⁴ + P y² + Q y + R
    e = 0.25 * a
    ee = e * e
    P = b - 6 * ee
    Q = c + 2 * e * (4 * ee - b)
    R = d + e * (e * (b - 3 * ee) - c)
    # y² ± k y + …: u = k² is the largest root of u³ + 2P u² + (P² − 4R) u − Q² = 0, never negative
    u = np.maximum(_largest_cubic_root(2 * P, P * P - 4 * R, -Q * Q), 0)
    k = np.sqrt(u)
    total = P + u  # sum of the two constant terms; their difference is Q/k, and its square total² − 4R
    square = np.maximum(total * total - 4 * R, 0)
    safe = u * (np.abs(P) + np.sqrt(np.abs(R))) > square  # then the quotient is the better of the two
    difference = np.where(safe, Q / np.where(safe, k, 1), np.copysign(np.sqrt(square), Q))
    q, t = 0.5 * (total - difference), 0.5 * (total + difference)
    # back to s: y² + k y + q → s² + (k + 2e) s + …
    p, r = k + 2 * e, 2 * e - k
    q, t = q + e * (k + e), t + e * (e - k)
    return _polished(Factors(p, q, r, t), a, b, c, d)


def _polished(f: Factors, a: Floats, b: Floats, c: Floats, d: Floats) -> Factors:
    """One step of Newton's method on the four equations that the product's coefficients give."""
    p, q, r, t = f
    ea = a - (p + r)
    eb = b - (q + t + p * r)
    ec = c - (p * t + q * r)
    ed = d - q * t
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
    return Factors(p + dp, q + dq, r + dr, t + dt)


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
