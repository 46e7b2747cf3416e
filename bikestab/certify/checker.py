"""Check a certificate of stability, slowly and plainly: ``python checker.py FILE``.

It shares nothing with the program that wrote it. All numbers are fractions; the equations of motion are
those of Dikarev, Dikareva and Fufaev (1981), with sums over the rigid bodies in place of two parts; a block
is right if on it all Bernstein coefficients of the conditions have the sign that its verdict says.
"""

from __future__ import annotations

import itertools
import json
import sys
from fractions import Fraction as F
from math import comb, inf, prod
from pathlib import Path
from typing import Any

STABLE, UNSTABLE, MOST, MOST_VARIED = 1, 2, 10**7, 2
TWO = "c g delta m1 l1 h1 A1 B1 D1 C1 R1 m2 l2 h2 A2 B2 D2 C2 R2"
FOUR = "w c lam g delta rR mR IRxx IRyy xB zB mB IBxx IByy IBzz IBxz xH zH mH IHxx IHyy IHzz IHxz rF mF"
FOUR += " IFxx IFyy rider.m rider.x rider.z rider.Ixx rider.Iyy rider.Izz rider.Ixz rider.inertia_mass"
Poly = dict[tuple[int, ...], F]  # coefficients by the powers of sin, cos, σ, V and what varies

Bodies = list[tuple[Poly, ...]]  # mass, forward, up, Ixx, Izz, ∫ x h dm


class Refuted(ValueError):
    """What a certificate says does not hold."""


def times(*factors: Poly) -> Poly:
    total = factors[0]
    for factor in factors[1:]:
        product: Poly = {}
        for (p, a), (q, b) in itertools.product(total.items(), factor.items()):
            powers = tuple(map(sum, zip(p, q, strict=True)))
            product[powers] = product.get(powers, F()) + a * b
        total = product
    return total


def plus(*terms: Poly) -> Poly:
    total: Poly = {}
    for term in terms:
        for powers, a in term.items():
            total[powers] = total.get(powers, F()) + a
    return {powers: a for powers, a in total.items() if a}


def by(factor: int, poly: Poly) -> Poly:
    return {powers: factor * a for powers, a in poly.items()}


def minus(a: Poly, b: Poly) -> Poly:
    return plus(a, by(-1, b))


def bodies_of(n: dict[str, Poly], four: bool) -> tuple[list[Bodies], dict[str, Poly]]:
    """The bodies of the rear and the front part, and what else there is, by name."""
    if not four:
        rear: Bodies = [(n["m1"], n["l1"], n["h1"], n["A1"], n["B1"], n["D1"])]
        front: Bodies = [(n["m2"], n["l2"], n["h2"], n["A2"], n["B2"], by(-1, n["D2"]))]
        return [rear, front], {key: n[key] for key in ("c", "g", "delta", "C1", "R1", "C2", "R2")}
    zero = by(0, n["g"])
    wheel = (n["mR"], zero, n["rR"], n["IRxx"], n["IRxx"], zero)
    frame = (n["mB"], n["xB"], by(-1, n["zB"]), n["IBxx"], n["IBzz"], n["IBxz"])
    rear = [wheel, frame]
    if "rider.m" in n:
        inertia = [n[f"rider.I{axes}"] for axes in ("xx", "zz", "xz")]
        for a in n.get("rider.inertia_mass", {}).values():  # that of a rider of this mass, which is a number
            inertia = [times(n["rider.m"], {p: b / a for p, b in each.items()}) for each in inertia]
        rear.append((n["rider.m"], n["rider.x"], by(-1, n["rider.z"]), *inertia))
    fork = (n["mH"], n["xH"], by(-1, n["zH"]), n["IHxx"], n["IHzz"], n["IHxz"])
    steered = (n["mF"], n["w"], n["rF"], n["IFxx"], n["IFxx"], zero)
    others = {"c": n["w"], "g": n["g"], "delta": n["delta"], "C1": n["IRyy"], "R1": n["rR"], "C2": n["IFyy"]}
    return [rear, [fork, steered]], {**others, "R2": n["rF"]}


def conditions(machine: dict[str, str], varied: list[str], four: bool, refined: bool) -> list[Poly]:
    """p0 … p4 and hurwitz3, times what is positive."""
    one: Poly = {(0,) * (size := 4 + len(varied)): F(1)}
    sin, cos, sigma, V, *free = ({tuple(int(i == k) for i in range(size)): F(1)} for k in range(size))
    numbers = {"g": (9.81).hex(), "delta": "0x0p0", **machine}
    if set(numbers) - set((FOUR if four else TWO).split()):
        raise Refuted(f"the block of numbers has others than {FOUR if four else TWO}")
    if len(set(varied)) < len(varied) or not {*varied} <= {*numbers}:
        raise Refuted("what is varied is given twice, or is no number of the machine")
    n = {key: {(0,) * size: F(float.fromhex(text))} for key, text in numbers.items()}
    n |= dict(zip(varied, free, strict=True))
    (rear, front), k = bodies_of(n, four)
    c, g = k["c"], k["g"]
    for i in "12":
        k[f"R{i}"] = k[f"R{i}"] if any(k[f"C{i}"].values()) else one
    # everything times R1 R2, so that C1° = C1/R1 and C2° = C2/R2 need no division
    R, C1, C2 = times(k["R1"], k["R2"]), times(k["C1"], k["R2"]), times(k["C2"], k["R1"])
    mu = times(sigma, cos)  # c1/c
    h = plus(*(times(m, up) for m, _, up, *_ in rear + front))
    l_ = plus(*(times(m, x) for m, x, *_ in rear + front))
    J1 = plus(*(plus(times(m, up, up), xx) for m, _, up, xx, *_ in rear + front))
    J2 = plus(*(plus(times(m, x, x), zz) for m, x, _, _, zz, _ in rear + front))
    J12 = plus(*(plus(times(m, x, up), xz) for m, x, up, _, _, xz in rear + front))
    J = J3 = J4 = m2d = by(0, one)
    for m, x, up, xx, zz, xz in front:
        d = minus(plus(times(up, sin), times(minus(x, c), cos)), times(mu, c))
        m2d = plus(m2d, times(m, d))
        J = plus(J, times(m, d, d), times(xx, sin, sin), by(2, times(xz, sin, cos)), times(zz, cos, cos))
        J3 = plus(J3, times(m, up, d), times(xx, sin), times(xz, cos))
        J4 = plus(J4, times(m, x, d), times(xz, sin), times(zz, cos))
    turn = plus(m2d, times(l_, mu))
    S = turn if refined else m2d
    spin = plus(C1, C2)
    a0, a1, a2 = times(R, c, J1), times(R, c, g, h), times(R, c, plus(J3, times(mu, J12)))
    a3 = plus(times(cos, plus(times(R, J12), times(c, C2))), times(mu, c, plus(times(R, h), spin)))
    a4, a5 = times(R, c, g, S), times(cos, plus(times(R, h), spin))
    b0 = times(R, c, plus(J, by(2, times(mu, J4)), times(mu, mu, J2)))
    b1 = plus(times(R, J4, cos), times(R, mu, plus(times(c, turn), times(J2, cos))))
    b2, b3 = times(cos, plus(times(R, turn), times(C2, sin))), times(R, c, g, S, sin)
    b4, b5, b6 = a2, times(c, plus(times(C2, cos), times(mu, spin))), times(R, c, g, S)
    damped = plus(times(V, b1), times(R, c, k["delta"]))  # b1 V of (1.5), with its damping
    p4 = minus(times(a0, b0), times(a2, b4))
    p3 = plus(times(a0, damped), times(V, minus(times(a2, b5), times(a3, b4))))
    p2 = minus(
        times(V, V, minus(plus(times(a0, b2), times(a3, b5)), times(a5, b4))),
        minus(plus(times(a0, b3), times(a1, b0)), plus(times(a2, b6), times(a4, b4))),
    )
    falling = plus(times(a1, damped), times(V, minus(times(a4, b5), times(a3, b6))))
    p1 = minus(times(V, V, V, a5, b5), falling)
    p0 = plus(times(V, V, minus(times(a5, b6), times(a1, b2))), minus(times(a1, b3), times(a4, b6)))
    hurwitz3 = minus(times(p1, minus(times(p2, p3), times(p4, p1))), times(p0, p3, p3))
    return [p0, p1, p2, p3, p4, hurwitz3]


def in_half_angle(side: Poly) -> tuple[Poly, int, bool]:
    """Variables t = tan(λ/2), σ, V or V² …, times a power of 1 + t², over V^least; V's power; least > 0."""
    degree, least = max(p[0] + p[1] for p in side), min(p[3] for p in side)
    power = 1 if any((p[3] - least) % 2 for p in side) else 2
    size = len(next(iter(side))) - 1
    one = {(0,) * size: F(1)}
    t = {(1,) + (0,) * (size - 1): F(1)}
    plus_, minus_ = plus(one, times(t, t)), minus(one, times(t, t))
    groups: dict[tuple[int, int], Poly] = {}
    for (s, k, sigma, speed, *others), a in side.items():
        groups.setdefault((s, k), {})[s, sigma, (speed - least) // power, *others] = a * 2**s
    terms = [
        times(group, times(one, *[minus_] * k, *[plus_] * (degree - s - k)))
        for (s, k), group in groups.items()
    ]
    return plus(*terms), power, least > 0


def coefficients(poly: Poly, box: list[tuple[F, F]]) -> list[F]:
    """All Bernstein coefficients of a polynomial on a box, one axis after the other."""
    for axis, (low, high) in enumerate(box):
        degree = max(p[axis] for p in poly)
        rows = []  # Σ_k x^k/comb(degree, k) [z^k] (1 + high z)^i (1 + low z)^(degree − i)
        for i in range(degree + 1):
            row = [F(1)] + [F()] * degree
            for end in [high] * i + [low] * (degree - i):
                row = [row[0]] + [row[k] + end * row[k - 1] for k in range(1, degree + 1)]
            rows.append([row[k] / comb(degree, k) for k in range(degree + 1)])
        out: Poly = {}
        for powers, a in poly.items():
            for i, row in enumerate(rows):
                at = (*powers[:axis], i, *powers[axis + 1 :])
                out[at] = out.get(at, F()) + row[powers[axis]] * a
        poly = out
    return list(poly.values())


def half_angle(lam: float, up: bool) -> F:
    """A fraction above or below tan(λ/2), nearer than 2^−78, from the series of sine and cosine."""
    x = F(lam)
    sin = cos = F()
    term = F(1)
    for k in range(40):
        sin, cos = (sin + (-1) ** (k // 2) * term, cos) if k % 2 else (sin, cos + (-1) ** (k // 2) * term)
        term = term * x / (k + 1)
    value = sin / (1 + cos)
    return F() if lam == 0 else F(round(value * 2**80) + (1 if up else -1), 2**80)


def check(certificate: dict[str, Any]) -> str:
    """The share of the cells that is proved; raises Refuted where that does not hold, others where it is no
    certificate.
    """
    if len(certificate["varied"]) > MOST_VARIED:
        raise Refuted(f"more than {MOST_VARIED} numbers are varied")
    four = ["two parts", "four bodies"].index(certificate["notation"]) == 1
    sides = conditions(certificate["machine"], certificate["varied"], four, certificate["model"] == "refined")
    halves = [in_half_angle(side) for side in sides]
    edges = [[float.fromhex(text) for text in axis] for axis in certificate["edges"]]
    total = prod(len(axis) - 1 for axis in edges)
    if total > MOST or any(not (-inf < a <= b < inf) for axis in edges for a, b in itertools.pairwise(axis)):
        raise Refuted("the edges of blocks do not ascend, or are too many")
    if not (-1.57 < edges[0][0] <= edges[0][-1] < 1.57 and edges[2][0] >= 0):
        raise Refuted("blocks have tilts that do not meet the ground, or negative speeds")
    seen: set[tuple[int, ...]] = set()
    for ends, verdict in certificate["blocks"]:
        inside = all(0 <= a < b < len(axis) for (a, b), axis in zip(ends, edges, strict=True))
        cells = set(itertools.product(*(range(a, b) for a, b in ends))) if inside else set()
        if not inside or cells & seen:
            raise Refuted(f"block {ends} overlaps another one or leaves the box")
        seen |= cells
        low, high = ([axis[e[side]] for e, axis in zip(ends, edges, strict=True)] for side in (0, 1))
        box = [(half_angle(low[0], False), half_angle(high[0], True))]
        box += [(F(a), F(b)) for a, b in zip(low[1:], high[1:], strict=True)]
        signs = []
        for poly, power, _ in halves:
            speeds = (F(low[2]) ** power, F(high[2]) ** power)
            signs.append(coefficients(poly, [*box[:2], speeds, *box[3:]]))
        at_rest = low[2] == 0 and any(rest for *_, rest in halves)
        right = {STABLE: all(min(values) > 0 for values in signs) and not at_rest}
        right[UNSTABLE] = min(signs[4]) > 0 and any(max(values) < 0 for values in signs)
        if not right.get(verdict):
            raise Refuted(f"block {ends} is not proved: verdict {verdict}")
    return f"{len(certificate['blocks'])} blocks hold, {len(seen)} of {total} cells"


if __name__ == "__main__":
    sys.stdout.write(check(json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))) + "\n")
