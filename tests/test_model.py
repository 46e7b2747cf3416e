"""The table of the characteristic polynomial against other codes and in 40 digits."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from bicycleparameters.bicycle import benchmark_par_to_canonical
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from bikestab.bicycle import Bicycle
from bikestab.machines import Machines
from bikestab.model import MODELS, canonical_matrices, characteristic_table, coefficients, exact_table
from bikestab.rounding import ENTRY
from bikestab.speeds import KINDS, intervals_of
from tests.references import generate_speeds as reference
from tests.strategies import lams, machines, meijaard_machines, paper_machines, sigmas

EPS = np.finfo(float).eps
ENTRIES = {(4, 0), (3, 1), (3, 0), (2, 2), (2, 0), (1, 3), (1, 1), (1, 0), (0, 2), (0, 0)}

# Kooijman et al. (2011): two point masses on skates, without trail and gyroscopic effect, stable.
TWO_MASS_SKATE = {
    "w": 1, "c": 0, "lam": "5deg", "xB": 1.2, "zB": -0.4, "mB": 10, "xH": 1.02, "zH": -0.2, "mH": 1,
    "rR": 0, "mR": 0, "IRxx": 0, "IRyy": 0, "rF": 0, "mF": 0, "IFxx": 0, "IFyy": 0,
    "IBxx": 0, "IBzz": 0, "IBxz": 0, "IHxx": 0, "IHzz": 0, "IHxz": 0,
}  # fmt: skip


def canonical(machine, lam, sigma):
    """The matrices of BicycleParameters for a machine with another tilt and trail."""
    return benchmark_par_to_canonical({**machine, "lam": lam, "c": sigma * machine["w"]})


def test_two_rows_of_more_cells_than_are_worked_on_at_a_time():
    bicycle = Bicycle.preset("dikarev1981")
    lam, sigma = np.array([[0.1], [0.3]]), np.linspace(0, 0.1, 13_000)
    table = characteristic_table(bicycle, np.broadcast_to(lam, (2, 13_000)), sigma)
    for row in range(2):
        np.testing.assert_array_equal(table[:, :, row], characteristic_table(bicycle, lam[row], sigma))


def test_gains_in_proportion_to_the_inverse_speed_have_a_column_of_their_own():
    bicycle = Bicycle.preset("meijaard2007").replaced({"k_phi_per_V": 1.5})
    assert characteristic_table(bicycle, 0.3, 0.08).shape == (5, 5)
    assert exact_table(bicycle, 0.3, 0.08).shape == (5, 5)


@settings(deadline=None, max_examples=100, derandomize=True)
@given(machine=meijaard_machines(), lam=lams, sigma=sigmas)
def test_canonical_matrices_of_bicycleparameters(machine, lam, sigma):
    """To 1e-13 of each matrix's largest entry: both codes round sums of some ten terms."""
    found = canonical_matrices(Bicycle.from_mapping(machine), lam, sigma)
    for got, expected in zip(found, canonical(machine, lam, sigma), strict=True):
        assert got == pytest.approx(expected, rel=0, abs=1e-13 * np.abs(expected).max())


@settings(deadline=None, max_examples=100, derandomize=True)
@given(machine=meijaard_machines(), lam=lams, sigma=sigmas, delta=st.just(0.0) | st.floats(1e-9, 10))
def test_table_is_the_determinant(machine, lam, sigma, delta):
    """c² det(M s² + (V C1 + δ) s + g K0 + V² K2), with the independent matrices."""
    M, C1, K0, K2 = canonical(machine, lam, sigma)
    matrix = np.zeros((3, 3, 2, 2))  # [power of s, power of V]
    matrix[2, 0], matrix[1, 1], matrix[0, 0], matrix[0, 2] = M, C1, machine["g"] * K0, K2
    matrix[1, 0, 1, 1] = delta
    expected, size = np.zeros((5, 5)), np.zeros((5, 5))
    norm = np.abs(matrix).max(axis=(2, 3))
    for k, j, m, n in np.ndindex(3, 3, 3, 3):
        a, b = matrix[k, j], matrix[m, n]
        expected[k + m, j + n] += a[0, 0] * b[1, 1] - a[0, 1] * b[1, 0]
        size[k + m, j + n] += norm[k, j] * norm[m, n]
    table = characteristic_table(Bicycle.from_mapping({**machine, "delta": delta}), lam, sigma)
    error = np.abs(table / machine["w"] ** 2 - expected[:, :4])
    assert np.all(error <= 1e-13 * size[:, :4])  # the matrices agree to that share of their largest entry
    assert np.all(expected[:, 4] == 0)


@pytest.mark.parametrize("model", MODELS)
@settings(deadline=None, max_examples=60, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas, delta=st.just(0.0) | st.floats(1e-3, 10))
def test_table_in_40_digits(model, machine, lam, sigma, delta):
    """Each entry within its bound, rounded to the nearest double, and no entry the theory does not have."""
    machine = {key: value for key, value in machine.items() if key != "delta"}
    bicycle = Bicycle.from_mapping({**machine, "delta": delta})
    if bicycle.bodies is not None:  # the wheelbase divides the trail before it divides the entries
        machine = {**machine, "c": sigma * machine["w"]}
    table, rest, error = exact_table(bicycle, lam, sigma, model=model)
    plain = characteristic_table(bicycle, lam, sigma, model=model)
    assert (
        np.abs(plain - table) <= 60 * EPS * error / ENTRY
    ).all()  # of the terms' sizes; zero where there are none
    with mp.workdps(40):
        exact = reference.polynomial(machine, lam, sigma, delta, model)
        for k, j in np.ndindex(5, 4):
            entry = exact.get((k, j), reference.Sum(0))
            assert abs(mpf(table[k, j]) + mpf(rest[k, j]) - entry.value) <= error[k, j]
            assert abs(table[k, j] - entry.value) <= 0.500001 * EPS * abs(entry.value) + error[k, j]
    assert {index for index in np.ndindex(5, 4) if table[index]} <= ENTRIES


def test_refinement_is_in_the_gravity_terms_only():
    bicycle = Bicycle.preset("dikarev1981")
    refined, unrefined = (coefficients(bicycle, 0.2, 0.1, model=model) for model in MODELS)
    differ = {
        name for name in refined._fields if getattr(refined, name).value != getattr(unrefined, name).value
    }
    assert differ == {"a4", "b3", "b6"}
    l, c1 = 80 * 0.4 + 2.7 * 0.9, 0.1 * 1.04 * math.cos(0.2)  # noqa: E741  # the paper's letter
    assert refined.a4.value - unrefined.a4.value == pytest.approx(9.8 * l * c1, rel=1e-13)


def test_without_trail_the_models_agree():
    bicycle = Bicycle.preset("dikarev1981")
    refined, unrefined = (characteristic_table(bicycle, 0.2, 0.0, model=model) for model in MODELS)
    assert np.array_equal(refined, unrefined)


def test_unknown_model():
    with pytest.raises(ValueError, match="'fine', not one of"):
        characteristic_table(Bicycle.preset("dikarev1981"), 0.2, 0.1, model="fine")


def test_exact_zero_of_the_two_mass_skate():
    """Its p0 does not depend on V; a rounded V² term would give it a capsize speed of about 1e8 m/s."""
    bicycle = Bicycle.from_mapping(TWO_MASS_SKATE)
    table = characteristic_table(bicycle, bicycle.lam, bicycle.sigma)
    assert table[0, 2] == 0
    found = intervals_of(table)
    assert found.V1.tolist() == pytest.approx([2.841], abs=5e-4)
    assert found.V2.tolist() == [np.inf]
    assert (KINDS[found.lower[0]], KINDS[found.upper[0]]) == ("weave", "unbounded")


@pytest.mark.parametrize("C1", [0, 1e-12, 1e-6])
def test_tiny_but_true_coefficient_is_kept(C1):
    """p0's V² term is c g cos λ C1° S for a skate with a little spin: 1e-13 of the terms it is left of."""
    n = {**TWO_MASS_SKATE, "rR": 0.5, "IRyy": C1}
    bicycle = Bicycle.from_mapping(n)
    lam = bicycle.lam
    S = bicycle.m2 * (bicycle.h2 * math.sin(lam) + (bicycle.l2 - 1) * math.cos(lam))
    got = characteristic_table(bicycle, lam, 0.0)[0, 2]
    assert got == pytest.approx(9.81 * math.cos(lam) * C1 / 0.5 * S, rel=1e-14)  # S in plain doubles
    assert (got != 0) == (C1 > 0)


@pytest.mark.parametrize("metre", [1, 1000])
def test_nearly_singular_inertias_keep_their_digits(metre):
    """Two point masses beside a design where both turn about one axis: p4 is 1e-8 of its terms."""
    lengths = {name: metre * TWO_MASS_SKATE[name] for name in ("w", "xB", "zB", "xH", "zH")}
    bicycle = Bicycle.from_mapping(TWO_MASS_SKATE | lengths)
    sigma = np.array([0.05, 0.1411, 0.2])
    p4 = characteristic_table(bicycle, 0.3, sigma)[4, 0]
    np.testing.assert_allclose(p4, exact_table(bicycle, 0.3, sigma).value[4, 0], rtol=1e-11)
    alone = [characteristic_table(bicycle, 0.3, one)[4, 0] for one in sigma]
    assert p4.tolist() == alone


def test_a_light_rear_part_leaves_the_bound_as_narrow_as_it_is():
    """Two point masses, the rear one low and 1e-8 of the other: M nearly singular, p4 as certain as ever."""
    light = {"m1": 1e-6, "m2": 100.0, "h1": 0.003, "h2": 1.0, "l1": 1.6, "l2": 0.7}
    table = exact_table(replace(Bicycle.preset("kooijman2011"), **light), 0.1, [1e-6, 0.1])
    assert np.all(table.error[4, 0] < 1e-25 * table.value[4, 0])


def test_zero_speed_terms_of_damping():
    """Without damping the rows p3 and p1 have odd powers of V only."""
    bicycle = Bicycle.preset("meijaard2007")
    table, damped = (characteristic_table(bicycle.with_delta(d), 0.3, 0.08) for d in (0, 2.5))
    assert table[3, 0] == table[1, 0] == 0
    M, _, K0, _ = canonical_matrices(bicycle, 0.3, 0.08)
    assert damped[3, 0] == pytest.approx(2.5 * M[0, 0] * bicycle.c**2, rel=1e-14)
    assert damped[1, 0] == pytest.approx(2.5 * bicycle.g * K0[0, 0] * bicycle.c**2, rel=1e-14)
    changed = np.argwhere(damped != table).tolist()
    assert changed == [[1, 0], [3, 0]]


@pytest.mark.parametrize(
    ("lam_shape", "sigma_shape", "shape"),
    [
        ((), (), ()),
        ((3,), (), (3,)),
        ((3, 1), (4,), (3, 4)),
        ((2, 1, 1), (3, 1), (2, 3, 1)),
        ((0,), (1,), (0,)),
    ],
)
@pytest.mark.parametrize("model", MODELS)
def test_shapes(lam_shape, sigma_shape, shape, model):
    """Arrays broadcast, and every cell is what it is alone."""
    bicycle = Bicycle.preset("meijaard2007").with_delta(0.3)
    lam = np.linspace(0, 0.5, math.prod(lam_shape)).reshape(lam_shape)
    sigma = np.linspace(-0.1, 0.4, math.prod(sigma_shape)).reshape(sigma_shape)
    table = characteristic_table(bicycle, lam, sigma, model=model)
    assert table.shape == (5, 4, *shape)
    lams_, sigmas_ = np.broadcast_arrays(lam, sigma)
    for cell in np.ndindex(shape):
        alone = characteristic_table(bicycle, float(lams_[cell]), float(sigmas_[cell]), model=model)
        assert np.array_equal(table[(..., *cell)], alone)


@settings(deadline=None, max_examples=100, derandomize=True)
@given(machine=paper_machines(), data=st.data())
def test_many_machines_are_the_same_as_one_after_another(machine, data):
    """To the last bit, where the squares of lengths are exact: Python and numpy may round others apart."""
    lengths = ("h1", "l1", "h2", "l2")
    bicycle = Bicycle.from_mapping(
        {k: float(np.float32(v)) if k in lengths else v for k, v in machine.items()}
    )
    names = data.draw(st.lists(st.sampled_from(sorted(bicycle.given)), min_size=1, max_size=4, unique=True))
    factors = np.array([1.0, 1.25, 1.5])
    samples = {name: bicycle.given[name] * factors for name in names}
    if any(name[0] in "D" for name in names):
        samples |= {name: bicycle.given[name] * factors for name in ("A1", "B1", "A2", "B2")}
    lam = np.array(data.draw(st.lists(lams, min_size=2, max_size=2)))
    sigma = np.array(data.draw(st.lists(sigmas, min_size=2, max_size=2)))
    for model in MODELS:
        table = characteristic_table(Machines.drawn(bicycle, samples), lam, sigma, model=model)
        assert table.shape == (5, 4, 3, 2)
        for i in range(3):
            one = bicycle.replaced({name: float(values[i]) for name, values in samples.items()})
            np.testing.assert_array_equal(table[:, :, i], characteristic_table(one, lam, sigma, model=model))


def test_many_machines_some_of_them_on_skates():
    samples = {"C1": np.array([0.0, 0.0, 0.5]), "R1": np.array([0.0, 0.3, 0.3])}
    bicycle = Bicycle.preset("dikarev1981")
    table = characteristic_table(Machines.drawn(bicycle, samples), 0.2, np.array([0.08]))
    for i in range(3):
        one = bicycle.replaced({name: float(values[i]) for name, values in samples.items()})
        expected = characteristic_table(one, 0.2, 0.08)
        np.testing.assert_allclose(table[:, :, i, 0], expected, rtol=1e-14)
    assert np.array_equal(table[:, :, 0], table[:, :, 1])


@settings(deadline=None, max_examples=100, derandomize=True)
@given(machine=paper_machines(), rear=st.booleans(), front=st.booleans())
def test_what_does_not_spin_has_no_angular_momentum(machine, rear, front):
    """To the last bit: a5 = (h + C1/R1 + C2/R2) cos λ of (1.5), on wheels or on skates."""
    machine |= {"C1": 0.0, "R1": 0.0} if rear else {}
    machine |= {"C2": 0.0, "R2": 0.0} if front else {}
    numbers = Bicycle.from_mapping(machine).numbers()
    n = {name: Fraction(value) for name, value in numbers.items() if value is not None}
    spin = [n[f"C{i}"] / n[f"R{i}"] if n[f"R{i}"] else 0 for i in "12"]
    h = n["m1"] * n["h1"] + n["m2"] * n["h2"]
    assert coefficients(Bicycle.from_mapping(machine), 0.0, 0.1).a5.value == float(h + spin[0] + spin[1])


@pytest.mark.parametrize("model", MODELS)
def test_a_front_part_above_its_contact_leaves_no_trace(model):
    """λ = 0, σ = 0 and l2 = c: the front part turns about its centre of mass; p0 has no term in V⁰."""
    for c in (1.0, 1.04, 0.1 + 0.2):
        bicycle = Bicycle.preset("dikarev1981").replaced({"c": c, "l2": c})
        table, rest, error = exact_table(bicycle, 0.0, 0.0, model=model)
        plain = characteristic_table(bicycle, 0.0, 0.0, model=model)
        for zero in (table, rest, error, plain):
            assert zero[0, 0] == 0
        assert error[4, 0] > 0
        beside = exact_table(bicycle.replaced({"l2": np.nextafter(c, 2)}), 0.0, 0.0, model=model)
        assert 0 < abs(beside.value[0, 0]) < 1e-10
        assert beside.error[0, 0] < 1e-20 * abs(beside.value[0, 0])


def test_what_is_kept_of_a_bicycle_is_its_own():
    """The parameters' own part of a table is kept for the next one: of this very bicycle, and no other."""
    one, other = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
    machines = one, other, one, one.replaced({"m1": 81.0}), one.with_delta(1.0), one
    lam = np.array([0.1, 0.2])
    found = [exact_table(each, lam, 0.08).value for each in machines]
    for table, each in zip(found, machines, strict=True):
        fresh = exact_table(Bicycle(**each.numbers()) if each.bodies is None else each, lam, 0.08)
        np.testing.assert_array_equal(table, fresh.value)
    assert not np.array_equal(found[0], found[3])
    assert not np.array_equal(found[0], found[4])
