"""A few hundred hostile cases of each kind; ``python -m tests.fuzz`` runs as many as are wanted."""

import pytest
from hypothesis import HealthCheck, given, settings

from tests.fuzz.cases import KINDS
from tests.fuzz.harness import Case, Hang, judged, limited

CASES = 100  # of each kind, but for those that take long
FEWER = {"damaged certificates": 25, "outputs": 30}


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
