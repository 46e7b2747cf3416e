"""What a config can say, and its JSON Schema."""

import json
import math
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from ruamel.yaml import YAML

from bikestab.bicycle import Bicycle
from bikestab.config.file import config_schema, load_config
from bikestab.presets import preset_text
from tests.configs import GOOD, GRID_V, IN_PLACE, change, load, message

CONFIGS = sorted(Path(__file__).parents[2].joinpath("configs").glob("*.yaml"))


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("path", CONFIGS, ids=lambda p: p.stem)
def test_the_configs_that_people_copy_are_good(path):
    config = load_config(path)
    assert config.text == path.read_text("utf-8")
    assert config.output == f"out/{path.stem}"


def test_defaults():
    config = load(GOOD)
    assert config.model == "refined"
    assert config.fields == ["stable", "violated", "growth_rate"]
    assert (config.slices, config.expect, config.title, config.output) == ([], [], "", "out/scan")
    assert config.machine == Bicycle.preset("dikarev1981")


def test_a_range_has_both_ends():
    grid = load(GOOD).grid
    assert grid.shape == (4, 5, 6)
    np.testing.assert_array_equal(grid.values("V"), [0, 2, 4, 6, 8, 10])
    assert grid.ends("lam") == (0.0, 0.3)


def test_values_of_ones_own():
    grid = load(GOOD, "grid.V={values: [0.5m/s, 18km/h, 20m/s]}").grid
    np.testing.assert_array_equal(grid.values("V"), [0.5, 5, 20])
    assert grid.shape == (4, 5, 3)
    assert grid.ends("V") == (0.5, 20)


def test_units():
    config = load(GOOD, "grid.lam.stop=18deg", "grid.V.stop=36km/h", "slices=[{lam: 9deg}, {V: 18km/h}]")
    assert config.grid.ends("lam")[1] == pytest.approx(math.pi / 10, rel=1e-15)
    assert config.grid.ends("V")[1] == pytest.approx(10, rel=1e-15)
    assert [plane.fixed for plane in config.slices] == [("lam", pytest.approx(math.pi / 20)), ("V", 5.0)]


def test_in_place_in_the_papers_notation():
    assert load(IN_PLACE).machine.numbers() == Bicycle.preset("dikarev1981").numbers()
    assert load(IN_PLACE).machine.name == "mine"


def test_in_place_in_the_notation_of_meijaard():
    indented = "".join(f"  {line}\n" for line in preset_text("meijaard2007").splitlines())
    config = load("bicycle:\n" + indented + GOOD.split("\n", 1)[1])
    assert config.machine == Bicycle.preset("meijaard2007")


def test_delta_replaces_the_bicycles_own():
    assert load(GOOD + "delta: 2.5\n").machine.delta == 2.5
    assert load(IN_PLACE, "bicycle.delta=3").machine.delta == 3
    assert load(IN_PLACE, "bicycle.delta=3", "delta=0").machine.delta == 0


def test_expectations():
    config = load(
        GOOD + "expect:\n"
        "  - {lam: 18deg, sigma: 0.1, V1: 18km/h, V2: unbounded, within: 0.01}\n"
        "  - {stable: never}\n"
    )
    first, second = config.expect
    assert first.lam == pytest.approx(math.pi / 10)
    assert (first.sigma, first.V1, first.V2, first.within) == (0.1, 5, math.inf, 0.01)
    assert (second.stable, second.V1, second.V2, second.within) == ("never", None, None, 0.001)


# --- the schema

plain_yaml = YAML(typ="safe", pure=True)


def valid(text):
    return jsonschema.Draft202012Validator(config_schema()).is_valid(plain_yaml.load(text))


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(config_schema())
    json.dumps(config_schema(), allow_nan=False)


@pytest.mark.parametrize("path", CONFIGS, ids=lambda p: p.stem)
def test_the_configs_fit_the_schema(path):
    jsonschema.Draft202012Validator(config_schema()).validate(plain_yaml.load(path.read_text("utf-8")))


@pytest.mark.parametrize(
    "text",
    [
        GOOD,
        IN_PLACE,
        change("stop: 0.3", "stop: 18deg"),
        change("stop: 10", "stop: 20 km/h"),
        change(GRID_V, "{values: [1, 2, 18km/h]}"),
        GOOD + "delta: 1\nfields: [conditions]\nslices: [{V: 5}]\n",
        GOOD + "expect: [{V1: 3, V2: unbounded}, {lam: 9deg, sigma: 0, stable: never}]\n",
    ],
)
def test_what_loads_fits_the_schema(text):
    load(text)
    assert valid(text)


@pytest.mark.parametrize(
    "text",
    [
        GOOD + "titel: x\n",
        GOOD + "model: refind\n",
        GOOD + "fields: []\n",
        GOOD + "fields: [stabel]\n",
        GOOD + "output: ''\n",
        GOOD + "delta: damped\n",
        GOOD + "slices: {lam: 0.2}\n",
        GOOD + "slices: [{lamb: 0.2}]\n",
        GOOD + "expect: [{V1: fast}]\n",
        GOOD + "expect: [{stable: always}]\n",
        change("grid:", "gird:"),
        change("num: 4", "num: 1"),
        change("num: 4", "num: 3.5"),
        change("num: 4", "nun: 4"),
        change("stop: 0.3", "stop: 20km/h"),
        change("stop: 0.3", "stop: wide"),
        change("stop: 10", "stop: 18deg"),
        change(GRID_V, "{values: []}"),
        change(GRID_V, "{values: 1}"),
        change("bicycle: dikarev1981\n", ""),
        change("dikarev1981", "3"),
        IN_PLACE.replace("m2: 2.7", "mm2: 2.7"),
    ],
)
def test_what_the_schema_refuses_does_not_load(text):
    assert not valid(text)
    message(text)


def test_the_schemas_names_are_words():
    assert all(name.isalpha() for name in config_schema()["$defs"])


def test_an_axis_may_have_one_value():
    grid = load(GOOD, "grid.V={values: [5]}").grid
    assert (grid.shape[2], grid.ends("V")) == (1, (5.0, 5.0))
