"""The refined equations against those of the paper's reference [1]: where and why they differ."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import MODELS, Floats, Model, characteristic_table, coefficients
from bikestab.paper1981.box import LAM, PAPER_BOX, SIGMA, Sampling, V, middles
from bikestab.paper1981.maps import DesignMap, Shares, map_designs, region_volume
from bikestab.roots import positive_roots
from bikestab.routh import condition_polynomials

SECTION = 0.3  # rad: the λ at which the two models are compared; the unrefined one comes nearest there
_DAMPER = 1.0  # kg m²/s


@dataclass(frozen=True)
class Region:
    """The stable region of one model in the paper's box: its volume [rad m/s], and shares of designs."""

    volume: float
    volume_share: float
    shares: Shares


@dataclass(frozen=True)
class Causes:
    """Where p0 and p1 are positive: p0 > 0 needs S > 0 [kg m] and V below capsize, p1 > 0 a higher V.

    Shares of designs, speeds in m/s.
    """

    S: list[float]
    p0_somewhere: float
    p0_rising: float
    capsize_highest: float | None
    p1_lowest: float
    capsize_over_p1: float | None
    p0_and_p1: float


@dataclass(frozen=True)
class Beyond:
    """The shares of designs with a stable speed in a wider box, without damping and with a damper."""

    stable_in_wider_box: float
    stable_with_damper: float
    damper: float


@dataclass(frozen=True)
class ModelNumbers(Beyond, Causes, Region):
    """All of one model."""


@dataclass(frozen=True)
class Refinement:
    """The stable region's volume in both models, and what the terms do to p0 and p1."""

    section_lam: float
    changed_coefficients: list[str]
    changed_terms: list[str]
    volume_uncertainty: float
    volume_of_box: float
    designs: int
    designs_for_terms: int
    models: dict[Model, ModelNumbers]


def refinement(bicycle: Bicycle, refined: DesignMap, sampling: Sampling) -> Refinement:
    """Both models compared; ``refined`` is the map of the refined one."""
    n = sampling.grid // 2
    x, y = middles(LAM, n)[:, np.newaxis], middles(SIGMA, n)
    tables = {model: characteristic_table(bicycle, x, y, model=model) for model in MODELS}
    maps: dict[Model, DesignMap] = {
        "refined": refined, "unrefined": map_designs(bicycle, sampling.grid, model="unrefined"),
    }  # fmt: skip
    return Refinement(
        section_lam=SECTION,
        changed_coefficients=_changed_coefficients(bicycle, x, y),
        changed_terms=[
            f"V^{j} of p{k}"
            for k in range(5)
            for j in range(4)
            if not np.array_equal(tables["refined"][k, j], tables["unrefined"][k, j])
        ],
        volume_uncertainty=abs(region_volume(refined) - region_volume(map_designs(bicycle, n))),
        volume_of_box=_volume_of_box(),
        designs=refined.number.size,
        designs_for_terms=n * n,
        models={
            model: ModelNumbers(
                **vars(_region(maps[model])),
                **vars(_causes(bicycle, tables[model], model, x, y)),
                **vars(_beyond(bicycle, model, sampling.grid_readings)),
            )
            for model in MODELS
        },
    )


def _changed_coefficients(bicycle: Bicycle, x: Floats, y: Floats) -> list[str]:
    a, b = (coefficients(bicycle, x, y, model=model) for model in MODELS)
    return [name for name in a._fields if not np.array_equal(getattr(a, name).value, getattr(b, name).value)]


def _volume_of_box() -> float:
    return float(np.prod([end[1] - end[0] for end in (LAM, SIGMA, V)]))


def _region(designs: DesignMap) -> Region:
    volume = region_volume(designs)
    return Region(volume, volume / _volume_of_box(), designs.shares)


def _causes(bicycle: Bicycle, table: Floats, model: Model, x: Floats, y: Floats) -> Causes:
    S = coefficients(bicycle, x, y, model=model).a4.value / (bicycle.c * bicycle.g)
    p0, p1 = (condition_polynomials(table)[name] for name in ("p0", "p1"))
    some = (p0[0] > 0) | (p0[2] > 0)
    falling = (p0[0] > 0) & (p0[2] < 0)  # positive below the capsize speed only
    capsize, low = (np.nan_to_num(positive_roots(p).max(axis=0, initial=0.0)) for p in (p0, p1))
    return Causes(
        S=[float(S.min()), float(S.max())],
        p0_somewhere=float(some.mean()),
        p0_rising=float((p0[2] > 0).mean()),
        capsize_highest=float(capsize[falling].max()) if falling.any() else None,
        p1_lowest=float(low.min()),
        capsize_over_p1=float((capsize[falling] / low[falling]).max()) if falling.any() else None,
        p0_and_p1=float(((p0[2] > 0) | (falling & (capsize > low))).mean()),
    )


def _beyond(bicycle: Bicycle, model: Model, n: int) -> Beyond:
    without, with_damper = (
        1 - map_designs(machine, n, PAPER_BOX.wider, model=model).shares.none
        for machine in (bicycle, bicycle.with_delta(_DAMPER))
    )
    return Beyond(without, with_damper, _DAMPER)
