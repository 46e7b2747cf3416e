"""bikestab design: table, JSON, files, and what it says about mistakes and about nothing."""

import csv
import json
from functools import partial

import jsonschema
import pytest

from bikestab.bicycle import Bicycle
from bikestab.design import best as module
from bikestab.design import search
from bikestab.design.best import best_designs
from bikestab.design.criteria import Wanted
from bikestab.family import Family
from bikestab.presets import preset_text

NUMBER, MAYBE = {"type": "number"}, {"type": ["number", "null"]}
KIND = {"enum": ["weave", "capsize", "rest", "unbounded", None]}
DESIGN = {
    "type": "object",
    "properties": {
        "lam": NUMBER, "sigma": NUMBER, "head_angle_deg": NUMBER, "trail": NUMBER, "offset": NUMBER,
        "V1": MAYBE, "V2": MAYBE,
        "lower": KIND, "upper": KIND, "width": {"type": "number", "minimum": 0}, "growth_rate": MAYBE,
        "V": NUMBER, "at": {"type": "string"},
    },
    "additionalProperties": False,
}  # fmt: skip
DESIGN["required"] = list(DESIGN["properties"])
SCHEMA = {
    "properties": {name: {"anyOf": [DESIGN, {"type": "null"}]} for name in ("own", "closest")}
    | {name: {"anyOf": [DESIGN, {"type": "null"}]} for name in ("widest", "lowest_V1", "fastest_decay")}
    | {"pareto": {"type": "array", "items": DESIGN}},
    "required": ["own", "widest", "lowest_V1", "fastest_decay", "pareto", "closest"],
}


@pytest.fixture
def design(monkeypatch, without_warnings):
    """Run the command on a coarse grid."""
    monkeypatch.setattr(module, "GRID", 31)
    monkeypatch.setattr(search, "ROUNDS", 12)
    monkeypatch.setattr(search, "ROUNDS_TOGETHER", 6)
    return partial(without_warnings, "design")


def test_json_and_its_schema(design):
    code, out, err = design("--bicycle", "meijaard2007", "--V", "18km/h", "--lam", "10deg:30deg", "--json")
    assert (code, err) == (0, "")
    found = json.loads(out, parse_constant=pytest.fail)
    assert list(found) == ["bicycle", "model", "delta", "results"]
    (found,) = found["results"]
    jsonschema.validate(found, SCHEMA)
    assert list(found) == [
        "searched", "own", "widest", "lowest_V1", "fastest_decay", "pareto", "closest",
    ]  # fmt: skip
    searched = found["searched"]
    assert list(searched) == ["lam", "sigma", "trail", "offset", "V_max", "judged", "stable"]
    assert searched["judged"] == [5, 5]
    assert searched["sigma"] == [0, 0.3]
    wanted = Wanted(Family(Bicycle.preset("meijaard2007")), x=tuple(searched["lam"]), judged=(5.0, 5.0))
    best = best_designs(wanted)
    assert {name: found[name] for name in best._fields} == best._asdict()
    assert found["own"]["V1"] == pytest.approx(4.292382536341, abs=1e-12)


def test_table(design, monkeypatch):
    monkeypatch.setattr(search, "ROUNDS", 100)
    code, out, err = design("--bicycle", "meijaard2007", "--V", "5")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert lines[:3] == [
        "meijaard2007, refined model, damping 0 kg m²/s",
        "searched: λ = 0 ... 0.6 rad, σ = 0 ... 0.3 (trail 0.0000 ... 0.3060 m)",
        "decay: growth rate at 5 m/s",
    ]
    assert max(map(len, lines)) <= 80
    assert lines[6].split() == ["own", "0.314159", "0.0784314", "1.73188", "4.29238", "6.02426", "-0.322866"]
    assert lines[7].split() == ["72.000", "0.0800", "0.0321", "weave", "capsize", "5.0000"]
    assert [line[:9].strip() for line in lines[6:14]] == [
        "own", "", "widest", "interval", "lowest V1", "", "fastest", "decay",
    ]  # fmt: skip
    assert "widest interval: limit of sigma" in lines
    assert "ask for --stable A:B" in " ".join(out.split())
    assert "*" not in out  # nothing is cut at the cap


def test_cut_at_the_cap(design):
    _, out, _ = design("--V", "5", "--V-max", "72km/h")
    (widest,) = (line for line in out.splitlines() if line.startswith("widest  "))
    assert "unbounded" in widest
    assert any(word.startswith("17.") and word.endswith("*") for word in widest.split())
    assert "* the interval goes on above 20 m/s, up to which widths count (--V-max)" in out


def test_nothing_stable(design):
    code, out, err = design("--stable", "1:20", "--delta", "0")
    assert (code, err) == (0, "")
    assert "no design was found that is stable from 1 to 20 m/s\nclosest: λ = " in out
    assert "what may help: a smaller --stable" in out
    code, out, _ = design("--stable", "1:20", "--json")
    (found,) = json.loads(out)["results"]
    jsonschema.validate(found, SCHEMA)
    assert (code, found["widest"], found["pareto"]) == (0, None, [])
    assert found["closest"]["growth_rate"] > 0


def test_unstable_where_judged(design):
    code, out, _ = design("--sigma", "0.08", "--V", "4:6")
    assert code == 0
    assert "no design that was found decays at the worst speed from 4 to 6 m/s" in out
    assert "width against decay" not in out


def test_files(design, tmp_path):
    args = ("--V", "5", "--lam", "0:0.3", "-o", "d.png", "--csv", "front.csv")
    code, out, err = design(*args)
    assert (code, err) == (0, "")
    assert "width against decay" in out
    assert out.endswith("\nfront.csv\nd.png\n")
    assert (tmp_path / "d.png").read_bytes()[:4] == b"\x89PNG"
    with (tmp_path / "front.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    best = best_designs(Wanted(Family(Bicycle.preset("dikarev1981")), x=(0.0, 0.3), judged=(5.0, 5.0)))
    assert [float(row["width"]) for row in rows] == [found["width"] for found in best.pareto]
    assert [row["at"] for row in rows] == [found["at"] for found in best.pareto]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["d.png", "front.csv"]


def test_a_bicycle_without_own_design_and_one_outside_the_box(design, tmp_path):
    text = "\n".join(line for line in preset_text("dikarev1981").splitlines())
    (tmp_path / "mine.yaml").write_text(text + "\nlam: 0.7\nsigma: 0.1\n", "utf-8")
    _, out, _ = design("--bicycle", "mine.yaml", "--V", "5", "--json")
    assert json.loads(out)["results"][0]["own"]["at"] == "outside the box"
    _, out, _ = design("--V", "5", "--json")
    assert json.loads(out)["results"][0]["own"] is None


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (("--lam", "0.3:0.1"), "--lam: the range 0.3:0.1 ends before it starts; did you mean 0.1:0.3?"),
        (("--lam", "0:1:5"), "'--lam': '0:1:5' is neither a number nor START:STOP"),
        (("--lam", "0:tilt"), "'tilt' is not a number; allowed: a number, or one with a unit"),
        (("--trail", "0.5:0.6"), "--trail: on a wheelbase of 1.04 m this is σ = 0.480769"),
        (
            ("--stable", "4:40"),
            "--stable: 40 m/s is above 30 m/s, up to which intervals count",
        ),
        (("--V", "-1"), "--V: -1 m/s is negative; allowed: 0 and above"),
        (("--V", "1e9"), "--V: 1e+09 m/s is out of range; allowed: 0 ... 1e+06 m/s"),
        (("--V-max", "0"), "--V-max: 0 m/s is no cap for the speed"),
        (("-o", "picture"), "'picture' has no ending .png, .pdf or .svg"),
        (("-o", "a.xyz"), "'a.xyz' has no ending .png, .pdf or .svg"),
        (("-o", "a.svg", "--csv", "a.svg"), "a.svg is asked for twice"),
        (("-o", "d.png", "--sigma", "0.1"), "--sigma: a picture needs a range, not 0.1 alone"),
        (("--csv", "no/front.csv", "--lam", "0.2"), "no/front.csv: cannot be written"),
        (("--csv", "..//.", "--lam", "0.2"), "'..//.' is a folder, not a file to write"),
    ],
)
def test_mistakes(design, tmp_path, args, words):
    code, out, err = design(*args)
    assert (code, out) == (2, "")
    assert words in err
    assert len(err.splitlines()) <= 3
    assert not list(tmp_path.iterdir())
