"""The options that choose designs: tilt or head angle, trail, fork offset."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import click
from bikestab_cli.options import told_as_options
from bikestab_cli.quantities import (
    ANGLE_ENDS,
    ANGLE_VALUE,
    ANGLES,
    LENGTH_ENDS,
    LENGTH_VALUE,
    LENGTHS,
    TRAIL_ENDS,
    TRAIL_VALUE,
    TRAILS,
    Ends,
)

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle

Given = dict[str, Any]  # what was typed, in SI: numbers, or lists of them
_TOO_MANY = "tilt and trail are given as well; give two of head angle, trail and offset"
_ANGLE = ("ANGLE", ANGLE_VALUE, ANGLES, ANGLE_ENDS)
_NUMBER = ("NUMBER", TRAIL_VALUE, TRAILS, TRAIL_ENDS)
_LENGTH = ("LENGTH", LENGTH_VALUE, LENGTHS, LENGTH_ENDS)
_OPTIONS: tuple[tuple[str, tuple[str, Any, Any, Any], str, str, str], ...] = (
    ("--lam", _ANGLE, "Tilt of the steering axis: 0.1, 19deg", "0.05:0.3:6", "17deg:19deg"),
    ("--sigma", _NUMBER, "Trail divided by the wheelbase: 0.08", "0:0.15:16", "0.07:0.09"),
    ("--head-angle", _ANGLE, "Instead of --lam: 71deg", "68deg:74deg:7", "71deg:73deg"),
    ("--trail", _LENGTH, "Instead of --sigma: 55mm", "40mm:80mm:5", "50mm:60mm"),
    ("--offset", _LENGTH, "Fork offset, instead of one of the two: 45mm", "0:80mm:5", "40mm:50mm"),
)
Taking: TypeAlias = Literal["a value", "a range", "two ends"]


def design_options(taking: Taking = "a value") -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """--lam, --sigma, --head-angle, --trail and --offset, as one argument ``given``.

    A range is START:STOP:NUM, two ends are A:B; either may be one value too.
    """

    def decorated(function: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(function)
        def command(**arguments: Any) -> Any:
            typed = {name: arguments.pop(name) for name in _names()}
            return function(given={k: v for k, v in typed.items() if v is not None}, **arguments)

        for option, (kind, value, values, ends), text, of_range, of_ends in reversed(_OPTIONS):
            of_kind, metavar, told = {
                "a value": (value, kind, f"{text}."),
                "a range": (values, f"{kind}|RANGE", f"{text} or {of_range}."),
                "two ends": (ends, "A:B", f"{text} or {of_ends}."),
            }[taking]
            command = click.option(option, type=of_kind, metavar=metavar, help=told)(command)
        return command

    return decorated


def _names() -> list[str]:
    return [option[2:].replace("-", "_") for option, *_ in _OPTIONS]


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _bad(name: str, problem: str) -> click.BadParameter:
    return click.BadParameter(problem, param_hint=_option(name))


def designs_chosen(bicycle: Bicycle, given: Given) -> tuple[Any, Any]:
    """λ and σ of the designs, arrays of two axes that broadcast together; None for the bicycle's own.

    Of a range of tilts and one of trails every combination. A mistake is told of as one of the options.
    """
    from bikestab.geometry import design_given

    groups = (["lam", "head_angle"], ["sigma", "trail"], ["offset"])
    axes = [typed for names in groups if (typed := [name for name in names if name in given])]
    if len(axes) > 2 and any(_is_range(given[name]) for name in axes[2]):
        raise _bad("offset", _TOO_MANY)
    shaped = {}
    for axis, names in enumerate(axes):
        for name in names:
            shaped[name] = [[v] for v in _list(given[name])] if axis == 0 else [_list(given[name])]
    with told_as_options():
        return design_given(shaped, bicycle.c, bicycle.R2, (bicycle.lam, bicycle.sigma))


def design_chosen(bicycle: Bicycle, given: Given) -> tuple[float, float]:
    """λ and σ of the one design that is chosen, or the bicycle's own."""
    from bikestab.arguments import design_of

    lam, sigma = designs_chosen(bicycle, given)
    with told_as_options():
        tilt, trail = (float(values.flat[0]) for values in design_of(bicycle, lam, sigma))
    doubt_designs(given, tilt, trail, bicycle.c)
    return tilt, trail


def box_chosen(bicycle: Bicycle, given: Given) -> dict[str, Ends]:
    """Least and largest λ and σ of the box of designs between the ends that are ``given``, as far as known.

    A mistake is told of as one of the options.
    """
    from bikestab.geometry import design_given

    for name, (start, stop) in given.items():
        if stop < start:
            raise _bad(name, f"{start:g}:{stop:g} ends before it starts")
    if "offset" in given:
        others = [name for name in given if name != "offset"]
        if len(others) > 1:
            raise _bad("offset", _TOO_MANY)
        if others and given[others[0]][0] < given[others[0]][1]:
            option = _option(others[0])
            raise _bad(
                "offset", f"with a range of {option} it is no box of tilts and trails; give it one value"
            )
    with told_as_options():
        designs = design_given(given, bicycle.c, bicycle.R2)
    box = {
        name: (float(values.min()), float(values.max()))
        for name, values in zip(("lam", "sigma"), designs, strict=True)
        if values is not None
    }
    if len(box) == 2:
        doubt_designs(given, box["lam"][0], min(box["sigma"], key=abs), bicycle.c)
    return box


def doubt_designs(given: Given, lam: float, sigma: float, wheelbase: float) -> None:
    """Warn of the likely mistake in the least λ [rad] and the least |σ| of designs that were ``given``."""
    from bikestab.plausible import design_doubts

    for text in design_doubts(lam, sigma, wheelbase) if given else ():
        click.echo(f"warning: {text}", err=True)


def is_single(given: Given) -> bool:
    """Whether one design is chosen, not a range."""
    return not any(_is_range(value) for value in given.values())


def _is_range(value: Any) -> bool:
    return isinstance(value, list) and len(value) > 1


def _list(value: Any) -> list[float]:
    return value if isinstance(value, list) else [value]
