"""How far what is found may be from what is expected: a speed, or per cent."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import BeforeValidator, WithJsonSchema

from bikestab.config.values import json_schema, mistake, reader
from bikestab.errors import InputError
from bikestab.units import PURE, SPEED, quantity, shown

_PERCENT = r"^\s*\d[\d.eE+-]*\s*%\s*$"
_speed = reader(SPEED, "positive")


def tolerance(value: object) -> float | str:
    """A speed [m/s], or per cent as text, such as ``1%``; raises the mistake of what is neither."""
    if not (isinstance(value, str) and value.rstrip().endswith("%")):
        return _speed(value)
    try:
        percent = quantity(value.rstrip()[:-1], PURE)
    except InputError:
        raise mistake(f"{shown(value)} is no percentage", "allowed: a number and %, such as 1%") from None
    if not 0 < percent <= 100:
        raise mistake(f"{percent:g}% is out of range", "allowed: above 0% up to 100%")
    return f"{percent:.15g}%"


def allowance(within: float | str, value: float) -> float:
    """How far from ``value`` a tolerance reaches, in its unit [m/s]."""
    return abs(value) * float(within[:-1]) / 100 if isinstance(within, str) else within


Within: TypeAlias = Annotated[
    float | str,
    BeforeValidator(tolerance),
    WithJsonSchema({"anyOf": [*json_schema(SPEED)["anyOf"], {"type": "string", "pattern": _PERCENT}]}),
]
