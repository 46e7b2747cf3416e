"""Numbers with and without a unit."""

import math

import numpy as np
import pytest

from bikestab.errors import InputError
from bikestab.units import ANGLE, PURE, SPEED, quantity


@pytest.mark.parametrize(
    ("text", "units", "expected"),
    [
        (0.3, PURE, 0.3),
        (7, PURE, 7.0),
        ("1e-3", PURE, 1e-3),
        ("+.5", PURE, 0.5),
        ("5.", PURE, 5.0),
        ("-2", PURE, -2.0),
        ("18deg", ANGLE, math.pi / 10),
        ("18°", ANGLE, math.pi / 10),
        (" 18 deg ", ANGLE, math.pi / 10),
        ("-1.8e1deg", ANGLE, -math.pi / 10),
        ("0.3rad", ANGLE, 0.3),
        ("18km/h", SPEED, 5.0),
        ("5m/s", SPEED, 5.0),
        ("100mph", SPEED, 44.704),  # 160934.4 m in 3600 s
        ("0.3", ANGLE, 0.3),
    ],
)
def test_understood(text, units, expected):
    assert quantity(text, units) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize("number", [np.float64(3), np.float32(3), np.int64(3), 3])
def test_numbers_of_numpy_are_numbers(number):
    result = quantity(number, PURE)
    assert result == 3.0
    assert type(result) is float


@pytest.mark.parametrize("units", [PURE, ANGLE, SPEED])
@pytest.mark.parametrize(
    "nonsense",
    [
        "", " ", "abc", "1 2", "1,5", "1e", "--1", "0x10", "1_000", "deg", "3 furlongs", "nan", "inf", "1:2",
        True, False, np.True_, None, [], [1], {}, b"1", 1 + 2j,
    ],
)  # fmt: skip
def test_nonsense_is_no_number(nonsense, units):
    with pytest.raises(InputError, match="is not a number"):
        quantity(nonsense, units)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, np.float64("nan"), "1e400", 10**400])
def test_not_finite(value):
    with pytest.raises(InputError, match="is not finite"):
        quantity(value, PURE)


@pytest.mark.parametrize("value", [10**5000, "9" * 5000], ids=["int", "text"])
def test_a_number_too_long_to_print(value):
    with pytest.raises(InputError) as caught:
        quantity(value, PURE)
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize(("text", "units"), [("18deg", SPEED), ("20km/h", ANGLE), ("3m/s", PURE)])
def test_a_unit_of_something_else(text, units):
    with pytest.raises(InputError, match="is not a number"):
        quantity(text, units)


def test_the_message_names_key_value_and_units():
    with pytest.raises(InputError) as caught:
        quantity("18grad", ANGLE, key=("grid", "lam", "stop"))
    assert str(caught.value) == (
        "grid.lam.stop: '18grad' is not a number\nallowed: a number, or one with a unit (rad, deg, °)"
    )


def test_a_long_value_is_quoted_short():
    with pytest.raises(InputError) as caught:
        quantity("spam " * 100, PURE)
    assert len(str(caught.value).splitlines()[0]) < 90
