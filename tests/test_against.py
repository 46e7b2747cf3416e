"""Where motion at one speed is stable as a parameter varies: the ends are exact."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from bikestab.against import modes_against, stable_ranges
from bikestab.bicycle import Bicycle
from bikestab.model import exact_table
from bikestab.speeds import intervals_of
from bikestab.variants import varied
from tests.strategies import meijaard_machines

CASES = [
    ("meijaard2007", "mB", (40.0, 140.0), 5.0),
    ("meijaard2007", "delta", (0.0, 20.0), 5.0),
    ("meijaard2007", "lam", (0.0, 0.6), 5.0),
    ("meijaard2007", "offset", (-0.05, 0.12), 5.0),
    ("sharp1971", "trail", (0.0, 0.3), 10.0),
    ("kooijman2011", "sigma", (-0.05, 0.05), 4.0),
]


@pytest.mark.parametrize(("preset", "name", "ends", "V"), CASES)
def test_at_the_ends_the_speed_is_an_end_of_the_exact_intervals(preset, name, ends, V):
    bicycle = Bicycle.preset(preset)
    found = modes_against(bicycle, name, np.linspace(*ends, 12), V)
    inner = [end for pair in found.stable for end in pair if end not in ends]
    assert inner
    for end in inner:
        machine, lam, sigma = varied(bicycle, {name: np.array([end])})
        intervals = intervals_of(exact_table(machine, lam, sigma))
        speeds = np.concatenate([intervals.V1.ravel(), intervals.V2.ravel()])
        near = np.abs(speeds - V).min() < 1e-9 * V
        vertical = np.abs(_growth(machine, lam, sigma, V)) < 1e-9  # an end at all speeds
        assert near or vertical, (end, speeds)


@pytest.mark.parametrize(("preset", "name", "ends", "V"), CASES)
def test_ranges_are_those_in_which_no_eigenvalue_grows(preset, name, ends, V):
    """Seen at samples that the ranges were not found from, by numpy's eigenvalues of the companion matrix."""
    bicycle = Bicycle.preset(preset)
    ranges = modes_against(bicycle, name, np.linspace(*ends, 12), V).stable
    x = np.linspace(*ends, 157)
    machine, lam, sigma = varied(bicycle, {name: x})
    lam, sigma, _ = np.broadcast_arrays(lam, sigma, x)
    stable = _growth(machine, lam, sigma, V) < 0
    inside = np.any([(low < x) & (x < high) for low, high in ranges], axis=0)
    np.testing.assert_array_equal(stable[1:-1], inside[1:-1])


def _growth(machine, lam, sigma, V):
    return np.array([roots.real.max() for roots in _roots(machine, lam, sigma, V)])


def _roots(machine, lam, sigma, V):
    table = np.asarray(exact_table(machine, lam, sigma).value)
    p = np.moveaxis(table, (0, 1), (-2, -1)) @ V ** np.arange(4.0)
    return [np.roots(row[::-1]) for row in p]


def test_a_narrow_range_between_two_conditions():
    """Both zeros lie between the same two values: 0.31 of the one that is met first, 0.32 of the other."""
    assert stable_ranges(lambda x: np.array([x > 0.31, x < 0.32]), np.array([0.0, 1.0])) == [
        (pytest.approx(0.31, abs=1e-15), pytest.approx(0.32, abs=1e-15))
    ]
    assert stable_ranges(lambda x: np.array([x > 0.32, x < 0.31]), np.array([0.0, 1.0])) == []
    assert stable_ranges(lambda x: np.array([(x < 0.2) | (x > 0.7)]), np.linspace(0, 1, 4)) == [
        (0.0, pytest.approx(0.2)),
        (pytest.approx(0.7), 1.0),
    ]
    assert stable_ranges(lambda x: np.ones((1, len(x)), bool), np.array([2.0, 1.0])) == [(1.0, 2.0)]
    assert stable_ranges(lambda x: np.ones((1, len(x)), bool), np.array([2.0])) == []


def test_curves_lead_through_the_modes_and_on_to_where_they_meet():
    """Their points are eigenvalues as numpy has them, named as at the values that they start from."""
    bicycle = Bicycle.preset("kooijman2011")
    values = np.linspace(0, 5, 6)
    found = modes_against(bicycle, "delta", values, 4.5)
    names = {str(name) for modes in found.modes for name in modes.names[:, 0]}
    assert {curve.name for curve in found.curves} == names
    for curve in found.curves:
        machine, lam, sigma = varied(bicycle, {"delta": curve.x[::7]})
        lam, sigma, _ = np.broadcast_arrays(lam, sigma, curve.x[::7])
        for roots, s in zip(_roots(machine, lam, sigma, 4.5), curve.s[::7], strict=True):
            assert np.abs(roots - s).min() < 1e-5 * max(abs(s), 1)  # some nearly meet
    for modes, x in zip(found.modes, values, strict=True):
        for s, name in zip(modes.eigenvalues[:, 0], modes.names[:, 0], strict=True):
            if s.imag >= 0:
                near = [c.name for c in found.curves if np.abs(c.s - s).min() < 1e-9 * abs(s)]
                assert name in near, (x, name)


@pytest.mark.parametrize(
    ("preset", "name", "values", "V"),
    [
        ("sharp1971", "delta", [0, 15, 30], 0.5),
        ("sharp1971", "lam", [-0.3, 0.9], 0.5),
        ("meijaard2007", "lam", np.linspace(-0.3, 0.9, 5), 0.5),
    ],
)
def test_curves_are_of_all_eigenvalues_everywhere(preset, name, values, V):
    """Also where eigenvalues meet on both sides, so that their number of pairs is that of no value."""
    assert_all_there(Bicycle.preset(preset), name, values, V)


@settings(max_examples=8, deadline=None)
@given(meijaard_machines(), st.sampled_from(["delta", "lam", "sigma"]), st.floats(0.1, 10))
def test_curves_of_random_machines(machine, name, V):
    ends = {"delta": (0, 20), "lam": (0.0, 0.8), "sigma": (0, 0.2)}
    assert_all_there(Bicycle.from_mapping(machine), name, ends[name], V)


def assert_all_there(bicycle, name, values, V):
    curves = modes_against(bicycle, name, list(map(float, values)), V).curves
    for x in np.linspace(values[0], values[-1], 43)[:-1]:
        machine, lam, sigma = varied(bicycle, {name: np.array([x])})
        lam, sigma, _ = np.broadcast_arrays(lam, sigma, np.array([x]))
        (roots,) = _roots(machine, lam, sigma, V)
        here = [curve for curve in curves if curve.x[0] <= x < curve.x[-1]]
        found = [_at(curve, x) for curve in here]
        found += [np.conj(s) for s, curve in zip(found, here, strict=True) if curve.s.imag.max() > 0]
        assert len(found) == 4, (x, [curve.name for curve in here])
        away = abs(np.subtract.outer(roots, found))
        # between two points of a curve that bends sharply, where eigenvalues nearly meet: 0.023 was found
        assert away[linear_sum_assignment(away)].max() < 0.05 * abs(roots).max(), (x, roots, found)


def _at(curve, x):
    """Linear between the points of a curve."""
    return np.interp(x, curve.x, curve.s.real) + 1j * np.interp(x, curve.x, curve.s.imag)


def test_a_curve_goes_on_where_another_passes_it_in_size():
    """From λ = 0.101 to 0.135 there are two pairs, and the slower one becomes the faster one."""
    curves = modes_against(Bicycle.preset("meijaard2007"), "lam", [-0.3, 0.9], 0.5).curves
    two = [curve for curve in curves if curve.x[0] < 0.11 < curve.x[-1]]
    assert [curve.s.imag[16] > 0 for curve in two] == [True, True]
    fast = two[0].s.imag > two[1].s.imag
    assert fast.any()
    assert not fast.all()
    for curve in two:
        assert abs(np.diff(curve.s)).max() < 0.1 < abs(two[0].s - two[1].s).min()


def test_an_eigenvalue_becomes_infinite():
    """Where the mass matrix is singular, at λ = −0.0997, all others are on both sides as they are."""
    curves = modes_against(Bicycle.preset("kooijman2011"), "lam", [-0.3, 0.9], 0.0).curves
    gap = min((curve.x[0] for curve in curves if curve.x[0] > -0.3), key=lambda x: abs(x + 0.0997))
    for x in (gap - 1e-3, gap + 1e-3):
        assert sum(c.x[0] <= x <= c.x[-1] for c in curves) == (4 if x < gap else 3)
    assert max(abs(curve.s).max() for curve in curves) < 1e6
