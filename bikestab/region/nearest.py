"""Where a design has no stable speed: the nearest designs that have one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypedDict

import numpy as np

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.region.lines import stable_ranges
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of

LAM_RANGE, SIGMA_RANGE = (0.0, 0.6), (0.0, 0.5)  # rad, 1: what is searched
V_MAX = 50.0  # m/s, up to which the smallest growth rate is searched


class Nearest(TypedDict):
    """What would help; None where nothing in the searched ranges does.

    ``sigma_min`` is the smallest larger σ at this λ with a stable speed; ``lam_min`` … ``lam_max`` the
    nearest range of λ at this σ with one: points of the exact skeleton, or ends of what is searched.
    ``V`` [m/s] is the speed with the smallest growth rate [s⁻¹] up to V_MAX, None where an
    eigenvalue is infinite (p4 = 0).
    """

    sigma_min: float | None
    lam_min: float | None
    lam_max: float | None
    V: float | None
    growth_rate: float | None


def nearest_stable(family: Family, lam: float, sigma: float) -> Nearest:
    """What is nearest to stability around a design (λ [rad], σ [1]) that has no stable speed."""
    low, high = (max(sigma, end) for end in SIGMA_RANGE)
    sigmas = stable_ranges(family, low, high, x=lam)[0] if low < high else []
    lams = stable_ranges(family, *LAM_RANGE, y=sigma)[0]
    close = min(lams, key=lambda ends: min(abs(end - lam) for end in ends), default=None)

    def at_sigma(values: Floats) -> Floats:
        return family.table(lam, values)

    def at_lam(values: Floats) -> Floats:
        return family.table(values, sigma)

    table = family.table(lam, sigma)
    V, growth = _slowest(lambda V: growth_rate_of(table, V))
    finite = bool(np.isfinite(growth))
    return Nearest(
        sigma_min=_inside(at_sigma, *sigmas[0]) if sigmas else None,
        lam_min=_inside(at_lam, *close) if close else None,
        lam_max=_inside(at_lam, *close[::-1]) if close else None,
        V=V if finite else None,
        growth_rate=growth if finite else None,
    )


def _inside(table: Callable[[Floats], Floats], end: float, other: float) -> float:
    """The end of a stable range moved by rounding's share, so that it has a stable speed itself."""
    steps = np.concatenate([[0.0], 2.0 ** np.arange(-54, -34)]) * max(abs(end), 1e-3)
    values = end + np.copysign(steps, other - end)
    some = intervals_of(table(values)).number > 0
    return float(values[np.argmax(some)])


def _slowest(growth: Callable[[Floats], Floats]) -> tuple[float, float]:
    low, high = 0.0, V_MAX
    while True:
        V = np.linspace(low, high, 501)
        rate = growth(V)
        best = int(np.argmin(rate))
        if high - low < 1e-6:
            return float(V[best]), float(rate[best])
        low, high = V[max(best - 1, 0)], V[min(best + 1, 500)]
