"""Conclusion 1: whether every design has one finite interval of stable speeds."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.paper1981.box import PAPER_BOX, DesignBox, Sampling
from bikestab.paper1981.forks import offset
from bikestab.paper1981.maps import DesignMap, Shares, box_curves, shares_along_lines
from bikestab.paper1981.one_design import Interval, eigenvalues, intervals
from bikestab.paper1981.random_machines import RandomMachines, study_random_machines

COUNTEREXAMPLES = ((0.05, 0.15), (0.08, 0.13), (0.11, 0.145))  # (λ, σ) between the two curves at infinity
FAR = (100.0, 1000.0)  # m/s
TWO = (0.04834835, 0.15)  # a design with two intervals


@dataclass(frozen=True)
class CountedShares:
    """Shares of a number of designs, counted one by one."""

    designs: int
    shares: Shares


@dataclass(frozen=True)
class CurveEnd:
    """Where a curve ends: a design, and the other curve or the edge of the box that it meets there."""

    lam: float
    sigma: float
    at: str


@dataclass(frozen=True)
class CurveAtInfinity:
    """One of the two curves between which there is no upper limit."""

    name: str
    start: CurveEnd = field(metadata={"key": "from"})
    stop: CurveEnd = field(metadata={"key": "to"})


@dataclass(frozen=True)
class Counterexample:
    """A design without upper limit: eigenvalues [1/s] by speed [m/s], and 1/decay [s] of the slowest.

    ``offset`` [m] is the fork offset b.
    """

    lam: float
    sigma: float
    offset: float
    intervals: list[Interval]
    eigenvalues: dict[str, list[list[float]]]
    speeds: list[float]
    stable_far_up: bool
    time_constants: list[float | None]


@dataclass(frozen=True)
class DesignIntervals:
    """A design and its stable intervals."""

    lam: float
    sigma: float
    intervals: list[Interval]


@dataclass(frozen=True)
class Exceptions:
    """The shares of designs with an unbounded interval or several: what the verdict is drawn from."""

    in_box: float
    beyond: float


@dataclass(frozen=True)
class NoUpperLimit:
    """Above which line in (tan λ, σ) there can be no upper limit, and below which the fork is bent forwards.

    The first is the curve "capsize at infinity", σ = least + slope tan λ, the other σ = slope_forwards tan λ.
    ``apart`` says that no λ >= 0 is between them.
    """

    least: float
    slope: float
    slope_forwards: float
    apart: bool


@dataclass(frozen=True)
class Forwards:
    """The same shares among designs whose fork is bent forwards, and how many these are."""

    shares: Shares
    shares_wider_box: Shares
    of_designs: float
    of_stable: float | None
    line: NoUpperLimit
    judged_by: Exceptions


@dataclass(frozen=True)
class FiniteInterval:
    """How many designs have bounded, unbounded, several or no intervals, with counterexamples."""

    shares: Shares
    shares_wider_box: Shares
    wider_box: DesignBox
    shares_uncertainty: float
    unbounded_of_stable: float | None
    bounded_of_stable: float | None
    grid: CountedShares
    formula_disagreements: int
    curves_at_infinity: list[CurveAtInfinity]
    counterexamples: list[Counterexample]
    two_intervals: DesignIntervals
    random_machines: RandomMachines
    judged_by: Exceptions
    forwards: Forwards


def finite_interval(bicycle: Bicycle, designs: DesignMap, sampling: Sampling) -> FiniteInterval:
    """The numbers behind conclusion 1; ``designs`` is the map of the paper's box."""
    box, box_forwards, of_designs = shares_along_lines(bicycle, sampling.lines)
    wider, wider_forwards, _ = shares_along_lines(bicycle, sampling.lines, PAPER_BOX.wider)
    coarser, _, _ = shares_along_lines(bicycle, sampling.lines // 2)
    return FiniteInterval(
        shares=box,
        shares_wider_box=wider,
        wider_box=PAPER_BOX.wider,
        shares_uncertainty=max(
            abs(share - other) for share, other in zip(_values(box), _values(coarser), strict=True)
        ),
        unbounded_of_stable=box.unbounded / box.some if box.some else None,
        bounded_of_stable=box.finite / box.some if box.some else None,
        grid=CountedShares(designs.number.size, designs.shares),
        formula_disagreements=int(np.count_nonzero(designs.formula != designs.unbounded)),
        curves_at_infinity=_curves_at_infinity(bicycle, sampling.picture),
        counterexamples=[_counterexample(bicycle, *design) for design in COUNTEREXAMPLES],
        two_intervals=DesignIntervals(*TWO, intervals(bicycle, *TWO)),
        random_machines=study_random_machines(sampling),
        judged_by=exceptions(box, wider),
        forwards=Forwards(
            box_forwards, wider_forwards, of_designs,
            of_stable=box_forwards.some * of_designs / box.some if box.some else None,
            line=no_upper_limit(bicycle),
            judged_by=exceptions(box_forwards, wider_forwards),
        ),
    )  # fmt: skip


def exceptions(box: Shares, wider: Shares) -> Exceptions:
    """The shares of designs that are not as conclusion 1 has them."""
    return Exceptions(box.unbounded + box.multiple, wider.unbounded + wider.multiple)


def no_upper_limit(bicycle: Bicycle) -> NoUpperLimit:
    """S > κ h sin λ with κ = C2°/(C1° + C2°), which −α7 > 0 is, in σ and tan λ; needs l > m2 c and wheels."""
    p = bicycle
    ahead, h = p.m1 * p.l1 + p.m2 * p.l2 - p.m2 * p.c, p.m1 * p.h1 + p.m2 * p.h2
    kappa = p.C2 / p.R2 / (p.C1 / p.R1 + p.C2 / p.R2)
    least, slope = (v / ahead for v in (p.m2 * (p.c - p.l2), kappa * h - p.m2 * p.h2))
    return NoUpperLimit(least, slope, p.R2 / p.c, apart=least >= 0 and slope >= p.R2 / p.c)


def _values(shares: Shares) -> tuple[float, ...]:
    return shares.none, shares.some, shares.finite, shares.unbounded, shares.multiple


def _counterexample(bicycle: Bicycle, lam: float, sigma: float) -> Counterexample:
    values = {f"{speed:g}": eigenvalues(bicycle, lam, sigma, speed) for speed in FAR}
    slowest = [values[f"{speed:g}"][0][0] for speed in FAR]
    return Counterexample(
        lam, sigma, float(offset(bicycle, lam, sigma)), intervals(bicycle, lam, sigma), values, list(FAR),
        stable_far_up=all(rate < 0 for rate in slowest),
        time_constants=[-1 / rate if rate < 0 else None for rate in slowest],
    )  # fmt: skip


def _curves_at_infinity(bicycle: Bicycle, samples: int) -> list[CurveAtInfinity]:
    return [
        CurveAtInfinity(
            curve.name,
            *(CurveEnd(float(curve.x[at]), float(curve.y[at]), curve.ends[at]) for at in (0, -1)),
        )
        for curve in box_curves(bicycle, samples)
        if curve.name.endswith("infinity")
    ]
