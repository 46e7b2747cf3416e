"""Head angle, trail and offset in a config are lam and sigma by other names."""

import math

import jsonschema
import pytest
from ruamel.yaml import YAML

from bikestab.config.expectations import outcome_of
from bikestab.config.file import config_schema
from tests.configs import load, message

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")

MEASURED = """\
bicycle: meijaard2007
grid:
  head_angle: {start: 68deg, stop: 74deg, num: 4}
  trail: {values: [0mm, 51mm, 10.2cm]}
  V: {start: 0, stop: 20mph, num: 2}
slices: [{head_angle: 72deg}, {trail: 51mm}, {V: 5}]
expect:
  - {head_angle: 72deg, trail: 80mm, V1: 4.2924, within: 0.001}
  - {offset: 32.0721mm, V1: 4.2924, within: 0.001}
  - {head_angle: 72deg, trail: 80mm, offset: 32.07mm, V2: 6.0243}
"""
SAME = """\
bicycle: meijaard2007
grid:
  lam: {start: 16deg, stop: 22deg, num: 4}
  sigma: {values: [0, 0.05, 0.1]}
  V: {start: 0, stop: 20mph, num: 2}
"""


def test_they_are_lam_and_sigma():
    config, same = load(MEASURED), load(SAME)
    assert config.grid.values("lam") == pytest.approx(same.grid.values("lam"), rel=0, abs=1e-15)
    assert config.grid.values("sigma") == pytest.approx(same.grid.values("sigma"), rel=0, abs=1e-15)
    assert [plane.fixed[0] for plane in config.slices] == ["lam", "sigma", "V"]
    assert config.slices[0].lam == pytest.approx(math.pi / 10, rel=1e-15)
    assert config.slices[1].sigma == pytest.approx(0.05, rel=1e-15)
    assert all(outcome_of(config, expected, ()).holds for expected in config.expect)


def test_an_end_without_a_unit_takes_that_of_the_other():
    bare = MEASURED.replace("start: 68deg", "start: 68").replace("[0mm, 51mm, 10.2cm]", "[0, 0.051, 102mm]")
    config = load(bare + "ensemble: {mB: {normal: [85kg, 3000g]}, c: {uniform: [0.07, 90mm]}, samples: 2}\n")
    assert config.grid.values("lam") == pytest.approx(load(SAME).grid.values("lam"), rel=0, abs=1e-15)
    assert config.grid.values("sigma") == pytest.approx([0, 0.05, 0.1], rel=0, abs=1e-15)
    assert config.ensemble.parameters["c"].uniform == (0.07, 0.09)
    family = "bicycle: meijaard2007\ngrid:\n  x: {name: mB, start: 60, stop: 110000g, num: 3}\n"
    family += "  y: {name: offset, start: 10, stop: 80mm, num: 3}\n  V: {start: 18, stop: 36km/h, num: 3}\n"
    grid = load(family).grid
    assert grid.x.points[0] == pytest.approx(0.06)
    assert (grid.y.points[0], grid.V.start) == (pytest.approx(0.01), 5)


def test_the_schema_knows_them():
    validator = jsonschema.Draft202012Validator(config_schema())
    validator.validate(YAML(typ="safe").load(MEASURED))
    both = MEASURED.replace("  V: {start", "  sigma: {start: 0, stop: 1, num: 2}\n  V: {start")
    assert not validator.is_valid(YAML(typ="safe").load(both))


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (
            "start: 68deg",
            "start: 68mm",
            "line 3: grid.head_angle.start: '68mm' is not a number",
        ),
        (
            "start: 68deg, stop: 74deg",
            "start: 68, stop: 74",
            "line 3: grid.head_angle.start: a head angle of 68 rad",
        ),
        ("51mm, 10.2cm", "51mm, 1O cm", "line 4: grid.trail.values[2]: '1O cm' is not a number"),
        ("  trail:", "  sigma: {values: [0, 1]}\n  trail:", "line 5: grid.trail: sigma is given as well"),
        ("  trail:", "  offset:", "line 4: grid.offset: the grid has tilt and trail"),
        ("{trail: 51mm}", "{trail: 51kg}", "line 6: slices[1].trail: '51kg' is not a number: it is a mass"),
        ("{trail: 51mm}", "{offset: 51mm}", "line 6: slices[1].offset: a slice fixes one axis"),
        ("{trail: 51mm}", "{trail: 51mm, V: 1}", "line 6: slices[1]: a slice fixes one axis"),
        (
            "offset: 32.07mm",
            "offset: 45mm",
            "line 10: expect[2].offset: a head angle of 72° and",
        ),
        ("slices:", "sweep: {w: [1, 1.1]}\nslices:", "line 4: grid.trail: the sweep has the wheelbase, w"),
        (
            "slices:",
            "sweep: {head_angle: [1, 1.1]}\nslices:",
            "line 6: sweep.head_angle: the grid has",
        ),
        ("  trail:", "  trial:", "line 4: grid.trial: unknown key\ndid you mean 'trail'?"),
    ],
)
def test_mistakes_are_told_with_their_place(old, new, told):
    assert message(MEASURED.replace(old, new, 1)).startswith(f"scan.yaml, {told}")
