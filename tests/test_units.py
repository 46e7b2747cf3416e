"""Numbers with and without a unit."""

import math
import time
from contextlib import suppress
from fractions import Fraction

import numpy as np
import pytest

from bikestab.errors import InputError
from bikestab.units import (
    ACCELERATION,
    ANGLE,
    DAMPING,
    INERTIA,
    LENGTH,
    MASS,
    PURE,
    SPEED,
    bare_among,
    quantity,
    united,
    units_in,
)


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
        ("20 kn", SPEED, 37040 / 3600),
        ("55mm", LENGTH, 0.055),
        ("5.5 cm", LENGTH, 0.055),
        ("2.1in", LENGTH, 0.05334),
        ("3ft", LENGTH, 0.9144),
        ("-1e2mm", LENGTH, -0.1),
        ("850g", MASS, 0.85),
        ("187 lb", MASS, 84.82177319),  # 187 · 0.45359237
        ("32.174ft/s²", ACCELERATION, 9.8066352),
        ("2 N m s", DAMPING, 2.0),
        ("1.4e5 kg mm²", INERTIA, 0.14),
        ("1 lb in²", INERTIA, 0.45359237 * 0.0254**2),
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
        "5,5cm", "1 000 mm", "5m m", "m5", "1.2.3", "3 k g",
        True, False, np.True_, None, [], [1], {}, b"1", 1 + 2j,
    ],
)  # fmt: skip
def test_nonsense_is_no_number(nonsense, units):
    with pytest.raises(InputError, match="is not a number"):
        quantity(nonsense, units)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, np.float64("nan")])
def test_not_finite(value):
    with pytest.raises(InputError, match="is not finite"):
        quantity(value, PURE)


@pytest.mark.parametrize("value", [10**5000, "9" * 5000], ids=["int", "text"])
def test_a_number_too_long_to_print(value):
    with pytest.raises(InputError) as caught:
        quantity(value, PURE)
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize(
    ("text", "units", "problem"),
    [
        ("18deg", SPEED, "it is an angle, not a speed"),
        ("20km/h", ANGLE, "it is a speed, not an angle"),
        ("3m/s", PURE, "it is a speed, not a plain number"),
        ("55mm", MASS, "it is a length, not a mass"),
        ("5 kg m^2", LENGTH, "it is a moment of inertia, not a length"),
    ],
)
def test_a_unit_of_something_else(text, units, problem):
    with pytest.raises(InputError) as caught:
        quantity(text, units)
    assert caught.value.problem == f"'{text}' is not a number: {problem}"


@pytest.mark.parametrize(
    "text", ["0.14 kg m²", "0.14kg m^2", "0.14 kg*m^2", "0.14 kg·m²", "0.14 kg  m**2", "0.14 kg m2"]
)
def test_spellings_of_a_moment_of_inertia(text):
    assert quantity(text, INERTIA) == 0.14


EXACTLY = {
    "mm": (LENGTH, "1/1000"), "cm": (LENGTH, "1/100"), "in": (LENGTH, "254/10000"), "ft": (LENGTH, "0.3048"),
    "g": (MASS, "1/1000"), "lb": (MASS, "0.45359237"), "kg mm²": (INERTIA, "1/1000000"),
    "lb in²": (INERTIA, "0.0002926396534292"), "g cm²": (INERTIA, "1/10000000"),
    "km/h": (SPEED, "5/18"), "mph": (SPEED, "0.44704"), "kn": (SPEED, "463/900"),
}  # fmt: skip


@pytest.mark.parametrize("unit", EXACTLY)
def test_units_are_exact_to_the_nearest_double(unit):
    units, size = EXACTLY[unit]
    draw = np.random.default_rng(1)
    for digits, whole in zip(draw.integers(0, 18, 1000), draw.integers(-(10**9), 10**9, 1000), strict=True):
        for text in (f"{whole / 10 ** int(digits):.{digits}f}", f"{whole}e-{digits}", f"{whole}.{digits}E3"):
            assert quantity(f"{text}{unit}", units) == float(Fraction(text) * Fraction(size)), text


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0e999999999mm", 0.0), ("5e-321mm", 5e-324),
        ("1.7e308mm", 1.7e305), (".5mm", 0.0005), ("-5.mm", -0.005), ("+.5e+1mm", 0.005),
        (f"{'1' * 500}e-500mm", 1 / 9000),
    ],
)  # fmt: skip
def test_units_of_extreme_numbers(text, value):
    assert quantity(text, LENGTH) == pytest.approx(value, rel=1e-15, abs=0)


@pytest.mark.parametrize("text", ["1e400mm", "1e999999999mm", f"{'9' * 5000}mm"])
def test_units_of_numbers_that_are_too_large(text):
    with pytest.raises(InputError, match="is out of range"):
        quantity(text, LENGTH)


@pytest.mark.parametrize("text", ["1e-999999999mm", "4.9e-324mm", "-1e-400", f"0.{'0' * 400}1"])
def test_numbers_that_would_become_zero(text):
    with pytest.raises(InputError, match="is too small: it would be 0"):
        quantity(text, LENGTH)


@pytest.mark.parametrize("value", ["1e400", 10**400, -(10**400)])
def test_numbers_that_no_double_holds(value):
    with pytest.raises(InputError, match=r"is out of range\nallowed: up to 1e\+09"):
        quantity(value, PURE)


@pytest.mark.parametrize(
    ("text", "units", "hint"),
    [
        ("5,5cm", LENGTH, "write '5.5cm'"),
        ("18,5 deg", ANGLE, "write '18.5 deg'"),
        ("20kmh", SPEED, "did you mean 'km/h'?"),
        ("2inch", LENGTH, "did you mean 'in'?"),
        ("5 lbs", MASS, "did you mean 'lb'?"),
        ("5MM", LENGTH, "did you mean 'mm'?"),
    ],
)
def test_what_was_meant(text, units, hint):
    with pytest.raises(InputError, match="is not a number") as caught:
        quantity(text, units)
    assert caught.value.hint.startswith(hint)


@pytest.mark.parametrize("text", ["1{} x y", "1{}", "{}1", "1{}mm mm", "1,5{}cm", "1,5{}c m"])
def test_time_grows_with_length_and_not_with_its_square(text):
    start = time.process_time()
    for blank in (" ", "\t", "m", "*", "^"):
        with suppress(InputError):
            quantity(text.format(blank * 200_000), LENGTH)
    assert time.process_time() - start < 2


@pytest.mark.parametrize(
    ("meaning", "units"),
    [
        ("wheelbase [m]", LENGTH),
        ("inertia [kg m²]", INERTIA),
        ("[1]", PURE),
        ("", PURE),
        ("g [m/s²]", ACCELERATION),
    ],
)
def test_units_of_a_parameter(meaning, units):
    assert units_in(meaning) == units


def test_the_message_names_key_value_and_units():
    with pytest.raises(InputError) as caught:
        quantity("18grad", ANGLE, key=("grid", "lam", "stop"))
    assert str(caught.value) == (
        "grid.lam.stop: '18grad' is not a number with a unit that is known\n"
        "did you mean 'rad'? allowed: a number, or one with a unit (rad, deg, °)"
    )


def test_a_long_value_is_quoted_short():
    with pytest.raises(InputError) as caught:
        quantity("spam " * 100, PURE)
    assert len(str(caught.value).splitlines()[0]) < 90


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        (["40", "80mm"], ["40 mm", "80mm"]),
        ([0.05, "80 mm", 1], ["0.05 mm", "80 mm", "1 mm"]),
        (["0", "5cm", "60mm"], ["0", "5cm", "60mm"]),
        ([1, 2.5], [1, 2.5]),
        (["5cm", "60mm"], ["5cm", "60mm"]),
        ([True, "x", None, "5 ells"], [True, "x", None, "5 ells"]),
    ],
)
def test_numbers_without_a_unit_have_that_of_the_others(values, expected):
    assert united(values) == expected


@pytest.mark.parametrize(
    ("values", "bare"),
    [
        (["187lb", 85], "85"), (["85", "187 lb"], "85"), ([1, "2m", "3cm"], "1"), ([0, "18deg", 0.5], "0.5"),
        (["60kg", 85], ""), ([0, "18deg"], ""), ([1, 2], ""), (["1cm", "2mm"], ""), ([None, "x", "1cm"], ""),
        ([True, "20km/h", {"a": 1}], ""), ([], ""),
    ],
)  # fmt: skip
def test_numbers_of_no_unit_in_a_list_are_told_of(values, bare):
    """Unless zero, or where what stands beside them is in the SI unit anyway."""
    assert bare_among(values) == (f"{bare} has no unit, so in a list it is in SI units" if bare else "")


def test_which_unit_is_not_guessed():
    with pytest.raises(InputError, match="'50' has no unit, and others beside it have cm and mm"):
        united(["5cm", "60mm", "50"])
