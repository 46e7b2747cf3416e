"""Where motion at one speed is stable as a parameter varies: the ends are exact."""

import numpy as np
import pytest

from bikestab.against import modes_against, stable_ranges
from bikestab.bicycle import Bicycle
from bikestab.model import exact_table
from bikestab.speeds import intervals_of
from bikestab.variants import varied

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
