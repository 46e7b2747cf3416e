"""Conclusion 4: what viscous damping of the steering does to the boundaries."""

from __future__ import annotations

from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Floats, characteristic_table, coefficients
from bikestab.paper1981 import box as paper
from bikestab.paper1981 import claims
from bikestab.paper1981.box import LAM, SIGMA
from bikestab.region.skeleton import lowest_stable
from bikestab.speeds import CAPSIZE, WEAVE, intervals_of

Numbers = dict[str, Any]
DESIGNS = ((0.20, 0.08), (0.30, 0.10), (0.05, 0.15), (0.12, 0.12))  # (λ, σ), stable without damping
UNSTABLE = (0.10, 0.08)  # without damping
FOLDS = (0.10, 0.20, 0.30)  # λ [rad] at which the smallest stable σ is followed
DELTAS = tuple(float(f"{delta:.4g}") for delta in np.logspace(-3, 1, 21))  # kg m²/s
SHOWN = (0.001, 0.01, 0.1, 1.0, 10.0)  # in the report's tables
FEW = (0.01, 0.03, 0.1, 1.0, 10.0)


def damping(bicycle: Bicycle, n: int, deltas: tuple[float, ...] = DELTAS) -> Numbers:
    """How the region of n × n designs, its smallest trail and single designs change with δ [kg m²/s].

    Changes are relative to δ = 0. ``marked_from`` names, for each measure, the δ from which it is marked.
    """
    x, y = paper.middles(LAM, n)[:, np.newaxis], paper.middles(SIGMA, n)
    still = _Region(bicycle.with_delta(0.0), x, y)
    rows: list[Numbers] = []
    for delta in deltas:
        here = _Region(bicycle.with_delta(delta), x, y)
        both = still.weave & here.weave
        moved = np.abs(here.V1[both] / still.V1[both] - 1)
        rows.append(
            {
                "delta": delta,
                "volume": here.volume,
                "volume_change": _relative(here.volume, still.volume),
                "V1_change_median": float(np.median(moved)) if moved.size else None,
                "V1_change_largest": float(moved.max()) if moved.size else None,
                "sigma_min": here.folds,
                "sigma_min_change": [
                    _relative(now, before) for now, before in zip(here.folds, still.folds, strict=True)
                ],
                "p0_change": float(np.abs(here.table[0] - still.table[0]).max()),
                "unbounded_changed": int(np.count_nonzero(here.unbounded != still.unbounded)),
            }
        )
    marked = _marked(list(deltas), rows)
    return {
        "designs": n * n,
        "marked": claims.THRESHOLDS["marked"],
        "bearings": claims.THRESHOLDS["bearings"],
        "verdict_by_measure": {name: claims.judge_damping(delta) for name, delta in marked.items()},
        "deltas": list(deltas),
        "without": {"volume": still.volume, "sigma_min": still.folds},
        "range": [deltas[0], deltas[-1]],
        "shown": [delta for delta in SHOWN if delta in deltas],
        "p0_change": max(row["p0_change"] for row in rows),
        "unbounded_changed": max(row["unbounded_changed"] for row in rows),
        "folds_at_lam": list(FOLDS),
        "sweep": rows,
        "marked_from": marked,
        "judged_by": {"marked_from": min((v for v in marked.values() if v is not None), default=None)},
    }


def single_designs(bicycle: Bicycle, deltas: tuple[float, ...] = DELTAS) -> list[Numbers]:
    """V1 and V2 [m/s] of the first interval of single designs against δ, and the δ that equals b1° V/c."""
    found = []
    for lam, sigma in (*DESIGNS, UNSTABLE):
        without = _ends(bicycle.with_delta(0.0), lam, sigma)
        rows = [{"delta": delta, **_ends(bicycle.with_delta(delta), lam, sigma)} for delta in deltas]
        changes = [_relative(row["V1"], without["V1"]) for row in rows]
        b1 = float(coefficients(bicycle, lam, sigma).b1.value)
        found.append(
            {
                "lam": lam,
                "sigma": sigma,
                "without": without,
                "sweep": rows,
                "marked_from": claims.first_marked(list(deltas), changes) if without["V1"] else None,
                "stable_from": next((row["delta"] for row in rows if row["V1"] is not None), None),
                "kinematic_damping": b1 * without["V1"] / bicycle.c if without["V1"] else None,
            }
        )
    return found


class _Region:
    """The stable region of a grid of designs, with its smallest trails and its lower ends."""

    def __init__(self, bicycle: Bicycle, lam: Floats, sigma: Floats) -> None:
        self.table = characteristic_table(bicycle, lam, sigma)
        found = intervals_of(self.table)
        self.volume = (
            float(paper.widths(found).sum(axis=-1).mean()) * (LAM[1] - LAM[0]) * (SIGMA[1] - SIGMA[0])
        )
        self.weave, self.V1 = found.lower[..., 0] == WEAVE, found.V1[..., 0]
        self.unbounded = np.isinf(found.V2).any(axis=-1)
        folds = lowest_stable(Family(bicycle), 0.0, SIGMA[1], x=FOLDS).tolist()
        self.folds = [None if np.isnan(fold) else fold for fold in folds]


def _ends(bicycle: Bicycle, lam: float, sigma: float) -> Numbers:
    found = intervals_of(characteristic_table(bicycle, lam, sigma))
    if not found.upper[0]:
        return {"V1": None, "V2": None, "capsize": False}
    V1, V2 = float(found.V1[0]), float(found.V2[0])
    return {"V1": V1, "V2": V2 if np.isfinite(V2) else None, "capsize": bool(found.upper[0] == CAPSIZE)}


def _relative(now: float | None, before: float | None) -> float | None:
    return None if not now or not before else now / before - 1


def _marked(deltas: list[float], rows: list[Numbers]) -> Numbers:
    measures = {
        "volume of the stable region": [row["volume_change"] for row in rows],
        "V1, median over designs": [row["V1_change_median"] for row in rows],
    }
    for i, lam in enumerate(FOLDS):
        measures[f"smallest stable σ at λ = {lam:g}"] = [row["sigma_min_change"][i] for row in rows]
    usable = {name: values for name, values in measures.items() if values[0] is not None}
    return {name: claims.first_marked(deltas, values) for name, values in usable.items()}
