"""Eigenvalues at one speed against any parameter of a machine, with the names of their modes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.model import ExactTable, Floats, Model, characteristic_table, exact_table
from bikestab.modes import Modes, follow
from bikestab.records import Design, design_record
from bikestab.routh import conditions
from bikestab.spectrum import eigenvalues_of
from bikestab.variants import check_names, check_values, varied

Complex = NDArray[np.complex128]
_BETWEEN = 33  # points of a curve from a value to the next
_HALVES = 60  # of a step, down to rounding


class Curve(NamedTuple):
    """Values of a parameter, close together, and one eigenvalue there, of a pair the upper one."""

    name: str
    x: Floats
    s: Complex


class Against(NamedTuple):
    """The designs of one machine in which the parameter ``name`` has ``values``: their tables and modes.

    ``tables`` and ``modes`` have one entry for each value, and each of ``modes`` is of one speed. ``stable``
    has the ranges of values, from the least to the greatest, in which motion at that speed is stable: their
    ends are zeros of the conditions to rounding; a range or a gap between two zeros of one condition that
    both lie between two neighbouring values is missed. ``curves`` lead from each value to the next.
    """

    name: str
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

    machine, lam, sigma = machines(x)
    table = exact_table(machine, lam, sigma, model=model)
    tables = [ExactTable(*(part[..., i] for part in table)) for i in range(len(x))]
    whole = design_record(lam, sigma, machine)
    columns: dict[str, list[float]] = {
        key: np.broadcast_to(cast("Floats", each), x.shape).tolist() for key, each in whole.items()
    }
    designs = [{key: each[i] for key, each in columns.items()} for i in range(len(x))]
    modes = [follow(each, V) for each in tables]
    curves = curves_between(x, modes, lambda x: eigenvalues_of(quick(x), V))
    ranges = stable_ranges(signs, x)
    return Against(name, x, designs, tables, modes, ranges, curves)  # type: ignore[arg-type]  # a Design


def curves_between(
    x: Floats, modes: Sequence[Modes], eigenvalues: Callable[[Floats], Complex]
) -> list[Curve]:
    """Curves through the modes at values x, from ``eigenvalues`` (4, n) at many values between these.

    On both sides of a value eigenvalues have the names that they have at it, in the order of their size, as
    far as to the next one and as long as as many of them are pairs.
    """
    order = np.argsort(x).tolist()
    curves = []
    for one, other in pairwise(order):
        between = np.linspace(x[one], x[other], _BETWEEN)
        jumps = np.flatnonzero(np.diff(_pairs(eigenvalues(between)))).tolist()
        closer = [np.linspace(between[k], between[k + 1], _BETWEEN) for k in jumps]
        between = np.unique(np.concatenate([between, *closer]))
        s = eigenvalues(between)
        pairs = _pairs(s)
        taken = np.zeros(len(between), dtype=bool)
        for end, way in ((one, 1), (other, -1)):
            known = modes[end]
            here = np.logical_and.accumulate((pairs == _pairs(known.eigenvalues))[::way])[::way]
            here &= ~taken
            taken[here] = True
            names = known.names[_by_size(known.eigenvalues)[:, 0], 0]
            rows = np.take_along_axis(s[:, here], _by_size(s[:, here]), axis=0)
            curves += [Curve(str(name), between[here], row) for name, row in zip(names, rows, strict=True)]
    return [curve for curve in curves if len(curve.x) > 1 and curve.s.imag.min() >= 0]


def _pairs(s: Complex) -> NDArray[np.intp]:
    """How many of the eigenvalues (4, n) are pairs."""
    return np.count_nonzero(s.imag > 0, axis=0)


def _by_size(s: Complex) -> NDArray[np.intp]:
    """The order of eigenvalues (4, n): upper ones of pairs, the fastest first, lower ones, real ones."""
    return np.lexsort([-s.real, -s.imag], axis=0)


def stable_ranges(signs: Callable[[Floats], NDArray[np.bool_]], x: Floats) -> list[tuple[float, float]]:
    """The ranges of a parameter, between the least and the greatest of x, in which all conditions hold.

    ``signs`` gives for values (n,) which conditions hold at (condition, n). Where one changes between two
    neighbours of x it is halved down to neighbouring doubles.
    """
    x = np.unique(x)
    which, step = np.nonzero(np.diff(signs(x), axis=1)) if len(x) > 1 else (np.empty(0, int),) * 2
    low, high = x[step], x[step + 1]
    before = signs(x)[which, step]
    for _ in range(_HALVES if len(which) else 0):
        middle = 0.5 * (low + high)
        as_low = signs(middle)[which, np.arange(len(which))] == before
        low, high = np.where(as_low, middle, low), np.where(as_low, high, middle)
    ends = np.unique(np.concatenate([x[[0, -1]], high]))
    inside: list[bool] = np.all(signs(0.5 * (ends[1:] + ends[:-1])), axis=0).tolist()
    ranges: list[tuple[float, float]] = []
    for start, stop, stable in zip(ends[:-1].tolist(), ends[1:].tolist(), inside, strict=True):
        if stable and ranges and ranges[-1][1] == start:
            ranges[-1] = ranges[-1][0], stop
        elif stable:
            ranges.append((start, stop))
    return ranges
