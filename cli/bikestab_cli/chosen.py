"""The options that choose designs: tilt or head angle, trail, fork offset."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.options import (
    ANGLE_VALUE,
    ANGLES,
    LENGTH_VALUE,
    LENGTHS,
    TRAIL_VALUE,
    TRAILS,
    told_as_options,
)

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle

Given = dict[str, Any]  # what was typed, in SI: numbers, or lists of them
_OPTIONS: tuple[tuple[str, Any, Any, str, str, str], ...] = (
    ("--lam", ANGLE_VALUE, ANGLES, "ANGLE", "Tilt of the steering axis: 0.1, 19deg", "0.05:0.3:6"),
    ("--sigma", TRAIL_VALUE, TRAILS, "NUMBER", "Trail divided by the wheelbase: 0.08", "0:0.15:16"),
    ("--head-angle", ANGLE_VALUE, ANGLES, "ANGLE", "Instead of --lam: 71deg", "68deg:74deg:7"),
    ("--trail", LENGTH_VALUE, LENGTHS, "LENGTH", "Instead of --sigma: 55mm", "40mm:80mm:5"),
    ("--offset", LENGTH_VALUE, LENGTHS, "LENGTH", "Fork offset, instead of one of the two: 45mm", "0:80mm:5"),
)


def design_options(*, ranges: bool = False) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """--lam, --sigma, --head-angle, --trail and --offset, as one argument ``given``; perhaps as ranges."""

    def decorated(function: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(function)
        def command(**arguments: Any) -> Any:
            typed = {name: arguments.pop(name) for name in _names()}
            return function(given={k: v for k, v in typed.items() if v is not None}, **arguments)

        for option, value, values, kind, text, example in reversed(_OPTIONS):
            command = click.option(
                option,
                type=values if ranges else value,
                metavar=f"{kind}|RANGE" if ranges else kind,
                help=f"{text} or {example}." if ranges else f"{text}.",
            )(command)
        return command

    return decorated


def _names() -> list[str]:
    return [option[2:].replace("-", "_") for option, *_ in _OPTIONS]


def designs_chosen(bicycle: Bicycle, given: Given) -> tuple[Any, Any]:
    """λ and σ of the designs, arrays of two axes that broadcast together; None for the bicycle's own.

    Of a range of tilts and one of trails every combination. A mistake is told of as one of the options.
    """
    from bikestab.geometry import design_given

    groups = (["lam", "head_angle"], ["sigma", "trail"], ["offset"])
    axes = [typed for names in groups if (typed := [name for name in names if name in given])]
    if len(axes) > 2 and any(_is_range(given[name]) for name in axes[2]):
        problem = "tilt and trail are given as well; give two of head angle, trail and offset"
        raise click.BadParameter(problem, param_hint="--offset")
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
