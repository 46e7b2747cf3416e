"""The numbers behind the verdicts on the paper's conclusions, as plain data for a report."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.design import criteria
from bikestab.design.best import Best, best_designs
from bikestab.design.criteria import Wanted
from bikestab.family import Family
from bikestab.model import Floats, canonical_matrices, characteristic_table
from bikestab.paper1981 import box as paper
from bikestab.paper1981.box import LAM, SIGMA, WIDER, Map, Size, V
from bikestab.paper1981.machines import random_machines
from bikestab.region.curves import trace
from bikestab.region.skeleton import lowest_stable, stable_ranges
from bikestab.speeds import KINDS, intervals_of

Numbers = dict[str, Any]
COUNTEREXAMPLES = ((0.05, 0.15), (0.08, 0.13), (0.11, 0.145))  # (λ, σ) between the two curves at infinity
FAR = (100.0, 1000.0)  # m/s
SIGMAS = (0.06, 0.08, 0.10, 0.11, 0.12, 0.13, 0.14, 0.15)
LAMS = (0.05, 0.10, 0.15, 0.20, 0.25, 0.30)
TWO = (0.04834835, 0.15)  # a design with two intervals
JUDGED: dict[str, paper.Range | None] = {
    "at each design's best speed": None,
    "at 5 m/s": (5.0, 5.0),
    "at the worst of 4 … 6 m/s": (4.0, 6.0),
}
_TIE = 1e-9  # m/s: widths closer than that are equal


def intervals(bicycle: Bicycle, lam: float, sigma: float) -> list[Numbers]:
    """The stable intervals of one design; an unbounded V2 is None."""
    found = intervals_of(characteristic_table(bicycle, lam, sigma))
    return [
        {"V1": V1, "V2": V2 if math.isfinite(V2) else None, "lower": KINDS[lower], "upper": KINDS[upper]}
        for V1, V2, lower, upper in zip(*(values.tolist() for values in found), strict=True)
        if upper
    ]


def eigenvalues(bicycle: Bicycle, lam: float, sigma: float, speed: float) -> list[list[float]]:
    """[real, imaginary] of the eigenvalues [1/s] of the equations of motion, the fastest growing first.

    From the matrices and a general solver, so that neither the polynomial nor Routh–Hurwitz is involved.
    """
    M, C1, K0, K2 = canonical_matrices(bicycle, lam, sigma)
    C = speed * C1 + np.diag([0.0, bicycle.delta])
    inverse = np.linalg.inv(M)
    first = np.block(
        [[np.zeros((2, 2)), np.eye(2)], [-inverse @ (bicycle.g * K0 + speed**2 * K2), -inverse @ C]]
    )
    values = np.linalg.eigvals(first)
    return [[float(s.real), float(s.imag)] for s in sorted(values, key=lambda s: (-s.real, -s.imag))]


def finite_interval(bicycle: Bicycle, found: Map, size: Size) -> Numbers:
    """Conclusion 1: how many designs have bounded, unbounded, several or no intervals; counterexamples."""
    wide: Numbers = {"lam": (LAM[0], WIDER * LAM[1]), "sigma": (SIGMA[0], WIDER * SIGMA[1])}
    box = paper.exact_shares(bicycle, size.lines)
    wider = paper.exact_shares(bicycle, size.lines, **wide)
    coarser = paper.exact_shares(bicycle, size.lines // 2)
    examples: list[Numbers] = [
        {
            "lam": lam, "sigma": sigma, "intervals": intervals(bicycle, lam, sigma),
            "eigenvalues": {f"{speed:g}": eigenvalues(bicycle, lam, sigma, speed) for speed in FAR},
        }
        for lam, sigma in COUNTEREXAMPLES
    ]  # fmt: skip
    for example in examples:
        slowest = [example["eigenvalues"][f"{speed:g}"][0][0] for speed in FAR]
        example["speeds"] = list(FAR)
        example["stable_far_up"] = all(rate < 0 for rate in slowest)
        example["time_constants"] = [-1 / rate if rate < 0 else None for rate in slowest]  # s
    return {
        "shares": box,
        "shares_wider_box": wider,
        "wider_box": {name: list(ends) for name, ends in wide.items()},
        "shares_uncertainty": max(abs(box[name] - coarser[name]) for name in box),
        "unbounded_of_stable": box["unbounded"] / box["some"] if box["some"] else None,
        "bounded_of_stable": box["finite"] / box["some"] if box["some"] else None,
        "grid": {"designs": found.number.size, **found.shares},
        "formula_disagreements": int(np.count_nonzero(found.formula != found.unbounded)),
        "curves_at_infinity": _curves_at_infinity(bicycle, size),
        "counterexamples": examples,
        "two_intervals": {"lam": TWO[0], "sigma": TWO[1], "intervals": intervals(bicycle, *TWO)},
        "random_machines": on_random_machines(size),
        "judged_by": {
            "in_box": box["unbounded"] + box["multiple"], "beyond": wider["unbounded"] + wider["multiple"],
        },
    }  # fmt: skip


def _curves_at_infinity(bicycle: Bicycle, size: Size) -> list[Numbers]:
    """The two curves between which there is no upper limit, with their ends."""
    return [
        {
            "name": curve.name,
            "from": {"lam": float(curve.x[0]), "sigma": float(curve.y[0]), "at": curve.ends[0]},
            "to": {"lam": float(curve.x[-1]), "sigma": float(curve.y[-1]), "at": curve.ends[1]},
        }
        for curve in trace(Family(bicycle), LAM, SIGMA, samples=size.picture)
        if curve.name.endswith("infinity")
    ]


def on_random_machines(size: Size) -> Numbers:
    """How many random machines that could be built have an unbounded interval in the paper's box."""
    maps = [paper.designs(machine, size.grid_machines) for machine in random_machines(size.machines)]
    stable, unbounded, several = (
        np.array([values.mean() for values in found])
        for found in zip(*((m.number > 0, m.unbounded, m.number > 1) for m in maps), strict=True)
    )
    return {
        "machines": size.machines,
        "designs_each": size.grid_machines**2,
        "designs": size.machines * size.grid_machines**2,
        "with_stable": float(np.mean(stable > 0)),
        "with_unbounded": float(np.mean(unbounded > 0)),
        "with_several": float(np.mean(several > 0)),
        "stable_designs": float(stable.mean()),
        "unbounded_designs": float(unbounded.mean()),
        "formula_disagreements": int(sum(np.count_nonzero(m.formula != m.unbounded) for m in maps)),
    }


def widening(found: Map) -> Numbers:
    """Conclusion 2 on a map: how the width of the widest interval changes between neighbouring designs.

    Two unbounded intervals are equally wide, and steps between them count for nothing.
    """
    W = found.widest
    larger_sigma, smaller_lam = (_share_widened(a, b) for a, b in ((W[:, :-1], W[:, 1:]), (W[1:], W[:-1])))
    best = len(W) - 1 - np.argmax(W[::-1], axis=0)  # of equally wide ones that with the largest tilt
    good = [W[k, j] > 0 and _falls(W[k:, j]) for j, k in enumerate(best.tolist())]
    first = next((j for j in range(len(good)) if all(good[j:])), None)
    return {
        "designs": W.size,
        "larger_sigma_widens": larger_sigma,
        "smaller_lam_widens": smaller_lam,
        "sigma_from": None if first is None else float(found.sigma[first]),
        "sigma_step": float(found.sigma[1] - found.sigma[0]),
        "reaches_zero": first is not None and bool(np.all(W[0, first:] >= W.max(axis=0)[first:])),
    }


def _share_widened(before: Floats, after: Floats) -> float:
    """The share of steps between stable designs that do not narrow the interval."""
    counts = (before > 0) & (after > 0) & (np.isfinite(before) | np.isfinite(after))
    return float(np.mean(after[counts] >= before[counts] - _TIE)) if counts.any() else 0.0


def _falls(values: Floats) -> bool:
    return len(values) > 1 and bool(np.all(values[1:] <= values[:-1] + _TIE))


def widths_along_lines(bicycle: Bicycle, steps: int) -> Numbers:
    """Where along lines of constant σ and of constant λ there are stable speeds, and the widest interval."""
    wanted = Wanted(Family(bicycle), LAM, SIGMA, V_max=V[1])
    rows: dict[str, list[Numbers]] = {"sigma": [], "lam": []}
    for sigma, ranges in zip(SIGMAS, stable_ranges(Family(bicycle), *LAM, y=SIGMAS), strict=True):
        lam, width = _widest(bicycle, np.linspace(*LAM, steps), sigma)
        unbounded = paper.unbounded_ranges(bicycle, sigma)
        end = float(_widths(bicycle, np.array([LAM[1]]), np.array(sigma))[0])
        rows["sigma"].append(
            {"sigma": sigma, "stable_lam": ranges, "unbounded_lam": unbounded, "best_lam": lam,
             "width": width, "width_at_largest_lam": end}
        )  # fmt: skip
    for lam, ranges in zip(LAMS, stable_ranges(Family(bicycle), *SIGMA, x=LAMS), strict=True):
        sigma, width = _widest(bicycle, lam, np.linspace(*SIGMA, steps))
        rows["lam"].append({"lam": lam, "stable_sigma": ranges, "best_sigma": sigma, "width": width})
    return {"cap": wanted.V_max, "at_sigma": rows["sigma"], "at_lam": rows["lam"]}


def _widths(bicycle: Bicycle, lam: Any, sigma: Any) -> Floats:
    found = intervals_of(characteristic_table(bicycle, lam, sigma))
    return paper.widths(found).max(axis=-1)


def _widest(bicycle: Bicycle, lam: Any, sigma: Any) -> tuple[float, float]:
    width = _widths(bicycle, lam, sigma)
    k = int(np.argmax(width))
    return float((lam if np.ndim(lam) else sigma)[k]), float(width[k])


def smallest_tilt(bicycle: Bicycle) -> Numbers:
    """The smallest λ with a stable speed at the largest σ, and the smallest σ at the largest λ."""
    lam = float(lowest_stable(Family(bicycle), 0.0, LAM[1], y=SIGMA[1]))
    sigma = float(lowest_stable(Family(bicycle), 0.0, SIGMA[1], x=LAM[1]))
    return {"lam_min": None if math.isnan(lam) else lam, "sigma_min": None if math.isnan(sigma) else sigma}


@cache
def searched(wanted: Wanted, grid: int) -> Best:
    """The best designs; the same ones are tabled and drawn."""
    return best_designs(wanted, grid=grid)


def margin(bicycle: Bicycle, size: Size) -> Numbers:
    """Conclusion 3: the best designs by width and by decay, each searched for in the paper's box."""
    box = Wanted(Family(bicycle), LAM, SIGMA, V_max=V[1])
    found: list[Numbers] = []
    for words, speeds in JUDGED.items():
        best = searched(replace(box, judged=speeds), size.search)
        if not found and best.widest:
            found.append({"criterion": "widest interval", **best.widest})
        if best.fastest_decay:
            found.append({"criterion": f"fastest decay {words}", **best.fastest_decay})
    if not found:
        return {"optima": [], "judged_by": {"apart": None}}
    return {"optima": found, "judged_by": {"apart": _apart(found[0], found[1])}}


def margin_on_grid(bicycle: Bicycle, n: int) -> float | None:
    """How far the widest and the fastest decaying of n × n designs are apart, in sides of the box."""
    box = Wanted(Family(bicycle), LAM, SIGMA, V_max=V[1])
    x = np.stack(np.meshgrid(np.linspace(*LAM, n), np.linspace(*SIGMA, n), indexing="ij")).reshape(2, -1)
    width, growth = criteria.width_and_decay(box, x)
    if not width.max() > 0:
        return None
    wide, fast = (x[:, k] for k in (np.argmax(width), np.argmin(np.where(width > 0, growth, np.inf))))
    return _apart(*({"lam": float(d[0]), "sigma": float(d[1])} for d in (wide, fast)))


def _apart(a: Numbers, b: Numbers) -> float:
    return max(abs(a[name] - b[name]) / (end[1] - end[0]) for name, end in (("lam", LAM), ("sigma", SIGMA)))
