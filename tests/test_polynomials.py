"""Arithmetic of many small polynomials, held against numpy's own of one and against fractions."""

from fractions import Fraction

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from bikestab import polynomials
from bikestab.roots import sign_near_zero
from bikestab.twofold import Double, Twofold, exact_sum

RNG = np.random.default_rng(7)
X = RNG.uniform(-2, 2, (3, 4))


def random(degree, *shape):
    return RNG.uniform(-3, 3, (degree + 1, *shape))


def each(c):
    """The polynomials of every cell, as numpy has them."""
    return [Polynomial(c[:, *cell]) for cell in np.ndindex(*c.shape[1:])]


@pytest.mark.parametrize("degree", range(7))
def test_values_slopes_and_shifts(degree):
    c = random(degree, 3, 4)
    x = X.ravel()
    expected = [p(at) for p, at in zip(each(c), x, strict=True)]
    np.testing.assert_allclose(polynomials.value(c, X).ravel(), expected, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(polynomials.value(c, np.zeros(())), c[0])
    slopes = [p.deriv()(at) for p, at in zip(each(c), x, strict=True)]
    derivative = polynomials.derivative(c)
    assert len(derivative) == max(1, degree)
    np.testing.assert_allclose(polynomials.value(derivative, X).ravel(), slopes, rtol=0, atol=1e-11)
    if degree:
        bends = [p.deriv(2)(at) / 2 for p, at in zip(each(c), x, strict=True)]
        found = [part.ravel() for part in polynomials.value_and_slopes(c, X)]
        np.testing.assert_allclose(found, [expected, slopes, bends], rtol=0, atol=1e-11)
    moved = polynomials.value(polynomials.taylor(c, X), np.full(X.shape, 0.3))
    there = [p(at + 0.3) for p, at in zip(each(c), x, strict=True)]
    np.testing.assert_allclose(moved.ravel(), there, rtol=0, atol=1e-11)


@pytest.mark.parametrize("has", range(16))
def test_cubics_without_some_powers(has):
    c = random(3, 3, 4) * np.reshape([has >> j & 1 for j in range(4)], (4, 1, 1))
    found = polynomials.value_of_cubics(c, X, X.shape)
    assert found.shape == X.shape
    np.testing.assert_allclose(found, polynomials.value(c, X), rtol=0, atol=1e-13)


@pytest.mark.parametrize(("p", "q"), [(0, 0), (0, 3), (2, 3), (4, 1)])
def test_products_sums_and_what_is_left_of_them(p, q):
    a, b = random(p, 5), random(q, 5)
    for found, expected in (
        (polynomials.product(a, b), [x * y for x, y in zip(each(a), each(b), strict=True)]),
        (polynomials.total(a, b), [x + y for x, y in zip(each(a), each(b), strict=True)]),
    ):
        for i, one in enumerate(expected):
            np.testing.assert_allclose(found[: len(one), i], one.coef, rtol=1e-14, atol=1e-14)
            assert not np.any(found[len(one) :, i])


def test_products_with_nothing():
    none, some = np.zeros((1, 5)), random(2, 5)
    for found in (polynomials.product(some, none), polynomials.product(none, some)):
        np.testing.assert_array_equal(found, np.zeros((3, 5)))


def test_products_of_one_with_many():
    one, many = random(2), random(3, 5)
    expected = [Polynomial(one) * p for p in each(many)]
    for found in (polynomials.product(one, many), polynomials.product(many, one)):
        for i, p in enumerate(expected):
            np.testing.assert_allclose(found[:, i], p.coef, rtol=0, atol=1e-13)


def test_powers_that_no_cell_has():
    c = np.zeros((6, 2))
    assert polynomials.used_powers(c) == []
    assert polynomials.trimmed(c).shape == (1, 2)
    c[1, 0], c[4, 1] = 1.0, -1.0
    assert polynomials.used_powers(c) == [1, 4]
    np.testing.assert_array_equal(polynomials.trimmed(c), c[1:5])


def test_what_rounding_leaves_is_settled():
    c, size = np.array([1.0, 1e-20, -1e-20, 0.5, -0.5]), np.array([1.0, 1.0, 1.0, 1.0, 1.0])
    np.testing.assert_array_equal(polynomials.settled(c, size, 0.5), [1.0, 0, 0, 0, 0])
    np.testing.assert_array_equal(polynomials.settled(c, size), [1.0, 0, 0, 0.5, -0.5])


def test_the_sign_right_of_zero_is_that_of_the_first_coefficient_there_is():
    c = np.array([[0.0, 0, 0, 2], [0, 0, 0, -1], [-3, 0, 4, -1]])
    np.testing.assert_array_equal(sign_near_zero(c), [-1, 0, 1, 1])


def whole(number):
    """Its exact value."""
    return Fraction(float(number.value)) + Fraction(float(getattr(number, "rest", 0.0)))


@pytest.mark.parametrize("kind", [Twofold, Double])
def test_products_and_differences_of_numbers_with_sizes(kind):
    """Whole numbers, so that all of it is exact; sizes are those of the same with absolute values."""

    def of(*values):
        return [v if v is None else kind(float(v), *[0.0] * (kind is Twofold), float(abs(v))) for v in values]

    a, b = of(3, None, -2), of(None, 5, None, 7)
    product = polynomials.product_of(a, b)
    assert [n and whole(n) for n in product] == [None, 15, None, 11, None, -14]
    assert [n and n.size for n in product] == [None, 15, None, 31, None, 14]
    difference = polynomials.difference_of(a, b)
    assert [n and whole(n) for n in difference] == [3, -5, -2, -7]
    assert [n and n.size for n in difference] == [3, 5, 2, 7]
    assert polynomials.difference_of(of(None), of(None)) == [None]
    assert polynomials.product_of(of(2, None), of(None)) == [None]


def test_an_exact_sum_is_one():
    total = exact_sum(1.0, 2.0**-70)
    assert whole(total) == 1 + Fraction(2) ** -70
