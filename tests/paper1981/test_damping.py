"""Conclusion 4: boundaries that damping moves."""

import numpy as np
import pytest

from bikestab.paper1981.damping import single_designs
from tests.small import brute, numbers


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


def test_a_single_design_is_followed_from_where_it_appears(bicycle):
    last = single_designs(bicycle, (0.1, 1.0))[-1]
    assert [row.V1 is None for row in last.sweep] == [True, False]
    assert last.stable_from == 1.0
