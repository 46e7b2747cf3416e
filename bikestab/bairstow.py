"""Two quadratics → nearer to a quartic as its factors, by Newton's method on the coefficients (Bairstow).

In place like ``quartic``, with the plain formulas in tests/test_quartic.py.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.quartic import Factors

# What Newton's step leaves of the product's coefficients is the second-order terms of that step; the split is
# good where they are within this share of the coefficients.
SECOND_ORDER = 2.0**-64
SETTLED = 2.0**-32  # the same of a second step, by how far it moves the factors
# Two quadratics whose resultant is below this share of their coefficients nearly have a root in common, and
# rounding moves them.
COMMON = 2.0**-24


class _Residuals(NamedTuple):
    """What the coefficients of s³ … s⁰ lack in the product, each less its share of those before.

    Newton's step solves dp + dr = g0, dq + dt − m dp = g1, (p m − n) dp − m dq = g2 and q m dp − n dq = g3
    with m = p − r and n = q − t.
    """

    g0: Floats
    g1: Floats
    g2: Floats
    g3: Floats


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
