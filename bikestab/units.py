"""Numbers the way people write them: ``0.3``, ``18deg``, ``55mm``, ``20km/h``, ``850 g``, ``3 lb in²``."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from numbers import Real

from bikestab.errors import InputError, nearest

Units = Mapping[str, float]  # of one dimension: how many SI units each is

# foot, inch, pound: exact since 1959; mile per hour and knot: 1609.344 m and 1852 m in 3600 s, exact
ANGLE = {"rad": 1.0, "deg": math.pi / 180, "°": math.pi / 180}
LENGTH = {"m": 1.0, "mm": 0.001, "cm": 0.01, "in": 0.0254, "ft": 0.3048}
SPEED = {"m/s": 1.0, "km/h": 1 / 3.6, "mph": 0.44704, "kn": 1852 / 3600}
MASS = {"kg": 1.0, "g": 0.001, "lb": 0.45359237}
INERTIA = {f"{m} {r}²": M * R * R for m, M in MASS.items() for r, R in LENGTH.items()}
DAMPING = {"kg m²/s": 1.0, "N m s": 1.0}
ACCELERATION = {"m/s²": 1.0, "ft/s²": 0.3048}
PURE: dict[str, float] = {}

_DIMENSIONS: dict[str, Units] = {
    "an angle": ANGLE, "a length": LENGTH, "a speed": SPEED, "a mass": MASS, "a moment of inertia": INERTIA,
    "a damping": DAMPING, "an acceleration": ACCELERATION, "a plain number": PURE,
}  # fmt: skip
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", re.ASCII)
_COMMA = re.compile(r"[-+]?\d+,\d+\s*[^\d\s,]*", re.ASCII)
_MOST_SHOWN = 6


def quantity(value: object, units: Units, *, key: tuple[str | int, ...] = ()) -> float:
    """A finite number in SI units from a number or from text with one of ``units``.

    Raises InputError for anything else, naming the units that are understood.
    """
    if isinstance(value, str):
        value = _read(value, units, key)
    if type(value).__name__ in ("bool", "bool_") or not isinstance(value, Real):
        raise InputError(f"{shown(value)} is not a number", key=key, hint=_allowed(units))
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise InputError(f"{shown(value)} is not finite", key=key, hint=_allowed(units))
    return number


def units_in(meaning: str) -> Units:
    """The units of what is described with its SI unit in brackets at the end, such as ``wheelbase [m]``."""
    symbol = meaning.rpartition("[")[2].rstrip("]")
    return next((units for units in _DIMENSIONS.values() if symbol in units), PURE)


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
    unit = " ".join(re.split(r"[\s*·]+", written.replace("**", "^"))).replace("^", "").replace("2", "²")
    if unit in units:
        per = 1 / units[unit]  # dividing by a thousand is right to the last digit, as 0.001 is not
        return float(number[0]) / per if per.is_integer() else float(number[0]) * units[unit]
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


def _allowed(units: Units) -> str:
    if not units:
        return "allowed: a number"
    names = list(units)[:_MOST_SHOWN] + ["..."] * (len(units) > _MOST_SHOWN)
    return f"allowed: a number, or one with a unit ({', '.join(names)})"
