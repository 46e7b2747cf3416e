"""Conclusion 3: which design has the greatest stability margin."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.design import criteria
from bikestab.design.best import Best, Design, best_designs
from bikestab.design.criteria import Wanted
from bikestab.family import Family
from bikestab.paper1981.box import LAM, SIGMA, Range, V

JUDGED: dict[str, Range | None] = {
    "at each design's best speed": None,
    "at 5 m/s": (5.0, 5.0),
    "at the worst of 4 … 6 m/s": (4.0, 6.0),
}


class Optimum(Design):
    """The best design by one criterion."""

    criterion: str


@dataclass(frozen=True)
class Apart:
    """How far the widest and the fastest decaying design are apart, in sides of the box."""

    apart: float | None


@dataclass(frozen=True)
class Margin:
    """The best designs by width and by decay."""

    optima: list[Optimum]
    judged_by: Apart


@cache
def searched(wanted: Wanted, grid: int) -> Best:
    """The best designs; the same ones are tabled and drawn."""
    return best_designs(wanted, grid=grid)


def whole_box(bicycle: Bicycle) -> Wanted:
    """Any design of the paper's box, widths counted up to its highest speed."""
    return Wanted(Family(bicycle), LAM, SIGMA, V_max=V[1])


def margin(bicycle: Bicycle, grid: int) -> Margin:
    """The best designs by width and by decay, each searched for in the paper's box."""
    optima: list[Optimum] = []
    for words, speeds in JUDGED.items():
        best = searched(replace(whole_box(bicycle), judged=speeds), grid)
        if not optima and best.widest:
            optima.append({"criterion": "widest interval", **best.widest})
        if best.fastest_decay:
            optima.append({"criterion": f"fastest decay {words}", **best.fastest_decay})
    if not optima:
        return Margin([], Apart(None))
    (x1, y1), (x2, y2) = ((optimum["lam"], optimum["sigma"]) for optimum in optima[:2])
    return Margin(optima, Apart(_sides_apart(x1, y1, x2, y2)))


def apart_on_grid(bicycle: Bicycle, n: int) -> float | None:
    """How far the widest and the fastest decaying of n × n designs are apart, in sides of the box."""
    x = np.stack(np.meshgrid(np.linspace(*LAM, n), np.linspace(*SIGMA, n), indexing="ij")).reshape(2, -1)
    width, growth = criteria.width_and_decay(whole_box(bicycle), x)
    if not width.max() > 0:
        return None
    widest, fastest = np.argmax(width), np.argmin(np.where(width > 0, growth, np.inf))
    return _sides_apart(*x[:, widest].tolist(), *x[:, fastest].tolist())


def _sides_apart(lam: float, sigma: float, other_lam: float, other_sigma: float) -> float:
    return max(abs(lam - other_lam) / (LAM[1] - LAM[0]), abs(sigma - other_sigma) / (SIGMA[1] - SIGMA[0]))
