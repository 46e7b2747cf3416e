"""A design as a record: judged, and where in the box it lies."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Literal, NotRequired

import numpy as np

from bikestab.design.criteria import WORSE, Criterion, Wanted, assessed, counted, judged
from bikestab.design.search import Found
from bikestab.family import Family
from bikestab.model import Floats
from bikestab.records import Design, design_record
from bikestab.speeds import KINDS

SHRINKS = ", where the interval shrinks to a point"
VANISHING = 0.01  # m/s: an optimum at the rim whose interval is narrower has an interval only in name
_BESIDE = 1e-4  # share of the box's sides at which the neighbours of an optimum are looked at
_JUMP = 1e-3  # share of its value by which an optimum at a jump is better than a close neighbour
_TOUCH = 1e-3  # m/s
_SAME_OFFSET = 1e-7  # m

Pick = Literal["widest", "lowest", "judged"]


class JudgedDesign(Design):
    """A design, one of its stable intervals, and its growth rate [s⁻¹] at the speed V [m/s] it is judged at.

    V2 is None where unbounded. V1, V2 and their kinds are None, and width 0, where nothing is stable;
    growth_rate is None where an eigenvalue is infinite. ``width`` ends at the cap. ``at`` says where an
    optimum lies: ``interior``, or the limit, edge or jump that it lies at. ``over`` has the parameters that
    were searched, where they are others than tilt and trail.
    """

    V1: float | None
    V2: float | None
    lower: str | None
    upper: str | None
    width: float
    growth_rate: float | None
    V: float
    at: str
    over: NotRequired[dict[str, float]]


def own_design(wanted: Wanted) -> JudgedDesign | None:
    """The machine's own design, and whether it is in the box and stable as asked; None where it has none."""
    own = wanted.family.own
    if None in own:
        return None
    x = np.array(own, dtype=float)
    inside = wanted.contains(x)
    allowed = bool(counted(wanted, wanted.table(x[:, np.newaxis])).any[0])
    at = "" if inside and allowed else "not stable as asked" if inside else "outside the box"
    return judged_design(wanted if allowed else replace(wanted, stable=None), x, at=at)


def judged_design(wanted: Wanted, x: Floats, pick: Pick = "widest", at: str = "") -> JudgedDesign:
    """The design with the interval that made it the best: the widest, the lowest, the one of speed V."""
    table = wanted.table(x[:, np.newaxis])
    found = counted(wanted, table)
    V, rate = judged(wanted, table, found, rounds=7)
    V1, V2, lower, upper = (values[0] for values in found.intervals)
    wide = np.where(found.counts, np.minimum(V2, wanted.V_max) - V1, -1.0)[0]
    merit = wide
    if pick == "lowest":
        merit = np.where(wide > 0, -V1, -np.inf)
    elif pick == "judged" and np.any(hit := (wide > 0) & (V[0] >= V1) & (V[0] <= V2)):
        merit = np.where(hit, 1.0, 0.0)
    k = int(np.argmax(merit))
    some = bool(found.intervals.upper[0, k])
    family = wanted.family
    lam, sigma, machine = family.geometry(*x)
    over = {} if family.of_front else {"over": {family.x: float(x[0]), family.y: float(x[1])}}
    return {
        **design_record(float(lam), float(sigma), machine),
        "V1": float(V1[k]) if some else None,
        "V2": finite(V2[k]),
        "lower": KINDS[lower[k]] if some else None,
        "upper": KINDS[upper[k]] if some else None,
        "width": max(float(wide[k]), 0.0),
        "growth_rate": finite(rate[0]),
        "V": float(V[0]),
        "at": at,
        **over,  # type: ignore[typeddict-item]  # which is one of its keys
    }


def place_in_plane(family: Family, design: JudgedDesign) -> tuple[float, float]:
    """The values of the family's two parameters that a design has."""
    values: dict[str, Any] = {**design, **design.get("over", {})}
    return values[family.x], values[family.y]


def place_of(wanted: Wanted, criterion: Criterion, best: Found) -> str:
    """Where in the box an optimum lies, from its coordinates and from designs just beside it."""
    low, high = wanted.box
    size = high - low
    places = []
    for i, name in enumerate((wanted.family.x, wanted.family.y)):
        for end, given in zip((low[i], high[i]), (wanted.x, wanted.y)[i], strict=True):
            if size[i] and abs(best.x[i] - end) <= 1e-6 * size[i] and (i or end == given):
                places.append(f"limit of {'trail' if end != given else name}")
    if wanted.offset and min(abs(wanted.offset_at(best.x) - end) for end in wanted.offset) <= _SAME_OFFSET:
        places.append("limit of offset")
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
    return float(assessed(wanted, [criterion], points).max())  # which moves them into the limits


def _rim(wanted: Wanted, x: Floats) -> str:
    """The words for an optimum beside which nothing is stable."""
    found = counted(wanted, wanted.table(x[:, np.newaxis]))
    vanishes = found.width[found.counts].min(initial=np.inf) < VANISHING
    return "edge of the stable region" + (SHRINKS if vanishes else "")


def _touches(wanted: Wanted, x: Floats) -> bool:
    """Whether an interval ends where the speeds do that should be stable."""
    if not wanted.stable:
        return False
    found = counted(wanted, wanted.table(x[:, np.newaxis]))
    near = np.abs(found.intervals.V1 - wanted.stable[0]) < _TOUCH
    near |= np.abs(found.intervals.V2 - wanted.stable[1]) < _TOUCH
    return bool(np.any(near & found.counts))


def finite(value: float) -> float | None:
    """A number as records hold it: None for one that is not finite."""
    return float(value) if math.isfinite(value) else None
