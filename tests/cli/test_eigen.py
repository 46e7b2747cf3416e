"""bikestab eigen: table, JSON, CSV and picture, and what it refuses."""

import csv
import json
import re
from itertools import pairwise

import click
import numpy as np
import pytest
from bikestab_cli.eigen import command
from click.testing import CliRunner
from matplotlib.colors import to_rgb

from bikestab.bicycle import Bicycle
from bikestab.errors import BikestabError
from bikestab.plot.modes import STYLES, draw_modes

BENCHMARK = ("--bicycle", "meijaard2007")
MISSING = "No such file or directory", "its folder is not there; make it: mkdir -p missing"


RECUMBENT = """\
w: 1.092
c: 0.089
lam: 0.129154
g: 9.81
rR: 0.2445
mR: 1.14
IRxx: 0.02
IRyy: 0.04
xB: 0.68151
zB: -0.39088
mB: 106.216
IBxx: 5.55605664918
IByy: 25.06012355961
IBzz: 23.52409141966
IBxz: 2.04399182523
xH: 1.0
zH: -0.604
mH: 3.17
IHxx: 0.0757714812
IHyy: 0.08696201242
IHzz: 0.01550348533
IHxz: 0.03034277154
rF: 0.2445
mF: 1.81
IFxx: 0.027
IFyy: 0.052
"""  # BicycleParameters' recumbent with rider A


def recumbent(folder):
    path = folder / "recumbent.yaml"
    path.write_text(RECUMBENT, encoding="utf-8")
    return path


def run(*args):
    result = CliRunner().invoke(command, args, standalone_mode=False)
    if result.exception:
        raise result.exception
    return result.stdout


def result(out):
    """The one result of an answer in JSON."""
    (found,) = json.loads(out)["results"]
    return found


def test_table():
    out = run(*BENCHMARK, "--V", "0:10:3")
    assert "stable from 4.292383 m/s (weave) to 6.024262 m/s (capsize)" in out
    assert "at 0.684283 m/s two real eigenvalues (real pair) become a complex pair (weave)" in out
    rows = out.splitlines()[-6:]
    assert len({len(row) for row in rows if "(" not in row}) == 1
    assert [" ".join(row.split()) for row in rows] == [
        "V weave capsize castering",
        "[m/s] [1/s] [1/s] [1/s]",
        "0 5.530944, 3.131643 -3.131643 -5.530944",
        "(real pair)",
        "5 -0.775342 ± 4.464868i -0.322866 -14.078390",
        "10 -3.720168 ± 10.906811i 0.161053 -24.624596",
    ]


def rows_of(out):
    """The cells of the table of eigenvalues, which are at least two blanks apart."""
    return [re.split(r" {2,}", line.strip()) for line in out.split("\n\n")[-1].splitlines()]


def test_table_of_what_is_neither_weave_nor_capsize_nor_castering():
    second = run("--lam", "0.1", "--sigma", "0.08", "--V", "0.5")
    assert "no stable speed" in second
    assert rows_of(second) == [
        ["V", "weave", "capsize", "castering", "others"],
        ["[m/s]", "[1/s]", "[1/s]", "[1/s]", "[1/s]"],
        ["0.5", "3.080037, 1.833694", "-2.881991 ± 0.188016i"],
        ["(real pair)", "(pair 2)"],
    ]
    mixed = run("--lam", "0.05", "--sigma", "0.15", "--V", "0")
    assert "stable from 4.806507 m/s (weave) on, without upper limit" in mixed
    assert rows_of(mixed)[2:] == [
        ["0", "-3.232112", "3.232112"], ["(real)"], ["0.000000 ± 0.922212i"], ["(pair 2)"]
    ]  # fmt: skip


def test_what_meets_and_what_is_renamed(tmp_path):
    """A recumbent whose weave is made by other branches than the pair of high speeds."""
    out = run("--bicycle", str(recumbent(tmp_path)), "--V", "7:9:3")
    assert "stable from 8.117449 m/s (weave) on, without upper limit" in out
    words = "at 6.641718 m/s two real eigenvalues (capsize, real pair) become a complex pair (weave)"
    assert words in " ".join(out.split())
    assert "9.687128" not in out  # beyond the speeds asked for
    assert rows_of(out)[2][0:2] == ["7", "0.334459 ± 0.301294i"]
    found = result(run("--bicycle", str(recumbent(tmp_path)), "--V", "7:9:3", "--json"))
    meeting = {key: found["coalescences"][2][key] for key in ("branches", "below", "above")}
    assert meeting == {"branches": [2, 0], "below": ["weave", "weave"], "above": ["capsize", "real pair"]}


def test_json():
    found = json.loads(run(*BENCHMARK, "--V", "0:36km/h:11", "--json"))
    assert {key: found[key] for key in ("bicycle", "model", "delta")} == {
        "bicycle": "meijaard2007", "model": "refined", "delta": 0.0,
    }  # fmt: skip
    (found,) = found["results"]
    assert found["head_angle_deg"] == 72.0
    assert found["trail"] == pytest.approx(0.08)
    assert found["sigma"] == pytest.approx(0.08 / 1.02)
    assert found["lam"] == pytest.approx(np.pi / 10)
    (interval,) = found["intervals"]
    assert {key: interval[key] for key in ("V1", "lower", "V2", "upper")} == {
        "V1": pytest.approx(4.29238253634111, abs=1e-12), "lower": "weave",
        "V2": pytest.approx(6.02426201538837, abs=1e-12), "upper": "capsize",
    }  # fmt: skip
    assert found["coalescences"] == [
        {"V": pytest.approx(0.68428307889246, abs=1e-12), "branches": [0, 1],
         "below": ["real pair", "real pair"], "above": ["weave", "weave"]}
    ]  # fmt: skip
    assert found["V"] == pytest.approx(list(range(11)))
    assert [b["branch"] for b in found["branches"]] == ["weave", "weave", "capsize", "castering"]
    upper, lower, capsize, castering = found["branches"]
    assert upper["name"] == lower["name"] == ["real pair"] + ["weave"] * 10
    assert (upper["re"][5], upper["im"][5]) == pytest.approx((-0.77534188219585, 4.46486771378823), abs=1e-11)
    assert lower["im"][1:] == [-x for x in upper["im"][1:]]
    assert capsize["re"][7] == pytest.approx(0.10268170574766, abs=1e-11)
    assert castering["re"][10] == pytest.approx(-24.62459635017404, abs=1e-11)


def test_unbounded_is_null_and_damping_and_model_count():
    design = ("--lam", "0.05", "--sigma", "0.15", "--json", "--V", "5")
    assert result(run(*design))["intervals"][0]["V2"] is None
    damped = json.loads(run(*design, "--delta", "1"))
    assert damped["delta"] == 1
    assert result(run(*design, "--model", "unrefined"))["intervals"] == []


def test_csv(tmp_path):
    path = tmp_path / "modes.csv"
    assert run(*BENCHMARK, "--V", "0:10:5", "--csv", str(path)) == f"{path}\n"
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    found = result(run(*BENCHMARK, "--V", "0:10:5", "--json"))
    assert len(rows) == 20
    for i, row in enumerate(rows):
        branch = found["branches"][int(row["branch"])]
        assert float(row["V"]) == found["V"][i // 4]
        assert row["name"] == branch["name"][i // 4]
        assert (float(row["re"]), float(row["im"])) == (branch["re"][i // 4], branch["im"][i // 4])
    assert [p.name for p in tmp_path.iterdir()] == ["modes.csv"]


@pytest.mark.parametrize(("ending", "magic"), [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_picture(tmp_path, ending, magic):
    path = tmp_path / f"modes.{ending}"
    assert run(*BENCHMARK, "--V", "0:10:3", "-o", str(path)) == f"{path}\n"
    assert path.read_bytes().startswith(magic)
    assert len(list(tmp_path.iterdir())) == 1


def test_one_speed_as_a_range():
    assert run(*BENCHMARK, "--V", "7:7:1") == run(*BENCHMARK, "--V", "7")


def test_several_machines(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    several = ("--bicycle", "meijaard2007", "--bicycle", "sharp1971", "--set", "g=9.81,3", "--V", "0:10:3")
    out = run(*several)
    assert max(map(len, out.splitlines())) <= 80
    assert "sharp1971 g=3: stable from 3.5" in out
    found = json.loads(run(*several, "--json"))
    assert (found["bicycle"], len(found["results"])) == (["meijaard2007", "sharp1971"], 4)
    for each in found["results"]:
        alone = ("--bicycle", each["bicycle"], "--set", f"g={each['set']['g']}", "--V", "0:10:3", "--json")
        assert result(run(*alone)) == each
    assert run(*several, "-o", "a.png", "--csv", "a.csv") == "a.csv\na.png\n"
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()))
    assert (len(rows), rows[-1]["bicycle"], rows[-1]["set"]) == (48, "sharp1971", "g=3")
    assert float(rows[-1]["re"]) == found["results"][3]["branches"][3]["re"][2]


def test_files_are_named_in_json(tmp_path):
    path = tmp_path / "modes.csv"
    assert json.loads(run(*BENCHMARK, "--csv", str(path), "--json"))["files"] == {"csv": str(path)}


@pytest.mark.parametrize(
    ("args", "says"),
    [
        (["--sigma", "0.08"], "has no lam of its own: give --lam, for example --lam 0.2"),
        (["--lam", "0.2"], "has no sigma of its own"),
        (["--lam", "2", "--sigma", "0.08"], "does not meet the ground"),
        ([*BENCHMARK, "--V", "-1:5:3"], "-1 is a speed backwards"),
        ([*BENCHMARK, "--V", "0:5"], "neither a number nor START:STOP:NUM"),
        ([*BENCHMARK, "--V", "5", "-o", "x.png"], "a picture needs a range"),
        ([*BENCHMARK, "-o", "x"], "has no ending .png, .pdf or .svg"),
        ([*BENCHMARK, "--delta", "-1"], "is negative"),
        ([*BENCHMARK, "-o", "a.png", "--csv", "a.png"], "a.png is asked for twice"),
        (["--bicycle", "nothing"], "there is no bicycle 'nothing'"),
    ],
)
def test_refused(args, says):
    with pytest.raises((click.UsageError, BikestabError)) as caught:
        run(*args)
    assert says in getattr(caught.value, "message", str(caught.value))


@pytest.mark.parametrize(
    ("option", "name", "why", "hint"),
    [
        ("-o", "missing/modes.png", *MISSING),
        ("--csv", "missing/modes.csv", *MISSING),
        ("--csv", "folder", "Is a directory", "it is a folder: name a file in it, as folder/NAME"),
    ],
)
def test_nothing_is_left_of_what_cannot_be_written(tmp_path, monkeypatch, option, name, why, hint):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    with pytest.raises(BikestabError) as caught:
        run(*BENCHMARK, option, name)
    assert str(caught.value) == f"{name}: cannot be written ({why})\n{hint}"
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


def test_a_failure_keeps_the_file_that_was_there(tmp_path, monkeypatch):
    path = tmp_path / "modes.csv"
    path.write_text("before", encoding="utf-8")

    def full(columns, blocks, part):
        part.touch()
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("bikestab.export.tables._csv", full)
    with pytest.raises(BikestabError, match=r"modes\.csv: the disk is full"):
        run(*BENCHMARK, "--csv", str(path))
    assert path.read_bytes() == b"before"
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize(
    ("lam", "sigma", "delta", "notes"),
    [
        (0.2, 0.08, 0, ["V₁ = 4.056 m/s (weave)", "V₂ = 4.636 m/s (capsize)"]),
        (0.05, 0.15, 0, ["V₁ = 4.807 m/s (weave)", "no upper limit →"]),
        (0.1, 0.08, 0, ["no stable speed"]),
        (0.015, 0.1475, 0, ["V₁ = 3.6211 m/s (capsize)", "V₂ = 3.6328 m/s (weave)"]),
        (0.1, 0.08, 1, ["V₁ = 3.302 m/s (weave)", "V₂ = 5.451 m/s (capsize)"]),
    ],
)
def test_picture_tells_the_stable_speeds(lam, sigma, delta, notes):
    figure = draw_modes(Bicycle.preset("dikarev1981").with_delta(delta), lam, sigma, 0, 10)
    (ax,) = figure.axes
    texts = [text.get_text() for text in ax.texts]
    assert [text for text in texts if text in notes] == notes
    assert {"weave", "capsize", "castering"} <= set(texts)
    assert ("stable" in [text.get_text() for text in figure.legends[0].get_texts()]) == (len(notes) == 2)


@pytest.mark.parametrize(("start", "stop", "note"), [(0, 3, "V₁ = 4.056 m/s (weave) →"),
                                                     (6, 9, "← V₂ = 4.636 m/s (capsize)"),
                                                     (4.2, 4.4, "V₂ = 4.636 m/s (capsize) →")])  # fmt: skip
def test_stable_speeds_beyond_the_picture(start, stop, note):
    (ax,) = draw_modes(Bicycle.preset("dikarev1981"), 0.2, 0.08, start, stop).axes
    assert note in [text.get_text() for text in ax.texts]


def test_colours_differ_in_greyscale():
    grey = sorted(
        np.dot(to_rgb(STYLES[n][0]), (0.299, 0.587, 0.114)) for n in ("weave", "capsize", "castering")
    )
    assert all(b - a > 0.15 for a, b in pairwise(grey))
