"""Numbers are printed with the digits that are certain, and no more."""

import math

import pytest
from bikestab_cli.output import certain
from hypothesis import given
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("value", "error", "most", "text"),
    [
        (4.292382536341104, 2e-15, 12, "4.292382536341"),
        (4.292382536341104, 0.0, 12, "4.292382536341"),
        (4.292382536341104, 1e-10, 12, "4.292382536"),
        (4.0, 1e-15, 12, "4.000000000000"),
        (4.0, 1e-4, 6, "4.000"),
        (24.333662909, 1e-7, 6, "24.333663"),
        (0.0, 0.0, 12, "0.000000000000"),
        (770461.0843244519, 1e-10, 12, "770461.084324452"),
        (94640.38798002, None, 12, "about 94640.4"),
        (1e18, 1e17, 12, "about 1e+18"),
    ],
)
def test_certain(value, error, most, text):
    assert certain(value, error, most) == text


def test_significant_digits():
    assert certain(3.913290770190, 1e-15, 13, "g") == "3.91329077019"
    assert certain(11.31603264181234, 1e-8, 13, "g") == "11.316033"


@given(st.floats(1e-3, 1e3), st.floats(-16, -2), st.floats(-1, 1))
def test_every_value_within_the_bound_prints_alike(value, power, share):
    error = value * 10**power
    text = certain(value, error)
    if not text.startswith("about"):
        digits = len(text.partition(".")[2])
        inside = min(max(value + share * error, value - error), value + error)
        assert f"{inside:.{digits}f}" == text
        finer = math.nextafter(value - error, -math.inf), math.nextafter(value + error, math.inf)
        assert digits == 12 or len({f"{end:.{digits + 1}f}" for end in finer}) == 2
