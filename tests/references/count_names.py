"""How often a mode bears another name than the edge that it makes: over random machines of five kinds.

The eigenvalue that crosses the axis at an end of the stable speeds is found by numpy in the coefficients of
the polynomial, its name by ``modes``. Run ``python -m tests.references.count_names 3000``.
"""

from __future__ import annotations

import math
import random
import sys
from collections import Counter

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import Floats, characteristic_table
from bikestab.modes import follow
from bikestab.speeds import KINDS, intervals_of

# wheelbase, height and place of the rider, masses of wheels, rider and fork
SIZES = {
    "bicycle": ((0.9, 1.2), (0.7, 1.1), (0.2, 0.5), (1, 3), (60, 110), (1, 5)),
    "recumbent": ((1.0, 1.9), (0.3, 0.7), (0.3, 0.8), (1, 3), (60, 130), (1, 5)),
    "motorcycle": ((1.2, 1.7), (0.4, 0.9), (0.3, 0.6), (8, 20), (150, 350), (5, 30)),
    "anything": ((0.7, 1.8), (0.3, 1.5), (0.1, 0.7), (0.5, 15), (10, 250), (0.5, 15)),
}
SPREAD = {
    "bicycle": (0.1, 0.5, 0.01, 0.12),
    "recumbent": (0.0, 0.6, 0.0, 0.2),
    "motorcycle": (0.3, 0.6, 0.03, 0.15),
}


def machine(kind: str, rng: random.Random) -> dict[str, float]:
    """A random machine in the notation of Meijaard et al. (2007)."""
    if kind == "skates":
        return skates(rng)
    w, zB, xB, mW, mB, mH = (rng.uniform(*limits) for limits in SIZES[kind])
    lam, more_lam, trail, more_trail = SPREAD.get(kind, (-0.2, 0.9, -0.1, 0.5))
    n = {"w": w, "c": w * rng.uniform(trail, more_trail), "lam": rng.uniform(lam, more_lam), "g": 9.81}
    n |= {
        "xB": w * xB,
        "zB": -zB,
        "mB": mB,
        "xH": w * rng.uniform(0.7, 1.1),
        "zH": -rng.uniform(0.2, 1),
        "mH": mH,
    }
    for wheel in "RF":
        r, m = rng.uniform(0.15, 0.4), mW * rng.uniform(0.8, 1.2)
        spin = m * r * r * rng.uniform(0.5, 1)
        n |= {f"r{wheel}": r, f"m{wheel}": m, f"I{wheel}xx": 0.55 * spin, f"I{wheel}yy": spin}
    for part, m, size in (("B", mB, 0.4), ("H", mH, 0.25)):
        xx, zz = (m * (size * rng.uniform(0.2, 1)) ** 2 for _ in range(2))
        n |= {f"I{part}xx": xx, f"I{part}zz": zz, f"I{part}xz": rng.uniform(-0.9, 0.9) * math.sqrt(xx * zz)}
    return n


def skates(rng: random.Random) -> dict[str, float]:
    """Two masses on skates, as in Kooijman et al. (2011)."""
    n = dict.fromkeys(
        [
            "rR",
            "mR",
            "IRxx",
            "IRyy",
            "rF",
            "mF",
            "IFxx",
            "IFyy",
            "IBxx",
            "IBzz",
            "IBxz",
            "IHxx",
            "IHzz",
            "IHxz",
        ],
        0.0,
    )
    n |= {"w": 1, "c": rng.uniform(-0.05, 0.05), "lam": rng.uniform(-0.1, 0.2), "g": 9.81}
    n |= {"xB": rng.uniform(0.5, 1.4), "zB": -rng.uniform(0.2, 0.8), "mB": rng.uniform(3, 30)}
    return n | {"xH": rng.uniform(0.9, 1.15), "zH": -rng.uniform(0.1, 0.4), "mH": rng.uniform(0.3, 3)}


def tables(number: int, seed: int = 1) -> list[tuple[str, Floats]]:
    """Tables of random machines, every second one with a damper."""
    rng = random.Random(seed)
    out = []
    for i in range(number):
        kind = (*SIZES, "skates")[i % 5]
        bicycle = Bicycle.from_mapping(machine(kind, rng))
        damped = bicycle.with_delta(10 ** rng.uniform(-3, 1)) if rng.random() < 0.5 else bicycle
        out.append((kind, characteristic_table(damped, bicycle.lam, bicycle.sigma)))
    return out


def ends(table: Floats) -> list[tuple[float, str]]:
    """The speeds at which weave or capsize begins, and which of them."""
    intervals = intervals_of(table)
    every = [
        *zip(intervals.V1, intervals.lower, strict=True),
        *zip(intervals.V2, intervals.upper, strict=True),
    ]
    return [(float(V), KINDS[kind]) for V, kind in every if KINDS[kind] in ("weave", "capsize")]


def name_of_crossing(table: Floats, V: float, kind: str) -> str:
    """The name of the eigenvalue that crosses the imaginary axis at V, with or without oscillating."""
    s = np.roots((table @ V ** np.arange(4))[::-1])
    s = s[s.imag > 0] if kind == "weave" else s[s.imag == 0]
    crossing = s[np.argmin(np.abs(s.real))]
    modes = follow(table, V)
    return str(modes.names[np.argmin(np.abs(modes.eigenvalues[:, 0] - crossing)), 0])


def count(number: int) -> Counter[tuple[str, str, str]]:
    """For each kind of machine and of end, the names of what crosses there."""
    found: Counter[tuple[str, str, str]] = Counter()
    for kind, table in tables(number):
        for V, edge in ends(table):
            found[kind, edge, name_of_crossing(table, V, edge)] += 1
    return found


if __name__ == "__main__":
    for (kind, edge, name), times in sorted(count(int(sys.argv[1])).items()):
        print(f"{kind:12} {edge:8} called {name:10} {times:6}")
