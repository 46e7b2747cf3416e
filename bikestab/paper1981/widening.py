"""Conclusion 2: whether less tilt and enough trail widen the interval of stable speeds."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Floats, characteristic_table
from bikestab.paper1981 import claims
from bikestab.paper1981.box import LAM, SIGMA, Range, V
from bikestab.paper1981.maps import DesignMap, unbounded_ranges, widths
from bikestab.region.lines import lowest_stable, stable_ranges
from bikestab.speeds import intervals_of

SIGMAS = (0.06, 0.08, 0.10, 0.11, 0.12, 0.13, 0.14, 0.15)
LAMS = (0.05, 0.10, 0.15, 0.20, 0.25, 0.30)
_TIE = 1e-9  # m/s: widths closer than that are equal


@dataclass(frozen=True)
class Trends:
    """How the width of the widest interval changes between neighbouring designs of a map.

    Shares of the steps that do not narrow it, the σ from which a smaller λ widens it to the end, and the
    design with the widest interval of all, of equally wide ones that with the largest λ.
    """

    designs: int
    larger_sigma_widens: float
    smaller_lam_widens: float
    sigma_from: float | None
    sigma_step: float
    reaches_zero: bool
    widest_lam: float | None
    widest_sigma: float | None
    widest_at_largest_lam: bool


@dataclass(frozen=True)
class Limits:
    """The smallest λ with a stable speed at the largest σ, and the smallest σ at the largest λ."""

    lam_min: float | None
    sigma_min: float | None


@dataclass(frozen=True)
class AlongLam:
    """Along λ at one σ: where speeds are stable, without upper limit, and the widest interval [m/s]."""

    sigma: float
    stable_lam: list[Range]
    unbounded_lam: list[Range]
    best_lam: float
    width: float
    width_at_largest_lam: float


@dataclass(frozen=True)
class AlongSigma:
    """Along σ at one λ: where speeds are stable, and the widest interval [m/s]."""

    lam: float
    stable_sigma: list[Range]
    best_sigma: float
    width: float


@dataclass(frozen=True)
class Lines:
    """Widths along lines of the box, up to the cap [m/s]."""

    cap: float
    at_sigma: list[AlongLam]
    at_lam: list[AlongSigma]


@dataclass(frozen=True)
class Widening(Trends):
    """The trends, where stability ends, and the widths along lines."""

    limits: Limits
    lines: Lines
    forwards: Trends


def widening(bicycle: Bicycle, designs: DesignMap, steps: int) -> Widening:
    """The numbers behind conclusion 2; ``steps`` designs on each line."""
    return Widening(
        **vars(trends(designs, designs.widest)),
        limits=smallest_tilt(bicycle),
        lines=widths_along_lines(bicycle, steps),
        forwards=trends(designs, designs.widest_forwards),
    )


def trends(designs: DesignMap, W: Floats) -> Trends:
    """The trends of widths W on a map, 0 for designs that do not count.

    Two unbounded intervals are equally wide, and steps between them do not count.
    """
    best = len(W) - 1 - np.argmax(W[::-1], axis=0)  # of equally wide ones that with the largest tilt
    good = [W[k, j] > 0 and _falls(W[k:, j]) for j, k in enumerate(best.tolist())]
    last = int(np.flatnonzero(W.any(axis=0))[-1]) if W.any() else -1  # σ above it have no stable design
    first = next((j for j in range(last + 1) if all(good[j : last + 1])), None)
    i, j = np.unravel_index(W.size - 1 - np.argmax(W[::-1, ::-1]), W.shape)
    return Trends(
        designs=W.size,
        larger_sigma_widens=_share_not_narrowed(W[:, :-1], W[:, 1:]),
        smaller_lam_widens=_share_not_narrowed(W[1:], W[:-1]),
        sigma_from=None if first is None else float(designs.sigma[first]),
        sigma_step=float(designs.sigma[1] - designs.sigma[0]),
        reaches_zero=first is not None and bool(np.all(W[0, first:] >= W.max(axis=0)[first:])),
        widest_lam=float(designs.lam[i, 0]) if W.any() else None,
        widest_sigma=float(designs.sigma[j]) if W.any() else None,
        widest_at_largest_lam=bool(W.any() and i >= (1 - claims.THRESHOLDS["one_optimum"]) * len(W)),
    )


def _share_not_narrowed(before: Floats, after: Floats) -> float:
    """The share of steps between stable designs that do not narrow the interval."""
    counts = (before > 0) & (after > 0) & (np.isfinite(before) | np.isfinite(after))
    return float(np.mean(after[counts] >= before[counts] - _TIE)) if counts.any() else 0.0


def _falls(values: Floats) -> bool:
    return len(values) > 1 and bool(np.all(values[1:] <= values[:-1] + _TIE))


def smallest_tilt(bicycle: Bicycle) -> Limits:
    """Where the stable designs end at the largest σ and at the largest λ."""
    lam = float(lowest_stable(Family(bicycle), *LAM, y=SIGMA[1]))
    sigma = float(lowest_stable(Family(bicycle), *SIGMA, x=LAM[1]))
    return Limits(None if math.isnan(lam) else lam, None if math.isnan(sigma) else sigma)


def widths_along_lines(bicycle: Bicycle, steps: int) -> Lines:
    """Where along lines of constant σ and of constant λ there are stable speeds, and the widest interval."""
    lam, sigma = np.linspace(*LAM, steps), np.linspace(*SIGMA, steps)
    at_sigma = []
    for value, ranges in zip(SIGMAS, stable_ranges(Family(bicycle), *LAM, y=SIGMAS), strict=True):
        width = widest(bicycle, lam, value)
        best = int(np.argmax(width))
        at_sigma.append(
            AlongLam(
                value, ranges, unbounded_ranges(bicycle, value), float(lam[best]), float(width[best]),
                width_at_largest_lam=float(widest(bicycle, LAM[1], value)),
            )
        )  # fmt: skip
    at_lam = []
    for value, ranges in zip(LAMS, stable_ranges(Family(bicycle), *SIGMA, x=LAMS), strict=True):
        width = widest(bicycle, value, sigma)
        best = int(np.argmax(width))
        at_lam.append(AlongSigma(value, ranges, float(sigma[best]), float(width[best])))
    return Lines(V[1], at_sigma, at_lam)


def widest(bicycle: Bicycle, lam: ArrayLike, sigma: ArrayLike) -> Floats:
    """The width [m/s] of the widest interval of designs up to the paper's highest speed."""
    return np.asarray(widths(intervals_of(characteristic_table(bicycle, lam, sigma))).max(axis=-1))
