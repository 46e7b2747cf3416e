"""Angles and speeds the way people write them: ``0.3``, ``18deg``, ``20km/h``."""

from __future__ import annotations

import math
import re
from numbers import Real

from bikestab.errors import InputError

ANGLE = {"rad": 1.0, "deg": math.pi / 180, "°": math.pi / 180}
SPEED = {"m/s": 1.0, "km/h": 1 / 3.6, "mph": 0.44704}  # mph: 1609.344 m / 3600 s, exact
PURE: dict[str, float] = {}

_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\d\s]*)\s*")


def quantity(value: object, units: dict[str, float], *, key: tuple[str | int, ...] = ()) -> float:
    """A finite number in SI units from a number or from text with one of ``units``.

    Raises InputError for anything else, naming the units that are understood.
    """
    what = f"a number, or one with a unit ({', '.join(units)})" if units else "a number"
    if isinstance(value, str):
        match = _QUANTITY.fullmatch(value)
        if match and (not match[2] or match[2] in units):
            value = float(match[1]) * units.get(match[2], 1.0)
    if type(value).__name__ in ("bool", "bool_") or not isinstance(value, Real):
        raise InputError(f"{shown(value)} is not a number", key=key, hint=f"allowed: {what}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise InputError(f"{shown(value)} is not finite", key=key, hint=f"allowed: {what}")
    return number


def shown(value: object) -> str:
    """A value as it is quoted in a message: short, on one line."""
    try:
        text = "nothing" if value is None else repr(value) if isinstance(value, str) else str(value)
    except ValueError:  # Python does not print integers of thousands of digits
        return "an integer of thousands of digits"
    text = " ".join(text.split())
    return text if len(text) <= 60 else text[:57] + "..."
