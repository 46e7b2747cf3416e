"""Exact ranges along lines through a plane of designs: where there is a stable speed, and of which kinds.

The zeros of the skeleton's functions along a line say where to look: beside each of them the stable
intervals themselves are counted at ever smaller distances, and wherever two neighbours differ the
change is enclosed to rounding. So what is returned is what the intervals say, however badly a
function is conditioned, as discriminants are with next to no damping.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.family import Family
from bikestab.model import ExactTable, Floats
from bikestab.region import series
from bikestab.region.skeleton import curve_functions, in_units, undamped
from bikestab.speeds import KINDS, intervals_of

_PIECE = 0.05  # longest piece of a line on which functions are taken for polynomials
_PIECES = 12, 4000  # least and largest number of pieces: lines longer than 200 are followed less closely
_BESIDE = 10.0 ** np.arange(-15, -1)  # of a piece: how far beside a zero is looked
_PARTS = 8  # into which a change is narrowed down at a time


class Line(NamedTuple):
    """Parallel lines in the plane of a family: x or y is None and runs, the other has shape (line,).

    ``others`` are further parameters (line,) of their designs. Only stable intervals count that begin by the
    speed ``begun_by`` [m/s].
    """

    family: Family
    x: ArrayLike | None
    y: ArrayLike | None
    others: Mapping[str, Floats] = MappingProxyType({})
    begun_by: float = np.inf

    @property
    def fixed(self) -> Floats:
        """The values (line,) of the one that does not run."""
        return np.array(self.y if self.x is None else self.x, dtype=float).reshape(-1)

    def table(self, values: Floats) -> Floats:
        """The table (5, 4, line, …) at values (line, …) of the running parameter."""
        return self.at(np.arange(len(self.fixed)).reshape(-1, *(1,) * (values.ndim - 1)), values).value

    def at(self, line: NDArray[np.intp], values: Floats) -> ExactTable:
        """The table (5, 4, …) at values of the running parameter on the lines of these numbers."""
        fixed = self.fixed[line]
        others = {name: of[line] for name, of in self.others.items()}
        return self.family.exact_table(*((values, fixed) if self.x is None else (fixed, values)), others)


class Samples(NamedTuple):
    """Designs on lines, in the lines' order and ascending on each: which line, where, and what is stable.

    ``structure`` is a number that two designs share if they have the same kinds of stable intervals, 0 for
    none, and it is ``clear`` unless it is within rounding. Where it differs between two neighbours on a line,
    they are next to each other to rounding, or neither is clear.
    """

    line: NDArray[np.intp]
    value: Floats
    structure: NDArray[np.int64]
    clear: NDArray[np.bool_]


def stable_ranges(
    family: Family,
    low: float,
    high: float,
    *,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
    among: float | None = None,
    begun_by: float = np.inf,
) -> list[list[tuple[float, float]]]:
    """For each line the ranges of the other parameter, within low … high, with a stable speed.

    Give ``x`` for ranges of y, or ``y`` for ranges of x. Only stable intervals that begin by the speed
    ``begun_by`` [m/s] count: else a range may end where they begin beyond all sense. The ends themselves are
    designs with a stable speed, and designs that have none are next to them; or they are low and high. The
    design ``among`` them is looked at in any case.
    """
    line = Line(family, x, y, begun_by=begun_by)
    found = sampled(line, low, high, [low, high] if among is None else [low, high, among])
    return _runs(found, found.structure > 0, len(line.fixed))


def lowest_stable(
    family: Family, low: float, high: float, *, x: ArrayLike | None = None, y: ArrayLike | None = None,
    others: Mapping[str, Floats] = MappingProxyType({}),
) -> Floats:  # fmt: skip
    """For each line the smallest value from low to high with any stable speed; NaN where there is none.

    ``others`` are further parameters (line,) of the lines.
    """
    line = Line(family, x, y, others)
    found = sampled(line, low, high, [low, high])
    ranges = _runs(found, found.structure > 0, len(line.fixed))
    lowest = np.array([of[0][0] if of else np.nan for of in ranges])
    return lowest.reshape(np.asarray(y if x is None else x).shape)


def crossings(line: Line, low: float, high: float) -> Floats:
    """Where the kinds of stable intervals change along lines: (line, number), ascending from low to high.

    Both ends are included; lines with fewer changes than others repeat ``high``.
    """
    found = sampled(line, low, high, [low, high])
    change = _changes(found)
    row = found.line[change]
    count = np.bincount(row, minlength=len(line.fixed))
    cuts = np.full((len(count), int(count.max(initial=0)) + 2), float(high))
    cuts[:, 0] = low
    nth = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
    cuts[row, 1 + nth] = 0.5 * (found.value[change] + found.value[change + 1])
    return cuts


def sampled(line: Line, low: float, high: float, given: list[float]) -> Samples:
    """Designs from low to high on each line, among which every change of the stable intervals is enclosed.

    Those ``given`` are among them.
    """
    ends = np.linspace(low, high, int(np.clip(np.ceil((high - low) / _PIECE), *_PIECES)) + 1)
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * (ends[1:] - ends[:-1])
    lines = len(line.fixed)
    values = middle[:, np.newaxis] + half[:, np.newaxis] * series.nodes()
    values = np.broadcast_to(values, (lines, *values.shape))
    row, zero = _zeros(in_units(line.table(values)), values, half)
    beside = zero[:, np.newaxis] + np.append(0.0, [-_BESIDE, _BESIDE]) * half[0]
    each = np.arange(lines)
    where = np.concatenate([values.ravel(), beside.ravel(), np.repeat(given, lines)])
    parts = [each.repeat(values[0].size), row.repeat(beside.shape[1]), np.tile(each, len(given))]
    which = np.concatenate(parts)
    order = np.lexsort((where, which))
    which, where = which[order], where[order]
    again = np.append(False, (which[1:] == which[:-1]) & (where[1:] == where[:-1]))
    kept = (where >= low) & (where <= high) & ~again
    found = _seen(line, which[kept], where[kept])
    return _enclosed(line, found, 4 * np.spacing(max(abs(low), abs(high))))


def _seen(line: Line, which: NDArray[np.intp], where: Floats) -> Samples:
    """Designs at values on the lines of these numbers, in this order."""
    found = intervals_of(line.at(which, where))
    kinds = np.where(line.begun_by >= found.V1, found.lower.astype(np.int64) * len(KINDS) + found.upper, 0)
    structure = (kinds * len(KINDS) ** (2 * np.arange(kinds.shape[-1]))).sum(axis=-1)
    return Samples(which, where, structure, found.marginal[..., 0] == 0)


def _zeros(table: Floats, values: Floats, half: Floats) -> tuple[NDArray[np.intp], Floats]:
    """Zeros of the functions along lines, with damping and without: which line, and where.

    With little damping a curve at a speed V > 0 has a double next to it, of V < 0, so that a function nearly
    has a double zero, near the simple one of the function without damping.
    """
    functions = list(curve_functions(table).values())
    if (plain := undamped(table)) is not None:
        functions += curve_functions(plain).values()
    shape = np.broadcast_shapes(*(f.shape for f in functions), values.shape)
    at_nodes = np.array([np.broadcast_to(f, shape) for f in functions])
    row, x = series.zeros(at_nodes.reshape(-1, shape[-1]))
    _, line, piece = np.unravel_index(row, at_nodes.shape[:-1])
    middle = 0.5 * (values[0, piece, 0] + values[0, piece, -1])
    return line, middle + half[piece] * x


def _together(one: Samples, other: Samples) -> Samples:
    line, value, structure, clear = (np.concatenate(each) for each in zip(one, other, strict=True))
    order = np.lexsort((value, line))
    return Samples(line[order], value[order], structure[order], clear[order])


def _changes(samples: Samples) -> NDArray[np.intp]:
    """The samples behind which, on the same line, the structure is another one."""
    same = (samples.line[1:] == samples.line[:-1]) & (samples.structure[1:] != samples.structure[:-1])
    return np.flatnonzero(same)


def _enclosed(line: Line, samples: Samples, close: float) -> Samples:
    """With further samples, until neighbours with different structures are ``close``, or neither is clear.

    Where rounding decides over some length, what is found there changes from one sample to the next.
    """
    parts = np.arange(1, _PARTS) / _PARTS
    while True:
        change = _changes(samples)
        a, b = samples.value[change], samples.value[change + 1]
        wide = (b - a > close) & (samples.clear[change] | samples.clear[change + 1])
        if not wide.any():
            return samples
        which = np.repeat(samples.line[change[wide]], _PARTS - 1)
        new = (a[wide, np.newaxis] + (b - a)[wide, np.newaxis] * parts).ravel()
        samples = _together(samples, _seen(line, which, new))


def _runs(samples: Samples, good: NDArray[np.bool_], lines: int) -> list[list[tuple[float, float]]]:
    """For each line the ranges of neighbouring samples that are all good; one alone is none."""
    other = samples.line[1:] != samples.line[:-1]
    start = good & np.append(True, other | ~good[:-1])
    stop = good & np.append(other | ~good[1:], True)
    ranges: list[list[tuple[float, float]]] = [[] for _ in range(lines)]
    for a, b in zip(np.flatnonzero(start), np.flatnonzero(stop), strict=True):
        if samples.value[b] > samples.value[a]:
            ranges[samples.line[a]].append((float(samples.value[a]), float(samples.value[b])))
    return ranges
