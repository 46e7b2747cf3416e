"""Several machines and several values in one picture: what is refused, and what tells them apart."""

import json
from pathlib import Path

import pytest
from bikestab_cli.over import beside, check_meanings, curves_of
from bikestab_cli.several import Chosen

from bikestab import motion as motions
from bikestab.bicycle import Bicycle
from bikestab.plot import ends, growth
from bikestab.region import nearest

BENCHMARK = ("--bicycle", "meijaard2007")
MASSES = "mB=" + ",".join(str(60 + i) for i in range(25))
OWN = ("--set", "lam=0.2", "--set", "sigma=0.08")


@pytest.mark.parametrize("command", [("vrange",), ("eigen", "--at", "5")], ids=" ".join)
def test_one_name_of_two_quantities_is_refused(bikestab, command):
    args = (*BENCHMARK, "--bicycle", "dikarev1981", "-o", "c.png")
    code, out, err = bikestab(*command, *args, "--over", "c=0.06:1.1:5")
    assert (code, out) == (2, "")
    told = "c is the trail along the ground [m] of meijaard2007, the wheelbase [m] of dikarev1981"
    assert f"--over: {told}: vary trail, sigma or offset" in err
    assert not list(Path().iterdir())
    check_meanings([Chosen(Bicycle.preset(name), {}) for name in args[1:4:2]], {"trail": [0.06], "g": [9]})


@pytest.mark.parametrize(
    "command",
    [
        ("vrange", "--set", MASSES),
        ("vrange", "--set", MASSES, "--trail", "0:0.1:5"),
        ("vrange", "--over", "mB=60:84:30", "--over", "delta=0:5:25"),
        ("eigen", "--set", MASSES, "--csv", "q.csv"),
        ("eigen", "--set", MASSES, "--shapes", "--at", "5", "--csv", "q.csv"),
        ("eigen", "--over", "mB=60:84:30", "--over", "delta=0:5:25", "--at", "5", "--csv", "q.csv"),
        ("sensitivity", "--set", MASSES, "--csv", "q.csv"),
        ("design", "--set", MASSES, "--csv", "q.csv"),
    ],
    ids=lambda command: " ".join(word for word in command if word != MASSES),
)
def test_nothing_is_written_where_curves_are_too_many(bikestab, command):
    code, out, err = bikestab(*command, *BENCHMARK, "-o", "q.png")
    assert (code, out) == (2, "")
    assert "25 curves in one picture cannot be told apart" in err
    assert not list(Path().iterdir())


def test_labels_tell_all_values_apart(bikestab, monkeypatch):
    over = ("--over", "mB=60:110:5", "--over", "delta=1:1.0002:3")
    names = [f"delta = {value} kg m²/s" for value in ("1", "1.0001", "1.0002")]
    figures = []
    for module, name in ((ends, "draw_ends"), (growth, "draw_growth_against")):
        draw = getattr(module, name)

        def kept(machines, *args, draw=draw, **more):
            figures.append([own for own, _ in machines])
            return draw(machines, *args, **more)

        monkeypatch.setattr(module, name, kept)
    for command in (("vrange",), ("eigen", "--at", "5")):
        assert bikestab(*command, *BENCHMARK, *over, "-o", "l.png")[0] == 0
    assert figures == [names, names]


def test_digits_are_those_of_both_the_values_that_are_set_and_those_that_vary():
    machine = Chosen(Bicycle.preset("meijaard2007"), {"mB": 85.0}, 5)
    over = {"delta": [1.0, 1.00000001], "mR": [2.0, 2.5, 3.0]}
    assert curves_of(over) == 2
    (first, _), (second, own) = beside(machine, over, "mR")
    assert (first, second, own.set) == ({"delta": 1.0}, {"delta": 1.00000001}, {"mB": 85.0, **second})
    assert own.digits == 9


def test_what_is_not_told_is_not_computed(bikestab, monkeypatch):
    def never(*_, **__):
        raise AssertionError

    monkeypatch.setattr(nearest, "nearest_stable", never)
    args = ("vrange", *OWN, "--set", "delta=0,1", "--set", "m1=1,2", "-o", "v.png")
    assert bikestab(*args)[0] == 0
    monkeypatch.setattr(motions, "before_a_quarter_turn", never)
    push = ("eigen", *BENCHMARK, "--push", "roll_rate=9", "--at", "5")
    assert bikestab(*push, "--json")[0] == 0


def test_the_heading_is_silent_of_a_damping_that_is_set(bikestab):
    code, out, _ = bikestab("sensitivity", *BENCHMARK, "--set", "delta=1,2")
    assert (code, out.splitlines()[0]) == (0, "refined model")


@pytest.mark.parametrize(
    "varied", [("--trail", "0:15cm:3"), ("--over", "trail=0:15cm:3"), ("--over", "mB=20:110:2")], ids=" ".join
)
def test_a_picture_has_more_values_than_the_table(bikestab, monkeypatch, varied):
    draw, drawn = ends.draw_ends, []

    def kept(machines, *args, **more):
        drawn.extend(len(answers) for _, answers in machines)
        return draw(machines, *args, **more)

    monkeypatch.setattr(ends, "draw_ends", kept)
    code, out, _ = bikestab("vrange", *BENCHMARK, *varied, "-o", "v.png", "--json")
    assert (code, len(json.loads(out)["results"])) == (0, int(varied[1][-1]))
    assert len(drawn) == 1
    assert drawn[0] >= 201


def test_rows_tell_all_values_apart(bikestab):
    for command in (("vrange",), ("eigen", "--at", "5")):
        code, out, _ = bikestab(*command, *BENCHMARK, "--over", "delta=1:1.00000002:3")
        first = [line.split()[0] for line in out.splitlines() if line.split()]
        assert code == 0
        assert [word for word in first if word[0] == "1"] == ["1", "1.00000001", "1.00000002"]
