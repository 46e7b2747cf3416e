"""Continuous branches against numpy's eigenvalues, the published table, and nearest neighbours."""

from itertools import pairwise, permutations

import numpy as np
import pytest
from hypothesis import assume, given, settings

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.model import characteristic_table
from bikestab.modenames import BRANCHES, NAMES, OSCILLATING
from bikestab.modes import follow
from tests.strategies import lams, machines, sigmas
from tests.test_model import TWO_MASS_SKATE

PERMUTATIONS = np.array(list(permutations(range(4))))
# Meijaard et al. (2007), table 2: V, capsize, weave, castering
BENCHMARK = [
    (1, -3.13423125066578, 3.52696170990070 + 0.80774027519930j, -7.11008014637442),
    (4, -1.42944427361326, 0.41325331521125 + 3.07910818603206j, -12.15861426576450),
    (5, -0.32286642900409, -0.77534188219585 + 4.46486771378823j, -14.07838969279820),
    (7, 0.10268170574766, -2.13875644258362 + 7.19525913329805j, -18.15788466125262),
    (10, 0.16105338653172, -3.72016840437287 + 10.90681139476287j, -24.62459635017404),
]


def table_of_preset(name, lam=None, sigma=None, delta=None, model="refined"):
    own = Bicycle.preset(name).with_delta(delta)
    lam, sigma = own.lam if lam is None else lam, own.sigma if sigma is None else sigma
    return characteristic_table(own, lam, sigma, model=model)


def product(one, two):
    """The table of (s² + p s + q)(s² + r s + t); p, q, r and t are lists of coefficients of powers of V."""
    table = np.zeros((5, 4))
    for i, a in enumerate([*one[::-1], [1]]):
        for j, b in enumerate([*two[::-1], [1]]):
            c = np.convolve(a, b)
            table[i + j, : len(c)] += c
    return table


def same_as_numpy(modes, table):
    """Every column is numpy's eigenvalues, to 1e-9 of their size where no two of them nearly meet."""
    for V, values in zip(modes.V, modes.eigenvalues.T, strict=True):
        expected = np.roots((table @ V ** np.arange(4))[::-1])
        distance = np.abs(values[:, np.newaxis] - expected)
        gap = np.abs(expected[:, np.newaxis] - expected)[~np.eye(4, dtype=bool)].min()
        size = 1 + np.abs(expected).max()
        tolerance = 1e-9 * size if gap > 1e-3 * size else 1e-5 * size
        assert distance.min(axis=0).max() < tolerance
        assert distance.min(axis=1).max() < tolerance


def keeps_identity(table, V):
    """On every step the branches move less than under any exchange of two, halving until it is plain.

    Where two eigenvalues meet there is nothing to tell; steps are halved down to 1e-7 of the speed.
    """
    first = follow(table, V)
    V0, V1 = first.V[:-1], first.V[1:]
    while len(V0):
        modes = follow(table, np.concatenate([V0, V1]))
        before, after = np.hsplit(modes.eigenvalues, 2)
        cost = np.sort(np.abs(after[PERMUTATIONS] - before).max(axis=1), axis=0)
        moved = np.abs(after - before).max(axis=0)
        unclear = (moved > cost[0]) | (4 * moved >= cost[1])
        final = V1 - V0 < 1e-7 * (1 + V1)
        size = 1 + np.abs(before).max(axis=0)
        near = np.abs(modes.coalescences[:, np.newaxis] - V0).min(axis=0, initial=np.inf) < 1e-5 * (1 + V1)
        done = unclear & final
        assert np.all(moved[done] < 1e-2 * size[done])  # continuous all the same
        assert np.all((moved <= cost[0] + 1e-6 * size)[done & ~near])
        V0, V1 = V0[unclear & ~final], V1[unclear & ~final]
        middle = V0 / 2 + V1 / 2
        V0, V1 = np.concatenate([V0, middle]), np.concatenate([middle, V1])
    return first


@pytest.mark.parametrize(("V", "capsize", "weave", "castering"), BENCHMARK)
def test_published_eigenvalues_with_their_names(V, capsize, weave, castering):
    modes = follow(table_of_preset("meijaard2007"), V)
    assert modes.names[:, 0].tolist() == ["weave", "weave", "capsize", "castering"]
    expected = [weave, weave.conjugate(), capsize, castering]
    np.testing.assert_allclose(modes.eigenvalues[:, 0], expected, rtol=0, atol=1e-11)


def test_benchmark_at_rest_and_through_the_coalescence():
    modes = follow(table_of_preset("meijaard2007"), [0, 0.684, 0.6842830788, 0.6842830790, 0.7])
    at_rest = [5.53094371765393, 3.13164324790656, -3.13164324790656, -5.53094371765393]
    np.testing.assert_allclose(modes.eigenvalues[:, 0], at_rest, rtol=0, atol=1e-12)
    assert modes.coalescences == pytest.approx([0.68428307889246], abs=1e-13)
    assert modes.meeting == ((0, 1),)
    assert modes.names[0].tolist() == ["real pair"] * 3 + ["weave"] * 2
    assert modes.names[1].tolist() == modes.names[0].tolist()
    assert set(modes.names[2]) == {"capsize"}
    assert set(modes.names[3]) == {"castering"}
    assert np.all(modes.eigenvalues[0].real >= modes.eigenvalues[1].real)
    assert np.all(modes.eigenvalues[0].imag >= 0)


@pytest.mark.parametrize(
    ("lam", "sigma", "delta", "stretches"),
    [
        (0.2, 0.08, 0, [("real pair", "real pair", "capsize", "castering"),
                        ("weave", "weave", "capsize", "castering")]),
        (0.1, 0.08, 0, [("real pair", "real pair", "capsize", "castering"),
                        ("real pair", "real pair", "pair 2", "pair 2"),
                        ("weave", "weave", "pair 2", "pair 2"),
                        ("weave", "weave", "capsize", "castering")]),
        (0.05, 0.15, 0, [("real", "pair 2", "pair 2", "castering"),
                         ("real pair", "real pair", "capsize", "castering"),
                         ("weave", "weave", "capsize", "castering")]),
        (0.015, 0.1475, 0, [("weave", "weave", "capsize", "castering")]),
        (0.1, 0.08, 1, [("real pair", "real pair", "capsize", "castering"),
                        ("weave", "weave", "capsize", "castering")]),
    ],
)  # fmt: skip
def test_names_of_the_papers_bicycle(lam, sigma, delta, stretches):
    table = table_of_preset("dikarev1981", lam, sigma, delta)
    edges = [0, *follow(table, 0).coalescences, 20]
    middle = [(a + b) / 2 for a, b in pairwise(edges)]
    assert [tuple(column) for column in follow(table, middle).names.T] == stretches


@pytest.mark.parametrize("sigma", [0.04, -0.3])
def test_slow_capsize_and_castering_proportional_to_speed(sigma):
    modes = follow(table_of_preset("meijaard2007", sigma=sigma), [500.0, 1000.0])
    capsize, castering = modes.eigenvalues[2:].real
    assert modes.names[2:, 0].tolist() == ["capsize", "castering"]
    assert castering[1] / castering[0] == pytest.approx(2, rel=1e-3)
    assert capsize[1] / capsize[0] == pytest.approx(0.5, rel=1e-2)
    assert np.all(castering < 0)


def test_pairs_with_equal_real_parts_pass():
    """−V ± 3i and −1 ± i: the order along the real axis changes at V = 1, the branches do not."""
    table = product(([0, 2], [9, 0, 1]), ([2], [2]))
    V = np.array([0, 0.5, 1, 1.5, 2])
    values = follow(table, V).eigenvalues
    np.testing.assert_allclose(values[0], -V + 3j, atol=1e-12)
    np.testing.assert_allclose(values[2], np.full(5, -1 + 1j), atol=1e-12)


def test_pairs_with_equal_imaginary_parts_pass():
    """−1 ± V i and −3 ± 2 i at V = 2."""
    table = product(([2], [1, 0, 1]), ([6], [13]))
    V = np.array([0.5, 1, 2, 3, 4])
    values = follow(table, V).eigenvalues
    np.testing.assert_allclose(values[0], -1 + 1j * V, atol=1e-12)
    np.testing.assert_allclose(values[2], np.full(5, -3 + 2j), atol=1e-12)


def test_coalescence_of_each_kind_is_exact():
    """(s + 1)² = V − 2 and (s + 5)² = 3 − V: a pair becomes real at 2, a real couple a pair at 3."""
    modes = follow(product(([2], [3, -1]), ([10], [22, 1])), [1.0, 2.5, 4.0])
    assert modes.coalescences.tolist() == pytest.approx([2, 3], rel=1e-15)
    np.testing.assert_allclose(modes.eigenvalues[:2, 0], [-5 + 2**0.5, -5 - 2**0.5], rtol=1e-12)
    np.testing.assert_allclose(modes.eigenvalues[2:, 0].imag, [1, -1], rtol=1e-12)
    assert modes.names[:, 0].tolist() == ["real pair", "real pair", "pair 2", "pair 2"]
    assert modes.names[:, 1].tolist() == ["real pair", "real pair", "capsize", "castering"]
    assert modes.names[:, 2].tolist() == ["weave", "weave", "capsize", "castering"]


def test_two_coalescences_closer_than_any_grid():
    """(s + 1)² = (V − 2)² − ε²: a second pair exists only for |V − 2| < 1e-5."""
    eps = 1e-5
    modes = follow(product(([2], [1 - 4 + eps**2, 4, -1]), ([4], [104])), [1.0, 2.0, 3.0])
    assert modes.coalescences == pytest.approx([2 - eps, 2 + eps], abs=1e-10)
    assert modes.names[2].tolist() == ["capsize", "pair 2", "capsize"]
    np.testing.assert_allclose(modes.eigenvalues[2], [0, -1 + 1j * eps, 0], rtol=0, atol=1e-9)


def test_real_eigenvalues_that_touch_keep_their_order():
    """−V and −1, beside −1 ± 2i."""
    values = follow(product(([1, 1], [0, 1]), ([2], [5])), [0.5, 1.0, 2.0])
    assert len(values.coalescences) == 0
    assert np.sort(values.eigenvalues[2:].real, axis=0).tolist() == [[-1, -1, -2], [-0.5, -1, -1]]
    assert len(set(np.argmax(values.eigenvalues[2:, [0, 2]].real, axis=0))) == 1


def test_names_without_a_single_pair():
    always_real = follow(product(([3], [2]), ([0, 7], [0, 0, 12])), [1.0])  # −1, −2, −3V, −4V
    assert always_real.names[:, 0].tolist() == ["real pair", "real pair", "capsize", "castering"]
    assert always_real.eigenvalues[2:, 0] == pytest.approx([-1, -4])
    two_pairs = follow(product(([2], [2]), ([4], [29])), [1.0])  # −1 ± i, −2 ± 5i
    assert two_pairs.names[:, 0].tolist() == ["weave", "weave", "pair 2", "pair 2"]
    assert two_pairs.eigenvalues[0, 0] == pytest.approx(-2 + 5j)


def test_always_a_double_eigenvalue():
    """The discriminant is zero at every speed."""
    table = product(([2], [1]), ([2], [2, 1]))
    same_as_numpy(follow(table, np.linspace(0, 5, 11)), table)


def test_sign_of_the_leading_coefficient_does_not_matter():
    table = table_of_preset("dikarev1981", 0.1, 0.08)
    V = np.linspace(0, 10, 101)
    one, other = follow(table, V), follow(-table, V)
    assert np.array_equal(one.names, other.names)
    np.testing.assert_allclose(one.eigenvalues, other.eigenvalues, rtol=0, atol=1e-12)


def test_two_mass_skate():
    """Castering is faster than capsize also where both are proportional to V."""
    bicycle = Bicycle.from_mapping(TWO_MASS_SKATE)
    table = characteristic_table(bicycle, bicycle.lam, bicycle.sigma)
    modes = keeps_identity(table, np.linspace(0, 15, 301))
    same_as_numpy(modes, table)
    assert modes.names[:, -1].tolist() == list(BRANCHES)
    assert np.all(modes.eigenvalues[3].real < modes.eigenvalues[2].real)


@pytest.mark.parametrize("V", [-1.0, np.nan, np.inf])
def test_refused_speeds(V):
    with pytest.raises(InputError, match="V: a speed is negative or not finite"):
        follow(table_of_preset("meijaard2007"), [1.0, V])


def test_refused_infinite_eigenvalue():
    table = table_of_preset("meijaard2007")
    table[4] = 0
    with pytest.raises(InputError, match="p4 = 0"):
        follow(table, 1.0)


@pytest.mark.parametrize(
    ("preset", "lam", "sigma", "delta", "model"),
    [
        ("meijaard2007", None, None, 0, "refined"),
        ("meijaard2007", None, -0.1, 2, "refined"),
        ("dikarev1981", 0.2, 0.08, 0, "refined"),
        ("dikarev1981", 0.1, 0.08, 0, "refined"),
        ("dikarev1981", 0.05, 0.15, 1, "refined"),
        ("dikarev1981", 0.2, 0.08, 1, "unrefined"),
    ],
)
def test_presets_against_numpy_and_nearest_neighbours(preset, lam, sigma, delta, model):
    table = table_of_preset(preset, lam, sigma, delta, model)
    modes = keeps_identity(table, np.linspace(0, 12, 241))
    same_as_numpy(modes, table)


@settings(deadline=None, max_examples=25, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas)
def test_random_machines(machine, lam, sigma):
    table = characteristic_table(Bicycle.from_mapping(machine), lam, sigma)
    assume(table[4, 0] != 0)
    fine = np.linspace(0, 40, 161)
    modes = keeps_identity(table, fine)
    same_as_numpy(modes, table)
    coarse = follow(table, fine[::-8])  # backwards: a branch does not depend on the grid
    assert np.array_equal(coarse.eigenvalues, modes.eigenvalues[:, ::-8])
    assert np.array_equal(coarse.names, modes.names[:, ::-8])
    assert set(modes.names.flat) <= set(NAMES)

    real = modes.names != ""
    for name in OSCILLATING:
        real &= modes.names != name
    size = np.abs(modes.eigenvalues).max(axis=0)
    assert np.all(np.abs(modes.eigenvalues.imag[real]) < 1e-5 * np.broadcast_to(size, real.shape)[real])
    for V, (a, b) in zip(modes.coalescences, modes.meeting, strict=True):
        met = follow(table, V).eigenvalues[:, 0]
        assert abs(met[a] - met[b]) < 1e-5 * np.abs(met).max()
