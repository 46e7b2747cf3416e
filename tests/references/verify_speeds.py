"""Random machines: bikestab's stable intervals and their bounds against interval arithmetic of 400 bits.

Half of the machines lie within 1e-16 … 1e-1 (relative, in the trail) of a design at which the intervals
change: where a leading coefficient of p0 or hurwitz3, their discriminant or resultant changes its sign. The
truth comes from python-flint: the determinant of the equations (1.5) of docs/theory.md in balls, all complex
roots of its conditions isolated, and the six conditions themselves between them.

    python tests/references/verify_speeds.py --number 100000 --seed 1

prints how many structures are wrong without being called marginal, how many are marginal, how many ends are
outside their bound, and how many are wrong by more than 4 ε κ, where κ = Σ |x ∂V/∂x| / V over the inputs.
"""

from __future__ import annotations

import argparse
import math
import random
from collections import Counter
from itertools import pairwise
from statistics import median
from types import SimpleNamespace
from typing import Any

import numpy as np
from flint import acb_poly, arb, arb_poly, ctx

from bikestab.model import characteristic_table, exact_table
from bikestab.region.skeleton import curve_functions
from bikestab.speeds import KINDS, Intervals, intervals_of

BITS = 400
BATCH = 2000  # machines at a time
EPS = 2.0**-52
_NOTHING = arb(2) ** -300  # of a coefficient's terms: it cancels


def table(p: dict[str, Any], lam: Any, sigma: Any) -> list[arb_poly]:
    """p0 … p4 as polynomials in V, by the determinant of (1.5)."""
    n = {key: arb(value) for key, value in p.items()}
    c, g, m1, l1, h1, m2, l2, h2 = (n[key] for key in ("c", "g", "m1", "l1", "h1", "m2", "l2", "h2"))
    A1, B1, D1, A2, B2, D2 = (n[key] for key in ("A1", "B1", "D1", "A2", "B2", "D2"))
    K1, K2 = (n["C" + i] / n["R" + i] if p["C" + i] else arb(0) for i in "12")
    sin, cos = arb(lam).sin(), arb(lam).cos()
    c1 = c * arb(sigma) * cos
    d = h2 * sin + (l2 - c) * cos - c1
    l, h = m1 * l1 + m2 * l2, m1 * h1 + m2 * h2  # noqa: E741  # the paper's letters
    J = m2 * d * d + A2 * sin * sin - 2 * D2 * sin * cos + B2 * cos * cos
    J1, J2 = m1 * h1 * h1 + A1 + m2 * h2 * h2 + A2, m1 * l1 * l1 + B1 + m2 * l2 * l2 + B2
    J3, J4 = m2 * h2 * d + A2 * sin - D2 * cos, m2 * d * l2 - D2 * sin + B2 * cos
    J12, S = m1 * h1 * l1 + D1 + m2 * h2 * l2 - D2, m2 * d + l * c1 / c
    a2, a3 = c * J3 + c1 * J12, (J12 + c * K2) * cos + c1 * (h + K1 + K2)
    a4, a5, b5 = c * g * S, (h + K1 + K2) * cos, c * K2 * cos + c1 * (K1 + K2)
    b0 = c * J + 2 * c1 * J4 + c1 * c1 * J2 / c
    b1, b2 = J4 * cos + c1 * (m2 * d + J2 * cos / c + l * c1 / c), (m2 * d + K2 * sin + l * c1 / c) * cos
    lean = {2: arb_poly([c * J1]), 0: arb_poly([-(c * g * h)])}
    side = {2: arb_poly([-a2]), 1: arb_poly([0, -a3]), 0: arb_poly([a4, 0, -a5])}
    back = {2: arb_poly([-a2]), 1: arb_poly([0, b5]), 0: arb_poly([a4])}
    steer = {2: arb_poly([b0]), 1: arb_poly([c * n["delta"], b1]), 0: arb_poly([-(a4 * sin), 0, b2])}
    out = [arb_poly([0]) for _ in range(5)]
    for first, second, sign in ((lean, steer, 1), (side, back, -1)):
        for i, x in first.items():
            for j, y in second.items():
                out[i + j] = out[i + j] + sign * x * y
    return out


def hurwitz3(p: list[arb_poly]) -> arb_poly:
    return p[1] * (p[2] * p[3] - p[4] * p[1]) - p[0] * p[3] * p[3]


def settled(poly: arb_poly, size: float) -> arb_poly:
    """Without coefficients that cancel identically: their balls hold zero and are tiny."""
    zero = [x.contains(arb(0)) and bool(abs(x) < _NOTHING * size) for x in poly.coeffs()]
    return arb_poly([arb(0) if z else x for z, x in zip(zero, poly.coeffs(), strict=True)])


def positive_roots(poly: arb_poly) -> list[arb]:
    """The positive real roots, all of them simple; ValueError where some cannot be told apart."""
    c = poly.coeffs()
    while c and c[-1] == 0:
        c.pop()
    while c and c[0] == 0:
        c.pop(0)
    if len(c) < 2:
        return []
    if any(x.contains(arb(0)) for x in (c[0], c[-1])):
        raise ValueError
    found = acb_poly(c).roots(tol=arb(2) ** -200, maxprec=4 * BITS)
    real = [z.real for z in found if z.imag.contains(arb(0)) and not z.real < 0]
    if any(x.contains(arb(0)) for x in real):
        raise ValueError
    return real


def truth(p: dict[str, float], lam: float, sigma: float) -> list[tuple[Any, str, Any, str]]:
    """Every interval: V1, kind, V2 (None = unbounded), kind. ValueError where 400 bits cannot tell."""
    rows = table(p, lam, sigma)
    size = max([1.0, *(abs(float(x.mid())) for row in rows for x in row.coeffs())]) ** 3
    rows = [settled(row, size) for row in rows]
    edges = [(arb(0), "rest")]
    found = [
        (x, kind)
        for poly, kind in ((rows[0], "capsize"), (settled(hurwitz3(rows), size), "weave"))
        for x in positive_roots(poly)
    ]
    edges += sorted(found, key=lambda edge: float(edge[0].mid()))
    edges = [edges[0], *_in_order(edges[1:])]
    out = []
    for i, (low, kind) in enumerate(edges):
        high, upper = edges[i + 1] if i + 1 < len(edges) else (None, "unbounded")
        inside = 2 * low + 1 if high is None else (low + high) / 2
        values = [row(arb(inside.mid())) for row in (*rows, hurwitz3(rows))]
        if any(x.contains(arb(0)) and x != 0 for x in values) and not any(x < 0 for x in values):
            raise ValueError
        if all(x > 0 for x in values):
            out.append((low, kind, high, upper))
    return out


def _in_order(edges: list[Any]) -> list[Any]:
    for i in range(len(edges)):
        for k in range(len(edges) - 1 - i):
            if edges[k + 1][0] < edges[k][0]:
                edges[k], edges[k + 1] = edges[k + 1], edges[k]
    if any(not a[0] < b[0] for a, b in pairwise(edges)):
        raise ValueError
    return edges


def kappa(p: dict[str, float], lam: float, sigma: float, V: arb, kind: str) -> float:
    """Σ |x ∂V/∂x| / V, by differences of the condition in 400 bits."""

    def condition(values: dict[str, Any], at: Any) -> arb:
        rows = table({key: values[key] for key in p}, values["lam"], values["sigma"])
        return (rows[0] if kind == "capsize" else hurwitz3(rows))(at)

    x = {key: arb(value) for key, value in {**p, "lam": lam, "sigma": sigma}.items()}
    step, V = arb(2) ** -100, arb(V.mid())
    slope = (condition(x, V * (1 + step)) - condition(x, V * (1 - step))) / 2
    total = arb(0)
    for key, value in x.items():
        if value != 0:
            up, down = (condition({**x, key: value * (1 + s * step)}, V) for s in (1, -1))
            total += abs((up - down) / 2 / slope)
    return float(total.mid())


def random_machine(rng: random.Random) -> tuple[dict[str, float], float, float]:
    """A bicycle, motorcycle or something else on two wheels or skates, with its tilt and trail."""
    c, m1, m2 = rng.uniform(0.7, 1.8), rng.uniform(10, 250), rng.uniform(1, 35)
    p = {"c": c, "g": rng.choice([9.81, 9.8, 1.62]), "m1": m1, "m2": m2}
    p |= {"l1": c * rng.uniform(0.1, 0.7), "h1": rng.uniform(0.3, 1.4)}
    p |= {"l2": c * rng.uniform(0.7, 1.2), "h2": rng.uniform(0.2, 1.0)}
    for i, m, size in (("1", m1, 0.5), ("2", m2, 0.35)):
        A, B = (m * (size * rng.uniform(0.2, 1)) ** 2 for _ in range(2))
        R = rng.uniform(0.15, 0.5)
        C = min(0.3 * m * R**2 * rng.uniform(0.3, 1), A + B)
        p |= {
            "A" + i: A,
            "B" + i: B,
            "D" + i: rng.uniform(-0.9, 0.9) * math.sqrt(A * B),
            "C" + i: C,
            "R" + i: R,
        }
    if rng.random() < 0.05:
        p |= {"C1": 0.0, "C2": 0.0}
    if rng.random() < 0.03:
        p |= dict.fromkeys(("A1", "B1", "D1", "A2", "B2", "D2"), 0.0)
    p["delta"] = 0.0 if rng.random() < 0.5 else 10 ** rng.uniform(-12, 6)
    lam = 0.0 if rng.random() < 0.02 else rng.uniform(-0.4, 1.3)
    sigma = 0.0 if rng.random() < 0.02 else rng.uniform(-0.3, 1.5)
    return p, lam, sigma


def together(machines: list[dict[str, float]], axes: int = 0) -> SimpleNamespace:
    """Many machines as the model takes them: arrays, with so many axes behind."""
    columns = {key: np.array([p[key] for p in machines]).reshape(-1, *(1,) * axes) for key in machines[0]}
    return SimpleNamespace(**columns, shape=(len(machines), *(1,) * axes))


def beside_changes(machines: list[dict[str, float]], lam: Any, rng: random.Random) -> list[float | None]:
    """Trails within 1e-16 … 1e-1 of one at which the intervals may change; None where there is none."""

    def signs(at: Any, axes: int) -> Any:
        table = characteristic_table(together(machines, axes), lam.reshape(-1, *(1,) * axes), at)
        return np.sign([np.broadcast_to(row, table.shape[2:]) for row in curve_functions(table).values()])

    sigma = np.linspace(-0.3, 1.5, 65)
    grid = signs(sigma, 1)
    chosen = []
    for machine in range(len(machines)):
        row = grid[:, machine]
        chosen.append(rng.choice([*zip(*np.nonzero(row[:, 1:] * row[:, :-1] < 0), strict=True)] or [(0, 0)]))
    k, place = (np.array(each) for each in zip(*chosen, strict=True))
    each = np.arange(len(machines))
    low, high = sigma[place], sigma[place + 1]
    for _ in range(55):
        middle = 0.5 * (low + high)
        same = signs(middle, 0)[k, each] == grid[k, each, place]
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    exists = grid[k, each, place] * grid[k, each, place + 1] < 0
    aside = [1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-16, -1) for _ in machines]
    return [float(x * f) if there else None for x, f, there in zip(low, aside, exists, strict=True)]


def check(
    p: dict[str, float], lam: float, sigma: float, found: Intervals, counts: Counter[str], ratios: list[float]
) -> None:
    """Compare one machine's intervals, and count."""
    counts["machines"] += 1
    number, marginal = int(found.number), bool(found.marginal[0])
    counts["marginal"] += marginal
    try:
        exact = truth(p, lam, sigma)
    except ValueError:
        counts["beyond 400 bits"] += 1
        counts["beyond 400 bits and not marginal"] += not marginal
        return
    kinds = [(KINDS[found.lower[i]], KINDS[found.upper[i]]) for i in range(number)]
    if kinds != [(lower, upper) for _, lower, _, upper in exact]:
        counts["wrong structure, marginal" if marginal else "WRONG STRUCTURE"] += 1
        if not marginal:
            print("wrong structure:", kinds, lam, sigma, p, flush=True)
        return
    for i, (low, lower, high, upper) in enumerate(exact):
        ends = (found.V1[i], found.V1_error[i], low, lower), (found.V2[i], found.V2_error[i], high, upper)
        for V, error, right, kind in ends:
            if kind not in ("weave", "capsize"):
                counts["OUTSIDE"] += not (error == 0 and (V == 0 if kind == "rest" else np.isinf(V)))
                continue
            counts["ends"] += 1
            off = abs(arb(float(V)) - right)
            if not off <= arb(float(error)):
                counts["OUTSIDE"] += 1
                print("outside:", V, error, off, lam, sigma, p, flush=True)
            if off > 0:
                ratios.append(float(error) / float(off.mid()))
            if not off <= 2 * EPS * right:  # κ is never below one half: V² is proportional to lengths and g
                counts["ends of which κ was needed"] += 1
                too_far = not off <= 4 * EPS * kappa(p, lam, sigma, right, kind) * right
                counts["beyond 4 ε κ, marginal" if marginal else "BEYOND 4 ε κ"] += too_far
                if too_far and not marginal:
                    print("beyond:", V, error, off, lam, sigma, p, flush=True)


def run(number: int, seed: int) -> tuple[Counter[str], list[float]]:
    """Check so many machines."""
    ctx.prec = BITS
    rng = random.Random(seed)
    counts: Counter[str] = Counter({"WRONG STRUCTURE": 0, "OUTSIDE": 0, "BEYOND 4 ε κ": 0})
    ratios: list[float] = []
    while counts["machines"] < number:
        drawn = [random_machine(rng) for _ in range(min(BATCH, 2 + number - counts["machines"]))]
        machines, lam, sigma = (list(each) for each in zip(*drawn, strict=True))
        half = len(machines) // 2
        beside = beside_changes(machines[:half], np.array(lam[:half]), rng)
        sigma[:half] = [own if other is None else other for own, other in zip(sigma, beside, strict=False)]
        counts["beside a change"] += sum(other is not None for other in beside)
        found = intervals_of(exact_table(together(machines), lam, sigma))
        for i, p in enumerate(machines):
            check(
                p,
                lam[i],
                sigma[i],
                Intervals(*(field[i] for field in found.arrays().values())),
                counts,
                ratios,
            )
        print(dict(counts), flush=True)
    return counts, ratios


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--number", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    counts, ratios = run(asked.number, asked.seed)
    print("\n".join(f"{name}: {count}" for name, count in counts.items()))
    print(f"bound / error, median: {median(ratios):.6g}")
