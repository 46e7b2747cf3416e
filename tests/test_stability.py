"""The answers for a machine, against those for its table, numpy's eigenvalues, and each other."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import bikestab as bs
from bikestab.limits import LEAST
from bikestab.model import canonical_matrices, exact_table
from bikestab.speeds import intervals_of
from tests.strategies import lams, machines, sigmas

MEIJAARD = bs.Bicycle.preset("meijaard2007")
DIKAREV = bs.Bicycle.preset("dikarev1981")  # without a design of its own


def state_matrix(bicycle, lam, sigma, V):
    """The motion as ẋ = A x, from the equations of motion, damping in the steer equation."""
    M, C1, K0, K2 = canonical_matrices(bicycle, lam, sigma)
    C = V * C1 + np.diag([0, bicycle.delta])
    K = bicycle.g * K0 + V**2 * K2
    return np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])


@pytest.mark.parametrize("delta", [None, 0.7])
def test_eigenvalues_are_those_of_the_equations_of_motion(delta):
    lam, sigma, V = np.array([[0.2], [0.35]]), 0.06, np.array([0.0, 2.0, 5.5])
    found = bs.eigenvalues(MEIJAARD, V, lam, sigma, delta=delta)
    growth = bs.growth_rate(MEIJAARD, V, lam, sigma, delta=delta)
    assert found.shape == (4, 2, 3)
    assert growth.shape == (2, 3)
    machine = MEIJAARD.with_delta(delta)
    for i, j in np.ndindex(2, 3):
        expected = np.linalg.eigvals(state_matrix(machine, lam[i, 0], sigma, V[j])).astype(complex)
        assert np.sort_complex(found[:, i, j]) == pytest.approx(np.sort_complex(expected), rel=1e-8, abs=1e-7)
        assert growth[i, j] == pytest.approx(expected.real.max(), rel=1e-8, abs=1e-7)


def test_one_number_gives_no_axes():
    assert bs.eigenvalues(MEIJAARD, 5.0).shape == (4,)
    for function in (bs.growth_rate, bs.stable):
        assert np.shape(function(MEIJAARD, 5)) == ()
    assert bs.stable_intervals(MEIJAARD).V1.shape == (1,)


def test_its_own_design_and_that_design_given():
    own, given_, mixed = (
        bs.stable_intervals(MEIJAARD, *design)
        for design in ((), (MEIJAARD.lam, MEIJAARD.sigma), (None, [MEIJAARD.sigma]))
    )
    for a, b, c in zip(own, given_, mixed, strict=True):
        np.testing.assert_array_equal(a, b)
        np.testing.assert_array_equal(a, c[0])


def test_shapes_broadcast_together():
    lam, sigma = np.linspace(0, 0.3, 5)[:, None, None], np.linspace(0, 0.15, 4)[:, None]
    V = np.linspace(0, 10, 3)
    found = bs.stable_intervals(DIKAREV, lam, sigma)
    assert found.V1.shape[:-1] == (5, 4, 1)
    stable = bs.stable(DIKAREV, V, lam, sigma)
    assert stable.shape == bs.growth_rate(DIKAREV, V, lam, sigma).shape == (5, 4, 3)
    for index in np.ndindex(5, 4, 3):
        i, j, k = index
        one = bs.stable(DIKAREV, V[k], lam[i, 0, 0], sigma[j, 0])
        assert one == stable[index]
    for a, b in zip(found, intervals_of(exact_table(DIKAREV, lam, sigma)), strict=True):
        np.testing.assert_array_equal(a, b)


@given(machine=machines, lam=lams, sigma=sigmas, V=st.just(0.0) | st.floats(LEAST, 30))
def test_stable_where_everything_dies_out(machine, lam, sigma, V):
    bicycle = bs.Bicycle.from_mapping(machine)
    growth = float(bs.growth_rate(bicycle, V, lam, sigma))
    size = np.abs(bs.eigenvalues(bicycle, V, lam, sigma)).max()
    if abs(growth) > 1e-6 * size:  # else rounding decides
        assert bs.stable(bicycle, V, lam, sigma) == (growth < 0)


@pytest.mark.parametrize("delta", [0.0, 3.0])
def test_stable_at_rest_and_between_the_ends(delta):
    lam, sigma = np.linspace(-0.2, 0.5, 8)[:, None], np.linspace(-0.05, 0.2, 6)
    found = bs.stable_intervals(MEIJAARD, lam, sigma, delta=delta)
    V = np.where(np.isinf(found.V2), 2 * found.V1 + 1, 0.5 * (found.V1 + found.V2))
    for k in range(V.shape[-1]):
        there = np.isfinite(V[..., k])
        speeds = np.where(there, V[..., k], 1.0)
        assert bs.stable(MEIJAARD, speeds, lam, sigma, delta=delta)[there].all()
    at_rest = bs.growth_rate(MEIJAARD, 0.0, lam, sigma, delta=delta)
    assert not bs.stable(MEIJAARD, 0.0, lam, sigma, delta=delta).any()  # a bicycle falls
    assert at_rest.min() > 0


def test_text_with_units():
    assert bs.stable(MEIJAARD, "18km/h", lam="18deg") == bs.stable(MEIJAARD, 5.0, lam=np.pi / 10)
    two = bs.stable_intervals(MEIJAARD, lam=["18deg", "0.3"])
    np.testing.assert_array_equal(two.V1[0], bs.stable_intervals(MEIJAARD, lam=18 * np.pi / 180).V1)


def test_models_and_damping():
    refined, unrefined = (bs.stable_intervals(DIKAREV, 0.2, 0.08, model=m) for m in ("refined", "unrefined"))
    assert refined.number == 1
    assert unrefined.number == 0
    assert not np.array_equal(refined.V1, bs.stable_intervals(DIKAREV, 0.2, 0.08, delta=1).V1)


def test_modes_are_the_eigenvalues():
    V = [3.0, 5.0, 8.0]
    found = bs.modes(MEIJAARD, V)
    np.testing.assert_allclose(
        np.sort_complex(found.eigenvalues.T), np.sort_complex(bs.eigenvalues(MEIJAARD, V).T), rtol=1e-12
    )
    assert bs.modes(MEIJAARD, 5).eigenvalues.shape == (4, 1)


@pytest.mark.parametrize(
    ("call", "key", "words"),
    [
        (lambda: bs.stable_intervals(DIKAREV), "lam", "no lam and no sigma of its own"),
        (lambda: bs.stable_intervals(DIKAREV, 0.2), "sigma", "give one, for example sigma=0.08"),
        (lambda: bs.stable_intervals("meijaard2007"), "bicycle", "Bicycle.load"),
        (lambda: bs.stable_intervals(MEIJAARD, [0.1, 2.0]), "lam", "tilted by 2 rad"),
        (lambda: bs.stable_intervals(MEIJAARD, [0.1, np.nan]), "lam", "nan"),
        (lambda: bs.stable_intervals(MEIJAARD, sigma=-1e3), "sigma", "out of range"),
        (lambda: bs.stable_intervals(MEIJAARD, "18dge"), "lam", "'18dge' is not a number"),
        (lambda: bs.stable_intervals(MEIJAARD, [None]), "lam", "not a number"),
        (lambda: bs.stable_intervals(MEIJAARD, model="refind"), "model", "did you mean 'refined'"),
        (lambda: bs.stable_intervals(MEIJAARD, delta=-1), "delta", "non-negative"),
        (lambda: bs.growth_rate(MEIJAARD, [1, -1]), "V", "-1 is a speed backwards"),
        (lambda: bs.stable(MEIJAARD, np.inf), "V", "out of range"),
        (lambda: bs.eigenvalues(MEIJAARD, True), "V", "not a number"),
        (lambda: bs.modes(MEIJAARD, 5, [0.1, 0.2]), "lam, sigma", "one design"),
        (lambda: bs.modes(MEIJAARD, [[5.0]]), "V", "one row of speeds"),
    ],
)
def test_mistakes(call, key, words):
    with pytest.raises(bs.InputError) as error:
        call()
    assert error.value.key == (key,)
    assert words in str(error.value)


def test_shapes_that_do_not_fit():
    with pytest.raises(bs.InputError, match="do not broadcast"):
        bs.stable(MEIJAARD, [1, 2, 3], lam=[0.1, 0.2])
