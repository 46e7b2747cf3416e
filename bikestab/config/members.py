"""The machines of a config: those of a sweep, and whether they and the samples around them exist."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping
from itertools import product
from typing import NamedTuple

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.config.parts import FamilyGrid, Grid
from bikestab.config.values import NumberAxis
from bikestab.config.variation import BOTH, Ensemble
from bikestab.errors import InputError, nearest
from bikestab.family import Family
from bikestab.fields import AXES, Axes
from bikestab.gains import infinite_at_rest
from bikestab.limits import MOST_TRAIL, SMALL
from bikestab.model import Floats
from bikestab.variants import FRONT, fixed_by, front_of, varied

MOST_MEMBERS = 10_000  # of a sweep
_STEEPEST = 1.57  # rad
MOST_MACHINES = 100_000_000  # of all ensembles of a sweep


class Member(NamedTuple):
    """One machine of a sweep, and the swept parameters' values."""

    values: dict[str, float]
    bicycle: Bicycle


class SweptAxis(NamedTuple):
    """One axis of a sweep: a parameter, its values, unit and meaning."""

    name: str
    values: Floats
    unit: str
    meaning: str


def swept_axes(bicycle: Bicycle, sweep: Mapping[str, NumberAxis]) -> list[SweptAxis]:
    """The axes of a sweep over parameters of the bicycle."""
    axes = []
    for name, axis in sweep.items():
        meaning, _, unit = bicycle.notation[name].rpartition(" [")
        axes.append(SweptAxis(name, axis.points, unit.rstrip("]"), meaning))
    return axes


def check_names(
    bicycle: Bicycle, axes: Axes, sweep: Iterable[str], ensemble: Ensemble | None, *, own_delta: bool
) -> None:
    """Raise InputError unless every varied name is a parameter of the bicycle's notation, and varied once.

    ``axes`` are the grid's.
    """
    names = [("sweep", name) for name in sweep]
    names += [("ensemble", name) for name in (ensemble.parameters if ensemble else ())]
    on_grid = fixed_by(bicycle, axes)
    swept = [name for name in bicycle.notation if front_of(bicycle, name) not in on_grid]
    seen: dict[str, str] = {one: "grid" for name in axes for one in _equal(name)}
    for key in names:
        name, of_front = key[1], front_of(bicycle, key[1])
        known = swept if key[0] == "sweep" else [*bicycle.notation, *FRONT]
        if key[0] == "ensemble" and of_front:
            if (the := f"the {of_front}") in seen:
                raise InputError(f"{seen[the]} is {the} as well", key=key, hint="draw one of them")
            seen[the] = ".".join(key)
            continue
        if (place := front_of(bicycle, name)) in on_grid:
            the, axis = "trail" if place == "offset" else place, on_grid[place]
            raise InputError(f"the grid has the {the}", key=key, hint=f"give its values in grid.{axis}")
        if name not in known:
            other = " (a key of the other notation)" if name in BOTH else ""
            raise InputError(f"unknown parameter{other}", key=key, hint=nearest(name, known))
        if name == "delta" and own_delta:
            raise InputError("delta is given for the whole config as well", key=key, hint="give one of them")
        for one in _equal(name):
            if one in seen:
                raise InputError(f"{seen[one]} varies it already", key=key, hint="vary it once")
            seen[one] = ".".join(key)


def _equal(name: str) -> tuple[str, ...]:
    return ("R1", "R2") if name == "R" else (name,)


def check_family(bicycle: Bicycle, grid: Grid | FamilyGrid) -> None:
    """Raise InputError unless the grid's two parameters are such of the bicycle, and leave no other open."""
    x, y, _ = grid.names
    if grid.names == AXES:
        return
    try:
        Family(bicycle, x=x, y=y)
    except InputError as error:
        axis = str(error.key[0])
        key = ("grid", axis, "name") if axis in ("x", "y") else ("grid",)
        raise InputError(error.problem, key=key, hint=error.hint) from None


def check_designs(machines: list[Member], grid: Grid | FamilyGrid) -> None:
    """Raise InputError where no machine has the values at the corners of the grid, or one none at rest."""
    x, y, _ = grid.names
    named = {x, y}.union(*(dict(member.bicycle.gains) for member in machines))
    if grid.ends("V")[0] == 0 and (gains := infinite_at_rest(sorted(named))):
        problem = f"{gains[0]}/V is infinite at V = 0"
        raise InputError(problem, key=("grid", "V"), hint="let the speeds begin above 0")
    if grid.names == AXES:  # checked where they are read
        return
    for member in machines:
        family = Family(member.bicycle, x=x, y=y)
        for corner in product(_telling(grid, x), _telling(grid, y)):
            try:
                family.check(*corner)
            except InputError as error:
                at = ", ".join(
                    f"{n} = {v:g}" for n, v in {**member.values, x: corner[0], y: corner[1]}.items()
                )
                name = str(error.key[0]) if error.key else x
                key = ("grid", grid.key(name)) if name in (x, y) else ("grid",)
                raise InputError(f"at {at}: {error.problem}", key=key, hint=error.hint) from None


def _telling(grid: Grid | FamilyGrid, name: str) -> tuple[float, ...]:
    """The ends of an axis and, of a parameter that may be too small, what is nearest to zero."""
    ends = grid.ends(name)
    if name not in SMALL:
        return ends
    some = [value for value in grid.values(name).tolist() if value]
    return *ends, min(some, key=abs, default=0.0)


def members(machine: Bicycle, sweep: Mapping[str, NumberAxis]) -> list[Member]:
    """The machines at every combination of a sweep's values, the last axis fastest.

    Raises InputError for too many of them, and for values that no machine has.
    """
    number = math.prod(axis.size for axis in sweep.values())
    if number > MOST_MEMBERS:
        sizes = " × ".join(str(axis.size) for axis in sweep.values())
        raise InputError(
            f"{sizes} machines are too many", key=("sweep",), hint=f"allowed: up to {MOST_MEMBERS}"
        )
    machines = []
    for point in product(*(axis.points.tolist() for axis in sweep.values())):
        values = dict(zip(sweep, point, strict=True))
        try:
            machines.append(Member(values, machine.replaced(values) if values else machine))
        except InputError as error:
            raise InputError(error.problem, key=("sweep", *error.key), hint=error.hint) from None
    return machines


def doubts_of(machines: list[Member], ensemble: Ensemble | None) -> list[str]:
    """What no rigid bodies on the ground can have, and how many of the machines have it."""
    first: dict[str, str] = {}
    counts: Counter[str] = Counter()
    drawn: Counter[str] = Counter()
    for member in machines:
        for text in member.bicycle.warnings:
            kind = text.partition(":")[0]
            first.setdefault(kind, text)
            counts[kind] += 1
        if ensemble:
            drawn.update(ensemble.machines(member.bicycle).doubtful())
    of = f"{{}} of {len(machines)} machines of the sweep: {{}}" if len(machines) > 1 else "{1}"
    doubts = [of.format(counts[kind], text) for kind, text in first.items()]
    if ensemble:
        number = len(machines) * ensemble.samples
        doubts += [f"{count} of {number} drawn machines: {text}" for text, count in drawn.items()]
    return doubts


def _check_fronts(bicycle: Bicycle, ensemble: Ensemble, grid: Grid | FamilyGrid) -> None:
    """Raise InputError where a drawn tilt or trail is none, at the corners of the grid."""
    x, y, _ = grid.names
    fronts = [name for name in ensemble.parameters if front_of(bicycle, name)]
    if not fronts:
        return
    drawn, away = ensemble.parted(bicycle, grid.names)
    corners = np.array(list(product(grid.ends(x), grid.ends(y)))).T
    columns, moves = ({name: v[:, np.newaxis] for name, v in each.items()} for each in (drawn, away))
    with np.errstate(all="ignore"):
        _, lam, sigma = varied(bicycle, {**columns, x: corners[0], y: corners[1]}, moves)
    most = np.max(np.abs(lam)), np.max(np.abs(sigma))  # NaN where one is
    if not (most[0] < _STEEPEST and most[1] <= MOST_TRAIL):
        problem = "some samples have a tilt or a trail that no machine has"
        raise InputError(
            problem, key=(fronts[0],), hint="take a narrower distribution, or uniform: [low, high]"
        )


def check_samples(machines: list[Member], ensemble: Ensemble | None, grid: Grid | FamilyGrid) -> None:
    """Raise InputError if some sample around some member is no machine, or all are too many."""
    if ensemble is None:
        return
    if len(machines) * ensemble.samples > MOST_MACHINES:
        raise InputError(
            f"{ensemble.samples} samples of each of {len(machines)} machines are too many",
            key=("ensemble", "samples"),
            hint=f"allowed: up to {MOST_MACHINES // len(machines)} with this sweep",
        )
    for member in machines:
        try:
            ensemble.machines(member.bicycle)
            _check_fronts(member.bicycle, ensemble, grid)
        except InputError as error:
            at = ", ".join(f"{name} = {value:g}" for name, value in member.values.items())
            problem = f"at {at}, {error.problem}" if at else error.problem
            raise InputError(problem, key=("ensemble", *error.key), hint=error.hint) from None
