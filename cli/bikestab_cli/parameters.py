"""NAME=VALUE of a bicycle's parameters, in their units."""

from __future__ import annotations

from collections.abc import Iterator

import click

from bikestab.errors import InputError, nearest
from bikestab.limits import MOST
from bikestab.units import Units, quantity, united, units_in

MOST_VALUES = 1_000_000


def values_given(_: click.Context, option: click.Parameter, texts: tuple[str, ...]) -> dict[str, float]:
    values: dict[str, float] = {}
    for text in texts:
        name, equals, number = text.partition("=")
        name = name.strip()
        if not equals:
            raise click.BadParameter(f"{text!r} is not NAME=VALUE, e.g. delta=1", param=option)
        if name in values:
            raise click.BadParameter(f"{name} is given twice", param=option)
        try:
            values[name] = parameter(name, number)
        except InputError as error:
            if number.count(",") > 1 or ("," in number and error.hint.startswith("allowed")):
                problem = f"{text!r} has several values, where one is taken"
                raise click.BadParameter(problem, param=option) from None
            raise click.BadParameter(f"{text!r}: {error.problem}; {error.hint}", param=option) from None
    return values


def deviations_given(
    context: click.Context, option: click.Parameter, texts: tuple[str, ...]
) -> tuple[bool, dict[str, float]]:
    """Whether those of the bicycle's file are asked for, and others by their parameters' names."""
    given = values_given(context, option, tuple(text for text in texts if text != "file"))
    for name, value in given.items():
        if not 0 < value <= MOST:
            problem = f"{name}={value:g} is no standard deviation; allowed: above 0 up to {MOST:g}"
            raise click.BadParameter(problem, param=option)
    return "file" in texts, given


def over_values(_: click.Context, option: click.Parameter, texts: tuple[str, ...]) -> dict[str, list[float]]:
    """The values of NAME=START:STOP:NUM, by the parameters' names."""
    found: dict[str, list[float]] = {}
    for name, start, stop, num in _over(option, texts, "START:STOP:NUM"):
        if not num.isdecimal() or not 2 <= int(num) <= MOST_VALUES:
            problem = f"{num!r} of {name} is not a number of values from 2 to {MOST_VALUES}"
            raise click.BadParameter(problem, param=option)
        steps = int(num) - 1
        found[name] = [start + (stop - start) * i / steps for i in range(steps)] + [stop]
    return found


def over_ends(
    _: click.Context, option: click.Parameter, texts: tuple[str, ...]
) -> dict[str, tuple[float, float]]:
    """The ends of NAME=START:STOP, by the parameters' names."""
    return {name: (start, stop) for name, start, stop, _ in _over(option, texts, "START:STOP")}


def _over(
    option: click.Parameter, texts: tuple[str, ...], form: str
) -> Iterator[tuple[str, float, float, str]]:
    seen: set[str] = set()
    for text in texts:
        name, _, ends = text.partition("=")
        parts, name = ends.split(":"), name.strip()
        if len(parts) != form.count(":") + 1 or not name:
            example = "mB=60:110:6" if form.endswith("NUM") else "mB=60:110"
            hint = f"; --set takes a list: --set {text}" if name and "," in ends and _has_set() else ""
            raise click.BadParameter(f"{text!r} is not NAME={form}, e.g. {example}{hint}", param=option)
        if name in seen:
            raise click.BadParameter(f"{name} is given twice", param=option)
        seen.add(name)
        try:
            start, stop = (parameter(name, part) for part in ends_of(parts[:2]))
        except InputError as error:
            raise click.BadParameter(f"{text!r}: {error.problem}; {error.hint}", param=option) from None
        if not start < stop:
            raise click.BadParameter(f"{text!r} does not end above its start", param=option)
        yield name, start, stop, parts[2].strip() if len(parts) > 2 else ""


def _has_set() -> bool:
    return any("--set" in each.opts for each in click.get_current_context().command.params)


def is_list(text: object, units: Units) -> bool:
    """Whether it is numbers with commas between, each of which would do alone."""
    if not isinstance(text, str) or "," not in text:
        return False
    try:
        for part in text.split(","):
            quantity(part, units)
    except InputError:
        return False
    return True


def ends_of(parts: list[str]) -> list[str]:
    """Two ends, of which one without a unit takes that of the other: it is told of, unless it is zero."""
    both: list[str] = united(parts)
    for part, text in zip(parts, both, strict=True):
        if part != text:
            unit = text.removeprefix(part).strip()
            click.echo(f"note: {part.strip()} in '{':'.join(parts)}' is in {unit}", err=True)
    return both


def parameter(name: str, text: str) -> float:
    """The value in SI units; InputError for another unit, or for any where there is no such parameter."""
    from bikestab.bicycle import PAPER
    from bikestab.gains import GAINS
    from bikestab.notation import MEASURED, MEIJAARD
    from bikestab.rider import RIDER

    known = {**PAPER, **MEIJAARD, **MEASURED, **RIDER, **GAINS}
    try:
        return quantity(text, units_in(known.get(name, "")))
    except InputError:
        if name in known:
            raise
        raise InputError(f"there is no parameter {name!r}", hint=nearest(name, known)) from None
