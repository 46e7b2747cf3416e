"""What is given twice, or is empty, is refused and not dropped."""

import importlib
import re
import subprocess
import sys

import click
import pytest
from bikestab_cli.main import COMMANDS
from bikestab_cli.once import takes_one

from bikestab.presets import preset_text

OPTIONS = [
    (name, command, param)
    for name in COMMANDS
    for command in [importlib.import_module(f"bikestab_cli.{name}").command]
    for param in command.params
    if isinstance(param, click.Option)
]
ONCE = [(name, param) for name, _, param in OPTIONS if takes_one(param)]
WITH_VALUE = [each for each in OPTIONS if not each[2].is_flag]


def test_no_option_is_of_a_kind_that_these_tests_do_not_know():
    """Each takes one value, is a flag or may stand several times; and those of each kind are there."""
    assert all(param.nargs == 1 and not param.count for _, _, param in OPTIONS)
    assert {"--lam", "--V", "--delta", "--model", "-o", "--csv", "--junit", "--within", "--hold"} <= {
        param.opts[0] for _, param in ONCE
    }
    assert len(ONCE) > 70


@pytest.mark.parametrize(("name", "param"), ONCE, ids=lambda x: x if isinstance(x, str) else x.opts[0])
def test_an_option_of_one_value_is_typed_once(bikestab, name, param):
    """Under any of its names; what else is missing or wrong is told of later."""
    first, last = param.opts[0], param.opts[-1]
    code, out, err = bikestab(name, first, "1", last, "2")
    assert (code, out) == (2, "")
    assert err.startswith(f"error: {first} is given twice; give it once")
    assert err.endswith(f"see 'bikestab {name} --help'\n")


def test_flags_help_and_options_of_several_values_may_stand_again(bikestab):
    assert bikestab("vrange", "--lam", "0.2", "--sigma", "0.08", "--json", "--json")[0] == 0
    assert bikestab("vrange", "--lam", "0.2", "--lam", "0.1", "--help")[0] == 0
    assert "START:STOP:NUM gives several" in bikestab("vrange", "--lam", "0.2", "--lam", "0.1")[2]
    assert bikestab("design", "--V", "4", "--V", "5")[2].startswith(
        "error: --V is given twice; give it once\n"
    )


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("sensitivity --sd mB=1 --sd mB=2", "mB is given twice"),
        ("vrange --set mB=60 --set mB=70", "mB is set twice"),
        ("vrange --set mB=60,70,60.0", "mB=60 is given twice in 'mB=60,70,60.0'"),
        ("vrange --set lam=18deg,20deg,18deg", "is given twice in"),
        ("vrange --over mB=60:70:2 --over mB=60:80:3", "mB is given twice"),
        ("eigen --over mB=60:70:2 --over mB=60:80:3 --at 5", "mB is given twice"),
        ("design --free mB=60:70 --free mB=60:80", "mB is given twice"),
        ("design --certified --sd mB=1 --sd mB=2", "mB is given twice"),
        ("slice out --at delta=1 --at delta=2", "delta is given twice"),
        ("export out --at delta=1 --at delta=1", "delta is given twice"),
        ("compare a b --at delta=1 --at delta=2", "delta is given twice"),
        ("eigen --push roll=1deg --push roll=2deg", "roll is given twice"),
        ("certify --lam 0.2 --sigma 0.08 --V 4.6:5.6 --tolerance m1=1+-1 --tolerance m1=1+-2", "m1 is given"),
        ("scan a.yaml --set grid.V.num=3 --set grid.V.num=4", "grid.V.num is set already"),
        ("scan a.yaml --set grid.V.num=3 --set grid={}", "grid.V.num is set already"),
    ],
)  # fmt: skip
def test_a_name_that_is_given_two_values(without_warnings, tmp_path, words, told):
    """A key of a config below one that is set is another matter: it changes what was set."""
    (tmp_path / "a.yaml").write_text("bicycle: dikarev1981\n")
    code, out, err = without_warnings(*words.split())
    assert (code, out, told in err) == (2, "", True), err


def test_pushes_add_up(bikestab):
    """What is typed apart moves as what is typed together."""
    common = ("eigen", "--bicycle", "meijaard2007", "--at", "5", "--until", "0.5")
    code, together, _ = bikestab(*common, "--push", "roll=5deg,steer=1deg")
    assert (code, bikestab(*common, "--push", "roll=5deg", "--push", "steer=1deg")[1]) == (0, together)
    assert "roll" in together
    assert "steer" in together


@pytest.mark.parametrize(
    ("name", "command", "param"), WITH_VALUE, ids=lambda x: x.opts[0] if hasattr(x, "opts") else None
)
def test_an_option_without_its_value_is_refused_by_its_name(without_warnings, tmp_path, name, command, param):
    """As a script gives it whose variable is empty; nothing takes it for an option that is not there."""
    (tmp_path / "a.yaml").write_text("bicycle: dikarev1981\n")
    files = [
        "a.yaml" for each in command.params if isinstance(each, click.Argument) and each.required
        for _ in range(max(each.nargs, 1))
    ]  # fmt: skip
    box = ["--lam", "0.2", "--sigma", "0.1"] if param.opts[0] in ("--rider", "--tolerance") else []
    box = box if any("--lam" in each.opts for each in command.params) else []
    box += ["--V", "4:5"] if name == "certify" and box else []
    code, out, err = without_warnings(name, *files, *box, param.opts[0], "")
    assert (code, out) == (2, ""), err
    assert any(option in err for option in param.opts), err


def test_values_that_differ_late_have_labels_that_differ(bikestab):
    _, out, _ = bikestab("vrange", "--bicycle", "meijaard2007", "--set", "mB=85.0000001,85.0000002")
    assert "mB=85.0000001" in out
    assert "mB=85.0000002" in out
    _, out, _ = bikestab("vrange", "--bicycle", "meijaard2007", "--set", "mB=187lb,85")
    assert "mB=84.8218 " in out


M = "--bicycle meijaard2007"


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (f"vrange {M} --over w=0:2:3", "--over: w: 0 is not positive"),
        (f"eigen {M} --over w=0:2:5 --at 5", "--over: w: 0 is not positive"),
        (f"design {M} --over w=0:2 --over mB=60:80", "--over: w: 0 is not positive"),
        (f"design {M} --free w=0:2 --free mB=60:80", "--free: w: 0 is not positive"),
        (
            f"certify {M} --lam 0.3 --sigma 0.08 --V 4:5 --tolerance w=1+-1",
            "--tolerance: w: 0 is not positive",
        ),
        (f"sensitivity {M} --set w=0", "--set: w: 0 is not positive"),
        (f"vrange {M} --set mB=1e-5,1e9", "--set: mB: 1e+09 is too much: the rear part's m1 = 1000000002 is"),
        (f"eigen {M} --over rF=0:0.5:5 --at 5", "--over: rF: rF = 0 (a skate) cannot spin, but IFyy = 0.28"),
        (f"eigen {M} --over IBxz=0:20:5 --at 5", "allowed: |IBxz| <= 5.07543"),
        (f"vrange {M} --over delta=-1:3:3", "--over: delta: -1 is not non-negative"),
        (f"vrange {M} --over trail=0:200:3", "--over: trail: a trail of 196.078 wheelbases"),
        (f"eigen {M} --over head_angle=0:1:3 --at 5", "--over: head_angle: a steering axis tilted by 1.5708"),
        (f"sensitivity {M} --lam 2", "--lam: a steering axis tilted by 2 rad"),
    ],
)
def test_what_cannot_be_is_told_of_by_its_option_and_name(bikestab, words, told):
    """In one message, without a warning of numpy."""
    code, out, err = bikestab(*words.split())
    assert (code, out, err.count("\n")) == (2, "", 2)
    assert err.startswith("error: Invalid value for --")
    assert told in err


@pytest.mark.parametrize(
    ("words", "start", "end"),
    [
        ("check c.yaml --junit -", "<?xml", "</testsuites>"),
        (f"sensitivity {M} --csv -", "interval,", "{csv}"),
        (f"eigen {M} --V 4:5:2 --csv -", "V,branch", "{csv}"),
        (f"certify {M} --lam 0.3 --sigma 0.08 --V 4.6:4.7 -o -", '{"format"', "}"),
        ("init -", "# ", "{any}"),
    ],
)
def test_a_dash_to_write_to_is_stdout(tmp_path, words, start, end):
    """Which then has nothing but the file; no file is called -."""
    (tmp_path / "c.yaml").write_text("bicycle: meijaard2007\nexpect: [{V1: 4.292, V2: 6.024, within: 1%}]\n")
    command = [sys.executable, "-m", "bikestab", *words.split()]
    ran = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=True)
    lines = ran.stdout.strip().split("\n")
    assert lines[0].startswith(start)
    if end == "{csv}":
        assert len({line.count(",") for line in lines}) == 1
    elif end != "{any}":
        assert lines[-1].endswith(end)
    assert not (tmp_path / "-").exists()


@pytest.mark.parametrize(
    "words",
    [
        f"eigen {M} --V 4:5:2 --csv -", f"certify {M} --lam 0.3 --sigma 0.08 --V 4.6:4.7 -o -",
        f"sensitivity {M} --csv /dev/stdout", "check c.yaml --junit=-", f"design {M} --csv -",
    ],
)  # fmt: skip
def test_json_and_a_file_do_not_share_stdout(tmp_path, words):
    command = [sys.executable, "-m", "bikestab", *words.split(), "--json"]
    ran = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert (ran.returncode, ran.stdout) == (2, "")
    assert re.search(r"--json and -\S+ both go to stdout; give one of them", ran.stderr)


@pytest.mark.parametrize("words", ["vrange --bicycle -", "check -", "eigen --bicycle - --V 5", "convert -"])
def test_a_dash_to_read_from_is_stdin(tmp_path, words):
    """A config from there has its bicycle's file in the current folder."""
    (tmp_path / "b.yaml").write_text(preset_text("meijaard2007"), "utf-8")
    text = "bicycle: b.yaml\nexpect: [{V1: 4.292, V2: 6.024, within: 1%}]\n"
    given = text if words == "check -" else preset_text("meijaard2007")
    command = [sys.executable, "-m", "bikestab", *words.split()]
    ran = subprocess.run(command, input=given, capture_output=True, text=True, cwd=tmp_path, check=True)
    assert re.search(r"4\.29238|mB: 85|weave", ran.stdout)


def test_a_dash_is_no_picture_and_no_folder(bikestab):
    for words in (f"vrange {M} -o -", "reproduce -o -", "scan a.yaml --scheduler -"):
        code, out, err = bikestab(*words.split())
        assert (code, out, "'-' " in err) == (2, "", True)


def test_a_head_angle_that_is_typed_in_degrees_is_shown_in_degrees(bikestab):
    """In tables; JSON has radians, as its key says."""
    over = ("--bicycle", "meijaard2007", "--over", "head_angle=68deg:72deg:3")
    table = bikestab("vrange", *over)[1]
    assert "[rad]" not in table.replace("lam [rad]", "")
    assert re.search(r"^ +68 +0\.383972", table, re.MULTILINE)
    table = bikestab("eigen", *over, "--at", "5")[1]
    assert "head_angle [°] at 5 m/s\nstable: 68 to 72 °" in table
    assert re.search(r"^ +70 ", table, re.MULTILINE)
    box = ("--bicycle", "meijaard2007", "--over", "head_angle=68deg:74deg", "--over", "mB=60:90", "--V", "5")
    table = bikestab("design", *box)[1]
    assert "searched: head_angle = 68 ... 74 °, mB = 60 ... 90 kg" in table
    assert re.search(r"^own +72 +85 ", table, re.MULTILINE)
    assert "head_angle=68deg" in bikestab("vrange", *over[:2], "--set", "head_angle=68deg,70deg")[1]


def test_long_names_of_two_parameters_leave_80_columns(bikestab):
    names = ("--over", "k_phidot_per_V=-50:0:3", "--over", "k_deltadot_per_V=0:5:3")
    code, out, _ = bikestab("vrange", "--bicycle", "meijaard2007", *names)
    assert (code, max(map(len, out.split("\n"))) <= 80) == (0, True)
