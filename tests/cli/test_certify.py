"""bikestab certify: its verdicts, its JSON and its mistakes."""

import json
import math
import subprocess
import sys
from decimal import Decimal
from pathlib import Path

import jsonschema
import pytest
from bikestab_cli.largest import told_speeds
from bikestab_cli.schemas import SCHEMAS

import bikestab.proving as proving
from bikestab.certify import checker
from tests.plot.test_proved import CONFIG
from tests.test_proving import stopped_after

CONFIGS = Path(__file__).parents[2] / "configs"
BOX = ["--bicycle", "meijaard2007", "--lam", "17deg:19deg", "--sigma", "0.07:0.085"]
KEYS = {"verdict", "proved_stable", "proved_unstable", "undecided", "counterexample"}


@pytest.mark.parametrize(
    ("speeds", "verdict"),
    [("4.6:5.6", "stable"), ("1:3", "unstable"), ("3:8", "mixed"), ("4.29:4.3", "undecided")],
)
def test_verdicts(bikestab, speeds, verdict):
    cells = "1" if verdict == "undecided" else "16"
    code, out, _ = bikestab("certify", *BOX, "--V", speeds, "--cells", cells, "--json")
    assert code == 0
    found = json.loads(out)
    assert found.keys() >= KEYS
    assert found["verdict"] == verdict
    assert found["proved_stable"] + found["proved_unstable"] + found["undecided"] == pytest.approx(
        1, abs=1e-12
    )
    assert (found["counterexample"] is not None) == (verdict == "mixed")


@pytest.mark.parametrize(
    ("design", "same"),
    [
        (["--head-angle", "71deg:73deg"], ["--lam", "17deg:19deg"]),
        (["--trail", "71.4mm:86.7mm"], ["--sigma", "0.07:0.085"]),
    ],
)
def test_a_box_of_head_angles_and_trails(bikestab, design, same):
    """Both ways of typing the box give the same one; the angle's complement is right to the last bit."""
    other = [("--sigma", "0.08"), ("--lam", "18deg")][same[0] == "--sigma"]
    found = []
    for typed in (design, same):
        options = [*typed, *other, "--V", "4.7:5.5", "--cells", "2", "--json"]
        found.append(json.loads(bikestab("certify", "--bicycle", "meijaard2007", *options)[1]))
    for axis, ends in found[0]["box"].items():
        assert ends == pytest.approx(found[1]["box"][axis], rel=1e-15)
    assert found[0]["verdict"] == found[1]["verdict"] == "stable"


@pytest.mark.parametrize(
    ("tolerance", "same"),
    [("trail=80mm+-3mm", ["--trail", "77mm:83mm"]), ("offset=32mm±2mm", ["--offset", "30mm:34mm"])],
)
def test_tolerances_of_the_design_are_sides_of_the_box(bikestab, tolerance, same):
    """Not further dimensions: the same box, with its proof."""
    found = []
    for typed in (["--tolerance", tolerance], same):
        options = ["--head-angle", "72deg", *typed, "--V", "4.7:5.3", "--cells", "2", "--json"]
        found.append(json.loads(bikestab("certify", "--bicycle", "meijaard2007", *options)[1]))
    assert found[0]["box"].keys() == {"lam", "sigma", "V"}
    for axis, ends in found[0]["box"].items():
        assert ends == pytest.approx(found[1]["box"][axis], rel=1e-14)
    assert found[0]["verdict"] == found[1]["verdict"] == "stable"


def test_a_box_of_fork_offsets(bikestab):
    """At one tilt: b = R2 sin λ − σ w cos λ, with the benchmark's rF = 0.35 m and w = 1.02 m."""
    options = ["--head-angle", "72deg", "--offset", "30mm:35mm", "--V", "4.8:5.2", "--cells", "2", "--json"]
    box = json.loads(bikestab("certify", "--bicycle", "meijaard2007", *options)[1])["box"]
    lam = math.radians(18)
    trails = sorted((0.35 * math.sin(lam) - b) / math.cos(lam) for b in (0.03, 0.035))
    assert box["lam"] == pytest.approx([lam, lam], rel=1e-15)
    assert box["sigma"] == pytest.approx([trail / 1.02 for trail in trails], rel=1e-14)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ([], "a box needs a CONFIG"),
        (["--lam", "0.1", "--sigma", "0.1"], "--V is missing"),
        (["--lam", "1:2", "--sigma", "0.1", "--V", "1:2"], "does not meet the ground"),
        (["--lam", "0.2:0.1", "--sigma", "0.1", "--V", "1:2"], "ends before it starts"),
        (["--lam", "0.1", "--sigma", "0.1", "--V=-1:2"], "negative"),
        (["--lam", "0.1", "--sigma", "0.1", "--V", "1:2", "--tolerance", "mB=85+-2"], "no parameter 'mB'"),
        (["--lam", "0.1", "--sigma", "0.1", "--V", "1:2", "--tolerance", "m1=85"], "mB=85+-2"),
        (["--lam", "0.1", "--sigma", "0.1", "--V", "1:2", "--tolerance", "k_phi=0+-1"], "is feedback"),
        ([str(CONFIGS / "loads.yaml")], "--tolerance mB=80+-40 proves such a box"),
        ([str(CONFIGS / "steer_assist.yaml")], "the grid is over k_phidot and k_deltadot"),
        ([str(CONFIGS / "spread.yaml")], "spread.yaml: sweep: a proof is of one machine"),
        (["--lam", "0.1", "--sigma", "0.1", "--V", "1:2", "--tolerance", "m1=1+-2"], "m1"),
        (["--trail", "0.1", "--tolerance", "trail=80mm+-3mm"], "trail is given twice"),
        (["nowhere.yaml", "--tolerance", "trail=80mm+-3mm"], "says what --trail says"),
        (["--lam", "0.1", "--V", "1:2", "--tolerance", "trail=80+-3kg"], "trail=80+-3kg"),
        (["--verify", "nowhere.json"], "nowhere.json"),
        (["--verify", "/dev/zero"], "/dev/zero: is longer than 50 MB"),
        (["nowhere.yaml"], "nowhere.yaml"),
        (["nowhere.yaml", "--lam", "1"], "says what --lam says"),
        (["nowhere.yaml", "--head-angle", "71deg"], "says what --head-angle says"),
        (["--head-angle", "74deg:71deg", "--trail", "0.1", "--V", "1:2"], "--head-angle: 1.29154:1.239"),
        ([*BOX, "--V", "4.6:5", "--jobs", "100000"], "100000 processes are too many"),
        (["--lam", "0.1:0.2", "--offset", "0.03", "--V", "1:2"], "no box of tilts and trails"),
        (["--lam", "0.1", "--trail", "0.1", "--offset", "0.03", "--V", "1:2"], "give two of"),
        (["--offset", "0.03", "--V", "1:2"], "--lam is missing"),
    ],
)
def test_mistakes(bikestab, options, words):
    code, out, err = bikestab("certify", *options)
    assert (code, out) == (2, "")
    assert words in err


def test_a_certificate_is_written_and_checked(bikestab, tmp_path):
    path = tmp_path / "proof.json"
    assert bikestab("certify", *BOX, "--V", "4.8:5.2", "--cells", "2", "-o", path)[0] == 0
    code, out, _ = bikestab("certify", "--verify", path)
    assert code == 0
    for words in (
        "1 block holds, ",
        "g = 9.81,",
        "V 4.8 ... 5.2\n",
        "verdict: stable\n",
        "stable    100.0000 %",
    ):
        assert words in out
    text = path.read_text("utf-8")
    path.write_text(text.replace((4.8).hex(), (2.0).hex()), "utf-8")
    code, out, err = bikestab("certify", "--verify", path)
    assert (code, out) == (1, "")
    assert "was changed" in err
    for no_certificate in ("{}", "[" * 10**5, text.replace("blocks", "block")):
        assert no_certificate != text
        path.write_text(no_certificate, "utf-8")
        code, out, err = bikestab("certify", "--verify", path)
        assert (code, out) == (2, "")
        assert "is no certificate of bikestab" in err


def test_a_scan_draws_them_and_so_does_slice(bikestab, tmp_path):
    path = tmp_path / "scan.yaml"
    path.write_text(CONFIG.replace("OUT", str(tmp_path / "out")).replace("16", "4"))
    names = {"certified_lam_0.2.png", "certified_V_5.png"}
    assert bikestab("scan", path, "--quiet")[0] == 0
    assert not names & {each.name for each in (tmp_path / "out").iterdir()}
    for more in (["--certify"], []):  # when they are there they are drawn again
        code, out, _ = bikestab("scan", path, "--quiet", *more)
        assert (code, "5 pictures" in out) == (0, True)
        for name in names:
            (tmp_path / "out" / name).unlink()
    assert bikestab("slice", tmp_path / "out", "--sigma", "0.1", "--certified")[0] == 0
    assert (tmp_path / "out" / "certified_sigma_0.1.png").is_file()
    code, _, err = bikestab("slice", tmp_path / "out", "--V", "5", "--certified", "--probability")
    assert (code, "give one of them" in err) == (2, True)


def test_the_largest_box_of_design(bikestab, tmp_path):
    """Three ways of one question: the box as JSON, in words, and as a certificate that is proved again."""
    options = [
        "--bicycle",
        "meijaard2007",
        "--stable",
        "4.6:5.4",
        "--sd",
        "head_angle=1deg",
        "--sd",
        "trail=1cm",
    ]
    path = tmp_path / "box.json"
    code, out, _ = bikestab("design", "--certified", *options, "--certificate", path, "--json")
    answer = json.loads(out)
    (found,) = answer["results"]
    box = found["certified"]["box"]
    assert (code, answer["files"]) == (0, {"certificate": str(path)})
    assert found["certified"]["verdict"] == "stable"
    ends = [f"--{name}={low!r}:{high!r}" for name, (low, high) in box.items()]
    again = json.loads(bikestab("certify", "--bicycle", "meijaard2007", *ends, "--json")[1])
    assert (again["verdict"], again["box"]) == ("stable", box)
    certificate = json.loads(path.read_text("utf-8"))
    assert [[float.fromhex(edges[i]) for i in (0, -1)] for edges in certificate["edges"]] == list(
        box.values()
    )
    words = bikestab("design", "--certified", *options)[1]
    half = math.degrees(0.5 * (box["lam"][1] - box["lam"][0]))
    assert f"head angle 72.00 ± {math.floor(100 * half) / 100:.2f}°, trail" in words
    assert "4.600 ... 5.400 m/s" in words
    assert "larger is not" in words


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--certified", "--lam", "0.1:0.2"], "give --lam one value"),
        (["--certified", "--lam", "0.2"], "has no sigma of its own: give --sigma"),
        (["--certified", "--free", "lam=0.1:0.2"], "leave out --free"),
        (["--certified", "--bicycle", "meijaard2007", "--stable", "1:2"], "from 4.292 to 6.024 m/s"),
        (["--certified", "--bicycle", "meijaard2007", "--V", "1:2"], "a range is --stable"),
        (["--certified", "--bicycle", "meijaard2007", "--sd", "offset=1mm"], "give head_angle and trail"),
        (["--certified", "--bicycle", "meijaard2007", "--sd", "file"], "no standard deviations in its file"),
        (["--certificate", "x.json"], "is of the box that --certified finds"),
    ],
)
def test_mistakes_of_the_largest_box(bikestab, options, words):
    code, out, err = bikestab("design", *options)
    assert (code, out) == (2, "")
    assert words in err


@pytest.mark.parametrize(
    ("low", "high", "given", "words"),
    [
        (5.1, 5.1, True, "5.100 ... 5.100"),
        (4.60005, 5.4, True, "4.60005 ... 5.400"),
        (5.1, 5.1, False, "5.100 ... 5.100"),
        (4.5521, 5.7639, False, "4.553 ... 5.763"),
        (5.4, 5.6, False, "5.401 ... 5.599"),  # the doubles are above 5.4 and below 5.6, by 4e-16
        (5.09996, 5.10004, False, "5.100 ... 5.100"),
        (5.10011, 5.10019, False, "5.10011 ... 5.10018"),
        (5.4, math.nextafter(5.4, 6), False, "5.400000000000001 ... 5.400000000000001"),
    ],
)
def test_speeds_are_told_as_they_were_given_or_within(low, high, given, words):
    assert told_speeds(low, high, given=given) == words
    ends = [Decimal(text) for text in words.split(" ... ")]
    assert ends[0] <= ends[1]
    if given:
        assert [*map(float, ends)] == [low, high]
    elif low < high:
        assert Decimal(low) <= ends[0]
        assert ends[1] <= Decimal(high)


def test_the_largest_box_at_one_speed(bikestab):
    out = bikestab("design", "--certified", "--bicycle", "meijaard2007", "--stable", "5.1:5.1")[1]
    assert "5.100 ... 5.100 m/s" in out


def test_a_proof_that_is_stopped_goes_on(bikestab, tmp_path, monkeypatch):
    """Ctrl-C between two parts: what is kept is told of, and the certificate is the same in the end."""
    monkeypatch.setattr(proving, "_SIDE", 5)
    box = ["--lam", "0:0.3", "--sigma", "0:0.15", "--V", "0:15", "--cells", "10", "--jobs", "1"]
    path, parts = tmp_path / "proof.json", tmp_path / "proof.json.parts"
    with stopped_after(3):
        code, out, err = bikestab("certify", *box, "-o", path)
    assert (code, out, path.exists(), parts.exists()) == (130, "", False, True)
    assert "the same command goes on from there" in err
    assert "going on at 37 %" in bikestab("certify", *box, "-o", path)[2]
    assert not parts.exists()
    other = tmp_path / "other.json"
    assert bikestab("certify", *box, "-o", other)[0] == 0
    assert path.read_bytes() == other.read_bytes()
    out = bikestab("certify", *box, "--work", "50")[1]
    assert "stopped at the limit of --work" in out


def test_a_point_that_is_not_stable_is_told_with_its_eigenvalues(bikestab):
    options = [*BOX, "--V", "3:8", "--cells", "8"]
    point = json.loads(bikestab("certify", *options, "--json")[1])["counterexample"]
    words = bikestab("certify", *options)[1]
    (line,) = (line for line in words.splitlines() if "eigenvalues" in line)
    for real, imaginary in point["eigenvalues"]:
        assert f"{real:.4g}" in line
        assert imaginary == 0 or f"± {abs(imaginary):.4g} i" in line
    assert "twice as many --cells" in words


def test_what_is_verified_is_what_was_proved(bikestab, tmp_path):
    path = tmp_path / "proof.json"
    options = ["--lam", "18deg", "--sigma", "0.07:0.085", "--V", "4.2:5.6", "--cells", "4"]
    options += ["--bicycle", "meijaard2007", "--tolerance", "mB=85+-0.1", "-o", path, "--json"]
    proved = json.loads(bikestab("certify", *options)[1])
    verified = json.loads(bikestab("certify", "--verify", path, "--json")[1])
    jsonschema.validate(verified, SCHEMAS["certify"])
    for name in ("box", "cells", "model", "verdict", "proved_stable", "proved_unstable", "undecided"):
        assert verified[name] == proved[name]
    assert 0 < verified["undecided"] < 1
    assert verified["holds"]
    assert (verified["machine"]["w"], "mB" in verified["machine"]) == (1.02, False)
    path.write_text(path.read_text("utf-8").replace((1.02).hex(), (1.03).hex()), "utf-8")
    code, out, err = bikestab("certify", "--verify", path, "--json")
    jsonschema.validate(json.loads(out), SCHEMAS["certify"])
    assert (code, json.loads(out)["holds"]) == (1, False)
    assert json.loads(out)["reason"] in err
    alone = subprocess.run(
        [sys.executable, checker.__file__, path], capture_output=True, text=True, check=False
    )
    assert (alone.returncode, alone.stdout, alone.stderr.count("\n")) == (1, "", 1)
    assert "something in it was changed" in alone.stderr
