"""Every preset's eigenvalues in 40 digits; tests/references/generate_eigenvalues.py made the file.

The stable speeds in 40 digits are in tests/references/speeds.json and tested in tests/test_speeds.py.
"""

import json

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.presets import preset_names
from bikestab.spectrum import eigenvalues_of, growth_rate_of
from tests.references import generate_eigenvalues as reference

CASES = json.loads(reference.FILE.read_text("utf-8"))
# In units of the largest eigenvalue: ε times some ten operations, times the condition of an eigenvalue. The
# nearest two are 1 % of the largest apart, save the slow ones of the two-mass-skate bicycle far up; but 5e-15
# is the most that occurs.
TOLERANCE = 2e-14


def test_every_preset_is_there():
    assert {case["name"] for case in CASES} == set(preset_names())


@pytest.mark.parametrize("name", reference.DESIGNS)
def test_machines_are_the_presets(name):
    """The script repeats the presets' numbers, so that it uses nothing of bikestab."""
    machine = Bicycle.from_mapping(reference.DESIGNS[name][0]).numbers()
    preset = Bicycle.preset(name).numbers()
    own = {"lam", "sigma", "delta"}  # the cases have their own
    assert {key: machine[key] for key in machine if key not in own} == {
        key: preset[key] for key in preset if key not in own
    }


@pytest.mark.parametrize(
    "case", CASES, ids=lambda c: f"{c['name']} {c['lam']:g} {c['sigma']:g} {c['delta']:g}"
)
def test_eigenvalues(case):
    bicycle = Bicycle.preset(case["name"]).with_delta(case["delta"])
    table = characteristic_table(bicycle, case["lam"], case["sigma"])[..., np.newaxis]
    V = np.array(reference.V, float)
    exact = np.array(case["eigenvalues"], float) @ [1, 1j]
    size = np.abs(exact).max(axis=1)
    distance = np.abs(eigenvalues_of(table, V).T[:, :, np.newaxis] - exact[:, np.newaxis])
    assert np.all(distance.min(axis=1).max(axis=-1) <= TOLERANCE * size)
    assert np.all(distance.min(axis=2).max(axis=-1) <= TOLERANCE * size)
    assert np.all(np.abs(growth_rate_of(table, V) - exact.real.max(axis=1)) <= TOLERANCE * size)


@pytest.mark.parametrize("index", [1, 6, 7, 9])
def test_file_is_what_the_script_writes(index):
    case = dict(CASES[index])
    expected = case.pop("eigenvalues")
    assert case == reference.cases()[index]
    assert reference.result(**case) == expected
