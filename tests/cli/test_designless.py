"""One of several machines has no tilt or trail of its own: the others are told of all the same."""

import csv
import json
from pathlib import Path

import pytest

from bikestab.design import best, search

THREE = [word for name in ("meijaard2007", "dikarev1981", "sharp1971") for word in ("--bicycle", name)]
NAMES = THREE[1::2]
ADVICE = "dikarev1981 has no tilt and trail of its own: give --lam and --sigma, of all machines then"
COMMANDS = [
    ("vrange",),
    ("eigen", "--V", "0:10:3"),
    ("eigen", "--shapes", "--at", "7"),
    ("eigen", "--over", "delta=0:5:3", "--at", "6"),
    ("vrange", "--over", "delta=0:5:3"),
    ("sensitivity",),
    ("sensitivity", "--of", "growth"),
]


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_the_others_are_as_without_it(bikestab, command):
    code, out, err = bikestab(*command, *THREE)
    assert code == 2
    assert ADVICE in err
    assert "no tilt and trail" in out
    assert max(map(len, out.splitlines())) <= 80
    code, out, _ = bikestab(*command, *THREE, "--json")
    results = json.loads(out)["results"]
    alone = json.loads(bikestab(*command, *THREE[:2], *THREE[4:], "--json")[1])["results"]
    assert code == 2
    assert [each for each in results if "error" not in each] == alone
    (without,) = (each for each in results if "error" in each)
    assert (without["bicycle"], without["lam"], without["intervals"]) == (NAMES[1], None, [])
    assert without["error"].startswith(ADVICE)
    assert [*dict.fromkeys(each["bicycle"] for each in results)] == NAMES


def test_files_are_of_the_others(bikestab):
    code, out, _ = bikestab("eigen", *THREE, "-o", "a.png", "--csv", "a.csv")
    assert (code, out) == (2, "a.csv\na.png\n")
    with Path("a.csv").open(encoding="utf-8", newline="") as file:
        assert {row["bicycle"] for row in csv.DictReader(file)} == {NAMES[0], NAMES[2]}
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")


def test_what_varies_is_no_lack(bikestab):
    """With the tilt of all machines given, and the trail that varies, none lacks anything."""
    args = "eigen", *THREE, "--lam", "0.2", "--at", "5", "--json"
    assert bikestab(*args, "--over", "sigma=0.05:0.1:3")[0] == 0
    code, _, err = bikestab(*args, "--over", "delta=0:5:3")
    assert (code, "dikarev1981 has no trail of its own: give --sigma, of all" in err) == (2, True)


@pytest.mark.parametrize("command", [*COMMANDS, ("design", "--certified")], ids=" ".join)
def test_one_message_names_all_that_one_machine_lacks(bikestab, command):
    if "--over" in command:
        pytest.skip("says what varies beside it")
    code, out, err = bikestab(*command)
    assert (code, out) == (2, "")
    words = "no lam and no sigma of its own: give --lam and --sigma, for example --lam 0.2 --sigma 0.08"
    assert words in err


def test_none_has_a_design(bikestab):
    for command in COMMANDS:
        code, out, err = bikestab(*command, "--set", "m1=80,90")
        assert (code, out) == (2, "")
        assert "dikarev1981 m1=80, dikarev1981 m1=90 have no tilt and trail of their own" in err


def test_a_search_over_other_parameters_needs_a_design(bikestab, monkeypatch):
    monkeypatch.setattr(best, "GRID", 11)
    monkeypatch.setattr(search, "ROUNDS", 3)
    monkeypatch.setattr(search, "ROUNDS_TOGETHER", 2)
    args = ("design", "--over", "delta=0:1", "--over", "h1=0.8:0.9")
    two = ("--bicycle", "sharp1971", "--bicycle", "dikarev1981")
    code, out, err = bikestab(*args, *two, "--csv", "a.csv")
    assert code == 2
    assert ADVICE in err
    assert "dikarev1981: no tilt and trail of its own" in out
    code, out, _ = bikestab(*args, *two, "--json")
    assert (code, ["error" in each for each in json.loads(out)["results"]]) == (2, [False, True])
    assert bikestab("design", *two, "--V", "6", "--json")[0] == 0
