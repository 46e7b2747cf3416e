"""Stable intervals and critical speeds against 40-digit arithmetic and against eigenvalues."""

import json
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given, settings
from mpmath import mp, mpf

from bikestab.bicycle import Bicycle
from bikestab.critical import critical
from bikestab.entries import cells_of
from bikestab.model import ExactTable, characteristic_table, exact_table
from bikestab.routh import coefficients_at, condition_polynomials
from bikestab.speeds import (
    CAPSIZE,
    KINDS,
    NONE,
    REST,
    UNBOUNDED,
    WEAVE,
    _Ends,
    _in_order,
    _others_positive,
    _out_of_order,
    critical_speeds,
    intervals_of,
)
from tests.references import generate_speeds as reference
from tests.strategies import lams, machines, sigmas

EPS = np.finfo(float).eps
CASES = json.loads(reference.FILE.read_text(encoding="utf-8"))
NAMES = [f"{c['name']} {c['lam']:g} {c['sigma']:g} {c['delta']:g} {c['model']}" for c in CASES]
# A critical speed may be wrong by the rounding of the terms that form its polynomial (about 16 operations
# on the way to an entry of the table, some more for hurwitz3) times the root's condition number κ.
OPERATIONS = 32


def intervals(bicycle, lam, sigma, model="refined"):
    """The stable intervals of one design as tuples V1, kind, V2, kind."""
    found = intervals_of(characteristic_table(bicycle, lam, sigma, model=model))
    n = int(found.number)
    return [
        (float(found.V1[i]), KINDS[found.lower[i]], float(found.V2[i]), KINDS[found.upper[i]])
        for i in range(n)
    ]


def table_of(rows, shape=()):
    """A table from {(k, j): coefficient}."""
    table = np.zeros((5, 4, *shape))
    for index, value in rows.items():
        table[index] = value
    return table


def tuples_of(table):
    """The stable intervals of a table of one cell as tuples V1, V2, lower, upper."""
    found = intervals_of(table)
    return list(zip(*(values.tolist() for values in found), strict=True))


@pytest.mark.parametrize("case", CASES, ids=NAMES)
def test_reference(case):
    bicycle = Bicycle.from_mapping(case["machine"]).with_delta(case["delta"])
    found = intervals(bicycle, case["lam"], case["sigma"], case["model"])
    expected = case["intervals"]
    assert [(x[1], x[3]) for x in found] == [(x[1], x[4]) for x in expected]
    for got, want in zip(found, expected, strict=True):
        for value, (text, _, condition) in ((got[0], want[:3]), (got[2], want[3:])):
            exact = mpf(text)
            if math.isinf(value) or value == 0:
                assert value == exact
                continue
            error = abs(value - exact) / exact
            assert error <= OPERATIONS * EPS * condition
            if condition < 1e6:  # every case but the one within 1e-8 rad of a fold of the surface Δ3 = 0
                assert error <= 1e-12


@pytest.mark.parametrize("index", [3, 7, 11, 40])
def test_file_is_what_the_script_writes(index):
    case = dict(CASES[index])
    expected = case.pop("intervals")
    assert case == reference.cases()[index]
    assert reference.result(*list(case.values())[1:]) == expected


def test_script_gives_the_published_speeds():
    """The 40-digit values of docs/theory.md belong to the decimal inputs, not to their doubles."""
    with mp.workdps(40):
        machine = {key: str(value) for key, value in reference.BENCHMARK.items()}
        table = reference.polynomial(machine, mp.pi / 10, mpf("0.08") / mpf("1.02"), 0, "refined")
        ((lower, upper),) = reference.stable_intervals(table)
        assert abs(lower.V - mpf("4.2923825363411039587")) < mpf("1e-18")
        assert abs(upper.V - mpf("6.0242620153883588899")) < mpf("1e-18")


@pytest.mark.parametrize(("delta", "model"), [(0.0, "refined"), (1.0, "refined"), (0.0, "unrefined")])
@settings(deadline=None, max_examples=40, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas)
def test_ends_are_zeros_of_their_condition(delta, model, machine, lam, sigma):
    """In 40 digits and from the parameters on: the distance to the zero, κ being its conditioning."""
    bicycle = Bicycle.from_mapping(machine).with_delta(delta)
    machine = {key: value for key, value in machine.items() if key != "delta"}
    with mp.workdps(40):
        exact = reference.condition_polynomials(reference.polynomial(machine, lam, sigma, delta, model))
        for V1, lower, V2, upper in intervals(bicycle, lam, sigma, model):
            for V, kind in ((V1, lower), (V2, upper)):
                if kind in ("weave", "capsize"):
                    poly = exact["hurwitz3" if kind == "weave" else "p0"]
                    slope = sum(j * x.value * mpf(V) ** j for j, x in poly.items())
                    error = abs(reference.at(poly, V) / slope)
                    assert error <= OPERATIONS * EPS * reference.condition_number(poly, V)


@pytest.mark.parametrize("delta", [0.0, 0.7])
@settings(deadline=None, max_examples=60, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas)
def test_stable_inside_only(delta, machine, lam, sigma):
    """A sweep of a matrix's eigenvalues over V, save where they are within their rounding of zero."""
    table = characteristic_table(Bicycle.from_mapping(machine).with_delta(delta), lam, sigma)
    V = np.geomspace(0.01, 200, 400)
    p0, p1, p2, p3, p4 = coefficients_at(table[..., np.newaxis], V)
    companion = np.zeros((len(V), 4, 4))
    companion[:, [1, 2, 3], [0, 1, 2]] = 1
    companion[:, 0] = -np.stack([p3, p2, p1, p0], axis=1) / p4[:, np.newaxis]
    s = np.linalg.eigvals(companion)
    # ε ρ for a simple eigenvalue; the square root covers a sweep that meets a double one
    clear = np.abs(s.real).min(axis=1) > 1e-7 * np.abs(s).max(axis=1)
    found = intervals_of(table)
    inside = np.any((V[:, np.newaxis] > found.V1) & (V[:, np.newaxis] < found.V2), axis=1)
    assert np.array_equal(inside[clear], (s.real.max(axis=1) < 0)[clear])


def test_interval_narrower_than_any_grid():
    """Around (0.04834835, 0.15) a second interval of 1.6 mm/s, then one more above 24 m/s."""
    first, second = intervals(Bicycle.preset("dikarev1981"), 0.04834835, 0.15)
    assert first[1::2] == ("capsize", "weave")
    assert first[0::2] == pytest.approx((2.2903, 2.2918), abs=5e-5)
    assert second == (pytest.approx(24.33, abs=5e-3), "weave", np.inf, "unbounded")


def test_interval_of_rounding_width():
    """hurwitz3/V² = 2 V² − 2 − w and p0 = 1 + w − V² leave 1 + w/4 … 1 + w/2 with w = 1e-12."""
    w = 1e-12
    narrow = table_of({(4, 0): 1, (3, 1): 1, (2, 2): 1, (1, 1): 1, (0, 0): 1 + w, (0, 2): -1})
    ((V1, V2, lower, upper),) = tuples_of(narrow)
    assert (lower, upper) == (WEAVE, CAPSIZE)
    assert abs(V1 - 1 - w / 4) <= 2 * EPS
    assert abs(V2 - 1 - w / 2) <= 2 * EPS


def test_unbounded_from_rest():
    """(s + 1)⁴ at every speed is stable from rest on."""
    found = intervals_of(table_of({(4, 0): 1, (3, 0): 4, (2, 0): 6, (1, 0): 4, (0, 0): 1}))
    assert found.V1.tolist() == [0]
    assert found.V2.tolist() == [np.inf]
    assert (found.lower[0], found.upper[0]) == (REST, UNBOUNDED)


def test_none():
    found = intervals_of(table_of({(4, 0): 1, (2, 0): -1}))
    assert found.number == 0
    assert np.isnan([found.V1[0], found.V2[0]]).all()
    assert (found.lower.tolist(), found.upper.tolist()) == ([NONE], [NONE])


@pytest.mark.parametrize("k", range(5))
def test_one_negative_coefficient_is_unstable(k):
    """(s + 1)⁴ with p_k < 0 at every speed; for k = 4 hurwitz3 and p0 stay positive."""
    p = np.array([1, 4, 6, 4, 1.0])
    p[k] *= -1
    assert intervals_of(table_of(dict(zip([(j, 0) for j in range(5)], p, strict=True)))).number == 0


@pytest.mark.parametrize("p", [(0, 1, 3, 2, 1), (1.5625, 3.125 / 4, 3.125, 1.25, 1)], ids=["p0", "hurwitz3"])
def test_none_where_a_condition_is_zero_at_all_speeds(p):
    """(s³ + 2 s² + 3 s + 1) s, and (s² + 0.625) (s² + 1.25 s + 2.5)."""
    table = table_of({(k, 0): value for k, value in enumerate(p)})
    assert intervals_of(table).number == 0


def test_touching_weave_is_no_edge():
    """hurwitz3/V² = (V² − 1)² touches zero at V = 1 without a change of sign; p0 = 3 V² − 1."""
    touching = table_of({(4, 0): 1, (3, 1): 1, (2, 2): 2, (2, 0): 1, (1, 3): 1, (0, 2): 3, (0, 0): -1})
    assert tuples_of(touching) == [(pytest.approx(1 / math.sqrt(3)), np.inf, CAPSIZE, UNBOUNDED)]


@pytest.mark.parametrize("power", [1, 2, 3])
@pytest.mark.parametrize("k", [1, 2, 3, 4])
def test_the_sign_of_a_coefficient_that_cancels_is_not_certain(k, power):
    """1 − (V/3)^j at V = 3; beside a certain p1 or p2 the other of them need not be."""
    table = table_of({(j, 0): 1.0 for j in range(1, 5)} | {(k, power): -(3.0**-power)}, (1,))
    stable, certain = _others_positive(cells_of(table), np.array([0]), np.array([3.0]))
    assert (stable.item(), certain.item()) == (k < 3, k < 3)


def test_an_error_is_no_less_than_second_double_and_radius():
    table = exact_table(Bicycle.preset("meijaard2007"), np.array([0.1, 0.2, 0.3]), 0.08)
    found, zeros = intervals_of(table), critical(table, ("p0", "hurwitz3")).zeros
    condition, compared = {WEAVE: "hurwitz3", CAPSIZE: "p0"}, 0
    for cell in range(3):
        for V, error, kind in (
            (found.V1[cell, 0], found.V1_error[cell, 0], found.lower[cell, 0]),
            (found.V2[cell, 0], found.V2_error[cell, 0], found.upper[cell, 0]),
        ):
            if kind not in condition:
                continue
            name, compared = condition[kind], compared + 1
            (row,) = np.flatnonzero(zeros[name].V[:, cell] == V)
            rest, radius = zeros[name].rest[row, cell], zeros[name].radius[row, cell]
            least = abs(Fraction(float(rest))) + Fraction(float(radius))
            assert least <= Fraction(float(error)) < least * Fraction(1 + 1e-14)
    assert compared >= 2


@pytest.mark.parametrize("k", [1, 2, 3, 4])
def test_the_signs_of_coefficients_with_a_part_of_the_inverse_speed(k):
    """1 − 2/V at V = 4 and V = 1."""
    table = np.zeros((5, 5, 1))
    table[:, 0], table[k, 4] = 1.0, -2.0
    stable, certain = _others_positive(cells_of(table), np.array([0, 0]), np.array([4.0, 1.0]))
    assert (stable.tolist(), certain.tolist()) == ([True, k == 2], [True, True])


@pytest.mark.parametrize(("k", "j", "known"), [(1, 0, True), (2, 1, True), (3, 2, False), (4, 0, False)])
def test_signs_are_not_certain_within_the_bounds_of_entries(k, j, known):
    """p_k = 1 ± 2 at V = 2; of p1 and p2 one that is certain will do."""
    value, error = np.zeros((2, 5, 4, 1))
    value[1:, 0], error[1:, 0] = 1.0, 1e-30
    error[k, j] = 2 / 2.0**j
    stable, certain = _others_positive(
        cells_of(ExactTable(value, 0 * value, error)), np.array([0]), np.array([2.0])
    )
    assert (stable.tolist(), certain.tolist()) == ([True], [known])


@pytest.mark.parametrize(
    ("rows", "known"),
    [
        ({2: [], 4: [1, -1 / 3]}, False),  # p2 zero at all speeds tells nothing of p4
        ({1: [1, -1 / 3], 2: [1, -1 / 3]}, False),
        ({1: [1, -1 / 3], 2: [1, -1 / 3], 3: [0.5], 4: [0.5]}, False),
        ({3: []}, True),
        ({4: []}, True),  # not stable, whatever the others are
    ],
)
def test_which_signs_are_certain_where_some_are_zero(rows, known):
    """At all speeds, or at V = 3 but for rounding."""
    table = table_of({(k, 0): 1.0 for k in range(1, 5) if k not in rows}, (1,))
    for k, row in rows.items():
        table[k, : len(row), 0] = row
    stable, certain = _others_positive(cells_of(table), np.array([0]), np.array([3.0]))
    assert certain.tolist() == [known]
    assert not (known and stable.item())


def test_where_one_sign_says_no_the_others_need_not_be_certain():
    """p3 = V − 2 is zero in the middle of 1 < V < 3, where hurwitz3 = 1 − (V − 2)² > 0; p4 = −1."""
    found = intervals_of(table_of({(0, 0): 1, (1, 0): 1, (3, 1): 1, (3, 0): -2, (4, 0): -1}))
    assert (found.number, found.marginal) == (0, 0)


@pytest.mark.parametrize("speed", [0.34375, 1.375, 2.0, 2.15625])
@pytest.mark.parametrize("sign", [1, -1])
def test_where_capsize_is_only_touched_the_answer_is_marginal_and_has_no_interval_more(sign, speed):
    """p0 = ± (V − speed)², and hurwitz3 = 80 − 16 p0; next to it p0 with two zeros 2^−19 apart is certain."""
    rows = {(1, 0): 4, (2, 0): 6, (3, 0): 4, (4, 0): 1, (0, 1): -2 * sign * speed, (0, 2): sign}
    touched = intervals_of(table_of({**rows, (0, 0): sign * speed**2}))
    assert touched.marginal == 1
    ends = [0.0, speed + math.sqrt(5)] if sign > 0 else [math.nan, math.nan]
    np.testing.assert_allclose([touched.V1[0], touched.V2[0]], ends, rtol=1e-15)
    assert (touched.lower, touched.upper) == ((REST, WEAVE) if sign > 0 else (NONE, NONE))
    apart = intervals_of(table_of({**rows, (0, 0): sign * (speed**2 - 2.0**-40)}))
    assert not apart.marginal.any()
    near = [speed - 2.0**-20, speed + 2.0**-20]
    expected = [(0.0, near[0]), (near[1], speed + math.sqrt(5))] if sign > 0 else [tuple(near)]
    np.testing.assert_allclose([*zip(apart.V1, apart.V2, strict=True)], expected, rtol=1e-12)
    kinds = [*zip(apart.lower, apart.upper, strict=True)]
    assert kinds == ([(REST, CAPSIZE), (CAPSIZE, WEAVE)] if sign > 0 else [(CAPSIZE, CAPSIZE)])


def test_stable_at_every_speed_but_rest():
    """s⁴ + V s³ + 3 s² + V s + 1: hurwitz3 = V²."""
    table = table_of({(4, 0): 1, (3, 1): 1, (2, 0): 3, (1, 1): 1, (0, 0): 1})
    assert tuples_of(table) == [(0.0, np.inf, REST, UNBOUNDED)]
    assert intervals_of(table).marginal == 0


def test_an_ordinary_answer_is_certain_and_has_narrow_bounds():
    bicycle = Bicycle.preset("dikarev1981")
    found = intervals_of(characteristic_table(bicycle, 0.2, 0.08))
    assert found.marginal == 0
    assert 0 < found.V1_error[0] < 1e-14
    assert 0 < found.V2_error[0] < 1e-14


def test_root_of_hurwitz3_that_is_no_edge():
    """At (0.05, 0.15) Δ3 is zero at 1.58 m/s too, but p0 < 0 on both sides of it."""
    table = characteristic_table(Bicycle.preset("dikarev1981"), 0.05, 0.15)
    assert critical_speeds(table)["hurwitz3"] == pytest.approx([1.5796, 4.8065], abs=5e-5)
    assert [V1 for V1, *_ in tuples_of(table)] == pytest.approx([4.8065], abs=5e-5)


@settings(deadline=None, max_examples=60, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas)
def test_critical_speeds_are_sign_changes(machine, lam, sigma):
    """Each condition changes sign at each of its speeds, and only there."""
    table = characteristic_table(Bicycle.from_mapping(machine), lam, sigma)
    for name, speeds in critical_speeds(table).items():
        poly = condition_polynomials(table)[name]
        ends = np.concatenate([[1e-3], speeds[np.isfinite(speeds)], [1e3]])
        assume(np.all(ends[1:] > ends[:-1] * (1 + 1e-6)))
        V = np.sqrt(ends[:-1] * ends[1:])
        sign = np.sign(np.polynomial.polynomial.polyval(V, poly))
        if np.any(poly):
            assert np.all(sign[:-1] * sign[1:] == -1)
            assert np.all(sign != 0)


def test_shapes_and_vectorised_equals_scalar():
    bicycle = Bicycle.preset("dikarev1981")
    lam, sigma = np.array([0.015, 0.04834835, 0.1, 0.2])[:, np.newaxis], np.array([0.08, 0.1475, 0.15])
    found = intervals_of(characteristic_table(bicycle, lam, sigma))
    assert found.V1.shape == found.lower.shape == (4, 3, 2)
    assert found.number.shape == (4, 3)
    for i, j in np.ndindex(4, 3):
        one = intervals_of(characteristic_table(bicycle, lam[i, 0], sigma[j]))
        n = int(one.number)
        assert found.number[i, j] == n
        for many, single in zip(found, one, strict=True):
            assert np.array_equal(many[i, j, :n], single[:n])
        assert np.isnan(found.V1[i, j, n:]).all()
        assert np.isnan(found.V2[i, j, n:]).all()
        assert not found.upper[i, j, n:].any()


def test_more_cells_than_are_worked_on_at_a_time():
    """Cells beyond the first chunk, of different numbers of intervals."""
    bicycle = Bicycle.preset("dikarev1981")
    lam = np.tile([0.2, 0.1, 0.04834835], 12000)
    found = intervals_of(characteristic_table(bicycle, lam, 0.15))
    few = intervals_of(characteristic_table(bicycle, lam[:3], 0.15))
    for many, once in zip(found, few, strict=True):
        assert np.array_equal(many, np.tile(once, (12000, 1)), equal_nan=many.dtype.kind == "f")


def test_no_cells():
    found = intervals_of(np.zeros((5, 4, 0)))
    assert found.V1.shape == (0, 1)
    assert found.number.shape == (0,)


def test_ends_of_one_speed_go_by_their_second_doubles():
    V, radius = np.ones(3), np.array([1e-30, 1.0, 1e-30])
    one = (V, np.array([1e-20, 1e-20, 3e-20]), radius, np.full(3, WEAVE, np.uint8))
    other = (V, np.array([2e-20, 1e-20, 2e-20]), radius[::-1], np.full(3, CAPSIZE, np.uint8))
    first, second = _in_order(one, other)
    np.testing.assert_array_equal(first[1], [1e-20, 1e-20, 2e-20])
    np.testing.assert_array_equal(second[1], [2e-20, 1e-20, 3e-20])
    assert first[3].tolist() == [WEAVE, WEAVE, CAPSIZE]  # those that are equal stay
    assert second[3].tolist() == [CAPSIZE, CAPSIZE, WEAVE]


@pytest.mark.parametrize(("kinds", "close"), [((WEAVE, CAPSIZE), True), ((WEAVE, WEAVE), False)])
def test_bounds_that_touch(kinds, close):
    V, nothing = np.array([[0.0], [1.0], [2.0], [np.inf]]), np.zeros((4, 1))
    radius = np.array([[0.0], [0.5], [0.5], [0.0]])
    kind = np.array([[REST], [kinds[0]], [kinds[1]], [UNBOUNDED]], np.uint8)
    assert _out_of_order(_Ends(V, nothing, radius, kind)).tolist() == [close]
    assert not _out_of_order(_Ends(V, nothing, 0.99 * radius, kind)).any()
