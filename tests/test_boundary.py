"""Sign changes on a grid, refined, against the exact critical speeds."""

import numpy as np
import pytest
from hypothesis import given, settings

from bikestab import boundary
from bikestab.bicycle import Bicycle
from bikestab.boundary import AGREEMENT, Brackets, agreement, refine, sign_changes
from bikestab.errors import ScanError
from bikestab.model import characteristic_table
from bikestab.routh import CONDITIONS, condition_polynomials, conditions, violated
from bikestab.speeds import critical_speeds, stable_intervals
from tests.strategies import machines

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
V = np.linspace(0, 15, 301)


def cells(bicycle, lam, sigma):
    """The table (5, 4, cell) of every pair of λ and σ."""
    return characteristic_table(bicycle, np.atleast_1d(lam)[:, None], sigma).reshape(5, 4, -1)


def brackets_of(table, V=V):
    return sign_changes(violated(conditions(table[..., np.newaxis], V)), V)


BOX = np.linspace(0, 0.3, 16), np.linspace(0, 0.15, 16)


@pytest.mark.parametrize(
    "bicycle", [DIKAREV, MEIJAARD, DIKAREV.with_delta(2.0)], ids=["1981", "2007", "damped"]
)
def test_refined_roots_are_the_exact_speeds(bicycle):
    table = cells(bicycle, *BOX)
    exact = critical_speeds(table)
    for name, found in brackets_of(table).items():
        seen = agreement(table, name, refine(table, name, found), exact[name])
        assert seen.largest <= AGREEMENT
        assert seen.largest_loose <= 1e-5


def test_there_is_something_to_refine():
    table = cells(DIKAREV, *BOX)
    number = {name: len(found.cell) for name, found in brackets_of(table).items()}
    assert number["p0"] > 100
    assert number["hurwitz3"] > 100


def test_every_root_is_found_that_the_grid_separates():
    """Except in the first step from rest, where odd conditions are zero for another reason."""
    table = cells(DIKAREV, *BOX)
    for name, found in brackets_of(table).items():
        exact = critical_speeds(table)[name]
        between = (exact > V[0]) & (exact < V[-1])  # NaN is in neither
        step = np.searchsorted(V, np.where(between, exact, 0))
        pairs = zip(step.T, between.T, strict=True)
        alone = np.array([len(set(s[b])) == b.sum() and 1 not in s[b] for s, b in pairs])
        assert alone.mean() > 0.9
        counted = np.bincount(refine(table, name, found).cell, minlength=table.shape[-1])
        np.testing.assert_array_equal(counted[alone], between.sum(axis=0)[alone])


@settings(max_examples=30, deadline=None)
@given(machines)
def test_random_machines(machine):
    bicycle = Bicycle.from_mapping(machine)
    table = cells(bicycle, np.linspace(0, 0.6, 4), np.linspace(0, 0.3, 4))
    exact = critical_speeds(table)
    for name, found in brackets_of(table).items():
        assert agreement(table, name, refine(table, name, found), exact[name]).largest <= AGREEMENT


def test_a_refined_root_is_a_zero_of_the_condition():
    table = cells(DIKAREV, 0.2, 0.08)
    for name in ("p0", "hurwitz3"):
        roots = refine(table, name, brackets_of(table)[name])
        left = getattr(conditions(table, roots.low * (1 - 1e-12)), name)
        right = getattr(conditions(table, roots.low * (1 + 1e-12)), name)
        assert len(left) > 0
        assert np.all(left * right < 0)


def test_sign_changes_are_between_neighbouring_speeds():
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    found = brackets_of(table)
    np.testing.assert_allclose(found["hurwitz3"].low[-1], 4.25)  # 4.292382536341 lies in the next 0.05
    np.testing.assert_allclose(found["hurwitz3"].high[-1], 4.30)
    np.testing.assert_allclose(found["p0"].low, [6.0])
    np.testing.assert_allclose(found["p0"].high, [6.05])


def test_a_root_on_a_speed_of_the_grid():
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    capsize = critical_speeds(table)["p0"][0, 0]
    for grid in ([1.0, capsize, 8.0], [1.0, capsize], [capsize, 8.0]):
        found = brackets_of(table, np.array(grid))["p0"]
        np.testing.assert_allclose(refine(table, "p0", found).low, [capsize][: len(found.cell)], rtol=1e-14)
    assert len(brackets_of(table, np.array([1.0, capsize, 8.0]))["p0"].cell) == 1


def test_rest_is_no_crossing():
    """Without damping p1, p3 and hurwitz3 are zero at V = 0 whatever the design."""
    table = cells(DIKAREV, *BOX)
    found = brackets_of(table)
    assert np.any(found["p3"].low == 0)
    for name in CONDITIONS:
        assert np.all(refine(table, name, found[name]).low > 0)


# --- close to a fold, where two roots meet


def fold(sigma=0.08):
    """The two weave speeds of the paper's bicycle nearest to the λ where they meet, from either side."""
    low, high = 0.1, 0.3  # without and with a stable speed
    while high - low > 1e-15:
        middle = 0.5 * (low + high)
        some = stable_intervals(characteristic_table(DIKAREV, middle, sigma)).number > 0
        low, high = (low, middle) if some else (middle, high)
        if middle in (low, high) and np.nextafter(low, high) >= high:
            break
    return low, high


def test_near_the_end_of_the_stable_region():
    low, high = fold()
    table = cells(DIKAREV, high + np.array([0, 1e-13, 1e-10, 1e-7]), [0.08])
    inside = stable_intervals(table)
    assert np.all(inside.number == 1)
    assert np.all(np.diff(inside.V2[:, 0] - inside.V1[:, 0]) > 0)
    assert stable_intervals(cells(DIKAREV, low, [0.08])).number == 0
    centre = 0.5 * (inside.V1[0, 0] + inside.V2[0, 0])
    around = centre + np.array([-1, 0, 1]) * 0.5
    exact = critical_speeds(table)
    for name in ("p0", "hurwitz3"):
        roots = refine(table, name, brackets_of(table, around)[name])
        seen = agreement(table, name, roots, exact[name])
        assert seen.largest <= AGREEMENT


def table_with_p0(*coefficients):
    """A table of one cell whose p0 is a polynomial in V."""
    table = np.zeros((5, 4, 1))
    table[0, : len(coefficients), 0] = coefficients
    return table


def test_a_double_root_is_called_loose():
    """p0 = (V − 2)² − ε²: the roots 2 ± ε move by more than 1e-10 with the rounding of p0 once ε is small."""
    for width, loose in ((1e-3, 0), (1e-7, 2)):
        table = table_with_p0(4 - width**2, -4.0, 1.0)
        speeds = np.array([1.0, 2.0, 3.0])
        roots = refine(table, "p0", brackets_of(table, speeds)["p0"])
        seen = agreement(table, "p0", roots, critical_speeds(table)["p0"])
        assert (seen.roots, seen.loose) == (2, loose)
        assert seen.largest <= AGREEMENT
        assert seen.largest_loose <= 1e-8


def test_a_wrong_root_is_seen():
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    exact = critical_speeds(table)["p0"]
    wrong = Brackets(np.array([0]), *(np.array([exact[0, 0] + 1e-6]),) * 2)
    assert agreement(table, "p0", wrong, exact).largest == pytest.approx(1e-6, rel=1e-6)
    none = np.full_like(exact, np.nan)
    assert agreement(table, "p0", wrong, none).largest == np.inf


def test_a_double_root_on_a_speed_of_the_grid_is_no_disagreement():
    """p0 = (V − 2)² is zero at 2, which the grid calls violated, but changes no sign: no critical speed."""
    table = table_with_p0(4.0, -4.0, 1.0)
    roots = refine(table, "p0", brackets_of(table, np.array([1.0, 2.0, 3.0]))["p0"])
    exact = critical_speeds(table)["p0"]
    np.testing.assert_array_equal(roots.low, [2, 2])
    assert len(exact) == 0
    assert agreement(table, "p0", roots, exact) == (2, 0.0, 0, 0.0, 2)


def test_a_root_near_a_fold_that_is_no_zero_is_a_disagreement():
    """p0 = (V − 2)² − ε² has no slope at 2, but there it is −ε²: more than rounding, unless ε is tiny."""
    at_two = Brackets(np.array([0]), *(np.array([2.0]),) * 2)
    for width, largest in ((1e-2, np.inf), (1e-4, np.inf), (1e-8, 0.0)):
        table = table_with_p0(4 - width**2, -4.0, 1.0)
        for exact in (critical_speeds(table)["p0"], np.empty((0, 1)), np.array([[7.0]])):
            seen = agreement(table, "p0", at_two, exact)
            assert seen.largest == largest
            assert seen.largest_loose < 1e-6  # a speed far away is not the root's own


def test_a_lost_pair_close_to_a_fold_is_a_disagreement():
    """Two roots that rounding moves by more than 1e-10 m/s, but does not make one, must both be there."""
    width = 1e-5
    table = table_with_p0(4 - width**2, -4.0, 1.0)
    roots = refine(table, "p0", brackets_of(table, np.array([1.0, 2.0, 3.0]))["p0"])
    exact = critical_speeds(table)["p0"]
    seen = agreement(table, "p0", roots, exact)
    assert (seen.loose, seen.touching, seen.largest) == (2, 0, 0.0)
    other = agreement(table, "p0", roots, exact[:1])
    assert (other.loose, other.touching) == (1, 1)


def test_a_root_that_cannot_be_refined_is_an_error():
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    same_sign = Brackets(np.array([0]), np.array([1.0]), np.array([2.0]))  # p0 has no root between 1 and 2
    with pytest.raises(ScanError, match=r"p0: 1 of 1 sign changes .* the first between 1 and 2 m/s"):
        refine(table, "p0", same_sign)


def test_joined_agreements_keep_the_worst():
    a, b = boundary.Agreement(3, 1e-14, 1, 1e-9, 2), boundary.Agreement(4, 1e-13, 0, 0.0, 1)
    assert a.joined(b) == b.joined(a) == (7, 1e-13, 1, 1e-9, 3)


def test_polynomials_and_conditions_are_the_same_thing():
    """What ``agreement`` calls the slope is that of the condition the refinement has looked at."""
    table = cells(DIKAREV, 0.2, 0.08)
    for name, polynomial in condition_polynomials(table).items():
        value = sum(c * 4.0**j for j, c in enumerate(polynomial))
        np.testing.assert_allclose(value, getattr(conditions(table, 4.0), name), rtol=1e-9)
