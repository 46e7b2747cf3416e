"""(sensitivities, a stable interval) → by how much each parameter must change for V1 to change by LOWER.

Slopes tell the direction and how far to look. The answer is the first value there with which V1 + LOWER is
the lower end of a stable interval, by the exact speeds of machines with that value: V1 may turn on its way.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from bikestab.design.sensitivity import Sensitivity
from bikestab.geometry import trail_from
from bikestab.limits import MOST_TRAIL
from bikestab.machines import Machines
from bikestab.model import Floats, exact_table
from bikestab.speeds import Intervals, intervals_of
from bikestab.variants import front_of

LOWER = -0.1  # m/s
_FARTHEST = 4.0  # times what the slope alone says: beyond, V1 does not follow the parameter any more
_SAMPLES, _FINER, _ROUNDS = 64, 16, 6  # steps to look at, and those into which the first that will do is cut
_SAME = 1e-6  # m/s between V1 + LOWER and the end that is found
_STEEPEST = 1.5  # rad


def steps_to_lower(found: Sensitivity, interval: int) -> dict[str, float | None]:
    """The change of each parameter, in its SI unit, alone, with which this interval's V1 is LOWER away.

    ``found.hold`` stays with it. None where no change does it within what a machine may have, within the
    parameter's own value up or down (tilt, trail and offset aside) and _FARTHEST times what the slope says;
    where V1 is not above −LOWER; and for gravity, which nobody can change.
    """
    V = float(found.intervals.V1[interval]) + LOWER
    far = {name: _farthest(found, name, float(found.dV1[name][interval])) for name in found.values}
    names = [name for name, most in far.items() if most and name != "g"] if V > 0 else []
    none: dict[str, float | None] = dict.fromkeys(found.values)
    if not names:
        return none
    most = np.array([far[name] for name in names])[:, np.newaxis]
    below = np.zeros_like(most)
    width = most
    for i in range(_ROUNDS):
        parts = _SAMPLES if i == 0 else _FINER
        steps = below + width * np.arange(1, parts + 1) / parts
        does = _stable_at(_intervals(found, names, steps), V)
        first = np.argmax(does, axis=-1)[:, np.newaxis]
        if i == 0:
            reached = does.any(axis=-1)
        width = width / parts
        below = np.take_along_axis(steps, first, axis=-1) - width
    end = below + width
    at = _intervals(found, names, end)
    with np.errstate(invalid="ignore"):
        ends = np.any(np.abs(at.V1 - V) <= _SAME, axis=(-2, -1))
    good = reached & ends
    return none | {name: float(end[i, 0]) for i, name in enumerate(names) if good[i]}


def _farthest(found: Sensitivity, name: str, slope: float) -> float:
    """How far to look along a parameter, with the sign of the direction; 0 where there is none."""
    if not slope or not math.isfinite(slope):
        return 0.0
    step, own = _FARTHEST * LOWER / slope, abs(found.values[name])
    if front_of(found.bicycle, name) or not own:
        return step
    return math.copysign(min(abs(step), own), step)


def _stable_at(intervals: Intervals, V: float) -> Any:
    with np.errstate(invalid="ignore"):
        return ((intervals.V1 <= V) & (intervals.V2 > V)).any(axis=-1)


def _intervals(found: Sensitivity, names: list[str], steps: Floats) -> Intervals:
    """The stable speeds (name, step) where each of ``names`` alone is changed; none of what is no machine."""
    values = {
        name: np.where(
            np.arange(len(names))[:, np.newaxis] == i, found.values[name] + steps, found.values[name]
        )
        for i, name in enumerate(names)
    }
    others = {name: value for name, value in values.items() if not front_of(found.bicycle, name)}
    with np.errstate(all="ignore"):  # of what is no machine
        machines = Machines.varied(found.bicycle, others or {"g": np.asarray(found.bicycle.g)}, steps.shape)
    lam, sigma = _designs(found, values, machines)
    with np.errstate(all="ignore"):
        good = machines.exist & (np.abs(lam) < _STEEPEST) & (np.abs(sigma) <= MOST_TRAIL)
        good &= np.isfinite(sigma)
        lam, sigma = np.where(good, lam, found.lam), np.where(good, sigma, found.sigma)
        table = exact_table(machines, lam, sigma, model=found.model)
        intervals = intervals_of(table)
    arrays = intervals.arrays()
    arrays["V1"] = np.where(good[..., np.newaxis], arrays["V1"], np.nan)
    return Intervals(**arrays)


def _designs(found: Sensitivity, values: Mapping[str, Floats], machines: Machines) -> tuple[Floats, Floats]:
    """Tilt and σ of machines: what is held stays; trail, offset and σ vary with the rest as it is."""
    c, R2 = machines.c, machines.R2
    own = found.values
    lam = np.zeros(machines.shape) + found.lam
    lam = lam + (values["lam"] - own["lam"] if "lam" in values else 0.0)
    lam = lam - (values["head_angle"] - own["head_angle"] if "head_angle" in values else 0.0)
    with np.errstate(all="ignore"):
        if found.hold == "offset":
            sigma = trail_from(lam, own["offset"], R2) / c
        else:
            sigma = own["trail"] / c if found.hold == "trail" else np.full(machines.shape, found.sigma)
        for name in values:
            if front_of(found.bicycle, name) in ("trail", "offset"):
                by = {"sigma": 1.0, "offset": -c * np.cos(lam)}.get(name, c)
                sigma = sigma + (values[name] - own[name]) / by
    return lam, np.broadcast_to(sigma, machines.shape)
