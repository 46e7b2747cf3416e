"""A few hundred hostile cases of each kind; ``python -m tests.fuzz`` runs as many as are wanted."""

import bikestab_cli.main
import click
import pytest
from hypothesis import HealthCheck, given, settings

from tests.fuzz.cases import KINDS
from tests.fuzz.commandlines import COMMANDS
from tests.fuzz.harness import Case, Hang, judged, limited

CASES = 100  # of each kind, but for those that take long
FEWER = {"damaged certificates": 25, "outputs": 30, "scans": 25}


@pytest.mark.parametrize("kind", KINDS)
def test_every_command_ends_as_it_has_to(kind):
    @settings(
        max_examples=FEWER.get(kind, CASES),
        deadline=None,
        database=None,
        derandomize=True,
        suppress_health_check=list(HealthCheck),
    )
    @given(KINDS[kind])
    def check(case):
        judged(case)

    check()


ELSEWHERE = {"scan", "slice", "reproduce"}  # of the kinds "scans" and "outputs"; reproductions take minutes
LONG = {("export", "--mesh")}  # among "outputs", with few cells


def test_command_lines_know_every_option():
    context = click.Context(bikestab_cli.main.cli)
    there = {
        (name, option.opts[0])
        for name in set(bikestab_cli.main.COMMANDS) - ELSEWHERE
        for option in bikestab_cli.main.cli.get_command(context, name).params
        if isinstance(option, click.Option)
    }
    assert there - LONG == {(name, option) for name, (_, options) in COMMANDS.items() for option in options}


@pytest.mark.parametrize("error", [ZeroDivisionError("no such luck"), RuntimeWarning("of numpy")])
def test_what_the_judge_would_say_of_a_mistake(monkeypatch, error):
    def broken(name):
        raise error

    monkeypatch.setattr("bikestab.bicycle.Bicycle.load", broken)
    with pytest.raises(AssertionError, match="a mistake of bikestab itself"):
        judged(Case(("vrange",)))


def test_the_clock():
    def for_ever():
        while True:
            pass

    with pytest.raises(Hang), limited(0.05):
        for_ever()
