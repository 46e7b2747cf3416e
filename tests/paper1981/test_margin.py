"""Conclusion 3: the best designs."""

import pytest

from tests.small import numbers


def test_optima():
    wide, fast = numbers(3)["optima"][:2]
    assert (wide["sigma"], wide["V2"]) == (0.15, None)
    assert 0.0483 < wide["lam"] < 0.1230
    assert (fast["lam"], fast["sigma"]) == pytest.approx((0.3, 0.15))
    assert fast["growth_rate"] == pytest.approx(-0.386048, abs=1e-5)
