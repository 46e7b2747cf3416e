"""Conclusion 2: widths along both axes, and where stability ends."""

import pytest

from tests.small import brute, numbers


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
