"""How a config is read: overrides, and one message for each mistake."""

from pathlib import Path

import pytest

from bikestab.config.file import load_config
from bikestab.errors import InputError
from bikestab.presets import preset_text
from tests.configs import GOOD, GRID_V, IN_PLACE, PAPER, change, load, message


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_a_bicycle_beside_the_config_wins_over_the_current_folder():
    for folder, mass in (("here", 80), ("there", 81)):
        Path(folder).mkdir()
        text = preset_text("dikarev1981").replace("m1: 80", f"m1: {mass}")
        Path(folder, "mine.yaml").write_text(text, "utf-8")
    Path("mine.yaml").write_text(preset_text("dikarev1981"), "utf-8")
    Path("there/scan.yaml").write_text(GOOD.replace("dikarev1981", "mine.yaml"))
    Path("scan.yaml").write_text(GOOD.replace("dikarev1981", "here/mine.yaml"))
    assert load_config("there/scan.yaml").machine.m1 == 81
    assert load_config("scan.yaml").machine.m1 == 80


def test_yaml_of_other_editors():
    assert load("\ufeff" + GOOD).grid == load(GOOD).grid
    assert load(GOOD.replace("\n", "\r\n")).grid == load(GOOD).grid
    merged = GOOD.replace("lam: {", "lam: &a {").replace(
        "{start: 0, stop: 0.15, num: 5}", "{<<: *a, stop: 1}"
    )
    assert load(merged).grid.shape == (4, 4, 6)


# --- overrides


def test_overrides_are_part_of_the_text():
    plain, changed = load(GOOD), load(GOOD, "grid.V.num=61", "output=out/fine", "slices=[{lam: 0.2}]")
    assert changed.grid.shape == (4, 5, 61)
    assert changed.output == "out/fine"
    assert changed.slices[0].fixed == ("lam", 0.2)
    assert changed.sha256 != plain.sha256 == load(GOOD, "output=out/fine").sha256
    Path("again.yaml").write_text(changed.text)
    assert load_config("again.yaml").sha256 == changed.sha256


def test_overrides_reach_into_lists():
    text = GOOD + "slices: [{lam: 0.1}, {V: 5}]\n"
    assert load(text, "slices.1.V=6").slices[1].fixed == ("V", 6)
    assert load(text, "fields=[stable]").fields == ["stable"]


@pytest.mark.parametrize(
    ("override", "expected"),
    [
        ("grid.lam.nun=4", "--set grid.lam.nun=4: grid.lam.nun: unknown key\ndid you mean 'num'?"),
        ("gird.lam.num=4", "--set gird.lam.num=4: gird: unknown key\ndid you mean 'grid'?"),
        ("grid.lam.num=1", "--set grid.lam.num=1: grid.lam.num: 1 is not "),
        ("bicycle=dikarev", "--set bicycle=dikarev: bicycle: there is no bicycle 'dikarev'\ndid you mean "),
        ("bicycle.m1=4", "--set bicycle.m1=4: bicycle has no keys"),
        ("grid.lam.num.x=3", "--set grid.lam.num.x=3: grid.lam.num has no keys"),
        ("slices.0.lam=9", "--set slices.0.lam=9: slices[0].lam: a steering axis tilted by 9 rad"),
        ("slices.0.lam=0.4", "--set slices.0.lam=0.4: slices[0].lam: 0.4 is outside the grid"),
        ("slices.1.lam=0.2", "--set slices.1.lam=0.2: slices has no item 1"),
        ("slices.a.lam=0.2", "--set slices.a.lam=0.2: slices has no item a"),
        ("title=", "--set title=: title: nothing is not text"),
        ("title=a: b", "--set title=a: b, line 1, column 9: not valid YAML: "),
        ("grid.lam=[1, 2", "--set grid.lam=[1, 2, line 1: not valid YAML: "),
        ("grid.lam.num", "--set: 'grid.lam.num' is not key=value"),
        ("=3", "--set: '=3' is not key=value"),
        ("grid..num=3", "--set: 'grid..num=3' is not key=value"),
    ],
)
def test_a_bad_override_is_quoted(override, expected):
    assert message(GOOD + "slices: [{lam: 0.1}]\n", override).startswith(expected)


def test_a_mistake_in_the_file_is_not_blamed_on_an_override():
    assert message(GOOD + "titel: x\n", "grid.lam.num=3").startswith("scan.yaml, line 6: titel: unknown key")


# --- mistakes: file, line, key path, value, what is allowed


@pytest.mark.parametrize(
    ("text", "line", "problem", "hint"),
    [
        # keys
        (GOOD + "titel: x\n", 6, "titel: unknown key", "did you mean 'title'?"),
        (GOOD + "xyzzy: x\n", 6, "xyzzy: unknown key", "known: title, bicycle, model, delta, grid"),
        (GOOD + "3: x\n", 6, "3: unknown key", "known: title"),
        (change("grid:", "gird:"), 2, "gird: unknown key", "did you mean 'grid'?"),
        (change("num: 4", "nun: 4"), 3, "grid.lam.nun: unknown key", "did you mean 'num'?"),
        (change("sigma:", "Sigma:"), 4, "grid.Sigma: unknown key", "did you mean 'sigma'?"),
        (change(GRID_V, "{values: [1, 2], num: 2}"), 5, "grid.V.num: unknown key", "known: values"),
        (GOOD + "slices: [{lamb: 1}]\n", 6, "slices[0].lamb: unknown key", "did you mean 'lam'?"),
        (GOOD + "expect: [{v1: 3}]\n", 6, "expect[0].v1: unknown key", "did you mean 'V1'?"),
        # missing
        (change("bicycle: dikarev1981\n", ""), 1, "bicycle: missing", ""),
        (change("  V: " + GRID_V + "\n", ""), 2, "grid.V: missing", "needed here: lam, sigma, V"),
        (change(", num: 6", ""), 5, "grid.V.num: missing", ""),
        # numbers
        (change("stop: 10", "stop: .nan"), 5, "grid.V.stop: nan is not finite", "allowed: a number"),
        (change("stop: 10", "stop: .inf"), 5, "grid.V.stop: inf is not finite", "allowed: a number"),
        (change("stop: 10", "stop: fast"), 5, "grid.V.stop: 'fast' is not a number", "(m/s, km/h, mph, kn)"),
        (change("stop: 10", "stop: true"), 5, "grid.V.stop: True is not a number", "allowed: a number"),
        (change("stop: 10", "stop: 18deg"), 5, "grid.V.stop: '18deg' is not a number", "(m/s, km/h, mph"),
        (change("stop: 10", "stop: ~"), 5, "grid.V.stop: nothing is not a number", "allowed: a number"),
        (change("stop: 10", "stop: [1]"), 5, "grid.V.stop: [1] is not a number", "allowed: a number"),
        (change("start: 0, stop: 10", "start: -1, stop: 10"), 5, "grid.V.start: -1 is a speed backwards",
         "allowed: 0 ..."),
        (change("stop: 0.3", "stop: 90deg"), 3, "grid.lam.stop: a steering axis tilted by 1.5708 rad",
         "allowed: between -90deg and 90deg"),
        (change("stop: 0.3", "stop: 18"), 3, "grid.lam.stop: a steering axis tilted by 18 rad", "18deg"),
        (change("stop: 0.15", "stop: 0.15m"), 4, "grid.sigma.stop: '0.15m' is not a number", "a number"),
        # ranges and values
        (change("stop: 10", "stop: 0"), 5, "grid.V: stop = 0.0 is not above start = 0.0", "start < stop"),
        (change("start: 0, stop: 0.3", "start: 1, stop: 0.3"), 3, "grid.lam: stop = 0.3 is not above", "<"),
        (change("num: 6", "num: 0"), 5, "grid.V.num: 0 is not", "2"),
        (change("num: 6", "num: 1"), 5, "grid.V.num: 1 is not", "2"),
        (change("num: 6", "num: -3"), 5, "grid.V.num: -3 is not", "2"),
        (change("num: 6", "num: 3.5"), 5, "grid.V.num: 3.5 is not a whole number", "whole number"),
        (change("num: 6", "num: six"), 5, "grid.V.num: 'six' is not a whole number", "whole number"),
        (change("num: 6", "num: true"), 5, "grid.V.num: True is not a whole number", "whole number"),
        (change("num: 6", "num: ~"), 5, "grid.V.num: nothing is not a whole number", "whole number"),
        (change(GRID_V, "{values: [1, 3, 2]}"), 5, "grid.V: 2.0 does not come after 3.0", "increase"),
        (change(GRID_V, "{values: [1, 1]}"), 5, "grid.V: 1.0 does not come after 1.0", "increase"),
        (change(GRID_V, "{values: []}"), 5, "grid.V.values: [] is not", "at least 1"),
        (change(GRID_V, "{values: 3}"), 5, "grid.V.values: 3 is not a list", "a list"),
        (change(GRID_V, "{values: [1, fast]}"), 5, "grid.V.values[1]: 'fast' is not a number", "a number"),
        (change(GRID_V, "5"), 5, "grid.V: 5 is not keys with values", "start, stop, num"),
        (change(GRID_V, ""), 5, "grid.V: nothing is not keys with values", "start, stop, num"),
        ("bicycle: dikarev1981\ngrid: 3\n", 2, "grid: 3 is not keys with values", "lam, sigma, V"),
        # the rest
        (GOOD + "model: refind\n", 6, "model: 'refind' is not known", "did you mean 'refined'?"),
        (GOOD + "model: 3\n", 6, "model: 3 is not known", "known: refined, unrefined"),
        (GOOD + "fields: [stable, vilated]\n", 6, "fields[1]: 'vilated' is not known", "'violated'?"),
        (GOOD + "fields: []\n", 6, "fields: [] is not", "at least 1"),
        (GOOD + "fields: stable\n", 6, "fields: 'stable' is not a list", "a list"),
        (GOOD + "delta: -1\n", 6, "delta: -1 is negative", "allowed: 0 and above"),
        (GOOD + "title: 3\n", 6, "title: 3 is not text", "text"),
        (GOOD + "output: 3\n", 6, "output: 3 is not text", "text"),
        (GOOD + "output: ''\n", 6, "output: '' is not", "not empty"),
        # slices
        (GOOD + "slices:\n  - {lam: 0.1}\n  - {V: 11}\n", 8, "slices[1].V: 11 is outside the grid",
         "allowed: 0 ... 10"),
        (GOOD + "slices: [{lam: 0.1, V: 2}]\n", 6, "slices[0]: a slice fixes one axis", "{lam: ...}"),
        (GOOD + "slices: [{}]\n", 6, "slices[0]: a slice fixes one axis", "{lam: ...}"),
        (GOOD + "slices: [{lam: ~}]\n", 6, "slices[0].lam: nothing is not a number", "a number"),
        (GOOD + "slices: {lam: 1}\n", 6, "slices: {'lam': 1} is not a list", "a list"),
        (GOOD + "slices: [0.2]\n", 6, "slices[0]: 0.2 is not keys with values", "lam, sigma, V"),
        # expectations
        (GOOD + "expect: [{lam: 0.2}]\n", 6, "expect[0]: expects nothing, or two things", "V1 and/or V2"),
        (GOOD + "expect: [{V1: 3, stable: never}]\n", 6, "expect[0]: expects nothing, or two", "V1"),
        (GOOD + "expect: [{stable: always}]\n", 6, "expect[0].stable: 'always' is not known", "never"),
        (GOOD + "expect: [{V1: 3, within: 0}]\n", 6, "expect[0].within: 0 is not positive", "above 0"),
        (GOOD + "expect: [{V1: unbounded}]\n", 6, "expect[0].V1: 'unbounded' is not a number", "m/s"),
        (GOOD + "expect: [{V2: unbound}]\n", 6, "expect[0].V2: 'unbound' is not a number", "unbounded"),
        # the bicycle
        (change("dikarev1981", "dikarev"), 1, "bicycle: there is no bicycle 'dikarev'", "'dikarev1981'?"),
        (change("dikarev1981", "3"), 1, "bicycle: 3 is no bicycle", "a preset, a path to a YAML file, or"),
        (change("dikarev1981", ""), 1, "bicycle: nothing is no bicycle", "a preset, a path"),
        (IN_PLACE.replace("m2: 2.7", "m2: -2.7"), 12, "bicycle.m2: -2.7 is not positive", "m2 > 0"),
        (IN_PLACE.replace("m2: 2.7", "m2: .nan"), 12, "bicycle.m2: nan is not finite", "a number"),
        (IN_PLACE.replace("m2: 2.7", "m2: 2,7"), 12, "bicycle.m2: '2,7' is not a number", "a number"),
        (IN_PLACE.replace("m2: 2.7", "mm2: 2.7"), 12, "bicycle.mm2: unknown parameter", "'m2'?"),
        (IN_PLACE.replace("  m2: 2.7\n", ""), 1, "bicycle: missing parameter: m2", "mass of the front"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_with_its_place(text, line, problem, hint):
    first, *rest = message(text).splitlines()
    assert first.startswith(f"scan.yaml, line {line}: {problem}")
    assert len(rest) <= 1
    assert hint in "".join(rest)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "scan.yaml: holds an empty document"),
        ("# only a remark\n", "scan.yaml: holds an empty document"),
        ("- a\n- b\n", "scan.yaml: holds a list, not keys with values"),
        ("bicycle dikarev1981\n", "scan.yaml: holds text, not keys with values"),
        (b"\xff\xfe\x00", "scan.yaml, line 1: is not a text file in UTF-8"),
        ("grid: [\n", "scan.yaml, line 2, column 1: not valid YAML: "),
        ("a: b: c\n", "scan.yaml, line 1, column 5: not valid YAML: mapping values are not allowed"),
        ("\ta: 1\n", "scan.yaml, line 1, column 1: not valid YAML: found character that cannot start"),
        (GOOD + "bicycle: x\n", "scan.yaml, line 6, column 1: not valid YAML: found duplicate key 'bicycle'"),
        (GOOD + "---\nbicycle: x\n", "scan.yaml, line 6, column 1: not valid YAML: a second document"),
        ("bicycle: \0\n", "scan.yaml, line 1: not valid YAML: unacceptable character #x0000"),
        ("grid: " + "[" * 500 + "]" * 500 + "\n", "scan.yaml, line 1, column 39: is nested too deeply"),
        (GOOD.replace("num: 6", "num: " + "9" * 5000), "scan.yaml, line 5, column 32: not valid YAML"),
        ("bicycle: &loop\n  c: *loop\n", "scan.yaml, line 2, column 6: *loop stands in what"),
    ],
    ids=[
        "empty", "remark", "list", "text", "binary", "open list", "two colons", "tab", "twice",
        "two documents", "NUL", "deep", "long number", "loop",
    ],
)  # fmt: skip
def test_what_is_no_config_at_all(text, expected):
    found = message(text)
    assert found.startswith(expected)
    assert len(found.splitlines()) <= 2
    assert len(found) < 400


@pytest.mark.parametrize("bad", ['title: "a\\0b"', 'output: "a\\0b"'])
def test_text_that_no_file_can_hold(bad):
    assert message(GOOD + bad + "\n").startswith(f"scan.yaml, line 6: {bad[: bad.index(':')]}: ")


def test_a_file_that_is_not_there_with_those_that_are():
    for name in ("a.yaml", "b.yml", "c.txt"):
        Path(name).touch()
    with pytest.raises(
        InputError, match=r"d\.yaml: there is no such file\nYAML files in '\.': a\.yaml, b\.yml$"
    ):
        load_config("d.yaml")
    with pytest.raises(InputError, match="the folder 'nowhere' does not exist either"):
        load_config("nowhere/d.yaml")


def test_a_folder_is_no_file():
    with pytest.raises(InputError, match="is a folder, not a file"):
        load_config(".")


def test_a_mistake_in_a_bicycles_own_file_has_that_files_lines():
    Path("mine.yaml").write_text("# a remark\n" + PAPER.split("\n", 1)[1].replace("m1: 80", "m1: -1"))
    found = message(change("dikarev1981", "mine.yaml"))
    assert found.startswith("mine.yaml, line 6: m1: -1 is not positive (mass of the rear part")


def test_a_bicycles_file_that_is_not_there():
    assert message(change("dikarev1981", "mine.yaml")).startswith(
        "mine.yaml: there is no such file\nYAML files"
    )
