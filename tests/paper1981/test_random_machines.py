"""Random machines that could be built."""

import numpy as np

from bikestab.paper1981.maps import map_designs
from bikestab.paper1981.one_design import intervals
from bikestab.paper1981.random_machines import random_machines
from tests.small import brute, numbers


def test_random_machines_are_possible():
    first, again = (list(random_machines(30)) for _ in range(2))
    assert first == again
    assert not any(machine.warnings for machine in first)
    assert numbers(1)["random_machines"]["with_unbounded"] > 0.3


def test_a_fork_bent_forwards_without_upper_limit():
    """Rare among random machines; by eigenvalues at speeds up to 10⁴ m/s."""
    machine = list(random_machines(9))[-1]
    found = map_designs(machine, 21)
    i, j = np.argwhere(found.unbounded & found.forwards)[0]
    lam, sigma = found.lam[i, 0], found.sigma[j]
    assert machine.R2 * np.sin(lam) >= sigma * machine.c * np.cos(lam)
    V1 = intervals(machine, lam, sigma)[-1].V1
    assert (brute(machine, lam, sigma, np.geomspace(1.01 * V1, 1e4, 100)) < 0).all()
