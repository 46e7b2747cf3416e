"""Intervals with one zero each, and what is left undecided."""

import numpy as np
import pytest

from bikestab.certain import signs, zeros_of
from bikestab.isolation import _sign_changes, _whole, brackets, isolated
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


def test_a_sign_is_certain_from_twice_the_error():
    a = Twofold(np.array([1.0, 1.0]) * COEFFICIENT, 0.0, np.array([0.4, 0.6]))
    assert signs(a)[1].tolist() == [True, False]


def test_ends_that_are_no_neighbours_may_be_out_of_order():
    V = np.array([[0.0, 0.0], [1.0, 1.0], [1.1, 1.1], [1.2, 1.2], [np.inf, np.inf]])
    radius = np.array([[0, 0], [0.3, 0.1], [0, 0], [0, 0], [0, 0]])
    kind = np.array([[REST] * 2, [WEAVE] * 2, [WEAVE] * 2, [CAPSIZE] * 2, [UNBOUNDED] * 2], np.uint8)
    assert _out_of_order(_Ends(V, np.zeros_like(V), radius, kind)).tolist() == [True, False]
