"""Stable speeds in 40-digit arithmetic, from the equations of docs/theory.md: writes speeds.json.

Nothing of bikestab is used. The characteristic polynomial is the determinant of the equations of
motion (1.5), a stretch of speeds is stable where the eigenvalues say so, not the Hurwitz conditions.
Run ``python tests/references/generate_speeds.py`` to write the file anew.
"""

from __future__ import annotations

import json
import math
import random
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from mpmath import mp, mpf

FILE = Path(__file__).with_name("speeds.json")
DIGITS = 40

PAPER = {
    "R": 0.35, "c": 1.04, "g": 9.8, "m1": 80, "l1": 0.4, "h1": 0.9, "A1": 3.3, "B1": 6.7, "C1": 0.5,
    "m2": 2.7, "l2": 0.9, "h2": 0.5, "A2": 0.036, "B2": 0.22, "C2": 0.5,
}  # fmt: skip
BENCHMARK = {
    "w": 1.02, "c": 0.08, "lam": math.pi / 10, "g": 9.81, "rR": 0.3, "mR": 2, "IRxx": 0.0603, "IRyy": 0.12,
    "xB": 0.3, "zB": -0.9, "mB": 85, "IBxx": 9.2, "IByy": 11, "IBzz": 2.8, "IBxz": 2.4,
    "xH": 0.9, "zH": -0.7, "mH": 4, "IHxx": 0.05892, "IHyy": 0.06, "IHzz": 0.00708, "IHxz": -0.00756,
    "rF": 0.35, "mF": 3, "IFxx": 0.1405, "IFyy": 0.28,
}  # fmt: skip

SKATES = {
    "w": 1, "c": 0, "lam": math.pi / 36, "g": 9.81, "xB": 1.2, "zB": -0.4, "mB": 10, "xH": 1.02, "zH": -0.2,
    "mH": 1, "rR": 0, "mR": 0, "IRxx": 0, "IRyy": 0, "rF": 0, "mF": 0, "IFxx": 0, "IFyy": 0,
    "IBxx": 0, "IBzz": 0, "IBxz": 0, "IHxx": 0, "IHzz": 0, "IHxz": 0,
}  # fmt: skip
MOTORCYCLE = {
    "c": 1.414332, "g": 9.81, "m1": 217.4492, "l1": 0.4797552, "h1": 0.615696, "A1": 31.18381, "B1": 21.06941,
    "D1": -1.735447, "C1": 1.050759, "R1": 0.3048, "m2": 30.6472, "l2": 1.359504, "h2": 0.4164403,
    "A2": 1.070599, "B2": 0.605192, "D2": 0.3202889, "C2": 0.7185835, "R2": 0.3048,
}  # fmt: skip
RAKE, TRAIL, DAMPER = 27 * math.pi / 180, 0.1299923 / 1.414332, 6.77909  # Sharp's own


class Sum:
    """A number with the summed absolute values of the terms that formed it, for its conditioning."""

    def __init__(self, value: Any, size: Any = None) -> None:
        self.value, self.size = mpf(value), abs(mpf(value)) if size is None else size

    def __add__(self, other: Any) -> Sum:
        other = other if isinstance(other, Sum) else Sum(other)
        return Sum(self.value + other.value, self.size + other.size)

    def __mul__(self, other: Any) -> Sum:
        other = other if isinstance(other, Sum) else Sum(other)
        return Sum(self.value * other.value, self.size * other.size)

    def __sub__(self, other: Any) -> Sum:
        return self + other * -1 if isinstance(other, Sum) else self + Sum(-other)

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self) -> Sum:
        return self * -1

    def __truediv__(self, other: Any) -> Sum:
        return Sum(self.value / other, self.size / abs(other))


Polynomial = dict[Any, Sum]  # exponent, or (exponent of s, exponent of V) → coefficient


def two_parts(machine: dict[str, float]) -> dict[str, Any]:
    """The paper's parameters of a machine in either notation."""
    n = {key: mpf(value) for key, value in machine.items()}
    if "w" not in n:
        radius = n.get("R")
        return {"D1": mpf(0), "D2": mpf(0), "R1": radius, "R2": radius, **n}
    p = {"c": n["w"], "g": n["g"], "C1": n["IRyy"], "R1": n["rR"], "C2": n["IFyy"], "R2": n["rF"]}
    rear = "R", mpf(0), n["rR"], n["IRxx"], n["IRxx"], 0
    body = "B", n["xB"], -n["zB"], n["IBxx"], n["IBzz"], n["IBxz"]
    fork = "H", n["xH"], -n["zH"], n["IHxx"], n["IHzz"], n["IHxz"]
    front = "F", n["w"], n["rF"], n["IFxx"], n["IFxx"], 0
    for i, pair in (("1", (rear, body)), ("2", (fork, front))):
        mass = sum(n["m" + name] for name, *_ in pair)
        l = sum(n["m" + name] * x for name, x, *_ in pair) / mass  # noqa: E741  # the paper's letter
        h = sum(n["m" + name] * z for name, _, z, *_ in pair) / mass
        p |= {"m" + i: mass, "l" + i: l, "h" + i: h}
        p["A" + i] = sum(xx + n["m" + name] * (z - h) ** 2 for name, x, z, xx, zz, xz in pair)
        p["B" + i] = sum(zz + n["m" + name] * (x - l) ** 2 for name, x, z, xx, zz, xz in pair)
        p["D" + i] = sum(xz + n["m" + name] * (x - l) * (z - h) for name, x, z, xx, zz, xz in pair)
    p["D2"] *= -1
    return p


def polynomial(machine: dict[str, float], lam: Any, sigma: Any, delta: Any, model: str) -> Polynomial:
    """The characteristic polynomial: {(k, j): coefficient of s^k V^j}."""
    p = {key: Sum(value) for key, value in two_parts(machine).items()}
    c, g = p["c"], p["g"]
    cos, sin = Sum(mp.cos(lam)), Sum(mp.sin(lam))
    A1, B1, D1, m1, l1, h1 = (p[key] for key in ("A1", "B1", "D1", "m1", "l1", "h1"))
    A2, B2, D2, m2, l2, h2 = (p[key] for key in ("A2", "B2", "D2", "m2", "l2", "h2"))
    K1, K2 = (p[C] / p[R].value if p[C].value else Sum(0) for C, R in (("C1", "R1"), ("C2", "R2")))

    c1 = c * Sum(sigma) * cos
    d = h2 * sin + (l2 - c) * cos - c1
    l, h = m1 * l1 + m2 * l2, m1 * h1 + m2 * h2  # noqa: E741  # the paper's letters
    J = m2 * d * d + A2 * sin * sin - 2 * D2 * sin * cos + B2 * cos * cos
    J1, J2 = m1 * h1 * h1 + A1 + m2 * h2 * h2 + A2, m1 * l1 * l1 + B1 + m2 * l2 * l2 + B2
    J3, J4 = m2 * h2 * d + A2 * sin - D2 * cos, m2 * d * l2 - D2 * sin + B2 * cos
    J12 = m1 * h1 * l1 + D1 + m2 * h2 * l2 - D2
    turn = l * c1 / c.value
    S = m2 * d + turn if model == "refined" else m2 * d

    a2 = c * J3 + c1 * J12
    a3 = (J12 + c * K2) * cos + c1 * (h + K1 + K2)
    a4, a5 = c * g * S, (h + K1 + K2) * cos
    b0 = c * J + 2 * c1 * J4 + c1 * c1 * J2 / c.value
    b1 = J4 * cos + c1 * (m2 * d + J2 * cos / c.value + turn)
    b2 = (m2 * d + K2 * sin + turn) * cos
    b5 = c * K2 * cos + c1 * (K1 + K2)

    lean_lean = {(2, 0): c * J1, (0, 0): -(c * g * h)}  # (1.5), lean equation
    lean_steer = {(2, 0): -a2, (1, 1): -a3, (0, 0): a4, (0, 2): -a5}
    steer_lean = {(2, 0): -a2, (1, 1): b5, (0, 0): a4}  # (1.5), steer equation
    steer_steer = {(2, 0): b0, (1, 1): b1, (1, 0): c * Sum(delta), (0, 2): b2, (0, 0): -(a4 * sin)}
    return combine(product(lean_lean, steer_steer), product(lean_steer, steer_lean), -1)


def product(a: Polynomial, b: Polynomial) -> Polynomial:
    out: Polynomial = {}
    for i, x in a.items():
        for j, y in b.items():
            k = tuple(map(sum, zip(i, j, strict=True))) if isinstance(i, tuple) else i + j
            out[k] = out.get(k, Sum(0)) + x * y
    return out


def combine(a: Polynomial, b: Polynomial, sign: int) -> Polynomial:
    return {k: a.get(k, Sum(0)) + b.get(k, Sum(0)) * sign for k in {**a, **b}}


def condition_polynomials(table: Polynomial) -> dict[str, Polynomial]:
    """p0 and hurwitz3, whose zeros bound the stable speeds, as {j: coefficient of V^j}."""
    p0, p1, p2, p3, p4 = ({j: x for (k, j), x in table.items() if k == power} for power in range(5))
    inner = combine(product(p2, p3), product(p4, p1), -1)
    return {"p0": p0, "hurwitz3": combine(product(p1, inner), product(p0, product(p3, p3)), -1)}


def roots(coefficients: list[Any]) -> list[Any]:
    """All roots of c0 + c1 x + …, as eigenvalues of a companion matrix."""
    c = list(coefficients)
    while c and c[-1] == 0:
        c.pop()
    zeros = next((i for i, x in enumerate(c) if x != 0), 0)
    c = c[zeros:]
    n = len(c) - 1
    if n < 1:
        return [mpf(0)] * zeros
    if n == 1:  # some versions of mpmath return something else from a matrix of one entry
        return [mpf(0)] * zeros + [-c[0] / c[1]]
    scale = max(abs(c[k] / c[n]) ** (mpf(1) / (n - k)) for k in range(n))
    matrix = mp.matrix(n, n)
    for k in range(n):
        matrix[k, n - 1] = -c[k] / c[n] / scale ** (n - k)
        if k:
            matrix[k, k - 1] = 1
    return [mpf(0)] * zeros + [x * scale for x in mp.eig(matrix, left=False, right=False)]


def at(poly: Polynomial, V: Any) -> Any:
    return sum((x.value * V**j for j, x in poly.items()), mpf(0))


def condition_number(poly: Polynomial, V: Any) -> Any:
    """How much larger the relative error of a root is than that of the terms that form ``poly``."""
    slope = sum(j * x.value * V**j for j, x in poly.items())
    return sum(x.size * V**j for j, x in poly.items()) / abs(slope)


class Edge(NamedTuple):
    """A critical speed, the condition that is zero there, and its condition number."""

    V: Any
    kind: str
    condition: Any


def critical_speeds(table: Polynomial) -> list[Edge]:
    found = []
    for name, kind in (("p0", "capsize"), ("hurwitz3", "weave")):
        poly = condition_polynomials(table)[name]
        dense = [mpf(0)] * (max(poly) + 1)
        for j, x in poly.items():
            if abs(x.value) > x.size * mpf(10) ** (10 - DIGITS):  # else zero: its terms cancel
                dense[j] = x.value
        real = [mp.re(V) for V in roots(dense) if abs(mp.im(V)) < abs(V) * mpf(10) ** (-DIGITS // 2)]
        found += [Edge(V, kind, condition_number(poly, V)) for V in real if V > 0]
    return sorted(found)


def eigenvalues(table: Polynomial, V: Any) -> list[Any]:
    return roots([at({j: x for (k, j), x in table.items() if k == power}, V) for power in range(5)])


def stable_intervals(table: Polynomial) -> list[tuple[Edge, Edge]]:
    """Every stretch between two critical speeds in which all eigenvalues have a negative real part."""
    edges = [Edge(mpf(0), "rest", mpf(0)), *critical_speeds(table), Edge(mp.inf, "unbounded", mpf(0))]
    stretches = []
    for lower, upper in pairwise(edges):
        inside = (lower.V + upper.V) / 2 if mp.isfinite(upper.V) else 2 * lower.V + 1
        if max(mp.re(s) for s in eigenvalues(table, inside)) < 0:
            stretches.append((lower, upper))
    return stretches


def result(machine: dict[str, float], lam: float, sigma: float, delta: float, model: str) -> list[Any]:
    """The intervals of one case as they stand in the file: V1, lower, κ1, V2, upper, κ2."""
    with mp.workdps(DIGITS):
        found = stable_intervals(polynomial(machine, lam, sigma, delta, model))
        return [[x for edge in pair for x in _rounded(edge)] for pair in found]


def _rounded(edge: Edge) -> tuple[str, str, float]:
    speed = mp.nstr(edge.V, 22).lstrip("+")  # versions of mpmath differ in the sign of infinity
    return speed, edge.kind, float(mp.nstr(edge.condition, 2))


def random_machine(rng: random.Random) -> dict[str, float]:
    """A machine in the paper's notation or in that of Meijaard et al., with short numbers."""

    def between(low: float, high: float) -> float:
        return float(f"{rng.uniform(low, high):.3g}")

    def wheel(m: float, r: float) -> tuple[float, float]:
        spin = float(f"{m * r**2 * rng.uniform(0.5, 0.95):.3g}")
        return spin, float(f"{spin * 0.53:.3g}")

    if rng.random() < 0.5:
        m2, R = between(2, 12), between(0.2, 0.4)
        return {
            "c": between(0.8, 1.5), "R": R, "g": 9.81, "m1": between(20, 200), "l1": between(0.2, 0.6),
            "h1": between(0.5, 1.1), "A1": between(2, 12), "B1": between(2, 12), "D1": between(-1, 2),
            "C1": between(0, 0.2), "m2": m2, "l2": between(0.8, 1.3), "h2": between(0.3, 0.7),
            "A2": between(0.1, 0.5), "B2": between(0.1, 0.4), "D2": between(-0.1, 0.1),
            "C2": between(0, 0.5 * m2 * R**2),
        }  # fmt: skip
    w, mR, mF, rR, rF = (between(*x) for x in ((0.9, 1.5), (1, 10), (1, 10), (0.2, 0.4), (0.2, 0.4)))
    IRyy, IRxx = wheel(mR, rR)
    IFyy, IFxx = wheel(mF, rF)
    IHxx, IHzz = between(0.05, 0.5), between(0.005, 0.2)
    IHxz = float(f"{-0.5 * math.sqrt(IHxx * IHzz):.3g}")
    return {
        "w": w, "c": between(0, 0.15), "lam": between(0, 0.6), "g": 9.81, "rR": rR, "mR": mR, "IRxx": IRxx,
        "IRyy": IRyy, "xB": between(0.2, 0.6), "zB": -between(0.5, 1.1), "mB": between(20, 200),
        "IBxx": between(3, 12), "IBzz": between(2, 10), "IBxz": between(-2, 2), "xH": between(w - 0.3, w),
        "zH": -between(0.4, 0.9), "mH": between(1, 10), "IHxx": IHxx, "IHzz": IHzz, "IHxz": IHxz,
        "rF": rF, "mF": mF, "IFxx": IFxx, "IFyy": IFyy,
    }  # fmt: skip


def cases() -> list[dict[str, Any]]:
    """The questions, without their answers."""
    points = [  # the table of docs/theory.md and its other claims
        (0.20, 0.08, 0), (0.30, 0.10, 0), (0.05, 0.15, 0), (0.015, 0.1475, 0), (0.10, 0.08, 0),
        (0.10, 0.08, 1), (0.04834835, 0.15, 0), (0.20, 0.08, 0.5), (0.0, 0.2, 0),
    ]  # fmt: skip
    own = BENCHMARK["lam"], BENCHMARK["c"] / BENCHMARK["w"]
    found = [("dikarev1981", PAPER, *point, "refined") for point in points]
    found += [("dikarev1981", PAPER, *point, "unrefined") for point in points[:2]]
    found += [("meijaard2007", BENCHMARK, *own, delta, "refined") for delta in (0, 0.5, 2)]
    found += [("meijaard2007", BENCHMARK, *own, 0, "unrefined")]
    found += [("meijaard2007", BENCHMARK, 0.1, 0.05, 0, "refined")]
    rng = random.Random(1981)
    for number in range(22):
        machine = random_machine(rng)
        lam, sigma = float(f"{rng.uniform(0, 0.5):.3g}"), float(f"{rng.uniform(0, 0.15):.3g}")
        delta, model = float(f"{rng.uniform(0.1, 3):.2g}"), rng.choice(["refined", "unrefined"])
        found += [
            (f"random {number}", machine, lam, sigma, *more) for more in ((0, "refined"), (delta, model))
        ]
    found += [("sharp1971", MOTORCYCLE, RAKE, TRAIL, delta, "refined") for delta in (DAMPER, 0)]
    found += [("kooijman2011", SKATES, SKATES["lam"], 0, 0, "refined")]
    keys = ("name", "machine", "lam", "sigma", "delta", "model")
    return [dict(zip(keys, values, strict=True)) for values in found]


if __name__ == "__main__":
    answers = [case | {"intervals": result(*list(case.values())[1:])} for case in cases()]
    lines = ",\n".join(json.dumps(answer) for answer in answers)
    FILE.write_text(f"[\n{lines}\n]\n", encoding="utf-8")
