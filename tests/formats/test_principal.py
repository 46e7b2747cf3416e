"""Principal axes, held against BicycleParameters' own conversion."""

import json

import pytest
from bicycleparameters.conversions import _convert_principal_to_benchmark
from bicycleparameters.parameter_dicts import moore2019_browser_jason
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.formats.principal import IGNORED, PRINCIPAL

EXTRAS = {"v": 3.0, "yD": 0.0, "yP": 0.0, "yH": 0.0, "lP": 1.7, "wP": 0.5}


def load(values, folder):
    path = folder / "p.yml"
    path.write_text(json.dumps({"parameterization": "Moore2019", "values": values}), "utf-8")
    return Bicycle.load(str(path))


def same(found, expected):
    """To rounding of sums about the ground."""
    other = Bicycle.from_mapping({k: float(v) for k, v in expected.items() if k in found.notation})
    for name, value in other.numbers().items():
        assert getattr(found, name) == pytest.approx(value, rel=1e-12, abs=1e-13), name


def test_the_packages_own_set(tmp_path):
    values = dict(moore2019_browser_jason)
    found = load(values, tmp_path)
    same(found, _convert_principal_to_benchmark({**EXTRAS, **values}))
    assert found.given["rider.m"] == values["mP"]
    assert "not in the equations, left out: v" in found.notes[0]


def test_uncertainties_that_are_lost_are_told(tmp_path):
    values = dict(moore2019_browser_jason)
    found = load(values | {key: f"{values[key]} +/- 0.001" for key in ("w", "kDaa", "mP")}, tmp_path)
    assert found.deviations == {"w": 0.001}
    assert found.notes[-1] == "not carried to other axes, left out: the uncertainties of kDaa, mP"


@settings(deadline=None, max_examples=30, derandomize=True)
@given(st.lists(st.floats(0.05, 1.0), min_size=len(PRINCIPAL), max_size=len(PRINCIPAL)))
def test_any_set(tmp_path_factory, numbers):
    values = dict(zip(PRINCIPAL, numbers, strict=True))
    values |= {key: -value for key, value in values.items() if key[0] == "z"}
    theirs = _convert_principal_to_benchmark({**EXTRAS, **values})
    same(load({**values, "v": 1.0}, tmp_path_factory.getbasetemp()), theirs)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"kDaa": None}, "missing parameter: kDaa"),
        ({"alphaDD": 1.0}, "values.alphaDD: unknown parameter\ndid you mean 'alphaD'?"),
        ({"kRbb": 0.9}, "values.kRbb: 0.9 is not what the others say, kRaa"),
        ({"mD": "heavy"}, "values.mD: 'heavy' is not a number"),
    ],
)
def test_refused(tmp_path, change, message):
    values = {k: v for k, v in {**moore2019_browser_jason, **change}.items() if v is not None}
    with pytest.raises(InputError) as caught:
        load(values, tmp_path)
    assert message in str(caught.value)
    assert not IGNORED & PRINCIPAL.keys()
