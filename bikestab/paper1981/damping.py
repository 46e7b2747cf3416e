"""Conclusion 4: what viscous damping of the steering does to the boundaries."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import Floats
from bikestab.paper1981 import claims
from bikestab.paper1981.box import PAPER_BOX, DesignBox
from bikestab.paper1981.damped_designs import DampedDesign, relative, single_designs
from bikestab.paper1981.damped_region import (
    Choice,
    Region,
    choices,
    exact_sigma_min,
    fold_lams,
    regions,
    sampled_sigma_min,
)  # fmt: skip

DELTAS = tuple(float(f"{delta:.4g}") for delta in np.logspace(-3, 1, 21))  # kg m²/s
FEW = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 10.0)
SHOWN = (0.001, 0.01, 0.1, 1.0, 10.0)  # in the report's tables


class Measures(NamedTuple):
    """What is followed against δ, of all designs or of those whose fork is bent forwards."""

    volume: float
    V1: Floats  # of each design, NaN where the first interval does not start with weave
    sigma_min: list[float | None]  # at each λ of FOLDS


@dataclass(frozen=True)
class Change:
    """With damping δ [kg m²/s]: the region's volume [rad m/s], and changes relative to δ = 0."""

    delta: float
    volume: float
    volume_change: float | None
    V1_change_median: float | None
    V1_change_largest: float | None
    sigma_min: list[float | None]
    sigma_min_change: list[float | None]


@dataclass(frozen=True)
class Sweep:
    """The changes at every δ; from which δ [kg m²/s] each measure is marked, by what counts as marked.

    ``marked_from`` is the lowest of them by the threshold of the verdict: what it is drawn from.
    """

    volume: float
    sigma_min: list[float | None]
    changes: list[Change]
    marked_by_measure: dict[str, dict[str, float | None]]
    verdict_by_measure: dict[str, claims.Verdict]
    marked_from: float | None


@dataclass(frozen=True)
class Damping:
    """How the region and its smallest trail change with δ [kg m²/s].

    Of all designs and of those with forks bent forwards; also how far p0 changes, and how many designs
    change in having an upper limit.
    """

    designs: int
    deltas: list[float]
    shown: list[float]
    folds_at_lam: list[float]
    p0_change: float
    unbounded_changed: int
    everywhere: Sweep
    forwards: Sweep
    single_designs: list[DampedDesign]


def damping(bicycle: Bicycle, n: int, deltas: tuple[float, ...] = DELTAS) -> Damping:
    """The numbers behind conclusion 4, from n × n designs."""
    box = PAPER_BOX
    bicycles = [bicycle.with_delta(delta) for delta in (0.0, *deltas)]
    still, *damped = regions(bicycles, n, box, exact_sigma_min)
    everywhere, forwards = (_sweep(deltas, still, damped, among, box) for among in choices(bicycle, n, box))
    return Damping(
        designs=n * n,
        deltas=list(deltas),
        shown=[delta for delta in SHOWN if delta in deltas],
        folds_at_lam=fold_lams(box).tolist(),
        p0_change=max(float(np.abs(region.p0 - still.p0).max()) for region in damped),
        unbounded_changed=max(int(np.count_nonzero(r.unbounded != still.unbounded)) for r in damped),
        everywhere=everywhere,
        forwards=forwards,
        single_designs=single_designs(bicycle, deltas),
    )


def marked_from_each(
    bicycles: Sequence[Bicycle], n: int, box: DesignBox = PAPER_BOX, deltas: tuple[float, ...] = FEW
) -> list[tuple[float | None, float | None]]:
    """The lowest δ [kg m²/s] from which any measure is marked, of all designs and of forks bent forwards.

    None if none is. For each bicycle, from n × n designs; smallest trails are found by sampling.
    """
    among = [choices(bicycle, n, box) for bicycle in bicycles]
    still = regions([bicycle.with_delta(0.0) for bicycle in bicycles], n, box, sampled_sigma_min)
    damped: list[list[Region]] = [[] for _ in bicycles]
    marked: list[tuple[float | None, float | None]] = [(None, None)] * len(bicycles)
    for number, delta in enumerate(deltas, 1):
        left = [i for i, found in enumerate(marked) if None in found]  # a larger δ changes nothing else
        bicycles_left = [bicycles[i].with_delta(delta) for i in left]
        for i, region in zip(left, regions(bicycles_left, n, box, sampled_sigma_min), strict=True):
            damped[i].append(region)
            whole, forwards = (
                _sweep(deltas[:number], still[i], damped[i], a, box).marked_from for a in among[i]
            )
            marked[i] = whole, forwards
    return marked


def _measures(region: Region, among: Choice, box: DesignBox) -> Measures:
    sigma_min = [
        sigma if sigma is not None and among.design(lam, sigma) else None
        for lam, sigma in zip(fold_lams(box).tolist(), region.sigma_min, strict=True)
    ]
    share = region.width[among.grid].sum() / region.width.size
    return Measures(float(share) * box.area, region.V1[among.grid], sigma_min)


def _sweep(
    deltas: tuple[float, ...], still: Region, damped: list[Region], among: Choice, box: DesignBox
) -> Sweep:
    """What is followed of the chosen designs."""
    without, *rest = (_measures(region, among, box) for region in (still, *damped))
    changes = [_change(delta, here, without) for delta, here in zip(deltas, rest, strict=True)]
    measures = {
        "volume of the stable region": [change.volume_change for change in changes],
        "V1, median over designs": [change.V1_change_median for change in changes],
    }
    for i, lam in enumerate(fold_lams(box).tolist()):
        measures[f"smallest stable σ at λ = {lam:g}"] = [change.sigma_min_change[i] for change in changes]
    measures = {name: values for name, values in measures.items() if values[0] is not None}
    marked = {
        name: {key: claims.first_marked(deltas, values, claims.THRESHOLDS[key]) for key in claims.MARKED}
        for name, values in measures.items()
    }
    lowest = {name: by["marked"] for name, by in marked.items()}
    return Sweep(
        without.volume, without.sigma_min, changes, marked,
        verdict_by_measure={name: claims.judge_damping(delta) for name, delta in lowest.items()},
        marked_from=min((delta for delta in lowest.values() if delta is not None), default=None),
    )  # fmt: skip


def _change(delta: float, damped: Measures, still: Measures) -> Change:
    moved = np.abs(damped.V1 / still.V1 - 1)
    moved = moved[np.isfinite(moved)]
    return Change(
        delta=delta,
        volume=damped.volume,
        volume_change=relative(damped.volume, still.volume),
        V1_change_median=float(np.median(moved)) if moved.size else None,
        V1_change_largest=float(moved.max()) if moved.size else None,
        sigma_min=damped.sigma_min,
        sigma_min_change=[
            relative(now, before) for now, before in zip(damped.sigma_min, still.sigma_min, strict=True)
        ],
    )
