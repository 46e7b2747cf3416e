"""Stable speeds in closed form, against those with bounds."""

import numpy as np
import pytest
from hypothesis import given, settings

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.speeds import intervals_of
from bikestab.undamped import _closed_form, stable_speeds
from tests.strategies import machines

X, Y = np.meshgrid(np.linspace(-0.2, 0.6, 60), np.linspace(-0.3, 0.5, 50), indexing="ij")


def compared(table):
    found, exact = stable_speeds(table), intervals_of(table)
    assert np.array_equal(found.lower, exact.lower)
    assert np.array_equal(found.upper, exact.upper)
    for V, reference in ((found.V1, exact.V1), (found.V2, exact.V2)):
        assert np.array_equal(np.isnan(V), np.isnan(reference))
        np.testing.assert_allclose(V, reference, rtol=1e-9, atol=0)


@pytest.mark.parametrize("name", ["dikarev1981", "meijaard2007", "kooijman2011", "sharp1971"])
def test_presets(name):
    bicycle = Bicycle.preset(name)
    table = characteristic_table(bicycle.with_delta(0.0), X, Y)
    compared(table)
    sure = _closed_form(table.reshape(5, 4, -1))[1]
    assert sure.mean() > 0.95 or name == "kooijman2011"
    compared(characteristic_table(bicycle.with_delta(1.0), X[::9, ::9], Y[::9, ::9]))
    compared(characteristic_table(bicycle, 0.2, 0.08))


def test_on_both_sides_of_every_curve():
    """Designs within 1e-3 … 1e-13 of where speeds meet, leave to infinity or to rest."""
    bicycle = Bicycle.preset("dikarev1981")
    lam, table = np.linspace(0.0, 0.3, 40), None
    for _ in range(12):
        table = characteristic_table(bicycle, lam, 0.15)
        compared(table)
        change = np.flatnonzero(np.diff(stable_speeds(table).upper.astype(int).sum(axis=-1)))
        ends = lam[change], lam[change + 1]
        lam = np.unique(np.concatenate([np.linspace(*ends, 9).ravel(), lam[[0, -1]]]))


@settings(max_examples=40)
@given(machines)
def test_random_machines(numbers):
    compared(
        characteristic_table(Bicycle.from_mapping(numbers).with_delta(0.0), X[::12, ::12], Y[::12, ::12])
    )


def test_nothing_and_odd_numbers():
    assert stable_speeds(np.zeros((5, 4, 0))).V1.shape == (0, 1)
    compared(np.zeros((5, 4, 3)))
    random = np.random.default_rng(14)
    table = np.zeros((5, 4, 3000))
    for key in ((0, 0), (0, 2), (1, 1), (1, 3), (2, 0), (2, 2), (3, 1), (4, 0)):
        table[key] = random.choice([-2.0, -1.0, 0.0, 1.0, 3.0], 3000)
    compared(table)
