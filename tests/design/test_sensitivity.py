"""Derivatives of stable speeds: against central differences in 60 digits, and published and known values."""

import functools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from mpmath import mp, mpf

import bikestab as bs
from bikestab.bicycle import Bicycle
from bikestab.design.effects import effects, sensitivity_record, tried
from bikestab.design.sensitivity import HOLDS, sensitivity, two_parts
from bikestab.errors import InputError
from tests.references import generate_speeds as reference
from tests.strategies import lams, machines, sigmas

STEP = mpf(10) ** -16  # of the parameter's size; the error of a central difference is its square
# relative; or, of one that is next to nothing, of what the largest elasticity would give
CLOSE, NOTHING = 1e-12, 1e-15

CARGO = {  # a long machine of four bodies with damping
    "w": 1.4, "c": 0.06, "lam": 0.35, "g": 9.81, "delta": 0.7, "rR": 0.33, "mR": 3, "IRxx": 0.12,
    "IRyy": 0.23, "xB": 0.5, "zB": -0.95, "mB": 110, "IBxx": 11, "IByy": 14, "IBzz": 6, "IBxz": 1.2,
    "xH": 1.2, "zH": -0.75, "mH": 6, "IHxx": 0.25, "IHyy": 0.24, "IHzz": 0.03, "IHxz": -0.03, "rF": 0.25,
    "mF": 2, "IFxx": 0.05, "IFyy": 0.09,
}  # fmt: skip
MACHINES = {
    "benchmark": (Bicycle.preset("meijaard2007"), None, None),
    "skates": (Bicycle.preset("kooijman2011"), None, None),
    "motorcycle": (Bicycle.preset("sharp1971"), None, None),
    "paper": (Bicycle.preset("dikarev1981"), 0.2, 0.08),
    "cargo": (Bicycle.from_mapping(CARGO), None, None),
}


def speeds(bicycle, found, changes, hold):
    """The ends of the first interval, in 60 digits, with changes of parameters and what is held kept."""
    meijaard = bicycle.bodies is not None
    n = {name: mpf(value) for name, value in bicycle.given.items()}
    n.setdefault("g", mpf(9.81)), n.setdefault("delta", mpf(0))
    n |= {"D1": n.get("D1", 0), "D2": n.get("D2", 0)} if not meijaard else {}
    base, radius = ("w", "rF") if meijaard else ("c", "R2")
    lam, sigma = mpf(found.lam), mpf(found.sigma)
    trail = sigma * n[base]
    offset = n[radius] * mp.sin(lam) - trail * mp.cos(lam)
    for name, change in changes.items():
        if name in ("lam", "head_angle"):
            lam += change if name == "lam" else -change
        elif name not in ("sigma", "trail", "offset") and not (meijaard and name == "c"):
            n[name] += change
    if hold == "offset":
        trail = (n[radius] * mp.sin(lam) - offset) / mp.cos(lam)
    trail = sigma * n[base] if hold == "sigma" else trail
    trail += changes.get("trail", 0) + (changes.get("c", 0) if meijaard else 0)
    trail += changes.get("sigma", 0) * n[base] - changes.get("offset", 0) / mp.cos(lam)
    n.pop("lam", 0), n.pop("sigma", 0)
    conditions = reference.condition_polynomials(
        reference.polynomial(n, lam, trail / n[base], n["delta"], found.model)
    )
    ends = []
    for V, kind in (
        (found.intervals.V1[0], found.intervals.lower[0]),
        (found.intervals.V2[0], found.intervals.upper[0]),
    ):
        name = {"weave": "hurwitz3", "capsize": "p0"}.get(bs.KINDS[kind])
        ends.append(mp.nan if name is None else root(conditions[name], mpf(V)))
    return ends


def root(poly, V):
    for _ in range(8):
        V -= reference.at(poly, V) / sum(j * x.value * V ** (j - 1) for j, x in poly.items() if j)
    return V


def differences(bicycle, found, name, hold):
    """dV1/dp and dV2/dp by central differences."""
    step = STEP * max(abs(found.values[name]), 0.01)
    with mp.workdps(60):
        above, below = (speeds(bicycle, found, {name: side * step}, hold) for side in (1, -1))
        return [(a - b) / (2 * step) for a, b in zip(above, below, strict=True)]


@functools.cache
def answer(key, hold):
    bicycle, lam, sigma = MACHINES[key]
    return bicycle, sensitivity(bicycle, lam, sigma, hold=hold)


def close(got, expected, V, value):
    scale = abs(V / max(abs(value), 0.01))
    return abs(got - float(expected)) <= CLOSE * abs(float(expected)) + NOTHING * scale


@pytest.mark.parametrize("key", MACHINES)
@pytest.mark.parametrize("hold", HOLDS)
def test_derivatives_are_differences_in_60_digits(key, hold):
    """Every parameter once; with other things held those that it makes another derivative of."""
    bicycle, found = answer(key, hold)
    front = {"w", "c", "rF", "R2", "lam", "head_angle"}
    own = "trail" if bicycle.bodies is not None else "sigma"
    for name in found.values:
        skate = bicycle.R1 == 0 and name in ("IRyy", "IFyy", "rR", "rF")
        if skate or (hold != own and name not in front):
            continue
        expected = differences(bicycle, found, name, hold)
        for got, want, V in zip(
            (found.dV1[name][0], found.dV2[name][0]),
            expected,
            (found.intervals.V1, found.intervals.V2),
            strict=True,
        ):
            if math.isfinite(V[0]):
                assert close(got, want, V[0], found.values[name]), (name, got, want)
            else:
                assert math.isnan(got)


def test_the_three_holds_differ_where_they_should():
    found = {hold: answer("benchmark", hold)[1] for hold in HOLDS}
    for name in found["trail"].values:
        values = [found[hold].dV1[name][0] for hold in HOLDS]
        assert (len({*values}) > 1) == (name in ("w", "rF", "lam", "head_angle")), name
    assert found["trail"].dV1["lam"] == found["sigma"].dV1["lam"] != found["offset"].dV1["lam"]


# d ln V1/d ln p, d ln V2/d ln p of the benchmark, from 40-digit differences
KNOWN = {
    "g": (0.5, 0.5), "rF": (0.41266, 0.59703), "IFyy": (-0.37815, -0.53078), "lam": (0.30569, 0.22470),
    "xH": (0.30182, 0.75898), "mB": (0.29961, 0.35853), "c": (0.21396, 0.38363), "w": (-0.11349, -0.74381),
}  # fmt: skip


def test_known_elasticities_of_the_benchmark():
    found = bs.sensitivity(Bicycle.preset("meijaard2007"))
    for name, expected in KNOWN.items():
        assert [each[0] for each in found.elasticity(name)] == pytest.approx(expected, abs=6e-6)
    for name in ("IByy", "IHyy"):
        assert found.dV1[name] == found.dV2[name] == 0


def test_scaling_laws():
    """Speeds go with the root of all lengths, inertias with them, and know no unit of mass."""
    for key in ("benchmark", "motorcycle", "cargo"):
        _, found = answer(key, "sigma")
        powers = dict.fromkeys(found.values, (0, 0))  # of mass and of length
        for name, unit in found.units.items():
            if name not in ("trail", "offset", "head_angle", "lam", "sigma") and not (
                key != "motorcycle" and name == "c"
            ):
                powers[name] = {"m": (0, 1), "kg": (1, 0), "kg m²": (1, 2), "kg m²/s": (1, 1.5)}.get(
                    unit, (0, 0)
                )
        for which in (0, 1):
            sums = [
                sum(found.elasticity(name)[which][0] * power[i] for name, power in powers.items())
                for i in (0, 1)
            ]
            assert sums == pytest.approx([0, 0.5], abs=1e-12)


@settings(deadline=None, max_examples=25, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas)
def test_random_machines_in_60_digits(machine, lam, sigma):
    """The direction in which all parameters change by shares of themselves at once."""
    bicycle = Bicycle.from_mapping(machine)
    found = sensitivity(bicycle, lam, sigma, hold="sigma")
    if found.intervals.number == 0 or bs.KINDS[found.intervals.lower[0]] == "rest":
        assert all(len(each) == found.intervals.number for each in found.dV1.values())
        return
    names = [name for name in found.values if name in bicycle.notation and name not in ("lam", "sigma")]
    names = [name for name in names if not (bicycle.bodies is not None and name == "c")] + ["lam"]
    shares = dict(zip(names, np.random.default_rng(1).uniform(-1, 1, len(names)), strict=True))
    total = sum(share * found.values[name] * found.dV1[name][0] for name, share in shares.items())
    size = sum(abs(share * found.values[name] * found.dV1[name][0]) for name, share in shares.items())
    with mp.workdps(60):
        step = STEP * mpf(10) ** -4
        changes = [{n: s * side * step * mpf(found.values[n]) for n, s in shares.items()} for side in (1, -1)]
        above, below = (speeds(bicycle, found, each, "sigma")[0] for each in changes)
        expected = (above - below) / (2 * step)
    assert total == pytest.approx(float(expected), abs=1e-10 * size)


def test_several_intervals_unbounded_ends_and_none():
    paper = Bicycle.preset("dikarev1981")
    two = sensitivity(paper, 0.04834835, 0.15)
    assert two.dV1["m1"].shape == two.intervals.V1.shape == (2,)
    assert np.isnan(two.dV2["m1"][1]) == np.isinf(two.intervals.V2[1])
    none = sensitivity(paper, 0.1, 0.08)
    assert none.dV1["m1"].shape == (0,)
    assert sensitivity_record(none)["intervals"] == []


def test_damping_raises_the_benchmarks_lowest_speed_and_lowers_the_papers():
    benchmark = sensitivity(Bicycle.preset("meijaard2007"))
    assert (
        benchmark.dV1["delta"][0] > 0 > sensitivity(Bicycle.preset("dikarev1981"), 0.2, 0.08).dV1["delta"][0]
    )
    damping, heavier = (each["interval"] for each in tried(benchmark))
    assert (damping["V1"], damping["V2"]) == pytest.approx((4.374, 6.024), abs=5e-4)
    assert heavier["V2"] - heavier["V1"] == pytest.approx(1.835, abs=5e-4)


def test_rows_are_sorted_by_effect():
    rows = effects(sensitivity(Bicycle.preset("meijaard2007")), 0)
    sizes = [max(abs(row["elasticity_V1"]), abs(row["elasticity_V2"])) for row in rows]
    assert sizes == sorted(sizes, reverse=True)
    by_name = {row["name"]: row for row in rows}
    assert by_name["mB"]["change"] == pytest.approx(-6.525, abs=1e-3)  # exact: tests/design/test_steps.py
    assert by_name["IByy"]["change"] is None


def test_the_two_parts_of_a_machine_have_the_same_speeds():
    benchmark = Bicycle.preset("meijaard2007")
    other = sensitivity(two_parts(benchmark))
    assert other.hold == "sigma"
    own = sensitivity(benchmark, hold="sigma")
    for name in ("g", "delta", "lam", "sigma", "trail", "offset", "head_angle"):
        assert other.dV1[name] == pytest.approx(own.dV1[name], rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "key", "problem"),
    [
        ({"hold": "rake"}, "hold", "'rake' cannot be held"),
        ({"lam": [0.1, 0.2]}, "lam", "derivatives are those of one design"),
        ({"lam": 9}, "lam", "9"),
    ],
)
def test_mistakes(arguments, key, problem):
    with pytest.raises(InputError) as error:
        sensitivity(Bicycle.preset("meijaard2007"), **arguments)
    assert error.value.key == (key,)
    assert problem in error.value.problem


def test_a_rider_beside_the_bicycle():
    """By the rider's numbers and the frame's, against differences of speeds."""
    rider = {"m": 60, "x": 0.35, "z": -1.1, "Ixx": 9.6, "Izz": 2.2, "Ixz": -1.0, "scale_inertia": True}
    given = {**Bicycle.preset("meijaard2007").given, "mB": 12.0, "rider": rider}
    bicycle = Bicycle.from_mapping(given)
    found = sensitivity(bicycle)
    for name, step in (("rider.m", 1e-3), ("rider.x", 1e-5), ("rider.Ixx", 1e-3), ("mB", 1e-3)):
        own = bicycle.given[name]
        ends = [bs.stable_intervals(bicycle.replaced({name: own + way * step})) for way in (1, -1)]
        difference = (ends[0].V1[0] - ends[1].V1[0]) / (2 * step)
        assert found.dV1[name][0] == pytest.approx(difference, rel=1e-6), name
    assert found.units["rider.m"] == "kg"
