"""Where a design has no stable speed: the nearest designs that have one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypedDict

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import Floats, Model, characteristic_table
from bikestab.spectrum import growth_rate
from bikestab.speeds import stable_intervals

LAM_RANGE, SIGMA_RANGE = (0.0, 0.6), (0.0, 0.5)  # rad, 1: what is searched
V_MAX = 50.0  # m/s, up to which the smallest growth rate is searched
_SAMPLES = 1201


class Nearest(TypedDict):
    """What would help; None where nothing in the searched ranges does.

    ``sigma_min`` is the smallest larger σ at this λ with a stable speed; ``lam_min`` … ``lam_max`` the
    nearest λ at this σ with one; ``V`` [m/s] the speed with the smallest growth rate [s⁻¹] up to V_MAX,
    None where an eigenvalue is infinite (p4 = 0).
    """

    sigma_min: float | None
    lam_min: float | None
    lam_max: float | None
    V: float | None
    growth_rate: float | None


def nearest_stable(bicycle: Bicycle, lam: float, sigma: float, *, model: Model = "refined") -> Nearest:
    """What is nearest to stability around a design (λ [rad], σ [1]) that has no stable speed."""

    def at_sigma(values: Floats) -> np.ndarray:
        return stable_intervals(characteristic_table(bicycle, lam, values, model=model)).number > 0

    def at_lam(values: Floats) -> np.ndarray:
        return stable_intervals(characteristic_table(bicycle, values, sigma, model=model)).number > 0

    larger = np.linspace(max(sigma, SIGMA_RANGE[0]), max(sigma, SIGMA_RANGE[1]), _SAMPLES)
    sigmas = _ranges(at_sigma, larger)
    lams = _ranges(at_lam, np.linspace(*LAM_RANGE, _SAMPLES))
    close = min(lams, key=lambda ends: min(abs(end - lam) for end in ends), default=(None, None))
    V, growth = _slowest(lambda V: growth_rate(characteristic_table(bicycle, lam, sigma, model=model), V))
    finite = bool(np.isfinite(growth))
    return Nearest(
        sigma_min=sigmas[0][0] if sigmas else None,
        lam_min=close[0],
        lam_max=close[1],
        V=V if finite else None,
        growth_rate=growth if finite else None,
    )


def _ranges(holds: Callable[[Floats], np.ndarray], samples: Floats) -> list[tuple[float, float]]:
    """The ranges of samples for which something holds, their ends (inside) refined to rounding."""
    good = holds(samples)
    starts = np.flatnonzero(good & ~np.concatenate([[False], good[:-1]]))
    ends = np.flatnonzero(good & ~np.concatenate([good[1:], [False]]))
    return [
        (
            _edge(holds, samples[i - 1], samples[i]) if i else float(samples[0]),
            _edge(holds, samples[j + 1], samples[j]) if j + 1 < len(samples) else float(samples[-1]),
        )
        for i, j in zip(starts, ends, strict=True)
    ]


def _edge(holds: Callable[[Floats], np.ndarray], bad: float, good: float) -> float:
    """The value nearest to ``bad`` for which it holds, by repeated division into 64."""
    while abs(good - bad) > 1e-14 * max(abs(good), 1e-3):
        cuts = np.linspace(bad, good, 65)
        first = int(np.argmax(holds(cuts)))
        if first == 0:
            break
        bad, good = cuts[first - 1], cuts[first]
    return float(good)


def _slowest(growth: Callable[[Floats], Floats]) -> tuple[float, float]:
    low, high = 0.0, V_MAX
    while True:
        V = np.linspace(low, high, 501)
        rate = growth(V)
        best = int(np.argmin(rate))
        if high - low < 1e-6:
            return float(V[best]), float(rate[best])
        low, high = V[max(best - 1, 0)], V[min(best + 1, 500)]
