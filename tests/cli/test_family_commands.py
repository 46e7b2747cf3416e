"""Commands over any two parameters of a machine."""

import json
from pathlib import Path

import meshio
import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.speeds import intervals_of
from bikestab.stability import stable_intervals

SCAN = """\
bicycle: meijaard2007
grid:
  x: {name: mB, start: 40kg, stop: 110, num: 8}
  y: {name: offset, start: 0mm, stop: 80mm, num: 5}
  V: {start: 0, stop: 36km/h, num: 11}
output: out
"""


@pytest.fixture
def scanned(bikestab, tmp_path):
    (tmp_path / "scan.yaml").write_text(SCAN)
    assert bikestab("scan", "scan.yaml", "--quiet")[0] == 0
    return bikestab


def test_slice(scanned):
    assert scanned("slice", "out", "--at", "offset=45mm", "-o", "a.png") == (0, "a.png\n", "")
    code, _, err = scanned("slice", "out", "--lam", "0.3")
    assert code == 2
    assert "the volume is over mB, offset and V: give one of --at mB=VALUE, --at offset=VALUE and --V" in err
    code, _, err = scanned("slice", "out", "--at", "mB=200")
    assert code == 2
    assert "mB = 200 is outside the volume\n  allowed: 40 ... 110" in err


def test_export_and_info(scanned, tmp_path):
    code, out, _ = scanned(
        "export", "out", "--mesh", "a.ply", "--intervals", "i.csv", "--skeleton", "s.csv", "--cells", "20"
    )
    assert code == 0
    assert "x = 0.2 mB, y = 100 offset, z = 1 V" in out
    head, first, *_ = (tmp_path / "i.csv").read_text().splitlines()
    assert head.startswith("mB,offset,lam,sigma,head_angle_deg,trail,interval,V1,V2")
    assert first.startswith("40.0,0.0,0.314159")
    points = meshio.read("a.ply").points
    assert (np.min(points, axis=0)[:2], np.max(points, axis=0)[:2]) == (
        pytest.approx([8, 0]), pytest.approx([22, 8]),
    )  # fmt: skip
    code, out, _ = scanned("info", "out", "--json")
    assert json.loads(out)["results"][0]["axes"]["mB"] == {
        "first": 40.0, "last": 110.0, "num": 8, "unit": "kg", "uniform": True,
    }  # fmt: skip


def test_vrange_over_two_parameters(bikestab):
    over = ("--over", "mB=60:110:3", "--over", "offset=0:80mm:2")
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", *over, "--json")
    assert (code, err) == (0, "")
    results = json.loads(out)["results"]
    assert [each["over"] for each in results] == [
        {"mB": m, "offset": b} for m in (60.0, 85.0, 110.0) for b in (0.0, 0.08)
    ]
    bike = Bicycle.preset("meijaard2007")
    for each in results:
        own = bike.replaced(each["over"])
        (interval,) = each["intervals"]
        found = stable_intervals(own)
        assert (interval["V1"], interval["V2"]) == pytest.approx((found.V1[0], found.V2[0]), rel=1e-13)
        assert each["trail"] == pytest.approx(own.bodies["c"], rel=1e-14)
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", *over)
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    assert " ".join(out.splitlines()[4].split()) == "60 0 0.314159 0.111492 4.163649384 6.098247598"
    with_rider = {**bike.given, "rider": {"m": 75, "x": 0.35, "z": -1.1, "Ixx": 3, "Izz": 1.5, "Ixz": 0.2}}
    path = Path("rider.yaml")
    path.write_text(json.dumps(with_rider))
    code, out, _ = bikestab("vrange", "--bicycle", path, "--over", "rider.m=60:100:2", "--json")
    assert [each["over"] for each in json.loads(out)["results"]] == [{"rider.m": 60.0}, {"rider.m": 100.0}]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (
            ["--over", "mb=60:110:6"],
            "mb: the bicycle 'meijaard2007' has no parameter 'mb'; did you mean 'mB'?",
        ),
        (["--over", "mB=60:110"], "'mB=60:110' is not NAME=START:STOP:NUM, e.g. mB=60:110:6"),
        (["--over", "mB=-60:110:2"], "mB: -60 is not non-negative"),
        (["--over", "mB=60:10:2"], "does not end above its start"),
        (["--over", "mB=60:110m:2"], "it is a length, not a mass"),
        (["--over", "c=0:0.1:2", "--over", "trail=0:0.1:2"], "c and trail are one parameter"),
        (["--over", "mB=60:110:2", "--lam", "0.3"], "set the rest with --set, as --set lam=18deg"),
        (
            ["--over", "lam=0:0.3:2", "--over", "c=0:0.1:2", "--over", "offset=0:0.1:2"],
            "lam and c fix the offset; leave one of the three out",
        ),
    ],
)
def test_mistakes_of_over(bikestab, options, words):
    code, _, err = bikestab("vrange", "--bicycle", "meijaard2007", *options)
    assert code == 2
    assert words in err


def test_design_over_two_parameters(bikestab, tmp_path):
    over = ("--over", "mB=60:110", "--over", "offset=0:80mm")
    code, out, err = bikestab(
        "design", "--bicycle", "meijaard2007", *over, "--V", 5, "--json", "-o", "a.png", "--csv", "a.csv"
    )
    assert (code, err) == (0, "")
    found = json.loads(out)["results"][0]
    assert found["searched"]["mB"] == [60, 110]
    assert found["widest"]["over"] == {"mB": pytest.approx(110), "offset": pytest.approx(0, abs=1e-9)}
    own = stable_intervals(Bicycle.preset("meijaard2007").replaced(found["widest"]["over"]))
    assert found["widest"]["width"] == pytest.approx(own.V2[0] - own.V1[0], rel=1e-9)
    random = np.random.default_rng(1).uniform([60, 0], [110, 0.08], (4000, 2)).T
    dense = intervals_of(Family(Bicycle.preset("meijaard2007"), x="mB", y="offset").table(*random))
    assert found["widest"]["width"] >= np.max(dense.V2 - dense.V1)
    assert found["lowest_V1"]["V1"] <= np.min(dense.V1)
    head, *rows = (tmp_path / "a.csv").read_text().splitlines()
    assert head.startswith("mB,offset,lam,sigma,")
    assert len(rows) == len(found["pareto"])
    code, out, _ = bikestab("design", "--bicycle", "meijaard2007", *over)
    assert max(map(len, out.splitlines())) <= 80
    code, _, err = bikestab("design", "--bicycle", "meijaard2007", *over[:2])
    assert (code, "--over is given twice, for two parameters" in err) == (2, True)


def test_design_of_free_parameters(bikestab):
    options = ["--free", "trail=2cm:15cm", "--free", "xB=0.2:0.4", "--stable", "4.6:5.4", "--sd", "mB=3"]
    code, out, err = bikestab("design", "--bicycle", "meijaard2007", *options)
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    assert "most robust: every machine within" in out
    code, out, _ = bikestab("design", "--bicycle", "meijaard2007", *options, "--json")
    found = json.loads(out)["results"][0]
    assert found["most_robust"]["radius"] > 3
    assert found["widest"]["width"] > found["own"]["width"]
    for wrong, words in (
        (["--sd", "mB=3"], "--sd is for the most robust design of --free parameters"),
        ([*options, "--lam", "0:0.3"], "--free says all that is searched"),
        (["--free", "xB=0.2:0.4", "--sd", "mB=3"], "robust designs need speeds"),
    ):
        code, _, err = bikestab("design", "--bicycle", "meijaard2007", *wrong)
        assert (code, words in err) == (2, True), err
