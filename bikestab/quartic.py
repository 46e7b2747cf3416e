"""s⁴ + a s³ + b s² + c s + d → two real quadratics whose product it is, by closed formulas for arrays.

The split is Ferrari's and Euler's: the largest root u of the resolvent cubic is the square of half the
difference between the sums of the two pairs of roots, and never negative, so that its quadratics are real
and as far apart as any. ``bairstow`` polishes it.

Operations are in place wherever an operand is no longer needed: on tiles that fit the cache this is twice
as fast as the plain formulas, which tests/test_quartic.py has as the reference.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

# Rounding moves a quadratic's roots that are nearer to each other than the root of this share of their size.
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


def split(a: Floats, b: Floats, c: Floats, d: Floats) -> Factors:
    """The factors by closed formulas, before polishing; NaN where they overflow."""
    e, P, Q, R = _depressed(a, b, c, d)
    R4 = 4 * R
    u = _largest_resolvent_root(P, Q, R4)
    k = np.sqrt(u)
    q, t = _constant_terms(P, Q, R, R4, u, k)
    return _shifted(k, q, t, e)


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
