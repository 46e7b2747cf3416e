"""How right eigenvalues are where two of them nearly meet, by 60-digit eigenvalues of the same machines.

The machines are those of ``count_names``, the polynomials those of ``generate_speeds``: nothing of bikestab
is used for what is right. The speeds are 1e-16 … 1e-2 of themselves from where two eigenvalues meet.
Run ``python -m tests.references.measure_coalescences 1000 20`` (machines, speeds of each).
"""

from __future__ import annotations

import random
import sys
from typing import Any

import numpy as np
from mpmath import mp, mpf

from bikestab.bicycle import Bicycle
from bikestab.model import ExactTable, Floats, exact_table
from bikestab.spectrum import eigenvalues_of
from bikestab.stretches import course
from tests.references.count_names import SIZES, machine
from tests.references.generate_speeds import Polynomial, polynomial, roots

DIGITS = 60


def errors(machines: int, speeds: int, seed: int = 1) -> Floats:
    """The largest error of an eigenvalue by the size of the largest one: a row for each machine."""
    rng = random.Random(seed)
    rows: list[Floats] = []
    while len(rows) < machines:
        parameters = machine((*SIZES, "skates")[len(rows) % 5], rng)
        delta = rng.choice([0.0, 10 ** rng.uniform(-3, 1)])
        bicycle = Bicycle.from_mapping(parameters).with_delta(delta)
        table = exact_table(bicycle, bicycle.lam, bicycle.sigma)
        events = [V for V, met in zip(*course(table)[::2], strict=True) if met and V < 100]
        if not events:
            continue
        V = [
            rng.choice(events) * (1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-16, -2)) for _ in range(speeds)
        ]
        with mp.workdps(DIGITS):
            exact = polynomial(parameters, mpf(bicycle.lam), mpf(bicycle.sigma), mpf(delta), "refined")
            rows.append(np.array([_error(table, exact, each) for each in V]))
    return np.array(rows)


def _error(table: ExactTable, exact: Polynomial, V: float) -> float:
    coefficients = [
        sum((x.value * mpf(V) ** j for (power, j), x in exact.items() if power == k), mpf(0))
        for k in range(5)
    ]
    right: list[Any] = roots(coefficients)
    largest = float(max(abs(s) for s in right))
    got = [mp.mpc(complex(s)) for s in eigenvalues_of(table, V)]
    distance = np.array([[float(abs(a - b)) for b in right] for a in got])
    return float(max(distance.min(axis=0).max(), distance.min(axis=1).max())) / largest


if __name__ == "__main__":
    found = errors(int(sys.argv[1]), int(sys.argv[2]), *map(int, sys.argv[3:]))
    print(f"{found.size} eigenvalue problems; largest error by the largest eigenvalue {found.max():.2e}")
    for share in (0.5, 0.9, 0.99, 0.999, 0.9999):
        print(f"{share:8.2%} within {np.quantile(found, share):.2e}")
    print(f"{np.count_nonzero(found > 2**-26)} beyond √ε = {2**-26:.3e}")
