"""The exact critical speeds and the masks from them, checked against the conditions themselves."""

from functools import reduce
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings

from bikestab.bicycle import Bicycle
from bikestab.critical import critical
from bikestab.model import characteristic_table
from bikestab.routh import CONDITIONS, condition, condition_polynomials, conditions
from bikestab.scan.agreement import AGREEMENT, Agreement
from bikestab.scan.crosscheck import check
from bikestab.scan.signs import violated_between
from bikestab.speeds import critical_speeds, intervals_of
from tests.onecell import table_of, with_speeds
from tests.strategies import machines

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
V = np.linspace(0, 15, 301)
BOX = np.linspace(0, 0.3, 16), np.linspace(0, 0.15, 16)


def cells(bicycle, lam, sigma):
    """The table (5, 4, cell) of every pair of λ and σ."""
    return characteristic_table(bicycle, np.atleast_1d(lam)[:, None], sigma).reshape(5, 4, -1)


def checked(table, exact=None, V=V):
    """What is seen of critical speeds, by default the right ones, and of the mask that follows from them."""
    exact = critical(table) if exact is None else exact
    return check(table, exact, violated_between(table, exact, V), V)


def with_roots(table, name, change):
    """The critical speeds of a table with those of one condition changed."""
    exact = critical(table)
    return with_speeds(exact, {name: change(exact.speeds[name])})


# --- agreement


@pytest.mark.parametrize(
    "bicycle",
    [DIKAREV, MEIJAARD, DIKAREV.with_delta(2.0), Bicycle.preset("kooijman2011")],
    ids=["1981", "2007", "damped", "skates"],
)
def test_every_exact_speed_is_a_zero_of_its_condition(bicycle):
    table = cells(bicycle, *BOX)
    seen = checked(table)
    exact = critical_speeds(table)
    assert seen.roots == sum(np.count_nonzero(exact[name] <= V[-1]) for name in CONDITIONS) >= 200
    assert seen.largest <= AGREEMENT
    assert seen.largest_loose <= 1e-5
    assert seen.touching == 0


def test_speeds_above_the_last_one_are_not_looked_at():
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    speeds = np.sort([v for roots in critical_speeds(table).values() for v in roots.ravel() if v < 15])
    for k in range(1, len(speeds)):
        assert checked(table, V=np.array([0, 0.5 * (speeds[k - 1] + speeds[k])])).roots == k
    assert checked(table, V=np.array([1.0, speeds[0]])).roots == 1


@settings(max_examples=40, deadline=None, derandomize=True)
@given(machines)
def test_random_machines(machine):
    table = cells(Bicycle.from_mapping(machine), np.linspace(0, 0.6, 4), np.linspace(0, 0.3, 4))
    assert checked(table).largest <= AGREEMENT


@pytest.mark.parametrize(("name", "speed"), [("hurwitz3", 4.2923825363411), ("p0", 6.0242620153884)])
def test_the_benchmarks_edges(name, speed):
    """The published speeds are zeros, and none is 2e-10 m/s beside them."""
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    assert checked(table, with_roots(table, name, lambda _: np.array([[speed]]))).largest <= 1e-12
    assert checked(table, with_roots(table, name, lambda _: np.array([[speed + 2e-10]]))).largest >= 1.9e-10


# --- close to a fold, where two roots meet


def bisect(low, high, is_low):
    """The two neighbouring numbers between which something changes."""
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (middle, high) if is_low(middle) else (low, middle)
    return low, high


def test_near_the_end_of_the_stable_region():
    """Where weave meets capsize."""
    low, high = bisect(0.1, 0.3, lambda lam: not intervals_of(cells(DIKAREV, lam, [0.08])).number.any())
    table = cells(DIKAREV, high + np.array([0, 1e-13, 1e-10, 1e-7]), [0.08])
    inside = intervals_of(table)
    assert np.all(inside.number == 1)
    assert np.all(np.diff(inside.V2[:, 0] - inside.V1[:, 0]) > 0)
    assert intervals_of(cells(DIKAREV, low, [0.08])).number == 0
    assert checked(table).largest <= AGREEMENT


@pytest.mark.parametrize(("delta", "ends"), [(0.0, (0.052, 0.054)), (1.0, (0.014, 0.017))])
def test_near_a_fold(delta, ends):
    """Where two weave speeds meet: the nearer it is, the less does double precision fix them."""
    bicycle = DIKAREV.with_delta(delta)

    def speeds(lam):
        return np.count_nonzero(critical_speeds(cells(bicycle, lam, [0.08]))["hurwitz3"] > 0)

    number = speeds(ends[0])
    low, high = bisect(*ends, lambda lam: speeds(lam) == number)
    assert (number, speeds(high)) == (number, number - 2)
    for gap in np.geomspace(1e-16, 1e-5, 34):
        for lam in (low - gap, high + gap):
            seen = checked(cells(bicycle, lam, [0.08]))
            assert seen.largest <= AGREEMENT
            assert seen.largest_loose < 1e-5
    # in a single double the signs beside two roots may differ by chance as they should
    at_the_fold = checked(cells(bicycle, low - np.arange(20) * np.spacing(low), [0.08]))
    assert at_the_fold.loose + at_the_fold.touching > 0
    assert checked(cells(bicycle, low - 1e-5, [0.08])).loose == 0


def pair(width):
    """P4 = (V − 2)² − width², so that two roots are 2 ± width."""
    return table_of(p4=[4 - width**2, -4.0, 1.0])


def of_p4(table):
    """The table's critical speeds, of p4 alone."""
    exact = critical(table)
    return with_speeds(exact, {n: r[:0] for n, r in exact.speeds.items() if n != "p4"})


@pytest.mark.parametrize(("width", "loose"), [(1e-3, 0), (1e-5, 0), (1e-6, 2), (1e-7, 2)])
def test_a_root_that_rounding_moves_is_called_loose(width, loose):
    """Rounding of p4's terms, 16, moves a root by some 1e-15/width: more than 1e-10 m/s below 1e-5."""
    table = pair(width)
    seen = check(table, of_p4(table), violated_between(table, critical(table), V), V)
    assert seen.roots == 2
    assert seen.loose <= loose
    assert seen.largest <= AGREEMENT
    assert seen.largest_loose <= 1e-8


@pytest.mark.parametrize("k", range(40))
def test_roots_that_have_nearly_met(k):
    """However the rounding of their difference turns out, it is neither an error nor a disagreement."""
    table = pair(1e-8 * (1 + 0.17 * k))
    seen = check(table, of_p4(table), violated_between(table, critical(table), V), V)
    assert seen.largest <= AGREEMENT
    assert seen.largest_loose <= 1e-7


def test_a_double_root_on_a_speed_of_the_grid_is_no_disagreement():
    """p4 = (V − 2)² is zero at 2, which the conditions call violated, but changes no sign."""
    table = pair(0)
    seen = checked(table, V=np.array([0.0, 1, 2, 3]))
    assert critical_speeds(table)["p4"].size == 0
    assert not critical(table).zeros["p4"].sure.any()
    assert (seen.largest, seen.loose, seen.touching) == (0, 0, 1)


def test_a_condition_that_is_zero_to_rounding_has_no_sign_to_differ_in():
    """(s² + a²)(s² + k V s + b²): hurwitz3 is zero, and what 40 ε change in it is still called that."""
    touching = 0
    for change in range(-40, 41, 4):
        table = np.zeros((5, 4, 1))
        table[range(5), [0, 1, 0, 1, 0], 0] = 0.6 * 2.6, 0.6 * 1.7, 3.2, 1.7, 1.0
        table[1] *= 1 + change * np.finfo(float).eps
        seen = checked(table)
        assert seen.largest <= AGREEMENT
        touching += seen.touching
    assert touching > 0


# --- what is wrong is seen


@pytest.mark.parametrize("name", ["p0", "p1", "p2", "hurwitz3"])
@pytest.mark.parametrize("shift", [1e-9, 1e-6, 1e-4, -1e-6])
def test_a_wrong_root_is_seen_with_its_size(name, shift):
    """To within the factor 2 of the steps in which the sign change near it is looked for."""
    table = cells(DIKAREV, 0.2, 0.08)
    largest = checked(table, with_roots(table, name, lambda roots: roots + shift)).largest
    assert abs(shift) * 0.99 <= largest <= abs(shift) * 2


def test_roots_that_are_all_a_little_too_large():
    table = cells(DIKAREV, *BOX)
    for name in ("p0", "hurwitz3"):
        assert checked(table, with_roots(table, name, lambda roots: roots * (1 + 1e-9))).largest > 1e-9


def test_a_root_far_from_any_zero_is_a_disagreement():
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    assert checked(table, with_roots(table, "p0", lambda _: np.array([[9.0]]))).largest == np.inf


def test_a_missing_root_is_seen_by_the_signs_on_the_grid():
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    for name in ("p0", "hurwitz3"):
        assert checked(table, with_roots(table, name, lambda roots: roots[:-1])).largest == np.inf


def test_one_cells_missing_root_among_many():
    def without_one(roots):
        roots = roots.copy()
        roots[0, np.nanargmin(np.abs(roots[0] - 5))] = np.nan
        return np.sort(roots, axis=0)

    table = cells(DIKAREV, *BOX)
    assert checked(table, with_roots(table, "hurwitz3", without_one)).largest == np.inf


def test_a_lost_pair_is_seen_where_a_sample_lies_between():
    table = table_of(p2=[6 - 1e-3, -5.0, 1.0])  # zero at about 2 and 3
    assert checked(table, V=np.array([0, 2.5, 5])).largest <= AGREEMENT
    lost = with_roots(table, "p2", lambda roots: roots[:0])
    assert checked(table, lost, V=np.array([0, 2.5, 5])).largest == np.inf
    assert checked(table, lost, V=np.linspace(0, 15, 16)).largest == np.inf


def test_a_wrong_mask_is_seen():
    table = cells(DIKAREV, *BOX)
    exact = critical(table)
    mask = violated_between(table, exact, V)
    mask[100, -1] ^= 1 << CONDITIONS.index("p1")
    assert check(table, exact, mask, V).largest == np.inf


def test_a_point_near_a_fold_that_is_no_zero_is_a_disagreement():
    """p4 = (V − 2)² − width² has no slope at 2, but there it is −width²: more than rounding, or not."""
    for width, largest in ((1e-2, np.inf), (1e-4, np.inf), (1e-8, 0)):
        table = pair(width)
        at_two = of_p4(table)
        at_two.speeds["p4"] = np.array([[2.0]])
        mask = violated_between(table, critical(table), V)
        assert check(table, at_two, mask, V).largest == pytest.approx(largest, abs=AGREEMENT)


def test_what_is_partly_no_number_is_a_disagreement():
    """Not all of the conditions see that; a volume must not call it stable."""
    table = cells(MEIJAARD, MEIJAARD.lam, MEIJAARD.sigma)
    table[0, 2] = np.nan
    assert checked(table).largest == np.inf


# --- sums


def test_combined_agreements_keep_the_worst():
    a, b = Agreement(3, 1e-14, 1, 1e-9, 2), Agreement(4, 1e-13, 0, 0.0, 1)
    assert a.combined(b) == b.combined(a) == (7, 1e-13, 1, 1e-9, 3)
    assert Agreement().combined(a) == a


def test_polynomials_and_conditions_are_the_same_thing():
    """What is called the slope is that of the condition whose signs are looked at; ``condition`` is one."""
    table = cells(DIKAREV.with_delta(1.0), 0.2, 0.08)
    for name, polynomial in condition_polynomials(table).items():
        value = sum(c * 4.0**j for j, c in enumerate(polynomial))
        np.testing.assert_allclose(value, getattr(conditions(table, 4.0), name), rtol=1e-9)
        np.testing.assert_array_equal(condition(table, name, 4.0), getattr(conditions(table, 4.0), name))


def test_parts_of_the_speeds_see_each_root_once():
    """A tile looks at the roots above the last speed of the tile before, so none between them is left out."""
    table = cells(DIKAREV.with_delta(0.5), *BOX)
    whole, exact = checked(table), critical(table)
    for borders in ([0, 301], [0, 2, 150, 301], range(0, 302, 7)):
        parts = [
            check(table, exact, violated_between(table, exact, V[a:b]), V[a:b], float(V[a - 1]) if a else 0.0)
            for a, b in pairwise(borders)
        ]
        total = reduce(Agreement.combined, parts)
        assert total[:4] == whole[:4]


def test_roots_closer_together_than_the_check_looks():
    """With a trace of damping hurwitz3 has roots of 1e-10 m/s that lie as close to each other."""
    bicycle = Bicycle.preset("sharp1971").with_delta(1e-9)
    table = cells(bicycle, np.radians(np.linspace(0, 40, 41)), np.linspace(-0.6, 0.2, 41))
    speeds = np.linspace(0, 20, 21)
    exact = critical(table)
    close = np.diff(exact.speeds["hurwitz3"], axis=0)
    assert np.nanmin(close) < 2 * AGREEMENT
    seen = check(table, exact, violated_between(table, exact, speeds), speeds)
    assert seen.largest <= AGREEMENT
