"""Lists where one value is taken, and numbers that no double holds: both are told as they were typed."""

import math
import re
from pathlib import Path

import pytest

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.file import parse_config
from bikestab.errors import InputError
from bikestab.limits import MOST, MOST_SPEED
from bikestab.units import ANGLE, LENGTH, MASS, PURE, SPEED, quantity


def said(bikestab, *args):
    code, out, err = bikestab(*args)
    assert (code, out) == (2, "")
    return " ".join(err.split())


RANGE, ENDS = "one value or START:STOP:NUM is taken", "one value or START:STOP is taken"
LISTS = [
    (
        "vrange --trail 60mm,70mm",
        f"'60mm,70mm' is a list, where {RANGE}, e.g. 60mm:70mm:5; --set takes several",
    ),
    ("vrange --trail 60mm,70mm", "--set takes several: --set trail=60mm,70mm"),
    ("vrange --sigma 0.1,0.2,0.3", f"'0.1,0.2,0.3' is a list, where {RANGE}, e.g. 0.1:0.3:5 see"),
    ("vrange --delta 1,2,3", "one value is taken; --set takes several: --set delta=1,2,3"),
    ("eigen --V 5,6,7", f"{RANGE}, e.g. 5:7:5"),
    ("eigen --head-angle 70deg,72deg", "one value is taken; --set takes several: --set head_angle=70"),
    ("sensitivity --trail 60mm,70mm", "--set trail=60mm,70mm"),
    ("design --lam 0.1,0.2", f"{ENDS}, e.g. 0.1:0.2; --set takes several: --set lam=0.1,0.2"),
    ("slice out --V 5,6,7", "'5,6,7' is a list, where one value is taken"),
    ("certify --lam 0.1,0.2 --sigma 0 --V 5", f"{ENDS}, e.g. 0.1:0.2"),
    ("vrange --over mB=60,70", "'mB=60,70' is not NAME=START:STOP:NUM, e.g. mB=60:110:6; --set takes a list"),
    ("vrange --sd mB=1,2,3", "'mB=1,2,3' has several values, where one is taken"),
    ("slice out --at delta=1.5,2.5 --V 3", "'delta=1.5,2.5' has several values, where one is taken"),
    ("vrange --bicycle meijaard2007,dikarev1981", "is a list; give --bicycle once for each"),
    ("vrange --lam 0,1", "'0,1' is not a number: it has a comma; write '0.1'"),  # of half of Europe
]


@pytest.mark.parametrize(("args", "words"), LISTS)
def test_a_list_is_told_from_a_number_and_who_takes_it(bikestab, args, words):
    assert words in said(bikestab, *args.split())


@pytest.mark.parametrize("name", ["trail=60mm,70mm", "head_angle=70deg,72deg", "lam=0.3,0.2", "delta=1,2"])
def test_what_is_proposed_is_taken(bikestab, name):
    assert bikestab("vrange", "--bicycle", "meijaard2007", "--set", name)[0] == 0


TYPED = {
    "lam": "between -90deg and 90deg, of a head angle", "sigma": "up to 1e+09, of sigma up to 100",
    "trail": "up to 1e+09 m", "delta": "up to 1e+09 kg m²/s",
}  # fmt: skip


@pytest.mark.parametrize("name", TYPED)
@pytest.mark.parametrize("number", ["1e400", "-1e400", "9" * 350])
def test_a_number_too_large_is_named_as_typed_with_the_largest(bikestab, name, number):
    typed = number if len(number) < 9 else f"{'9' * 27} ... {'9' * 26}"
    found = said(bikestab, "vrange", f"--{name}={number}")
    assert typed in found
    assert f"is out of range; allowed: {TYPED[name]}" in found
    assert "inf" not in found


@pytest.mark.parametrize(
    "args",
    [
        "vrange --lam 0:1e400:3", "vrange --set m1=60,1e400", "vrange --over m1=1:1e400:3",
        "vrange --sd m1=1e400", "eigen --V 1e400", "compare meijaard2007 dikarev1981 --within 1e400",
        "design --sigma 0:1e400", "slice out --at delta=1e400 --V 3",

    ],
)  # fmt: skip
def test_wherever_it_is_typed(bikestab, args):
    found = said(bikestab, *args.split())
    assert re.search(r"'1e400' is out of range; allowed: .*\d", found)
    assert re.search(
        r"'1e-400' is too small: it would be 0", said(bikestab, *args.replace("1e400", "1e-400").split())
    )


BEYOND = [  # what is told of a number that no double holds, and one of the same option that is taken
    ("vrange --bicycle meijaard2007 --head-angle {}", "of a head angle between 0deg and 180deg", "100deg"),
    ("eigen --bicycle meijaard2007 --push roll={}", "no number is larger than 1.8e+308", "100deg"),
    ("eigen --bicycle meijaard2007 --push steer_rate={}", "no number is larger than 1.8e+308", "1e10"),
    ("eigen --bicycle meijaard2007 --push steer=1 --until {}", "no number is larger than 1.8e+308", "1e10"),
]
SMALL = ["vrange --lam 0.2 --sigma {}", "vrange --bicycle meijaard2007 --set mB={}"]


@pytest.mark.parametrize(("args", "words", "taken"), BEYOND)
def test_no_limit_is_told_that_does_not_hold(bikestab, args, words, taken):
    told = said(bikestab, *args.format("1e400").split())
    assert "'1e400' is out of range; " in told
    assert words in told
    assert bikestab(*args.format(taken).split())[0] == 0


@pytest.mark.parametrize("args", SMALL)
def test_no_least_number_is_told_where_there_is_none(bikestab, args):
    told = said(bikestab, *args.format("1e-400").split())
    assert "'1e-400' is too small: it would be 0; write 0 if that is meant" in told
    assert bikestab(*args.format("1e-60").split())[0] == 0


@pytest.mark.parametrize("text", ["1e400", "-1e400", "1e999999999", "123e400 ", "0.001e400"])
@pytest.mark.parametrize("units", [ANGLE, LENGTH, MASS, SPEED, PURE])
def test_no_number_becomes_infinite_or_zero(text, units):
    unit = next(iter(units), "")
    for number in (text, f"{text.strip()}{unit}", text.replace("e", "e-")):
        with pytest.raises(InputError) as caught:
            quantity(number, units)
        assert repr(number) in caught.value.problem
    assert quantity("0e999", units) == 0
    assert math.copysign(1, quantity("-0.0e-999", units)) == -1


def test_the_largest_that_is_named_is_taken():
    given = Bicycle.preset("dikarev1981").given
    assert Bicycle.from_mapping({**given, "m1": MOST}).m1 == MOST
    for text in (f"up to {MOST:g} kg", f"0 ... {MOST_SPEED:g} m/s"):
        with pytest.raises(InputError) as caught:
            quantity("1e999", MASS if "kg" in text else SPEED)
        assert caught.value.hint == f"allowed: {text}"


def test_in_a_file(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    text = """\
bicycle: {w: 1e400, c: 1e-400, mB: -1e400kg, rR: .inf}
title: 1e400
grid: {lam: {start: 1e400, stop: 1e-400, num: 1e400}, sigma: {values: [0, 1]}, V: {values: [1e400]}}
"""
    with pytest.raises(InputError) as caught:
        parse_config(yamltext.parse(text, "a.yaml"))
    problems = {".".join(map(str, each.key)): each.problem for each in caught.value.mistakes}
    assert problems == {
        "bicycle.w": "'1e400' is out of range",
        "bicycle.c": "'1e-400' is too small: it would be 0",
        "bicycle.mB": "'-1e400kg' is out of range",
        "bicycle.rR": "inf is not finite",
        "grid.lam.start": "'1e400' is out of range",
        "grid.lam.stop": "'1e-400' is too small: it would be 0",
        "grid.lam.num": "'1e400' is not a whole number",
        "grid.V.values.0": "'1e400' is out of range",
    }
    Path("b.yaml").write_text("w: 1e400\nmB: 85\n", "utf-8")
    with pytest.raises(InputError, match=r"b\.yaml, line 1: w: '1e400' is out of range"):
        Bicycle.load("b.yaml")
