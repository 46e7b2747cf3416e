"""Conclusion 4: what viscous damping of the steering does to the boundaries."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Floats, characteristic_table, coefficients
from bikestab.paper1981 import claims
from bikestab.paper1981.box import LAM, SIGMA, middles
from bikestab.paper1981.maps import Flags, has_unbounded, widths
from bikestab.region.lines import lowest_stable
from bikestab.speeds import CAPSIZE, WEAVE, intervals_of

DESIGNS = ((0.20, 0.08), (0.30, 0.10), (0.05, 0.15), (0.12, 0.12))  # (λ, σ), stable without damping
UNSTABLE = (0.10, 0.08)  # without damping
FOLDS = (0.10, 0.20, 0.30)  # λ [rad] at which the smallest stable σ is followed
DELTAS = tuple(float(f"{delta:.4g}") for delta in np.logspace(-3, 1, 21))  # kg m²/s
SHOWN = (0.001, 0.01, 0.1, 1.0, 10.0)  # in the report's tables
FEW = (0.01, 0.03, 0.1, 1.0, 10.0)


@dataclass(frozen=True)
class Undamped:
    """The region without damping: its volume [rad m/s] and the smallest stable σ at each λ of FOLDS."""

    volume: float
    sigma_min: list[float | None]


@dataclass(frozen=True)
class Damped:
    """The region with damping δ [kg m²/s], and its changes relative to δ = 0."""

    delta: float
    volume: float
    volume_change: float | None
    V1_change_median: float | None
    V1_change_largest: float | None
    sigma_min: list[float | None]
    sigma_min_change: list[float | None]
    p0_change: float
    unbounded_changed: int


@dataclass(frozen=True)
class Ends:
    """The first stable interval of a design [m/s]; without an upper limit V2 is None, without speeds both."""

    V1: float | None
    V2: float | None
    capsize: bool


@dataclass(frozen=True)
class DampedEnds:
    """The first stable interval of a design with damping δ [kg m²/s]."""

    delta: float
    V1: float | None
    V2: float | None
    capsize: bool


@dataclass(frozen=True)
class DampedDesign:
    """A design's interval against δ, and the δ [kg m²/s] that equals b1° V1/c."""

    lam: float
    sigma: float
    without: Ends
    sweep: list[DampedEnds]
    marked_from: float | None
    stable_from: float | None
    kinematic_damping: float | None


@dataclass(frozen=True)
class MarkedFrom:
    """The lowest δ [kg m²/s] from which any measure has moved markedly: what the verdict is drawn from."""

    marked_from: float | None


@dataclass(frozen=True)
class Damping:
    """How the region, its smallest trail and single designs change with δ [kg m²/s].

    ``marked_from`` names, for each measure, the δ from which it is marked.
    """

    designs: int
    marked: float
    bearings: float
    verdict_by_measure: dict[str, claims.Verdict]
    deltas: list[float]
    without: Undamped
    range: tuple[float, float]
    shown: list[float]
    p0_change: float
    unbounded_changed: int
    folds_at_lam: list[float]
    sweep: list[Damped]
    marked_from: dict[str, float | None]
    judged_by: MarkedFrom
    single_designs: list[DampedDesign]


def damping(bicycle: Bicycle, n: int, deltas: tuple[float, ...] = DELTAS) -> Damping:
    """The numbers behind conclusion 4, from n × n designs."""
    still, rows = _sweep(bicycle, n, deltas)
    marked = _marked_from(deltas, rows)
    return Damping(
        designs=n * n,
        marked=claims.THRESHOLDS["marked"],
        bearings=claims.THRESHOLDS["bearings"],
        verdict_by_measure={name: claims.judge_damping(delta) for name, delta in marked.items()},
        deltas=list(deltas),
        without=Undamped(still.volume, still.sigma_min),
        range=(deltas[0], deltas[-1]),
        shown=[delta for delta in SHOWN if delta in deltas],
        p0_change=max(row.p0_change for row in rows),
        unbounded_changed=max(row.unbounded_changed for row in rows),
        folds_at_lam=list(FOLDS),
        sweep=rows,
        marked_from=marked,
        judged_by=MarkedFrom(_lowest(marked)),
        single_designs=single_designs(bicycle, deltas),
    )


def marked_from(bicycle: Bicycle, n: int, deltas: tuple[float, ...] = FEW) -> float | None:
    """The lowest δ [kg m²/s] from which any measure of n × n designs is marked; None if none is."""
    return _lowest(_marked_from(deltas, _sweep(bicycle, n, deltas)[1]))


def single_designs(bicycle: Bicycle, deltas: tuple[float, ...] = DELTAS) -> list[DampedDesign]:
    """V1 and V2 [m/s] of the first interval of single designs against δ, and the δ that equals b1° V/c."""
    return [_single_design(bicycle, lam, sigma, deltas) for lam, sigma in (*DESIGNS, UNSTABLE)]


def _single_design(bicycle: Bicycle, lam: float, sigma: float, deltas: tuple[float, ...]) -> DampedDesign:
    without = _ends(bicycle.with_delta(0.0), lam, sigma)
    sweep = [DampedEnds(delta, **vars(_ends(bicycle.with_delta(delta), lam, sigma))) for delta in deltas]
    changes = [_relative(row.V1, without.V1) for row in sweep]
    b1 = float(coefficients(bicycle, lam, sigma).b1.value)
    return DampedDesign(
        lam=lam,
        sigma=sigma,
        without=without,
        sweep=sweep,
        marked_from=claims.first_marked(list(deltas), changes) if without.V1 else None,
        stable_from=next((row.delta for row in sweep if row.V1 is not None), None),
        kinematic_damping=b1 * without.V1 / bicycle.c if without.V1 else None,
    )


def _ends(bicycle: Bicycle, lam: float, sigma: float) -> Ends:
    intervals = intervals_of(characteristic_table(bicycle, lam, sigma))
    if not intervals.upper[0]:
        return Ends(None, None, capsize=False)
    V1, V2 = float(intervals.V1[0]), float(intervals.V2[0])
    return Ends(V1, V2 if np.isfinite(V2) else None, capsize=bool(intervals.upper[0] == CAPSIZE))


class _Region(NamedTuple):
    """The stable region of a grid of designs, with its smallest trails and its lower ends."""

    p0: Floats
    volume: float
    weave: Flags  # whether the first interval starts with weave
    V1: Floats
    unbounded: Flags
    sigma_min: list[float | None]


def _sweep(bicycle: Bicycle, n: int, deltas: tuple[float, ...]) -> tuple[_Region, list[Damped]]:
    """The region of n × n designs without damping, and what each δ changes."""
    still = _region(bicycle.with_delta(0.0), n)
    return still, [_compared(_region(bicycle.with_delta(delta), n), still, delta) for delta in deltas]


def _region(bicycle: Bicycle, n: int) -> _Region:
    table = characteristic_table(bicycle, middles(LAM, n)[:, np.newaxis], middles(SIGMA, n))
    intervals = intervals_of(table)
    volume = float(widths(intervals).sum(axis=-1).mean()) * (LAM[1] - LAM[0]) * (SIGMA[1] - SIGMA[0])
    folds = lowest_stable(Family(bicycle), *SIGMA, x=FOLDS).tolist()
    return _Region(
        table[0], volume, intervals.lower[..., 0] == WEAVE, intervals.V1[..., 0], has_unbounded(intervals),
        [None if np.isnan(fold) else fold for fold in folds],
    )  # fmt: skip


def _compared(damped: _Region, still: _Region, delta: float) -> Damped:
    both = still.weave & damped.weave
    moved = np.abs(damped.V1[both] / still.V1[both] - 1)
    return Damped(
        delta=delta,
        volume=damped.volume,
        volume_change=_relative(damped.volume, still.volume),
        V1_change_median=float(np.median(moved)) if moved.size else None,
        V1_change_largest=float(moved.max()) if moved.size else None,
        sigma_min=damped.sigma_min,
        sigma_min_change=[
            _relative(now, before) for now, before in zip(damped.sigma_min, still.sigma_min, strict=True)
        ],
        p0_change=float(np.abs(damped.p0 - still.p0).max()),
        unbounded_changed=int(np.count_nonzero(damped.unbounded != still.unbounded)),
    )


def _relative(now: float | None, before: float | None) -> float | None:
    return None if not now or not before else now / before - 1


def _marked_from(deltas: tuple[float, ...], rows: list[Damped]) -> dict[str, float | None]:
    measures = {
        "volume of the stable region": [row.volume_change for row in rows],
        "V1, median over designs": [row.V1_change_median for row in rows],
    }
    for i, lam in enumerate(FOLDS):
        measures[f"smallest stable σ at λ = {lam:g}"] = [row.sigma_min_change[i] for row in rows]
    usable = {name: changes for name, changes in measures.items() if changes[0] is not None}
    return {name: claims.first_marked(list(deltas), changes) for name, changes in usable.items()}


def _lowest(marked: dict[str, float | None]) -> float | None:
    return min((delta for delta in marked.values() if delta is not None), default=None)
