"""The exact ranges of λ and σ with a stable speed, against dense sampling and 40-digit arithmetic."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import characteristic_table
from bikestab.region.lines import Line, crossings, lowest_stable, stable_ranges
from bikestab.region.skeleton import curve_functions, speed_polynomials
from bikestab.routh import stable
from bikestab.speeds import intervals_of
from tests.strategies import machines, sigmas

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
BICYCLES = {"1981": DIKAREV, "2007": MEIJAARD}
BICYCLES |= {"1981 damped": DIKAREV.with_delta(1.0), "2007 damped": MEIJAARD.with_delta(2.0)}
each_bicycle = pytest.mark.parametrize("bicycle", BICYCLES.values(), ids=BICYCLES)


def has_stable(bicycle, lam, sigma):
    return intervals_of(characteristic_table(bicycle, lam, sigma)).number > 0


def within(values, ranges):
    return np.any([(values > a) & (values < b) for a, b in ranges] or [values != values], axis=0)


@each_bicycle
def test_a_million_random_designs_have_a_stable_speed_exactly_within_the_ranges(bicycle):
    rng = np.random.default_rng(1981)
    lam = rng.uniform(0, 0.6, 200)
    sigma = rng.uniform(0, 0.5, (200, 5000 if bicycle.delta == 0 else 1000))
    ranges = stable_ranges(Family(bicycle), 0, 0.5, x=lam)
    inside = np.array([within(row, found) for row, found in zip(sigma, ranges, strict=True)])
    np.testing.assert_array_equal(has_stable(bicycle, lam[:, None], sigma), inside)
    least = lowest_stable(Family(bicycle), 0, 0.5, x=lam)[:, None]
    assert not has_stable(bicycle, lam[:, None], sigma)[~(sigma > least)].any()  # NaN: nowhere at this λ
    assert 0.3 < inside.mean() < 1


@each_bicycle
def test_no_eigenvalue_is_stable_below_the_smallest_trail(bicycle):
    """The same without the intervals of ``speeds``: the conditions at 250 000 random points."""
    rng = np.random.default_rng(2007)
    lam = rng.uniform(0, 0.6, 300)
    least = lowest_stable(Family(bicycle), 0, 0.5, x=lam)
    lam, least = (values[least != 0][:100] for values in (lam, least))  # at 0 nothing is below
    sigma = np.where(np.isnan(least), 0.5, least)[:, None] * rng.uniform(0, 1 - 1e-9, (100, 100))
    V = rng.uniform(0, 30, (100, 100, 25))
    table = characteristic_table(bicycle, lam[:, None], sigma)
    assert not stable(table[..., None], V).any()
    known = ~np.isnan(least)
    assert has_stable(bicycle, lam[known], least[known] + 1e-9).all()
    assert not has_stable(bicycle, lam[known], least[known] - 1e-12).any()


def test_the_smallest_tilt_is_the_same_curve():
    """λ → smallest σ and σ → smallest λ are inverse where the curve falls."""
    lam = np.array([0.17, 0.2, 0.3, 0.5])
    sigma = lowest_stable(Family(DIKAREV), 0, 0.5, x=lam)
    np.testing.assert_allclose(lowest_stable(Family(DIKAREV), 0.1, 0.6, y=sigma), lam, atol=1e-11)


def test_shapes_and_nothing_there():
    assert lowest_stable(Family(MEIJAARD), 0, 0.5, x=0.2).shape == ()
    assert lowest_stable(Family(MEIJAARD), 0, 0.5, x=np.full((2, 3), 0.2)).shape == (2, 3)
    assert np.isnan(lowest_stable(Family(MEIJAARD), 0, 0.5, x=0.0))
    assert stable_ranges(Family(MEIJAARD), 0, 0.5, x=[0.0, 0.2])[0] == []
    assert np.isnan(lowest_stable(Family(MEIJAARD), 0, 0.1, y=0.0))


def test_ranges_of_whole_numbers_and_long_ones():
    damped = DIKAREV.with_delta(0.5)
    expected = lowest_stable(Family(damped), 0, 0.5, x=[0.05, 0.1, 0.2])
    for high in (1, 5.0, 100):
        np.testing.assert_allclose(
            lowest_stable(Family(damped), 0, high, x=[0.05, 0.1, 0.2]), expected, atol=1e-11
        )
    assert not has_stable(damped, np.array([0.05, 0.1, 0.2]), expected - 1e-9).any()
    assert has_stable(damped, np.array([0.05, 0.1, 0.2]), expected + 1e-9).all()


@settings(max_examples=30, deadline=None)
@given(machines, sigmas)
def test_random_machines(machine, sigma):
    bicycle = Bicycle.from_mapping(machine)
    ranges = stable_ranges(Family(bicycle), 0, 0.6, y=sigma)[0]
    lam = np.linspace(0, 0.6, 1201)
    far = np.abs(lam[:, None] - np.array([*sum(ranges, ()), -1.0])).min(axis=1) > 1e-9
    np.testing.assert_array_equal(has_stable(bicycle, lam, sigma)[far], within(lam, ranges)[far])


FAST = {  # its weave speeds meet at 275 m/s, where the discriminant is mostly rounding
    "c": 1.0, "g": 9.81, "m1": 186.0, "m2": 9.0, "delta": 2.0, "l1": 0.5, "h1": 0.375, "l2": 0.75, "h2": 1.0,
    "A1": 2.90625, "B1": 46.5, "D1": 8.71875, "R1": 0.25, "C1": 1.74375, "A2": 0.275625, "B2": 1.1025,
    "D2": 0.275625, "R2": 0.25, "C2": 0.084375,
}  # fmt: skip


@settings(max_examples=20, deadline=None)
@given(machines)
@example(FAST)
def test_the_kinds_of_the_ends_change_only_at_crossings(machine):
    bicycle = Bicycle.from_mapping(machine)
    line = Line(Family(bicycle), None, 0.1)
    cuts = crossings(line, 0.0, 0.6)[0]
    for a, b in pairwise(cuts):
        if b - a > 1e-6:
            found = intervals_of(characteristic_table(bicycle, np.linspace(a, b, 52)[1:-1], 0.1))
            assert np.ptp(found.lower, axis=0).max() == 0
            assert np.ptp(found.upper, axis=0).max() == 0


def test_cuts_are_ascending_from_end_to_end():
    cuts = crossings(Line(Family(DIKAREV), [0.05, 0.1, 0.2], None), 0.0, 0.3)
    assert np.all(np.diff(cuts, axis=1) >= 0)
    np.testing.assert_array_equal(cuts[:, 0], 0)
    np.testing.assert_array_equal(cuts[:, -1], 0.3)


# --- the functions whose zeros the curves are


def test_the_discriminant_has_the_sign_of_the_roots():
    """Without damping hurwitz3 is quadratic in x = V²: two real roots, or none, in x."""
    lam, sigma = np.meshgrid(np.linspace(0, 0.6, 30), np.linspace(0, 0.5, 30))
    table = characteristic_table(DIKAREV, lam, sigma)
    c, b, a = speed_polynomials(table).polynomials["hurwitz3"]
    value = curve_functions(table)["fold"]
    np.testing.assert_array_equal(np.sign(value), np.sign(4 * a * c - b * b))


@pytest.mark.parametrize("delta", [0.0, 1.0])
@pytest.mark.parametrize(("name", "pair"), [("meet", ("q", "p0")), ("slow meet", ("p1", "p0"))])
def test_a_resultant_is_a_product_over_the_roots(delta, name, pair):
    lam, sigma = np.linspace(0.05, 0.55, 7), np.linspace(0.45, 0.03, 7)
    table = characteristic_table(DIKAREV.with_delta(delta), lam, sigma)
    polynomials = speed_polynomials(table).polynomials
    f, g = (polynomials[key] for key in pair)
    value = curve_functions(table)[name]
    product = [np.prod(np.polyval(f[::-1, i], np.roots(g[::-1, i]))).real for i in range(7)]
    ratio = value / (product * g[-1] ** (len(f) - 1))
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-9)


def test_only_what_is_asked_for_is_computed():
    table = characteristic_table(DIKAREV, 0.2, 0.08)
    assert list(curve_functions(table, ["meet", "fold"])) == ["meet", "fold"]
