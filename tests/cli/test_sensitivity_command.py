"""bikestab sensitivity: its tables, files and mistakes."""

import csv
import json
import math
from functools import partial
from pathlib import Path

import pytest

from bikestab.bicycle import Bicycle
from bikestab.design.sensitivity import sensitivity
from bikestab.presets import preset_text

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
    assert body == ["mB", "85", "kg", "0.01513", "0.300", "0.02541", "0.359", "-6.53"]
    assert "these do not move the ends: IByy, IHyy" in out
    assert "wider when these decrease: w, IFyy" in out
    words = " ".join(out.split())
    assert "not tried for g, which nobody can change" in words
    (wheel,) = (row for row in rows if row[:1] == ["IFyy"])
    assert wheel[-1] == "+0.0179*"
    assert "* IFyy: no rigid front wheel has IFyy > 2 IFxx: 0.297918 > 0.281 kg m²" in words


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


def test_head_angle_and_trail_choose_the_design(told):
    code, out, _ = told("--bicycle", "meijaard2007", "--head-angle", "71deg", "--offset", "45mm", "--json")
    assert code == 0
    (record,) = json.loads(out)["results"]
    lam = math.radians(19)
    assert record["lam"] == pytest.approx(lam, rel=1e-15)
    assert record["sigma"] == pytest.approx((0.35 * math.sin(lam) - 0.045) / math.cos(lam) / 1.02, rel=1e-14)
    assert told("--head-angle", "71deg", "--lam", "0.2", "--sigma", "0.08")[0] == 2


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


def test_many_machines_are_rows_of_one_table(told):
    """With the parameters that matter most to any of them, as many as fit."""
    args = ("--bicycle", "meijaard2007", "--set", "mB=60,65,70,75,80,85")
    code, out, err = told(*args)
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    assert "F: meijaard2007 mB=85: stable from 4.292383 m/s" in out
    assert out.count("%/%  head_angle") == 1
    head, *table = (line.split() for line in out.split("\n\n")[2].splitlines())
    found = json.loads(told(*args, "--json")[1])["results"]
    sizes = {}
    for i, each in enumerate(found):
        rows = {row["name"]: row for row in each["intervals"][0]["parameters"]}
        for k, end in enumerate(("V1", "V2")):
            values = table[2 * i + k][-len(head) + 1 :]
            assert values == [f"{rows[name][f'elasticity_{end}']:.3f}" for name in head[1:]]
            for name, row in rows.items():
                sizes[name] = max(sizes.get(name, 0), abs(row[f"elasticity_{end}"]))
    assert max(sizes[name] for name in sizes.keys() - {*head}) <= min(sizes[name] for name in head[1:])
    assert f"{len(rows) - len(head) + 1} more parameters have less effect" in out


@pytest.mark.parametrize("what", ["growth", "sigma_min"])
def test_what_else_moves_is_side_by_side_too(told, what):
    args = ("--of", what, "--bicycle", "meijaard2007", "--bicycle", "sharp1971", "-o", "a.png")
    code, out, err = told(*args)
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    assert out.count("1 % more ") == 1
    rows = dict(line.split(maxsplit=1) for line in out.split("\n\n")[2].splitlines()[1:])
    found = json.loads(told(*args[2:], "--json")[1])["results"]
    for i, each in enumerate(found):
        slope = (each["best"] if what == "growth" else each["sigma_min"])["slope"]
        (value,) = (row["value"] for row in each["intervals"][0]["parameters"] if row["name"] == "m1")
        assert float(rows["m1"].split()[i]) == pytest.approx(0.01 * slope["m1"] * value, rel=5e-3)
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")


def test_no_stable_speed(told):
    code, out, err = told("--lam", "0.1", "--sigma", "0.08")
    assert (code, err) == (0, "")
    assert "no stable speed" in out


def test_the_growth_rate_and_the_first_sigma_on_request(told, without_warnings):
    code, out, err = told("--bicycle", "meijaard2007", "--of", "sigma_min")
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    assert "at this λ: -0.00785233 (weave meets capsize at" in out
    assert out.split("1 % more\n")[1].split()[:5] == ["w", "1020", "mm", "6.7853e-05", "+6.92e-04"]
    assert "dgrowth/dp" in told("--bicycle", "meijaard2007", "--of", "growth")[1]
    code, out, _ = told("--lam", "0.1", "--sigma", "0.08", "--csv", "a.csv", "--json")
    (record,) = json.loads(out)["results"]
    with Path("a.csv").open(encoding="utf-8") as file:
        rows = {row["parameter"]: row for row in csv.DictReader(file)}
    assert rows["m1"]["interval"] == "0"
    assert rows["m1"]["dV1"] == ""
    assert float(rows["m1"]["dsigma_min"]) == record["sigma_min"]["slope"]["m1"]
    assert float(rows["m1"]["dgrowth_rate"]) == record["best"]["slope"]["m1"]
    code, out, err = told("--bicycle", "meijaard2007", "--lam", "-0.2", "--of", "sigma_min")
    assert "none begins; no larger σ up to 0.5 has a stable speed" in " ".join(out.split())
    for what in ("growth", "sigma_min"):
        code, out, err = told("--bicycle", "meijaard2007", "--lam", "-0.2", "--of", what, "-o", f"{what}.png")
        assert (code, out.splitlines()[-1], err) == (0, f"{what}.png", "")
        assert Path(f"{what}.png").read_bytes().startswith(b"\x89PNG")


def test_deviations_give_the_speeds_their_own(told, without_warnings):
    args = "--bicycle", "meijaard2007", "--sd", "c=10mm", "--sd", "lam=1.5deg"
    code, out, err = told(*args)
    assert (code, err) == (0, "note: meijaard2007: c is the trail along the ground\n")
    lines = (
        "stable speeds exist in 100.0% of machines within the uncertainties\n"
        "V1 = 4.29 ± 0.16 m/s, 90 % within [4.03, 4.55] m/s\n"
        "V2 = 6.02 ± 0.31 m/s, 90 % within [5.49, 6.52] m/s\n"
    )
    assert lines in out
    assert "uncertain: c ± 0.01, lam ± 0.02618" in out
    assert without_warnings("vrange", *args)[1].endswith(f"\n{lines}")
    records = [json.loads(run(*args, "--json")[1]) for run in (told, partial(without_warnings, "vrange"))]
    one, other = (record["results"][0]["spread"] for record in records)
    assert one == other
    assert one["deviations"]["c"] == 0.01


def test_an_uncertain_mass_of_the_rider_is_noted(bikestab):
    rider = 'rider: {m: "75 +/- 5", x: 0.35, z: -1.1, Ixx: 8, Izz: 2.4, Ixz: -1.9}'
    drawn, scaled = rider.replace("8,", '"8 +/- 1",'), rider.replace("}", ", scale_inertia: true}")
    for text, noted in ((rider, True), (drawn, False), (scaled, False)):
        Path("ridden.yaml").write_text(f"{preset_text('meijaard2007')}\n{text}\n", "utf-8")
        for args in (("vrange", "--sd", "file"), ("sensitivity",)):
            code, _, err = bikestab(*args, "--bicycle", "ridden.yaml")
            assert code == 0
            assert ("the rider's mass alone changes from the file's 75 kg" in err) == noted


def test_the_tornado_picture(told):
    code, out, err = told("--bicycle", "meijaard2007", "--bicycle", "sharp1971", "-o", "a.png")
    assert (code, err) == (0, "")
    assert out.endswith("\na.png\n")
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")
    assert told("--bicycle", "meijaard2007", "-o", "a.pgn")[0] == 2


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        (["--bicycle", "meijaard2007", "--sd", "mX=1"], "--sd: there is no parameter 'mX'; known: w, c"),
        (["--bicycle", "meijaard2007", "--sd", "mB=0"], "mB=0 is no standard deviation; allowed: above 0"),
        (["--bicycle", "meijaard2007", "--sd", "mB"], "'mB' is not NAME=VALUE"),
        (
            [],
            "has no lam and no sigma of its own: give --lam and --sigma, for example --lam 0.2 --sigma 0.08",
        ),
        (["--bicycle", "meijaard2007", "--hold", "rake"], "'rake' is not one of"),
        (["--bicycle", "meijaard2007", "--csv", "none/a.csv"], "none/a.csv: cannot be written"),
        (["--bicycle", "meijard2007"], "did you mean 'meijaard2007'?"),
    ],
)
def test_mistakes(told, args, expected):
    code, out, err = told(*args)
    assert (code, out) == (2, "")
    assert expected in err
