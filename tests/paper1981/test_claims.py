"""The numbers behind the four verdicts against brute force, and the rules that draw the verdicts."""

import numpy as np
import pytest
from hypothesis import assume, given, settings

from bikestab.bicycle import Bicycle
from bikestab.model import canonical_matrices, characteristic_table, coefficients
from bikestab.paper1981 import box as paper
from bikestab.paper1981 import claims, damping, evidence, refinement
from bikestab.paper1981.machines import random_machines
from bikestab.speeds import intervals_of
from tests.small import TINY, study
from tests.strategies import lams, machines, sigmas

SPEEDS = np.concatenate([np.linspace(0.05, 15, 300), np.geomspace(15.5, 1e5, 100)])


@pytest.fixture(scope="module")
def bicycle():
    return Bicycle.preset("dikarev1981")


def numbers(number):
    return study()["conclusions"][str(number)]["numbers"]


def brute(bicycle, lam, sigma, speeds, model="refined"):
    """The largest real part of the eigenvalues at many speeds, from the matrices alone."""
    M, C1, K0, K2 = canonical_matrices(bicycle, lam, sigma, model=model)
    V = np.asarray(speeds)[:, np.newaxis, np.newaxis]
    first = np.zeros((len(speeds), 4, 4))
    first[:, :2, 2:] = np.eye(2)
    first[:, 2:, :2] = -np.linalg.solve(M, bicycle.g * K0 + V**2 * K2)
    first[:, 2:, 2:] = -np.linalg.solve(M, V * C1 + np.diag([0.0, bicycle.delta]))
    return np.linalg.eigvals(first).real.max(axis=-1)


def test_verdicts():
    verdicts = [part["verdict"] for part in study()["conclusions"].values()]
    assert verdicts == ["does not hold", "holds with limits", "holds with limits", "does not hold"]


def test_table_of_the_theory():
    """The table of docs/theory.md, from an independent eigenvalue code, to its printed digits."""
    expected = [[(4.056, 4.636)], [(3.913, 5.228)], [(4.807, None)], [(3.621, 3.633)], []]
    table = study()["figure3"]["table"]
    for row, ends in zip(table, expected, strict=True):
        found = [(i["V1"], i["V2"]) for i in row["intervals"]]
        assert len(found) == len(ends)
        for (V1, V2), (low, high) in zip(found, ends, strict=True):
            assert pytest.approx(low, abs=5e-4) == V1
            assert V2 is None if high is None else pytest.approx(high, abs=5e-4) == V2


def test_shares_by_eigenvalues(bicycle):
    """300 random designs: exact shares within three standard deviations of counting them."""
    rng = np.random.default_rng(7)
    designs = rng.uniform([0, 0], [0.3, 0.15], (300, 2))
    growth = np.array([brute(bicycle, *design, SPEEDS) for design in designs])
    stable, far = (growth < 0).any(axis=1), growth[:, -1] < 0
    shares = numbers(1)["shares"]
    for counted, share in ((~stable, shares["none"]), (far, shares["unbounded"])):
        deviation = np.sqrt(share * (1 - share) / len(designs))
        assert counted.mean() == pytest.approx(share, abs=3 * deviation)
    assert shares["none"] + shares["finite"] + shares["unbounded"] == pytest.approx(1)


def test_shares_and_volume_on_finer_grids():
    """0.3876 ± 0.002 of the designs are stable, and 0.04822 rad m/s: from 1000 × 1000 designs."""
    found = numbers(1)
    assert found["shares"]["some"] == pytest.approx(0.38712, abs=5e-4)
    assert found["shares"]["unbounded"] == pytest.approx(0.033562, abs=3e-4)
    assert found["grid"]["some"] == pytest.approx(0.38712, abs=5e-3)
    models = study()["refinement"]["models"]
    assert models["refined"]["volume"] == pytest.approx(0.0482246, rel=5e-3)
    assert models["unrefined"]["volume"] == 0


def test_volume_by_eigenvalues(bicycle):
    rng = np.random.default_rng(8)
    designs, speeds = rng.uniform([0, 0], [0.3, 0.15], (400, 2)), np.linspace(0.025, 14.975, 300)
    share = np.mean([(brute(bicycle, *design, speeds) < 0).mean() for design in designs])
    assert share * 0.3 * 0.15 * 15 == pytest.approx(0.0482246, rel=0.25)  # 7 % is one standard deviation


def test_counterexamples(bicycle):
    for example in numbers(1)["counterexamples"]:
        (interval,) = example["intervals"]
        assert interval["V2"] is None
        lam, sigma = example["lam"], example["sigma"]
        assert example["stable_far_up"]
        expected = brute(bicycle, lam, sigma, example["speeds"])
        for (V, values), growth in zip(example["eigenvalues"].items(), expected, strict=True):
            assert len(values) == 4
            assert values[0][0] == pytest.approx(growth, rel=1e-9)
            assert sum(re for re, _ in values) == pytest.approx(
                _trace(bicycle, lam, sigma, float(V)), rel=1e-9
            )
        assert (brute(bicycle, lam, sigma, np.geomspace(1.01 * interval["V1"], 1e4, 200)) < 0).all()
        slow = example["time_constants"]
        assert slow[1] / slow[0] == pytest.approx(10, rel=0.02)  # the slowest eigenvalue goes as 1/V


def _trace(bicycle, lam, sigma, V):
    M, C1, _, _ = canonical_matrices(bicycle, lam, sigma)
    return -np.trace(np.linalg.solve(M, V * C1))


def test_two_intervals(bicycle):
    two = numbers(1)["two_intervals"]
    assert len(two["intervals"]) == 2
    for found in two["intervals"]:
        top = found["V2"] or 4 * found["V1"]
        middle = found["V1"] + np.array([-0.02, 0.5, 1.02]) * (top - found["V1"])
        stable = brute(bicycle, two["lam"], two["sigma"], middle) < 0
        assert stable.tolist() == [False, True, found["V2"] is None]


def test_corner_of_the_unbounded_designs():
    curves = {curve["name"]: curve for curve in numbers(1)["curves_at_infinity"]}
    assert set(curves) == {"capsize at infinity", "weave at infinity"}
    corner = curves["capsize at infinity"]["from"]
    assert (corner["lam"], corner["sigma"]) == pytest.approx((0.0881670, 0.1107012), abs=5e-8)
    assert curves["weave at infinity"]["to"]["lam"] == pytest.approx(corner["lam"], abs=1e-12)


@settings(max_examples=150, deadline=None)
@given(machines, lams, sigmas)
def test_closed_form_on_any_machine(values, lam, sigma):
    """Against the roots of the conditions, with and without damping, which does not matter."""
    machine = Bicycle.from_mapping(values)
    table = characteristic_table(machine, lam, sigma)
    lead = [
        table[4, 0],
        table[3, 1],
        table[1, 3],
        table[0, 2],
        table[3, 1] * table[2, 2] - table[4, 0] * table[1, 3],
    ]
    size = [1e-4, 1e-4, 1e-6, 1e-3, 1e-6 * abs(table[4, 0] * table[1, 3])]
    assume(all(abs(v) > s for v, s in zip(lead, size, strict=True)))  # equality is another matter
    formula = bool(paper.stable_at_high_speed(table))
    assert formula == bool(np.isinf(intervals_of(table).V2).any())
    if min(lead[:3]) > 0:
        assert formula == bool(lead[3] > 0 and lead[4] > 0)


def test_first_condition_in_letters(bicycle):
    """−α7 = c g cos λ [S (C1° + C2°) − h C2° sin λ], and p0 at rest = c² g² S (h sin λ − S)."""
    p = bicycle
    lam, sigma = np.linspace(0, 0.6, 7)[:, np.newaxis], np.linspace(0, 0.3, 5)
    table = characteristic_table(p, lam, sigma)
    S = coefficients(p, lam, sigma).a4.value / (p.c * p.g)
    h = p.m1 * p.h1 + p.m2 * p.h2
    C1, C2 = p.C1 / p.R1, p.C2 / p.R2
    bracket = S * (C1 + C2) - h * C2 * np.sin(lam)
    assert table[0, 2] == pytest.approx(p.c * p.g * np.cos(lam) * bracket, rel=1e-9, abs=1e-9)
    rest = p.c**2 * p.g**2 * S * (h * np.sin(lam) - S)
    assert table[0, 0] == pytest.approx(rest, rel=1e-9, abs=1e-9)


def test_closed_form_over_the_map(bicycle):
    found = paper.designs(bicycle, 300)
    assert np.array_equal(found.formula, found.unbounded)
    assert numbers(1)["formula_disagreements"] == 0
    assert numbers(1)["random_machines"]["formula_disagreements"] == 0


def test_random_machines_are_possible():
    first, again = (list(random_machines(30)) for _ in range(2))
    assert first == again
    assert not any(machine.warnings for machine in first)
    assert numbers(1)["random_machines"]["with_unbounded"] > 0.3


def test_widening(bicycle):
    found = numbers(2)
    assert found["larger_sigma_widens"] == 1
    assert found["sigma_from"] == pytest.approx(0.0868, abs=3e-3)
    assert found["limits"]["lam_min"] == pytest.approx(0.010012802, abs=1e-8)
    rows = {row["sigma"]: row for row in found["lines"]["at_sigma"]}
    (low, high), *more = rows[0.15]["unbounded_lam"]
    assert not more
    assert (low, high) == pytest.approx((0.0483182, 0.1229520), abs=5e-8)
    for lam, stable in ((low - 1e-4, False), (low + 1e-4, True), (high - 1e-4, True), (high + 1e-4, False)):
        assert (brute(bicycle, lam, 0.15, [1e6])[0] < 0) == stable
    assert rows[0.08]["best_lam"] == 0.3
    assert rows[0.08]["unbounded_lam"] == []


def test_optima():
    wide, fast = numbers(3)["optima"][:2]
    assert (wide["sigma"], wide["V2"]) == (0.15, None)
    assert 0.0483 < wide["lam"] < 0.1230
    assert (fast["lam"], fast["sigma"]) == pytest.approx((0.3, 0.15))
    assert fast["growth_rate"] == pytest.approx(-0.386048, abs=1e-5)


def test_damping(bicycle):
    found = numbers(4)
    assert found["p0_change"] == 0
    assert found["unbounded_changed"] == 0
    assert found["judged_by"]["marked_from"] == pytest.approx(0.0409, rel=0.02)
    unstable = found["single_designs"][-1]
    assert (unstable["lam"], unstable["sigma"], unstable["without"]["V1"]) == (0.10, 0.08, None)
    at_one = next(row for row in unstable["sweep"] if row["delta"] == 1)
    assert (at_one["V1"], at_one["V2"]) == pytest.approx((3.30, 5.45), abs=5e-3)
    damped = bicycle.with_delta(1.0)
    around = brute(damped, 0.10, 0.08, [0.99 * at_one["V1"], 1.01 * at_one["V1"], 5.44, 5.46])
    assert (around < 0).tolist() == [False, True, True, False]


def test_fold_moves_with_damping(bicycle):
    """The smallest stable σ at λ = 0.3 falls by 12.6 % at δ = 0.1; what is between is stable only then."""
    row = next(row for row in numbers(4)["sweep"] if row["delta"] == 0.1)
    assert row["sigma_min_change"][2] == pytest.approx(-0.1258, abs=1e-3)
    speeds = np.linspace(2, 5, 3001)
    between = row["sigma_min"][2] * 1.05
    assert (brute(bicycle.with_delta(0.1), 0.3, between, speeds) < 0).any()
    assert not (brute(bicycle, 0.3, between, speeds) < 0).any()


def test_unrefined_model_by_eigenvalues(bicycle):
    found = study()["refinement"]
    assert found["changed_coefficients"] == ["a4", "b3", "b6"]
    assert found["models"]["unrefined"]["capsize_over_p1"] < 1
    rng = np.random.default_rng(9)
    for design in rng.uniform([0, 0], [0.3, 0.15], (60, 2)):
        assert (brute(bicycle, *design, SPEEDS, model="unrefined") > 0).all()


def test_terms_of_the_refinement_do_not_depend_on_the_grid(bicycle):
    small = TINY._replace(grid=20)
    found = refinement.refinement(bicycle, paper.designs(bicycle, 20), small)
    assert found["changed_terms"] == ["V^0 of p0", "V^2 of p0", "V^1 of p1", "V^0 of p2"]


@pytest.mark.parametrize(
    ("rule", "values", "verdict"),
    [
        (claims.judge_finite, (0.0, 0.0), "holds"),
        (claims.judge_finite, (0.0, 1e-9), "holds with limits"),
        (claims.judge_finite, (1e-9, 0.0), "does not hold"),
        (claims.judge_widening, (1.0, 0.0, True), "holds"),
        (claims.judge_widening, (0.995, 0.1, False), "holds with limits"),
        (claims.judge_widening, (0.98, 0.1, False), "does not hold"),
        (claims.judge_widening, (1.0, None, False), "does not hold"),
        (claims.judge_margin, (0.1,), "holds"),
        (claims.judge_margin, (0.11,), "holds with limits"),
        (claims.judge_margin, (None,), "does not hold"),
        (claims.judge_damping, (None,), "holds"),
        (claims.judge_damping, (10.5,), "holds"),
        (claims.judge_damping, (0.11,), "holds with limits"),
        (claims.judge_damping, (0.1,), "does not hold"),
    ],
)
def test_rules(rule, values, verdict):
    assert rule(*values) == verdict


def test_first_marked():
    assert claims.first_marked([0.01, 0.1, 1.0], [0.0, 0.1, 0.2]) == pytest.approx(10**-1.5)
    assert claims.first_marked([0.01, 0.1], [0.06, 0.1]) == 0.01
    assert claims.first_marked([0.01, 0.1], [0.01, None]) == 0.1  # what was there is gone
    assert claims.first_marked([0.01, 0.1], [-0.01, 0.04]) is None


def test_eigenvalues_are_those_of_the_polynomial(bicycle):
    values = [complex(*s) for s in evidence.eigenvalues(bicycle.with_delta(0.5), 0.2, 0.08, 4.3)]
    table = characteristic_table(bicycle.with_delta(0.5), 0.2, 0.08)
    for s in values:
        terms = [table[k, j] * 4.3**j * s**k for k in range(5) for j in range(4)]
        assert abs(sum(terms)) < 1e-10 * sum(map(abs, terms))


def test_a_single_design_is_followed_from_where_it_appears(bicycle):
    last = damping.single_designs(bicycle, (0.1, 1.0))[-1]
    assert [row["V1"] is None for row in last["sweep"]] == [True, False]
    assert last["stable_from"] == 1.0
