"""The ends of a range in a config → the same in one unit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from pydantic_core import PydanticCustomError

from bikestab.errors import InputError
from bikestab.units import bare_among, united


def mistake(problem: str, hint: str, key: tuple[str | int, ...] = ()) -> PydanticCustomError:
    """What a validator raises; ``key`` is a whole path, and needed only where pydantic's own is not it."""
    return PydanticCustomError("bikestab", "{problem}", {"problem": problem, "hint": hint, "key": key})


def all_of(mistakes: list[PydanticCustomError]) -> PydanticCustomError:
    """What a validator raises for several mistakes; there is at least one."""
    first, *others = (dict(each.context or {}) for each in mistakes)
    return PydanticCustomError("bikestab", "{problem}", {**first, "others": others})


def in_words(context: Mapping[str, Any] | None, key: tuple[str | int, ...]) -> list[InputError]:
    """The mistakes that such an error has in its ``context``; ``key`` where they have none of their own."""
    first: Mapping[str, Any] = context or {}
    return [
        InputError(each["problem"], key=each["key"] or key, hint=each["hint"])
        for each in (first, *first.get("others", ()))
    ]


def one_unit(given: Any) -> Any:
    """An axis as it is given, an end without a unit in that of the other; what is no axis as it is.

    In lists numbers without a unit are in SI units, whatever stands beside them; see ``bare_in_lists``.
    """
    if not isinstance(given, dict):
        return given
    found = dict(given)
    if {"start", "stop"} <= found.keys():
        found["start"], found["stop"] = in_one_unit([found["start"], found["stop"]])
    return found


def in_one_unit(values: Any, key: tuple[str | int, ...] = ()) -> list[Any]:
    """Values, those without a unit in that of the others; the mistake of those beside two that differ."""
    try:
        return united(values)
    except InputError as error:
        raise mistake(error.problem, error.hint, key) from None


def bare_in_lists(data: Any, key: str = "") -> Iterator[str]:
    """Notes on the lists of a config in which numbers have no unit beside others that have one."""
    if isinstance(data, dict):
        for name, value in data.items():
            if name != "lognormal":  # of which the second is the logarithm's
                yield from bare_in_lists(value, f"{key}.{name}".lstrip("."))
    elif isinstance(data, (list, tuple)):
        if note := bare_among(data):
            yield f"{key}: {note}"
        for i, value in enumerate(data):
            if isinstance(value, (dict, list)):
                yield from bare_in_lists(value, f"{key}[{i}]")
