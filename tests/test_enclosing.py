"""Zeros between doubles with certain signs, against zeros that are known."""

import numpy as np

from bikestab.enclosing import enclosed
from bikestab.rounding import COEFFICIENT
from bikestab.twofold import Twofold


def test_zeros_in_brackets():
    """(x − 1)(x − 3)², in brackets of one zero each."""
    c = [Twofold(np.full(3, a), 0.0) for a in (-9.0, 15.0, -7.0, 1.0)]
    low, high = np.array([0.0, 0.5, 0.9]), np.array([2.0, 2.5, 1.25])
    x, radius, certain = enclosed(c, low, high, np.ones(3), COEFFICIENT)
    assert certain.all()
    assert (np.abs(x - 1) <= radius).all()
    assert (radius < 1e-15).all()


def test_ends_at_zero_and_infinity():
    """x³ = 2^300 and x = 2^−100: far outside of what entries near one give."""
    far = [Twofold(np.array([-(2.0**300)])), None, None, Twofold(np.array([1.0]))]
    near = [Twofold(np.array([-(2.0**-100)])), Twofold(np.array([1.0])), None]
    for c, right in ((far, 2.0**100), (near, 2.0**-100)):
        x, radius, certain = enclosed(c, np.array([0.0]), np.array([np.inf]), np.ones(1), COEFFICIENT)
        assert certain.all()
        assert abs(x[0] - right) <= radius[0] <= 1e-15 * right


def test_what_rounding_leaves_open():
    """Where terms are 1e22 times the polynomial a zero is known less closely; where 1e40, not at all."""
    for size, most in ((1e12, 2e-15), (1e22, 1e-5), (1e40, None)):
        c = [Twofold(np.array([a]), 0.0, np.array([size])) for a in (-1.0, 1.0)]
        x, radius, certain = enclosed(c, np.array([0.5]), np.array([4.0]), np.ones(1), COEFFICIENT)
        assert certain[0] == (most is not None)
        if most:
            assert abs(x[0] - 1) <= 3e-16
            assert 4 * COEFFICIENT * size <= radius[0] <= most
