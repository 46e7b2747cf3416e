"""Numbers the way people write them: ``0.3``, ``18deg``, ``55mm``, ``20km/h``, ``850 g``, ``3 lb in²``."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Mapping, Sequence
from numbers import Real
from typing import Any, TypeAlias

from bikestab.errors import InputError, nearest
from bikestab.limits import MOST, MOST_SPEED, MOST_TRAIL

Size: TypeAlias = "tuple[int, int] | float"  # a quotient of whole numbers, or a double
Units: TypeAlias = Mapping[str, Size]  # of one dimension: how many SI units each is

# foot, inch, pound: exact since 1959; mile per hour and knot: 1609.344 m and 1852 m in 3600 s, exact
_DEGREE = math.pi / 180  # as a double, so that tilts and head angles of whole degrees add up to 90
_RATIOS = {
    "m": (1, 1), "mm": (1, 1000), "cm": (1, 100), "in": (254, 10_000), "ft": (3048, 10_000),
    "kg": (1, 1), "g": (1, 1000), "lb": (45_359_237, 10**8),
}  # fmt: skip
ANGLE: Units = {"rad": (1, 1), "deg": _DEGREE, "°": _DEGREE}
LENGTH: Units = {unit: _RATIOS[unit] for unit in ("m", "mm", "cm", "in", "ft")}
SPEED: Units = {"m/s": (1, 1), "km/h": (10, 36), "mph": (44_704, 100_000), "kn": (1852, 3600)}
MASS: Units = {unit: _RATIOS[unit] for unit in ("kg", "g", "lb")}
INERTIA: Units = {
    f"{m} {r}²": (_RATIOS[m][0] * _RATIOS[r][0] ** 2, _RATIOS[m][1] * _RATIOS[r][1] ** 2)
    for m in MASS for r in LENGTH
}  # fmt: skip
DAMPING: Units = {"kg m²/s": (1, 1), "N m s": (1, 1)}
ACCELERATION: Units = {"m/s²": (1, 1), "ft/s²": _RATIOS["ft"]}
RATE: Units = {"rad/s": (1, 1), "deg/s": _DEGREE, "°/s": _DEGREE}
TIME: Units = {"s": (1, 1), "ms": (1, 1000), "min": (60, 1)}
PURE: Units = {}

BUILDERS = {"m": ("mm", 1e3), "rad": ("deg", 180 / math.pi)}  # in which a frame is built, and how many

_DIMENSIONS: dict[str, Units] = {
    "an angle": ANGLE, "a length": LENGTH, "a speed": SPEED, "a mass": MASS, "a moment of inertia": INERTIA,
    "a damping": DAMPING, "an acceleration": ACCELERATION, "a rate": RATE, "a time": TIME,
    "a plain number": PURE,
}  # fmt: skip
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", re.ASCII)
LARGEST = f"no number is larger than {sys.float_info.max:.2g}"  # which is true wherever one is typed
_COMMA = re.compile(r"[-+]?\d+,\d+\s*[^\d\s,]*", re.ASCII)
_MOST_SHOWN = 6
_LONGEST = 400  # of a number that is taken exactly


def quantity(value: object, units: Units, *, key: tuple[str | int, ...] = (), limits: str = "") -> float:
    """A finite number in SI units from a number or from text with one of ``units``.

    Raises InputError for anything else, naming the units that are understood. ``limits`` says how large it
    may be where that is not as of parameters.
    """
    typed = value
    if isinstance(value, str):
        value = _read(value, units, key)
    if type(value).__name__ in ("bool", "bool_") or not isinstance(value, Real):
        raise InputError(f"{shown(value)} is not a number", key=key, hint=_allowed(units))
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if isinstance(typed, (str, int)):  # which stand for numbers that no double holds
        if math.isinf(number):
            raise InputError(f"{shown(typed)} is out of range", key=key, hint=limits or _limits(units))
        if number == 0 and isinstance(typed, str) and _telling(typed):
            hint = "write 0 if that is meant"
            raise InputError(f"{shown(typed)} is too small: it would be 0", key=key, hint=hint)
    if not math.isfinite(number):
        raise InputError(f"{shown(value)} is not finite", key=key, hint=_allowed(units))
    return number


def no_double(text: str) -> bool:
    """Whether a number in decimals is too large for a double, or so small that it would be 0."""
    number = float(text)
    return math.isinf(number) or (number == 0 and _telling(text))


def _telling(text: str) -> bool:
    """Whether a number in decimals has a digit other than 0 before its exponent."""
    match = _NUMBER.match(text.strip())
    return bool(match and match[0].lower().partition("e")[0].strip("+-.0"))


def _limits(units: Units) -> str:
    """How large a parameter or a speed may be, by its dimension."""
    if units == ANGLE:
        return "allowed: between -90deg and 90deg, of a head angle between 0deg and 180deg"
    if units in (RATE, TIME):
        return LARGEST
    if units == SPEED:
        return f"allowed: 0 ... {MOST_SPEED:g} m/s"
    if not units:
        return f"allowed: up to {MOST:g}, of sigma up to {MOST_TRAIL:g}"
    return f"allowed: up to {MOST:g} {next(iter(units))}"


def united(values: Sequence[Any]) -> list[Any]:
    """The ends of a range, or a value and its uncertainty, with one of no unit in that of the other.

    As the 40 of ``40:80mm``. In lists, of which configs and volumes of earlier versions have some, each value
    stands for itself: see ``bare_among``.

    InputError for numbers of no unit beside two that differ. What is no number stays as it is.
    """
    units = {unit: value for value in values if (unit := _unit_of(value))}
    bare = [_unit_of(value) == "" and float(value) != 0 for value in values]  # zero is zero in all
    if not any(bare) or not units:
        return list(values)
    if len(units) > 1:
        first = values[bare.index(True)]
        problem = f"{shown(first)} has no unit, and others beside it have {' and '.join(units)}"
        raise InputError(problem, hint=f"write {first}{next(iter(units))}, or the unit that is meant")
    unit = next(iter(units))
    return [f"{value} {unit}" if alone else value for value, alone in zip(values, bare, strict=True)]


def bare_among(values: Sequence[Any]) -> str:
    """A note on the first number of a list that has no unit, and is in SI units, beside some in others."""
    strange = {unit for units in _DIMENSIONS.values() for unit, size in units.items() if size != (1, 1)}
    kinds = [_unit_of(value) for value in values]
    if strange.isdisjoint(kinds):
        return ""
    bare = [value for value, unit in zip(values, kinds, strict=True) if unit == "" and float(value) != 0]
    return f"{shown(bare[0]).strip(chr(39))} has no unit, so in a list it is in SI units" if bare else ""


def in_its_unit(text: str) -> float | None:
    """The number in SI units, whichever unit it has; None for what is no number with a unit."""
    number, unit = _NUMBER.match(text.strip()), _unit_of(text)
    sizes = [units[unit] for units in _DIMENSIONS.values() if unit in units] if unit else []
    return _times(number[0], sizes[0]) if number and sizes else None


def dimension_of(text: str) -> str:
    """What a number is by its unit, as ``a length``; empty for one without a unit that is known."""
    unit = _unit_of(text)
    return next((name for name, units in _DIMENSIONS.items() if unit and unit in units), "")


def _unit_of(value: object) -> str | None:
    """The unit that a number is written with, empty for none; None for what is no number."""
    if isinstance(value, Real) and not isinstance(value, bool):
        return ""
    if not isinstance(value, str) or not (number := _NUMBER.match(value.strip())):
        return None
    unit = _spelled(value.strip()[number.end() :].strip())
    return unit if not unit or any(unit in units for units in _DIMENSIONS.values()) else None


def _spelled(unit: str) -> str:
    return " ".join(re.split(r"[\s*·]+", unit.replace("**", "^"))).replace("^", "").replace("2", "²")


def units_in(meaning: str) -> Units:
    """The units of what is described with its SI unit in brackets at the end, such as ``wheelbase [m]``."""
    symbol = meaning.rpartition("[")[2].rstrip("]")
    return next((units for units in _DIMENSIONS.values() if symbol in units), PURE)


def as_built(value: float, unit: str, digits: int = 6) -> str:
    """A quantity in SI units in those in which frames are built: lengths in mm, angles in degrees."""
    unit, size = BUILDERS.get(unit, (unit, 1.0))
    return f"{value * size:z.{digits}g} {unit}".removesuffix(" 1").replace(" deg", "°")


def shown(value: object) -> str:
    """A value as it is quoted in a message: on one line, without its middle where it is long."""
    try:
        text = "nothing" if value is None else repr(value) if isinstance(value, str) else str(value)
    except ValueError:  # Python does not print integers of thousands of digits
        return "an integer of thousands of digits"
    text = " ".join(text.split())
    return text if len(text) <= 60 else f"{text[:28]} ... {text[-27:]}"


def _read(text: str, units: Units, key: tuple[str | int, ...]) -> float | str:
    """The number in SI units, or the text where it is none; InputError where only its unit is wrong."""
    text = text.strip()
    number = _NUMBER.match(text)
    if not number:
        return text
    written = text[number.end() :].strip()
    if not written:
        return float(number[0])
    unit = _spelled(written)
    if unit in units:
        return _times(number[0], units[unit])
    if _COMMA.fullmatch(text):
        hint = f"write {shown(text.replace(',', '.', 1))}; {_allowed(units)}"
        raise InputError(f"{shown(text)} is not a number: it has a comma", key=key, hint=hint)
    if written[0].isdigit() or written[0] in ".,:+-_":
        return text
    for name, others in _DIMENSIONS.items():
        if unit in others:
            wanted = next(name for name, known in _DIMENSIONS.items() if known == units)
            problem = f"{shown(text)} is not a number: it is {name}, not {wanted}"
            raise InputError(problem, key=key, hint=_allowed(units))
    problem = f"{shown(text)} is not a number with a unit that is known"
    meant = nearest(unit, units)
    hint = f"{meant} {_allowed(units)}" if meant.startswith("did") else _allowed(units)
    raise InputError(problem, key=key, hint=hint)


def _times(number: str, size: Size) -> float:
    """The double nearest to a decimal number of units of a size."""
    plain = float(number)
    if isinstance(size, float):
        return plain * size
    if not plain or not math.isfinite(plain) or len(number) > _LONGEST:
        return plain * (size[0] / size[1])
    digits, _, exponent = number.lower().partition("e")
    whole, _, part = digits.partition(".")
    power = int(exponent or 0) - len(part)
    top, bottom = int(whole + part) * size[0], size[1]
    return top * 10**power / bottom if power >= 0 else top / (bottom * 10**-power)


def _allowed(units: Units) -> str:
    if not units:
        return "allowed: a number"
    names = list(units)[:_MOST_SHOWN] + ["..."] * (len(units) > _MOST_SHOWN)
    return f"allowed: a number, or one with a unit ({', '.join(names)})"
