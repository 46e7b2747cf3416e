"""NAME=VALUE of a bicycle's parameters, in their units."""

from __future__ import annotations

import click

from bikestab.errors import InputError, nearest
from bikestab.units import quantity, units_in


def values_given(_: click.Context, option: click.Parameter, texts: tuple[str, ...]) -> dict[str, float]:
    values: dict[str, float] = {}
    for text in texts:
        name, equals, number = text.partition("=")
        if not equals:
            raise click.BadParameter(f"{text!r} is not NAME=VALUE, e.g. delta=1", param=option)
        try:
            values[name.strip()] = parameter(name.strip(), number)
        except InputError as error:
            raise click.BadParameter(f"{text!r}: {error.problem}; {error.hint}", param=option) from None
    return values


def deviations_given(
    context: click.Context, option: click.Parameter, texts: tuple[str, ...]
) -> tuple[bool, dict[str, float]]:
    """Whether those of the bicycle's file are asked for, and others by their parameters' names."""
    given = values_given(context, option, tuple(text for text in texts if text != "file"))
    for name, value in given.items():
        if value <= 0:
            raise click.BadParameter(
                f"{name}={value:g} is no standard deviation; allowed: above 0", param=option
            )
    return "file" in texts, given


def parameter(name: str, text: str) -> float:
    """The value in SI units; InputError for another unit, or for any where there is no such parameter."""
    from bikestab.bicycle import PAPER
    from bikestab.notation import MEASURED, MEIJAARD
    from bikestab.rider import RIDER

    known = {**PAPER, **MEIJAARD, **MEASURED, **RIDER}
    try:
        return quantity(text, units_in(known.get(name, "")))
    except InputError:
        if name in known:
            raise
        raise InputError(f"there is no parameter {name!r}", hint=nearest(name, known)) from None
