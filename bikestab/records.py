"""Answers as plain records, which JSON can hold: designs, stable intervals, modes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NotRequired, TypedDict

from bikestab.geometry import offset_of
from bikestab.speeds import KINDS, REASONS, Intervals

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.machines import Machines
    from bikestab.modes import Modes


class Design(TypedDict):
    """A design: λ [rad], σ, head angle [°], trail [m] and fork offset [m], the paper's b."""

    lam: float
    sigma: float
    head_angle_deg: float
    trail: float
    offset: float


class Interval(TypedDict):
    """An interval of stable speeds [m/s] and what happens at its ends; V2 is None where it is unbounded.

    The true ends lie within V1_error and V2_error, which are None where there is no bound, or no V2.
    """

    V1: float
    V2: float | None
    lower: str
    upper: str
    V1_error: float | None
    V2_error: float | None


class Verdict(TypedDict):
    """Whether the number of intervals or the kind of an end is within rounding, and which, in words."""

    marginal: bool
    reason: NotRequired[str]


def interval_records(found: Intervals, *cell: int) -> list[Interval]:
    """The intervals of one cell of ``found``, by its indices, ascending."""
    V1, V2, lower, upper, V1_error, V2_error, _ = (
        values[cell].tolist() for values in found.arrays().values()
    )
    return [
        {
            "V1": V1[k],
            "V2": _finite(V2[k]),
            "lower": KINDS[lower[k]],
            "upper": KINDS[upper[k]],
            "V1_error": _finite(V1_error[k]),
            "V2_error": _finite(V2_error[k]) if math.isfinite(V2[k]) else None,
        }
        for k in range(int(found.number[cell]))
    ]


def verdict_record(found: Intervals, *cell: int) -> Verdict:
    """Whether the intervals of one cell of ``found`` are certain, by its indices."""
    reason = REASONS[int(found.marginal[cell][0])]
    return {"marginal": True, "reason": reason} if reason else {"marginal": False}


def design_record(lam: Any, sigma: Any, machine: Bicycle | Machines) -> Design:
    """A design of a machine by the words of tables and JSON, of floats; or several, of arrays."""
    return design_of_numbers(lam, sigma, machine.c, machine.R2)


def design_of_numbers(lam: Any, sigma: Any, wheelbase: Any, radius: Any) -> Design:
    """The same from its wheelbase [m] and front radius [m]."""
    offset = offset_of(lam, sigma, wheelbase, radius)
    return {
        "lam": lam,
        "sigma": sigma,
        "head_angle_deg": 90 - lam * (180 / math.pi),
        "trail": sigma * wheelbase,
        "offset": float(offset) if isinstance(lam, float) else offset,
    }


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


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def letter_of(number: int) -> str:
    """A, B, ..., Z, AA, AB, ...: stands for the machine of this number, from 0, in tables and pictures."""
    return (letter_of(number // 26 - 1) if number >= 26 else "") + chr(ord("A") + number % 26)
