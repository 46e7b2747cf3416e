"""Maps of the stable speeds over a box of designs, and the shares of designs of each kind."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Floats, Model, characteristic_table
from bikestab.paper1981.box import LAM, PAPER_BOX, DesignBox, Range, V, middles
from bikestab.paper1981.forks import bent_forwards, least_tilt
from bikestab.paper1981.several import groups, together
from bikestab.region.curves import Curve, trace
from bikestab.region.lines import Line, crossings
from bikestab.speeds import Intervals, intervals_of
from bikestab.undamped import StableSpeeds, stable_speeds

Flags = NDArray[np.bool_]
_DESIGNS = 1 << 15  # at a time: a table of 10⁶ designs would take 160 MB


@dataclass(frozen=True)
class Shares:
    """The shares of designs with no stable speed, some, bounded ones only, an unbounded interval, several."""

    none: float
    some: float
    finite: float
    unbounded: float
    multiple: float


@dataclass(frozen=True)
class DesignMap:
    """Stable speeds of n × n designs, at the middles of equal cells of a box.

    ``lam`` (n, 1) [rad] and ``sigma`` (n,); (n, n): ``number`` of stable intervals, whether one is
    ``unbounded``, whether the ``formula`` says so, the ``total`` width [m/s] up to the
    paper's highest speed, and the width of the ``widest`` interval without any cap; whether the fork is bent
    ``forwards``.
    """

    lam: Floats
    sigma: Floats
    number: NDArray[np.intp]
    unbounded: Flags
    formula: Flags
    total: Floats
    widest: Floats
    forwards: Flags

    @property
    def shares(self) -> Shares:
        """The shares of the designs, each of which counts for its cell."""
        return _shares(self.number, self.unbounded, lambda kind: float(kind.mean()))

    @property
    def shares_forwards(self) -> Shares:
        """The shares among the designs whose fork is bent forwards."""
        among = self.forwards
        return _shares(self.number, self.unbounded, lambda kind: _mean(kind[among]))

    @property
    def widest_forwards(self) -> Floats:
        """``widest``, 0 for forks bent backwards."""
        return np.where(self.forwards, self.widest, 0)


def _mean(kind: Flags) -> float:
    return float(kind.mean()) if kind.size else 0.0


def map_designs(
    bicycle: Bicycle, n: int, box: DesignBox = PAPER_BOX, *, model: Model = "refined"
) -> DesignMap:
    """The map of n × n designs of a box."""
    x, y = middles(box.lam, n)[:, np.newaxis], middles(box.sigma, n)
    rows = max(_DESIGNS // n, 1)
    parts = [
        _stable_speeds(characteristic_table(bicycle, x[i : i + rows], y, model=model))
        for i in range(0, n, rows)
    ]
    number, unbounded, formula, total, widest = (np.concatenate(of) for of in zip(*parts, strict=True))
    return DesignMap(x, y, number, unbounded, formula, total, widest, bent_forwards(bicycle, x, y))


@cache
def box_curves(bicycle: Bicycle, samples: int) -> list[Curve]:
    """The curves of the paper's box; the same ones are tabled and drawn."""
    return trace(Family(bicycle), LAM, PAPER_BOX.sigma, samples=samples)


def map_each(bicycles: Sequence[Bicycle], n: int, box: DesignBox = PAPER_BOX) -> list[DesignMap]:
    """The maps of n × n designs of a box of each bicycle."""
    x, y = middles(box.lam, n)[:, np.newaxis], middles(box.sigma, n)
    maps: list[DesignMap] = []
    for group in groups(bicycles, n * n):
        machines = together(group)
        found = *_stable_speeds(characteristic_table(machines, x, y)), bent_forwards(machines, x, y)
        maps += [DesignMap(x, y, *each) for each in zip(*found, strict=True)]
    return maps


def _stable_speeds(
    table: Floats,
) -> tuple[NDArray[np.intp], Flags, Flags, Floats, Floats]:
    intervals = stable_speeds(table)
    widest = np.where(intervals.upper > 0, intervals.V2 - intervals.V1, 0).max(axis=-1)
    total = widths(intervals).sum(axis=-1)
    return (
        np.count_nonzero(intervals.upper, axis=-1),
        has_unbounded(intervals),
        stable_at_high_speed(table),
        total,
        widest,
    )


def widths(intervals: Intervals | StableSpeeds) -> Floats:
    """The widths [m/s] of stable intervals up to the paper's highest speed; 0 behind the last."""
    return np.where(intervals.upper > 0, np.maximum(np.minimum(intervals.V2, V[1]) - intervals.V1, 0), 0)


def has_unbounded(intervals: Intervals | StableSpeeds) -> Flags:
    """Whether one of the intervals (…, interval) has no upper limit."""
    return np.asarray(np.isinf(intervals.V2).any(axis=-1))


def stable_at_high_speed(table: Floats) -> Flags:
    """Whether designs (5, 4, *shape) are stable at every speed above some speed, in closed form.

    In the paper's letters: α0, α1, α4 > 0, α7 < 0 and α1 α2 > α0 α4, the leading coefficients in V of the
    conditions (2.2). Damping does not enter. Where one of them is zero, the next power decides, not this.
    """
    a0, a1, a2, a4, minus_a7 = table[4, 0], table[3, 1], table[2, 2], table[1, 3], table[0, 2]
    return (a0 > 0) & (a1 > 0) & (a4 > 0) & (minus_a7 > 0) & (a1 * a2 > a0 * a4)


def region_volume(designs: DesignMap, box: DesignBox = PAPER_BOX) -> float:
    """The volume [rad m/s] of the stable region in the box of a map, from exact widths."""
    return float(designs.total.mean()) * box.area


def shares_along_lines(
    bicycle: Bicycle, lines: int, box: DesignBox = PAPER_BOX
) -> tuple[Shares, Shares, float]:
    """The shares of designs from the exact ends of each kind along λ on lines of constant σ.

    Those of all designs, those among designs whose fork is bent forwards, and the share of these.
    """
    sigma = middles(box.sigma, lines)
    line = Line(Family(bicycle), None, sigma)
    cuts = crossings(line, *box.lam)
    between = intervals_of(line.table(0.5 * (cuts[:, 1:] + cuts[:, :-1])))
    length = np.diff(cuts, axis=1)
    forwards = np.diff(np.maximum(cuts, least_tilt(bicycle, sigma)[:, np.newaxis]), axis=1)
    everywhere, among_forwards = (
        _shares(between.number, has_unbounded(between), partial(_weighted, weight=weight))
        for weight in (length, forwards)
    )
    return everywhere, among_forwards, float(forwards.sum() / length.sum())


def _weighted(kind: Flags, weight: Floats) -> float:
    whole = float(weight.sum())
    return float((kind * weight).sum()) / whole if whole else 0.0


def _shares(number: NDArray[np.intp], unbounded: Flags, share: Callable[[Flags], float]) -> Shares:
    some = number > 0
    return Shares(*map(share, (~some, some, some & ~unbounded, unbounded, number > 1)))


def unbounded_ranges(
    bicycle: Bicycle, sigma: float, *, lam: Range = LAM, model: Model = "refined"
) -> list[Range]:
    """The ranges of λ [rad] with an unbounded interval at one σ, right to rounding."""
    line = Line(Family(bicycle, model), None, [sigma])
    cuts = crossings(line, *lam)[0]
    between = intervals_of(line.table(0.5 * (cuts[1:] + cuts[:-1])[np.newaxis]))
    ranges: list[Range] = []
    for i in np.flatnonzero(has_unbounded(between)[0] & (np.diff(cuts) > 0)):
        start, stop = float(cuts[i]), float(cuts[i + 1])
        if ranges and ranges[-1][1] == start:
            start = ranges.pop()[0]
        ranges.append((start, stop))
    return ranges
