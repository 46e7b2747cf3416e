"""Sweeps and ensembles on the command line: pictures of their machines, and choosing one with --at."""

import csv
import json
from pathlib import Path

import h5py
import pytest

CONFIG = """\
bicycle: meijaard2007
grid:
  lam: {start: 0.1, stop: 0.5, num: 5}
  sigma: {start: 0.03, stop: 0.13, num: 6}
  V: {start: 0, stop: 9, num: 10}
"""
SWEEP = "sweep: {delta: [0, 2]}\n"
ENSEMBLE = "ensemble: {mB: {normal: [85, 8]}, samples: 20}\n"


@pytest.fixture
def scan(bikestab):
    def run(more, *args):
        Path("a.yaml").write_text(CONFIG + more)
        return bikestab("scan", "a.yaml", *args)

    return run


def pictures():
    return sorted(path.name for path in Path("out/a").glob("*.png"))


def test_each_machine_has_its_pictures(scan):
    code, out, err = scan(SWEEP + ENSEMBLE + "slices: [{lam: 0.2}]\n")
    assert (code, err) == (0, "")
    assert out.startswith("a.yaml: out/a/volume.h5, 6 pictures: ")
    assert "of 600 points stable" in out
    assert pictures() == [
        f"{kind}_delta_{value}.png"
        for kind in ("probability_lam_0.2", "region", "slice_lam_0.2")
        for value in (0, 2)
    ]


def test_too_many_machines_for_pictures(scan):
    code, out, err = scan("sweep: {delta: {start: 0, stop: 8, num: 9}}\nslices: [{lam: 0.2}]\n")
    assert (code, pictures()) == (0, [])
    assert err == (
        "note: pictures of 9 machines are not drawn; draw one with, for example, "
        "'bikestab slice out/a/volume.h5 --lam VALUE --at delta=0'\n"
    )
    assert "volume.h5: " in out


def test_slice_of_one_machine(scan, bikestab):
    scan(SWEEP + ENSEMBLE)
    assert bikestab("slice", "out/a", "--lam", "0.2", "--at", "delta=2")[1] == (
        "out/a/slice_lam_0.2_delta_2.png\n"
    )
    assert bikestab("slice", "out/a", "--lam", "0.2", "--at", "delta=2", "--probability")[1] == (
        "out/a/probability_lam_0.2_delta_2.png\n"
    )
    assert bikestab("slice", "out/a", "--V", "5", "--at", "delta=0", "-o", "mine.pdf")[0] == 0


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        (
            (),
            "has several machines, with delta = 0, 2\n  choose one, for example --at delta=0",
        ),
        (("--at", "delta=1"), "has no delta = 1\n  allowed: 0, 2"),
        (("--at", "delta"), "'delta' is not NAME=VALUE, e.g. delta=1"),
        (("--at", "delta=much"), "'delta=much': 'much' is not a number"),
    ],
)
def test_a_machine_that_is_not_there(scan, bikestab, args, expected):
    scan(SWEEP)
    for command in (("slice", "out/a", "--lam", "0.2"), ("export", "out/a", "--skeleton", "i.csv")):
        code, out, err = bikestab(*command, *args)
        assert (code, out) == (2, "")
        assert expected in err


def test_export_of_one_machine(scan, bikestab):
    scan(SWEEP)
    ends = []
    for delta in (0, 2):
        code, _, _ = bikestab("export", "out/a", "--intervals", "i.csv", "--at", f"delta={delta}")
        assert code == 0
        with Path("i.csv").open() as file:
            ends.append([float(row["V1"]) for row in csv.DictReader(file)])
    assert len(ends[0]) > 10
    assert ends[0] != ends[1]


def read(name):
    with Path(name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_export_of_all_machines_and_of_quantiles(scan, bikestab):
    scan(SWEEP + ENSEMBLE)
    code, out, _ = bikestab("export", "out/a", "--intervals", "all.csv", "--quantiles", "q.csv")
    assert (code, out.splitlines()[-1]) == (0, "q.csv: 300 rows")
    rows = read("all.csv")
    for delta in ("0.0", "2.0"):
        bikestab("export", "out/a", "--intervals", "i.csv", "--at", f"delta={delta}")
        own = read("i.csv")
        assert [row for row in rows if row["delta"] == delta] == [{"delta": delta, **row} for row in own]
    with h5py.File("out/a/volume.h5") as file:
        stored = file["V1_quantiles"][()]
    quantiles = read("q.csv")
    assert [float(row["V1"] or "nan") for row in quantiles] == pytest.approx(
        stored.ravel(), nan_ok=True, rel=0
    )
    scan("output: out/b\n")
    code, _, err = bikestab("export", "out/b", "--quantiles", "q.csv")
    assert code == 2
    assert "has no ensemble" in err


def test_info(scan, bikestab):
    scan(SWEEP + ENSEMBLE)
    (found,) = json.loads(bikestab("info", "out/a", "--json")[1])["results"]
    assert found["sweep"] == {"delta": [0, 2]}
    assert (found["points"], found["designs"], found["ensemble_samples"]) == (600, 60, 20)
    out = bikestab("info", "out/a")[1]
    assert "delta                               0, 2 (sweep)" in out
    assert "delta=2" in out.split("machine")[1]
    quantile = found["machines"][1]["quantiles"][0]
    assert f"{quantile['V1']:.4f}" in out
    assert found["machines"][1]["set"] == {"delta": 2}
    assert found["drawn"] == {"mB": {"normal": [85, 8]}}


@pytest.mark.parametrize(
    ("given", "drawn", "words"),
    [
        ("mB: {normal: [85kg, 8kg]}", {"mB": {"normal": [85, 8]}}, "normal: mean 85, standard deviation 8"),
        ("rF: {uniform: [34cm, 0.36]}", {"rF": {"uniform": [0.34, 0.36]}}, "uniform: low 0.34, high 0.36"),
        (
            "mH: {lognormal: [4, 0.1]}", {"mH": {"lognormal": [4, 0.1]}},
            "lognormal: median 4, standard deviation of the logarithm 0.1",
        ),
        (
            "delta: {truncated: [1, 0.5, 0, 3]}", {"delta": {"truncated": [1, 0.5, 0, 3]}},
            "truncated: mean 1, standard deviation 0.5, low 0, high 3",
        ),
    ],
)  # fmt: skip
def test_info_says_what_is_drawn(scan, bikestab, given, drawn, words):
    scan(f"ensemble: {{{given}, samples: 4}}\n")
    assert json.loads(bikestab("info", "out/a", "--json")[1])["results"][0]["drawn"] == drawn
    lines = bikestab("info", "out/a")[1].splitlines()
    assert all(len(line) <= 80 for line in lines)
    (name,) = drawn
    assert f"{name} {words} (drawn) lam " in " ".join(" ".join(lines).split())


def test_info_of_a_covariance_file(scan, bikestab):
    Path("cov.csv").write_text("mB,mH\n4,0.1\n0.1,0.04\n", "utf-8")
    scan("ensemble: {covariance: cov.csv, samples: 4}\n")
    assert json.loads(bikestab("info", "out/a", "--json")[1])["results"][0]["drawn"] == {}
    assert "as a file says that --config names" in bikestab("info", "out/a")[1]
    assert "cov.csv" in bikestab("info", "out/a", "--config")[1]


def test_a_probability_between_two_planes_is_that_of_the_nearest(scan, bikestab):
    scan(ENSEMBLE)
    code, out, err = bikestab("slice", "out/a", "--lam", "0.21", "--probability")
    assert (code, out) == (0, "out/a/probability_lam_0.2.png\n")
    assert err == "note: the nearest plane of the grid is drawn, lam = 0.2\n"
    code, out, err = bikestab("slice", "out/a", "--lam", "0.3", "--probability")
    assert (code, out, err) == (0, "out/a/probability_lam_0.3.png\n", "")  # the grid has 0.30000000000000004


def test_warnings_are_of_the_machines_that_are_computed(scan):
    """A centre of mass below the ground; not of the config's own machine, which is above it."""
    assert scan("sweep: {zB: [-0.9, 0.9]}\n")[2] == (
        "warning: meijaard2007: 1 of 2 machines of the sweep: "
        "the rear centre of mass is below the ground: h1 = -0.872414 m"
        "; z points down, so that zB and zH are negative\n"
    )
    more = "ensemble: {zB: {uniform: [-0.9, 1.9]}, samples: 100}\noutput: out/b\n"
    err = scan(more)[2]
    assert err.endswith(" of 100 drawn machines: the rear centre of mass is below the ground\n")
    assert 40 < int(err.split(": ")[2].split(" of ")[0]) < 90
