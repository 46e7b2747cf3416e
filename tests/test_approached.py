"""Doubles near zeros: by the compiled library the same bits as by numpy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab import approached, kernels
from bikestab.bicycle import Bicycle
from bikestab.critical import critical
from bikestab.model import exact_table
from bikestab.speeds import intervals_of
from bikestab.twofold import Double
from tests.strategies import machines

needed = pytest.mark.skipif(kernels.library() is None, reason="no C compiler has made the library")


def assert_same(found, expected):
    for name, values in expected.items():
        np.testing.assert_array_equal(found[name], values, err_msg=name)


def everything(table):
    """All that is found for a table, by names."""
    speeds, sign, zeros = critical(table)
    parts = {f"{name} {part}": x for name, z in zeros.items() for part, x in z._asdict().items()}
    return parts | speeds | {f"{name} before": x for name, x in sign.items()} | intervals_of(table).arrays()


def both_ways(compute):
    """The results of a function with the library and without it, however few cells there are."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(approached, "_FEW", 0)
        by_library = compute()
        patch.setattr(kernels, "library", lambda: None)
        return by_library, compute()


@needed
@pytest.mark.parametrize("delta", [1e-9, 1e-3, 1.0, 30.0])
@pytest.mark.parametrize("name", ["dikarev1981", "meijaard2007", "kooijman2011", "sharp1971"])
def test_usual_machines(name, delta):
    bicycle = Bicycle.preset(name).with_delta(delta)
    table = exact_table(bicycle, np.linspace(-0.3, 0.7, 29)[:, np.newaxis], np.linspace(-0.3, 0.5, 31))
    assert_same(*both_ways(lambda: everything(table)))


@needed
@settings(max_examples=30)
@given(machines.map(Bicycle.from_mapping), st.floats(1e-9, 30), st.integers(0, 2**32 - 1))
def test_random_machines(bicycle, delta, seed):
    lam, sigma = np.random.default_rng(seed).uniform(-0.5, 1, (2, 40))
    table = exact_table(bicycle.with_delta(delta), lam, sigma)
    assert_same(*both_ways(lambda: everything(table)))


@needed
@pytest.mark.parametrize("powers", [4, 7])
@pytest.mark.parametrize("scale", [1e-40, 1e-3, 1.0, 1e30])
def test_random_polynomials(powers, scale):
    """Many with zeros close to each other, on the places where intervals are cut, and with powers missing."""
    random = np.random.default_rng(powers)
    zeros = random.choice(
        [-2, 0.3, 0.171875, 0.6875, 1.375, 1.4, 1.4 + 1e-5, 1.4 + 1e-11, 8], (500, powers - 1)
    )
    zeros = zeros * scale ** random.choice([0, 1], (500, 1))
    c = np.array([np.polynomial.polynomial.polyfromroots(z) for z in zeros]).T
    c *= np.where(random.random(c.shape) < 0.1, 0.0, 1 + random.choice([0, 1e-9], c.shape))
    doubles = [Double(a, np.abs(a)) for a in c]
    (V, undecided), (expected, left) = both_ways(lambda: approached.zeros_near(doubles, 500))
    np.testing.assert_array_equal(V, expected)
    np.testing.assert_array_equal(undecided, left)
    assert np.isfinite(V).any()
    assert undecided.any()
    assert not undecided.all()


def test_other_lengths_and_no_library():
    one = Double(np.ones(300), np.ones(300))
    line = [Double(-np.arange(1.0, 301), np.arange(1.0, 301)), one]
    V, undecided = approached.zeros_near(line, 300)
    np.testing.assert_allclose(V[0], np.arange(1.0, 301), rtol=1e-7)
    assert not undecided.any()
