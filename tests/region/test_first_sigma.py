"""The first stable σ: where intervals begin, and its derivatives against central differences in 60 digits."""

import functools
import math

import numpy as np
import pytest
from mpmath import mp, mpf

import bikestab as bs
from bikestab.bicycle import Bicycle
from bikestab.design.sensitivity import two_parts
from bikestab.errors import InputError
from bikestab.region.pieces import NAMES
from tests.design.test_sensitivity import MACHINES
from tests.references import generate_speeds as reference

STEP = mpf(10) ** -18  # of the parameter's size; the error of a central difference is its square
CLOSE = 1e-9
PAPER = Bicycle.preset("dikarev1981")
CASES = {
    **MACHINES,
    "paper at infinity": (PAPER, 0.05, 0.15),
    "paper with damping": (PAPER.with_delta(1.0), 0.025, 0.08),
}
KINDS = {
    "benchmark": "slow meet", "skates": "capsize at infinity", "motorcycle": "slow meet", "paper": "meet",
    "cargo": "slow meet", "paper at infinity": "weave at infinity", "paper with damping": "fold",
}  # fmt: skip


@functools.cache
def answer(key):
    bicycle, lam, sigma = CASES[key]
    return bicycle, bicycle.lam if lam is None else lam, bs.first_sigma(bicycle, lam, sigma)


def conditions(kind, numbers, lam, sigma, V):
    """What vanishes at the first σ."""
    table = reference.polynomial(numbers, lam, sigma, numbers["delta"], "refined")
    rows = [{j: x.value for (k, j), x in table.items() if k == power} for power in range(5)]
    if kind.endswith("infinity"):
        name = "p0" if kind.startswith("capsize") else "hurwitz3"
        beside = reference.polynomial(numbers, lam, sigma + mpf("0.01"), numbers["delta"], "refined")
        c, there = (reference.condition_polynomials(each)[name] for each in (table, beside))
        return [c[max(j for j, x in there.items() if abs(x.value) > mpf(10) ** -40 * x.size)].value]
    p0, p1, p2, p3, p4 = (sum(x * V**j for j, x in row.items()) for row in rows)
    if kind == "fold":
        hurwitz3 = reference.condition_polynomials(table)["hurwitz3"]
        return [
            sum(x.value * V**j for j, x in hurwitz3.items()),
            sum(j * x.value * V ** (j - 1) for j, x in hurwitz3.items() if j),
        ]
    return [p0, p1] if kind == "slow meet" else [p0, p2 * p3 - p4 * p1]


def solved(kind, numbers, lam, start, J=None):
    """σ and V where they vanish, by Newton's method with slopes J at the start, which are returned too."""
    x = [mpf(each) for each in start]
    if J is None:
        h = mpf(10) ** -25
        J = mp.matrix(len(x), len(x))
        for column in range(len(x)):
            ends = []
            for way in (1, -1):
                moved = [each + way * h * (i == column) for i, each in enumerate(x)]
                ends.append(conditions(kind, numbers, lam, *moved, *[1] * (2 - len(x))))
            for row in range(len(x)):
                J[row, column] = (ends[0][row] - ends[1][row]) / (2 * h)
    for _ in range(8):
        step = mp.lu_solve(J, mp.matrix(conditions(kind, numbers, lam, *x, *[1] * (2 - len(x)))))
        x = [a - b for a, b in zip(x, step, strict=True)]
        if max(map(abs, step)) < mpf(10) ** -45:
            break
    return x, J


@pytest.mark.parametrize("key", CASES)
def test_derivatives_are_differences_in_60_digits(key):
    bicycle, lam, found = answer(key)
    kind = KINDS[key]
    assert found.kind == NAMES[kind]
    with mp.workdps(60):
        own = {name: mpf(value) for name, value in bicycle.given.items()}
        own = {"g": mpf(9.81), "delta": mpf(bicycle.delta), **own}
        if bicycle.bodies is None:
            own = {"D1": mpf(0), "D2": mpf(0), **own}
        start, J = solved(kind, own, mpf(lam), [found.value, found.V][: 2 - (found.V is None)])
        assert found.value == pytest.approx(float(start[0]), rel=1e-12)
        names = [name for name in found.slope if name in own and name not in ("sigma", "trail")]
        for name in names if bicycle.bodies is None else [name for name in names if name != "c"]:
            if math.isnan(found.slope[name]) or (bicycle.R1 == 0 and name in ("rR", "rF")):
                continue
            step = STEP * max(abs(own[name]), mpf("0.01"))
            ends = []
            for way in (1, -1):
                moved = own | {name: own[name] + way * step}
                tilt = moved["lam"] if name == "lam" else mpf(lam)
                ends.append(solved(kind, moved, tilt, start, J)[0][0])
            expected = float((ends[0] - ends[1]) / (2 * step))
            scale = abs(found.value) / max(abs(float(own[name])), 0.01)
            assert abs(found.slope[name] - expected) <= CLOSE * max(abs(expected), 1e-3 * scale), name
        tilts = [solved(kind, own, mpf(lam) + way * STEP, start, J)[0][0] for way in (1, -1)]
        expected = float((tilts[0] - tilts[1]) / (2 * STEP))
        assert found.slope["lam"] == -found.slope["head_angle"] == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize("key", CASES)
def test_stable_speeds_begin_there(key):
    bicycle, lam, found = answer(key)
    some = bs.stable_intervals(bicycle, lam, found.value + np.array([-1e-7, 1e-7])).number
    assert some.tolist() in ([0, 1], [0, 2])
    assert all(found.slope[name] == 0 for name in ("sigma", "trail", "offset"))


def test_it_is_the_sigma_that_vrange_names():
    """Of the designs without a stable speed, the nearest larger one."""
    from bikestab.region.answers import stable_speeds

    (record,) = stable_speeds(PAPER, 0.1, 0.08)
    assert bs.first_sigma(PAPER, 0.1, 0.08).value == pytest.approx(record["nearest"]["sigma_min"], rel=1e-13)
    case = bs.first_sigma(Bicycle.preset("meijaard2007"), sigma=-0.01).value
    assert -0.01 < case < -0.005  # -0.005 is stable from 2.787 to 2.860 m/s


@pytest.mark.parametrize(
    "design",
    [(None, None), (0.1813524440745007, 0.1), (0.34291936554562524, 0.1), (0.4920937242078955, 0.03)],
)
def test_both_notations_find_the_same(design):
    """Where the interval that opens is narrower than the rounding of a table's entries."""
    machine = Bicycle.preset("meijaard2007")
    own = bs.first_sigma(machine, *design)
    other = bs.first_sigma(two_parts(machine), *design)
    assert own.kind == other.kind == "weave meets capsize"
    assert (other.value, other.V) == pytest.approx((own.value, own.V), rel=1e-10)
    for name in ("lam", "g"):
        assert other.slope[name] == pytest.approx(own.slope[name], rel=1e-8)


def test_where_there_is_none():
    none = bs.first_sigma(Bicycle.preset("meijaard2007"), -0.2)
    assert (none.value, none.slope) == (None, {})
    assert none.reason == "no larger σ up to 0.5 has a stable speed at this tilt"
    strong = {"k_phi": -5000.0, "k_phidot": -500.0, "k_delta": 3000.0, "k_deltadot": 100.0}
    everywhere = bs.first_sigma(Bicycle.preset("meijaard2007").replaced(strong))
    assert everywhere.value is None
    assert everywhere.reason == "there are stable speeds down to σ = -0.5, where the search ends"
    with pytest.raises(InputError, match="the first σ is that of one design"):
        bs.first_sigma(PAPER, [0.1, 0.2], 0.1)
