"""The six conditions against eigenvalues of independent matrices."""

import numpy as np
import pytest
from bicycleparameters.bicycle import ab_matrix, benchmark_par_to_canonical
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.routh import (
    CONDITIONS,
    coefficients_at,
    condition,
    condition_polynomials,
    conditions,
    stable,
    violated,
    without_noise,
)
from bikestab.speeds import intervals_of
from bikestab.twofold import Twofold
from tests.strategies import lams, machines, meijaard_machines, sigmas, speeds

# LAPACK's eigenvalues belong to a matrix wrong by some ε ρ (ρ the largest eigenvalue). A simple one so
# moves by about ε ρ, two that meet by √ε ρ; nearer to the imaginary axis than that they say nothing.
UNCERTAIN = 4 * np.sqrt(np.finfo(float).eps)


def growth(matrices):
    """The largest real part of each matrix's eigenvalues; NaN where its sign is within rounding."""
    s = np.linalg.eigvals(matrices)
    largest = s.real.max(axis=-1)
    return np.where(np.abs(largest) > UNCERTAIN * np.abs(s).max(axis=-1), largest, np.nan)


def constant_table(p):
    table = np.zeros((5, 4, *np.shape(p)[1:]))
    table[:, 0] = p
    return table


@settings(deadline=None, max_examples=150, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas, some=st.lists(speeds, min_size=8, max_size=8))
def test_stable_is_the_sign_of_the_growth(machine, lam, sigma, some):
    """Stacked companion matrices of the same table."""
    table, V = (
        characteristic_table(Bicycle.from_mapping(machine), lam, sigma)[..., np.newaxis],
        np.array(some),
    )
    p0, p1, p2, p3, p4 = coefficients_at(table, V)
    companion = np.zeros((len(V), 4, 4))
    companion[:, [1, 2, 3], [0, 1, 2]] = 1
    companion[:, 0] = -np.stack([p3, p2, p1, p0], axis=1) / p4[:, np.newaxis]
    s = growth(companion)
    known = np.isfinite(s)
    assert np.array_equal(stable(table, V)[known], (s < 0)[known])


@settings(deadline=None, max_examples=150, derandomize=True)
@given(machine=meijaard_machines(), lam=lams, sigma=sigmas, some=st.lists(speeds, min_size=8, max_size=8))
def test_stable_as_in_bicycleparameters(machine, lam, sigma, some):
    """Another code from the 25 parameters to the state matrix."""
    table = characteristic_table(Bicycle.from_mapping(machine), lam, sigma)
    matrices = benchmark_par_to_canonical({**machine, "lam": lam, "c": sigma * machine["w"]})
    s = growth(np.array([ab_matrix(*matrices, V, machine["g"])[0] for V in some]))
    for V, right in zip(some, s, strict=True):
        if np.isfinite(right):
            assert stable(table, V) == (right < 0)


def test_each_condition_has_its_bit():
    """(s + 1)⁴ with one coefficient spoilt at a time, and the pair of Δ3 = 0 moved across."""
    good = np.array([1, 4, 6, 4, 1.0])
    for bit in range(5):
        for wrong in (0.0, -0.001):
            p = good.copy()
            p[bit] = wrong
            mask = int(violated(conditions(constant_table(p), 0.0)))
            assert mask & 1 << bit
            assert not any(mask & 1 << other for other in range(5) if other != bit)
    # (s² + s + 1)(s² − 0.1 s + 4) has positive coefficients but one complex pair to the right
    p = np.array([4, 3.9, 4.9, 0.9, 1])
    assert int(violated(conditions(constant_table(p), 0.0))) == 1 << CONDITIONS.index("hurwitz3")
    assert violated(conditions(constant_table(good), 0.0)) == 0


@settings(max_examples=100, derandomize=True)
@given(p=st.lists(st.floats(-3, 3) | st.just(0.0), min_size=5, max_size=5))
def test_mask_and_stable_belong_together(p):
    p0, p1, p2, p3, p4 = p
    hurwitz3 = p1 * (p2 * p3 - p4 * p1) - p0 * p3 * p3
    mask = violated(conditions(constant_table(p), 0.0))
    assert int(mask) == sum((value <= 0) << bit for bit, value in enumerate([*p, hurwitz3]))
    assert stable(constant_table(p), 0.0) == (mask == 0)
    assert mask.dtype == np.uint8


@settings(deadline=None, max_examples=60, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas, delta=st.just(0.0) | st.floats(0.01, 5))
def test_condition_polynomials_are_the_conditions(machine, lam, sigma, delta):
    """To 1e-13 of the summed absolute terms of hurwitz3: some 40 products and sums."""
    table = characteristic_table(Bicycle.from_mapping({**machine}).with_delta(delta), lam, sigma)
    V = np.array([0.0, 1e-3, 0.5, 3, 8, 20, 1e3])
    values, polynomials = conditions(table[..., np.newaxis], V), condition_polynomials(table)
    p0, p1, p2, p3, p4 = (np.polynomial.polynomial.polyval(V, np.abs(row)) for row in table)
    sizes = [p0, p1, p2, p3, p4, p1 * (p2 * p3 + p4 * p1) + p0 * p3**2]
    assert list(polynomials) == list(CONDITIONS) == list(values._fields)
    for name, value, size in zip(CONDITIONS, values, sizes, strict=True):
        expected = np.polynomial.polynomial.polyval(V, polynomials[name])
        assert np.all(np.abs(value - expected) <= 1e-13 * size)


@pytest.mark.parametrize(("a2", "b2", "k"), [(0.625, 2.5, 1.75), (1.75, 1.125, 1.25), (1.25, 1.875, 3.0)])
def test_condition_polynomials_of_exact_cancellation(a2, b2, k):
    """(s² + a²)(s² + k V s + b²) in numbers without rounding: Δ3 is zero at every speed."""
    table = np.zeros((5, 4))
    table[4, 0], table[3, 1], table[2, 0], table[1, 1], table[0, 0] = 1, k, a2 + b2, a2 * k, a2 * b2
    assert condition_polynomials(table)["hurwitz3"].tolist() == [0] * 10
    assert intervals_of(table).number == 0


def test_what_is_left_of_nearly_all_of_the_first_coefficient_is_right():
    """(1 + e) (1 − e) − 1 = −e²."""
    table = np.zeros((5, 4))
    table[:4, 0] = 1, 1 + 2.0**-50, 1 - 2.0**-50, 1
    assert condition_polynomials(table)["hurwitz3"][0] == -(2.0**-100)


def test_coefficients_in_proportion_to_the_inverse_speed_where_some_cells_have_none():
    table = np.zeros((5, 5, 3))
    table[:, 0], table[1, 4] = 2.0, [0, 3, -3]
    np.testing.assert_array_equal(coefficients_at(table, 6.0), [[2.0] * 3, [2, 2.5, 1.5], *[[2.0] * 3] * 3])
    np.testing.assert_array_equal(coefficients_at(table, 0.0)[1], [2, np.inf, -np.inf])


def test_condition_polynomials_with_a_part_of_the_inverse_speed():
    """V p_k and V³ hurwitz3, whose V^−3 cancels: p1 p2 = p0 p3 of products of whole numbers."""
    rng = np.random.default_rng(1)
    a, b, c, d = rng.integers(1 << 25, 1 << 26, (4, 40)).astype(float)
    table = np.zeros((5, 5, 40))
    table[:4, 4], table[:, :4] = [a * c, a * b, c * d, b * d], rng.uniform(1, 2, (5, 4, 40)) * 2.0**50
    found = condition_polynomials(table)
    assert not found["hurwitz3"][0].any()
    for V in (0.5, 3.0):
        for name, value in conditions(table, V)._asdict().items():
            power = 3 if name == "hurwitz3" else 1
            expected = np.polynomial.polynomial.polyval(V, found[name])
            np.testing.assert_allclose(V**power * value, expected, rtol=1e-12)


def test_what_rounding_leaves_of_the_first_coefficients_is_no_number():
    """Three of V³ hurwitz3, where there is V^−1; those behind stay as they are."""
    noise = Twofold(np.array([1e-30, 1.0, 1e-30]), np.array([1e-50, 1e-20, 0]), np.array([4.0, 4, 1e-6]))
    found = without_noise([noise, None, noise, noise])
    for settled in (found[0], found[2]):
        np.testing.assert_array_equal(
            (settled.value, settled.rest, settled.size), [[0, 1, 1e-30], [0, 1e-20, 0], [0, 4, 1e-6]]
        )
    assert found[1] is None
    assert found[3] is noise


@pytest.mark.parametrize("V", [2.5, np.array([0.5, 2.5]), np.ones((3, 1, 1))])
def test_shapes_and_vectorised_equals_scalar(V):
    bicycle = Bicycle.preset("dikarev1981").with_delta(0.5)
    V = np.asarray(V)
    table = characteristic_table(bicycle, np.array([[0.1], [0.4]]), np.array([0.1, 0.2]))
    values = conditions(table, V)
    assert {value.shape for value in values} == {np.broadcast_shapes((2, 2), V.shape)}
    for cell in np.ndindex(values.p0.shape):
        i, j = cell[-2:]
        speed = np.broadcast_to(V, values.p0.shape)[cell]
        for value, alone in zip(values, conditions(table[:, :, i, j], speed), strict=True):
            assert value[cell].tobytes() == alone.tobytes()
    assert coefficients_at(table, 0.0)[0].tolist() == table[0, 0].tolist()


def test_a_cell_has_the_same_bits_beside_any_others():
    """Tables with other powers of V beside them change nothing."""
    rng = np.random.default_rng(8)
    tables = rng.normal(size=(5, 4, 40)) * (rng.uniform(size=(5, 4, 40)) < 0.5)
    V = rng.uniform(0, 20, 40)
    together = conditions(tables, V)
    for i in range(40):
        for value, alone in zip(together, conditions(tables[..., i], V[i]), strict=True):
            assert value[i] + 0.0 == alone + 0.0
    for name in CONDITIONS:
        assert np.array_equal(condition(tables, name, V), getattr(together, name))
        assert np.array_equal(condition(tables, name, 3.0), getattr(conditions(tables, 3.0), name))
