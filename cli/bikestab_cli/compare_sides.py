"""What compare holds against each other: bicycles, configs and volumes, and the box that all have."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from bikestab_cli.chosen import Given, design_chosen
from bikestab_cli.options import load_bicycle, tell_once, warn

from bikestab.errors import InputError, nearest
from bikestab.texts import is_there

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.comparison import Box, Side
    from bikestab.model import Model

BOX = ((0.0, 0.6), (0.0, 0.3), (0.0, 30.0))  # that in which 'bikestab design' searches


class Asked(NamedTuple):
    """What the options say of all: the design, the equations, and the machine of a sweep."""

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


class Found(NamedTuple):
    """What a name stands for, its grid if it has one, and its sweep's axes; None of a bicycle's file."""

    side: Side
    axes: _Axes | None
    swept: Collection[str] | None


def opened(name: str, asked: Asked) -> Found:
    from bikestab.formats.kinds import kind_of

    path = Path(name)
    named = path.suffix in (".h5", ".hdf5") or ("/" in name and not path.suffix)
    if (named and not is_there(name)) or path.is_dir() or kind_of(name) == "volume":
        return _volume(name, asked)
    if kind_of(name) == "config":
        return _config(name, asked)
    bicycle = load_bicycle(name, asked.delta)
    return Found(_side(name, bicycle, asked.model, asked.given), None, None)


def check_used(asked: Asked, found: Sequence[Found]) -> None:
    """Refuse an option that says nothing of any of them, and tell of which it says nothing."""
    context = click.get_current_context()
    axes = [name for each in found for name in each.swept or ()]
    for name in sorted(asked.machine.keys() - axes):
        none = "neither" if len(found) == 2 else "none of them"
        problem = f"{none} has an axis {name!r}; {nearest(name, axes) if axes else 'they have no sweep'}"
        raise click.BadParameter(problem, param_hint="--at")
    default = click.core.ParameterSource.DEFAULT
    options = [name for name in ("model", "delta", "rider") if context.get_parameter_source(name) != default]
    others = [each.side.name for each in found if each.swept is not None]
    if options and len(others) == len(found):
        raise click.UsageError(f"--{options[0]} is for a bicycle, and these say it themselves", context)
    rest = "the other only" if len(found) == 2 else "the others only"
    for option, name in product(options, others):
        tell_once(f"note: {name} says itself what --{option} says; it holds for {rest}")


def _side(name: str, bicycle: Bicycle, model: Model, given: Given, stored: Any = None) -> Side:
    from bikestab.comparison import Side

    own = bicycle.lam is not None and bicycle.sigma is not None
    return Side(name, bicycle, model, design_chosen(bicycle, given) if own or given else None, stored)


def _volume(name: str, asked: Asked) -> Found:
    from bikestab.volume import Volume

    with Volume(name) as whole:
        volume = whole.at({axis: v for axis, v in asked.machine.items() if axis in whole.swept})
        axes = [volume.axis(axis) for axis in volume.axes]
        stored = volume.read("V1"), volume.read("V2")
        side = _side(name, volume.bicycle, volume.model, asked.given, stored)
        ends = tuple((float(x[0]), float(x[-1])) for x in axes)
        return Found(side, _Axes(volume.axes[:2], axes[0], axes[1], ends), [*whole.swept])


def _config(name: str, asked: Asked) -> Found:
    from bikestab.config.checks import load_checked
    from bikestab.config.members import members, swept_axes
    from bikestab.config.scanconfig import ScanConfig
    from bikestab.sweeps import chosen

    config = load_checked(name)
    swept = {axis.name: axis.values for axis in swept_axes(config.bicycle, config.sweep)}
    numbers = chosen(swept, {axis: v for axis, v in asked.machine.items() if axis in swept}, name)
    values = {axis: float(swept[axis][i]) for axis, i in numbers.items()}
    bicycle = next(each.bicycle for each in members(config.machine, config.sweep) if each.values == values)
    warn(bicycle)
    if not isinstance(config, ScanConfig):
        return Found(_side(name, bicycle, config.model, asked.given), None, [*swept])
    grid = config.grid
    x, y, _ = grid.names
    ends = tuple(grid.ends(axis) for axis in grid.names)
    axes = _Axes((x, y), grid.values(x), grid.values(y), ends)
    return Found(_side(name, bicycle, config.model, asked.given), axes, [*swept])


def paired(A: Found, B: Found) -> tuple[Side, Side, Box]:
    """Two sides, and what both have of designs and speeds; of other designs the speeds are computed anew."""
    import numpy as np

    from bikestab.comparison import Box, box_of

    one, other, known = A.side, B.side, [axes for axes in (A.axes, B.axes) if axes]
    names = known[0].names if known else ("lam", "sigma")
    if known and known[-1].names != names:
        first, second = (" and ".join(axes.names) for axes in known)
        hint = "give a bicycle in place of one of them: it takes the other's axes"
        problem = f"is over {second}, and {one.name} over {first}"
        raise InputError(problem, place=other.name, hint=hint)
    _check_meanings(one, other, names)
    ends: Any = BOX
    if known:
        both = [zip(*pairs, strict=True) for pairs in zip(*(axes.ends for axes in known), strict=True)]
        ends = tuple((max(low), min(high)) for low, high in both)
    for name, (low, high) in zip((*names, "V"), ends, strict=True):
        if low > high:
            problem = f"has no {name} in common with {one.name}"
            raise InputError(problem, place=other.name, hint="; ".join(_span(axes, name) for axes in known))
    if known and np.array_equal(known[0].x, known[-1].x) and np.array_equal(known[0].y, known[-1].y):
        return one, other, Box(known[0].x, known[0].y, ends, names)
    return one._replace(stored=None), other._replace(stored=None), box_of(ends, names)


def _check_meanings(A: Side, B: Side, names: tuple[str, str]) -> None:
    """Refuse a parameter that is another quantity in the notation of the other machine, as c is."""
    from bikestab.family import Family

    families = []
    for side in (A, B):
        try:
            families.append(Family(side.bicycle, side.model, *names))
        except InputError as error:
            raise InputError(error.problem, place=side.name, hint=error.hint) from None
    meanings = [[parameter.meaning for parameter in family.parameters] for family in families]
    for name, one, other in zip(names, *meanings, strict=True):
        if one != other:
            problem = f"{name} is the {other} here, and in {A.name} the {one}"
            raise InputError(problem, place=B.name, hint="a grid over 'trail' is one over the trail of any")


def _span(axes: _Axes, name: str) -> str:
    low, high = axes.ends[(*axes.names, "V").index(name)]
    return f"{name} = {low:g} ... {high:g}"
