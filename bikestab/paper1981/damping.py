"""Conclusion 4: what viscous damping of the steering does to the boundaries."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Floats, characteristic_table
from bikestab.paper1981 import claims
from bikestab.paper1981.box import PAPER_BOX, DesignBox, middles
from bikestab.paper1981.damped_designs import DampedDesign, relative, single_designs
from bikestab.paper1981.forks import bent_forwards
from bikestab.paper1981.maps import Flags, has_unbounded, widths
from bikestab.region.lines import lowest_stable
from bikestab.speeds import WEAVE, intervals_of

DELTAS = tuple(float(f"{delta:.4g}") for delta in np.logspace(-3, 1, 21))  # kg m²/s
FEW = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 10.0)
SHOWN = (0.001, 0.01, 0.1, 1.0, 10.0)  # in the report's tables
FOLDS = (1 / 3, 2 / 3, 1.0)  # of the largest λ: where the smallest stable σ is followed
_ROUNDS, _SAMPLES = 4, 60  # of sampling a line for its smallest stable σ


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


class _Region(NamedTuple):
    """The stable region of a grid of designs."""

    p0: Floats
    width: Floats
    V1: Floats
    unbounded: Flags
    sigma_min: list[float | None]


def damping(bicycle: Bicycle, n: int, deltas: tuple[float, ...] = DELTAS) -> Damping:
    """The numbers behind conclusion 4, from n × n designs."""
    box = PAPER_BOX
    smallest = partial(_exact_sigma_min, box=box)
    still, *damped = (_region(bicycle.with_delta(delta), n, box, smallest) for delta in (0.0, *deltas))
    everywhere, forwards = (_sweep(deltas, still, damped, among, box) for among in _choices(bicycle, n, box))
    return Damping(
        designs=n * n,
        deltas=list(deltas),
        shown=[delta for delta in SHOWN if delta in deltas],
        folds_at_lam=_fold_lams(box).tolist(),
        p0_change=max(float(np.abs(region.p0 - still.p0).max()) for region in damped),
        unbounded_changed=max(int(np.count_nonzero(r.unbounded != still.unbounded)) for r in damped),
        everywhere=everywhere,
        forwards=forwards,
        single_designs=single_designs(bicycle, deltas),
    )


def marked_from(
    bicycle: Bicycle, n: int, box: DesignBox = PAPER_BOX, deltas: tuple[float, ...] = FEW
) -> tuple[float | None, float | None]:
    """The lowest δ [kg m²/s] from which any measure is marked, of all designs and of forks bent forwards.

    None if none is. From n × n designs; smallest trails are found by sampling.
    """
    smallest = partial(_sampled_sigma_min, box=box)
    choices = _choices(bicycle, n, box)
    still = _region(bicycle.with_delta(0.0), n, box, smallest)
    damped: list[_Region] = []
    marked: list[float | None] = [None, None]
    while None in marked and len(damped) < len(deltas):  # a larger δ changes nothing where one is marked
        damped.append(_region(bicycle.with_delta(deltas[len(damped)]), n, box, smallest))
        here = deltas[: len(damped)]
        marked = [_sweep(here, still, damped, among, box).marked_from for among in choices]
    return marked[0], marked[1]


def _fold_lams(box: DesignBox) -> Floats:
    return np.array(FOLDS) * box.lam[1]


class _Choice(NamedTuple):
    """Which designs of the grid, and which (λ, σ) in general, are looked at."""

    grid: Flags
    design: Callable[[float, float], bool]


def _choices(bicycle: Bicycle, n: int, box: DesignBox) -> tuple[_Choice, _Choice]:
    x, y = middles(box.lam, n)[:, np.newaxis], middles(box.sigma, n)
    forwards = bent_forwards(bicycle, x, y)
    return (
        _Choice(np.ones_like(forwards), lambda lam, sigma: True),
        _Choice(forwards, lambda lam, sigma: bool(bent_forwards(bicycle, lam, sigma))),
    )


Smallest = Callable[[Bicycle], list[float]]


def _region(bicycle: Bicycle, n: int, box: DesignBox, smallest: Smallest) -> _Region:
    table = characteristic_table(bicycle, middles(box.lam, n)[:, np.newaxis], middles(box.sigma, n))
    intervals = intervals_of(table)
    weave = intervals.lower[..., 0] == WEAVE
    return _Region(
        p0=table[0],
        width=widths(intervals).sum(axis=-1),
        V1=np.where(weave, intervals.V1[..., 0], np.nan),
        unbounded=has_unbounded(intervals),
        sigma_min=[None if np.isnan(sigma) else sigma for sigma in smallest(bicycle)],
    )


def _exact_sigma_min(bicycle: Bicycle, box: DesignBox) -> list[float]:
    """The smallest σ with a stable speed at each λ of FOLDS, NaN where there is none."""
    return lowest_stable(Family(bicycle), *box.sigma, x=_fold_lams(box)).tolist()


def _sampled_sigma_min(bicycle: Bicycle, box: DesignBox) -> list[float]:
    """As ``_exact_sigma_min``, to 1e-6 of the range, where the stable σ are no less than 1/60 of it."""
    lam = _fold_lams(box)[:, np.newaxis]
    low, high = (np.full(lam.shape, end) for end in box.sigma)
    for _ in range(_ROUNDS):
        sigma = low + (high - low) * np.linspace(0, 1, _SAMPLES)
        stable = intervals_of(characteristic_table(bicycle, lam, sigma)).number > 0
        first = np.argmax(stable, axis=1)[:, np.newaxis]
        low, high = (np.take_along_axis(sigma, at, axis=1) for at in (np.maximum(first - 1, 0), first))
        low, high = (np.where(stable.any(axis=1, keepdims=True), end, np.nan) for end in (low, high))
    return high[:, 0].tolist()


def _measures(region: _Region, among: _Choice, box: DesignBox) -> Measures:
    sigma_min = [
        sigma if sigma is not None and among.design(lam, sigma) else None
        for lam, sigma in zip(_fold_lams(box).tolist(), region.sigma_min, strict=True)
    ]
    share = region.width[among.grid].sum() / region.width.size
    return Measures(float(share) * box.area, region.V1[among.grid], sigma_min)


def _sweep(
    deltas: tuple[float, ...], still: _Region, damped: list[_Region], among: _Choice, box: DesignBox
) -> Sweep:
    """What is followed of the chosen designs."""
    without, *rest = (_measures(region, among, box) for region in (still, *damped))
    changes = [_change(delta, here, without) for delta, here in zip(deltas, rest, strict=True)]
    measures = {
        "volume of the stable region": [change.volume_change for change in changes],
        "V1, median over designs": [change.V1_change_median for change in changes],
    }
    for i, lam in enumerate(_fold_lams(box).tolist()):
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
