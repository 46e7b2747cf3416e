"""What the 1981 paper studied: its box of λ, σ and V, and maps of the stable speeds over it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Floats, Model, characteristic_table
from bikestab.region.skeleton import Line, crossings
from bikestab.speeds import Intervals, intervals_of

Range = tuple[float, float]
LAM: Range = (0.0, 0.3)  # rad; section 2 of the paper
SIGMA: Range = (0.0, 0.15)
V: Range = (0.0, 15.0)  # m/s
WIDER = 2.0  # the box, this much longer along λ and σ, shows what lies just beyond the paper's
_ROWS = 1 << 15  # designs at a time: a table of 10⁶ designs would take 160 MB


class Size(NamedTuple):
    """How finely the study is sampled: designs per axis unless something else is said."""

    grid: int = 1000
    lines: int = 400  # of constant σ, along which shares are exact
    grid_damping: int = 60  # for each δ
    grid_readings: int = 80  # for each reading of the printed values
    machines: int = 400  # random ones
    grid_machines: int = 21
    search: int = 161  # what the search for the best designs starts from
    picture: int = 401
    cells: int = 48  # of the mesh drawn in three dimensions
    every: int = 1  # reading of the printed values


FULL = Size()
QUICK = Size(200, 60, 24, 30, 60, 11, 31, 121, 20, 3)


class Map(NamedTuple):
    """Stable speeds of n × n designs, at the middles of equal cells of a box.

    ``lam`` (n, 1) [rad] and ``sigma`` (n,); (n, n): ``number`` of stable intervals, whether one is
    ``unbounded``, whether the ``formula`` says so, the ``total`` width [m/s] up to the
    paper's highest speed, and the width of the ``widest`` interval without any cap.
    """

    lam: Floats
    sigma: Floats
    number: NDArray[np.intp]
    unbounded: NDArray[np.bool_]
    formula: NDArray[np.bool_]
    total: Floats
    widest: Floats

    @property
    def shares(self) -> dict[str, float]:
        """The shares of designs with no stable speed, some, bounded ones only, an unbounded and several."""
        kinds = _kinds(self.number, self.unbounded)
        return {name: float(is_.mean()) for name, is_ in kinds.items()}


def middles(ends: Range, n: int) -> Floats:
    """The middles (n,) of n equal parts of a range."""
    return ends[0] + (ends[1] - ends[0]) * (np.arange(n) + 0.5) / n


def designs(
    bicycle: Bicycle, n: int, *, lam: Range = LAM, sigma: Range = SIGMA, model: Model = "refined"
) -> Map:
    """The map of n × n designs of a box."""
    x, y = middles(lam, n)[:, np.newaxis], middles(sigma, n)
    rows = max(_ROWS // n, 1)
    parts = [
        _judged(characteristic_table(bicycle, x[i : i + rows], y, model=model)) for i in range(0, n, rows)
    ]
    return Map(x, y, *(np.concatenate(values) for values in zip(*parts, strict=True)))


def _judged(table: Floats) -> tuple[Any, ...]:
    found = intervals_of(table)
    widest = np.where(found.upper > 0, found.V2 - found.V1, 0).max(axis=-1)
    unbounded = np.isinf(found.V2).any(axis=-1)
    return found.number, unbounded, stable_at_high_speed(table), widths(found).sum(axis=-1), widest


def widths(found: Intervals) -> Floats:
    """The widths [m/s] of stable intervals up to the paper's highest speed; 0 behind the last."""
    return np.where(found.upper > 0, np.maximum(np.minimum(found.V2, V[1]) - found.V1, 0), 0)


def stable_at_high_speed(table: Floats) -> NDArray[np.bool_]:
    """Whether designs (5, 4, *shape) are stable at every speed above some speed, in closed form.

    In the paper's letters: α0, α1, α4 > 0, α7 < 0 and α1 α2 > α0 α4, the leading coefficients in V of the
    conditions (2.2). Damping does not enter. Where one of them is zero, the next power decides, not this.
    """
    a0, a1, a2, a4, minus_a7 = table[4, 0], table[3, 1], table[2, 2], table[1, 3], table[0, 2]
    return (a0 > 0) & (a1 > 0) & (a4 > 0) & (minus_a7 > 0) & (a1 * a2 > a0 * a4)


def volume(found: Map, lam: Range = LAM, sigma: Range = SIGMA) -> float:
    """The volume [rad m/s] of the stable region up to the cap, from widths that are exact in each cell."""
    return float(found.total.mean()) * (lam[1] - lam[0]) * (sigma[1] - sigma[0])


def exact_shares(
    bicycle: Bicycle, lines: int, *, lam: Range = LAM, sigma: Range = SIGMA, model: Model = "refined"
) -> dict[str, float]:
    """As ``Map.shares``, from the exact ends of each kind along λ on lines of constant σ."""
    line = Line(Family(bicycle, model), None, middles(sigma, lines))
    cuts = crossings(line, *lam)
    found = intervals_of(line.table(0.5 * (cuts[:, 1:] + cuts[:, :-1])))
    length = np.diff(cuts, axis=1) / (lam[1] - lam[0])
    kinds = _kinds(found.number, np.asarray(np.isinf(found.V2).any(axis=-1)))
    return {name: float((is_ * length).sum(axis=1).mean()) for name, is_ in kinds.items()}


def _kinds(number: NDArray[np.intp], unbounded: NDArray[np.bool_]) -> dict[str, NDArray[np.bool_]]:
    some = number > 0
    kinds = {"none": ~some, "some": some, "finite": some & ~unbounded, "unbounded": unbounded}
    return kinds | {"multiple": number > 1}


def unbounded_ranges(
    bicycle: Bicycle, sigma: float, *, lam: Range = LAM, model: Model = "refined"
) -> list[Range]:
    """The ranges of λ [rad] with an unbounded interval at one σ, right to rounding."""
    line = Line(Family(bicycle, model), None, [sigma])
    cuts = crossings(line, *lam)[0]
    found = intervals_of(line.table(0.5 * (cuts[1:] + cuts[:-1])[np.newaxis]))
    has = np.asarray(np.isinf(found.V2).any(axis=-1))[0] & (np.diff(cuts) > 0)
    ranges: list[Range] = []
    for i in np.flatnonzero(has):
        start, stop = float(cuts[i]), float(cuts[i + 1])
        if ranges and ranges[-1][1] == start:
            start = ranges.pop()[0]
        ranges.append((start, stop))
    return ranges
