"""The best designs in a box of a family, by several criteria, and the front between two of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from bikestab.design.criteria import (
    WORSE,
    Criterion,
    Wanted,
    assessed,
    decay,
    lowest,
    miss,
    missed_by,
    width,
    width_and_decay,
    width_if_decaying,
)
from bikestab.design.optimum import JudgedDesign, finite, judged_design, own_design, place_of
from bikestab.design.search import Found, axes, basins, minimise
from bikestab.model import Floats

GRID = 161  # values per axis to start from: a region narrower than a step of theirs may be missed
FRONT = 6  # how many widths, and how many rates of decay, the front is searched for between its ends
_STARTS = 15
_SAME = 1e-4  # m/s, 1/s: designs of the front that differ less are one, found twice


class Best(NamedTuple):
    """The bicycle's own design and the optima, each None where there is none.

    ``pareto`` is the front between width and decay, the widest first: of its designs none is both wider
    and decays faster than another. Where no design in the box is allowed, ``closest`` is the one with
    the lowest growth rate over the speeds that should be stable, or at its best speed.
    """

    own: JudgedDesign | None
    widest: JudgedDesign | None
    lowest_V1: JudgedDesign | None
    fastest_decay: JudgedDesign | None
    pareto: list[JudgedDesign]
    closest: JudgedDesign | None


def best_designs(wanted: Wanted, *, grid: int | None = None) -> Best:
    """Search the box, starting from grid × grid designs; the same question has the same answer."""
    search = _Search(wanted, grid or GRID)
    own = own_design(wanted)
    search.look([width, lowest, decay])
    if search.values[width].min() >= 0:
        (nearest,) = search.best([miss])
        if nearest.value > WORSE:
            V, rate = missed_by(wanted, wanted.table(nearest.x[:, np.newaxis]), rounds=7)
            closest = judged_design(replace(wanted, stable=None), nearest.x)
            closest |= {"V": float(V[0]), "growth_rate": finite(rate[0])}
            return Best(own, None, None, None, [], closest)
        search.known.append(nearest.x)  # a region that the grid missed
    widest, low, fast = search.best([width, lowest, decay])
    fast = _faster(wanted, widest, fast)
    return Best(
        own,
        judged_design(wanted, widest.x, "widest", place_of(wanted, width, widest)),
        judged_design(wanted, low.x, "lowest", place_of(wanted, lowest, low)),
        judged_design(wanted, fast.x, "judged", place_of(wanted, decay, fast)),
        [
            judged_design(wanted, best.x, at=place_of(wanted, width, best))
            for best in _front(search, widest, fast)
        ],
        None,
    )


def fastest_decay(wanted: Wanted, *, grid: int | None = None) -> JudgedDesign | None:
    """That of ``best_designs`` alone, where a design of the grid is allowed."""
    search = _Search(wanted, grid or GRID)
    search.look([width, decay])
    if search.values[width].min() >= 0:
        return None
    fast = _faster(wanted, *search.best([width, decay]))
    return judged_design(wanted, fast.x, "judged", place_of(wanted, decay, fast))


def _faster(wanted: Wanted, widest: Found, fast: Found) -> Found:
    """The widest where it decays faster: both searches end at the same optimum, save for their last steps."""
    as_widest = float(assessed(wanted, [decay], widest.x[:, np.newaxis])[0, 0])
    return Found(widest.x, as_widest) if as_widest < fast.value else fast


class _Search:
    """The grid of a box, and searches that start from it."""

    def __init__(self, wanted: Wanted, grid: int) -> None:
        self.wanted = wanted
        self.low, self.high = wanted.box
        lam, sigma = axes(self.low, self.high, grid)
        self.shape = len(lam), len(sigma)
        self.x = np.stack(np.meshgrid(lam, sigma, indexing="ij")).reshape(2, -1)
        self.step = (self.high - self.low) / np.maximum(np.array(self.shape) - 1, 1)
        self.values: dict[Criterion, Floats] = {}
        self.known: list[Floats] = []  # further points to start from

    def look(self, criteria: Sequence[Criterion]) -> None:
        """Note what criteria give for each design of the grid."""
        missing = [criterion for criterion in criteria if criterion not in self.values]
        if missing:
            self.values.update(zip(missing, assessed(self.wanted, missing, self.x), strict=True))

    def best(self, criteria: Sequence[Criterion]) -> list[Found]:
        """The best design by each criterion."""
        self.look(criteria)
        starts = [self.starts(self.values[criterion]) for criterion in criteria]
        ends = minimise(partial(assessed, self.wanted, criteria), self.low, self.high, starts, self.step)
        return [Found(self.wanted.within(end.x), end.value) for end in ends]

    def starts(self, on_grid: Floats) -> Floats:
        """Points (S, 2) of the grid at its lowest local minima, behind those known otherwise."""
        i, j = basins(on_grid.reshape(self.shape), _STARTS)
        return np.array([*self.known, *self.x.reshape(2, *self.shape)[:, i, j].T])


def _front(search: _Search, widest: Found, fastest: Found) -> list[Found]:
    """Designs of which none is both wider and decays faster than another, the widest first."""
    if fastest.value >= 0:
        return []
    wanted, wide, growth = search.wanted, -search.values[width], search.values[decay]
    top = widest.x
    if assessed(wanted, [decay], top[:, np.newaxis])[0, 0] >= 0:  # the widest is unstable at a judged speed
        on_grid = np.where((wide > 0) & (growth < 0), -wide, WORSE + np.maximum(growth, 0))
        starts = np.array([fastest.x, *search.starts(on_grid)])
        cost = partial(assessed, wanted, [width_if_decaying])
        (found,) = minimise(cost, search.low, search.high, [starts], search.step)
        top = wanted.within(found.x)
    (most, least), (slow, fast) = width_and_decay(wanted, np.stack([top, fastest.x], axis=-1))
    part = np.arange(1, FRONT + 1)[:, np.newaxis] / (FRONT + 1)
    widths, rates = most + part * (least - most), slow + part * (fast - slow)

    def costs(wide: Floats, growth: Floats) -> Floats:  # of each width, of each decay
        return np.concatenate(
            [
                np.where(wide[:FRONT] >= widths, growth[:FRONT], WORSE + widths - wide[:FRONT]),
                np.where(growth[FRONT:] <= rates, -wide[FRONT:], WORSE + growth[FRONT:] - rates),
            ]
        )

    def evaluated(points: Floats) -> Floats:
        measures = width_and_decay(wanted, points.reshape(2, -1))
        return costs(*measures.reshape(2, *points.shape[1:]))

    on_grid = costs(*np.broadcast_to(np.stack([wide, growth])[:, np.newaxis], (2, 2 * FRONT, len(wide))))
    points = [np.array([top, fastest.x, *search.starts(values)]) for values in on_grid]
    between = minimise(evaluated, search.low, search.high, points, search.step)
    x = wanted.within(np.stack([top, *(found.x for found in between), fastest.x], axis=-1))
    wide, growth = width_and_decay(wanted, x)
    better = (wide >= wide[:, np.newaxis]) & (growth <= growth[:, np.newaxis])
    better &= (wide > wide[:, np.newaxis]) | (growth < growth[:, np.newaxis])
    front = [i for i in np.lexsort((growth, -wide)) if not better[i].any()]
    apart: list[int] = []
    for i in front:
        last = apart[-1] if apart else None
        if last is None or max(abs(wide[i] - wide[last]), abs(growth[i] - growth[last])) > _SAME:
            apart.append(i)
    return [Found(x[:, i], float(-wide[i])) for i in apart]
