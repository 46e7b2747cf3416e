"""What eigen shows at one speed: mode shapes, the motion after a push, and modes against a parameter."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from bikestab_cli.chosen import Given, design_chosen
from bikestab_cli.eigen_view_words import told_against, told_motion, told_shapes
from bikestab_cli.options import SPEED_VALUE, Quantity, over_option
from bikestab_cli.several import Chosen

from bikestab.errors import InputError
from bikestab.units import ANGLE, RATE, TIME, quantity

if TYPE_CHECKING:
    from bikestab.model import Model

_TIMES = 501  # of a motion


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


class Shown(NamedTuple):
    """What was found of one machine: its record, its words, its table's columns and rows, and its picture."""

    record: dict[str, Any]
    text: str
    columns: Any
    blocks: Callable[[], Iterator[Any]]
    draw: Callable[[], Any]


def _pushed(_: click.Context, option: click.Parameter, text: str | None) -> dict[str, float]:
    units = {"roll": ANGLE, "steer": ANGLE, "roll_rate": RATE, "steer_rate": RATE}
    values: dict[str, float] = {}
    for part in text.split(",") if text else ():
        name, equals, number = part.partition("=")
        name = name.strip()
        if not equals or name not in units:
            problem = f"{part!r} is not STATE=VALUE, with one of {', '.join(units)}"
            raise click.BadParameter(problem, param=option)
        if name in values:
            raise click.BadParameter(f"{name} is given twice", param=option)
        try:
            values[name] = quantity(number, units[name])
        except InputError as error:
            raise click.BadParameter(f"{part!r}: {error.problem}; {error.hint}", param=option) from None
    return values


def view_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """--shapes, --push, --over, --at and --until, as one argument ``view``."""

    @functools.wraps(function)
    def command(**arguments: Any) -> Any:
        view = View(*(arguments.pop(name) for name in View._fields))
        if sum(map(bool, (view.shapes, view.push, view.over))) > 1 or len(view.over) > 1:
            problem = "give one of --shapes, --push and --over, and this once"
            raise click.UsageError(problem, click.get_current_context())
        _check_used(view)
        if not view.until > 0:
            raise click.BadParameter("allowed: above 0", param_hint="--until")
        return function(view=view, **arguments)

    options = (
        click.option("--shapes", is_flag=True, help="Show how roll and steer take part in each mode."),
        click.option(
            "--push", metavar="STATE=VALUE,...", callback=_pushed,
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


def shown(machine: Chosen, given: Given, view: View, model: Model) -> Shown:
    """What is asked for, of one machine."""
    if view.kind == "over":
        return _against(machine, given, view, model)
    bicycle = machine.bicycle
    lam, sigma = design_chosen(bicycle, given)
    V = _speed(bicycle, lam, sigma, view, model)
    from bikestab.records import design_record

    design = design_record(lam, sigma, bicycle)
    with _told():
        return (_shapes if view.shapes else _motion)(machine, design, V, view, model)


def _shapes(machine: Chosen, design: Any, V: float, view: View, model: Model) -> Shown:
    from bikestab.export.motions import SHAPES, shapes_blocks
    from bikestab.motion import shapes

    found = shapes(machine.bicycle, V, design["lam"], design["sigma"], model=model)

    def draw() -> Any:
        from bikestab.plot.shapes import draw_shapes

        return draw_shapes(machine.words, found)

    modes = [
        {
            "name": name, "re": s.real, "im": s.imag,
            "roll": {"re": roll.real, "im": roll.imag}, "steer": {"re": steer.real, "im": steer.imag},
        }
        for name, s, (roll, steer) in zip(
            found.names, found.eigenvalues.tolist(), found.phasors.T.tolist(), strict=True
        )
    ]  # fmt: skip
    record = {**design, "at": V, "shapes": modes}
    text = told_shapes(machine, design, found, model)
    return Shown(record, text, SHAPES, lambda: shapes_blocks(found), draw)


def _motion(machine: Chosen, design: Any, V: float, view: View, model: Model) -> Shown:
    import numpy as np

    from bikestab.export.motions import MOTION, motion_blocks
    from bikestab.motion import motion

    times = np.linspace(0, view.until, _TIMES)
    found = motion(machine.bicycle, V, view.push, times, design["lam"], design["sigma"], model=model)

    def draw() -> Any:
        from bikestab.plot.motion import draw_motion

        return draw_motion(machine.words, found, view.push)

    columns = next(motion_blocks(found))
    record = {**design, "at": V, "push": view.push, "motion": {k: x.tolist() for k, x in columns.items()}}
    text = told_motion(machine, design, found, view.push, model)
    return Shown(record, text, MOTION, lambda: motion_blocks(found), draw)


def _against(machine: Chosen, given: Given, view: View, model: Model) -> Shown:
    from bikestab.against import modes_against
    from bikestab.export.motions import against_blocks, against_columns
    from bikestab.records import interval_records, modes_record, verdict_record
    from bikestab.speeds import intervals_of
    from bikestab.variants import parameter_of

    ((name, values),) = view.over.items()
    if view.at is None:
        raise click.UsageError("--over needs a speed: give --at", click.get_current_context())
    with _told(**{name: "--over"}):
        others = {key: value[0] if isinstance(value, list) else value for key, value in given.items()}
        found = modes_against(machine.bicycle, name, values, view.at, others, model=model)
    parameter = parameter_of(machine.bicycle, name)
    records = []
    for value, design, table, modes in zip(
        found.values.tolist(), found.designs, found.tables, found.modes, strict=True
    ):
        stable = intervals_of(table)
        ends = {"intervals": interval_records(stable), **verdict_record(stable)}
        records.append({"over": {name: value}, **design, **ends, **modes_record(modes)})

    def draw() -> Any:
        from bikestab.plot.against import draw_against

        return draw_against(machine.words, found, float(view.at or 0), parameter)

    text = told_against(machine, found, view.at, parameter.unit, model)
    ranges = [{"at": view.at, "start": {name: start}, "stop": {name: stop}} for start, stop in found.stable]
    return Shown(
        {"all": records, "ranges": ranges}, text, against_columns(found), lambda: against_blocks(found), draw
    )


def _speed(bicycle: Any, lam: float, sigma: float, view: View, model: Model) -> float:
    """The speed that is asked for, or the middle of the widest stable interval that has two ends."""
    from bikestab.stability import stable_intervals

    if view.at is not None:
        return view.at
    found = stable_intervals(bicycle, lam, sigma, model=model)
    bounded = [(b - a, a, b) for a, b in zip(found.V1, found.V2, strict=True) if b - a < float("inf")]
    if not bounded:
        problem = f"{bicycle.name} has no stable interval with two ends to take the middle of: give --at"
        raise click.UsageError(problem, click.get_current_context())
    _, a, b = max(bounded)
    return float((a + b) / 2)


@contextmanager
def _told(**others: str) -> Iterator[None]:
    from bikestab_cli.options import told_as_options

    try:
        with told_as_options(V="--at", **others):
            yield
    except click.BadParameter as error:
        if error.param_hint == "--t":
            error.param_hint = "--until"
        raise


def save_picture(found: list[Shown], output: str) -> None:
    """Draw the one machine there is."""
    from bikestab.plot.files import save

    save(found[0].draw(), Path(output))
