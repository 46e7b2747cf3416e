"""The quartic's factors against the plain formulas of Ferrari, Cardano, Viète and Bairstow."""

import numpy as np
import pytest

from bikestab.bairstow import polished
from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.quartic import Factors, split
from bikestab.routh import coefficients_at


def plain_split(a, b, c, d):
    """Two quadratics of s⁴ + a s³ + b s² + c s + d, with s = y − e and y⁴ + P y² + Q y + R."""
    e = a / 4
    P = -6 * e**2 + b
    Q = 2 * ((4 * e**2 - b) * e) + c
    R = ((-3 * e**2 + b) * e - c) * e + d
    u = plain_resolvent_root(P, Q, R)
    k = np.sqrt(u)
    # (y² + k y + q)(y² − k y + t): q + t − k² = P, k (t − q) = Q, q t = R
    square = np.maximum((P + u) ** 2 - 4 * R, 0)
    difference = np.where(
        (np.sqrt(np.abs(R)) + np.abs(P)) * u > square, Q / k, np.copysign(np.sqrt(square), Q)
    )
    q, t = (P + u - difference) / 2, (P + u + difference) / 2
    return k + e + e, q + e * (k + e), e - k + e, t + e * (e - k)


def plain_resolvent_root(P, Q, R):
    """The largest root of u³ + 2P u² + (P² − 4R) u − Q² = 0 with u = w − 2P/3, w³ − 3 f w − 2 h = 0."""
    third = P * (1 / 3)
    f = third**2 + 4 * R * (1 / 3)
    h = (third**2 - 4 * R) * third + Q**2 * 0.5
    root = np.sqrt(np.maximum(h**2 - f * f * f, 0))
    x = np.cbrt(np.copysign(root, h) + h)
    cardano = x + f / x
    angle = np.arccos(np.clip(h / np.sqrt(f * f * f), -1, 1))
    viete = 2 * np.sqrt(np.maximum(f, 0)) * np.cos(angle * (1 / 3))
    return np.maximum(np.where(h**2 - f * f * f <= 0, viete, cardano) - (third + third), 0)


def plain_step(f, a, b, c, d):
    """Newton's step on p + r = a, q + t + p r = b, p t + q r = c, q t = d by elimination of dr and dt."""
    p, q, r, t = f
    m, n = p - r, q - t
    g0 = a - p - r
    g1 = b - q - t - p * r - p * g0
    g2 = c - p * t - q * r - q * g0 - p * g1
    g3 = d - q * t - q * g1
    x11, x21 = p * m - n, q * m
    det = m * x21 - n * x11
    dp, dq = (m * g3 - n * g2) / det, (x11 * g3 - x21 * g2) / det
    return dp, dq, g0 - dp, g1 + m * dp - dq


@pytest.fixture(scope="module", params=["dikarev1981", "meijaard2007", "kooijman2011", "sharp1971"])
def quartics(request):
    """Coefficients a, b, c, d over a plane of designs and a range of speeds."""
    bicycle = Bicycle.preset(request.param)
    table = characteristic_table(
        bicycle, np.linspace(0, 0.6, 25)[:, np.newaxis, np.newaxis], np.linspace(0, 0.2, 9)[:, np.newaxis]
    )
    p0, p1, p2, p3, p4 = coefficients_at(table, np.linspace(0.01, 30, 100))
    return [np.ascontiguousarray(p / p4) for p in (p3, p2, p1, p0)]


def test_split_in_place_is_the_plain_formulas(quartics):
    with np.errstate(all="ignore"):
        expected = plain_split(*quartics)
    for got, plain in zip(split(*quartics), expected, strict=True):
        np.testing.assert_array_equal(got, plain)


def test_step_in_place_is_the_plain_formulas(quartics):
    rough = split(*quartics)
    for got, x, dx in zip(polished(rough, *quartics)[0], rough, plain_step(rough, *quartics), strict=True):
        np.testing.assert_array_equal(got, dx + x)


def test_newtons_step_solves_the_linear_equations():
    """Each sum of first-order terms is what the product lacks of a coefficient."""
    rng = np.random.default_rng(7)
    a, b, c, d = rng.normal(size=(4, 500))
    f = Factors(*rng.normal(size=(4, 500)))
    p, q, r, t = f
    dp, dq, dr, dt = (new - old for new, old in zip(polished(f, a, b, c, d)[0], f, strict=True))
    lacks = a - p - r, b - q - t - p * r, c - p * t - q * r, d - q * t
    sums = dp + dr, dq + dt + r * dp + p * dr, t * dp + r * dq + q * dr + p * dt, t * dq + q * dt
    size = 1 + np.abs([dp, dq, dr, dt]).max(axis=0)
    for lack, total in zip(lacks, sums, strict=True):
        assert np.all(np.abs(lack - total) < 1e-12 * size)


@pytest.mark.parametrize("n", [*range(1, 34), 255, 1000])
def test_bits_do_not_depend_on_the_company(quartics, n):
    """What numpy's cbrt, arccos and cos take at once must not matter."""
    every = [x.reshape(-1)[:2000] for x in quartics]
    expected = np.array(split(*every))
    for start in (0, 1, 3, 700):
        part = [x[start : start + n] for x in every]
        assert np.array_equal(split(*part), expected[:, start : start + n], equal_nan=True)
        strided = [np.repeat(x, 2)[::2] for x in part]
        assert np.array_equal(split(*strided), expected[:, start : start + n], equal_nan=True)
