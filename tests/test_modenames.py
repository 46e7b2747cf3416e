"""One name for one motion: what crosses at an end of the stable speeds bears the name of that end."""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.modenames import NAMES, OSCILLATING
from bikestab.modes import follow
from bikestab.speeds import KINDS, intervals_of
from tests.references.count_names import count, tables
from tests.test_modes import product, table_of_preset


def test_edges_and_modes_have_the_same_names():
    """Of 3 000 random machines none disagrees (python -m tests.references.count_names 3000); here are 200."""
    names = count(200)
    assert sum(names.values()) > 150
    assert {name for _, edge, name in names if name != edge} == set()
    assert {edge for _, edge, _ in names} == {"weave", "capsize"}


@pytest.mark.parametrize("seed", range(15))
def test_a_name_belongs_to_one_motion_at_each_speed(seed):
    """Weave, weave 2 and pair 2 oscillate, the others do not; weave is one pair, capsize one eigenvalue."""
    ((_, table),) = tables(1, seed)
    modes = follow(table, np.linspace(0, 60, 601))
    apart = np.abs(modes.coalescences[:, np.newaxis] - modes.V).min(axis=0, initial=np.inf) > 1e-6
    complex_ = np.isin(modes.names, OSCILLATING)
    assert np.array_equal(complex_[:, apart], modes.eigenvalues.imag[:, apart] != 0)
    assert set(modes.names.flat) <= set(NAMES)
    for name, most in (("weave", 2), ("weave 2", 2), ("capsize", 1), ("capsize 2", 1), ("castering", 1)):
        number = np.count_nonzero(modes.names == name, axis=0)
        assert set(number) <= {0, most}
    assert np.all(np.count_nonzero(modes.names == "real pair", axis=0) != 1)


@pytest.mark.parametrize("seed", range(15))
def test_a_motion_is_renamed_only_where_two_meet(seed):
    ((_, table),) = tables(1, seed)
    V = np.linspace(0.01, 60, 1201)
    modes = follow(table, V)
    for name in modes.names:
        for i in np.flatnonzero(name[1:] != name[:-1]):
            assert np.any((modes.coalescences > V[i]) & (modes.coalescences <= V[i + 1]))


def test_weave_of_a_pair_of_capsize_and_castering():
    """(s + 1)² = −1 and s² − (1 − V) s + V: the slow pair crosses at V = 1, beside one of high speeds."""
    table = product(([4], [104]), ([-1, 1], [3, 1]))
    modes = follow(table, [0.9, 1.0, 1.1, 3.0, 50.0])
    assert modes.names[0].tolist() == ["weave 2", "weave 2", "weave 2", "weave 2", "weave"]
    assert modes.names[2].tolist() == ["weave", "weave", "weave", "weave", "capsize"]
    assert modes.below == (("weave 2", "weave 2", "weave", "weave"),)
    assert modes.above == (("weave", "weave", "capsize", "castering"),)


def test_two_pairs_that_both_make_an_edge():
    """One begins to decay at V = 1, the other to grow at 5: both are weave, and told apart by a 2."""
    table = product(([-0.1, 0.1], [4]), ([0.5, -0.1], [25]))
    intervals = intervals_of(table)
    assert [KINDS[k] for k in (intervals.lower[0], intervals.upper[0])] == ["weave", "weave"]
    assert (intervals.V1[0], intervals.V2[0]) == pytest.approx((1, 5))
    names = follow(table, [0.5, 1.0, 3.0, 5.0]).names
    assert names[:, 0].tolist() == ["weave 2", "weave 2", "weave", "weave"]
    assert np.all(names == names[:, :1])


def test_capsize_that_comes_of_weave():
    """Weave splits at V = 2 into two real eigenvalues, one of which crosses zero at 3."""
    table = product(([2], [3, -1]), ([24], [80]))  # (s + 1)² = V − 2, and −4, −20
    modes = follow(table, [1.0, 2.5, 3.0, 4.0])
    assert modes.names[0].tolist() == ["weave", "capsize", "capsize", "capsize"]
    assert modes.names[1].tolist() == ["weave", "real", "real", "real"]
    assert modes.names[2].tolist() == ["capsize", "capsize 2", "capsize 2", "capsize 2"]
    assert modes.names[3].tolist() == ["castering"] * 4


@pytest.mark.parametrize(
    ("preset", "delta"), [("meijaard2007", 0), ("kooijman2011", 0), ("sharp1971", 0), ("sharp1971", 6.77909)]
)
def test_the_literatures_own_cases_keep_their_names(preset, delta):
    table = table_of_preset(preset, delta=delta)
    modes = follow(table, np.linspace(1, 40, 40))
    assert modes.names[:, 0].tolist() == ["weave", "weave", "capsize", "castering"]
    assert np.all(modes.names == modes.names[:, :1])


def test_a_table_without_any_edge():
    bicycle = Bicycle.preset("dikarev1981")
    modes = follow(characteristic_table(bicycle, 0.1, 0.08), [0.1, 20.0])
    assert modes.names[:, 1].tolist() == ["weave", "weave", "capsize", "castering"]
