"""Conclusion 3: which design has the greatest stability margin."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.design import criteria
from bikestab.design.best import Best, best_designs, fastest_decay
from bikestab.design.criteria import Wanted
from bikestab.design.optimum import JudgedDesign
from bikestab.family import Family
from bikestab.model import Floats
from bikestab.paper1981.box import LAM, PAPER_BOX, SIGMA, DesignBox, Range, V
from bikestab.paper1981.controllability import Controllability, controllability
from bikestab.paper1981.forks import bent_forwards, offset
from bikestab.paper1981.largest_ball import Ball, largest_ball

JUDGED: dict[str, Range | None] = {
    "at each design's best speed": None,
    "at 5 m/s": (5.0, 5.0),
    "at the worst of 4 … 6 m/s": (4.0, 6.0),
}


class Optimum(JudgedDesign):
    """The best design by one criterion."""

    criterion: str


@dataclass(frozen=True)
class Apart:
    """How far the widest and the fastest decaying design are apart, in sides of the box."""

    apart: float | None


@dataclass(frozen=True)
class GridOptimum:
    """The best of a grid of designs by one criterion: fork offset [m], width [m/s] and growth rate [1/s]."""

    criterion: str
    lam: float
    sigma: float
    offset: float
    width: float
    growth_rate: float


@dataclass(frozen=True)
class GridMargin:
    """The best of a grid of designs by width and by decay."""

    designs: int
    optima: list[GridOptimum]
    judged_by: Apart


@dataclass(frozen=True)
class Margin:
    """The best designs by width and by decay, of all and of those whose fork is bent forwards."""

    optima: list[Optimum]
    judged_by: Apart
    forwards: GridMargin
    ball: Ball
    controllability: list[Controllability]


@cache
def searched(wanted: Wanted, grid: int) -> Best:
    """The best designs; the same ones are tabled and drawn."""
    return best_designs(wanted, grid=grid)


def whole_box(bicycle: Bicycle) -> Wanted:
    """Any design of the paper's box, widths counted up to its highest speed."""
    return Wanted(Family(bicycle), LAM, SIGMA, V_max=V[1])


def margin(bicycle: Bicycle, grid: int, points: int) -> Margin:
    """The best designs by width, by decay and by distance from the boundary, searched for in the paper's box.

    The search starts from ``grid`` designs per axis; balls and controllability are from ``points`` per axis.
    """
    optima: list[Optimum] = []
    for words, speeds in JUDGED.items():
        wanted = replace(whole_box(bicycle), judged=speeds)
        if optima:
            fast = fastest_decay(wanted, grid=grid)
        else:
            best = searched(wanted, grid)
            fast = best.fastest_decay
            if best.widest:
                optima.append({"criterion": "widest interval", **best.widest})
        if fast:
            optima.append({"criterion": f"fastest decay {words}", **fast})
    designs = [(optimum["lam"], optimum["sigma"]) for optimum in optima[:2]]
    _, forwards = margins_on_grid(bicycle, grid)
    ball = largest_ball(bicycle, points)
    named = {optimum["criterion"]: (optimum["lam"], optimum["sigma"]) for optimum in optima[:2]}
    named["largest ball"] = ball.lam, ball.sigma
    reached = controllability(bicycle, points // 2, named)
    return Margin(optima, Apart(_sides_apart(designs, PAPER_BOX)), forwards, ball, reached)


def margins_on_grid(bicycle: Bicycle, n: int, box: DesignBox = PAPER_BOX) -> tuple[GridMargin, GridMargin]:
    """The best of n × n designs of a box, and the best of those whose fork is bent forwards."""
    x = np.stack(np.meshgrid(np.linspace(*box.lam, n), np.linspace(*box.sigma, n), indexing="ij"))
    x = x.reshape(2, -1)
    width, growth = criteria.width_and_decay(Wanted(Family(bicycle), box.lam, box.sigma, V_max=V[1]), x)
    everywhere, forwards = (
        _grid_margin(bicycle, x[:, chosen], width[chosen], growth[chosen], box)
        for chosen in (slice(None), bent_forwards(bicycle, *x))
    )
    return everywhere, forwards


def _grid_margin(bicycle: Bicycle, x: Floats, width: Floats, growth: Floats, box: DesignBox) -> GridMargin:
    stable = np.flatnonzero(width > 0)
    best = {
        "widest interval": stable[np.argmax(width[stable])],
        "fastest decay at each design's best speed": stable[np.argmin(growth[stable])],
    } if len(stable) else {}  # fmt: skip
    b = offset(bicycle, *x)
    optima = [
        GridOptimum(words, *(float(values[k]) for values in (*x, b, width, growth)))
        for words, k in best.items()
    ]
    return GridMargin(len(width), optima, Apart(_sides_apart([(o.lam, o.sigma) for o in optima], box)))


def _sides_apart(designs: list[tuple[float, float]], box: DesignBox) -> float | None:
    """How far two designs are apart along λ or σ, in sides of the box; None without designs."""
    if not designs:
        return None
    lam, sigma = np.ptp(designs, axis=0)
    return float(max(lam / np.ptp(box.lam), sigma / np.ptp(box.sigma)))
