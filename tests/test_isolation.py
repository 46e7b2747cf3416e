"""Intervals with one zero each, and what is left undecided."""

from fractions import Fraction

import numpy as np
import pytest

import bikestab as bs
import bikestab.critical
import bikestab.isolation
from bikestab import signchanges
from bikestab.bicycle import Bicycle
from bikestab.certain import signs, zeros_of
from bikestab.corrected import zeros_between
from bikestab.isolation import _sign_changes, _whole, brackets, guessed, isolated
from bikestab.model import exact_table
from bikestab.rounding import COEFFICIENT, CUT
from bikestab.speeds import CAPSIZE, REST, UNBOUNDED, WEAVE, _Ends, _out_of_order
from bikestab.twofold import Double, Twofold


def polynomial(*zeros):
    """Coefficients of the product of x − zero: these zeros are such that no rounding occurs."""
    return [Twofold(np.array([a])) for a in np.polynomial.polynomial.polyfromroots(zeros)]


@pytest.mark.parametrize("power", [-3, -1, 0, 1, 4])
@pytest.mark.parametrize("others", [(3.5, -2.0), (1.0, 2.0, 4.0)])
def test_a_zero_where_the_axis_is_cut(power, others):
    """At 1.375 · 2^k, where cuts come, every one is found, and it is certain that there are no others."""
    expected = sorted(x for x in (1.375 * 2.0**power, *others) if x > 0)
    found = zeros_of(polynomial(1.375 * 2.0**power, *others), 1)
    assert found.sure.all()
    assert found.V[:, 0].tolist() == expected
    assert (found.radius[np.isfinite(found.V)] <= 1e-20).all()


def test_two_uncertain_coefficients_side_by_side_decide_nothing():
    """Their signs may be −, + between + and −: three changes."""
    for values, clear in (([1, 0.5, -1, -1], True), ([1, 0, -1, -1], True), ([1, 0, 0, -1], False)):
        b = np.array(values, float)[:, np.newaxis] * np.ones(2)
        work = _whole(Twofold(b, None, np.ones_like(b)), 1)
        assert _sign_changes(work, CUT)[1].tolist() == [clear, clear]


def test_the_plain_pass_leaves_what_it_cannot_tell():
    """A double zero, and two that are 1e-13 apart: pairs of doubles find the latter."""
    double = polynomial(1.0, 1.0, 3.0)
    assert isolated([Double(a.value, a.size) for a in double], 1)[1].all()
    assert not brackets(double, 1, COEFFICIENT)[1].any()
    near = polynomial(1.0, 1.0 + 2.0**-20)
    assert brackets(near, 1, COEFFICIENT)[1].all()
    assert zeros_of(near, 1).V[:, 0].tolist() == [1.0, 1.0 + 2.0**-20]


def test_a_guess_has_the_zeros_that_are_apart_and_no_double_one():
    """Whose sign rounding decides: none leaves the sign as it is, and the cell is not sure."""
    for m in np.random.default_rng(5).integers(1, 1 << 12, 12) / 2.0**9:
        for others in ((), (0.3125,), (m + 2.0**-16, 9.0)):
            (cell, low, high, _), sure = guessed(polynomial(m, m, *others), 1)
            assert not sure.any()
            assert len(cell) == len(others)
            assert all(np.any((low < zero) & (zero < high)) for zero in others)
    near = polynomial(1.0, 1.0 + 2.0**-20)
    assert len(guessed(near, 1)[0].cell) == 2


def test_powers_that_no_cell_has_are_left_out_of_the_cuts():
    """(x² − 1)(x² − 1 − 2^−20), which double precision does not part."""
    apart = 2.0**-20
    even = [None if a is None else Twofold(np.array([a])) for a in (1 + apart, None, -2 - apart, None, 1.0)]
    found, sure = brackets(even, 1, COEFFICIENT)
    assert sure.all()
    low, high = (np.sort(ends) for ends in (found.low, found.high))
    zeros = np.sqrt([1.0, 1 + apart])
    assert np.all((low <= zeros) & (zeros <= high))
    assert high[0] <= low[1]


@pytest.mark.parametrize(
    "zeros",
    [
        ("1.1", "1.1"), ("1.1", "1.1", "3"), ("0.6", "0.6", "0.6"), ("1.1", "1.1 + 1e-30"),
        ("1.1", "1.1 + 1e-12", "1.1 + 2e-12"),
    ],
    ids=["double", "double, and another", "triple", "two as good as one", "three as good as one"],
)  # fmt: skip
def test_what_cuts_do_not_end_is_undecided(zeros):
    """Zeros that pairs of doubles cannot tell from one of that order, which coefficients round."""
    c = [Fraction(1)]
    for zero in zeros:
        x = sum(map(Fraction, zero.split(" + ")))
        c = [a - x * b for a, b in zip([Fraction(0), *c], [*c, Fraction(0)], strict=True)]
    value = [float(a) for a in c]
    rest = [float(a - Fraction(b)) for a, b in zip(c, value, strict=True)]
    near = [Twofold(*(np.array([x]) for x in (a, b, abs(a)))) for a, b in zip(value, rest, strict=True)]
    found, sure = brackets(near, 1, COEFFICIENT)
    assert not sure.any()
    assert len(found.cell) == zeros.count("3")


@pytest.mark.parametrize("power", [-18, -24, -30, -36, -40])
def test_zeros_close_to_each_other_take_few_cuts(monkeypatch, power):
    """(x − m)² ∓ 4^power times other factors: both zeros, or none, are known after a few cuts."""
    monkeypatch.setattr(bikestab.isolation, "DEPTH", 12)
    middles = [Fraction(m) for m in (0.6, 1.1, 1.7, 5.3)]
    cells = [(m, two, other) for m in middles for two in (1, -1) for other in (0, 1)]
    rows = []
    for m, two, other in cells:
        c = [m * m - two * Fraction(4) ** power, -2 * m, Fraction(1)]
        for zero in (Fraction(3), Fraction(-2), Fraction(1, 4))[: 3 * other]:
            c = [a - zero * b for a, b in zip([Fraction(0), *c], [*c, Fraction(0)], strict=True)]
        rows.append(c + [Fraction(0)] * (6 - len(c)))
    value = [np.array([float(c[j]) for c in rows]) for j in range(6)]
    rest = [np.array([float(c[j] - Fraction(float(c[j]))) for c in rows]) for j in range(6)]
    near = [Twofold(a, b, np.abs(a)) for a, b in zip(value, rest, strict=True)]
    found = zeros_of(near, len(cells))
    assert found.sure.all()
    for k, (m, two, other) in enumerate(cells):
        around = [m - Fraction(2) ** power, m + Fraction(2) ** power] if two > 0 else []
        expected = sorted(around + [Fraction(3), Fraction(1, 4)][: 2 * other])
        V, rest_of, radius = (x[np.isfinite(found.V[:, k]), k] for x in found[:3])
        assert len(V) == len(expected)
        for x, low, far, zero in zip(V, rest_of, radius, expected, strict=True):
            assert abs(Fraction(x) + Fraction(low) - zero) <= Fraction(far)


@pytest.mark.parametrize("name", ["p1", "hurwitz3"])
@pytest.mark.parametrize("preset", ["meijaard2007", "dikarev1981", "sharp1971"])
def test_pairs_of_doubles_throughout_find_the_same_speeds(monkeypatch, preset, name):
    """As what double precision isolates and one step corrects: they meet within both bounds."""
    bicycle = Bicycle.preset(preset).with_delta(2.0)
    lam, sigma = np.linspace(0.02, 0.5, 9), np.linspace(-0.02, 0.3, 7)[:, np.newaxis]
    table = exact_table(bicycle, lam, sigma)
    plain = bikestab.critical.critical(table, [name]).zeros[name]

    def never_sure(*args):
        zeros = zeros_between(*args)
        return zeros._replace(sure=np.zeros_like(zeros.sure))

    monkeypatch.setattr(bikestab.critical, "zeros_between", never_sure)
    fine = bikestab.critical.critical(table, [name]).zeros[name]
    assert fine.sure.all()
    assert np.isfinite(fine.V).any()
    np.testing.assert_array_equal(np.isfinite(plain.V), np.isfinite(fine.V))
    apart = np.abs((plain.V - fine.V) + (plain.rest - fine.rest))
    assert np.all(apart[np.isfinite(apart)] <= (plain.radius + fine.radius)[np.isfinite(apart)])


def test_a_sign_is_certain_from_twice_the_error():
    a = Twofold(np.array([1.0, 1.0]) * COEFFICIENT, 0.0, np.array([0.4, 0.6]))
    assert signs(a)[1].tolist() == [True, False]


def test_ends_that_are_no_neighbours_may_be_out_of_order():
    V = np.array([[0.0, 0.0], [1.0, 1.0], [1.1, 1.1], [1.2, 1.2], [np.inf, np.inf]])
    radius = np.array([[0, 0], [0.3, 0.1], [0, 0], [0, 0], [0, 0]])
    kind = np.array([[REST] * 2, [WEAVE] * 2, [WEAVE] * 2, [CAPSIZE] * 2, [UNBOUNDED] * 2], np.uint8)
    assert _out_of_order(_Ends(V, np.zeros_like(V), radius, kind)).tolist() == [True, False]


def test_tabulated_sign_changes_are_those_counted():
    rng = np.random.default_rng(2)
    for rows in (4, 7):
        positive, negative = rng.random((2, rows, signchanges._FEW)) < 0.6
        many = signchanges.sign_changes(positive, negative)
        halves = zip(np.hsplit(positive, 2), np.hsplit(negative, 2), strict=True)
        few = [signchanges.sign_changes(*half) for half in halves]
        for values, parts in zip(many, zip(*few, strict=True), strict=True):
            np.testing.assert_array_equal(values, np.concatenate(parts))


def test_a_guess_keeps_a_zero_beside_one_that_is_hardly_positive():
    """hurwitz3 is zero at some 1e-13 m/s and at V1; its least value near the former may be zero."""
    sigma = [0.031088436576, 0.0310884365762, 0.0310884365765]
    found = bs.stable_intervals(
        bs.Bicycle.preset("dikarev1981").with_delta(1.0), lam=0.2347369142973972, sigma=sigma
    )
    assert found.number.tolist() == [1, 1, 1]
    assert found.V1[:, 0] == pytest.approx(2.493606, abs=1e-6)
