"""Numbers are printed with the digits that are certain, and no more."""

import io
import json
import math
import re
import sys

import click
import pytest
from bikestab_cli.output import certain, prose, table
from bikestab_cli.streams import Visible
from hypothesis import given
from hypothesis import strategies as st
from wcwidth import wcswidth

from bikestab.widths import columns, fitting


@pytest.mark.parametrize(
    ("value", "error", "most", "text"),
    [
        (4.292382536341104, 2e-15, 12, "4.292382536341"),
        (4.292382536341104, 0.0, 12, "4.292382536341"),
        (4.292382536341104, 1e-10, 12, "4.292382536"),
        (4.0, 1e-15, 12, "4.000000000000"),
        (4.0, 1e-4, 6, "4.000"),
        (24.333662909, 1e-7, 6, "24.333663"),
        (0.0, 0.0, 12, "0.000000000000"),
        (770461.0843244519, 1e-10, 12, "770461.084324452"),
        (94640.38798002, None, 12, "about 94640.4"),
        (1e18, 1e17, 12, "about 1e+18"),
    ],
)
def test_certain(value, error, most, text):
    assert certain(value, error, most) == text


def test_significant_digits():
    assert certain(3.913290770190, 1e-15, 13, "g") == "3.91329077019"
    assert certain(11.31603264181234, 1e-8, 13, "g") == "11.316033"


@given(st.floats(1e-3, 1e3), st.floats(-16, -2), st.floats(-1, 1))
def test_every_value_within_the_bound_prints_alike(value, power, share):
    error = value * 10**power
    text = certain(value, error)
    if not text.startswith("about"):
        digits = len(text.partition(".")[2])
        inside = min(max(value + share * error, value - error), value + error)
        assert f"{inside:.{digits}f}" == text
        finer = math.nextafter(value - error, -math.inf), math.nextafter(value + error, math.inf)
        assert digits == 12 or len({f"{end:.{digits + 1}f}" for end in finer}) == 2


WIDE = "自転車の安定性を調べるための標準的な二輪車モデル"
NAMES = [WIDE * 2, "a bicycle of many words " * 6, "solid" * 25]


@pytest.mark.parametrize("name", NAMES)
def test_no_name_makes_a_line_longer_than_80_columns(name):
    told = prose(f"{name}, refined model, damping 0 kg m²/s") + "\n" + table(["name", "V"], [[name, "1"]], 0)
    assert max(wcswidth(line) for line in told.splitlines()) <= 80
    assert told.replace(" ", "").replace("\n", "").count(name.replace(" ", "")) == 1


@given(st.text(st.sampled_from("ab é自e\u0301/"), max_size=200))
def test_columns_are_those_of_a_terminal(text):
    assert columns(text) == wcswidth(text)
    for most in range(12):
        start = fitting(text, most)
        assert wcswidth(start) <= most
        assert start == text or wcswidth(text[: len(start) + 1]) > most
    lines = prose(text).split("\n")
    assert all(columns(line) <= 80 for line in lines)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")


@pytest.mark.parametrize("command", [["vrange"], ["eigen", "--V", "5"], ["sensitivity"], ["design"]])
def test_tables_of_machines_with_long_names(bikestab, tmp_path, command):
    bikestab("convert", "meijaard2007", "-o", "own.yaml")
    text = (tmp_path / "own.yaml").read_text(encoding="utf-8")
    files = [tmp_path / f"{i}.yaml" for i in range(len(NAMES))]
    for file, name in zip(files, NAMES, strict=True):
        file.write_text(re.sub("name: .*", f"name: {name}", text), encoding="utf-8")
    for chosen in [files, *([file] for file in files)]:
        code, out, _ = bikestab(*command, *(part for file in chosen for part in ("--bicycle", file.name)))
        assert code == 0
        assert max(map(wcswidth, out.splitlines())) <= 80


def test_machines_of_one_name_are_told_apart_by_their_files(bikestab, tmp_path):
    for folder, trail in (("one", "60mm"), ("two", "70mm")):
        tmp_path.joinpath(folder).mkdir()
        bikestab("convert", "meijaard2007", "-o", f"{folder}/x.yaml")
        text = (tmp_path / folder / "x.yaml").read_text(encoding="utf-8")
        tmp_path.joinpath(folder, "x.yaml").write_text(re.sub("(?m)^c: .*", f"c: {trail}", text))
    several = ["--bicycle", "one/x.yaml", "--bicycle", "two/x.yaml", "--bicycle", "meijaard2007"]
    code, out, _ = bikestab("vrange", *several, "--json")
    names = ["meijaard2007 (one/x.yaml)", "meijaard2007 (two/x.yaml)", "meijaard2007"]
    assert code == 0
    assert [each["bicycle"] for each in json.loads(out)["results"]] == json.loads(out)["bicycle"] == names
    code, out, err = bikestab("vrange", *several[:2], *several[:2])
    assert (code, out) == (2, "")
    assert "one/x.yaml is given twice; give it once" in err


def test_the_damping_of_several_machines_is_told(bikestab):
    several = ["--bicycle", "meijaard2007", "--bicycle", "dikarev1981"]
    design = ["--lam", "0.3", "--sigma", "0.08"]
    assert bikestab("vrange", *several, *design)[1].startswith("refined model\n")
    assert bikestab("vrange", *several, *design, "--delta", "2")[1].startswith(
        "refined model, damping 2 kg m²/s\n"
    )
    assert bikestab("vrange", *several, *design, "--set", "delta=1,2")[1].startswith("refined model\n")


def test_tables_stay_aligned_where_letters_are_spelt(monkeypatch):
    """A terminal of ASCII gets ``[ deg]`` for ``[°]``: columns are counted as they are shown."""
    ascii_only = io.TextIOWrapper(io.BytesIO(), "ascii")
    monkeypatch.setattr(sys, "stdout", Visible(ascii_only))
    click.echo(table(["head\n[°]", "λ\x1b"], [["72", "0.3"]]))
    click.echo(prose("λ = 0.3 rad at 3 kg m²/s"))
    sys.stdout.flush()
    shown = ascii_only.buffer.getvalue().decode().splitlines()
    assert shown == ["  head  lam\\u001b", "[ deg]", "    72        0.3", "lam = 0.3 rad at 3 kg m^2/s"]
