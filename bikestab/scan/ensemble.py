"""Many machines → how probable stability is at each (λ, σ, V), and how the stable speeds spread.

The machines are counted through their exact stable intervals, and counts do not depend on how the work is
divided.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.compiled import stable_speeds
from bikestab.family import Family
from bikestab.model import Floats
from bikestab.speeds import intervals_of

_PAIRS = 1 << 15  # of a machine and a (λ, σ), worked on at a time: some 20 MB


class Statistics(NamedTuple):
    """What an ensemble's machines do at cells of (λ, σ) and at speeds V.

    ``probability`` (cell, V) is the share of machines with V1 < V < V2 in one of their stable intervals;
    ``somewhere`` (cell,) the share with any stable speed, ``unbounded`` (cell,) that without an upper limit.
    ``V1`` and ``V2`` (cell, quantile) [m/s] are quantiles of the ends of each machine's widest interval,
    over the machines that have one: the smallest end that at least that share of them does not exceed.
    They are NaN where no machine has one, and V2 is inf where the quantile's interval is unbounded.
    """

    probability: NDArray[np.float32]
    somewhere: Floats
    unbounded: Floats
    V1: Floats
    V2: Floats


def ensemble_statistics(
    family: Family, draws: Mapping[str, Floats], x: Floats, y: Floats, V: Floats, quantiles: Sequence[float],
    away: Mapping[str, Floats] | None = None, *, fast: bool = False,
) -> Statistics:  # fmt: skip
    """Statistics of machines at the cells x and y of a family, both (cell,), and at ascending speeds V [m/s].

    ``draws`` are values (machine,) of the parameters that are drawn, by their names; all others, and the
    family's two, are those of the cell. ``away`` (machine,) is how far from these tilt, trail and offset are.
    ``quantiles`` lie between 0 and 1. Of two intervals of equal width the lower counts as the widest.
    Needs memory for the result and for 16 bytes per machine. ``fast`` takes the compiled kernel's intervals.
    """
    drawn = draws, away or {}
    step = max(_PAIRS // _number(drawn), 1)
    parts = [
        _of_cells(family, drawn, x[start : start + step], y[start : start + step], V, quantiles, fast)
        for start in range(0, len(x), step)
    ]
    return Statistics(*(np.concatenate(values) for values in zip(*parts, strict=True)))


Drawn = tuple[Mapping[str, Floats], Mapping[str, Floats]]


def _number(drawn: Drawn) -> int:
    return len(next(values for each in drawn for values in each.values()))


def _of_cells(
    family: Family, drawn: Drawn, x: Floats, y: Floats, V: Floats, quantiles: Sequence[float], fast: bool
) -> Statistics:
    number, cells = _number(drawn), len(x)
    V1, V2 = np.empty((2, cells, number))
    steps = np.zeros((cells, len(V) + 1), np.int64)
    unbounded = np.zeros(cells, np.int64)
    step = max(_PAIRS // cells, 1)
    for start in range(0, number, step):
        part = slice(start, start + step)
        some = ({name: values[part, np.newaxis] for name, values in each.items()} for each in drawn)
        lower, upper = _stable(family.quick_table(x, y, *some), fast)
        V1[:, part], V2[:, part] = _widest(lower, upper)
        steps += _steps(lower, upper, V)
        unbounded += np.count_nonzero(np.isinf(upper), axis=(0, 2))
    stable = np.count_nonzero(np.isfinite(V1), axis=1)
    return Statistics(
        probability=(np.cumsum(steps, axis=1)[:, :-1] / number).astype(np.float32),
        somewhere=stable / number,
        unbounded=unbounded / number,
        V1=_quantiles(V1, stable, quantiles),
        V2=_quantiles(V2, stable, quantiles),
    )


def _stable(table: Floats, fast: bool) -> tuple[Floats, Floats]:
    """V1 and V2 (machine, cell, interval) of every stable interval."""
    if fast:
        return stable_speeds(table)
    found = intervals_of(table)
    return found.V1, found.V2


def _widest(lower: Floats, upper: Floats) -> tuple[Floats, Floats]:
    """V1 and V2 (cell, machine) of the widest of each machine's intervals (machine, cell, interval)."""
    if lower.shape[-1] == 1:
        return lower[..., 0].T, upper[..., 0].T
    width = np.where(np.isnan(lower), -1.0, upper - lower)
    index = np.argmax(width, axis=-1, keepdims=True)  # the first of equal ones
    V1, V2 = (np.take_along_axis(end, index, axis=-1)[..., 0].T for end in (lower, upper))
    return V1, V2


def _steps(lower: Floats, upper: Floats, V: Floats) -> NDArray[np.int64]:
    """By how much the number of stable machines rises from each speed to the next (cell, V + 1)."""
    cells, width = lower.shape[1], len(V) + 1
    row = width * np.arange(cells)[:, np.newaxis]
    first = row + np.searchsorted(V, lower, side="right")  # NaN, behind an end, is the last step: no rise
    last = row + np.searchsorted(V, upper, side="left")
    rises, falls = (np.bincount(at.ravel(), minlength=cells * width) for at in (first, last))
    return (rises - falls).reshape(cells, width)


def _quantiles(values: Floats, count: NDArray[np.intp], quantiles: Sequence[float]) -> Floats:
    """Order statistics (cell, quantile) of the ``count`` (cell,) numbers among the values (cell, machine).

    Nothing is interpolated, which between two unbounded intervals would be inf − inf.
    """
    rank = np.ceil(count[:, np.newaxis] * np.asarray(quantiles) - 1e-9)  # 0.07 × 100 is 7
    index = np.maximum(rank.astype(np.intp) - 1, 0)
    return np.take_along_axis(np.sort(values, axis=1), index, axis=1)  # NaN last
