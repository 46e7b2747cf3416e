"""Conclusion 4: boundaries that damping moves."""

import numpy as np
import pytest

from bikestab.paper1981.damped_designs import single_designs
from tests.small import brute, numbers


def test_damping(bicycle):
    found = numbers(4)
    assert found["p0_change"] == 0
    assert found["unbounded_changed"] == 0
    assert found["everywhere"]["marked_from"] == pytest.approx(0.0409, rel=0.02)
    unstable = found["single_designs"][-1]
    assert (unstable["lam"], unstable["sigma"], unstable["without"]["V1"]) == (0.10, 0.08, None)
    at_one = next(row for row in unstable["sweep"] if row["delta"] == 1)
    assert (at_one["V1"], at_one["V2"]) == pytest.approx((3.30, 5.45), abs=5e-3)
    damped = bicycle.with_delta(1.0)
    around = brute(damped, 0.10, 0.08, [0.99 * at_one["V1"], 1.01 * at_one["V1"], 5.44, 5.46])
    assert (around < 0).tolist() == [False, True, True, False]


def test_fold_moves_with_damping(bicycle):
    """The smallest stable σ at λ = 0.3 falls by 12.6 % at δ = 0.1; what is between is stable only then."""
    row = next(row for row in numbers(4)["everywhere"]["changes"] if row["delta"] == 0.1)
    assert row["sigma_min_change"][2] == pytest.approx(-0.1258, abs=1e-3)
    speeds = np.linspace(2, 5, 3001)
    between = row["sigma_min"][2] * 1.05
    assert (brute(bicycle.with_delta(0.1), 0.3, between, speeds) < 0).any()
    assert not (brute(bicycle, 0.3, between, speeds) < 0).any()


def test_a_single_design_is_followed_from_where_it_appears(bicycle):
    last = single_designs(bicycle, (0.1, 1.0))[-1]
    assert [row.V1 is None for row in last.sweep] == [True, False]
    assert last.stable_from == pytest.approx(0.6757834, abs=1e-6)


def test_an_upper_end_that_is_weave_moves():
    """λ = 0.03, σ = 0.15: 3.762, 3.810 and 4.327 m/s for δ = 0, 0.01 and 0.1 kg m²/s."""
    design = next(d for d in numbers(4)["single_designs"] if (d["lam"], d["sigma"]) == (0.03, 0.15))
    assert design["without"]["upper"] == "weave"
    V2 = {row["delta"]: row["V2"] for row in design["sweep"]}
    expected = (3.762, 3.810, 4.327)
    assert (design["without"]["V2"], V2[0.01], V2[0.1]) == pytest.approx(expected, abs=5e-4)


def test_onset_by_eigenvalues(bicycle):
    onset = numbers(4)["single_designs"][-1]["stable_from"]
    assert onset == pytest.approx(0.676, abs=5e-4)
    speeds = np.linspace(3, 5.5, 5001)
    assert not (brute(bicycle.with_delta(0.999 * onset), 0.10, 0.08, speeds) < 0).any()
    assert (brute(bicycle.with_delta(1.001 * onset), 0.10, 0.08, speeds) < 0).any()
