"""Eigenvalues at one speed against any parameter of a machine, with the names of their modes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.limits import check_speed
from bikestab.model import ExactTable, Floats, Model, characteristic_table, exact_table
from bikestab.modes import Modes, follow
from bikestab.records import Design, design_record
from bikestab.routh import conditions
from bikestab.spectrum import eigenvalues_of
from bikestab.variants import check_names, check_values, varied

Complex = NDArray[np.complex128]
_BETWEEN = 33  # points of a curve
_TALL = 1e4  # times the usual size: an eigenvalue that is infinite to rounding
_MOST = 12  # ranges of curves from a value to the next, or about so many
_HALVES = 60  # of a step, down to rounding


class Curve(NamedTuple):
    """Values of a parameter, close together, and one eigenvalue there, of a pair the upper one."""

    name: str
    x: Floats
    s: Complex


class Against(NamedTuple):
    """The designs of one machine in which the parameter ``name`` has ``values``: their tables and modes at V.

    ``tables`` and ``modes`` have one entry for each value, and each of ``modes`` is of one speed. ``stable``
    has the ranges of values, from the least to the greatest, in which motion at that speed is stable: their
    ends are zeros of the conditions to rounding; a range or a gap between two zeros of one condition that
    both lie between two neighbouring values is missed. ``curves`` lead from each value to the next.
    """

    name: str
    V: float
    values: Floats
    designs: list[Design]
    tables: list[ExactTable]
    modes: list[Modes]
    stable: list[tuple[float, float]]
    curves: list[Curve]


def modes_against(
    bicycle: Bicycle, name: str, values: Sequence[float], V: float, others: Mapping[str, float] | None = None,
    *, model: Model = "refined",
) -> Against:  # fmt: skip
    """The modes at a speed V [m/s] where a parameter has other values, SI, and ``others`` these.

    Names as in ``Family``. Raises InputError, with the parameter's name as key, for an unknown one, and for
    values that no machine can have; and as ``bikestab.modes``.
    """
    fixed = dict(others or {})
    if name in fixed:
        raise InputError("it varies, and is fixed too", key=(name,), hint="give one of them")
    check_speed(V, ("V",))
    check_names(bicycle, {each: each for each in (name, *fixed)})
    for value in (min(values), max(values)):
        check_values(bicycle, {**fixed, name: value})
    x = np.asarray(values, dtype=float)

    def machines(x: Floats) -> tuple[Any, Floats, Floats]:
        machine, lam, sigma = varied(bicycle, {**fixed, name: x})
        lam, sigma, _ = np.broadcast_arrays(lam, sigma, x)
        return machine, lam, sigma

    def quick(x: Floats) -> Floats:
        machine, lam, sigma = machines(x)
        return characteristic_table(machine, lam, sigma, model=model)

    def signs(x: Floats) -> NDArray[np.bool_]:
        """Which of the six conditions hold, at (condition, value)."""
        return np.array(conditions(quick(x), V)) > 0

    def tables_at(x: Floats) -> list[ExactTable]:
        machine, lam, sigma = machines(x)
        table = exact_table(machine, lam, sigma, model=model)
        return [ExactTable(*(part[..., i] for part in table)) for i in range(len(x))]

    machine, lam, sigma = machines(x)
    whole = design_record(lam, sigma, machine)
    columns: dict[str, list[float]] = {
        key: np.broadcast_to(cast("Floats", each), x.shape).tolist() for key, each in whole.items()
    }
    designs = [{key: each[i] for key, each in columns.items()} for i in range(len(x))]
    tables = tables_at(x)
    modes = [follow(each, V) for each in tables]
    curves = curves_between(x, V, modes, quick, lambda x: follow(tables_at(np.array([x]))[0], V))
    ranges = stable_ranges(signs, x)
    return Against(name, V, x, designs, tables, modes, ranges, curves)  # type: ignore[arg-type]  # a Design


def curves_between(
    x: Floats,
    V: float,
    modes: Sequence[Modes],
    table: Callable[[Floats], Floats],
    modes_at: Callable[[float], Modes],
) -> list[Curve]:
    """Curves through the modes at values x, from ``table`` (5, 4, n) at many values between these.

    Eigenvalues have the names that they have at the next value, as far as to where two of them meet or one
    is infinite; and where that is so on both sides, those of ``modes_at`` in the middle.
    """
    known = dict(zip(x.tolist(), modes, strict=True))
    curves = []
    for start, stop in _stretches(lambda x: _kinds(table(x), V), np.unique(x)):
        between = _points(start, stop)
        s = eigenvalues_of(table(between), V)
        size = abs(s).max(axis=0)
        finite = size <= _TALL * np.nanmedian(size)
        between, s = between[finite], s[:, finite]
        middle = len(between) // 2
        many = _pairs(s[:, middle])
        ends = {0: known.get(start), -1: known.get(stop)}
        near = [(i, end) for i, end in ends.items() if end and _pairs(end.eigenvalues[:, 0]) == many]
        at, named = near[0] if near else (middle, modes_at(float(between[middle])))
        names = named.names[_by_size(named.eigenvalues)[:, 0], 0]
        curves += [Curve(str(name), between, row) for name, row in zip(names, _rows(s, at), strict=False)]
    return curves


def _rows(s: Complex, at: int) -> Complex:
    """The real eigenvalues and the upper ones of pairs, of (4, n), as curves; ordered by size ``at`` one."""
    many = _pairs(s[:, at])
    rows: Complex = np.take_along_axis(s, _by_size(s), axis=0)[: 4 - many]
    if many == 2:  # two may pass each other in size
        step = [np.abs(np.diff(rows)).sum(axis=0), np.abs(rows[:, 1:] - rows[::-1, :-1]).sum(axis=0)]
        passed = np.concatenate([[0], np.cumsum(step[1] < step[0])])
        rows = np.where((passed - passed[at]) % 2, rows[::-1], rows)
    return rows


def _stretches(kinds: Callable[[Floats], NDArray[np.intp]], x: Floats) -> list[tuple[float, float]]:
    """Ranges between neighbours of x in each of which all is of one kind; they end at neighbouring doubles.

    A range or a gap between two neighbouring points of ``_points`` is missed; and where rounding alone makes
    the kinds, so that there is no end of ranges, the later ones are as they are.
    """
    start, stop = x[:-1], x[1:]
    while 0 < len(start) <= _MOST * len(x):
        points = _points(start, stop)
        found = kinds(points.ravel()).reshape(points.shape)
        step, which = np.nonzero(np.diff(found, axis=0))
        if not len(step):
            break
        as_low = partial(_same, kinds, found[step, which])
        low, high = _halved(as_low, points[step, which], points[step + 1, which])
        start, stop = np.sort([*start, *high]), np.sort([*stop, *low])
    return [(a, b) for a, b in zip(start.tolist(), stop.tolist(), strict=True) if a < b]


def _same(
    kinds: Callable[[Floats], NDArray[np.intp]], kind: NDArray[np.intp], x: Floats
) -> NDArray[np.bool_]:
    return kinds(x) == kind


def _points(start: Any, stop: Any) -> Floats:
    """Points from start to stop, closest at both, where eigenvalues that meet go like square roots."""
    part = 0.5 - 0.5 * np.cos(np.linspace(0, np.pi, _BETWEEN).reshape(-1, *(1,) * np.ndim(start)))
    points: Floats = start + (stop - start) * part
    points[-1] = stop
    return points


def _kinds(table: Floats, V: float) -> NDArray[np.intp]:
    """How many pairs there are, and the sign of p4: eigenvalues on both sides of its zeros are far apart."""
    return _pairs(eigenvalues_of(table, V)) + 4 * (table[4, 0] > 0)


def _pairs(s: Complex) -> Any:
    """How many of the eigenvalues (4, …) are pairs."""
    return np.count_nonzero(s.imag > 0, axis=0)


def _by_size(s: Complex) -> NDArray[np.intp]:
    """The order of eigenvalues (4, n): upper ones of pairs, the fastest first, real ones, lower ones."""
    return np.lexsort([-s.real, -s.imag], axis=0)


def _halved(
    as_low: Callable[[Floats], NDArray[np.bool_]], low: Floats, high: Floats
) -> tuple[Floats, Floats]:
    """Neighbouring doubles from low to high, of which ``as_low`` holds for the lower ones alone."""
    for _ in range(_HALVES if len(low) else 0):
        middle = 0.5 * (low + high)
        lower = as_low(middle)
        low, high = np.where(lower, middle, low), np.where(lower, high, middle)
    return low, high


def stable_ranges(signs: Callable[[Floats], NDArray[np.bool_]], x: Floats) -> list[tuple[float, float]]:
    """The ranges of a parameter, between the least and the greatest of x, in which all conditions hold.

    ``signs`` gives for values (n,) which conditions hold at (condition, n). Where one changes between two
    neighbours of x it is halved down to neighbouring doubles.
    """
    x = np.unique(x)
    which, step = np.nonzero(np.diff(signs(x), axis=1)) if len(x) > 1 else (np.empty(0, int),) * 2
    low, high = x[step], x[step + 1]
    before, each = signs(x)[which, step], np.arange(len(which))
    _, high = _halved(lambda x: signs(x)[which, each] == before, low, high)
    ends = np.unique(np.concatenate([x[[0, -1]], high]))
    inside: list[bool] = np.all(signs(0.5 * (ends[1:] + ends[:-1])), axis=0).tolist()
    ranges: list[tuple[float, float]] = []
    for start, stop, stable in zip(ends[:-1].tolist(), ends[1:].tolist(), inside, strict=True):
        if stable and ranges and ranges[-1][1] == start:
            ranges[-1] = ranges[-1][0], stop
        elif stable:
            ranges.append((start, stop))
    return ranges
