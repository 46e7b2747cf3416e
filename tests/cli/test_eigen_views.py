"""bikestab eigen at one speed: mode shapes, the motion after a push, a parameter; and the root locus."""

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest

import bikestab as bs
from bikestab.against import modes_against
from bikestab.motion import motion, shapes
from bikestab.plot import files
from bikestab.plot.against import draw_against
from bikestab.plot.loci import draw_loci
from bikestab.plot.locus import draw_locus
from bikestab.plot.motion import draw_motion
from bikestab.plot.shapes import draw_shapes
from bikestab.variants import parameter_of

MASSES = "mB=" + ",".join(str(60 + i) for i in range(25))
BENCHMARK = ("--bicycle", "meijaard2007")
BIKE = bs.Bicycle.preset("meijaard2007")


def rows(name):
    with Path(name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_shapes(bikestab):
    code, out, err = bikestab("eigen", *BENCHMARK, "--shapes", "--at", "18km/h")
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    (weave,) = (line.split() for line in out.splitlines() if line.split()[:1] == ["weave"])
    found = shapes(BIKE, 5.0)
    assert weave[1:4] == ["-0.775342", "±", "4.464868i"]
    assert float(weave[4]) == pytest.approx(abs(found.phasors[0, 0]), abs=1e-6)
    assert float(weave[5]) == pytest.approx(np.degrees(np.angle(found.phasors[0, 0])), abs=1e-3)
    assert bikestab("eigen", *BENCHMARK, "--shapes", "--at", "5", "--csv", "a.csv", "-o", "a.png")[1] == (
        "a.csv\na.png\n"
    )
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")
    assert [complex(float(r["steer_re"]), float(r["steer_im"])) for r in rows("a.csv")] == [*found.phasors[1]]
    texts = [text.get_text() for text in draw_shapes([("mine", found)]).axes[1].texts]
    assert sum(text.startswith("steer 0.") for text in texts) == 1
    assert {"0.5", "1"} <= {*texts}  # of the rings


def test_the_speed_is_by_default_in_the_middle(bikestab):
    found = json.loads(bikestab("eigen", *BENCHMARK, "--shapes", "--json")[1])["results"][0]
    assert found["at"] == pytest.approx((4.292382536341 + 6.024262015388) / 2)


def test_push(bikestab):
    push = ("--push", "roll_rate=0.5", "--at", "5", "--until", "2s")
    code, out, err = bikestab("eigen", *BENCHMARK, *push)
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    found = motion(BIKE, 5.0, {"roll_rate": 0.5}, np.linspace(0, 2, 501))
    last = [line.split() for line in out.splitlines() if line.lstrip().startswith("2 ")][-1]
    assert [float(x) for x in last] == pytest.approx(
        [2, *found.states[:2, -1], found.yaw[-1], 10, found.y[-1], found.y_front[-1]], abs=1e-6
    )
    bikestab("eigen", *BENCHMARK, *push, "--csv", "a.csv")
    table = rows("a.csv")
    assert len(table) == 501
    assert [float(row["steer"]) for row in table] == found.states[1].tolist()
    assert [float(row["x_front"]) for row in table] == (found.x + BIKE.c).tolist()
    assert "the front one is 1.02 m further" in out
    assert bikestab("eigen", *BENCHMARK, "--push", "roll=2deg", "-o", "a.svg")[:2] == (0, "a.svg\n")


def test_over_a_parameter(bikestab):
    """Each value is the machine with it."""
    args = ("--over", "delta=0:5:6", "--at", "4")
    code, out, err = bikestab("eigen", *BENCHMARK, *args)
    assert (code, err) == (0, "")
    assert out.splitlines()[-6].split() == ["0", "0.413253", "±", "3.079108i", "-1.429444", "-12.158614"]
    found = json.loads(bikestab("eigen", *BENCHMARK, *args, "--json")[1])["results"]
    assert [each["over"] for each in found] == [{"delta": float(x)} for x in range(6)]
    for each in found[1::2]:
        alone = ("--set", f"delta={each['over']['delta']}", "--V", "4", "--json")
        (one,) = json.loads(bikestab("eigen", *BENCHMARK, *alone)[1])["results"]
        assert each["intervals"] == one["intervals"]
        assert [b["re"] for b in each["branches"]] == [b["re"] for b in one["branches"]]
    bikestab("eigen", *BENCHMARK, *args, "--csv", "a.csv", "-o", "a.png")
    assert [row["delta"] for row in rows("a.csv")][3:5] == ["0.0", "1.0"]


def test_over_two_parameters(bikestab):
    """For each value of the second one it is what --set of that value gives."""
    args = ("--over", "delta=0:5:2", "--at", "4.5")
    both = ("--over", "mB=80:90:3", *args, "--csv", "a.csv", "-o", "a.png", "--json")
    found = json.loads(bikestab("eigen", *BENCHMARK, *both)[1])
    for delta in (0.0, 5.0):
        one = ("--over", "mB=80:90:3", "--at", "4.5", "--set", f"delta={delta}", "--json")
        alone = json.loads(bikestab("eigen", *BENCHMARK, *one)[1])
        own = [each for each in found["results"] if each["over"]["delta"] == delta]
        assert [each["over"]["mB"] for each in own] == [80.0, 85.0, 90.0]
        assert [each["branches"] for each in own] == [each["branches"] for each in alone["results"]]
        ranges = [each["start"]["mB"] for each in found["ranges"] if each["start"]["delta"] == delta]
        assert ranges == [each["start"]["mB"] for each in alone["ranges"]]
    table = rows("a.csv")
    assert [*table[0]][:2] == ["delta", "mB"]
    assert len(table) == 6 * 4
    out = bikestab("eigen", *BENCHMARK, *both[:6])[1]
    assert [line for line in out.splitlines() if "model" in line] == [
        f"meijaard2007, refined model (delta={delta})" for delta in (0, 5)
    ]


def test_pictures_of_several_machines(bikestab):
    several = (*BENCHMARK, "--bicycle", "sharp1971")
    for args in (("--shapes", "--at", "7"), ("--push", "roll=2deg", "--at", "7"), ("--locus",)):
        assert bikestab("eigen", *several, *args, "-o", "a.png")[:2] == (0, "a.png\n")
    (ax,) = draw_loci([("a", BIKE, BIKE.lam, BIKE.sigma, "refined")] * 2, 0, 10).axes
    ends = [line.get_xydata()[0] for line in ax.lines if line.get_marker() == "o"]
    s = bs.eigenvalues(BIKE, 4.292382536341)
    assert ends[0] == pytest.approx([0, abs(s[np.argmin(abs(s.real))].imag)], abs=1e-9)
    assert ends[1][1] < 0  # capsize, among the real ones


def test_a_machine_that_falls_does_not_flatten_the_others(bikestab, monkeypatch):
    drawn = []
    monkeypatch.setattr(files, "save", lambda figure, path: drawn.append(figure))
    args = ("--bicycle", "sharp1971", "--push", "roll=0.05", "--at", "5", "--until", "20", "-o", "a.png")
    assert bikestab("eigen", *BENCHMARK, *args)[0] == 0
    roll, steer, _ = drawn[0].axes
    assert max(abs(end) for ax in (roll, steer) for end in ax.get_ylim()) < 1.2 * math.pi / 2
    ends = sorted(line.get_xdata()[-1] for line in roll.lines if len(line.get_xdata()) > 2)
    assert ends[0] < 20 == ends[1]
    assert "a curve ends at a quarter turn" in " ".join(roll.get_title().split())


def test_ranges_of_a_parameter(bikestab):
    """Their ends are where vrange of a machine there has an end at that speed, and the text tells them."""
    args = ("--over", "delta=0:5:11", "--at", "4.5", "--set", "mB=80,90")
    found = json.loads(bikestab("eigen", *BENCHMARK, *args, "--json")[1])
    assert [(each["set"], each["at"], each["start"]) for each in found["ranges"]] == [
        ({"mB": mB}, 4.5, {"delta": 0}) for mB in (80, 90)
    ]
    text = bikestab("eigen", *BENCHMARK, *args)[1]
    for each in found["ranges"]:
        delta = each["stop"]["delta"]
        assert f"stable: 0 to {delta:.10g} kg m²/s" in text
        machine = ("--set", f"mB={each['set']['mB']}", "--set", f"delta={delta!r}", "--json")
        (result,) = json.loads(bikestab("vrange", *BENCHMARK, *machine)[1])["results"]
        assert result["intervals"][0]["V1"] == pytest.approx(4.5, abs=1e-12)
    (one,) = json.loads(bikestab("eigen", *BENCHMARK, *args[:4], "--json")[1])["ranges"]
    assert one.keys() == {"at", "start", "stop"}
    assert "ranges" not in json.loads(bikestab("eigen", *BENCHMARK, "--json")[1])
    assert json.loads(bikestab("eigen", *BENCHMARK, *args[:2], "--at", "1", "--json")[1])["ranges"] == []


@pytest.mark.parametrize("name", ["lam", "head_angle", "sigma", "trail", "offset", "mB", "w", "m1"])
def test_over_any_parameter(name):
    from bikestab.variants import own_value

    own = own_value(BIKE, name)
    found = modes_against(BIKE, name, [own, own * 1.01], 5.0)
    expected = bs.modes(BIKE, [5.0]).eigenvalues[:, 0]
    assert found.modes[0].eigenvalues[:, 0] == pytest.approx(expected, rel=1e-12)
    assert np.abs(found.modes[1].eigenvalues[:, 0] - expected).max() > 1e-5


def test_a_design_beside_the_parameter(bikestab):
    code, out, _ = bikestab("eigen", "--lam", "0.2", "--sigma", "0.08", "--over", "delta=0:2:3", "--at", "4")
    assert code == 0
    assert len(out.splitlines()[-1].split()) == 6


def test_locus(bikestab):
    assert bikestab("eigen", *BENCHMARK, "--locus", "-o", "a.png")[:2] == (0, "a.png\n")
    (ax,) = draw_locus(BIKE, BIKE.lam, BIKE.sigma, 0, 10).axes
    curves = np.concatenate([line.get_xydata() for line in ax.lines])
    s = bs.eigenvalues(BIKE, 5.0)
    for each in s:
        assert np.abs(curves - [each.real, each.imag]).sum(axis=1).min() < 0.02
    assert {"0", "5", "10"} <= {text.get_text() for text in ax.texts}


@pytest.mark.parametrize("name", ["meijaard2007", "sharp1971", "kooijman2011"])
def test_arrowheads_cover_no_dot_and_no_number(name):
    bike = bs.Bicycle.preset(name)
    figure = draw_locus(bike, bike.lam, bike.sigma, 0, 10)
    figure.draw_without_rendering()
    (ax,) = figure.axes
    to_points = 72 / figure.dpi
    dots = [ax.transData.transform(x.get_xydata()[0]) * to_points for x in ax.lines if x.get_marker() == "."]
    heads = [text for text in ax.texts if not text.get_text()]
    boxes = [text.get_window_extent() for text in ax.texts if text.get_text()]
    assert len(heads) > 4
    for head in heads:
        middle = ax.transAxes.transform((np.array(head.xy) + head.xyann) / 2)
        assert np.hypot(*(np.array(dots) - middle * to_points).T).min() > 3.5
        assert not any(box.contains(*middle) for box in boxes)


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (["--push", "rol=1"], "'rol=1' is not STATE=VALUE, with one of roll, steer, roll_rate"),
        (["--push", "roll=1m"], "it is a length, not an angle"),
        (["--push", "roll_rate=5deg"], "it is an angle, not a rate"),
        (["--push", "roll=1", "--at", "1", "--until", "1000s"], "it grows beyond all numbers"),
        (["--push", "roll=1", "--until", "0"], "--until: allowed: above 0"),
        (["--shapes", "--push", "roll=1"], "give one of --shapes, --push and --over"),
        (
            [*("--over", "mB=1:2:2", "--over", "mH=1:2:2", "--over", "mF=1:2:2"), "--at", "5"],
            "for one or two",
        ),
        (
            ["--over", "delta=0:5:6", "--lam", "-5deg"],
            "has no stable interval with two ends to take the middle",
        ),
        (["--over", "lam=0.1:0.2:3", "--lam", "0.2"], "--over: lam: it varies, and is fixed too"),
        (
            ["--over", "delta=0:5:6", "--at", "4", "--locus", "-o", "x.png"],
            "picture of its own, and so is that of --over: give one of them",
        ),
        (["--over", "delt=0:5:6", "--at", "5"], "has no parameter 'delt'; did you mean 'delta'?"),
        (["--over", "delta=-1:5:6", "--at", "5"], "-1 is not non-negative"),
        (["--locus"], "--locus: it is a picture: give -o FILE"),
        (["--shapes", "--at", "-1"], "--at: -1"),
        (["--over", "delta=0:1:3", "--at", "-1"], "--at: -1 is a speed backwards"),
        (["--over", "delta=0:1:3", "--at", "1e7"], "--at: 1e+07 m/s is out of range"),
        (["--shapes", "--bicycle", "kooijman2011"], "give --at"),
    ],
)
def test_mistakes(bikestab, args, words):
    code, out, err = bikestab("eigen", *BENCHMARK, *args)
    assert (code, out) == (2, "")
    assert words in " ".join(err.split())
    assert not list(Path().iterdir())


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (["--at", "5"], "--at is for --shapes, --push and --over"),
        (["--until", "3"], "--until is for --push"),
        (["--over", "delta=0:5:3", "--at", "4", "--V", "3"], "--V is for the table along the speed"),
        (["--shapes", "--at", "5", "--until", "3"], "--until is for --push"),
        (["--push", "roll_rate=0.5,roll_rate=1", "--at", "5"], "roll_rate is given twice"),
        (["--over", "delta=0:5:3", "--at", "4", "--delta", "2"], "--delta fixes delta, which varies"),
        (["--over", "mB=60:90:3", "--at", "4", "--set", "mB=70"], "--set fixes mB, which varies"),
        (["--bicycle", "kooijman2011", "--shapes"], "kooijman2011 has no stable interval with two ends"),
        (
            ["--set", MASSES, "--over", "delta=0:5:3", "--at", "4", "-o", "d.png", "--csv", "d.csv"],
            "25 curves in one picture cannot be told apart",
        ),
    ],
)
def test_options_that_say_nothing_are_refused(bikestab, args, words):
    code, out, err = bikestab("eigen", "--bicycle", "meijaard2007", *args)
    assert (code, out) == (2, "")
    assert words in err
    assert not Path("d.csv").exists()


def test_the_heading_is_silent_of_a_damping_that_varies(bikestab):
    args = ("--bicycle", "meijaard2007", "--over", "delta=0:5:3")
    for done in (bikestab("eigen", *args, "--at", "4"), bikestab("vrange", *args)):
        assert done[0] == 0
        assert "damping" not in done[1].splitlines()[0]
    assert "damping 0 kg" in bikestab("vrange", "--bicycle", "meijaard2007", "--over", "mB=60:90:2")[1]


def test_a_head_angle_is_drawn_in_degrees():
    found = modes_against(BIKE, "head_angle", [math.radians(68), math.radians(74)], 5.0)
    (ax,) = draw_against("own", found, 5.0, parameter_of(BIKE, "head_angle")).axes
    assert ax.get_xlabel() == "head angle [°]"
    assert ax.get_xlim() == pytest.approx((68, 74))


def test_a_motion_that_a_linear_model_cannot_tell(bikestab):
    args = ("eigen", "--bicycle", "meijaard2007", "--push", "roll=5deg", "--at", "8", "--until")
    sentence = "the model is linear: beyond about 0.5 rad"
    assert sentence in bikestab(*args, "20")[1]
    assert sentence not in bikestab(*args, "1")[1]


def test_a_motion_is_drawn_until_a_quarter_turn(bikestab, monkeypatch):
    """Where it leaves the linear model is said; the table is as long as was asked."""
    drawn = []
    monkeypatch.setattr(files, "save", lambda figure, path: drawn.append(figure))
    args = ("eigen", *BENCHMARK, "--push", "roll_rate=0.5", "--at", "3.8", "--until", "30", "--csv", "a.csv")
    assert bikestab(*args, "-o", "a.png")[0] == 0
    assert float(rows("a.csv")[-1]["t"]) == 30
    top, road = drawn[0].axes
    lines = [line for line in (*top.lines, *road.lines) if len(line.get_xdata()) > 2]
    t, V = lines[0].get_xdata(), 3.8
    exact = motion(BIKE, V, {"roll_rate": 0.5}, t)
    for line, values in zip(lines, (*exact.states[:2], exact.y, exact.y_front), strict=True):
        assert line.get_ydata().tolist() == values.tolist()
    assert lines[3].get_xdata() - lines[2].get_xdata() == pytest.approx(BIKE.c)  # the front one is ahead
    size = np.abs(exact.states[:2]).max(axis=0)
    assert len(t) > 200
    assert size[:-1].max() < math.pi / 2
    assert size[-1] == pytest.approx(math.pi / 2, rel=1e-3)
    left = t[np.argmax(size > 0.5)]
    (shaded,) = top.patches
    assert shaded.get_x() == pytest.approx(left, abs=0.02)
    title = " ".join(top.get_title().split())
    assert f"leaves the linear model at {shaded.get_x():.3g} s (beyond 0.5 rad)" in title
    assert f"from a quarter turn at {t[-1]:.3g} s to 30 s" in title


def test_all_of_a_motion_is_drawn_where_angles_are_small():
    drawn = draw_motion("own", motion(BIKE, 5.0, {"roll": 0.1}, np.linspace(0, 4, 50)), 4.0, {"roll": 0.1})
    top, road = drawn.axes
    assert (top.get_xlim(), road.get_xlim()) == ((0, 4), (0, 20 + BIKE.c))
    assert not top.patches
    assert top.get_title() == "own at 5 m/s after a push: roll = 0.1 rad"


def test_curves_are_drawn_in_one_piece_however_many_values_there_are():
    """Dashes that begin anew at each value make a solid line."""
    found = modes_against(bs.Bicycle.preset("meijaard2007"), "delta", np.linspace(0, 5, 101), 4.0)
    (ax,) = draw_against("meijaard2007", found, 4.0, parameter_of(BIKE, "delta")).axes
    spans = [line.get_xdata() for line in ax.lines if len(line.get_xdata()) > 2]
    assert [(x[0], x[-1]) for x in spans] == [(0.0, 5.0)] * 4  # weave twice, capsize and castering


@pytest.mark.parametrize(
    "args",
    [
        ["--push", "roll_rate=0.5", "--at", "1", "--until", "100"],
        ["--push", "roll_rate=0.5", "--at", "0"],
        ["--push", "steer=90deg", "--at", "3"],
        ["--push", "roll=1e-9"],
        ["--push", "roll=1e-300", "--at", "8"],
        ["--shapes", "--at", "1e6"],
        ["--V", "0:1e6:3"],
        ["--over", "delta=0:1e5:3", "--at", "1e5"],
        ["--over", "mB=80:90:3", "--over", "delta=0:5:2", "--at", "1e6"],
    ],
)
def test_numbers_of_any_size_stand_in_their_columns(bikestab, args):
    """And none is zero but what is."""
    code, out, err = bikestab("eigen", *BENCHMARK, *args)
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert max(map(len, lines)) <= 80
    heads = [
        i - 1 for i, line in enumerate(lines) if line.split()[:1] in (["[s]"], ["[m/s]"], ["[kg"], ["[kg]"])
    ]
    for i in heads:
        assert lines[i].split()[0] in ("t", "V", "delta", "mB")
        assert len(lines[i + 4]) == len(lines[i])
    if "--push" in args:
        last = lines[heads[0] + 12].split()
        assert len(last) == 7
        assert lines[heads[0]].split()[-4:] == ["rear", "wheel", "front", "wheel"]
        found = motion(BIKE, *(pushed(bikestab, args)))
        values = [found.states[0, -1], found.states[1, -1], found.yaw[-1], found.y[-1], found.y_front[-1]]
        told = [float(text) for text in (*last[1:4], *last[5:])]
        assert told == pytest.approx(values, rel=5e-2, abs=2e-4 if abs(values[0]) > 1e-3 else 0)


def pushed(bikestab, args):
    (record,) = json.loads(bikestab("eigen", *BENCHMARK, *args, "--json")[1])["results"]
    return record["at"], record["push"], record["motion"]["t"]


def test_two_real_modes_of_one_name_are_told_apart(bikestab):
    out = bikestab("eigen", "--bicycle", "kooijman2011", "--shapes", "--at", "0")[1].splitlines()
    first = next(i for i, line in enumerate(out) if line.startswith("real pair"))
    assert [line.split()[0] for line in out[first : first + 4]] == ["real", "faster", "real", "slower"]
    assert float(out[first].split()[2]) > float(out[first + 2].split()[2])


def test_over_a_parameter_at_the_middle_of_the_stable_speeds(bikestab):
    """The issue's own form: each machine's before the parameter varies."""
    both = ("--bicycle", "meijaard2007", "--bicycle", "sharp1971")
    found = [bs.stable_intervals(bs.Bicycle.preset(name)) for name in both[1::2]]
    middle = [(each.V1 + each.V2) / 2 for each in found]
    out = json.loads(bikestab("eigen", *both, "--over", "delta=0:5:3", "--json", "-o", "a.svg")[1])
    assert [each["at"] for each in out["ranges"]] == pytest.approx([float(V[0]) for V in middle])
    bare = bikestab("eigen", "--over", "delta=0:5:3")
    assert bare[:2] == (2, "")
    assert "dikarev1981 has no design of its own to take the middle" in bare[2]
    text = Path("a.svg").read_text(encoding="utf-8")
    assert "at 5.158 m/s" in text
    assert "at 8.686 m/s" in text


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (["eigen", "--at", "5", "--over", "IBxz=0:20:5"], "allowed: |IBxz| <= 5.07543"),
        (
            ["eigen", "--at", "5", "--over", "rF=0:0.5:5"],
            "--over: rF: rF = 0 (a skate) cannot spin, but IFyy",
        ),
        (["vrange", "--over", "rF=0:0.5:5"], "--over: rF: rF = 0 (a skate) cannot spin, but IFyy"),
        (["design", "--over", "rF=0:0.5", "--over", "mB=60:90"], "--over: rF: rF = 0 (a skate) cannot spin"),
        (["design", "--free", "IBxz=0:20", "--free", "mB=60:90"], "--free: IBxz: |20| is more"),
        (["eigen", "--at", "5", "--over", "w=0:2:5"], "--over: w: 0 is not positive"),
        (["vrange", "--over", "w=1e-5:2:5"], "--over: w: with w = 1e-05: a trail of 8000 wheelbases"),
    ],
)
def test_a_value_that_cannot_be_is_told_by_the_name_that_was_typed(bikestab, args, words):
    code, out, err = bikestab(*args, *BENCHMARK)
    assert (code, out) == (2, "")
    assert words in " ".join(err.split())
    assert "Warning" not in err


def test_real_eigenvalues_that_would_lie_on_each_other_are_side_by_side():
    bike = bs.Bicycle.preset("kooijman2011")
    figure = draw_locus(bike, bike.lam, bike.sigma, 0, 10)
    figure.draw_without_rendering()
    (ax,) = figure.axes
    dots = [line for line in ax.lines if line.get_marker() == "."]
    places = np.array([line.get_transform().transform(line.get_xydata()[0]) for line in dots])
    axis = ax.transData.transform((0, 0))[1]
    real = [
        (line.get_xdata()[0], y) for line, (_, y) in zip(dots, places, strict=True) if not line.get_ydata()[0]
    ]
    below = sorted(x for x, y in real if y < axis - 1)
    above = sorted(x for x, y in real if y > axis + 1)
    s = {V: np.sort(bs.eigenvalues(bike, float(V)).real) for V in range(11)}
    capsize = sorted(s[V][1] for V in (0, 1, 6, 7, 8, 9, 10))  # where dots stand apart
    assert all(min(abs(x - value) for x in below) < 0.1 for value in capsize)
    assert above == pytest.approx([s[1][0], s[0][0]], abs=0.1)
    numbers = {}
    for text in ax.texts:
        if text.get_text():
            numbers.setdefault(text.get_window_extent().y0 > axis, []).append(text.get_text())
    assert sorted(numbers[True])[:4] == ["0", "0", "0", "1"]  # castering, and the real pair at rest twice
    assert {"7", "8", "9", "10"} < {*numbers[False]}
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "capsize (drawn below the axis)" in labels
    bench = draw_locus(BIKE, BIKE.lam, BIKE.sigma, 0, 10)
    assert "capsize" in [text.get_text() for text in bench.legends[0].get_texts()]


@pytest.mark.parametrize(
    "args",
    [
        "eigen --V 0:1e6:3", "eigen --V 0:1e-9:3", "eigen --V 5:5.000000000001:3 --locus",
        "eigen --V 0:1e6:3 --locus", "eigen --over delta=0:1e-12:3", "eigen --over k_phi=-1e9:1e9:3 --at 5",
        "eigen --over lam=-1.57:1.57:3 --at 5", "eigen --shapes --at 1e6",
        "eigen --push roll_rate=0.5 --at 0", "eigen --push roll=0 --at 0", "eigen --push roll=1e-12",
        "eigen --push roll=1e12 --at 0", "eigen --push steer=1e-305 --at 3",
        "eigen --push roll=0.1 --at 0 --set mB=60,85", "eigen --V 0:1e6:3 --set mB=60,85",
        "vrange --over delta=0:1e-12:3", "vrange --sigma -99:99:3", "vrange --lam 0.1",
        "vrange --set mB=60,60.0000000001",
    ],
)  # fmt: skip
def test_pictures_of_extreme_numbers_warn_of_nothing(bikestab, args):
    """Warnings are errors in these tests; each axis has a range, and the ends of it are numbers."""
    assert bikestab(*args.split(), *BENCHMARK, "-o", "a.png") == (0, "a.png\n", "")


def test_a_machine_that_stands_leaves_no_rounding_on_the_road():
    push = {"steer": 0.1}
    found = motion(BIKE, 0.0, push, np.linspace(0, 0.5, 51))
    assert set(found.y.tolist()) == {0.0}
    assert np.ptp(found.y_front) == 0
    assert found.y_front[0] == pytest.approx(-BIKE.c * BIKE.sigma * np.cos(BIKE.lam) * 0.1, rel=1e-15)
    road = draw_motion("own", motion(BIKE, 0.0, {"roll_rate": 0.5}, np.linspace(0, 0.5, 51)), 0.5, push).axes[
        1
    ]
    assert road.get_xlim() == (-0.5, BIKE.c + 0.5)
    assert road.get_ylim() == (0.5, -0.5)


@pytest.mark.parametrize("name", ["meijaard2007", "sharp1971", "kooijman2011"])
@pytest.mark.parametrize("speeds", [(0, 10), (4, 6), (0, 60)])
def test_a_speed_is_nearest_its_own_dot(name, speeds):
    bike = bs.Bicycle.preset(name)
    figure = draw_locus(bike, bike.lam, bike.sigma, *speeds)
    figure.draw_without_rendering()
    (ax,) = figure.axes
    marks = [line for line in ax.lines if line.get_marker() in (".", "o")]
    places = np.array([line.get_transform().transform(line.get_xydata()[0]) for line in marks])
    s = [complex(*line.get_xydata()[0]) for line in marks]
    texts = [text for text in ax.texts if text.get_text()[:1].isdigit()]
    assert len(texts) >= 4
    for text in texts:
        box = text.get_window_extent()
        middle, half = np.array([box.x0 + box.x1, box.y0 + box.y1]) / 2, np.array([box.width, box.height]) / 2
        ways = [np.hypot(*np.maximum(np.abs(places - middle) - size, 0).T) for size in (half, 0 * half)]
        first, second = (np.sort(away)[:2] for away in ways)  # from its edges, from its middle
        assert first[1] >= 1.5 * first[0] or second[1] >= 1.5 * second[0]
        nearest = np.argsort(ways[0] if first[1] >= 1.5 * first[0] else ways[1])
        V = float(text.get_text())
        own = bs.eigenvalues(bike, V)
        assert np.abs(own - s[nearest[0]]).min() < 0.03 * max(np.abs(own).max(), 1)


def test_the_ends_of_stable_speeds_are_marked_on_the_locus():
    (ax,) = draw_locus(BIKE, BIKE.lam, BIKE.sigma, 0, 10).axes
    rings = [tuple(line.get_xydata()[0]) for line in ax.lines if line.get_marker() == "o"]
    weave = np.abs(bs.eigenvalues(BIKE, 4.292382536341).imag).max()
    assert sorted(rings) == [pytest.approx((0, y), abs=1e-6) for y in (-weave, 0, weave)]
    assert "V₁ 4.29" in [text.get_text() for text in ax.texts]


@pytest.mark.parametrize("name", ["sharp1971", "kooijman2011"])
def test_the_locus_ends_where_the_title_says(name):
    bike = bs.Bicycle.preset(name)
    (ax,) = draw_loci([("a", bike, bike.lam, bike.sigma, "refined")] * 2, 0, 14).axes
    said = float(ax.get_title().split("left of ")[1].split()[0].replace("−", "-"))
    assert ax.get_xlim()[0] == said


def test_real_eigenvalues_of_several_machines_are_solid_and_lie_in_lanes():
    bike = bs.Bicycle.preset("kooijman2011")
    own = ("b", bike, bike.lam, bike.sigma, "refined")
    figure = draw_loci([("a", BIKE, BIKE.lam, BIKE.sigma, "refined"), own], 0, 10)
    (ax,) = figure.axes
    real = [line for line in ax.lines if len(line.get_xdata()) > 2 and max(line.get_ydata()) < 0]
    assert {line.get_linestyle() for line in real} == {"-"}
    second = [line for line in real if line.get_color() == real[-1].get_color()]
    start, turn, stop = (float(np.sort(bs.eigenvalues(bike, V).real)[1]) for V in (0.0, 3.3, 10.0))
    there = next(line for line in second if abs(line.get_xdata()[0] - start) < 1e-6)
    back = next(line for line in second if abs(line.get_xdata()[-1] - stop) < 1e-6)
    assert there.get_xdata()[-1] == pytest.approx(turn, abs=0.02) == back.get_xdata()[0]
    assert there.get_ydata()[0] != back.get_ydata()[0]
    heads = [text for text in ax.texts if not text.get_text()]
    low = ax.transAxes.inverted().transform(ax.transData.transform((0, 0)))[1]
    assert sum(head.xy[1] < low for head in heads) >= 5
