"""Values that stand together in a config → the same in one unit."""

from __future__ import annotations

from typing import Any

from pydantic_core import PydanticCustomError

from bikestab.errors import InputError
from bikestab.units import united


def mistake(problem: str, hint: str, key: tuple[str | int, ...] = ()) -> PydanticCustomError:
    """What a validator raises; ``key`` is a whole path, and needed only where pydantic's own is not it."""
    return PydanticCustomError("bikestab", "{problem}", {"problem": problem, "hint": hint, "key": key})


def one_unit(given: Any) -> Any:
    """An axis as it is given, numbers without a unit in that of the others; what is no axis as it is."""
    if not isinstance(given, dict):
        return given
    found = dict(given)
    if {"start", "stop"} <= found.keys():
        found["start"], found["stop"] = in_one_unit([found["start"], found["stop"]])
    if isinstance(found.get("values"), list):
        found["values"] = in_one_unit(found["values"])
    return found


def in_one_unit(values: Any, key: tuple[str | int, ...] = ()) -> list[Any]:
    """Values, those without a unit in that of the others; the mistake of those beside two that differ."""
    try:
        return united(values)
    except InputError as error:
        raise mistake(error.problem, error.hint, key) from None
