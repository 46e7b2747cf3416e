"""Conclusion 3: the best designs."""

import numpy as np
import pytest
from scipy.linalg import eig

from bikestab.model import canonical_matrices
from bikestab.paper1981.controllability import modal_controllability
from tests.small import brute, numbers


def test_optima():
    wide, fast = numbers(3)["optima"][:2]
    assert (wide["sigma"], wide["V2"]) == (0.15, None)
    assert 0.0483 < wide["lam"] < 0.1230
    assert (fast["lam"], fast["sigma"]) == pytest.approx((0.3, 0.15))
    assert fast["growth_rate"] == pytest.approx(-0.386048, abs=1e-5)


def test_the_largest_ball(bicycle):
    """Its centre and radius; points just inside the sphere are stable, some just outside are not."""
    ball = numbers(3)["ball"]
    step = 1 / (ball["points"] - 1)
    assert ball["lam"] == pytest.approx(0.122, abs=0.3 * step)
    assert ball["sigma"] == pytest.approx(0.132, abs=0.15 * step)
    assert ball["V"] == pytest.approx(6.1, abs=15 * step)
    direction = np.random.default_rng(3).normal(size=(300, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    centre, sides = np.array([ball["lam"], ball["sigma"], ball["V"]]), np.array([0.3, 0.15, 15])
    for share, expected in ((1 - 2 / ball["points"] / ball["radius"], True), (1.5, False)):
        points = centre + share * ball["radius"] * sides * direction
        growth = [brute(bicycle, lam, sigma, [V])[0] for lam, sigma, V in points]
        assert bool(max(growth) < 0) is expected


def test_modal_controllability_by_left_eigenvectors(bicycle):
    """From the matrices of Meijaard et al. and scipy's left eigenvectors."""
    lam, sigma, V = 0.2, 0.12, 5.0
    M, C1, K0, K2 = canonical_matrices(bicycle, lam, sigma)
    forces = np.hstack([bicycle.g * K0 + V**2 * K2, V * C1])
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, forces)]])
    B = np.concatenate([[0, 0], np.linalg.solve(M, [0, 1])])
    _, left, _ = eig(A, left=True)
    expected = np.abs(left.conj().T @ B) / np.linalg.norm(B)
    found = modal_controllability(bicycle, np.array([lam, 0.3]), np.array([sigma, 0.1]), V)
    assert found.shape == (2,)
    assert found[0] == pytest.approx(expected.min(), rel=1e-9)
