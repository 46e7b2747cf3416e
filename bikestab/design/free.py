"""What is asked of designs in which up to six parameters of a machine are free, and the best of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, TypedDict

import numpy as np

from bikestab.aside import meanwhile
from bikestab.bicycle import Bicycle
from bikestab.design.ball import Ball, most_robust
from bikestab.design.criteria import (
    WORSE,
    Criterion,
    assessed,
    counted,
    decay,
    decay_finely,
    judged,
    lowest,
    width,
)
from bikestab.design.optimum import SHRINKS, VANISHING, finite
from bikestab.design.polish import better, or_inf, polished
from bikestab.draws import evenly
from bikestab.errors import InputError
from bikestab.lean import lean_numpy
from bikestab.limits import check_speed
from bikestab.model import Floats, Model, characteristic_table
from bikestab.records import Design, design_record
from bikestab.speeds import KINDS
from bikestab.variants import check_names, check_values, own_value, varied

with lean_numpy():
    from scipy.optimize import differential_evolution

MOST_FREE = 6
Range = tuple[float, float]
_START = 1024  # designs that are tried first, a low-discrepancy sequence
_POPULATION, _ROUNDS = 40, 60
_SEED = 1981


@dataclass(frozen=True)
class Free:
    """A box of designs: the ends of each free parameter, by its name; speeds as in ``Wanted``.

    Raises InputError, with the parameter's name as key, for what the bicycle does not have or no machine can
    have, and for more than six.
    """

    bicycle: Bicycle
    ends: Mapping[str, Range]
    model: Model = "refined"
    V_max: float = 30.0
    judged: Range | None = None
    stable: Range | None = None

    def __post_init__(self) -> None:
        if not 1 <= len(self.ends) <= MOST_FREE:
            hint = f"allowed: 1 to {MOST_FREE}"
            raise InputError(f"{len(self.ends)} parameters cannot be free", key=("free",), hint=hint)
        check_names(self.bicycle, {name: name for name in self.ends})
        for which in range(2 ** len(self.ends)):
            corner = {name: ends[which >> i & 1] for i, (name, ends) in enumerate(self.ends.items())}
            check_values(self.bicycle, corner)
        for name, speeds in (("judged", self.judged), ("stable", self.stable)):
            for V in speeds or ():
                check_speed(V, (name,))
        if self.stable and self.stable[1] > self.V_max:
            hint = f"raise V_max to {self.stable[1]:g} at least"
            raise InputError(
                f"{self.stable[1]:g} m/s is above {self.V_max:g} m/s", key=("stable",), hint=hint
            )

    @property
    def box(self) -> tuple[Floats, Floats]:
        """The lowest and the highest of each parameter."""
        low, high = np.array(list(self.ends.values()), dtype=float).T
        return low, high

    def within(self, x: Floats) -> Floats:
        """Points (n, *shape) moved into the box."""
        low, high = (end.reshape(-1, *(1,) * (x.ndim - 1)) for end in self.box)
        return np.clip(x, low, high)

    def table(self, x: Floats) -> Floats:
        """Characteristic tables of designs x (n, *shape)."""
        machine, lam, sigma = varied(self.bicycle, dict(zip(self.ends, x, strict=True)))
        lam, sigma = (np.broadcast_to(value, x.shape[1:]) for value in (lam, sigma))
        return characteristic_table(machine, lam, sigma, model=self.model)

    @cached_property
    def first(self) -> Floats:
        """Designs (n, S) spread evenly over the box, the bicycle's own among them where it is inside."""
        low, high = self.box
        unit = evenly(len(self.ends), _START)
        points = low + (high - low) * unit
        if (own := self.own) is not None and np.all((low <= own) & (own <= high)):
            points[0] = own
        return points.T

    @property
    def own(self) -> Floats | None:
        """The bicycle's own design (n,); None where it has none."""
        own = [own_value(self.bicycle, name) for name in self.ends]
        return None if None in own else np.array(own, dtype=float)


class FreeDesign(Design):
    """A design, its free parameters in ``over``, its widest interval, and the growth rate as judged.

    The interval is one that is stable as asked, where there is one. ``at`` says at which limits it lies, or
    that it is not stable as asked.
    """

    over: dict[str, float]
    V1: float | None
    V2: float | None
    lower: str | None
    upper: str | None
    width: float
    growth_rate: float | None
    V: float
    at: str


class RobustDesign(TypedDict):
    """The design with the largest ball of stable machines around it, in standard ``deviations``.

    ``radius`` is that of the ball; at ``nearest``, a machine on its surface, the interval of speeds is lost.
    """

    design: FreeDesign
    radius: float
    deviations: dict[str, float]
    nearest: dict[str, float]


class FreeBest(NamedTuple):
    """The own design and the optima, None where there is none."""

    own: FreeDesign | None
    widest: FreeDesign | None
    lowest_V1: FreeDesign | None
    fastest_decay: FreeDesign | None
    most_robust: RobustDesign | None

    @property
    def designs(self) -> dict[str, FreeDesign]:
        """Those that there are, by what they are called in tables and pictures."""
        robust = self.most_robust and self.most_robust["design"]
        named = {"own": self.own, "widest": self.widest, "lowest V1": self.lowest_V1}
        named |= {"fastest decay": self.fastest_decay, "most robust": robust}
        return {name: design for name, design in named.items() if design}


def best_free(free: Free, deviations: Mapping[str, float] | None = None) -> FreeBest:
    """The best designs; the most robust one where standard deviations and ``stable`` speeds are given.

    InputError, with the key ``sd``, for deviations without speeds, and for what the bicycle does not have.
    """

    def optimized() -> list[tuple[Floats, float]]:
        return [best_of(free, criterion) for criterion in (width, lowest, decay)]

    robust = None
    if deviations:
        if free.stable is None:
            hint = "for example stable from 4.5 to 5.5 m/s"
            raise InputError("robust designs need speeds to be stable at", key=("stable",), hint=hint)
        ball = Ball(free.bicycle, free.model, free.stable, free.ends, deviations)
        with meanwhile(optimized) as others:
            if found := most_robust(ball, free.first):
                x, radius, nearest = found
                robust = RobustDesign(
                    design=free_design(free, x), radius=radius, deviations={**deviations}, nearest=nearest
                )
            optima = others()
    else:
        optima = optimized()
    widest, low, fast = (None if value >= WORSE else free_design(free, x) for x, value in optima)
    own = None if free.own is None else free_design(free, free.own)
    best = [own, widest, low, fast, robust and robust["design"]]
    return FreeBest(
        own, better(widest, best, lambda design: -design["width"]),
        better(low, best, lambda design: or_inf(design["V1"])),
        better(fast, best, lambda design: or_inf(design["growth_rate"])), robust,
    )  # fmt: skip


def best_of(free: Free, criterion: Criterion) -> tuple[Floats, float]:
    """The design (n,) with the smallest value of a criterion, and that value; the same each time.

    Differential evolution from the best of evenly spread designs, then random steps that shrink: optima
    lie at kinks and rims, where gradients mislead.
    """
    low, high = free.box
    random = np.random.default_rng(_SEED)

    def cost(x: Floats) -> Floats:
        return assessed(free, [criterion], x)[0]

    start = free.first[:, np.argsort(cost(free.first), kind="stable")[:_POPULATION]].T
    beyond = 0.05 * (high - low)
    end = differential_evolution(
        cost, list(zip(low - beyond, high + beyond, strict=True)), init=start, vectorized=True,
        updating="deferred", polish=False, rng=random, maxiter=_ROUNDS, tol=0, atol=1e-9,
        mutation=(0.4, 0.9), recombination=0.9,
    )  # fmt: skip
    exact = decay_finely if criterion is decay else criterion

    def fine(x: Floats) -> Floats:
        return assessed(free, [exact], x)[0]

    return polished(cost, fine, free.box, free.within(end.x), random)


def free_design(free: Free, x: Floats) -> FreeDesign:
    """A design (n,) as a record."""
    found = counted(free, free.table(x[:, np.newaxis]))
    V, rate = judged(free, free.table(x[:, np.newaxis]), found, rounds=7)
    wide = np.minimum(found.intervals.V2, free.V_max) - found.intervals.V1  # of those too that do not count
    some = found.counts[0].any()
    k = int(np.argmax(np.where(found.counts if some else wide > 0, wide, -1)[0]))
    V1, V2, lower, upper = (values[0, k] for values in found.intervals)
    low, high = free.box
    at = _place(free, x, vanishes=bool(V2 - V1 < VANISHING)) if some else "not stable as asked"
    at = at if np.all((low <= x) & (x <= high)) else f"outside of what is searched{'' if some else f', {at}'}"
    machine, lam, sigma = varied(free.bicycle, dict(zip(free.ends, x.tolist(), strict=True)))
    return {
        **design_record(float(lam), float(sigma), machine),
        "over": dict(zip(free.ends, x.tolist(), strict=True)), "at": at,
        "V1": finite(V1), "V2": finite(V2),
        "lower": KINDS[lower] if upper else None, "upper": KINDS[upper] if upper else None,
        "width": max(float(np.nan_to_num(wide[0, k])), 0.0), "growth_rate": finite(rate[0]), "V": float(V[0]),
    }  # fmt: skip


def _place(free: Free, x: Floats, *, vanishes: bool) -> str:
    low, high = free.box
    at = np.minimum(np.abs(x - low), np.abs(x - high)) <= 1e-6 * (high - low)
    limits = [f"limit of {name}" for name, there in zip(free.ends, at, strict=True) if there]
    limits += ["edge of the stable region" + SHRINKS] if vanishes else []
    return ", ".join(limits) or "interior"
