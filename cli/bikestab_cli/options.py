"""Options that several commands share, and the words in which results are told."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import click

from bikestab.errors import InputError
from bikestab.units import ANGLE, PURE, SPEED, quantity

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle

F = TypeVar("F", bound=Callable[..., Any])
DEFAULT_BICYCLE = "dikarev1981"
MOST_VALUES = 1_000_000


class Quantity(click.ParamType):
    """A number with or without a unit."""

    def __init__(self, name: str, units: dict[str, float]) -> None:
        self.name, self.units = name, units

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        try:
            number = quantity(value, self.units)
        except InputError as error:
            self.fail(f"{error.problem}; {error.hint}", param, ctx)
        if str(value).strip().endswith("deg") and math.pi / 4 < number < math.pi / 2:
            tilt = f"{90 - math.degrees(number):g}deg"
            click.echo(
                f"note: --lam is the tilt from the vertical; for a head angle of {value} give {tilt}",
                err=True,
            )
        return number


class QuantityRange(Quantity):
    """One such number, or START:STOP:NUM."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> list[float]:
        if isinstance(value, list):
            return value
        parts = str(value).split(":")
        if len(parts) == 1:
            return [super().convert(value, param, ctx)]
        if len(parts) != 3:
            self.fail(f"{value!r} is neither a number nor START:STOP:NUM, e.g. 0.05:0.3:6", param, ctx)
        start, stop = (super(QuantityRange, self).convert(part, param, ctx) for part in parts[:2])
        if not parts[2].strip().isdecimal() or not 2 <= int(parts[2]) <= MOST_VALUES:
            self.fail(
                f"{parts[2]!r} in {value!r} is not a number of values from 2 to {MOST_VALUES}", param, ctx
            )
        num = int(parts[2])
        return [start + (stop - start) * i / (num - 1) for i in range(num - 1)] + [stop]


class QuantityEnds(Quantity):
    """START:STOP, or one number that is both."""

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float]:
        if isinstance(value, tuple):
            return value
        parts = str(value).split(":")
        if len(parts) > 2:
            self.fail(f"{value!r} is neither a number nor START:STOP", param, ctx)
        start, stop = (super(QuantityEnds, self).convert(part, param, ctx) for part in (parts[0], parts[-1]))
        return start, stop


ANGLE_VALUE, TRAIL_VALUE, SPEED_VALUE = (
    Quantity(name, units) for name, units in (("angle", ANGLE), ("number", PURE), ("speed", SPEED))
)
ANGLES, TRAILS = QuantityRange("angle", ANGLE), QuantityRange("number", PURE)


def machine_options(function: F) -> F:
    """--bicycle, --model and --delta."""
    for option in (
        click.option(
            "--delta", type=Quantity("number", PURE),
            help="Steering damping δ [kg m²/s], instead of the bicycle's own.",
        ),
        click.option(
            "--model", type=click.Choice(["refined", "unrefined"]), default="refined", show_default=True,
            help="The paper's refined equations, or those before it.",
        ),
        click.option(
            "--bicycle", "bicycle_name", metavar="NAME|FILE", default=DEFAULT_BICYCLE, show_default=True,
            help="A bicycle that comes with bikestab (see 'bikestab bicycles'), or a YAML file.",
        ),
    ):  # fmt: skip
        function = option(function)
    return function


def _machine(_: click.Context, option: click.Parameter, texts: tuple[str, ...]) -> dict[str, float]:
    values: dict[str, float] = {}
    for text in texts:
        name, equals, number = text.partition("=")
        if not equals:
            raise click.BadParameter(f"{text!r} is not NAME=VALUE, e.g. delta=1", param=option)
        try:
            values[name.strip()] = quantity(number, PURE)
        except InputError as error:
            raise click.BadParameter(f"{text!r}: {error.problem}; {error.hint}", param=option) from None
    return values


at_option = click.option(
    "--at", "machine", multiple=True, metavar="NAME=VALUE", callback=_machine,
    help="Which machine of a sweep, e.g. --at delta=1; once for each of its axes.",
)  # fmt: skip

json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON instead of a table.")


def load_bicycle(name: str, delta: float | None) -> Bicycle:
    """The bicycle that --bicycle and --delta name; its warnings go to stderr."""
    from bikestab.bicycle import Bicycle

    if delta is not None and delta < 0:
        raise click.BadParameter(f"{delta:g} is negative; allowed: 0 and above", param_hint="--delta")
    bicycle = Bicycle.load(name).with_delta(delta)
    warn(bicycle)
    return bicycle


def warn(bicycle: Bicycle) -> None:
    """Tell on stderr what no rigid body can have."""
    for text in bicycle.warnings:
        click.echo(f"warning: {bicycle.name}: {text}", err=True)


def print_json(value: object) -> None:
    """JSON on stdout; anything not finite has been turned into null or text before."""
    import json

    click.echo(json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False))


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Columns of text, aligned to the right."""
    widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    lines = ("  ".join(cell.rjust(w) for cell, w in zip(row, widths, strict=True)) for row in (head, *rows))
    return "\n".join(line.rstrip() for line in lines)


def design_columns(lam: float, sigma: float, wheelbase: float) -> list[str]:
    """λ, head angle, σ and trail as they stand in every table."""
    return [f"{lam:.6g}", f"{90 - math.degrees(lam):.3f}", f"{sigma:.6g}", f"{sigma * wheelbase:.4f}"]


DESIGN_HEAD = ["lam [rad]", "head angle [°]", "sigma", "trail [m]"]
