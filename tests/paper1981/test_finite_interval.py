"""Conclusion 1: shares, counterexamples and the closed form against eigenvalues."""

import numpy as np
import pytest
from hypothesis import assume, given, settings

from bikestab.bicycle import Bicycle
from bikestab.model import canonical_matrices, characteristic_table, coefficients
from bikestab.paper1981.box import PAPER_BOX
from bikestab.paper1981.maps import map_designs, stable_at_high_speed
from bikestab.speeds import intervals_of
from tests.small import SPEEDS, brute, numbers, study
from tests.strategies import lams, machines, sigmas


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
    assert found["grid"]["shares"]["some"] == pytest.approx(0.38712, abs=5e-3)
    models = study()["refinement"]["models"]
    assert models["refined"]["volume"] == pytest.approx(0.0482246, rel=5e-3)
    assert models["unrefined"]["volume"] == 0


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
    formula = bool(stable_at_high_speed(table))
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
    found = map_designs(bicycle, 300)
    assert np.array_equal(found.formula, found.unbounded)
    assert numbers(1)["formula_disagreements"] == 0
    assert numbers(1)["random_machines"]["formula_disagreements"] == 0


def test_no_fork_bent_forwards_is_without_upper_limit(bicycle):
    """On a fine grid of the wider box, and the share of the stable designs that have b >= 0."""
    forwards = numbers(1)["forwards"]
    assert forwards["shares"]["unbounded"] == forwards["shares_wider_box"]["unbounded"] == 0
    assert forwards["of_stable"] == pytest.approx(0.1725, abs=2e-3)
    designs = map_designs(bicycle, 200, PAPER_BOX.wider)
    assert not (designs.unbounded & designs.forwards).any()
    b = bicycle.R2 * np.sin(designs.lam) - designs.sigma * bicycle.c * np.cos(designs.lam)
    assert np.array_equal(b >= 0, designs.forwards)
    for example in numbers(1)["counterexamples"]:
        assert example["offset"] < -0.1
