"""Where a design has no stable speed: the nearest designs that have one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypedDict

import numpy as np

from bikestab.family import Family
from bikestab.limits import MOST_SPEED
from bikestab.model import ExactTable, Floats
from bikestab.region.lines import stable_ranges
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of

LAM_RANGE, SIGMA_RANGE = (-0.2, 0.6), (-0.5, 0.5)  # rad, 1: what is searched, and on to the design
V_MAX = 50.0  # m/s, up to which the smallest growth rate is searched
_DECIMALS = 6, 17  # fewest and most of a rounded number


class Nearest(TypedDict):
    """What would help; None where nothing in the searched ranges does.

    ``sigma_min`` and ``sigma_max`` are the nearest larger and the nearest smaller σ at this λ with a stable
    speed; ``lam_min`` … ``lam_max`` the nearest range of λ at this σ with one: each has a stable speed
    itself, and next to it is one that has none, or the end of what is ``searched``.
    ``V`` [m/s] is the speed with the smallest growth rate [s⁻¹] up to V_MAX, None where an
    eigenvalue is infinite (p4 = 0).
    """

    sigma_min: float | None
    sigma_max: float | None
    lam_min: float | None
    lam_max: float | None
    V: float | None
    growth_rate: float | None


def searched(lam: float, sigma: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """The ranges of λ and σ that are searched for a design: the usual ones, or on to the design."""
    (low, high), (least, most) = LAM_RANGE, SIGMA_RANGE
    return (min(low, lam), max(high, lam)), (min(least, sigma), max(most, sigma))


def nearest_stable(family: Family, lam: float, sigma: float) -> Nearest:
    """What is nearest to stability around a design (λ [rad], σ [1]) that has no stable speed.

    ``family`` is one over lam and sigma. Stable speeds that all are above MOST_SPEED are none here.
    """
    lam_range, sigma_range = searched(lam, sigma)
    (sigmas,) = stable_ranges(family, *sigma_range, x=lam, among=sigma, begun_by=MOST_SPEED)
    (lams,) = stable_ranges(family, *lam_range, y=sigma, among=lam, begun_by=MOST_SPEED)
    close = min(lams, key=lambda ends: min(abs(end - lam) for end in ends), default=None)
    table = family.table(lam, sigma)
    V, growth = _slowest(lambda V: growth_rate_of(table, V))
    finite = bool(np.isfinite(growth))
    return Nearest(
        sigma_min=min((start for start, _ in sigmas if start > sigma), default=None),
        sigma_max=max((stop for _, stop in sigmas if stop < sigma), default=None),
        lam_min=close[0] if close else None,
        lam_max=close[1] if close else None,
        V=V if finite else None,
        growth_rate=growth if finite else None,
    )


def rounded(table: Callable[[float], Floats | ExactTable], end: float, way: int) -> str:
    """An end of a stable range rounded upwards (``way`` = 1) or downwards (−1) to few decimals.

    To so many that what is written still has a stable speed, and can be typed in. ``table`` is of its value.
    """
    for decimals in range(*_DECIMALS):
        scale = 10.0**decimals
        text = f"{way * np.ceil(way * end * scale) / scale + 0.0:.{decimals}f}"  # no minus before zero
        if (intervals_of(table(float(text))).V1 <= MOST_SPEED).any():
            return text
    return repr(end)


def _slowest(growth: Callable[[Floats], Floats]) -> tuple[float, float]:
    low, high = 0.0, V_MAX
    while True:
        V = np.linspace(low, high, 501)
        rate = growth(V)
        best = int(np.argmin(rate))
        if high - low < 1e-6:
            return float(V[best]), float(rate[best])
        low, high = V[max(best - 1, 0)], V[min(best + 1, 500)]
