"""s⁴ + a s³ + b s² + c s + d → two real quadratics whose product it is, for arrays of coefficients.

The split is Ferrari's and Euler's: the largest root u of the resolvent cubic is the square of half the
difference between the sums of the two pairs of roots, and never negative, so that its quadratics are real
and as far apart as any. It is then polished by one step of Newton's method on the coefficients of the
product (Bairstow).

Operations are in place wherever an operand is no longer needed: on tiles that fit the cache this is twice
as fast as the plain formulas, which tests/test_quartic.py has as the reference.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

# What Newton's step leaves of the product's coefficients is the second-order terms of that step; the split is
# good where they are within this share of the coefficients.
SECOND_ORDER = 2.0**-64
SETTLED = 2.0**-32  # the same of a second step, by how far it moves the factors
# Two quadratics whose resultant is below this share of their coefficients nearly have a root in common, and
# rounding moves them; so it does the roots of one that are nearer than the root of this share of their size.
COMMON = 2.0**-24
NEAR = 2.0**-26


class Factors(NamedTuple):
    """s⁴ + … = (s² + p s + q)(s² + r s + t), all real."""

    p: Floats
    q: Floats
    r: Floats
    t: Floats


class Quadratic(NamedTuple):
    """s² + 2 half s + q; its roots are −half ± √square, square = half² − q."""

    half: Floats
    square: Floats
    q: Floats


class _Depressed(NamedTuple):
    """y⁴ + P y² + Q y + R with s = y − e."""

    e: Floats
    P: Floats
    Q: Floats
    R: Floats


class _Residuals(NamedTuple):
    """What the coefficients of s³ … s⁰ lack in the product, each less its share of those before.

    Newton's step solves dp + dr = g0, dq + dt − m dp = g1, (p m − n) dp − m dq = g2 and q m dp − n dq = g3
    with m = p − r and n = q − t.
    """

    g0: Floats
    g1: Floats
    g2: Floats
    g3: Floats


def split(a: Floats, b: Floats, c: Floats, d: Floats) -> Factors:
    """The factors by closed formulas, before polishing; NaN where they overflow."""
    e, P, Q, R = _depressed(a, b, c, d)
    R4 = 4 * R
    u = _largest_resolvent_root(P, Q, R4)
    k = np.sqrt(u)
    q, t = _constant_terms(P, Q, R, R4, u, k)
    return _shifted(k, q, t, e)


def polished(f: Factors, a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Factors, NDArray[np.bool_]]:
    """One step of Newton's method on the equations that the product's coefficients give (Bairstow).

    Also where its result is good: where the equations' second-order terms are within rounding, and the
    quadratics have no root nearly in common.
    """
    p, q, r, t = f
    products = p * r, p * t, q * r, q * t
    step, resultant = _newton_step(f, _residuals(f, products, a, b, c, d))
    good = _second_order_is_small(f, products, step, resultant)
    for x, dx in zip(f, step, strict=True):
        dx += x
    return step, good


def settled(f: Factors, g: Factors) -> NDArray[np.bool_]:
    """Where two splits are the same but for SETTLED of the largest root, without a root nearly in common."""
    p, q, r, t = f
    size = np.abs(p * r) + np.abs(q) + np.abs(t)
    m, n = p - r, q - t
    apart = np.abs(q * m * m - p * m * n + n * n) >= COMMON * size * size
    dp, dq, dr, dt = (np.abs(x - y) for x, y in zip(f, g, strict=True))
    return apart & (np.maximum(dp, dr) <= SETTLED * np.sqrt(size)) & (np.maximum(dq, dt) <= SETTLED * size)


def quadratic(p: Floats, q: Floats) -> tuple[Quadratic, NDArray[np.bool_]]:
    """The quadratic s² + p s + q, and where its roots are so far apart that rounding does not move them.

    Uses p up.
    """
    p *= 0.5
    square = p * p
    least = square * NEAR
    square -= q
    return Quadratic(p, square, q), np.abs(square) >= least


def _depressed(a: Floats, b: Floats, c: Floats, d: Floats) -> _Depressed:
    """The quartic in y = s + a/4, without its cubic term."""
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
    return _Depressed(e, P, Q, R)


def _largest_resolvent_root(P: Floats, Q: Floats, R4: Floats) -> Floats:
    """The largest root of u³ + 2P u² + (P² − 4R) u − Q² = 0, which is not negative.

    With w = u + 2P/3 the cubic is w³ − 3 f w − 2 h = 0.
    """
    third = P * (1 / 3)
    f = third * third  # f = P²/9 + 4R/3
    h = f - R4  # h = P/3 (P²/9 − 4R) + Q²/2
    h *= third
    part = R4 * (1 / 3)
    f += part
    np.multiply(Q, Q, out=part)
    part *= 0.5
    h += part
    w = _largest_cubic_root(f, h)
    third += third
    w -= third
    return np.maximum(w, 0, out=w)


def _largest_cubic_root(f: Floats, h: Floats) -> Floats:
    """The largest root of w³ − 3 f w − 2 h = 0, if it has three, else the only one."""
    fff = f * f
    fff *= f
    inside = h * h
    inside -= fff
    three = inside <= 0
    # Cardano, without subtracting nearly equal numbers: w = x + f/x
    w = np.sqrt(np.maximum(inside, 0, out=inside), out=inside)
    np.copysign(w, h, out=w)
    w += h
    np.cbrt(w, out=w)
    w += np.divide(f, w, out=fff)
    # Viète: w = 2 √f cos(arccos(h/√f³)/3)
    f, h = f[three], h[three]
    angle = np.arccos(np.clip(h / np.sqrt(f * f * f), -1, 1))
    w[three] = 2 * np.sqrt(np.maximum(f, 0)) * np.cos(angle * (1 / 3))
    return w


def _constant_terms(
    P: Floats, Q: Floats, R: Floats, R4: Floats, u: Floats, k: Floats
) -> tuple[Floats, Floats]:
    """Of y² + k y + q and y² − k y + t; uses R up.

    Their sum is P + u, their difference t − q = Q/k, and its square (P + u)² − 4R.
    """
    total = P + u
    square = total * total
    square -= R4
    np.maximum(square, 0, out=square)
    size = np.sqrt(np.abs(R, out=R), out=R)
    size += np.abs(P)
    size *= u
    quotient = size > square  # is then the better of the two
    difference = np.copysign(np.sqrt(square, out=square), Q, out=square)
    np.divide(Q, k, out=difference, where=quotient)
    q, t = total - difference, total + difference
    q *= 0.5
    t *= 0.5
    return q, t


def _shifted(k: Floats, q: Floats, t: Floats, e: Floats) -> Factors:
    """From y = s + e back to s: y² + k y + q is s² + (k + 2e) s + q + e (k + e); uses q and t up."""
    p, r = k + e, e - k
    q += e * p
    t += e * r
    p += e
    r += e
    return Factors(p, q, r, t)


def _residuals(
    f: Factors, products: tuple[Floats, ...], a: Floats, b: Floats, c: Floats, d: Floats
) -> _Residuals:
    p, q, r, t = f
    pr, pt, qr, qt = products
    w = np.empty_like(p)  # holds each product until it is subtracted
    g0 = a - p
    g0 -= r
    g1 = b - q  # g1 = b − (q + t + p r) − p g0
    g1 -= t
    g1 -= pr
    g1 -= np.multiply(p, g0, out=w)
    g2 = c - pt  # g2 = c − (p t + q r) − q g0 − p g1
    g2 -= qr
    g2 -= np.multiply(q, g0, out=w)
    g2 -= np.multiply(p, g1, out=w)
    g3 = d - qt  # g3 = d − q t − q g1
    g3 -= np.multiply(q, g1, out=w)
    return _Residuals(g0, g1, g2, g3)


def _newton_step(f: Factors, residuals: _Residuals) -> tuple[Factors, Floats]:
    """(dp, dq, dr, dt) by Cramer's rule, and the determinant; uses the residuals up."""
    p, q, r, t = f
    g0, g1, g2, g3 = residuals
    m, n = p - r, q - t
    w = np.empty_like(p)
    x11, x21 = p * m, q * m
    x11 -= n
    det = m * x21  # the resultant of the two quadratics
    det -= np.multiply(n, x11, out=w)
    n *= g2
    dp = m * g3
    dp -= n
    dp /= det
    x11 *= g3
    x21 *= g2
    dq = np.subtract(x11, x21, out=x11)
    dq /= det
    dr = np.subtract(g0, dp, out=g0)
    m *= dp
    dt = np.add(g1, m, out=g1)
    dt -= dq
    return Factors(dp, dq, dr, dt), det


def _second_order_is_small(
    f: Factors, products: tuple[Floats, ...], step: Factors, resultant: Floats
) -> NDArray[np.bool_]:
    """Where dp dr, dp dt + dq dr and dq dt are within rounding of the sums that they are left out of.

    And where the resultant is not small; uses it up.
    """
    dp, dq, dr, dt = step
    w = np.empty_like(dp)
    pr, pt, qr, qt = (np.abs(x, out=x) for x in products)
    pr += np.abs(f.q, out=w)
    pr += np.abs(f.t, out=w)
    pt += qr
    second = dp * dt
    second += np.multiply(dq, dr, out=w)
    least = pr * pr
    least *= COMMON
    good = np.abs(resultant, out=resultant) >= least
    good &= _small(np.multiply(dp, dr, out=w), pr)
    good &= _small(second, pt)
    good &= _small(np.multiply(dq, dt, out=w), qt)
    return good


def _small(x: Floats, size: Floats) -> NDArray[np.bool_]:
    """Where |x| is within rounding of ``size``; both are overwritten."""
    size *= SECOND_ORDER
    return np.abs(x, out=x) <= size
