"""Tell of meshes of random machines in random boxes whether each is delivered, closed and on the surface.

    python -m tests.references.verify_meshes --pairs 100 --cells 20 50 100
    python -m tests.references.verify_meshes --first 100 --pairs 100 --cells 100

The second goes on with numbers 100 to 199 of the same row. The first pairs are the presets with five dampings
in the box of the 1981 paper; then machines of both notations, half of them damped by 1e-12 to 10 kg m²/s, in
boxes of their own. Prints each mesh that is not as it should be, and counts; exits with 1 if there is one.
tests/region/test_mesh.py has a sample.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from itertools import islice

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.region.mesh import region_mesh
from tests.meshes import away_from_surface, open_edges

PRESETS = ("dikarev1981", "meijaard2007", "kooijman2011", "sharp1971")
DAMPINGS = (0.0, 1e-9, 1e-3, 1.0, 2.0)


def pairs(number: int, seed: int) -> Iterator[tuple[Family, list[tuple[float, float]]]]:
    """Families and boxes."""
    for name in PRESETS:
        for delta in DAMPINGS:
            yield Family(Bicycle.preset(name).with_delta(delta)), [(0, 0.3), (0, 0.15), (0, 15)]
    random = np.random.default_rng(seed)
    for _ in range(number - len(PRESETS) * len(DAMPINGS)):
        bicycle = Bicycle.from_mapping(paper(random) if random.random() < 0.5 else meijaard(random))
        delta = random.choice([0, 0, 10 ** random.uniform(-12, -3), 10 ** random.uniform(-3, 1)])
        low = random.uniform(-0.2, 0.4), random.uniform(-0.1, 0.1), random.choice([0, random.uniform(0, 5)])
        size = random.uniform(0.1, 0.6), random.uniform(0.05, 0.4), random.uniform(5, 25)
        yield Family(bicycle.with_delta(delta)), [(a, a + d) for a, d in zip(low, size, strict=True)]


def paper(random: np.random.Generator) -> dict[str, float]:
    """A machine in the notation of 1981."""
    u, c = random.uniform, random.uniform(0.7, 1.8)
    m1, m2 = u(10, 250), u(1, 30)
    n = {"c": c, "g": 9.81, "m1": m1, "l1": c * u(0.1, 0.7), "h1": u(0.3, 1.5)}
    n |= {"m2": m2, "l2": c * u(0.7, 1.2), "h2": u(0.2, 1)}
    for i, m, size in (("1", m1, 0.5), ("2", m2, 0.35)):
        n["A" + i], n["B" + i], n["D" + i] = body(random, m, size)
        n["R" + i] = r = u(0.15, 0.5)
        n["C" + i] = min(0.3 * m * r**2 * u(0.5, 1), n["A" + i] + n["B" + i])
    return n


def meijaard(random: np.random.Generator) -> dict[str, float]:
    """A machine in the notation of 2007."""
    u, w = random.uniform, random.uniform(0.7, 1.8)
    m = {"R": u(0.5, 15), "B": u(10, 250), "H": u(0.5, 15), "F": u(0.5, 15)}
    n = {"w": w, "c": w * u(-0.1, 0.5), "lam": u(-0.2, 0.9), "g": 9.81}
    n |= {f"m{i}": mass for i, mass in m.items()}
    n |= {"xB": w * u(0.1, 0.7), "zB": -u(0.3, 1.5), "xH": w * u(0.7, 1.2), "zH": -u(0.2, 1)}
    for i in "RF":
        n["r" + i] = r = u(0.15, 0.5)
        n[f"I{i}yy"] = m[i] * r**2 * u(0.5, 1)
        n[f"I{i}xx"] = 0.5 * n[f"I{i}yy"] * u(1, 1.2)
    for i, size in (("B", 0.5), ("H", 0.3)):
        n[f"I{i}xx"], n[f"I{i}zz"], n[f"I{i}xz"] = body(random, m[i], size)
    return n


def body(random: np.random.Generator, m: float, size: float) -> tuple[float, float, float]:
    """Moments of inertia about two axes, and their product, of a body of a mass and a radius of gyration."""
    xx, zz = m * (size * random.uniform(0.2, 1, 2)) ** 2
    return xx, zz, random.uniform(-0.9, 0.9) * np.sqrt(xx * zz)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--pairs", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--cells", type=int, nargs="+", default=[20, 50, 100])
    parser.add_argument("--seed", type=int, default=1)
    wanted = parser.parse_args()
    counts = dict.fromkeys(("meshes", "empty", "refused", "open", "off the surface", "with kind none"), 0)
    farthest, started = 0.0, time.process_time()
    row = enumerate(pairs(wanted.first + wanted.pairs, wanted.seed))
    for number, (family, box) in islice(row, wanted.first, None):
        for cells in wanted.cells:
            counts["meshes"] += 1
            try:
                mesh = region_mesh(family, *box, cells=cells)
            except Exception as error:
                counts["refused"] += 1
                print(f"pair {number}, {cells} cells: {type(error).__name__}: {error}", flush=True)
                continue
            torn, away = open_edges(mesh, box), away_from_surface(family, box, mesh)
            counts["empty"] += not len(mesh.triangles)
            counts["open"] += torn > 0
            counts["off the surface"] += not away < 1e-9
            counts["with kind none"] += bool((mesh.kind == 0).any())
            farthest = max(farthest, away)
            if torn or not away < 1e-9:
                print(f"pair {number}, {cells} cells: {torn} open edges, {away:.2g} away", flush=True)
    print(
        ", ".join(f"{value} {name}" for name, value in counts.items()),
        f"; farthest vertex {farthest:.2g} of the box",
    )
    print(f"{time.process_time() - started:.0f} s")
    sys.exit(counts["refused"] + counts["open"] + counts["off the surface"] > 0)


if __name__ == "__main__":
    main()
