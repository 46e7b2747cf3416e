"""The options of what eigen shows at one speed: --shapes, --push, --over, --at and --until."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import click
from bikestab_cli.options import over_option, told_as_options
from bikestab_cli.quantities import SPEED_VALUE, Quantity

from bikestab.errors import InputError
from bikestab.units import ANGLE, LARGEST, RATE, TIME, quantity


class View(NamedTuple):
    """What is asked for at one speed, and at which; the middle of the widest stable interval for None."""

    shapes: bool
    push: dict[str, float]
    over: dict[str, list[float]]
    at: float | None
    until: float

    @property
    def kind(self) -> str:
        """Which of them, if one."""
        return "shapes" if self.shapes else "push" if self.push else "over" if self.over else ""


def _pushed(_: click.Context, option: click.Parameter, texts: tuple[str, ...]) -> dict[str, float]:
    units = {"roll": ANGLE, "steer": ANGLE, "roll_rate": RATE, "steer_rate": RATE}
    values: dict[str, float] = {}
    for part in (part for text in texts for part in text.split(",")):
        name, equals, number = part.partition("=")
        name = name.strip()
        if not equals or name not in units:
            problem = f"{part!r} is not STATE=VALUE, with one of {', '.join(units)}"
            raise click.BadParameter(problem, param=option)
        if name in values:
            raise click.BadParameter(f"{name} is given twice", param=option)
        try:
            values[name] = quantity(number, units[name], limits=LARGEST)
        except InputError as error:
            raise click.BadParameter(f"{part!r}: {error.problem}; {error.hint}", param=option) from None
    return values


def view_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """--shapes, --push, --over, --at and --until, as one argument ``view``."""

    @functools.wraps(function)
    def command(**arguments: Any) -> Any:
        view = View(*(arguments.pop(name) for name in View._fields))
        context = click.get_current_context()
        if sum(map(bool, (view.shapes, view.push, view.over))) > 1:
            raise click.UsageError("give one of --shapes, --push and --over", context)
        if len(view.over) > 2:
            raise click.UsageError("--over is for one or two parameters; more are --set", context)
        _check_used(view)
        if not view.until > 0:
            raise click.BadParameter("allowed: above 0", param_hint="--until")
        return function(view=view, **arguments)

    options = (
        click.option("--shapes", is_flag=True, help="Show how roll and steer take part in each mode."),
        click.option(
            "--push", metavar="STATE=VALUE,...", multiple=True, callback=_pushed,
            help="Show the motion after a push: 'roll_rate=0.5', of roll, steer, roll_rate, steer_rate.",
        ),
        over_option,
        click.option(
            "--at", type=SPEED_VALUE, metavar="SPEED",
            help="Speed of --shapes, --push and --over.  [default: the middle of the stable speeds]",
        ),
        click.option(
            "--until", type=Quantity("time", TIME), metavar="TIME", default="5", show_default=True,
            help="How long --push goes on [s].",
        ),
    )  # fmt: skip
    for option in reversed(options):
        command = option(command)
    return command


def _check_used(view: View) -> None:
    """Refuse options that are typed and say nothing of what is asked for."""
    context = click.get_current_context()
    for name, option, used, what in (
        ("at", "--at", view.kind, "--shapes, --push and --over; the table's speeds are --V"),
        ("until", "--until", view.kind == "push", "--push"),
        ("speeds", "--V", not view.kind, "the table along the speed; give --at"),
    ):
        if not used and context.get_parameter_source(name) != click.core.ParameterSource.DEFAULT:
            raise click.UsageError(f"{option} is for {what}", context)


@contextmanager
def told_as_views(**others: str) -> Iterator[None]:
    """Tell of the library's mistakes in its arguments as of these options, or of ``others``."""
    try:
        with told_as_options(V="--at", **others):
            yield
    except click.BadParameter as error:
        if error.param_hint == "--t":
            error.param_hint = "--until"
        raise
