"""Several mistakes in one file: all that can be known at once are told at once."""

from pathlib import Path

import pytest

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.checks import checked
from bikestab.config.file import load_config, parse_config
from bikestab.errors import InputError

GRID = "grid: {lam: {values: [0, 0.3]}, sigma: {values: [0, 0.1]}, V: {values: [1, 9]}}\n"
MANY = """\
titel: many mistakes
bicycle: meijard2007
model: refind
grid:
  head_angle: {start: 68deg, stop: 74mm, num: 4}
  sigma: {start: 0, stop: much, num: many}
  V: {values: [3, 2, 1]}
sweep: {mB: [80kg, 90s], zB: [1kg]}
slices: [{lamb: 3}, {V: -5}, {V: 2}]
expect: [{V1: 4, V2: 1kg}, {within: 1%}, {lam: 95deg, V1: 3}]
"""


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def told(text, overrides=()):
    with pytest.raises(InputError) as caught:
        parse_config(yamltext.parse(text, "a.yaml"), overrides)
    return [
        (each.place.removeprefix("a.yaml, "), each.key, each.hint, each.problem)
        for each in caught.value.mistakes
    ]


def test_every_part_of_a_config():
    found = told(MANY)
    assert [each[:2] for each in found] == [
        ("line 1", ("titel",)),
        ("line 2", ("bicycle",)),
        ("line 3", ("model",)),
        ("line 5", ("grid", "head_angle", "stop")),
        ("line 6", ("grid", "sigma", "stop")),
        ("line 6", ("grid", "sigma", "num")),
        ("line 7", ("grid", "V")),
        ("line 8", ("sweep", "mB", 1)),
        ("line 8", ("sweep", "zB", 0)),
        ("line 9", ("slices", 0, "lamb")),
        ("line 9", ("slices", 1, "V")),
        ("line 10", ("expect", 0, "V2")),
        ("line 10", ("expect", 1)),
        ("line 10", ("expect", 2, "lam")),
    ]
    assert found[0][2] == "did you mean 'title'?"
    assert found[1][2].startswith("did you mean 'meijaard2007'?")


@pytest.mark.parametrize(
    ("text", "keys"),
    [
        # what a misspelt key is likely to be is not missing as well
        ("bicycle: dikarev1981\n" + GRID.replace("grid", "gird"), [("gird",)]),
        ("bicycle: dikarev1981\n" + GRID.replace("sigma", "trial"), [("grid", "trial")]),
        ("bicycle: dikarev1981\n" + GRID.replace("lam", "head_angel"), [("grid", "head_angel")]),
        ("bicycle: dikarev1981\nfoo: 3\n", [("grid",), ("foo",)]),
        # planes of the grid, which can be looked at only when all else is well
        (
            "bicycle: dikarev1981\n" + GRID + "slices: [{V: 55}, {lam: 0.1}, {sigma: 3}]\n",
            [("slices", 0, "V"), ("slices", 2, "sigma")],
        ),
        # of another bicycle, an offset or a trail would be in range
        ("bicycle: none\nexpect: [{trail: 60mm, V1: 4}]\n" + GRID, [("bicycle",)]),
        (
            "bicycle: none\nensemble: {covariance: no.csv, samples: 9, mB: {normal: [80, 1]}}\n" + GRID,
            [("bicycle",)],
        ),
        ("bicycle: none\nsweep: {m1: [1, 2], mB: [1, 2]}\n" + GRID, [("bicycle",)]),
        (
            "bicycle: dikarev1981\nensemble: {samples: 9, m11: 3, sed: 4, m1: {normal: [80, 1]}}\n" + GRID,
            [("ensemble", "m11"), ("ensemble", "sed")],
        ),
    ],
)  # fmt: skip
def test_nothing_is_told_that_follows_from_another_mistake(text, keys):
    assert [each[1] for each in told(text)] == keys


def test_options_and_lines_are_told_apart():
    found = told("bicycle: dikarev1981\nmodle: 3\n" + GRID, ["grid.lam.num=3", "grid.V.values=[a, b]"])
    assert [each[0] for each in found] == [
        "line 2", "--set grid.lam.num=3", *["--set grid.V.values=[a, b]"] * 2,
    ]  # fmt: skip


def test_a_bicycles_file_and_the_config_that_names_it():
    Path("bike.yaml").write_text("w: 1.02\nc: 80kg\nmB: heavy\nzBB: 3\n", "utf-8")
    Path("a.yaml").write_text("bicycle: bike.yaml\nmodle: 3\n" + GRID, "utf-8")
    with pytest.raises(InputError) as caught:
        load_config("a.yaml")
    places = [each.place for each in caught.value.mistakes]
    assert places == ["bike.yaml, line 2", "bike.yaml, line 3", "bike.yaml, line 4", "a.yaml, line 2"]
    hints = [each.hint for each in caught.value.mistakes]
    assert [hint.endswith("named in a.yaml, line 1") for hint in hints] == [True, True, True, False]
    Path("b.yaml").write_text("bicycle: none.txt\nexpect: [{V1: 4}]\n", "utf-8")
    with pytest.raises(InputError, match=r"named in b\.yaml, line 1"):
        checked("b.yaml")


def test_an_expectation_of_no_design_has_its_line():
    Path("a.yaml").write_text("bicycle: dikarev1981\nexpect:\n  - {lam: 0.1, V1: 4}\n", "utf-8")
    _, [(line, error)] = checked("a.yaml")
    assert line == 3
    assert str(error).startswith("a.yaml, line 3: expect[0]: ")


@pytest.mark.parametrize(
    ("bicycle", "changes", "keys"),
    [
        ("dikarev1981", {"m1": -3, "C1": -1, "lam": 9, "sigma": 1e5}, {"m1", "C1", "lam", "sigma"}),
        ("meijaard2007", {"mB": -3, "IBxx": -1, "rR": -0.3, "lam": 9}, {"mB", "IBxx", "rR", "lam"}),
        ("meijaard2007", {"mB": "heavy", "foo": 1, "c": "3kg"}, {"mB", "foo", "c"}),
    ],
)
def test_a_bicycle(bicycle, changes, keys):
    with pytest.raises(InputError) as caught:
        Bicycle.from_mapping({**Bicycle.preset(bicycle).given, **changes})
    assert {each.key[0] for each in caught.value.mistakes} == keys


def test_files_of_other_programs_have_their_lines():
    text = "".join(f"{key} = {value}\n" for key, value in Bicycle.preset("meijaard2007").given.items())
    lines = [line.partition(" ")[0] for line in text.splitlines()]
    Path("b.txt").write_text(text.replace("mB = 85", "mB = -85").replace("rR = 0.3", "rR = -0.3"), "utf-8")
    with pytest.raises(InputError) as caught:
        Bicycle.load("b.txt")
    assert {(each.key[0], each.place) for each in caught.value.mistakes} == {
        (key, f"b.txt, line {lines.index(key) + 1}") for key in ("mB", "rR")
    }
