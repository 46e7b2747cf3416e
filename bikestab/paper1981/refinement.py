"""The refined equations against those of the paper's reference [1]: where and why they differ."""

from __future__ import annotations

from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import MODELS, Model, characteristic_table, coefficients
from bikestab.paper1981 import box as paper
from bikestab.paper1981.box import LAM, SIGMA, WIDER, Map, Size
from bikestab.roots import positive_roots
from bikestab.routh import condition_polynomials

Numbers = dict[str, Any]
_DAMPER = 1.0  # kg m²/s


def refinement(bicycle: Bicycle, found: Map, size: Size) -> Numbers:
    """The stable region's volume in both models, and what the terms do to p0 and p1; ``found`` is refined."""
    n = size.grid // 2
    x, y = paper.middles(LAM, n)[:, np.newaxis], paper.middles(SIGMA, n)
    tables = {model: characteristic_table(bicycle, x, y, model=model) for model in MODELS}
    changed = [
        f"V^{j} of p{k}"
        for k in range(5)
        for j in range(4)
        if not np.array_equal(tables["refined"][k, j], tables["unrefined"][k, j])
    ]
    a, b = (coefficients(bicycle, x, y, model=model) for model in MODELS)
    letters = [
        name for name in a._fields if not np.array_equal(getattr(a, name).value, getattr(b, name).value)
    ]
    maps = {"refined": found, "unrefined": paper.designs(bicycle, size.grid, model="unrefined")}
    coarser = paper.designs(bicycle, n)
    whole = float(np.prod([end[1] - end[0] for end in (LAM, SIGMA, paper.V)]))
    return {
        "changed_coefficients": letters,
        "changed_terms": changed,
        "volume_uncertainty": abs(paper.volume(found) - paper.volume(coarser)),
        "volume_of_box": whole,
        "designs": found.number.size,
        "designs_for_terms": n * n,
        "models": {
            model: {
                "volume": paper.volume(maps[model]),
                "volume_share": paper.volume(maps[model]) / whole,
                "shares": maps[model].shares,
            }
            | _why(bicycle, tables[model], model, x, y)
            | _beyond(bicycle, model, size)
            for model in MODELS
        },
    }


def _why(bicycle: Bicycle, table: Any, model: Model, x: Any, y: Any) -> Numbers:
    """Where p0 and p1 are positive: p0 > 0 needs S > 0 at V = 0 and V below capsize, p1 > 0 a higher V."""
    S = coefficients(bicycle, x, y, model=model).a4.value / (bicycle.c * bicycle.g)
    p0, p1 = (condition_polynomials(table)[name] for name in ("p0", "p1"))
    some = (p0[0] > 0) | (p0[2] > 0)
    falling = (p0[0] > 0) & (p0[2] < 0)  # positive below the capsize speed only
    capsize, low = (np.nan_to_num(positive_roots(p).max(axis=0, initial=0.0)) for p in (p0, p1))
    return {
        "S": [float(S.min()), float(S.max())],  # kg m
        "p0_somewhere": float(some.mean()),
        "p0_rising": float((p0[2] > 0).mean()),
        "capsize_highest": float(capsize[falling].max()) if falling.any() else None,
        "p1_lowest": float(low.min()),
        "capsize_over_p1": float((capsize[falling] / low[falling]).max()) if falling.any() else None,
        "p0_and_p1": float(((p0[2] > 0) | (falling & (capsize > low))).mean()),
    }


def _beyond(bicycle: Bicycle, model: Model, size: Size) -> Numbers:
    """The shares of designs with a stable speed in a wider box, without damping and with a damper."""
    wide: dict[str, Any] = {"lam": (LAM[0], WIDER * LAM[1]), "sigma": (SIGMA[0], WIDER * SIGMA[1])}
    shares = [
        1 - paper.designs(machine, size.grid_readings, model=model, **wide).shares["none"]
        for machine in (bicycle, bicycle.with_delta(_DAMPER))
    ]
    return {"stable_in_wider_box": shares[0], "stable_with_damper": shares[1], "damper": _DAMPER}
