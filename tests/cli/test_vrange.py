"""bikestab vrange: digits, JSON, ranges, and what it says about mistakes."""

import json
import math
import os
import re
import subprocess
import sys
from fractions import Fraction
from functools import partial
from pathlib import Path

import pytest
from bikestab_cli.main import main

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.plot.ends import draw_ends
from bikestab.presets import preset_text
from bikestab.region.nearest import nearest_stable

MARGINAL = """\
c: 1.3935860104502882
m1: 82.47782237325313
l1: 0.2775508685842784
h1: 0.4157738551854539
A1: 4.816143075981204
B1: 2.5323305673044088
D1: -1.1341174541130257
C1: 0.10724799617925335
R1: 0.23754874873490853
m2: 4.987453295073282
l2: 1.300092024941829
h2: 0.39091470502617587
A2: 0.5172233013084794
B2: 0.1728285139822189
D2: 0.17071755001392463
C2: 0.10285666796825092
R2: 0.2055939209940405
g: 1.62
delta: 16.747810213263357
lam: 0.09180686585229965
sigma: 0.07344122522429647
"""


@pytest.fixture
def vrange(without_warnings):
    return partial(without_warnings, "vrange")


def results(vrange, *args):
    code, out, err = vrange(*args, "--json")
    assert (code, err) == (0, "")
    return json.loads(out)


# --- results


def test_a_head_angle_in_place_of_the_tilt(bikestab):
    code, _, err = bikestab("vrange", "--bicycle", "meijaard2007", "--lam", "72deg")
    assert code == 0
    assert err == (
        "warning: λ = 72° is a head angle of 18°: lam is the tilt from the vertical; "
        "for a head angle of 72° give lam = 18deg, or head_angle\n"
    )
    assert bikestab("vrange", "--bicycle", "meijaard2007", "--lam", "18deg")[2] == ""


def test_the_benchmark_to_twelve_digits(vrange):
    code, out, err = vrange("--bicycle", "meijaard2007")
    assert (code, err) == (0, "")
    head, below, row, measured = out.splitlines()[-4:]
    assert (head.split("  ")[0], below.split("  ")[0]) == ("lam [rad]", " head [°]")
    assert row.split() == ["0.314159", "0.0784314", "4.292382536341", "6.024262015388"]
    assert measured.split() == ["72.000", "0.0800", "0.0321", "weave", "capsize"]


def test_json(vrange):
    found = results(vrange, "--lam", "0.2", "--sigma", "0.08")
    assert list(found) == ["bicycle", "model", "delta", "results"]
    assert (found["bicycle"], found["model"], found["delta"]) == ("dikarev1981", "refined", 0.0)
    (result,) = found["results"]
    assert list(result) == [
        "lam",
        "sigma",
        "head_angle_deg",
        "trail",
        "offset",
        "intervals",
        "marginal",
        "nearest",
    ]
    assert result["marginal"] is False
    assert (result["lam"], result["sigma"], result["nearest"]) == (0.2, 0.08, None)
    assert result["head_angle_deg"] == pytest.approx(90 - math.degrees(0.2))
    assert result["trail"] == pytest.approx(0.0832)
    (interval,) = result["intervals"]
    assert list(interval) == ["V1", "V2", "lower", "upper", "V1_error", "V2_error"]
    assert 0 < interval["V1_error"] < 1e-12
    assert 0 < interval["V2_error"] < 1e-12
    assert (interval["lower"], interval["upper"]) == ("weave", "capsize")
    assert interval["V1"] == pytest.approx(4.056, abs=1e-3)
    assert interval["V2"] == pytest.approx(4.636, abs=1e-3)


def test_json_has_full_precision(vrange):
    (result,) = results(vrange, "--bicycle", "meijaard2007")["results"]
    (interval,) = result["intervals"]
    assert interval["V1"] == pytest.approx(4.292382536341103803652, abs=5e-15)  # tests/references
    assert interval["V2"] == pytest.approx(6.024262015388358340853, abs=5e-15)


def test_bounds_of_the_reference_values(vrange):
    """The values of tests/references in 22 digits lie within the bounds; what is printed is certain."""
    (result,) = results(vrange, "--bicycle", "meijaard2007")["results"]
    (interval,) = result["intervals"]
    for end, digits in (("V1", "4.292382536341103803652"), ("V2", "6.024262015388358340853")):
        distance = abs(Fraction(interval[end]) - Fraction(digits))
        assert distance <= Fraction(interval[f"{end}_error"]) + Fraction(1, 10**21)


def test_what_rounding_leaves_open_is_told(vrange, tmp_path):
    """The interval is 4.4e-16 m/s wide in 80-digit arithmetic, half the gap between doubles there."""
    (tmp_path / "mine.yaml").write_text(MARGINAL, "utf-8")
    (result,) = results(vrange, "--bicycle", "mine.yaml")["results"]
    assert result["marginal"] is True
    assert result["reason"] == "the interval is narrower than two neighbouring doubles"
    assert list(result)[-3:] == ["marginal", "reason", "nearest"]
    _, out, _ = vrange("--bicycle", "mine.yaml")
    words = f"marginal at λ = {result['lam']:.6g}, σ = {result['sigma']:.6g}: {result['reason']}"
    assert words in " ".join(out.split())


def test_unbounded(vrange):
    (result,) = results(vrange, "--lam", "0.05", "--sigma", "0.15")["results"]
    (interval,) = result["intervals"]
    assert (interval["V2"], interval["V2_error"], interval["upper"]) == (None, None, "unbounded")
    _, out, _ = vrange("--lam", "0.05", "--sigma", "0.15")
    assert out.splitlines()[-2].endswith("  unbounded")
    assert out.splitlines()[-1].endswith(" weave")


def test_two_intervals_of_one_design(vrange):
    (result,) = results(vrange, "--lam", "0.04834835", "--sigma", "0.15")["results"]
    assert [(i["lower"], i["upper"]) for i in result["intervals"]] == [
        ("capsize", "weave"),
        ("weave", "unbounded"),
    ]
    _, out, _ = vrange("--lam", "0.04834835", "--sigma", "0.15")
    _, first, second, kinds = out.splitlines()[-4:]
    assert first.split()[0] == "87.230"
    assert second.split()[0].startswith("24.33366290")
    assert kinds.split() == ["weave"]


def test_no_stable_speed(vrange):
    (result,) = results(vrange, "--lam", "0.1", "--sigma", "0.08")["results"]
    assert result["intervals"] == []
    assert list(result["nearest"]) == [
        "sigma_min", "sigma_max", "lam_min", "lam_max", "V", "growth_rate",
    ]  # fmt: skip
    assert result["nearest"] == nearest_stable(Family(Bicycle.preset("dikarev1981")), 0.1, 0.08)


def test_advice_can_be_typed_in(vrange):
    """What is printed as a stable trail and stable tilts is stable, though it is rounded."""
    _, out, _ = vrange("--lam", "0.1", "--sigma", "0.08")
    assert "no stable speed" in out
    sigma = out.split("at this λ: σ = ")[1].split()[0]
    low, high = " ".join(out.split()).split("at this σ: λ = ")[1].split(" rad")[0].split(" ... ")
    for lam, trail in (("0.1", sigma), (low, "0.08"), (high, "0.08")):
        (result,) = results(vrange, "--lam", lam, "--sigma", trail)["results"]
        assert result["intervals"], (lam, trail)


def test_advice_says_what_was_searched_and_looks_both_ways(vrange):
    _, out, _ = vrange("--bicycle", "meijaard2007", "--sigma", "-0.01")
    *trails, searched, least = out.partition("\n\n")[2].partition("\n\n")[2].splitlines()
    words = " ".join(" ".join(trails).split())
    assert words.startswith("nearest stable speed at this λ: σ = -0.00")
    assert ", none below nearest stable speed at this σ: " in words
    assert searched == "searched: σ = -0.5 ... 0.5, λ = -0.2 ... 0.6 rad, V = 0 ... 50 m/s"
    assert least.startswith("least unstable at ")


def test_advice_searches_on_to_the_design(vrange):
    """Stable up to σ = 1.047, beyond the usual range; and stable at λ = 0.65, where no search goes."""
    design = ["--bicycle", "meijaard2007", "--lam", "18deg", "--sigma", "1.5"]
    found = results(vrange, *design)["results"][0]["nearest"]
    assert (found["sigma_min"], found["sigma_max"]) == (None, pytest.approx(1.047346, abs=1e-6))
    words = " ".join(vrange(*design)[1].split())
    assert "at this λ: none searched above, σ = 1.047346 below" in words
    assert "0.600000 rad (head angle 67.83 ... 55.62°), at least: the search ends at 0.6" in words
    assert "searched: σ = -0.5 ... 1.5," in words
    (beyond,) = results(vrange, "--bicycle", "meijaard2007", "--lam", "0.65", "--sigma", "1.5")["results"]
    assert beyond["intervals"]
    assert "none searched below" in " ".join(vrange(*design[:-1], "-0.7")[1].split())


def test_ranges(vrange):
    found = results(vrange, "--lam", "0.05:0.3:6", "--sigma", "0.1:0.15:2")
    pairs = [(r["lam"], r["sigma"]) for r in found["results"]]
    assert pairs == [
        (pytest.approx(lam), sigma) for lam in (0.05, 0.1, 0.15, 0.2, 0.25, 0.3) for sigma in (0.1, 0.15)
    ]
    assert pairs[-1] == (0.3, 0.15)
    _, out, _ = vrange("--lam", "0.05:0.3:6", "--sigma", "0.1:0.15:2")
    assert len(out.splitlines()) == 4 + 2 * len(pairs)
    assert "least unstable" not in out


def test_a_range_in_degrees(vrange):
    found = results(vrange, "--bicycle", "meijaard2007", "--lam", "10deg:20deg:3")["results"]
    assert [r["head_angle_deg"] for r in found] == pytest.approx([80, 75, 70])


def test_units(vrange):
    (result,) = results(vrange, "--lam", "18deg", "--sigma", "0.08")["results"]
    assert result["lam"] == pytest.approx(math.pi / 10, rel=1e-15)


def test_damping_and_model(vrange):
    damped = results(vrange, "--lam", "0.2", "--sigma", "0.08", "--delta", "2", "--model", "unrefined")
    assert (damped["delta"], damped["model"]) == (2.0, "unrefined")
    plain = results(vrange, "--lam", "0.2", "--sigma", "0.08")
    assert damped["results"][0]["intervals"] != plain["results"][0]["intervals"]
    _, out, _ = vrange("--lam", "0.2", "--sigma", "0.08", "--delta", "2")
    heading = "dikarev1981, refined model, damping 2 kg m²/s (no --bicycle: the paper's)"
    assert out.splitlines()[0] == heading


def test_a_bicycle_of_ones_own(vrange, tmp_path):
    text = preset_text("meijaard2007").replace("name: meijaard2007\n", "")
    (tmp_path / "mine.yaml").write_text(text, "utf-8")
    found = results(vrange, "--bicycle", "mine.yaml")
    assert found["bicycle"] == "mine"
    assert found["results"] == results(vrange, "--bicycle", "meijaard2007")["results"]


def test_only_a_part_is_given(vrange):
    found = results(vrange, "--bicycle", "meijaard2007", "--lam", "0.3")["results"]
    assert found[0]["sigma"] == pytest.approx(0.08 / 1.02)


# --- warnings and mistakes


def test_warnings_go_to_stderr_only(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["bikestab", "vrange", "--lam", "0.2", "--sigma", "0.08", "--json"])
    with pytest.raises(SystemExit):
        main()
    out, err = capsys.readouterr()
    json.loads(out)
    lines = err.splitlines()
    assert len(lines) == 2
    assert all(line.startswith("warning: dikarev1981: no ") for line in lines)


def test_a_sound_bicycle_has_no_warnings(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["bikestab", "vrange", "--bicycle", "meijaard2007"])
    with pytest.raises(SystemExit):
        main()
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ("--lam abc --sigma 0.1", "'abc' is not a number"),
        ("--lam 18grad --sigma 0.1", "(rad, deg, °)"),
        ("--lam 0.1 --sigma 5cm", "'5cm' is not a number"),
        ("--lam 0.1 --sigma nan", "'nan' is not a number"),
        ("--lam 1:2 --sigma 0.1", "'1:2' is neither a number nor START:STOP:NUM"),
        ("--lam 0:1:1 --sigma 0.1", "'1' in '0:1:1' is not a number of values from 2"),
        ("--lam 0:1:2.5 --sigma 0.1", "'2.5' in '0:1:2.5'"),
        ("--lam 0:1:-3 --sigma 0.1", "'-3' in '0:1:-3'"),
        ("--lam 0:x:3 --sigma 0.1", "'x' is not a number"),
        ("--lam 0:1:2:3 --sigma 0.1", "is neither a number nor START:STOP:NUM"),
        ("--lam 90deg --sigma 0.1", "does not meet the ground"),
        ("--lam 0:2:3 --sigma 0.1", "tilted by 2 rad does not meet the ground"),
        ("--lam 0.1 --sigma 0.1 --delta -1", "-1 is negative; allowed: 0 and above"),
        ("--lam 0.1 --sigma 0.1 --sd m1=1e300", "m1=1e+300 is no standard deviation; allowed: above 0 up to"),
        ("--lam 0.1 --sigma 0.1 --model fine", "'refined', 'unrefined'"),
        ("--lam 0.1 --sigma 0.1 --bicycle meijard", "did you mean 'meijaard2007'?"),
        ("--lam 0.1 --sigma 0.1 --bicycle xyzzy", "known: dikarev1981, kooijman2011, meijaard2007"),
        ("--lam 0.1 --sigma 0.1 --bicycle none.yaml", "none.yaml: there is no such file"),
        ("--lamb 0.1", "'--lam'"),
        ("0.1", "unexpected extra argument"),
        ("--sigma 0.1", "has no lam of its own: give --lam"),
        ("--lam 0.1", "has no sigma of its own: give --sigma"),
    ],
)
def test_a_mistake_is_told_in_three_lines(vrange, args, expected):
    code, out, err = vrange(*args.split())
    assert (code, out) == (2, "")
    assert err.startswith("error: ")
    assert expected in err
    assert 1 <= len(err.splitlines()) <= 3


@pytest.mark.parametrize("sigma", ["1e300", "-1e300", "1e80"])
def test_a_trail_beyond_double_precision(vrange, sigma):
    code, _, err = vrange("--lam", "0.1", f"--sigma={sigma}", "--json")
    assert code == 2
    assert err.startswith("error: ")


# --- start-up


@pytest.mark.parametrize(
    "args", [["--bicycle", "meijaard2007"], ["--lam", "0.1", "--sigma", "0.08", "--json"]]
)
def test_no_slow_import(args):
    """An answer without the packages that are slow to import."""
    script = (
        "import sys; from bikestab_cli.main import main\n"
        f"sys.argv = ['bikestab', 'vrange', *{args!r}]\n"
        "try: main()\n"
        "except SystemExit as end: assert end.code == 0\n"
        "slow = {'scipy', 'h5py', 'matplotlib', 'pydantic', 'xarray', 'yaml'} & set(sys.modules)\n"
        "assert not slow, slow\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, env=os.environ | {"PYTHONUTF8": "1"}
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "two",
    [
        ("--head-angle", "71deg", "--trail", "55mm"),
        ("--head-angle", "71deg", "--offset", "61.9453mm"),
        ("--trail", "5.5cm", "--offset", "6.19453cm"),
        ("--lam", "19deg", "--head-angle", "71deg", "--trail", "0.055", "--offset", "61.9mm"),
    ],
)
def test_what_builders_measure(vrange, two):
    """B = 0.35 sin 19° − 0.055 cos 19° = 61.945 mm, so any two of the three are one design."""
    (result,) = results(vrange, *two)["results"]
    assert list(result)[:5] == ["lam", "sigma", "head_angle_deg", "trail", "offset"]
    assert result["head_angle_deg"] == pytest.approx(71, abs=1e-4)
    assert result["trail"] == pytest.approx(0.055, abs=1e-6)
    assert result["offset"] == pytest.approx(0.061945, abs=1e-5)


def test_ranges_of_what_builders_measure(vrange):
    found = results(vrange, "--head-angle", "70deg:72deg:3", "--offset", "40mm:50mm:2")["results"]
    assert [(r["head_angle_deg"], r["offset"]) for r in found] == [
        (pytest.approx(angle), pytest.approx(offset)) for angle in (70, 71, 72) for offset in (0.04, 0.05)
    ]
    alone = results(vrange, "--bicycle", "meijaard2007", "--offset", "0:80mm:5")["results"]
    assert {r["head_angle_deg"] for r in alone} == {72}
    assert [r["offset"] for r in alone] == pytest.approx([0, 0.02, 0.04, 0.06, 0.08], abs=1e-12)


def test_three_that_contradict(bikestab):
    words = ("--head-angle", "72deg", "--offset", "45mm", "--trail", "50mm")
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", *words)
    assert (code, out) == (2, "")
    assert "offset of 45 mm give a trail of 66.4061 mm, not 50 mm; give two of" in err


def test_several_machines_in_one_table_and_json(without_warnings):
    options = ["vrange", "--bicycle", "meijaard2007", "--bicycle", "kooijman2011", "--set", "mB=60,85"]
    code, out, err = without_warnings(*options)
    assert (code, err) == (0, "")
    lines = out.splitlines()[4:]
    assert [line.split()[0] for line in lines][:4] == ["meijaard2007", "mB=60", "meijaard2007", "mB=85"]
    assert "4.292382536  " in lines[2]
    found = json.loads(without_warnings(*options, "--json")[1])
    assert found["bicycle"] == ["meijaard2007", "kooijman2011"]
    assert [(r["bicycle"], r["set"]) for r in found["results"]] == [
        (name, {"mB": mass}) for name in ("meijaard2007", "kooijman2011") for mass in (60.0, 85.0)
    ]
    alone = json.loads(without_warnings("vrange", "--bicycle", "meijaard2007", "--json")[1])
    assert found["results"][1]["intervals"] == alone["results"][0]["intervals"]
    assert "set" not in alone["results"][0]


def test_one_of_several_machines_without_a_design(bikestab):
    """The others are told of all the same, as check tells of all its files."""
    three = [word for name in ("meijaard2007", "dikarev1981", "kooijman2011") for word in ("--bicycle", name)]
    code, out, err = bikestab("vrange", *three)
    assert code == 2
    assert [word in out for word in ("4.292382536", "no tilt and trail", "2.841008323")] == [True] * 3
    assert "error: dikarev1981 has no tilt and trail of its own: give --lam and --sigma" in err
    code, out, _ = bikestab("vrange", *three, "-o", "a.png", "--json")
    found = json.loads(out)["results"]
    assert (code, [each["bicycle"] for each in found]) == (2, three[1::2])
    assert ["error" in each for each in found] == [False, True, False]
    assert [len(each["intervals"]) for each in found] == [1, 0, 1]
    assert found[1]["lam"] is None
    assert Path("a.png").stat().st_size > 1000
    code, out, err = bikestab("vrange", *three, "--lam", "0.2")
    assert (code, "dikarev1981 has no trail of its own: give --sigma, of all" in err) == (2, True)
    assert bikestab("vrange", *three, "--lam", "0.2", "--sigma", "0.08")[0] == 0
    code, out, err = bikestab("vrange", "--set", "m1=80,90")
    assert (code, out) == (2, "")
    assert "dikarev1981 m1=80, dikarev1981 m1=90 have no tilt and trail of their own" in " ".join(err.split())
    many = [word for mass in range(40, 100) for word in ("--bicycle", f"m{mass}.yaml")]
    text = bikestab("bicycles", "dikarev1981")[1]
    for name in many[1::2]:
        Path(name).write_text(text.replace("name: dikarev1981", f"name: {name[:3]}"), encoding="utf-8")
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", *many)
    lines = err[err.index("error: ") :].splitlines()
    assert (code, len(lines), max(map(len, lines)) <= 200) == (2, 3, True)
    assert "m40, m41" in err
    assert "give --lam and --sigma" in err


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("mX=60", "mX"),
        ("mB", "is not NAME=VALUE"),
        ("mB=60,", "''"),
        ("mB=-1,2", "mB: -1 is not"),
        ("mB=60 m", "kg"),
    ],
)
def test_values_that_cannot_be_set(without_warnings, text, words):
    code, out, err = without_warnings("vrange", "--bicycle", "meijaard2007", "--set", text)
    assert (code, out) == (2, "")
    assert "--set" in err
    assert words in err


# --- parameters by name


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("--sd", "cc=10mm"), "there is no parameter 'cc'; did you mean 'c'?"),
        (("--set", "riderx=2cm,3cm"), "there is no parameter 'riderx'; did you mean 'rider.x'?"),
        (("--sd", "mB=10mm"), "it is a length, not a mass"),
        (("--bicycle", "folder"), "folder: is a folder, not a file"),
    ],
)
def test_names_of_parameters_and_files(bikestab, args, message):
    Path("folder").mkdir()
    code, out, err = bikestab("vrange", *args)
    assert (code, out) == (2, "")
    assert message in err


def test_units_of_a_rider(bikestab):
    rider = "rider: {m: 75, x: 0.35, z: -1.1, Ixx: 9.6, Izz: 2.2, Ixz: -1.0}\n"
    Path("ridden.yaml").write_text(preset_text("meijaard2007") + rider, "utf-8")
    with_unit, plain = (
        bikestab("vrange", "--bicycle", "ridden.yaml", "--set", f"rider.x={text}", "--json")
        for text in ("30cm", "0.3")
    )
    assert with_unit == plain
    assert with_unit[0] == 0


def test_a_file_with_deviations_is_noted_once(bikestab):
    text = preset_text("meijaard2007").replace("mB: 85 ", "mB: 85 +/- 1 ")
    Path("measured.yaml").write_text(text, "utf-8")
    note = "note: meijaard2007: the file has standard deviations: "
    note += "--sd file tells what they leave of the digits\n"
    plain = ("vrange", "--bicycle", "measured.yaml", "--set", "mH=3,4")
    assert bikestab(*plain)[::2] == (0, note)
    assert bikestab("vrange", "--bicycle", "measured.yaml", "--sd", "file")[::2] == (0, "")


def test_a_deviation_larger_than_the_value(bikestab):
    of_trail = "warning: the standard deviation c = 10 m is larger than c = 0.08 m itself: "
    of_trail += "millimetres are written 10mm\n"
    which = "note: meijaard2007: c is the trail along the ground\n"
    assert bikestab("vrange", "--bicycle", "meijaard2007", "--sd", "c=10")[::2] == (0, which + of_trail)
    assert bikestab("vrange", "--bicycle", "meijaard2007", "--sd", "c=10mm")[::2] == (0, which)
    assert "grams are written 90g" in bikestab("vrange", "--bicycle", "meijaard2007", "--sd", "mB=90")[2]


def test_which_c_is_meant(without_warnings):
    """The trail in one notation, the wheelbase in the other."""
    changed = ("--lam", "0.3", "--set", "c=0.9,1")
    runs = (
        ("--bicycle", "meijaard2007", *changed),
        ("--bicycle", "dikarev1981", "--sigma", "0.08", *changed),
    )
    err = "".join(without_warnings("vrange", *words)[2] for words in runs)
    notes = [line for line in err.splitlines() if "c is" in line]
    assert notes == [
        "note: meijaard2007: c is the trail along the ground", "note: dikarev1981: c is the wheelbase",
    ]  # fmt: skip


def test_a_deviation_that_is_typed_stands_for_that_of_the_file(bikestab):
    text = preset_text("meijaard2007").replace("\nc: 0.08 ", "\nc: 0.08 +/- 0.01 ")
    Path("measured.yaml").write_text(text, "utf-8")
    args = ("vrange", "--bicycle", "measured.yaml", "--json", "--sd", "file", "--sd", "trail=5mm")
    code, out, err = bikestab(*args)
    assert (code, err) == (0, "")
    assert json.loads(out)["results"][0]["spread"]["deviations"] == {"trail": 0.005}


def test_a_rider_that_is_not_there(bikestab):
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", "--set", "rider.m=60,100")
    assert (code, out) == (2, "")
    assert "meijaard2007 has no rider apart; its file needs one under rider:" in err


def test_an_end_without_a_unit_takes_that_of_the_other(bikestab):
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", "--trail", "40:80mm:3", "--json")
    assert (code, err) == (0, "note: 40 in '40:80mm' is in mm\n")
    assert [r["trail"] for r in json.loads(out)["results"]] == pytest.approx([0.04, 0.06, 0.08])
    over = json.loads(
        bikestab("vrange", "--bicycle", "meijaard2007", "--over", "offset=10:80mm:2", "--json")[1]
    )
    assert [r["offset"] for r in over["results"]] == pytest.approx([0.01, 0.08])


def test_in_a_list_each_value_stands_for_itself(bikestab):
    """As in the lists of a config, whose volumes hold what it meant: one rule for both."""
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", "--set", "mB=187lb,85", "--json")
    assert [r["set"]["mB"] for r in json.loads(out)["results"]] == [84.82177319, 85]
    assert (code, err) == (0, "note: 85 has no unit, so in a list it is in SI units (mB=187lb,85)\n")
    assert bikestab("vrange", "--bicycle", "meijaard2007", "--set", "mB=60,85kg")[2] == ""


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        (["--set", "c=55mm", "--trail", "60mm"], "c is set, and --trail fixes it too; give one of them"),
        (["--set", "lam=19deg", "--head-angle", "70deg"], "lam is set, and --head-angle fixes it too"),
        (["--set", "c=55mm", "--offset", "45mm"], "c is set, and --offset fixes it too"),
        (["--set", "delta=1", "--delta", "2"], "delta is set, and --delta fixes it too"),
    ],
)
def test_what_is_said_twice(bikestab, changes, told):
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", *changes)
    assert (code, out) == (2, "")
    assert told in err


def test_a_tilt_may_be_set_beside_a_trail(bikestab):
    words = ("vrange", "--bicycle", "meijaard2007", "--trail", "55mm", "--json")
    tilts = (["--set", "lam=19deg"], ["--lam", "19deg"])
    one, other = (json.loads(bikestab(*words, *tilt)[1])["results"][0] for tilt in tilts)
    assert one["intervals"] == other["intervals"]


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (("delta=0:2:2", "--delta", "5"), "--delta fixes delta, which varies"),
        (("mB=60:110:2", "--set", "mB=1,2"), "--set fixes mB, which varies"),
        (("sigma=0.05:0.1:2", "--set", "c=0.1"), "--set fixes c, which varies"),
    ],
)
def test_what_varies_is_not_fixed_too(bikestab, args, words):
    code, out, err = bikestab("vrange", "--bicycle", "meijaard2007", "--over", *args)
    assert (code, out) == (2, "")
    assert words in err


def test_a_table_over_gains_has_80_columns(bikestab):
    args = ("--over", "k_phidot_V=-50:0:3", "--over", "k_deltadot_V=-1:0:2")
    code, out, _ = bikestab("vrange", "--bicycle", "meijaard2007", *args)
    assert code == 0
    assert max(map(len, out.splitlines())) <= 80


def test_over_with_deviations_and_as_a_picture(bikestab):
    benchmark = ("--bicycle", "meijaard2007")
    args = ("vrange", *benchmark, "--over", "mB=60:110:3", "--sd", "c=10mm", "--sd", "mB=2")
    code, out, err = bikestab(*args)
    assert (code, err) == (0, "note: meijaard2007: c is the trail along the ground\n")
    assert "mB = 85: stable speeds exist in 100.0% of machines" in out
    assert max(map(len, out.splitlines())) <= 80
    results = json.loads(bikestab(*args, "--json")[1])["results"]
    alone = json.loads(
        bikestab(*(arg for arg in args if "mB=60" not in arg and arg != "--over"), "--json")[1]
    )
    assert results[1]["spread"] == alone["results"][0]["spread"]
    assert results[0]["spread"]["V1"]["own"] < results[2]["spread"]["V1"]["own"]
    code, out, err = bikestab(*args[:3], "--over", "mB=60:110:5", "--over", "offset=0:60mm:2", "-o", "a.png")
    assert (code, out, err) == (0, "a.png\n", "")
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")
    code, out, err = bikestab(*args[:3], "--over", "m1=60:110:2", "--sd", "c=10mm")
    assert (code, out) == (2, "")
    assert "--over m1 is not of the bicycle's notation" in err
    code, out, err = bikestab(*args[:3], "--over", "mB=60:110:2", "--lam", "0.3")
    assert (code, out) == (2, "")
    assert "--over says what varies" in err


def test_a_picture_over_parameters_names_the_machine(bikestab):
    args = ("vrange", "--bicycle", "meijaard2007", "--over", "mB=60:110:3", "--over", "offset=0:60mm:2")
    assert bikestab(*args, "-o", "a.svg")[0] == 0
    assert "<!-- meijaard2007: stable speeds -->" in Path("a.svg").read_text(encoding="utf-8")


def test_a_picture_has_the_deviations(bikestab):
    args = ("vrange", "--bicycle", "meijaard2007", "--over", "mB=60:110:3", "--sd", "trail=5mm")
    known = json.loads(bikestab(*args, "--json")[1])["results"]
    drawn = draw_ends([("own", [{**each, "mB": each["over"]["mB"]} for each in known])], "mB", "mB").axes[0]
    for which in (known, [known[0]]):
        if which is not known:
            drawn = draw_ends([("own", which)], "").axes[0]
        lines = [
            sorted(set(xy.ravel())) for xy in (line.get_xydata() for line in drawn.lines) if len(xy) == 2
        ]
        for each in which:
            for end in (each["spread"]["V1"], each["spread"]["V2"]):
                assert any({end["low"], end["high"]} <= set(line) for line in lines)
    assert bikestab(*args, "-o", "a.svg")[0] == 0
    assert "<!-- 90 % of the machines -->" in Path("a.svg").read_text(encoding="utf-8")


def test_files_of_one_name_are_told_apart(bikestab):
    text = preset_text("meijaard2007")
    Path("race.yaml").write_text(text, "utf-8")
    Path("touring.yaml").write_text(text.replace("c: 0.08 ", "c: 0.07 "), "utf-8")
    three = ("--bicycle", "race.yaml", "--bicycle", "touring.yaml", "--bicycle", "meijaard2007")
    found = json.loads(bikestab("vrange", *three, "--json")[1])
    names = ["meijaard2007 (race.yaml)", "meijaard2007 (touring.yaml)", "meijaard2007"]
    assert [each["bicycle"] for each in found["results"]] == names


def test_of_several_machines_a_line_says_what_would_help_each_that_is_never_stable(bikestab):
    """The σ and the λ that it names, typed in, have a stable speed."""
    machine = ("--bicycle", "meijaard2007", "--set", "delta=0,20,100")
    code, out, err = bikestab("vrange", *machine)
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    words = " ".join(out.split())
    for delta, stable in ((0, True), (20, False), (100, False)):
        found = re.search(rf"meijaard2007 delta={delta}: nearest stable: σ = (\S+) at this λ", words)
        assert (found is None) == stable
        if found:
            typed = ("--bicycle", "meijaard2007", "--delta", str(delta), "--sigma", found[1], "--json")
            assert json.loads(bikestab("vrange", *typed)[1])["results"][0]["intervals"]
    assert words.count("least unstable at") == 2
    assert "nearest stable" not in bikestab("vrange", *machine, "--lam", "0.1:0.3:3")[1]
