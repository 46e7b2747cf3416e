"""Random machines at the limits of what is allowed, through every way to an answer: nothing may break.

``python -m tests.references.run_extremes 20000`` counts, over that many machines, tracebacks, warnings and
messages that ask for a report; the seed of each is printed. A machine gets an answer or one clear message.
"""

from __future__ import annotations

import math
import sys
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.design.best import best_designs
from bikestab.design.criteria import Wanted
from bikestab.errors import BikestabError
from bikestab.family import Family
from bikestab.region.answers import stable_speeds
from bikestab.region.curves import trace
from bikestab.stability import modes

SPEEDS = [0.0, 0.5, 5.0, 20.0]
EVERY = {"speeds": 1, "vrange": 10, "eigen": 5, "trace": 500, "design": 5000}  # by how long they take


def machine(rng: np.random.Generator) -> tuple[dict[str, float], float, float]:
    """Parameters in either notation, tilt and trail; from ordinary ones to those at the limits."""
    reach = 9 * rng.uniform() ** 0.5

    def size(typical: float) -> float:
        value = typical * 10 ** rng.uniform(-reach, reach)
        return float(np.clip(value, 1e-9, 1e9)) if rng.uniform() < 0.9 else typical

    def either(typical: float) -> float:
        return float(size(typical) * rng.choice([-1, 1, 1]))

    def product(a: float, b: float) -> float:
        return float(rng.choice([0.0, rng.uniform(-0.999, 0.999)]) * math.sqrt(a * b))

    lam, sigma = rng.uniform(-1.4, 1.4), either(0.1)
    sigma = float(np.clip(sigma, -100, 100))
    delta = float(rng.choice([0.0, min(10 ** rng.uniform(-12, 6), 1e6)]))
    if rng.uniform() < 0.5:
        n = {"c": size(1.0), "g": size(9.81), "delta": delta}
        for i in "12":
            n |= {"m" + i: size(10.0), "l" + i: either(0.5), "h" + i: either(0.5), "A" + i: size(1.0)}
            n |= {"B" + i: size(1.0), "C" + i: size(0.1), "R" + i: size(0.3)}
            n["D" + i] = product(n["A" + i], n["B" + i])
            if rng.uniform() < 0.1:  # a skate
                n["C" + i] = n["R" + i] = 0.0
        return n, lam, sigma
    w = size(1.0)
    n = {"w": w, "c": sigma * w, "lam": lam, "g": size(9.81), "delta": delta}
    for i in "RF":
        n |= {"r" + i: size(0.3), "m" + i: size(3.0), f"I{i}xx": size(0.1), f"I{i}yy": size(0.2)}
    for i in "BH":
        n |= {"x" + i: either(0.5), "z" + i: -either(0.7), "m" + i: size(10.0)}
        n |= {f"I{i}xx": size(1.0), f"I{i}zz": size(1.0)}
        n[f"I{i}xz"] = product(n[f"I{i}xx"], n[f"I{i}zz"])
    return n, lam, sigma


def outcome(action: Callable[[], Any]) -> tuple[str, str]:
    """What became of it: ``answer``, ``message``, ``warning``, ``report`` or ``traceback``; and its text."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            action()
        except BikestabError as error:
            return ("report" if "please report" in str(error) else "message"), str(error)
        except Warning:
            return "warning", traceback.format_exc()
        except Exception:
            return "traceback", traceback.format_exc()
    return "answer", ""


def outcomes(seed: int) -> dict[str, tuple[str, str]]:
    """What became of each way to an answer for one machine."""
    values, lam, sigma = machine(np.random.default_rng([1981, seed]))
    results = {"machine": outcome(lambda: Bicycle.from_mapping(values))}
    if results["machine"][0] != "answer":
        return results
    bicycle = Bicycle.from_mapping(values)
    family = Family(bicycle)
    ways: dict[str, Callable[[], Any]] = {
        "speeds": lambda: stable_speeds(bicycle, [lam], [sigma], nearest=False),
        "vrange": lambda: stable_speeds(bicycle, [lam], [sigma]),
        "eigen": lambda: modes(bicycle, SPEEDS, lam, sigma),
        "trace": lambda: trace(family, (-0.2, 0.6), (-0.5, 0.5), samples=41),
        "design": lambda: best_designs(Wanted(family), grid=9),
    }
    return results | {name: outcome(way) for name, way in ways.items() if seed % EVERY[name] == 0}


def main(seeds: Iterable[int]) -> int:
    """Count the outcomes, print what is bad, and return how many of these there are."""
    count: Counter[tuple[str, str]] = Counter()
    for seed in seeds:
        for name, (result, text) in outcomes(seed).items():
            count[name, result] += 1
            if result not in ("answer", "message"):
                print(f"seed {seed}, {name}: {result}\n{text}", flush=True)
    for (name, result), number in sorted(count.items()):
        print(f"{name}: {number} {result}")
    return sum(number for (_, result), number in count.items() if result not in ("answer", "message"))


if __name__ == "__main__":
    first, number = (0, int(sys.argv[1])) if len(sys.argv) == 2 else map(int, sys.argv[1:])
    sys.exit(bool(main(range(first, first + number))))
