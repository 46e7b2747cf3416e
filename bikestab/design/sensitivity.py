"""(bicycle, λ, σ) → how its stable speeds move with every parameter: exact derivatives.

An end V of a stable interval is a zero of F(V, p), p0 or hurwitz3, so that dV/dp = −F_p/F_V. The slopes of F
come from those of the table (``slopes``), in twice double precision as F itself; no step is taken.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from bikestab.arguments import Given, design_of
from bikestab.bicycle import Bicycle
from bikestab.design.rates import Rate, best_rate
from bikestab.errors import InputError, nearest
from bikestab.model import Floats, Model
from bikestab.slopes import Slopes, by_name, condition_at, free_parameters, skates, slopes_of
from bikestab.speeds import CAPSIZE, REST, WEAVE, Intervals
from bikestab.stability import stable_intervals
from bikestab.twofold import Twofold

Hold = Literal["trail", "offset", "sigma"]
HOLDS: tuple[Hold, ...] = get_args(Hold)
GEOMETRY = {  # what a frame's front is measured by, beside the notation's own parameters
    "lam": ("rad", "steering-axis tilt"),
    "head_angle": ("rad", "head angle, 90° − tilt"),
    "sigma": ("1", "trail divided by the wheelbase"),
    "trail": ("m", "trail along the ground"),
    "offset": ("m", "fork offset, R2 sin λ − σ c cos λ"),
}
_STEPS = 2  # of Newton's, from an end that is right to a double already


@dataclass(frozen=True, kw_only=True)
class Sensitivity:
    """The stable intervals of a design and their ends' derivatives by each parameter.

    ``dV1`` and ``dV2`` have an array (interval,) of m/s per unit for each name in ``values``: the parameters
    of the bicycle's notation, and those of GEOMETRY. Where there is no derivative it is NaN: of an unbounded
    end, and by the spin of a skate, which cannot have one. ``hold`` is what of the front stays where another
    parameter varies, tilt and head angle too: the trail, the fork's offset, or σ. These three themselves are
    varied with all others as they are. ``best`` is the lowest growth rate over the speeds up to 30 m/s:
    its ``value`` [1/s], the speed ``V`` [m/s], and its ``slope`` by each name.

    >>> import bikestab as bs
    >>> frame = bs.sensitivity(bs.Bicycle.preset("meijaard2007"), hold="offset")
    >>> round(frame.values["offset"], 4), frame.units["offset"], frame.dV1["head_angle"].round(2)
    (0.0321, 'm', array([-8.49]))
    """

    bicycle: Bicycle
    lam: float
    sigma: float
    model: Model
    hold: Hold
    intervals: Intervals
    values: dict[str, float]
    units: dict[str, str]
    meanings: dict[str, str]
    dV1: dict[str, Floats]
    dV2: dict[str, Floats]
    best: Rate

    def elasticity(self, name: str) -> tuple[Floats, Floats]:
        """The d ln V1/d ln p and d ln V2/d ln p (interval,): per cent of a speed for one per cent of p."""
        with np.errstate(divide="ignore", invalid="ignore"):
            V1, V2 = self.intervals.V1, self.intervals.V2
            return self.dV1[name] * self.values[name] / V1, self.dV2[name] * self.values[name] / V2


def sensitivity(
    bicycle: Bicycle,
    lam: Given = None,
    sigma: Given = None,
    *,
    hold: Hold | None = None,
    model: Model = "refined",
    delta: float | None = None,
) -> Sensitivity:
    """How the ends of the stable intervals move with every parameter of the machine: exact derivatives.

    Parameters
    ----------
    bicycle : Bicycle
        The machine.
    lam, sigma : float or str, optional
        Its tilt [rad] and trail divided by the wheelbase, as in ``stable_intervals``; by default its own.
    hold : {"trail", "offset", "sigma"}, optional
        What stays constant where tilt, wheelbase or front wheel vary. By default that which the bicycle's
        notation has: the trail among the 25 parameters, σ in the paper's.
    model, delta
        As in ``stable_intervals``.

    Returns
    -------
    Sensitivity
        ``dV1["mB"]`` is an array (interval,) in m/s per unit of that parameter, ``elasticity("mB")`` the
        same in per cent for one per cent.

    Raises
    ------
    InputError
        As ``stable_intervals``, for several designs, and for an unknown ``hold``.

    Notes
    -----
    By the implicit function theorem: dV/dp = −F_p/F_V where hurwitz3 or p0 of (2.2) in Dikarev, Dikareva and
    Fufaev (1981) is zero; F_p by forward propagation through the equations, in twice double precision.

    Examples
    --------
    >>> import bikestab as bs
    >>> found = bs.sensitivity(bs.Bicycle.preset("meijaard2007"))
    >>> found.dV1["mB"].round(5), found.dV2["mB"].round(5)  # m/s for each kg
    (array([0.01513]), array([0.02541]))
    >>> [each.round(3) for each in found.elasticity("rF")]
    [array([0.413]), array([0.597])]
    """
    intervals = stable_intervals(bicycle, lam, sigma, model=model, delta=delta)  # checks all of these
    if intervals.V1.ndim > 1:
        raise InputError(
            "derivatives are those of one design", key=("lam",), hint="give one lam and one sigma"
        )
    if hold is not None and hold not in HOLDS:
        raise InputError(f"{hold!r} cannot be held", key=("hold",), hint=nearest(str(hold), HOLDS))
    machine = bicycle.with_delta(delta)
    tilt, trail = (float(value) for value in design_of(machine, lam, sigma))
    hold = hold or ("trail" if machine.bodies is not None else "sigma")
    slopes = slopes_of(machine, tilt, trail, model=model)
    ends = [
        [
            held(machine, tilt, trail, hold, speed_slopes(machine, slopes, float(V), int(kind)))
            for V, kind in zip(speeds[: int(intervals.number)], kinds, strict=False)
        ]
        for speeds, kinds in ((intervals.V1, intervals.lower), (intervals.V2, intervals.upper))
    ]
    values, units, meanings = described(machine, tilt, trail)
    dV1, dV2 = ({name: np.array([end[name] for end in of]) for name in values} for of in ends)
    best = best_rate(slopes)
    rates = held(machine, tilt, trail, hold, best.slope | skates(machine))
    best = best._replace(slope={name: rates[name] for name in values})
    return Sensitivity(
        bicycle=machine, lam=tilt, sigma=trail, model=model, hold=hold, intervals=intervals,
        values=values, units=units, meanings=meanings, dV1=dV1, dV2=dV2, best=best,
    )  # fmt: skip


def speed_slopes(bicycle: Bicycle, slopes: Slopes, V: float, kind: int) -> dict[str, float]:
    """The derivatives of an end V [m/s] of this kind by each parameter, at constant λ and σ; and by these.

    Zero by all for an interval from rest on, NaN where it is unbounded.
    """
    if kind not in (WEAVE, CAPSIZE):
        return dict.fromkeys(slopes.variables[:-1], 0.0 if kind == REST else math.nan)
    name = "hurwitz3" if kind == WEAVE else "p0"
    speed = Twofold(np.asarray(V))
    for _ in range(_STEPS):
        F = condition_at(slopes, name, speed)
        slope = Twofold(F.slope.value[-1], F.slope.rest[-1])
        speed = speed - F.value / slope
        speed = Twofold(speed.value, speed.rest)  # its size is its own, however it was found
    F = condition_at(slopes, name, speed)
    parts = by_name(slopes, F.slope)
    by_speed = float(parts["V"])
    found = {
        each: -float(parts[each]) / by_speed + 0.0 if by_speed else math.nan for each in slopes.variables[:-1]
    }
    return found | skates(bicycle)


def two_parts(bicycle: Bicycle) -> Bicycle:
    """The machine in the paper's notation, so that one in another can stand beside it."""
    numbers = {name: value for name, value in bicycle.numbers().items() if value is not None}
    return Bicycle.from_mapping({**numbers, "source": bicycle.source}, name=bicycle.name)


def held(
    bicycle: Bicycle, lam: float, sigma: float, hold: Hold, partial: dict[str, float]
) -> dict[str, float]:
    """Derivatives at constant trail, offset or σ, and by all of GEOMETRY, from those at constant λ and σ.

    σ = trail/c = (R2 sin λ − offset)/(c cos λ) follows the wheelbase, the front radius and the tilt.
    """
    c, R2, cos, tan = bicycle.c, bicycle.R2, math.cos(lam), math.tan(lam)
    found = dict(partial)
    wheelbase, front = ("w", "rF") if bicycle.bodies is not None else ("c", "R2")
    by_sigma = partial["sigma"]
    if hold != "sigma":
        found[wheelbase] -= sigma / c * by_sigma
    if hold == "offset":
        found[front] += tan / c * by_sigma
        found["lam"] += (R2 / c + sigma * tan) * by_sigma
    found |= {"head_angle": -found["lam"], "trail": by_sigma / c, "offset": -by_sigma / (c * cos)}
    return found | ({"c": found["trail"]} if bicycle.bodies is not None else {})


def described(
    bicycle: Bicycle, lam: float, sigma: float
) -> tuple[dict[str, float], dict[str, str], dict[str, str]]:
    """Values, units and meanings of what may vary: the notation's parameters, then GEOMETRY."""
    trail = sigma * bicycle.c
    geometry = {
        "lam": lam,
        "head_angle": 0.5 * math.pi - lam,
        "sigma": sigma,
        "trail": trail,
        "offset": bicycle.R2 * math.sin(lam) - trail * math.cos(lam),
    }
    values = free_parameters(bicycle)
    if bicycle.bodies is not None:
        values["c"] = trail
    known = {**values, **geometry}
    values = {name: known[name] for name in (*bicycle.notation, *geometry) if name in known}
    units, meanings = {}, {}
    for name in values:
        if name in GEOMETRY:
            units[name], meanings[name] = GEOMETRY[name]
        else:
            meaning, _, unit = bicycle.notation[name].rpartition(" [")
            units[name], meanings[name] = unit.rstrip("]"), meaning
    return values, units, meanings
