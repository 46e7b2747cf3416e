"""bikestab compare: what moved from one bicycle, config or volume to another."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from bikestab_cli.chosen import Given, design_chosen, design_options
from bikestab_cli.options import (
    BICYCLE,
    PICTURE,
    at_option,
    check_files,
    equation_options,
    json_option,
    load_bicycle,
    tell_once,
    warn,
)
from bikestab_cli.output import print_json, tell_file

from bikestab.errors import InputError, nearest

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.comparison import Box, Side
    from bikestab.model import Model

BOX = ((0.0, 0.6), (0.0, 0.3), (0.0, 30.0))  # that in which 'bikestab design' searches


class _Tolerance(click.ParamType):
    """A speed, or per cent."""

    name = "tolerance"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        from pydantic_core import PydanticCustomError

        from bikestab.config.tolerance import tolerance

        try:
            return tolerance(value)
        except PydanticCustomError as error:
            known = error.context or {}
            self.fail(f"{known['problem']}; {known['hint']}, or 1%", param, ctx)


@click.command("compare")
@click.argument("one", type=BICYCLE, metavar="A")
@click.argument("other", type=BICYCLE, metavar="B")
@click.option(
    "--within", type=_Tolerance(), metavar="PERCENT|SPEED",
    help="Exit with 1 if an end of the stable speeds or the stable region moved by more: 1%, or 0.05.",
)  # fmt: skip
@design_options()
@equation_options
@at_option
@click.option("-o", "--output", type=PICTURE, metavar="FILE", help="Draw both as PNG, PDF or SVG.")
@json_option
def command(
    one: str,
    other: str,
    within: float | str | None,
    given: Given,
    model: Model,
    delta: float | None,
    machine: dict[str, float],
    output: str | None,
    as_json: bool,
) -> None:
    """Compare two bicycles, configs or volumes.

    Each of A and B is a bicycle, or a file of one, a scan's config, or a volume or its folder; for three or
    more bicycles see 'bikestab vrange'. Compared are their parameters, the stable speeds of their designs, or
    of the one given, what happens at their ends, and the growth rate in the middle; and over the grid's two
    parameters, or else tilt and trail, and speeds the volume of the symmetric difference of their stable
    regions, as a share of their union. It is exact along the speed and a sum over designs: those of the grids
    if they are the same, else 81 × 81 in what both have of a box, for bicycles λ to 0.6, σ to 0.3, 30 m/s.

    --at chooses of a sweep, in each of A and B that has its axis. --model, --delta and --rider are for
    bicycles: configs and volumes say these themselves.

    --within is per cent of each end of A, and of the union; as a speed it is the distance of each end, and
    the mean distance of the regions' speeds. Other ends, or another number of intervals, are always beyond
    it. Exit code 1 if something is.

    \b
    Examples:
      bikestab compare meijaard2007 sharp1971
      bikestab compare configs/quick.yaml configs/dikarev1981.yaml --within 1%
      bikestab compare meijaard2007 meijaard2007 --head-angle 71deg --trail 55mm --within 0.01
      bikestab compare meijaard2007 kooijman2011 -o both.png
    """
    from bikestab_cli.compare_words import told

    from bikestab.changes import compare

    check_files(output)
    asked = _Asked(given, model, delta, machine)
    found = [_opened(name, asked) for name in (one, other)]
    _check_used(asked, found)
    box, (A, B) = _box(found)
    record, region = compare(A, B, box, within)
    files = {}
    if output:
        from bikestab.plot.compared import draw_compared
        from bikestab.plot.files import save

        save(draw_compared(A, B, box, region), Path(output))
        files["picture"] = output
    if as_json:
        print_json({"results": [record], **({"files": files} if files else {})})
    else:
        click.echo(told(record))
        if output:
            tell_file(output)
    click.get_current_context().exit(1 if record["holds"] is False else 0)


class _Asked(NamedTuple):
    """What the options say of both: the design, the equations, and the machine of a sweep."""

    given: Given
    model: Model
    delta: float | None
    machine: dict[str, float]


class _Axes(NamedTuple):
    """The designs and the box of a config or a volume, and what their axes are called."""

    names: tuple[str, str]
    x: Any
    y: Any
    ends: tuple[tuple[float, float], ...]


class _Found(NamedTuple):
    """What a name stands for, its grid if it has one, and its sweep's axes; None of a bicycle's file."""

    side: Side
    axes: _Axes | None
    swept: Collection[str] | None


def _opened(name: str, asked: _Asked) -> _Found:
    from bikestab.formats.kinds import kind_of

    if Path(name).is_dir() or kind_of(name) == "volume":
        return _volume(name, asked)
    if kind_of(name) == "config":
        return _config(name, asked)
    bicycle = load_bicycle(name, asked.delta)
    return _Found(_side(name, bicycle, asked.model, asked.given), None, None)


def _check_used(asked: _Asked, found: Sequence[_Found]) -> None:
    """Refuse an option that says nothing of either, and tell of which it says nothing."""
    context = click.get_current_context()
    axes = [name for each in found for name in each.swept or ()]
    for name in sorted(asked.machine.keys() - axes):
        problem = f"neither has an axis {name!r}; {nearest(name, axes) if axes else 'they have no sweep'}"
        raise click.BadParameter(problem, param_hint="--at")
    default = click.core.ParameterSource.DEFAULT
    options = [name for name in ("model", "delta", "rider") if context.get_parameter_source(name) != default]
    others = [each.side.name for each in found if each.swept is not None]
    if options and len(others) == len(found):
        raise click.UsageError(f"--{options[0]} is for a bicycle, and these say it themselves", context)
    for option, name in product(options, others):
        tell_once(f"note: {name} says itself what --{option} says; it holds for the other only")


def _side(name: str, bicycle: Bicycle, model: Model, given: Given, stored: Any = None) -> Side:
    from bikestab.comparison import Side

    own = bicycle.lam is not None and bicycle.sigma is not None
    return Side(name, bicycle, model, design_chosen(bicycle, given) if own or given else None, stored)


def _volume(name: str, asked: _Asked) -> _Found:
    from bikestab.volume import Volume

    with Volume(name) as whole:
        opened = whole.at({axis: v for axis, v in asked.machine.items() if axis in whole.swept})
        axes = [opened.axis(axis) for axis in opened.axes]
        stored = opened.read("V1"), opened.read("V2")
        side = _side(name, opened.bicycle, opened.model, asked.given, stored)
        ends = tuple((float(x[0]), float(x[-1])) for x in axes)
        return _Found(side, _Axes(opened.axes[:2], axes[0], axes[1], ends), [*whole.swept])


def _config(name: str, asked: _Asked) -> _Found:
    from bikestab.config.file import load_checked
    from bikestab.config.scanconfig import ScanConfig
    from bikestab.sweeps import chosen

    config = load_checked(name)
    if not isinstance(config, ScanConfig):
        warn(config.machine)
        return _Found(_side(name, config.machine, config.model, asked.given), None, ())
    swept = {axis.name: axis.values for axis in config.axes}
    numbers = chosen(swept, {axis: v for axis, v in asked.machine.items() if axis in swept}, name)
    values = {axis: float(swept[axis][i]) for axis, i in numbers.items()}
    bicycle = next(member.bicycle for member in config.members if member.values == values)
    warn(bicycle)
    grid = config.grid
    x, y, _ = grid.names
    ends = tuple(grid.ends(axis) for axis in grid.names)
    axes = _Axes((x, y), grid.values(x), grid.values(y), ends)
    return _Found(_side(name, bicycle, config.model, asked.given), axes, [*swept])


def _box(found: Sequence[_Found]) -> tuple[Box, list[Side]]:
    """What both have of the designs and speeds; of other designs the speeds are computed anew."""
    import numpy as np

    from bikestab.comparison import Box, box_of

    known = [each.axes for each in found if each.axes]
    names = known[0].names if known else ("lam", "sigma")
    for each in found:
        if each.axes and each.axes.names != names:
            one, other = (" and ".join(axes) for axes in (each.axes.names, names))
            hint = "give a bicycle in place of one of them: it takes the other's axes"
            raise InputError(f"is over {one}, and the other over {other}", place=each.side.name, hint=hint)
    ends: Any = BOX
    if known:
        both = [zip(*pairs, strict=True) for pairs in zip(*(axes.ends for axes in known), strict=True)]
        ends = tuple((max(low), min(high)) for low, high in both)
    for name, (low, high) in zip((*names, "V"), ends, strict=True):
        if low > high:
            problem = f"the two have no {name} in common"
            raise InputError(problem, hint="; ".join(_span(axes, name) for axes in known))
    first = known[0] if known else None
    same = first and all(
        np.array_equal(axes.x, first.x) and np.array_equal(axes.y, first.y) for axes in known
    )
    sides = [each.side for each in found]
    if first and same:
        return Box(first.x, first.y, ends, names), sides
    return box_of(ends, names), [side._replace(stored=None) for side in sides]


def _span(axes: _Axes, name: str) -> str:
    low, high = axes.ends[(*axes.names, "V").index(name)]
    return f"{name} = {low:g} ... {high:g}"
