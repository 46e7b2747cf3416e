"""The paper's four conclusions as claims, and the rules that turn numbers into verdicts.

The rules know nothing of how the numbers came about, and their thresholds are in the report.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

Verdict = Literal["holds", "holds with limits", "does not hold"]
HOLDS: Verdict = "holds"
LIMITS: Verdict = "holds with limits"
FAILS: Verdict = "does not hold"
VERDICTS = (HOLDS, LIMITS, FAILS)

CLAIMS = {
    1: "Rectilinear motion of an uncontrolled bicycle is stable, for any relation of the physical "
    "parameters, only on one finite interval V1 < V < V2.",
    2: "The interval of stable speeds becomes the largest if the tilt λ is reduced while the trail σ is kept "
    "large enough.",
    3: "The boundaries let the designer of a given bicycle choose λ and σ for the greatest stability margin.",
    4: "Viscous damping δ of the steering does not markedly affect the boundaries.",
}
THRESHOLDS = {
    "nearly_all": 0.99,  # conclusion 2: of neighbouring designs, where the wider of two is as claimed
    "one_optimum": 0.1,  # of the box's sides; optima closer than that to each other or to an end are one
    "marked": 0.05,  # conclusion 4: relative change of a boundary
    "bearings": 0.34,  # kg m²/s: viscous friction that Moore (2012) measured in a steering's bearings
    "one_bearing": 0.17,  # kg m²/s: half of it, as he takes for one of its two sets of bearings
    "smallest": 0.02,  # conclusion 4: other changes that one might call marked
    "larger": 0.1,
    "largest": 0.2,
    "dampers": 10.0,  # kg m²/s: the highest δ tried
}
MARKED = ("smallest", "marked", "larger", "largest")  # of the thresholds: changes of a boundary
RULES = {
    1: "holds if no design has an unbounded interval or more than one; with limits if only designs outside "
    "the paper's box do; else it does not hold",
    2: "holds if a larger σ widens the interval and, from some σ on, so does a smaller λ down to λ = 0; with "
    "limits if it does so down to an optimum λ > 0 only; else, or if the widest interval of all is at the "
    "largest λ, to a tenth of the box's side, it does not hold",
    3: "holds if there are stable designs, and the widest interval and the fastest decay are found at one of "
    "them, to a tenth of the box's sides; with limits if at different ones; does not hold without stable "
    "designs",
    4: "holds if no boundary moves markedly up to the strongest damper; with limits if none does up to the "
    "friction of bearings; else it does not hold",
}


def judge_finite(in_box: float, beyond: float) -> Verdict:
    """Conclusion 1, from the shares of designs with an unbounded interval or with several, in two boxes."""
    if in_box > 0:
        return FAILS
    return LIMITS if beyond > 0 else HOLDS


def judge_widening(
    along_sigma: float, sigma_from: float | None, reaches_zero: bool, at_largest_lam: bool
) -> Verdict:
    """Conclusion 2, from the share of steps to larger σ that widen the interval, the σ from which a smaller
    λ does, whether it does so down to λ = 0, and whether the widest of all is at the largest λ.
    """
    if sigma_from is None or along_sigma < THRESHOLDS["nearly_all"] or at_largest_lam:
        return FAILS
    return HOLDS if reaches_zero else LIMITS


def judge_margin(apart: float | None) -> Verdict:
    """Conclusion 3, from how far the widest design and the fastest decaying one are apart, in sides of the
    box; None without stable designs.
    """
    if apart is None:
        return FAILS
    return HOLDS if apart <= THRESHOLDS["one_optimum"] else LIMITS


def judge_damping(marked_from: float | None) -> Verdict:
    """Conclusion 4, from the lowest δ [kg m²/s] at which a boundary has moved markedly."""
    if marked_from is None or marked_from > THRESHOLDS["dampers"]:
        return HOLDS
    return LIMITS if marked_from > THRESHOLDS["bearings"] else FAILS


def first_marked(
    deltas: Sequence[float], changes: Sequence[float | None], limit: float = THRESHOLDS["marked"]
) -> float | None:
    """The lowest δ at which |change| reaches the limit, interpolated in log δ; None if it never does.

    ``deltas`` ascend and are positive; a change that is None counts as beyond any limit.
    """
    for i, change in enumerate(changes):
        size = math.inf if change is None else abs(change)
        if size >= limit:
            before = 0.0 if i == 0 else abs(changes[i - 1] or 0.0)
            if i == 0 or not math.isfinite(size):
                return deltas[i]
            part = (limit - before) / (size - before)
            return deltas[i - 1] * (deltas[i] / deltas[i - 1]) ** part
    return None
