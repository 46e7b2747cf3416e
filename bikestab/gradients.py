"""A family's stable intervals → how their ends move with its two parameters, for arrays of designs.

dV/dp = −F_p/F_V where F, p0 or hurwitz3 of (2.2), is zero. F_p needs the table's slopes by the parameter,
from differences of tables in twice double precision: over steps of 1e-6 of the parameter right to 1e-12.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from bikestab.family import Family
from bikestab.model import Floats, in_powers
from bikestab.polynomials import derivative, value
from bikestab.speeds import CAPSIZE, REST, WEAVE, Intervals

_STEP = 2.0**-20  # of a parameter's value, or of _LEAST
_LEAST = 1e-2


def speed_gradients(
    family: Family, x: ArrayLike, y: ArrayLike, intervals: Intervals, others: Mapping[str, Any] | None = None
) -> Floats:
    """The dV1/dx, dV1/dy, dV2/dx, dV2/dy (*shape, interval, 4) of ``intervals`` (*shape, interval).

    In m/s for each SI unit; zero for an interval from rest on, NaN for an unbounded end and where there is no
    interval. ``others`` are columns (machine, 1) of further parameters, and intervals then those of each
    machine's cells in turn.
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if others:  # machines, cell by cell
        number = len(next(iter(others.values())))
        parts = (each.reshape(number, len(x), each.shape[-1]) for each in intervals.arrays().values())
        intervals = Intervals(*parts)
    h = [_STEP * np.maximum(np.abs(p), _LEAST) for p in (x, y)]
    table = in_powers(family.table(x, y, others))
    slopes = [
        _slope(family, (x + h[0], y), (x - h[0], y), 0, others),
        _slope(family, (x, y + h[1]), (x, y - h[1]), 1, others),
    ]
    found = np.full((*intervals.V1.shape, 4), np.nan)
    for end, (V, kind) in enumerate(((intervals.V1, intervals.lower), (intervals.V2, intervals.upper))):
        for condition in (WEAVE, CAPSIZE):
            at = kind == condition
            cell: Any = (slice(None), slice(None), *np.nonzero(at)[:-1])
            by_V = _of_condition(condition, table[cell], derivative_rows(table[cell]), V[at])
            for axis, slope in enumerate(slopes):
                by_p = _of_condition(condition, table[cell], slope[cell], V[at])
                with np.errstate(divide="ignore", invalid="ignore"):
                    found[at, 2 * end + axis] = -by_p / by_V
        found[kind == REST, 2 * end : 2 * end + 2] = 0.0
    return found


def derivative_rows(table: Floats) -> Floats:
    """The table of the slopes of p0 … p4 by V."""
    return np.concatenate([np.moveaxis(derivative(np.moveaxis(table, 1, 0)), 0, 1), 0 * table[:, :1]], axis=1)


def _slope(
    family: Family, above: tuple[Floats, Floats], below: tuple[Floats, Floats], axis: int,
    others: Mapping[str, Any] | None,
) -> Floats:  # fmt: skip
    """The slope of the table between two designs that differ in one parameter."""
    a, b = (family.exact_table(*design, others) for design in (above, below))
    return in_powers(((a.value - b.value) + (a.rest - b.rest)) / (above[axis] - below[axis]))


def _of_condition(kind: int, table: Floats, slope: Floats, V: Floats) -> Floats:
    """The slope (cell,) of p0 or hurwitz3 at speeds V, from the table (5, 4, cell) and its slope."""
    p0, p1, p2, p3, p4 = (value(row, V) for row in table)
    d0, d1, d2, d3, d4 = (value(row, V) for row in slope)
    if kind == CAPSIZE:
        return d0
    inner = p2 * p3 - p4 * p1
    moved = d2 * p3 + p2 * d3 - d4 * p1 - p4 * d1
    return d1 * inner + p1 * moved - (d0 * p3 + 2 * p0 * d3) * p3
