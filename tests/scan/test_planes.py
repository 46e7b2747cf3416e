"""The sheets of many machines at once are those of each."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import exact_table
from bikestab.routh import CONDITIONS
from bikestab.scan.planes import sheets_of_planes
from bikestab.scan.sheets import Roots, critical_roots, sheets
from bikestab.speeds import Intervals, intervals_of
from tests.scan.test_sheets import DAMPED_LITTLE, MACHINES, cusp, no_intervals, plane
from tests.strategies import machines


def assert_each_as_alone(tables):
    """Of tables (5, 4, λ, σ), one for each machine."""
    table = np.stack(tables, axis=2)
    intervals, roots = intervals_of(table), critical_roots(table)
    for name in CONDITIONS:
        found = sheets_of_planes(name, roots[name], intervals)
        width = 0
        for i in range(len(tables)):
            own = Intervals(*(values[i] for values in intervals.arrays().values()))
            alone = sheets(name, Roots(*(values[i] for values in roots[name])), own)
            slots = alone.V.shape[-1]
            np.testing.assert_array_equal(found.V[i, ..., :slots], alone.V)
            np.testing.assert_array_equal(found.edge[i, ..., :slots], alone.edge)
            assert np.isnan(found.V[i, ..., slots:]).all()
            assert not found.edge[i, ..., slots:].any()
            width = max(width, slots)
        assert found.V.shape[-1] == width


def test_usual_machines():
    """Some have several roots of a direction, and those that lie over themselves are among them."""
    bicycles = [*MACHINES, DAMPED_LITTLE, *(MACHINES[1].with_delta(delta) for delta in (0.01, 0.1, 0.3, 1.0))]
    assert_each_as_alone([plane(bicycle, 13, 1.2, 0.6)[2] for bicycle in bicycles])


def test_what_lies_over_itself_stands_beside_what_does_not():
    folded = cusp(14)
    simple = plane(MACHINES[0], folded.shape[2], 1.2, 0.6)[2][..., : folded.shape[3]]
    assert simple.shape == folded.shape
    assert_each_as_alone([simple, folded, simple])
    assert_each_as_alone([folded])


@settings(max_examples=25, deadline=None, derandomize=True)
@given(some=st.lists(machines, min_size=1, max_size=4))
def test_random_machines(some):
    assert_each_as_alone([plane(Bicycle.from_mapping(machine), 6, 0.9, 0.5)[2] for machine in some])


def test_planes_without_roots_and_axes_in_front():
    nothing = Roots(np.empty((2, 3, 4, 5, 0)), np.ones((2, 3, 4, 5, 1), bool))
    ends = Intervals(*(np.stack([[each] * 3] * 2) for each in no_intervals((4, 5)).arrays().values()))
    assert sheets_of_planes("p1", nothing, ends).V.shape == (2, 3, 4, 5, 0)
    V = np.full((2, 3, 4, 5, 1), np.nan)
    V[1, 2] = 3.0
    found = sheets_of_planes("p1", Roots(V, nothing.rising), ends)
    np.testing.assert_array_equal(found.V, V)


# --- the machines themselves


@pytest.mark.parametrize("name", ["dikarev1981", "meijaard2007", "kooijman2011", "sharp1971"])
def test_tables_of_machines_put_together_are_those_of_each(name):
    """To the last bit, with an entry that cancels identically, or is not there, in some of them alone."""
    bicycle = Bicycle.preset(name)
    key, values = ("mB", (60, 75.5, 100)) if "mB" in bicycle.notation else ("m1", (60, 75.5, 100))
    pairs = [(value, delta) for value in values for delta in (0, 1.5)]
    bicycles = [bicycle.replaced({key: value, "delta": delta}) for value, delta in pairs]
    lam, sigma = np.linspace(-0.2, 0.6, 5), np.linspace(-0.1, 0.2, 5)
    masses, damping = np.array(pairs).T[..., np.newaxis]
    together = Family(bicycle).exact_table(lam, sigma, {key: masses, "delta": damping})
    for i, each in enumerate(bicycles):
        alone = exact_table(each, lam, sigma)
        for whole, own in zip(together, alone, strict=True):
            np.testing.assert_array_equal(whole[:, :, i], own)


def test_a_rider_of_several_masses():
    rider = {"m": 75, "x": 0.35, "z": -1.0, "Ixx": 3.0, "Izz": 1.2, "Ixz": 0.3, "scale_inertia": True}
    own = Bicycle.preset("meijaard2007").given
    bicycle = Bicycle.from_mapping({**own, "mB": 15, "rider": rider})
    bicycles = [bicycle.replaced({"rider.m": m}) for m in (60, 100)]
    together = Family(bicycle).exact_table(0.3, 0.08, {"rider.m": np.array([[60.0], [100.0]])})
    for i, each in enumerate(bicycles):
        np.testing.assert_array_equal(together.value[:, :, i, 0], exact_table(each, 0.3, 0.08).value)
