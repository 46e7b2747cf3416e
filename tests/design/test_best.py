"""The best designs: against grids finer than the search's own, and against eigenvalues of matrices."""

import functools
import math
from itertools import pairwise

import numpy as np
import pytest

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.design import best as module
from bikestab.design.best import best_designs
from bikestab.design.criteria import Wanted
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.model import canonical_matrices, characteristic_table
from bikestab.presets import preset_text
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of

N = 400  # grid of the issue: no design of it may beat what is found


def _benchmark_with(**changes):
    values = {k: v for k, v in yamltext.parse(preset_text("meijaard2007"), "x").data.items() if k != "source"}
    return Bicycle.from_mapping(values | changes, name="changed")


DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
MOTORCYCLE = _benchmark_with(
    w=1.45, rR=0.31, mR=16, IRxx=0.4, IRyy=0.75, xB=0.62, zB=-0.65, mB=230, IBxx=14, IByy=35, IBzz=24,
    IBxz=3, xH=1.25, zH=-0.65, mH=13, IHxx=1.2, IHyy=1, IHzz=0.4, IHxz=-0.2, rF=0.31, mF=12, IFxx=0.35,
    IFyy=0.65, name="motorcycle",
)  # fmt: skip
# a rider on wheels of little spin: two bodies, each with a product of inertia
LIGHT = Bicycle.from_mapping(
    {"c": 1.1, "g": 9.81, "m1": 60, "l1": 0.45, "h1": 1.0, "A1": 5, "B1": 3, "D1": 0.5, "C1": 0.05, "R": 0.3,
     "m2": 5, "l2": 1.0, "h2": 0.6, "A2": 0.3, "B2": 0.2, "D2": 0.02, "C2": 0.04, "delta": 0},
    name="light",
)  # fmt: skip
CASES = {
    "dikarev1981": Wanted(Family(DIKAREV)),
    "meijaard2007": Wanted(Family(MEIJAARD), judged=(5.0, 5.0)),
    "damped": Wanted(Family(DIKAREV.with_delta(1.0)), judged=(4.0, 6.0)),
    "light": Wanted(Family(LIGHT), x=(-0.1, 0.5), V_max=20.0),
    "motorcycle": Wanted(
        Family(MOTORCYCLE), x=(0.2, 0.6), trail=(0.02, 0.2), judged=(5.0, 7.0), stable=(6.0, 6.5)
    ),
}


found = functools.cache(best_designs)


@pytest.fixture(scope="module", params=CASES)
def case(request):
    """What was wanted and found, and widths, lowest V1 and growth rates on the grid of N × N designs."""
    wanted = CASES[request.param]
    return wanted, found(wanted), _on_grid(request.param)


@functools.cache
def _on_grid(name):
    wanted = CASES[name]
    c = wanted.family.bicycle.c
    low, high = wanted.y
    if wanted.trail:
        low, high = max(low, wanted.trail[0] / c), min(high, wanted.trail[1] / c)
    lam, sigma = np.linspace(*wanted.x, N)[:, None], np.linspace(low, high, N)
    table = characteristic_table(wanted.family.bicycle, lam, sigma)
    V1, V2, *_ = intervals_of(table)
    A, B = wanted.stable or (np.inf, 0.0)
    counts = (wanted.V_max > V1) & (V1 <= A) & (V2 >= B)
    width = np.where(counts, np.minimum(V2, wanted.V_max) - V1, 0).max(axis=-1)
    first = np.where(counts, V1, np.inf).min(axis=-1)
    if wanted.judged:
        rates = [growth_rate_of(table, V) for V in np.linspace(*wanted.judged, 5)]
        growth = np.max(rates, axis=0)
    else:
        growth = np.min([growth_rate_of(table, V) for V in np.linspace(1, wanted.V_max, 21)], axis=0)
    growth = np.where(width > 0, growth, np.inf)
    return width, first, growth


def largest_real_part(wanted, design, V):
    """By a matrix of the equations of motion instead of the polynomial."""
    M, C1, K0, K2 = canonical_matrices(
        wanted.family.bicycle, design["lam"], design["sigma"], model=wanted.family.model
    )
    damping = V * C1 + np.array([[0, 0], [0, wanted.family.bicycle.delta]])
    stiffness = wanted.family.bicycle.g * K0 + V**2 * K2
    inverse = np.linalg.inv(M)
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-inverse @ stiffness, -inverse @ damping]])
    return np.linalg.eigvals(A).real.max()


# --- no design of a finer grid is better


def test_each_case_has_something_to_find(case):
    _, best, (width, _, growth) = case
    assert best.closest is None
    assert (width > 0).any()
    assert (growth < 0).any()


def test_widest(case):
    _, best, (width, _, _) = case
    assert best.widest["width"] >= width.max()


def test_lowest(case):
    _, best, (_, first, _) = case
    assert best.lowest_V1["V1"] <= first.min()


def test_fastest(case):
    _, best, (_, _, growth) = case
    assert best.fastest_decay["growth_rate"] <= growth.min()


def test_front_is_not_dominated(case):
    _, best, (width, _, growth) = case
    front = [(d["width"], d["growth_rate"]) for d in best.pareto]
    assert len(front) > 5
    assert front == sorted(front, reverse=True)
    assert all(b[1] < a[1] and b[0] < a[0] for a, b in pairwise(front))
    for wide, rate in front:
        assert not np.any((width >= wide) & (growth <= rate) & ((width > wide) | (growth < rate)))


def test_ends_of_the_front(case):
    wanted, best, _ = case
    assert best.pareto[-1]["growth_rate"] == pytest.approx(best.fastest_decay["growth_rate"], abs=1e-9)
    if best.widest["growth_rate"] < 0:
        assert best.pareto[0]["width"] == pytest.approx(best.widest["width"], abs=1e-9)
    else:  # the widest is not stable where decay is judged
        assert wanted.judged
        assert -1e-6 < best.pareto[0]["growth_rate"] < 0


# --- what is said of a design is true


def test_intervals_by_eigenvalues(case):
    wanted, best, _ = case
    for design in (best.widest, best.fastest_decay, *best.pareto):
        V1, V2 = design["V1"], math.inf if design["V2"] is None else design["V2"]
        step = 1e-4 * V1
        assert largest_real_part(wanted, design, V1 + step) < 0 < largest_real_part(wanted, design, V1 - step)
        if math.inf > V2:
            assert (
                largest_real_part(wanted, design, V2 - step)
                < 0
                < largest_real_part(wanted, design, V2 + step)
            )
        inside = np.linspace(V1 + step, min(V2, 3 * wanted.V_max) - step, 30)
        near_double = [V for V in inside if largest_real_part(wanted, design, V) >= 1e-6]
        assert not near_double
        assert design["width"] == min(V2, wanted.V_max) - V1


def test_growth_by_eigenvalues(case):
    wanted, best, _ = case
    for design in (best.widest, best.fastest_decay, *best.pareto):
        rate = design["growth_rate"]
        assert rate == pytest.approx(largest_real_part(wanted, design, design["V"]), abs=1e-6)
        if wanted.judged:
            others = [largest_real_part(wanted, design, V) for V in np.linspace(*wanted.judged, 20)]
            assert max(others) <= rate + 1e-6
        else:
            top = min(design["V2"] or math.inf, wanted.V_max)
            others = [largest_real_part(wanted, design, V) for V in np.linspace(design["V1"], top, 60)]
            assert min(others) >= rate - 1e-6


def test_limits_are_kept(case):
    wanted, best, _ = case
    for design in (best.widest, best.lowest_V1, best.fastest_decay, *best.pareto):
        assert wanted.x[0] <= design["lam"] <= wanted.x[1]
        assert wanted.y[0] <= design["sigma"] <= wanted.y[1]
        assert design["trail"] == pytest.approx(design["sigma"] * wanted.family.bicycle.c)
        if wanted.trail:
            assert wanted.trail[0] - 1e-12 <= design["trail"] <= wanted.trail[1] + 1e-12
        if wanted.stable:
            assert design["V1"] <= wanted.stable[0]
            assert design["V2"] is None or design["V2"] >= wanted.stable[1]


def test_the_same_twice():
    wanted = Wanted(Family(MEIJAARD), x=(0.3, 0.3), judged=(5.0, 5.0))
    assert best_designs(wanted) == best_designs(wanted)


# --- where an optimum lies


def test_the_lowest_V1_lies_where_the_interval_vanishes():
    best = found(Wanted(Family(DIKAREV), judged=(5.0, 5.0)))
    assert best.lowest_V1["at"] == "edge of the stable region, where the interval shrinks to a point"
    assert best.lowest_V1["width"] < 1e-6
    assert best.widest["at"] == "jump"  # two intervals join there
    around = np.array([[-1, 1], [1, 1], [1, -1], [-1, -1], [0, 1], [0, -1], [1, 0], [-1, 0]]).T * 1e-6
    x = np.array([[best.widest["lam"]], [best.widest["sigma"]]]) + around
    V1, V2, *_ = intervals_of(characteristic_table(DIKAREV, *x))
    widths = np.where(V1 < 30, np.minimum(V2, 30) - V1, 0).max(axis=-1)
    assert widths.min() < best.widest["width"] - 0.05
    assert best.fastest_decay["at"] == "interior"
    rate = growth_rate_of(characteristic_table(DIKAREV, *(x - x.mean(axis=1, keepdims=True) + np.array(
        [[best.fastest_decay["lam"]], [best.fastest_decay["sigma"]]]))), 5.0)  # fmt: skip
    assert rate.min() > best.fastest_decay["growth_rate"] - 1e-9


def test_limits_are_named():
    limits = {"x": (0.31, 0.4), "y": (0.05, 0.3), "trail": (0.03, 0.1)}
    best = found(Wanted(Family(MEIJAARD), **limits, judged=(5.0, 5.0)))
    assert best.widest["at"] == "limit of lam, limit of trail"
    assert best.widest["trail"] == pytest.approx(0.1)
    assert best.lowest_V1["at"] == "limit of lam, limit of sigma"
    assert (best.lowest_V1["lam"], best.lowest_V1["sigma"]) == (0.31, 0.05)
    assert best.own["at"] == ""


def test_stable_speeds_asked_for():
    free = found(Wanted(Family(MEIJAARD), judged=(5.0, 5.0)))
    wanted = Wanted(Family(MEIJAARD), judged=(5.0, 5.0), stable=(4.5, 6.0))
    best = found(wanted)
    assert best.lowest_V1["at"] == "edge of the speeds asked for"
    assert best.lowest_V1["V2"] == pytest.approx(6.0, abs=1e-6)
    assert best.lowest_V1["V2"] >= 6.0
    assert free.lowest_V1["V1"] < best.lowest_V1["V1"] <= 4.5
    assert free.widest["width"] > best.widest["width"] > best.own["width"]


def test_a_fixed_tilt():
    best = found(Wanted(Family(MEIJAARD), x=(0.3, 0.3), judged=(5.0, 5.0)))
    sigma = np.linspace(0, 0.3, 20001)
    rate = growth_rate_of(characteristic_table(MEIJAARD, 0.3, sigma), 5.0)
    assert best.fastest_decay["lam"] == 0.3
    assert best.fastest_decay["sigma"] == pytest.approx(sigma[rate.argmin()], abs=2e-5)
    assert best.fastest_decay["growth_rate"] <= rate.min()


def test_a_single_design():
    best = found(Wanted(Family(MEIJAARD), x=(0.3, 0.3), y=(0.08, 0.08)))
    assert best.widest["lam"], best.widest["sigma"] == (0.3, 0.08)
    assert best.widest["V1"] == intervals_of(characteristic_table(MEIJAARD, 0.3, 0.08)).V1[0]
    assert len(best.pareto) == 1


def test_unbounded_intervals_are_cut_at_the_cap():
    widths = []
    for cap in (20.0, 30.0):
        best = found(Wanted(Family(DIKAREV), V_max=cap, judged=(5.0, 5.0)))
        assert best.widest["V2"] is None
        assert best.widest["upper"] == "unbounded"
        widths.append(best.widest["width"])
    assert widths[1] - widths[0] == pytest.approx(10)


def test_intervals_above_the_cap_do_not_count():
    """The benchmark bicycle with this trail is stable from about 5 m/s on, never below."""
    box = {"x": (0.3, 0.4), "y": (0.2, 0.25)}
    assert found(Wanted(Family(MEIJAARD), **box, V_max=5.5, judged=(5.0, 5.0))).widest["V1"] < 5.5
    best = found(Wanted(Family(MEIJAARD), **box, V_max=4.0))
    assert (best.widest, best.lowest_V1, best.fastest_decay, best.pareto) == (None, None, None, [])
    assert best.closest["growth_rate"] > 0


def test_nothing_is_stable_as_asked():
    best = found(Wanted(Family(DIKAREV), stable=(1.0, 20.0)))
    assert best.widest is None
    lam, sigma = np.linspace(0, 0.6, 80)[:, None], np.linspace(0, 0.3, 80)
    table = characteristic_table(DIKAREV, lam, sigma)
    worst = np.max([growth_rate_of(table, V) for V in np.linspace(1, 20, 100)], axis=0)
    assert 0 < best.closest["growth_rate"] <= worst.min()
    assert 1.0 <= best.closest["V"] <= 20.0


def test_a_region_that_the_grid_misses(monkeypatch):
    """On a grid of 11 × 11 the benchmark bicycle is nowhere stable over nearly its own range."""
    monkeypatch.setattr(module, "GRID", 11)
    wanted = Wanted(Family(MEIJAARD), judged=(5.0, 5.0), stable=(4.2, 6.02))
    lam, sigma = np.linspace(0, 0.6, 11)[:, None], np.linspace(0, 0.3, 11)
    V1, V2, *_ = intervals_of(characteristic_table(MEIJAARD, lam, sigma))
    assert not np.any((V1 <= 4.2) & (V2 >= 6.02))
    best = best_designs(wanted)
    assert best.widest["V1"] <= 4.2
    assert best.widest["V2"] >= 6.02


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        ({"x": (0.5, 0.1)}, "lam", "the range 0.5:0.1 ends before it starts\ndid you mean 0.1:0.5?"),
        ({"x": (0.0, 2.0)}, "lam", "does not meet the ground"),
        ({"y": (0.0, 1e9)}, "sigma", "out of range"),
        ({"judged": (-1.0, 2.0)}, "judged", "-1 m/s is negative\nallowed: 0 and above"),
        ({"V_max": 0.0}, "V_max", "0 m/s is no cap"),
        ({"stable": (4.0, 31.0)}, "stable", "raise V_max to 31"),
        ({"trail": (0.5, 0.6)}, "trail", "on a wheelbase of 1.04 m this is σ = 0.480769 ... 0.576923"),
    ],
)
def test_contradictions(changes, key, words):
    with pytest.raises(InputError) as error:
        Wanted(Family(DIKAREV), **changes)
    assert error.value.key == (key,)
    assert words in str(error.value)
