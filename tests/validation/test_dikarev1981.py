"""Dikarev, Dikareva and Fufaev (1981): their bicycle, and what holds of their conclusions.

The stable speeds are those of docs/theory.md, from an independent eigenvalue code, to all printed digits.
"""

from itertools import product

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import CAPSIZE, UNBOUNDED, WEAVE, intervals_of

LAM, SIGMA = np.linspace(0, 0.3, 121)[:, np.newaxis], np.linspace(0, 0.15, 61)  # the paper's box
HALF_DIGIT = 5e-4  # m/s: the table is printed with three decimals


@pytest.fixture(scope="module")
def bicycle():
    return Bicycle.preset("dikarev1981")


@pytest.mark.parametrize(
    ("lam", "sigma", "V1", "lower", "V2", "upper"),
    [
        (0.20, 0.08, 4.056, WEAVE, 4.636, CAPSIZE),
        (0.30, 0.10, 3.913, WEAVE, 5.228, CAPSIZE),
        (0.05, 0.15, 4.807, WEAVE, np.inf, UNBOUNDED),
        (0.015, 0.1475, 3.621, CAPSIZE, 3.633, WEAVE),
    ],
)
def test_stable_speeds(bicycle, lam, sigma, V1, lower, V2, upper):
    found = intervals_of(characteristic_table(bicycle, lam, sigma))
    assert found.V1.tolist() == pytest.approx([V1], rel=0, abs=HALF_DIGIT)
    assert found.V2.tolist() == pytest.approx([V2], rel=0, abs=HALF_DIGIT)
    assert (found.lower.tolist(), found.upper.tolist()) == ([lower], [upper])


def test_no_stable_speed(bicycle):
    table = characteristic_table(bicycle, 0.10, 0.08)
    assert intervals_of(table).number == 0
    assert growth_rate_of(table, np.linspace(0, 50, 5001)).min() > 0


def test_damping_makes_it_stable(bicycle):
    """At (0.1, 0.08) δ = 1 kg m²/s gives 3.30 … 5.45 m/s; the upper end does not depend on δ."""
    found, stiffer = (
        intervals_of(characteristic_table(bicycle.with_delta(delta), 0.1, 0.08)) for delta in (1, 2)
    )
    assert found.V1.tolist() == pytest.approx([3.30], rel=0, abs=5e-3)
    assert found.V2.tolist() == pytest.approx([5.45], rel=0, abs=5e-3)
    assert found.upper.tolist() == [CAPSIZE]
    assert stiffer.V2.tolist() == pytest.approx(found.V2.tolist(), rel=1e-14)


def test_conclusion_1_does_not_hold(bicycle):
    """'A finite interval for any parameters': small λ and large σ have no upper end."""
    found = intervals_of(characteristic_table(bicycle, LAM, SIGMA))
    unbounded = np.isinf(found.V2).any(axis=-1)
    assert 0 < np.count_nonzero(unbounded) < np.count_nonzero(found.number) < unbounded.size
    lam, sigma = np.broadcast_arrays(LAM, SIGMA)
    assert lam[unbounded].max() < 0.15
    assert sigma[unbounded].min() > 0.05
    # far above any capsize speed: still stable
    assert growth_rate_of(characteristic_table(bicycle, lam[unbounded], sigma[unbounded]), 1e4).max() < 0


def test_unrefined_model_is_nowhere_stable(bicycle):
    """Without the refinement no design of the paper's box has a stable speed; with it many have."""
    assert not intervals_of(characteristic_table(bicycle, LAM, SIGMA, model="unrefined")).number.any()
    assert intervals_of(characteristic_table(bicycle, LAM, SIGMA)).number.any()


def test_printed_inertias_are_no_rigid_body(bicycle):
    first, second = bicycle.warnings
    assert "A2 + B2 < C2" in first
    assert "C2 > m2 R2²" in second


def test_unbounded_intervals_remain_with_other_readings(bicycle):
    """A and B exchanged on either part, A2 ten times as large, lighter wheels.

    Conclusion 1 fails inside the box in every reading but the last, where σ must exceed 0.156.
    """
    n = {key: value for key, value in bicycle.numbers().items() if value is not None}
    finite = []
    for swap1, swap2, A2, C in product((0, 1), (0, 1), (0.036, 0.36), (0.05, 0.1, 0.2, 0.5)):
        first = ("B1", "A1") if swap1 else ("A1", "B1")
        second = ("B2", "A2") if swap2 else ("A2", "B2")
        inertias = dict(zip((*first, *second, "C1", "C2"), (3.3, 6.7, A2, 0.22, C, C), strict=True))
        other = Bicycle.from_mapping({**n, **inertias})
        if not np.isinf(intervals_of(characteristic_table(other, LAM, SIGMA)).V2).any():
            finite.append((swap1, swap2, A2, C))
            assert intervals_of(characteristic_table(other, LAM, 0.2)).upper.max() == UNBOUNDED
    assert finite == [(1, 1, 0.36, 0.5)]
