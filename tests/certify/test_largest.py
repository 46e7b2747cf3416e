"""The largest proved box: stable wherever it is looked at, and a little larger no more."""

import json
import math
import random
from collections import Counter
from itertools import product

import numpy as np
import pytest
from bikestab_cli.largest import _within
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.certify import checker
from bikestab.certify.largest import Around, around_design, largest_box
from bikestab.errors import InputError
from bikestab.model import exact_table
from bikestab.speeds import intervals_of
from bikestab.stability import eigenvalues
from tests.references import verify_proofs

BENCHMARK, PAPER = Bicycle.preset("meijaard2007"), Bicycle.preset("dikarev1981")
OWN = BENCHMARK.lam, BENCHMARK.sigma
DESIGN = {"head_angle": math.radians(1), "trail": 0.01}


def all_stable(found, rng, number=40):
    """Corners and random points of the box, each with the exact stable speeds of its machine."""
    box = dict(zip(("lam", "sigma", "V", *found.proof.varied), found.proof.edges, strict=True))
    V = box.pop("V")
    ends = {name: (float(edges[0]), float(edges[-1])) for name, edges in box.items()}
    points = [dict(zip(ends, at, strict=True)) for at in product(*ends.values())][:number]
    points += [{name: rng.uniform(*pair) for name, pair in ends.items()} for _ in range(number)]
    for point in points:
        lam, sigma = point.pop("lam"), point.pop("sigma")
        machine = found.around.bicycle.replaced(point) if point else found.around.bicycle
        speeds = intervals_of(exact_table(machine, lam, sigma))
        inside = (V[0] >= speeds.V1) & (V[-1] <= speeds.V2)
        assert inside.any(), (lam, sigma, point)


@pytest.mark.parametrize(
    ("bicycle", "design", "sides", "stable", "close"),
    [
        (BENCHMARK, OWN, DESIGN, None, 1.003),
        (BENCHMARK, OWN, DESIGN, (4.6, 5.4), 1.003),
        (BENCHMARK, OWN, {"lam": 0.02}, (4.6, 5.4), 1.003),
        (BENCHMARK, OWN, {"mB": 2.0, "trail": 0.005}, (4.6, 5.4), 1.003),
        (BENCHMARK, OWN, {"mB": 2.0, "xB": 0.01, "lam": 0.01}, (4.6, 5.4), 1.01),
        (PAPER, (0.2, 0.08), DESIGN, None, 1.003),
        (PAPER.with_delta(0.5), (0.2, 0.09), {"sigma": 0.01, "delta": 0.1}, None, 1.01),
    ],
)
def test_all_of_it_is_stable_and_little_more(bicycle, design, sides, stable, close):
    found = largest_box(around_design(bicycle, "refined", design, sides, stable))
    assert found.proof.verdict == "stable"
    all_stable(found, np.random.default_rng(1))
    assert found.factor < found.beyond < 1.01 * found.factor
    assert found.beyond <= found.spoiled < close * found.factor
    point = dict(found.point)
    rate, V, lam, sigma = (point.pop(name) for name in ("growth_rate", "V", "lam", "sigma"))
    machine = bicycle.replaced(point) if point else bicycle
    roots = eigenvalues(machine, V, lam=lam, sigma=sigma)
    assert roots.real.max() == pytest.approx(rate, rel=1e-6)
    assert rate > 0


def largest_of(machine):
    """The largest box around a random machine with one or two other parameters, None if it is not stable."""
    rng = random.Random(machine)
    bicycle, lam, sigma = verify_proofs.random_bicycle(rng)
    names = [k for k, v in bicycle.given.items() if v and k[0] in "mhABI" and not k.endswith("yy")]
    sides = {name: abs(bicycle.given[name]) / 100 for name in rng.sample(names, rng.choice([0, 1, 2]))}
    try:
        around = around_design(bicycle, "refined", (lam, sigma), {"sigma": 0.01, "lam": 0.02, **sides}, None)
    except InputError:  # no stable speed
        return None
    return largest_box(around)


def test_boxes_of_random_machines_in_400_bits():
    counts = Counter()
    for machine in range(8, 18):
        if found := largest_of(machine):
            counts["boxes"] += 1
            verify_proofs.compare(found.proof, random.Random(1), counts, 3)
    assert counts["boxes"] >= 4
    assert counts["points"] > 400
    assert counts["WRONG"] == 0


def test_its_proof_is_checked():
    found = largest_box(around_design(BENCHMARK, "refined", OWN, {"lam": 0.01}, (4.8, 5.2)))
    assert "hold" in checker.check(json.loads(found.proof.certificate("1")))


def test_the_speeds_are_of_the_interval_asked_for():
    """At σ = 0.15 and a small tilt the paper's bicycle has two intervals of stable speeds."""
    speeds = intervals_of(exact_table(PAPER, 0.04834835, 0.15))
    middles = 0.5 * (speeds.V1 + np.minimum(speeds.V2, 30.0))
    for V in middles[: int(speeds.number)]:
        around = around_design(PAPER, "refined", (0.04834835, 0.15), {"lam": 0.01}, None, V)
        assert around.speeds == (V, V)
    assert around_design(PAPER, "refined", (0.04834835, 0.15), {"lam": 0.01}, None).speeds[0] == max(middles)


def test_a_box_that_ends_where_machines_do():
    around = Around(BENCHMARK, "refined", *OWN, (5.0, 5.2), {"IFxx": BENCHMARK.bodies["IFxx"] / 2})
    found = largest_box(around)
    assert found.factor == pytest.approx(2, rel=0.003)
    assert "IFxx" in found.why
    assert found.point is None


@pytest.mark.parametrize(
    ("sides", "stable", "problem"),
    [
        ({"offset": 0.001}, None, "offset is no side"),
        ({"w": 0.001}, None, "w is no side"),
        ({"mb": 1.0}, None, "mb is no side"),
        ({"trail": 0.01, "sigma": 0.01}, None, "sigma is a side already"),
        ({"trail": 0.01}, (4.0, 5.0), "not stable at all speeds from 4 to 5"),
        ({"trail": 0.01}, (5.0, 7.0), "not stable at all speeds from 5 to 7"),
    ],
)
def test_mistakes(sides, stable, problem):
    with pytest.raises(InputError, match=problem):
        largest_box(around_design(BENCHMARK, "refined", OWN, sides, stable))
    with pytest.raises(InputError, match="not stable at 9 m/s"):
        around_design(BENCHMARK, "refined", OWN, {"lam": 0.01}, None, 9.0)


@settings(max_examples=300)
@given(st.floats(-1e4, 1e4), st.floats(1e-6, 1e3))
def test_printed_widths_are_within_what_is_proved(middle, half):
    low, high = middle - half, middle + half
    words = _within(low, high).split(" ± ")
    if len(words) == 2:
        about, wide = map(float, words)
        assert low - 1e-12 * abs(low) <= about - wide
        assert about + wide <= high + 1e-12 * abs(high)
        assert wide > 0.97 * half - 1e-11 * abs(middle)
