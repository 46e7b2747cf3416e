"""Conclusion 1: whether every design has one finite interval of stable speeds."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.paper1981.box import LAM, SIGMA, WIDER_LAM, WIDER_SIGMA, Range, Sampling
from bikestab.paper1981.maps import DesignMap, Shares, shares_along_lines
from bikestab.paper1981.one_design import Interval, eigenvalues, intervals
from bikestab.paper1981.random_machines import RandomMachines, study_random_machines
from bikestab.region.curves import trace

COUNTEREXAMPLES = ((0.05, 0.15), (0.08, 0.13), (0.11, 0.145))  # (λ, σ) between the two curves at infinity
FAR = (100.0, 1000.0)  # m/s
TWO = (0.04834835, 0.15)  # a design with two intervals


@dataclass(frozen=True)
class Box:
    """Ranges of λ [rad] and σ."""

    lam: Range
    sigma: Range


@dataclass(frozen=True)
class CountedShares:
    """Shares of a number of designs, counted one by one."""

    designs: int
    none: float
    some: float
    finite: float
    unbounded: float
    multiple: float


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
    """A design without upper limit: eigenvalues [1/s] by speed [m/s], and 1/decay [s] of the slowest."""

    lam: float
    sigma: float
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
class FiniteInterval:
    """How many designs have bounded, unbounded, several or no intervals, with counterexamples."""

    shares: Shares
    shares_wider_box: Shares
    wider_box: Box
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


def finite_interval(bicycle: Bicycle, designs: DesignMap, sampling: Sampling) -> FiniteInterval:
    """The numbers behind conclusion 1; ``designs`` is the map of the paper's box."""
    box = shares_along_lines(bicycle, sampling.lines)
    wider = shares_along_lines(bicycle, sampling.lines, lam=WIDER_LAM, sigma=WIDER_SIGMA)
    coarser = shares_along_lines(bicycle, sampling.lines // 2)
    return FiniteInterval(
        shares=box,
        shares_wider_box=wider,
        wider_box=Box(WIDER_LAM, WIDER_SIGMA),
        shares_uncertainty=max(
            abs(share - other) for share, other in zip(_values(box), _values(coarser), strict=True)
        ),
        unbounded_of_stable=box.unbounded / box.some if box.some else None,
        bounded_of_stable=box.finite / box.some if box.some else None,
        grid=CountedShares(designs.number.size, *_values(designs.shares)),
        formula_disagreements=int(np.count_nonzero(designs.formula != designs.unbounded)),
        curves_at_infinity=_curves_at_infinity(bicycle, sampling.picture),
        counterexamples=[_counterexample(bicycle, *design) for design in COUNTEREXAMPLES],
        two_intervals=DesignIntervals(*TWO, intervals(bicycle, *TWO)),
        random_machines=study_random_machines(sampling),
        judged_by=Exceptions(box.unbounded + box.multiple, wider.unbounded + wider.multiple),
    )


def _values(shares: Shares) -> tuple[float, ...]:
    return shares.none, shares.some, shares.finite, shares.unbounded, shares.multiple


def _counterexample(bicycle: Bicycle, lam: float, sigma: float) -> Counterexample:
    values = {f"{speed:g}": eigenvalues(bicycle, lam, sigma, speed) for speed in FAR}
    slowest = [values[f"{speed:g}"][0][0] for speed in FAR]
    return Counterexample(
        lam, sigma, intervals(bicycle, lam, sigma), values, list(FAR),
        stable_far_up=all(rate < 0 for rate in slowest),
        time_constants=[-1 / rate if rate < 0 else None for rate in slowest],
    )  # fmt: skip


def _curves_at_infinity(bicycle: Bicycle, samples: int) -> list[CurveAtInfinity]:
    return [
        CurveAtInfinity(
            curve.name,
            *(CurveEnd(float(curve.x[at]), float(curve.y[at]), curve.ends[at]) for at in (0, -1)),
        )
        for curve in trace(Family(bicycle), LAM, SIGMA, samples=samples)
        if curve.name.endswith("infinity")
    ]
