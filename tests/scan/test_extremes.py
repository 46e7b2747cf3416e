"""Machines at the limits: their scans end without a warning, and the ways to the critical speeds agree."""

import math
from collections import Counter

import numpy as np
import pytest
from flint import ctx

from bikestab.bicycle import Bicycle, parameters
from bikestab.config.scanconfig import ScanConfig
from bikestab.critical import critical
from bikestab.model import exact_table
from bikestab.rounding import NO_SIGN
from bikestab.routh import CONDITIONS, conditions
from bikestab.scan.agreement import AGREEMENT, size_of_terms
from bikestab.scan.crosscheck import check
from bikestab.scan.run import run_scan
from bikestab.scan.signs import violated_between
from bikestab.speeds import Intervals, intervals_of
from bikestab.volume import Volume
from tests.references import verify_speeds

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")
PRESETS = ("dikarev1981", "meijaard2007", "sharp1971", "kooijman2011")
ENDS = (1e-9, 1e-6, 1e-3, 1, 1e3, 1e6, 1e9)


def machine(rng):
    """A preset with some parameters zero, negative, far from what they were or at their limits."""
    n = Bicycle.preset(str(rng.choice(PRESETS))).numbers()
    for p in parameters():
        if p.name in ("lam", "sigma") or rng.random() > 0.3:
            continue
        check = p.metadata["check"]
        value = rng.choice(ENDS) if rng.random() < 0.5 else (n[p.name] or 1) * 10 ** rng.uniform(-4, 4)
        value *= 0 if check != "positive" and rng.random() < 0.3 else 1
        n[p.name] = -value if check == "" and rng.random() < 0.3 else value
    for i in "12":
        limit = math.sqrt(n["A" + i] * n["B" + i])
        if abs(n["D" + i]) > limit or rng.random() < 0.2:
            n["D" + i] = limit * rng.choice([-1, 0, 1])  # a thin rod is at the limit
        if n["R" + i] == 0:
            n["C" + i] = 0.0
    n["delta"] = float(rng.choice([0, 1e-12, 1e-9, 1e-6, 1e-3, 1, 1e3, 1e6]))
    return Bicycle(**{key: value if value is None else min(float(value), 1e9) for key, value in n.items()})


# Two parts of which one is 1e9 m high: so much cancels in three entries of the table (up to 2^−40 of their
# terms), and then in the products of these (2^−98 of all terms in all), that slopes tell nothing of where
# zeros are, and of 144 designs of the second some stay undecided: twice double precision has not the signs of
# their coefficients. The speeds are well conditioned, and 1600 bits tell all; what is said to be certain is.
OPEN = {
    "a high fork": {
        "c": 1.04, "m1": 1.0, "l1": 0.4, "h1": 0.9, "A1": 3.3, "B1": 0.021477638818699067, "C1": 1e-06,
        "R1": 0.04563019932424612, "m2": 2.7, "l2": 0.9, "h2": 1e9, "A2": 0.036, "B2": 0.22, "C2": 0.5,
        "R2": 0.35, "g": 9.8, "delta": 1.0,
    },
    "a deep fork": {
        "c": 1.0, "m1": 1e-06, "l1": 1e6, "h1": 399.0413820727467, "A1": 0.0, "B1": 0.0, "C1": 0.0, "R1": 0.0,
        "m2": 1000.0, "l2": 1.02, "h2": -1e9, "A2": 1e6, "B2": 4.0038083850092665, "C2": 0.0, "R2": 0.0,
        "delta": 1e-06,
    },
}  # fmt: skip


@pytest.mark.parametrize("numbers", OPEN.values(), ids=OPEN)
def test_the_conditions_decide_where_the_roots_do_not(numbers):
    """Wherever a condition is more than rounding, the mask has its sign."""
    lam, sigma, V = np.linspace(-1.2, 1.3, 12), np.linspace(-2.2, 5.8, 12), np.linspace(0, 21000, 60)
    exact = exact_table(Bicycle(**numbers), lam[:, np.newaxis], sigma).reshape(5, 4, -1)
    table, speeds = exact.value, critical(exact)
    mask, values = violated_between(table, speeds, V), conditions(table[..., np.newaxis], V)
    for bit, name in enumerate(CONDITIONS):
        value = getattr(values, name)
        clear = np.abs(value) > NO_SIGN * size_of_terms(table[..., np.newaxis], name, V)
        np.testing.assert_array_equal((mask >> bit & 1)[clear], value[clear] < 0)
    assert check(table, speeds, mask, V).largest <= AGREEMENT


@pytest.mark.parametrize(("name", "most"), [("a high fork", 0), ("a deep fork", 11)])
def test_most_of_their_speeds_are_certain(name, most):
    """Sizes of what is left of entries, and signs beside each zero, tell what those of all terms do not."""
    lam, sigma = np.linspace(-1.2, 1.3, 12), np.linspace(-2.2, 5.8, 12)
    found = critical(exact_table(Bicycle(**OPEN[name]), lam[:, np.newaxis], sigma), ["p0", "hurwitz3"])
    assert found.zeros["p0"].sure.all()
    assert np.count_nonzero(~found.zeros["hurwitz3"].sure) <= most


@pytest.mark.parametrize("name", OPEN)
def test_what_is_certain_of_them_is_so_in_1600_bits(name):
    bicycle = Bicycle(**OPEN[name])
    values = {key: x for key, x in bicycle.numbers().items() if key not in ("lam", "sigma")}
    lam, sigma = np.linspace(-1.2, 1.3, 12), np.linspace(-2.2, 5.8, 12)
    found = intervals_of(exact_table(bicycle, lam[:, np.newaxis], sigma))
    counts, ratios = Counter(), []
    with ctx.workprec(1600):
        for i, j in zip(range(12), np.arange(12) * 5 % 12, strict=True):
            cell = Intervals(*(field[i, j] for field in found.arrays().values()))
            verify_speeds.check(values, float(lam[i]), float(sigma[j]), cell, counts, ratios)
    assert counts["machines"] == 12
    assert counts["ends"] > 5
    assert not counts["WRONG STRUCTURE"] + counts["OUTSIDE"] + counts["beyond 400 bits"]


@pytest.mark.parametrize("seed", range(40))
def test_a_scan_of_an_extreme_machine(seed):
    """Pytest turns every warning of numpy into an error; a disagreement would be a ScanError."""
    rng = np.random.default_rng(seed)
    bicycle, width = machine(rng), 10 ** rng.uniform(-4, 2)
    axes = {
        "lam": np.unique([0, *rng.uniform(-1.4, 1.4, 5)]),
        "sigma": np.unique([0, *rng.uniform(-width, width, 5)]),
        "V": np.unique([0, *10 ** rng.uniform(-3, 6, 10)]),
    }
    config = ScanConfig(
        bicycle=bicycle, model=str(rng.choice(["refined", "unrefined"])), output="out",
        grid={name: {"values": values.tolist()} for name, values in axes.items()},
        fields=["stable", "violated", "growth_rate", "conditions"],
    )  # fmt: skip
    result = run_scan(config)
    with Volume(result.path) as volume:
        stable = volume.read("stable")
        assert np.array_equal(stable == 1, volume.read("violated") == 0)
        assert np.count_nonzero(stable) == result.stable_points
        V1, V2 = volume.read("V1"), volume.read("V2")
        assert np.array_equal(np.isnan(V1), np.isnan(V2))
        assert np.all(V1[~np.isnan(V1)] <= V2[~np.isnan(V2)])
