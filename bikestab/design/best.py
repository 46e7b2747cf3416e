"""The best designs in a box of a family, by several criteria, and the front between two of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Literal, NamedTuple, TypedDict

import numpy as np

from bikestab.design.criteria import (
    WORSE,
    Wanted,
    counted,
    decay,
    judged,
    lowest,
    miss,
    missed_by,
    width,
    width_and_decay,
    width_if_decaying,
)
from bikestab.design.search import Found, axes, basins, minimise, minimise_all
from bikestab.model import Floats
from bikestab.speeds import KINDS

GRID = 161  # values per axis to start from: a region narrower than a step of theirs may be missed
FRONT = 6  # how many widths, and how many rates of decay, the front is searched for between its ends
_STARTS = 15
_VANISHING = 0.01  # m/s: an optimum at the rim whose interval is narrower has an interval only in name
_BESIDE = 1e-4  # share of the box's sides at which the neighbours of an optimum are looked at
_JUMP = 1e-3  # share of its value by which an optimum at a jump is better than a close neighbour
_TOUCH = 1e-3  # m/s
_SAME = 1e-4  # m/s, 1/s: designs of the front that differ less are one, found twice

Criterion = Callable[[Wanted, Floats], Floats]
Pick = Literal["widest", "lowest", "judged"]


class Design(TypedDict):
    """A design, one of its stable intervals, and its growth rate [s⁻¹] at the speed V [m/s] it is judged at.

    V2 is None where unbounded. V1, V2 and their kinds are None, and width 0, where nothing is stable;
    growth_rate is None where an eigenvalue is infinite. ``width`` ends at the cap. ``at`` says where an
    optimum lies: ``interior``, or the limit, edge or jump that it lies at.
    """

    lam: float
    sigma: float
    head_angle_deg: float
    trail: float
    V1: float | None
    V2: float | None
    lower: str | None
    upper: str | None
    width: float
    growth_rate: float | None
    V: float
    at: str


class Best(NamedTuple):
    """The bicycle's own design and the optima, each None where there is none.

    ``pareto`` is the front between width and decay, the widest first: of its designs none is both wider
    and decays faster than another. Where no design in the box is allowed, ``closest`` is the one with
    the lowest growth rate over the speeds that should be stable, or at its best speed.
    """

    own: Design | None
    widest: Design | None
    lowest_V1: Design | None
    fastest_decay: Design | None
    pareto: list[Design]
    closest: Design | None


def best_designs(wanted: Wanted, *, grid: int | None = None) -> Best:
    """Search the box, starting from grid × grid designs; the same question has the same answer."""
    search = _Search(wanted, grid or GRID)
    own = _own(wanted)
    nearest = search.best(miss) if search.on_grid(width).min() >= 0 else None
    if nearest and nearest.value > 0:
        V, rate = missed_by(wanted, wanted.table(nearest.x[:, np.newaxis]), rounds=7)
        closest = _design(replace(wanted, stable=None), nearest.x)
        closest |= {"V": float(V[0]), "growth_rate": _finite(rate[0])}
        return Best(own, None, None, None, [], closest)
    if nearest:  # a region that the grid missed
        search.known.append(nearest.x)
    widest, low, fast = (search.best(criterion) for criterion in (width, lowest, decay))
    as_widest = float(decay(wanted, widest.x[:, np.newaxis])[0])
    if as_widest < fast.value:  # both searches end at the same optimum, save for their last steps
        fast = Found(widest.x, as_widest)
    return Best(
        own,
        _design(wanted, widest.x, "widest", _place(wanted, width, widest)),
        _design(wanted, low.x, "lowest", _place(wanted, lowest, low)),
        _design(wanted, fast.x, "judged", _place(wanted, decay, fast)),
        [_design(wanted, best.x, at=_place(wanted, width, best)) for best in _front(search, widest, fast)],
        None,
    )


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

    def on_grid(self, criterion: Criterion) -> Floats:
        """What the criterion gives for each design of the grid."""
        if criterion not in self.values:
            self.values[criterion] = criterion(self.wanted, self.x)
        return self.values[criterion]

    def best(self, criterion: Criterion) -> Found:
        starts = self.starts(self.on_grid(criterion))
        return minimise(partial(criterion, self.wanted), self.low, self.high, starts, self.step)

    def starts(self, on_grid: Floats) -> Floats:
        """Points (S, 2) of the grid at its lowest local minima, behind those known otherwise."""
        i, j = basins(on_grid.reshape(self.shape), _STARTS)
        return np.array([*self.known, *self.x.reshape(2, *self.shape)[:, i, j].T])


def _front(search: _Search, widest: Found, fastest: Found) -> list[Found]:
    """Designs of which none is both wider and decays faster than another, the widest first."""
    if fastest.value >= 0:
        return []
    wanted, wide, growth = search.wanted, -search.on_grid(width), search.on_grid(decay)
    top = widest.x
    if decay(wanted, top[:, np.newaxis])[0] >= 0:  # the widest is unstable at a judged speed
        on_grid = np.where((wide > 0) & (growth < 0), -wide, WORSE + np.maximum(growth, 0))
        starts = np.array([fastest.x, *search.starts(on_grid)])
        cost = partial(width_if_decaying, wanted)
        top = minimise(cost, search.low, search.high, starts, search.step).x
    (most, least), (slow, fast) = width_and_decay(wanted, np.stack([top, fastest.x], axis=-1))
    part = np.arange(1, FRONT + 1)[:, np.newaxis] / (FRONT + 1)
    widths, rates = most + part * (least - most), slow + part * (fast - slow)

    def costs(measures: Floats) -> Floats:  # for each width the fastest decay, for each decay the widest
        wide, growth = measures
        return np.concatenate(
            [
                np.where(wide[:FRONT] >= widths, growth[:FRONT], WORSE + widths - wide[:FRONT]),
                np.where(growth[FRONT:] <= rates, -wide[FRONT:], WORSE + growth[FRONT:] - rates),
            ]
        )

    on_grid = costs(np.broadcast_to(np.stack([wide, growth])[:, np.newaxis], (2, 2 * FRONT, len(wide))))
    points = [np.array([top, fastest.x, *search.starts(values)]) for values in on_grid]
    between = minimise_all(
        partial(width_and_decay, wanted), costs, search.low, search.high, points, search.step
    )
    x = np.stack([top, *between, fastest.x], axis=-1)
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


def _own(wanted: Wanted) -> Design | None:
    own = wanted.family.own
    if None in own:
        return None
    x = np.array(own, dtype=float)
    low, high = wanted.box
    inside = bool(np.all((low <= x) & (x <= high)))
    allowed = bool(counted(wanted, wanted.table(x[:, np.newaxis])).any[0])
    at = "" if inside and allowed else "not stable as asked" if inside else "outside the box"
    return _design(wanted if allowed else replace(wanted, stable=None), x, at=at)


def _design(wanted: Wanted, x: Floats, pick: Pick = "widest", at: str = "") -> Design:
    """The design with the interval that made it the best: the widest, the lowest, the one of speed V."""
    table = wanted.table(x[:, np.newaxis])
    found = counted(wanted, table)
    V, rate = judged(wanted, table, found, rounds=7)
    V1, V2, lower, upper = (values[0] for values in found.intervals[:4])
    wide = np.where(found.counts, np.minimum(V2, wanted.V_max) - V1, -1.0)[0]
    merit = wide
    if pick == "lowest":
        merit = np.where(wide > 0, -V1, -np.inf)
    elif pick == "judged" and np.any(hit := (wide > 0) & (V[0] >= V1) & (V[0] <= V2)):
        merit = np.where(hit, 1.0, 0.0)
    k = int(np.argmax(merit))
    some = bool(found.intervals.upper[0, k])
    lam, sigma, wheelbase = (float(value) for value in wanted.family.geometry(*x))
    return Design(
        lam=lam,
        sigma=sigma,
        head_angle_deg=90 - math.degrees(lam),
        trail=sigma * wheelbase,
        V1=float(V1[k]) if some else None,
        V2=_finite(V2[k]),
        lower=KINDS[lower[k]] if some else None,
        upper=KINDS[upper[k]] if some else None,
        width=max(float(wide[k]), 0.0),
        growth_rate=_finite(rate[0]),
        V=float(V[0]),
        at=at,
    )


def _place(wanted: Wanted, criterion: Criterion, best: Found) -> str:
    """Where in the box an optimum lies, from its coordinates and from designs just beside it."""
    low, high = wanted.box
    size = high - low
    places = []
    for i, name in enumerate((wanted.family.x, wanted.family.y)):
        for end, given in ((low[i], wanted.y[0]), (high[i], wanted.y[1])):
            if size[i] and abs(best.x[i] - end) <= 1e-6 * size[i]:
                places.append(f"limit of {'trail' if i and end != given else name}")
    near, far = (_beside(wanted, criterion, best.x, share * size) for share in (0.1 * _BESIDE, _BESIDE))
    if far >= WORSE:
        places.append("edge of the speeds asked for" if _touches(wanted, best.x) else _rim(wanted, best.x))
    elif near - best.value > max(0.5 * (far - best.value), _JUMP * abs(best.value)):  # not less when nearer
        places.append("jump")
    return ", ".join(places) or "interior"


def _beside(wanted: Wanted, criterion: Criterion, x: Floats, radii: Floats) -> float:
    """The worst value on an ellipse around a design."""
    angle = 2 * np.pi * np.arange(16) / 16
    points = x[:, np.newaxis] + radii[:, np.newaxis] * np.array([np.cos(angle), np.sin(angle)])
    return float(criterion(wanted, np.clip(points, *(end[:, np.newaxis] for end in wanted.box))).max())


def _rim(wanted: Wanted, x: Floats) -> str:
    """The words for an optimum beside which nothing is stable."""
    found = counted(wanted, wanted.table(x[:, np.newaxis]))
    vanishes = found.width[found.counts].min(initial=np.inf) < _VANISHING
    return "edge of the stable region" + (", where the interval shrinks to a point" if vanishes else "")


def _touches(wanted: Wanted, x: Floats) -> bool:
    """Whether an interval ends where the speeds do that should be stable."""
    if not wanted.stable:
        return False
    found = counted(wanted, wanted.table(x[:, np.newaxis]))
    near = np.abs(found.intervals.V1 - wanted.stable[0]) < _TOUCH
    near |= np.abs(found.intervals.V2 - wanted.stable[1]) < _TOUCH
    return bool(np.any(near & found.counts))


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
