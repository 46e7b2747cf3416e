"""Answers as plain records, which JSON can hold: designs, stable intervals, modes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypedDict

from bikestab.speeds import KINDS, Intervals

if TYPE_CHECKING:
    from bikestab.branches import Modes


class Design(TypedDict):
    """A design: λ [rad], σ, head angle [°] and trail [m]."""

    lam: float
    sigma: float
    head_angle_deg: float
    trail: float


class Interval(TypedDict):
    """An interval of stable speeds [m/s] and what happens at its ends; V2 is None where it is unbounded."""

    V1: float
    V2: float | None
    lower: str
    upper: str


def interval_records(found: Intervals, *cell: int) -> list[Interval]:
    """The intervals of one cell of ``found``, by its indices, ascending."""
    V1, V2, lower, upper = (values[cell].tolist() for values in found[:4])
    return [
        {
            "V1": V1[k],
            "V2": None if math.isinf(V2[k]) else V2[k],
            "lower": KINDS[lower[k]],
            "upper": KINDS[upper[k]],
        }
        for k in range(int(found.number[cell]))
    ]


def design_record(lam: Any, sigma: Any, wheelbase: Any) -> Design:
    """A design by the words of tables and JSON, of floats; or several, of arrays."""
    degrees = lam * (180 / math.pi)
    return {"lam": lam, "sigma": sigma, "head_angle_deg": 90 - degrees, "trail": sigma * wheelbase}


def modes_record(modes: Modes) -> dict[str, Any]:
    """Branches as lists; each has one name for each speed, since it can change where two meet."""
    from bikestab.modenames import BRANCHES

    return {
        "coalescences": [
            {
                "V": float(V),
                "branches": list(pair),
                "below": [below[row] for row in pair],
                "above": [above[row] for row in pair],
            }
            for V, pair, below, above in zip(
                modes.coalescences, modes.meeting, modes.below, modes.above, strict=True
            )
        ],
        "V": modes.V.tolist(),
        "branches": [
            {"branch": branch, "name": names.tolist(), "re": s.real.tolist(), "im": s.imag.tolist()}
            for branch, names, s in zip(BRANCHES, modes.names, modes.eigenvalues, strict=True)
        ],
    }
