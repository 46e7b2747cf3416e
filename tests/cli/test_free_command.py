"""bikestab design --free: what is told, written and drawn of a search over several parameters."""

import csv
import json
import math
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.distance import pdist

from bikestab.plot import files

FREE = "--bicycle", "meijaard2007", "--free", "lam=0.1:0.5", "--free", "trail=2cm:15cm"


@pytest.fixture
def told(without_warnings):
    return partial(without_warnings, "design")


def test_the_own_design_is_told_as_it_is_though_it_is_not_stable_as_asked(told):
    code, out, err = told(*FREE, "--stable", "4.2:5")
    assert (code, err) == (0, "")
    (width,) = (line.split() for line in out.splitlines() if line.strip().startswith("width"))
    assert width[2] == "1.73188"
    assert "own: not stable as asked" in out
    assert "own:" not in told(*FREE, "--stable", "4.6:5")[1]
    assert "own: outside of what is searched" in told(*FREE[:2], "--free", "lam=0.35:0.5")[1]


def test_files_have_what_the_table_has(told):
    args = (*FREE, "--stable", "4.6:5.4", "--sd", "lam=0.5deg", "--sd", "trail=5mm")
    code, out, err = told(*args, "--csv", "a.csv", "-o", "a.png", "--json")
    assert (code, err) == (0, "")
    record = json.loads(out)
    assert record["files"] == {"csv": "a.csv", "picture": "a.png"}
    (result,) = record["results"]
    with Path("a.csv").open(encoding="utf-8") as file:
        rows = {row["design"]: row for row in csv.DictReader(file)}
    assert [*rows] == ["own", "widest", "lowest V1", "fastest decay", "most robust"]
    assert float(rows["widest"]["trail"]) == result["widest"]["over"]["trail"]
    assert float(rows["most robust"]["V2"]) == result["most_robust"]["design"]["V2"]
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")


def test_deviations_and_the_radius_are_told_and_drawn(told, monkeypatch):
    drawn = []
    monkeypatch.setattr(files, "save", lambda figure, path: drawn.append(figure))
    args = (*FREE, "--stable", "4.6:5.4", "--sd", "lam=0.5deg", "--sd", "trail=5mm", "--sd", "mB=3")
    out = told(*args, "-o", "a.png")[1]
    words = "lam 0.5°, trail 5 mm, mB 3 kg"
    assert f"standard deviations: {words}\n" in out
    robust = json.loads(told(*args, "--json")[1])["results"][0]["most_robust"]
    assert robust["deviations"] == {"lam": math.radians(0.5), "trail": 0.005, "mB": 3}
    title = " ".join(drawn[0].axes[0].get_title().split())
    assert f"stable within {robust['radius']:.3g} standard deviations ({words})" in title


def test_no_mark_of_a_search_hides_another(told, monkeypatch):
    drawn = []
    monkeypatch.setattr(files, "save", lambda figure, path: drawn.append(figure))
    told(*FREE, "--free", "xB=0.2:0.4", "--stable", "4.6:5.4", "--sd", "mB=3", "-o", "a.png")
    drawn[0].draw_without_rendering()
    places = drawn[0].axes[1]
    marks = [line for line in places.lines if line.get_marker() != "None"]
    at = places.transData.transform(np.concatenate([line.get_xydata() for line in marks]))
    assert len(marks) == 15
    assert pdist(at).min() > 6 * drawn[0].dpi / 72


def test_a_picture_is_of_one_machine(told):
    code, out, err = told(*FREE, "--bicycle", "sharp1971", "-o", "a.png")
    assert (code, out) == (2, "")
    assert "this picture is of one machine" in err
    assert told("--bicycle", "sharp1971", "--free", "delta=0:20", "-o", "a.png")[0] == 0


def test_the_table_says_where_optima_lie(told):
    out = told("--bicycle", "sharp1971", "--free", "delta=0:20", "--free", "trail=5cm:20cm")[1]
    assert "widest: limit of delta, limit of trail\nlowest V1: limit of delta, limit of trail\n" in out


def test_an_unknown_deviation_is_told_with_the_parameters_that_there_are(told):
    code, out, err = told(*FREE, "--stable", "4.6:5.4", "--sd", "foo=1")
    assert (code, out) == (2, "")
    assert "has no parameter 'foo'; known: w, c, lam, g, delta, rR" in " ".join(err.split())
    code, out, err = told(*FREE, "--stable", "4.6:5.4", "--sd", "mB=1e200")
    assert (code, out) == (2, "")
    assert "no standard deviation; allowed: above 0 up to 1e+09" in " ".join(err.split())
