"""Single designs against viscous damping of the steering."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.machines import Machines
from bikestab.model import characteristic_table, coefficients
from bikestab.paper1981 import claims
from bikestab.region.lines import lowest_stable
from bikestab.speeds import KINDS, intervals_of

DESIGNS = ((0.20, 0.08), (0.30, 0.10), (0.05, 0.15), (0.12, 0.12), (0.03, 0.15))  # (λ, σ), stable without
UNSTABLE = (0.10, 0.08)  # without damping


@dataclass(frozen=True)
class Ends:
    """The first stable interval of a design [m/s] with damping δ [kg m²/s], and what ends it.

    Without an upper limit V2 is None, without stable speeds all are.
    """

    delta: float
    V1: float | None
    V2: float | None
    lower: str | None
    upper: str | None


@dataclass(frozen=True)
class DampedDesign:
    """A design's interval against δ, and the δ [kg m²/s] that equals b1° V1/c.

    V1 and V2 are marked from some δ on; where nothing is stable without damping, something is ``stable_from``
    some δ on, found exactly.
    """

    lam: float
    sigma: float
    without: Ends
    sweep: list[Ends]
    V1_marked_from: float | None
    V2_marked_from: float | None
    stable_from: float | None
    at_onset: Ends | None
    kinematic_damping: float | None


def single_designs(bicycle: Bicycle, deltas: tuple[float, ...]) -> list[DampedDesign]:
    """V1 and V2 [m/s] of the first interval of single designs against δ."""
    return [_single_design(bicycle, lam, sigma, deltas) for lam, sigma in (*DESIGNS, UNSTABLE)]


def relative(now: float | None, before: float | None) -> float | None:
    """The relative change; None where one of the two is nothing."""
    return None if not now or not before else now / before - 1


def _single_design(bicycle: Bicycle, lam: float, sigma: float, deltas: tuple[float, ...]) -> DampedDesign:
    without, *sweep = first_intervals(bicycle, lam, sigma, (0.0, *deltas))
    b1 = float(coefficients(bicycle, lam, sigma).b1.value)
    V1, V2 = ([relative(getattr(row, key), getattr(without, key)) for row in sweep] for key in ("V1", "V2"))
    onset = None if without.V1 else _onset(bicycle, lam, sigma, deltas[-1])
    return DampedDesign(
        lam=lam,
        sigma=sigma,
        without=without,
        sweep=sweep,
        V1_marked_from=claims.first_marked(deltas, V1) if without.V1 else None,
        V2_marked_from=claims.first_marked(deltas, V2) if without.V2 else None,
        stable_from=onset,
        at_onset=first_intervals(bicycle, lam, sigma, (onset * (1 + 1e-9),))[0] if onset else None,
        kinematic_damping=b1 * without.V1 / bicycle.c if without.V1 else None,
    )


def _onset(bicycle: Bicycle, lam: float, sigma: float, most: float) -> float | None:
    """The lowest δ [kg m²/s] with a stable speed, up to ``most``."""
    own = bicycle.replaced({"sigma": sigma})
    lowest = float(lowest_stable(Family(own, x="lam", y="delta"), 0.0, most, x=[lam])[0])
    return None if np.isnan(lowest) else lowest


def first_intervals(bicycle: Bicycle, lam: float, sigma: float, deltas: Sequence[float]) -> list[Ends]:
    """The first stable interval with each δ."""
    machines = Machines.varied(bicycle, {"delta": np.array(deltas)}, (len(deltas),))
    intervals = intervals_of(characteristic_table(machines, lam, sigma))
    first = (field[:, 0].tolist() for field in intervals)
    return [_named(delta, *each) for delta, *each in zip(deltas, *first, strict=True)]


def _named(delta: float, V1: float, V2: float, lower: int, upper: int) -> Ends:
    if not upper:
        return Ends(delta, None, None, None, None)
    return Ends(delta, V1, V2 if np.isfinite(V2) else None, KINDS[lower], KINDS[upper])
