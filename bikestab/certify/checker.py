"""Check a certificate of stability, slowly and plainly: ``python checker.py FILE``.

It shares nothing with what wrote it: fractions, the equations of Dikarev, Dikareva and Fufaev (1981) summed
over bodies, and blocks cut into parts on which values, slopes and their products prove the conditions' signs.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import sys
from fractions import Fraction as F
from functools import partial
from math import factorial, inf, prod
from pathlib import Path
from typing import Any

STABLE, UNSTABLE, MOST_CELLS, MOST_VARIED, MOST_PARTS = 1, 2, 10**7, 12, 1000
# bodies behind, in front: mass, forward, up, Ixx, Izz, ∫ x h dm; what else there is; what is not used
REAR = ["mR 0 rR IRxx IRxx 0", "mB xB -zB IBxx IBzz IBxz"]
REAR += ["rider.m rider.x -rider.z rider.Ixx rider.Izz rider.Ixz"]
FRONT, UNUSED = ["mH xH -zH IHxx IHzz IHxz", "mF w rF IFxx IFxx 0"], "c lam IByy IHyy rider.Iyy"
FOUR = [REAR, FRONT, ["w g delta IRyy rR IFyy rF"], [UNUSED, "rider.inertia_mass"]]
TWO = [["m1 l1 h1 A1 B1 D1"], ["m2 l2 h2 A2 B2 -D2"], ["c g delta C1 R1 C2 R2"], ["0"]]
Box = list[tuple[F, F]]
FIXED = "rider.inertia_mass"  # the mass at which a rider has the given inertia


class Refuted(ValueError):
    """What a certificate says does not hold."""


class Near:
    """All numbers within ``rest`` of ``middle`` + Σ slopes e, for each choice of every e from −1 to 1."""

    def __init__(self, middle: F, slopes: list[F], rest: F) -> None:
        self.middle, self.slopes, self.rest, self.reach = middle, slopes, rest, sum(map(abs, slopes), F())

    def __add__(self, other: Near) -> Near:
        slopes = [x + y for x, y in zip(self.slopes, other.slopes, strict=True)]
        return Near(self.middle + other.middle, slopes, self.rest + other.rest)

    def __mul__(self, other: Any) -> Near:
        if not isinstance(other, Near):
            return Near(self.middle * other, [x * other for x in self.slopes], self.rest * abs(other))
        a, b, pairs = self.middle, other.middle, list(zip(self.slopes, other.slopes, strict=True))
        squares = [x * y / 2 for x, y in pairs]  # of e² from 0 to 1
        rest = self.reach * other.reach - sum(map(abs, squares))
        rest += (abs(a) + self.reach) * other.rest + (abs(b) + other.reach + other.rest) * self.rest
        return Near(a * b + sum(squares), [a * y + b * x for x, y in pairs], rest)

    def __sub__(self, other: Near) -> Near:
        return self + other * -1

    def positive(self) -> bool:
        return self.middle - self.reach > self.rest


def parts_of(n: dict[str, Near], names: list[list[str]]) -> list[list[list[Near]]]:
    """The numbers of the bodies behind and in front, and what else there is; no rider where none is."""
    signed = n | {f"-{name}": x * -1 for name, x in n.items()}
    parts = [[[signed[x] for x in b.split()] for b in part if b.split()[0] in n] for part in names[:3]]
    if FIXED in n:
        parts[0][2][3:] = [n["rider.m"] * x * (1 / n[FIXED].middle) for x in parts[0][2][3:]]
    return parts


def conditions(n: dict[str, Near], box: list[Near], four: bool, refined: bool, damped: bool) -> list[Near]:
    """p0 … p4 and hurwitz3, times what is positive, and over powers of V; ``box``: 1, sin λ, cos λ, σ, V."""
    rear, front, ((c, g, delta, C1, R1, C2, R2),) = parts_of(n, FOUR if four else TWO)
    one, sin, cos, sigma, V = box
    v = V if damped else one  # else p1 and p3 are over V, and hurwitz3 over its square
    R1, R2 = (R if C.middle or C.reach else one for R, C in [(R1, C1), (R2, C2)])  # skates have none
    mu, zero, bodies = sigma * cos, one * 0, rear + front  # mu: c1/c
    least = [x.middle - x.reach for x in (delta, C1, C2, *(b[i] for b in bodies for i in (0, 3, 4)))]
    if min(least) < 0 or not all(x.positive() for x in (c, g, R1, R2)):
        raise Refuted("numbers of a block are no machine's: masses, lengths or inertias below or at zero")
    R, C1, C2 = R1 * R2, C1 * R2, C2 * R1  # all is times R1 R2, so that C1/R1 and C2/R2 need no division
    h, l_ = (sum((b[0] * b[i] for b in bodies), zero) for i in (2, 1))
    moments = ((2, 2, 3), (1, 1, 4), (1, 2, 5))
    J1, J2, J12 = (sum((b[0] * b[i] * b[j] + b[k] for b in bodies), zero) for i, j, k in moments)
    J = J3 = J4 = m2d = zero
    for m, x, up, xx, zz, xz in front:
        md = m * (d := up * sin + (x - c) * cos - mu * c)
        m2d, J = m2d + md, J + md * d + xx * sin * sin + xz * sin * cos * 2 + zz * cos * cos
        J3, J4 = J3 + md * up + xx * sin + xz * cos, J4 + md * x + xz * sin + zz * cos
    turn = m2d + l_ * mu
    S, spin = turn if refined else m2d, C1 + C2
    a0, a1, a2 = R * c * J1, R * c * g * h, R * c * (J3 + mu * J12)
    a3 = cos * (R * J12 + c * C2) + mu * c * (R * h + spin)
    a4, a5 = R * c * g * S, cos * (R * h + spin)
    b0, b1 = R * c * (J + mu * J4 * 2 + mu * mu * J2), R * J4 * cos + R * mu * (c * turn + J2 * cos)
    b2, b3, b5 = cos * (R * turn + C2 * sin), R * c * g * S * sin, c * (C2 * cos + mu * spin)
    turning = v * b1 + R * c * delta  # b1 V of (1.5), with its damping
    p4, p3 = a0 * b0 - a2 * a2, a0 * turning + v * (a2 * b5 - a3 * a2)
    p2 = V * V * (a0 * b2 + a3 * b5 - a5 * a2) - (a0 * b3 + a1 * b0 - a2 * a4 - a4 * a2)
    p1 = V * V * v * a5 * b5 - (a1 * turning + v * (a4 * b5 - a3 * a4))
    p0 = V * V * (a5 * a4 - a1 * b2) + (a1 * b3 - a4 * a4)
    return [p0, p1, p2, p3, p4, p1 * (p2 * p3 - p4 * p1) - p0 * p3 * p3]


class Machine:
    """The machine of a certificate, with what is varied, whose conditions are bounded on boxes."""

    def __init__(self, certificate: dict[str, Any]) -> None:
        told = json.dumps({**certificate, "sha256": ""}, sort_keys=True)
        if hashlib.sha256(told.encode()).hexdigest() != certificate["sha256"]:
            raise Refuted("something in it was changed: sha256 is not that of its numbers and blocks")
        self.four = {"two parts": False, "four bodies": True}[certificate["notation"]]
        self.refined = {"unrefined": False, "refined": True}[certificate["model"]]
        names = " ".join(itertools.chain(*(FOUR if self.four else TWO))).replace("-", "").split()
        self.varied = certificate["varied"]
        numbers = {"g": (9.81).hex(), "delta": "0x0p0", **certificate["machine"], "0": "0x0p0"}
        if not {*self.varied} <= {*numbers} - {FIXED, "0"} or not {*numbers} <= {*names}:
            raise Refuted(f"the block of numbers, or what is varied, has others than {', '.join(names)}")
        self.numbers = {key: F(float.fromhex(text)) for key, text in numbers.items()}
        if not self.numbers.get(FIXED, 1) or not len({*self.varied}) == len(self.varied) <= MOST_VARIED:
            raise Refuted(f"{FIXED} is zero, or more than {MOST_VARIED} are varied, or one of them twice")
        self.damped = bool(self.numbers["delta"]) or "delta" in self.varied

    def conditions(self, box: Box) -> list[Near]:
        """The six conditions on a box of tan(λ/2), σ, V and what varies; e is ∓1 at ends of sides."""

        def along(axis: int, middle: F, slope: F = F(), rest: F = F()) -> Near:
            return Near(middle, [slope * (i == axis) for i in range(len(box))], rest)

        (t, r), *_ = spans = [((a + b) / 2, (b - a) / 2) for a, b in box]
        values = 2 * t / (s := 1 + t * t), 2 * (1 - t * t) / s**2 * r, (1 - t * t) / s, -4 * t / s**2 * r
        places = [F(round(x * 2**80), 2**80) for x in values]
        sin = along(0, places[0], places[1], 3 * r * r / 2 + F(1, 2**80))  # |sin''| < 3, |cos''| ≤ 4, by t
        cos = along(0, places[2], places[3], 2 * r * r + F(1, 2**80))
        numbers = {key: along(0, a) for key, a in self.numbers.items()}
        numbers |= {key: along(3 + i, *spans[3 + i]) for i, key in enumerate(self.varied)}
        variables = [along(0, F(1)), sin, cos, along(1, *spans[1]), along(2, *spans[2])]
        return conditions(numbers, variables, self.four, self.refined, self.damped)

    def holds(self, box: Box, verdict: int) -> bool:
        """Whether the conditions have the right signs on all parts of a box."""
        for part in (parts := [box]):
            found = self.conditions(part)
            if not right(found, verdict):
                middle = [((a + b) / 2,) * 2 for a, b in part]
                if len(parts) > MOST_PARTS or not right(self.conditions(middle), verdict):
                    return False
                i = min(range(len(part)), key=partial(self.width, part, middle, found))
                halves = (part[i][0], middle[i][0]), (middle[i][0], part[i][1])
                parts += [[*part[:i], half, *part[i + 1 :]] for half in halves]
        return True

    def width(self, part: Box, middle: Box, found: list[Near], i: int) -> F:
        """How wide bounds not decided, now ``found``, would be with side i reduced to its middle."""
        sides = self.conditions([*part[:i], middle[i], *part[i + 1 :]])
        pairs = [(x, y) for x, y in zip(sides, found, strict=True) if not y.positive()]
        return sum(((x.reach + x.rest) / (y.reach + y.rest or 1) for x, y in pairs), F())


def right(found: list[Near], verdict: int) -> bool:
    """Whether bounds of the conditions have the signs that a verdict says."""
    if verdict == STABLE:
        return all(x.positive() for x in found)
    return verdict == UNSTABLE and found[4].positive() and any((x * -1).positive() for x in found)


def half_angle(lam: float, up: bool) -> F:
    """A fraction above or below tan(λ/2), nearer than 2^−78, from the series of sine and cosine."""
    terms = [F(lam) ** k / factorial(k) * (-1) ** (k // 2) for k in range(40)]
    value = sum(terms[1::2]) / (1 + sum(terms[::2]))
    return F() if lam == 0 else F(round(value * 2**80) + (1 if up else -1), 2**80)


def check(certificate: dict[str, Any], tell: Any = lambda cells: None) -> str:
    """The share of the cells that is proved; Refuted where it does not hold, others where it is none."""
    machine = Machine(certificate)
    edges = [[float.fromhex(text) for text in axis] for axis in certificate["edges"]]
    total = prod(len(axis) - 1 for axis in edges)
    ascend = all(-inf < a <= b < inf for axis in edges for a, b in itertools.pairwise(axis))
    if not ascend or total > MOST_CELLS or max(map(abs, edges[0])) > 1.57 or edges[2][0] < 0:
        raise Refuted("edges of blocks do not ascend, are too many, tilt beyond 1.57 or have speeds below 0")
    seen: set[tuple[int, ...]] = set()
    for ends, verdict in certificate["blocks"]:
        inside = all(0 <= a < b < len(axis) for (a, b), axis in zip(ends, edges, strict=True))
        cells = set(itertools.product(*itertools.starmap(range, ends))) if inside else seen
        if cells & seen or not inside:
            raise Refuted(f"block {ends} overlaps another one or leaves the box")
        seen |= cells
        low, high = ([axis[e[side]] for e, axis in zip(ends, edges, strict=True)] for side in (0, 1))
        box = [(half_angle(low[0], False), half_angle(high[0], True))]
        box += [(F(a), F(b)) for a, b in zip(low[1:], high[1:], strict=True)]
        if (verdict == STABLE and low[2] == 0 and not machine.damped) or not machine.holds(box, verdict):
            raise Refuted(f"block {ends} is not proved: verdict {verdict}")
        tell(len(seen))
    number = len(certificate["blocks"])
    return f"{number} block{' holds' if number == 1 else 's hold'}, {len(seen)} of {total} cells"


if __name__ == "__main__":
    sys.excepthook = lambda _, error, __: sys.stderr.write(f"{' '.join(sys.argv[1:])}: {error!r}\n")
    sys.stdout.write(check(json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))) + "\n")
