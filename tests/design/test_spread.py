"""How far stable speeds are known: the linear rule, and sampling against an independent Monte Carlo."""

import math

import numpy as np
import pytest
from bicycleparameters.bicycle import benchmark_par_to_canonical

from bikestab.bicycle import Bicycle
from bikestab.design.sensitivity import sensitivity
from bikestab.design.spread import own_spread, plain, spread
from bikestab.draws import drawn
from bikestab.errors import InputError

E_BIKE = {  # the balance-assist e-bike of TU Delft, from BicycleParameters
    "w": 1.113, "c": 0.042, "lam": 0.255, "g": 9.80665, "rR": 0.34895, "mR": 4.085, "IRxx": 0.1023,
    "IRyy": 0.1887, "xB": 0.519, "zB": -0.521, "mB": 22.5, "IBxx": 1.12, "IByy": 3.16, "IBzz": 2.119,
    "IBxz": 0.047, "xH": 0.921, "zH": -0.86, "mH": 4.3, "IHxx": 0.2984, "IHyy": 0.257, "IHzz": 0.0566,
    "IHxz": -0.038, "rF": 0.35231, "mF": 2.235, "IFxx": 0.0995, "IFyy": 0.1902,
}  # fmt: skip
BENCHMARK = Bicycle.preset("meijaard2007")


def stable_at(machine, speeds):
    """Whether a machine of 25 parameters is stable, by eigenvalues of the matrices of BicycleParameters."""
    M, C1, K0, K2 = benchmark_par_to_canonical(machine)
    found = np.linalg.solve(M, np.hstack([C1, K0, K2]))
    C, K, L = found[:, :2], found[:, 2:4], found[:, 4:]
    A = np.zeros((len(speeds), 4, 4))
    A[:, :2, 2:] = np.eye(2)
    V = speeds[:, np.newaxis, np.newaxis]
    A[:, 2:, :2], A[:, 2:, 2:] = -(machine["g"] * K + V**2 * L), -V * C
    return np.linalg.eigvals(A).real.max(axis=1) < 0


def test_an_independent_monte_carlo_agrees():
    """1000 machines of another generator, their intervals read off a fine row of speeds."""
    result = spread(sensitivity(Bicycle.from_mapping(E_BIKE)), {"c": 0.01, "lam": 0.026})
    random, speeds = np.random.default_rng(7), np.linspace(0.5, 9, 341)
    lows = []
    for _ in range(1000):
        c, lam = random.normal(0.042, 0.01), random.normal(0.255, 0.026)
        stable = stable_at({**E_BIKE, "c": c, "lam": lam}, speeds)
        if stable.any():
            lows.append(speeds[np.argmax(stable)])
    step = speeds[1] - speeds[0]
    assert len(lows) / 1000 == pytest.approx(
        result["exists"], abs=4 * math.sqrt(0.957 * 0.043 / 1000) + 0.005
    )
    for key, share in (("low", 0.05), ("median", 0.5), ("high", 0.95)):
        assert np.quantile(lows, share) == pytest.approx(
            result["V1"][key], abs=0.1 if key == "high" else step + 0.04
        )
    assert result["exists"] < 0.97
    assert any("have no stable speed" in reason for reason in result["reasons"])


def test_small_deviations_follow_the_linear_rule():
    """Within five standard errors of a sampled deviation of 20 000 machines."""
    deviations = {"mB": 0.5, "c": 0.0005, "lam": 0.001, "xB": 0.002}
    result = spread(sensitivity(BENCHMARK), deviations)
    assert result["exists"] == 1
    assert result["reasons"] == []
    for end in (result["V1"], result["V2"]):
        assert end["sampled"] == pytest.approx(end["linear"], rel=5 / math.sqrt(2 * 20_000))
        assert end["median"] == pytest.approx(end["own"], abs=5 * end["linear"] / math.sqrt(20_000))


def test_head_angle_and_offset_are_uncertain_too():
    """By the linear rule as a tilt and a trail are; a head angle spreads as the tilt does."""
    found = sensitivity(BENCHMARK)
    by_tilt, by_angle = (spread(found, {name: 0.002}) for name in ("lam", "head_angle"))
    assert by_angle["V1"]["linear"] == pytest.approx(by_tilt["V1"]["linear"], rel=1e-12)
    assert by_angle["V1"]["sampled"] == pytest.approx(by_tilt["V1"]["sampled"], rel=0.03)
    cos = math.cos(BENCHMARK.lam)
    by_offset, by_trail = spread(found, {"offset": 0.0005 * cos}), spread(found, {"c": 0.0005})
    assert by_offset["V2"]["linear"] == pytest.approx(by_trail["V2"]["linear"], rel=1e-12)
    assert by_offset["V2"]["sampled"] == pytest.approx(by_offset["V2"]["linear"], rel=0.03)
    for both, what in (({"lam": 0.1, "head_angle": 0.1}, "tilt"), ({"c": 0.1, "offset": 0.1}, "trail")):
        with pytest.raises(InputError, match=f"are both the {what}"):
            spread(found, both)


@pytest.mark.parametrize("r", [1.0, -1.0])
def test_parameters_of_one_measurement(r):
    """A correlation of ±1: the draws are one line, and the linear rule is that of the sum."""
    names = ["IFyy", "mB", "IRyy"]
    draws = drawn(dict.fromkeys(names, 1.0), names, dict.fromkeys(names, 0.1), {("IRyy", "IFyy"): r}, 4000, 1)
    moved = {name: values - 1 for name, values in draws.items()}
    assert moved["IFyy"] == pytest.approx(r * moved["IRyy"], abs=1e-15)
    assert moved["IFyy"].std() == pytest.approx(0.1, rel=0.05)
    assert abs(np.corrcoef(moved["IFyy"], moved["mB"])[0, 1]) < 0.06
    found = spread(
        sensitivity(BENCHMARK), {"IFyy": 0.001, "IRyy": 0.001}, {("IRyy", "IFyy"): r}, samples=2000
    )
    assert found["V1"]["sampled"] == pytest.approx(found["V1"]["linear"], rel=0.06)


def test_correlations_matter():
    """Two measures of one thing: their effects add up, or cancel, by the linear rule and in the samples."""
    found = sensitivity(BENCHMARK)
    deviations = {"xB": 0.01, "xH": 0.005}
    effects = [found.dV2[name][0] * sd for name, sd in deviations.items()]
    for r, expected in (
        (0.99999999, sum(effects)),
        (-0.99999999, abs(effects[0] - effects[1])),
        (0.0, math.hypot(*effects)),
    ):
        result = spread(found, deviations, {("xH", "xB"): r})
        assert result["V2"]["linear"] == pytest.approx(expected, rel=1e-5)
        assert result["V2"]["sampled"] == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("hold", ["trail", "sigma", "offset"])
def test_machines_are_drawn_with_the_same_held(hold):
    """Each by itself, and together, small enough for the linear rule."""
    found = sensitivity(BENCHMARK, hold=hold)
    deviations = {"w": 0.0005, "rF": 0.0005, "lam": 0.0005, "c": 0.0003}
    for some in (*({name: sd} for name, sd in deviations.items()), deviations):
        result = spread(found, some)
        for end in (result["V1"], result["V2"]):
            assert end["sampled"] == pytest.approx(end["linear"], rel=0.03)


@pytest.mark.parametrize("hold", ["trail", "sigma", "offset"])
def test_what_was_measured_does_not_depend_on_how_a_frame_may_be_changed(hold):
    """Trail and tilt of a file are the measured ones; of an uncertain offset the fork is."""
    measured = BENCHMARK.measured({"c": 0.001, "lam": 0.01, "w": 0.01}, {})
    own = own_spread(sensitivity(measured), of_file=True, given={})
    assert own_spread(sensitivity(measured, hold=hold), of_file=True, given={}) == own
    by_fork = own_spread(
        sensitivity(BENCHMARK, hold=hold), of_file=False, given={"offset": 1e-3, "lam": 0.01}
    )
    assert by_fork == spread(sensitivity(BENCHMARK, hold="offset"), {"offset": 1e-3, "lam": 0.01})


def test_what_cannot_exist_is_left_out_and_an_unbounded_end_is_told():
    result = spread(sensitivity(BENCHMARK), {"IFyy": 0.2})  # below zero in 8 % of draws
    assert result["refused"] == pytest.approx(20_000 * 0.0808, rel=0.1)
    assert result["samples"] + result["refused"] == 20_000
    paper = sensitivity(Bicycle.preset("dikarev1981"), 0.05, 0.15)
    unbounded = spread(paper, {"lam": 0.03})
    assert math.isinf(unbounded["V2"]["own"])
    assert plain(unbounded)["V2"]["own"] is None
    assert 0 < unbounded["unbounded"] < unbounded["exists"]
    assert any("have an upper limit" in reason for reason in unbounded["reasons"])


def test_deviations_of_the_file_and_given_ones():
    measured = BENCHMARK.measured({"mB": 1.0, "c": 0.001}, {("mB", "c"): 0.5})
    found = sensitivity(measured)
    assert own_spread(found, of_file=False, given={}) is None
    assert own_spread(found, of_file=True, given={})["deviations"] == {"mB": 1.0, "c": 0.001}
    assert own_spread(found, of_file=True, given={"c": 0.01})["deviations"] == {"mB": 1.0, "c": 0.01}
    typed = own_spread(found, of_file=True, given={"sigma": 0.01})["deviations"]
    assert typed == {"mB": 1.0, "sigma": 0.01}  # the trail under another name


@pytest.mark.parametrize(
    ("deviations", "correlations", "problem"),
    [
        ({"mX": 1}, {}, "there is no parameter 'mX'"),
        ({"mB": -1}, {}, "mB=-1 is no standard deviation"),
        ({"c": 0.1, "sigma": 0.1}, {}, "c and sigma are both the trail"),
        ({}, {}, "no standard deviation is given"),
        (
            {"mB": 1, "c": 1, "xB": 1},
            {("mB", "c"): 0.9, ("c", "xB"): 0.9, ("mB", "xB"): -0.9},
            "contradict each other",
        ),
    ],
)
def test_mistakes(deviations, correlations, problem):
    with pytest.raises(InputError, match=problem) as error:
        spread(sensitivity(BENCHMARK), deviations, correlations)
    assert error.value.key == ("sd",)
