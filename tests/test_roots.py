"""Positive sign changes of polynomials with known roots, and against 100-digit roots."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf
from numpy.polynomial.polynomial import polyfromroots

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.roots import _bounds, _exponent_above, bracketed_root, positive_roots, sign_near_zero
from bikestab.routh import condition_polynomials
from tests.references.generate_speeds import roots

EPS = np.finfo(float).eps
# Horner's scheme in floating point is exact for coefficients wrong by 2n ε each (n ≤ 6), Newton's last
# step adds a rounding: a root is wrong by that times its condition number Σ|c xʲ| / |x f'(x)|.
ROUNDING = 16 * EPS


def found(coefficients):
    x = positive_roots(np.asarray(coefficients, float))
    return x[np.isfinite(x)]


def exact(coefficients):
    """The roots at which the sign changes, with their condition numbers, from 100 digits."""
    with mp.workdps(100):
        c = [mpf(float(x)) for x in coefficients]
        all_roots = roots(c)
        real = sorted(mp.re(x) for x in all_roots if mp.re(x) > 0 and abs(mp.im(x)) < mpf("1e-20") * abs(x))
        slopes = [sum(j * cj * x**j for j, cj in enumerate(c)) for x in real]
        sizes = [sum(abs(cj) * x**j for j, cj in enumerate(c)) for x in real]
        return real, [
            float(size / abs(slope)) if slope else np.inf for size, slope in zip(sizes, slopes, strict=True)
        ]


@pytest.mark.parametrize(
    ("given_roots", "expected"),
    [
        ([2], [2]),
        ([-2], []),
        ([1, 3], [1, 3]),
        ([-1, 3], [3]),
        ([1j, -1j], []),
        ([1, 2, 3], [1, 2, 3]),
        ([1, 1 + 1j, 1 - 1j], [1]),
        ([0.5, 2, -3, 4], [0.5, 2, 4]),
        ([1, 2, 3, 4, 5], [1, 2, 3, 4, 5]),
        ([1, 2, 3, 4, 5, 6], [1, 2, 3, 4, 5, 6]),
        ([-1, -2, -3, -4, -5, -6], []),
        ([0, 0, 1, 4], [1, 4]),
        ([2, 2], []),  # no change of sign
        ([2, 2, 5], [5]),
        ([1, 1, 3], [3]),  # the polynomial is exactly zero where its slope is found to be
        ([4, 4, 1], [1]),
        ([2, 2, 2], [2]),
        ([1.8, 1.8, 1.8, -1.8], [1.8]),  # exactly zero at both places where its slope is found to be
        ([1, 1, 3, 3], []),
        ([1, 2, 2, 2, 8], [1, 2, 8]),
    ],
)
def test_known_roots(given_roots, expected):
    multiplicity = max(given_roots.count(x) for x in given_roots)
    # coefficients of these integers are exact; a triple root moves by the cube root of Horner's rounding
    tolerance = ROUNDING * 1e5 if multiplicity < 3 else 1e-4
    for sign in (1, -1):
        got = found(sign * polyfromroots(given_roots).real)
        assert got == pytest.approx(expected, rel=tolerance)


def test_even_and_odd_powers():
    """Polynomials in x² and in x³ are solved in these, to the same precision."""
    assert found([-4, 0, 5, 0, -1]) == pytest.approx([1, 2], rel=4 * EPS)
    assert found([-8, 0, 0, 9, 0, 0, -1]) == pytest.approx([1, 2], rel=4 * EPS)
    assert found([0, -4, 0, 1]) == pytest.approx([2], rel=4 * EPS)


@pytest.mark.parametrize("scale", [1e-100, 1e-6, 1, 1e6, 1e100])
def test_roots_from_1e_minus_6_to_1e6(scale):
    c = polyfromroots([1e-6, 1e-3, 1, 1e3, 1e6]) * scale
    assert found(c) == pytest.approx([1e-6, 1e-3, 1, 1e3, 1e6], rel=ROUNDING * 2)


@pytest.mark.parametrize("unit", [2.0**-40, 2.0**40])
def test_roots_in_another_unit_are_as_near(unit):
    assert found(polyfromroots([1, 2, 3]) / unit ** np.arange(4)) == pytest.approx(
        [unit, 2 * unit, 3 * unit], rel=100 * EPS
    )


@pytest.mark.parametrize("gap", [2.0**-8, 2.0**-14, 2.0**-20])
def test_close_roots_are_told_apart(gap):
    """(x − 1)(x − 1 − gap), and the same times (x − 5); κ is about 4/gap, and 40/gap."""
    assert found([1 + gap, -2 - gap, 1]) == pytest.approx([1, 1 + gap], abs=ROUNDING * 4 / gap)
    cubic = [-5 * (1 + gap), 11 + 6 * gap, -7 - gap, 1]
    assert found(cubic) == pytest.approx([1, 1 + gap, 5], abs=ROUNDING * 40 / gap)


def test_cells_of_different_degree():
    """Leading and trailing zeros belong to a cell; an all-zero cell has no roots."""
    cells = np.array(
        [[-1, 1, 0, 0], [0, -2, 1, 0], [0, 0, -3, 1], [0, 0, 0, 0], [6, -5, 1, 0], [7, 0, 0, 0]], float
    )
    x = positive_roots(cells.T)
    assert x.shape == (2, 6)
    assert x[0] == pytest.approx([1, 2, 3, np.nan, 2, np.nan], nan_ok=True)
    assert x[1] == pytest.approx([np.nan] * 4 + [3, np.nan], nan_ok=True)


def test_a_value_of_one_at_the_first_step_is_not_the_end():
    """x² − 3 at 2, the middle of 1 … 4."""
    got = bracketed_root(np.array([[-3.0], [0], [1]]), np.ones(1), np.full(1, 4.0), np.ones(1))
    np.testing.assert_allclose(got, np.sqrt(3), rtol=4 * EPS)


def test_quadratics_without_their_first_or_last_coefficient_beside_others():
    x = positive_roots(np.array([[0.0, 2, -6, -6], [-2, -3, 1, 2], [1, 1, 1, 0]]))
    np.testing.assert_array_equal(x, [[2, 1, 2, 3], [np.nan, 2, np.nan, np.nan]])


def test_linear_ones():
    """In x and in x²: one root where the signs differ, none without a slope or beyond double precision."""
    c0, c1 = (
        np.array([-6.0, 6, 6, 0, 0, -6, -1e300, -1e-300, np.nan]),
        [2.0, -3, 2, 2, 0, 0, 1e-300, 1e300, 1],
    )
    expected = np.array([3, 2, *[np.nan] * 7])
    for c, x in (([c0, c1], expected), ([c0, 0 * c0, c1], np.sqrt(expected)), ([0 * c0, c0, c1], expected)):
        got = positive_roots(np.array(c)[:, :-1])  # without NaN, which is in every power
        np.testing.assert_array_equal(got, [x[:-1]])
    np.testing.assert_array_equal(positive_roots(np.array([c0, c1])), [expected])


def test_a_root_of_which_nothing_is_known_but_that_it_is_positive():
    """(x − 2^k) (x² + 1), between 0 and infinity."""
    x = 2.0 ** np.array([-30, -3, 0, 2, 30])
    c = np.array([-x, np.ones(5), -x, np.ones(5)])
    got = bracketed_root(c, np.zeros(5), np.full(5, np.inf), np.ones(5))
    np.testing.assert_allclose(got, x, rtol=4 * EPS)


@pytest.mark.parametrize("shape", [(), (1,), (3,), (2, 3), (0,), (2, 0)])
@pytest.mark.parametrize("degree", range(1, 7))
def test_shapes(shape, degree):
    c = np.zeros((degree + 1, *shape))
    c[0], c[degree] = -1, 1
    x = positive_roots(c)
    assert x.shape == ((1 if 0 not in shape else 0), *shape)
    assert np.all(x == 1)


def test_vectorised_equals_scalar():
    """More cells than are worked on at a time, of which a few are solved alone."""
    rng = np.random.default_rng(0)
    c = rng.normal(size=(7, 20000))
    x = positive_roots(c)
    for i in range(0, 20000, 997):
        alone = positive_roots(c[:, i])
        assert np.array_equal(x[: len(alone), i], alone)
        assert np.isnan(x[len(alone) :, i]).all()


def test_sign_near_zero():
    cells = np.array([[1, -5], [-1, 5], [0, -5], [0, 5], [0, 0]], float).T
    assert sign_near_zero(cells).tolist() == [1, -1, -1, 1, 0]
    assert sign_near_zero(np.insert(cells, 1, 0.0, axis=0)).tolist() == [1, -1, -1, 1, 0]


coefficient = st.just(0.0) | st.builds(
    lambda sign, power: sign * 10.0**power, st.sampled_from([-1, 1]), st.floats(-6, 6)
)


@settings(deadline=None, max_examples=200, derandomize=True)
@given(c=st.lists(coefficient, min_size=2, max_size=7))
def test_random_coefficients(c):
    expected, condition = exact(c)
    assume(all(k < 1e9 for k in condition))  # nearly double: rounding decides whether there are any
    got = found(c)
    assert len(got) == len(expected)
    for x, y, k in zip(got, expected, condition, strict=True):
        assert abs(x - y) <= ROUNDING * max(k, 1) * y


@settings(deadline=None, max_examples=100, derandomize=True)
@given(
    x=st.lists(st.integers(-24, 24), min_size=1, max_size=5, unique=True),
    negative=st.lists(st.integers(-24, 24), max_size=1),
)
def test_random_roots(x, negative):
    """As many as were put in, ascending, each within its conditioning."""
    c = polyfromroots([*(10.0 ** (p / 4) for p in x), *(-(10.0 ** (p / 4)) for p in negative)])
    expected, condition = exact(c)
    assume(all(k < 1e9 for k in condition))
    got = found(c)
    assert len(got) == len(x) == len(expected)
    assert np.all(np.diff(got) > 0)
    for value, y, k in zip(got, expected, condition, strict=True):
        assert abs(value - y) <= ROUNDING * k * y


def test_a_search_that_newton_alone_would_never_end():
    """hurwitz3 of this design sent Newton's steps from one end of a bracket to the other and back."""
    bicycle = Bicycle.preset("meijaard2007").with_delta(1.0)
    lam, sigma = np.linspace(-0.2, 0.8, 401)[9], np.linspace(-0.1, 0.5, 401)[72]
    table = characteristic_table(bicycle, lam, sigma, model="unrefined")
    poly = condition_polynomials(table)["hurwitz3"]
    mine = positive_roots(poly[:, np.newaxis])[:, 0]
    real = np.roots(poly[::-1])
    real = np.sort(real.real[(np.abs(real.imag) < 1e-9) & (real.real > 0)])
    np.testing.assert_allclose(mine[np.isfinite(mine)], real, rtol=1e-9)


@pytest.mark.parametrize("degree", range(1, 7))
def test_bounds_are_not_far_from_the_roots(degree):
    """Fujiwara's is at most 2/(2^(1/n) − 1) times the largest root, 17; from exponents four times that."""
    rng = np.random.default_rng(degree)
    x = (
        rng.choice([-1.0, 1.0], (degree, 50))
        * 10 ** rng.uniform(-3, 3, 50)
        * rng.uniform(0.3, 3, (degree, 50))
    )
    c = np.zeros((8, 50))
    c[: degree + 1] = np.transpose([polyfromroots(each) for each in x.T])
    low, high = np.abs(x).min(axis=0), np.abs(x).max(axis=0)
    above = 2.0 ** _exponent_above(c)
    assert np.all((high < above) & (above < 70 * high))
    least, most = _bounds(c)
    assert np.all((high < most) & (most < 35 * high))
    assert np.all((low > least) & (least > low / 35))
