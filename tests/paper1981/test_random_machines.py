"""Random machines that could be built."""

from bikestab.paper1981.random_machines import random_machines
from tests.small import numbers


def test_random_machines_are_possible():
    first, again = (list(random_machines(30)) for _ in range(2))
    assert first == again
    assert not any(machine.warnings for machine in first)
    assert numbers(1)["random_machines"]["with_unbounded"] > 0.3
