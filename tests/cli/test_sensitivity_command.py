"""bikestab sensitivity: its tables, files and mistakes."""

import csv
import json
from functools import partial
from pathlib import Path

import pytest

from bikestab.bicycle import Bicycle
from bikestab.design.sensitivity import sensitivity

TWO = "--lam", "0.04834835", "--sigma", "0.15"  # of the paper's bicycle: two stable intervals


@pytest.fixture
def told(without_warnings):
    return partial(without_warnings, "sensitivity")


def test_the_table_of_the_benchmark(told):
    code, out, err = told("--bicycle", "meijaard2007")
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    rows = [line.split() for line in out.splitlines()]
    (body,) = (row for row in rows if row[:1] == ["mB"] and len(row) == 8)
    assert body == ["mB", "85", "kg", "0.01513", "0.300", "0.02541", "0.359", "-6.61"]
    assert "these do not move the ends: IByy, IHyy" in out
    assert "wider with less of: w, IFyy" in out


def test_json_and_csv_have_full_precision(told):
    code, out, _ = told("--bicycle", "meijaard2007", "--hold", "offset", "--csv", "a.csv", "--json")
    assert code == 0
    (record,) = json.loads(out)["results"]
    found = sensitivity(Bicycle.preset("meijaard2007"), hold="offset")
    rows = {row["name"]: row for row in record["intervals"][0]["parameters"]}
    assert {name: row["dV1"] for name, row in rows.items()} == {n: x[0] for n, x in found.dV1.items()}
    with Path("a.csv").open(encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    assert {line["parameter"]: float(line["dV2"]) for line in lines} == {
        n: x[0] for n, x in found.dV2.items()
    }
    assert record["hold"] == "offset"


def test_every_interval_has_its_table(told):
    code, out, _ = told(*TWO)
    assert code == 0
    assert out.count("stable from") == 2
    assert "without an upper limit" in out


def test_machines_of_two_notations_side_by_side(told):
    code, out, err = told("--bicycle", "meijaard2007", "--bicycle", "sharp1971")
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    assert "A: meijaard2007" in out
    assert "B: sharp1971" in out
    assert "l1" in out.split()
    assert "mB" not in out.split()
    many = told(*["--bicycle", "meijaard2007"] * 6)[1]
    assert "mB" in many.split()
    assert "F: meijaard2007" in many


def test_no_stable_speed(told):
    code, out, err = told("--lam", "0.1", "--sigma", "0.08")
    assert (code, err) == (0, "")
    assert "no stable speed" in out


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ([], "has no lam of its own"),
        (["--bicycle", "meijaard2007", "--hold", "rake"], "'rake' is not one of"),
        (["--bicycle", "meijaard2007", "--csv", "none/a.csv"], "none/a.csv: cannot be written"),
        (["--bicycle", "meijard2007"], "did you mean 'meijaard2007'?"),
    ],
)
def test_mistakes(told, args, expected):
    code, out, err = told(*args)
    assert (code, out) == (2, "")
    assert expected in err
