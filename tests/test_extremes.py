"""Machines at the limits of what is allowed get an answer or one clear message: a sample of run_extremes."""

import pytest

from tests.references.run_extremes import outcomes


@pytest.mark.parametrize("first", range(0, 60, 15))
def test_extreme_machines(first):
    for seed in range(first, first + 15):
        for way, (result, text) in outcomes(seed).items():
            assert result in ("answer", "message"), f"seed {seed}, {way}: {result}\n{text}"
