"""Random boxes of random machines: no proved cell has a point that arithmetic of 400 bits calls otherwise.

Boxes lie around a point of the boundary, have one as a corner, or end at one to the last bit; machines may be
degenerate (point masses, no spin), δ is 0 or up to 1e3, and up to three parameters vary. Points are corners
of cells, inside of cells, and beside the boundary. Every box gives a certificate too, which the checker must
take, and refuse with one number changed, and with a verdict changed and the hash made to fit. Without
tolerances the corners of all cells are compared with what a volume says of them too.

    nice python -m tests.references.verify_proofs --boxes 2000 --seed 1

takes ten minutes and prints counts; docs/trust.md has them. ``--first 500`` leaves out the boxes before.
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from contextlib import suppress
from typing import Any

import numpy as np
from flint import arb, ctx

from bikestab.bicycle import Bicycle
from bikestab.certified import contradicted
from bikestab.certify.proof import Proof, prove
from bikestab.certify.search import STABLE, UNDECIDED
from bikestab.critical import critical
from bikestab.model import exact_table
from bikestab.scan.signs import violated_between
from bikestab.speeds import intervals_of
from tests.references.certificates import check_certificate
from tests.references.verify_speeds import BITS, hurwitz3, random_machine, table

CELLS = 4
PRESETS = [Bicycle.preset(name) for name in ("meijaard2007", "kooijman2011", "dikarev1981", "sharp1971")]
ASIDE = [s * 10.0**-k for k in (2, 4, 7, 10, 13, 15) for s in (-1, 1)]  # of a critical speed


def random_bicycle(rng: random.Random) -> tuple[Bicycle, float, float]:
    """A machine with its tilt and trail: of two parts, or a preset with other numbers."""
    if rng.random() < 0.7:
        p, lam, sigma = random_machine(rng)
        p["delta"] = min(p["delta"], 1e3)
        return Bicycle.from_mapping(p), min(lam, 1.2), sigma
    bicycle = rng.choice(PRESETS)
    given = {k: v * (1 + rng.uniform(-0.05, 0.05)) for k, v in bicycle.given.items() if k not in ("c", "w")}
    with suppress(ValueError):  # no rigid body
        bicycle = Bicycle.from_mapping({**bicycle.given, **given})
    bicycle = bicycle.with_delta(rng.choice([0.0, 10 ** rng.uniform(-9, 3)]))
    return bicycle, rng.uniform(0, 0.5), rng.uniform(0, 0.2)


def random_box(rng: random.Random) -> tuple[Bicycle, list[Any], dict[str, tuple[float, float]]]:
    """A machine, edges in λ, σ and V, and tolerances."""
    bicycle, lam, sigma = random_bicycle(rng)
    found = intervals_of(exact_table(bicycle, lam, sigma))
    ends = [float(V) for each in (found.V1, found.V2) for V in each if 0 < V < 60]
    V = rng.choice(ends) if ends and rng.random() < 0.9 else rng.uniform(0, 15)
    scale, kind = 10 ** rng.uniform(-4, 0), rng.choice(["around", "corner", "tangent", "rest"])
    edges = []
    for middle, width in ((lam, 0.2), (sigma, 0.1), (V, 5.0)):
        low = middle - rng.uniform(0, 1) * width * scale
        if kind == "corner":
            low = middle - rng.choice([0, 1]) * width * scale
        edges.append(np.linspace(low, low + width * scale, CELLS + 1))
    if kind == "tangent":  # one design, from a critical speed on or up to it, within some last bits
        V = V * (1 + rng.randint(-2, 2) * 2.0**-52)
        edges = [
            np.full(2, lam),
            np.full(2, sigma),
            np.linspace(V, V + rng.choice([-1, 1]) * 3 * scale, CELLS + 1),
        ]
        edges[2].sort()
    edges[2] = np.linspace(
        0.0 if kind == "rest" else max(edges[2][0], 0.0), max(edges[2][-1], 0.1), CELLS + 1
    )
    edges[0] = np.clip(edges[0], -1.4, 1.4)
    names = [k for k, v in bicycle.given.items() if v and k not in ("c", "lam", "sigma", "trail", "w", "R")]
    tolerances = {}
    for name in rng.sample(names, rng.choice([0, 0, 0, 1, 2, 2, 3, 3])):
        half = abs(bicycle.given[name]) * 10 ** rng.uniform(-5, -1.5)
        tolerances[name] = (bicycle.given[name] - half, bicycle.given[name] + half)
    return bicycle, edges, tolerances


def parameters(bicycle: Bicycle, values: dict[str, float]) -> dict[str, Any]:
    """The numbers of the two parts in balls, those of four bodies put together here."""
    if not bicycle.bodies:
        return {**{k: v for k, v in bicycle.numbers().items() if k not in ("lam", "sigma")}, **values}
    n = {k: arb(float(v)) for k, v in {"g": 9.81, "delta": 0.0, **bicycle.bodies, **values}.items()}
    rear = [(n["mR"], arb(0), n["rR"], n["IRxx"], n["IRxx"], arb(0))]
    rear += [(n["mB"], n["xB"], -n["zB"], n["IBxx"], n["IBzz"], n["IBxz"])]
    front = [(n["mH"], n["xH"], -n["zH"], n["IHxx"], n["IHzz"], n["IHxz"])]
    front += [(n["mF"], n["w"], n["rF"], n["IFxx"], n["IFxx"], arb(0))]
    p = {
        "c": n["w"],
        "g": n["g"],
        "delta": n["delta"],
        "C1": n["IRyy"],
        "C2": n["IFyy"],
        "R1": n["rR"],
        "R2": n["rF"],
    }
    for i, bodies in (("1", rear), ("2", front)):
        m = sum((b[0] for b in bodies), arb(0))
        x, h = (sum((b[0] * b[k] for b in bodies), arb(0)) / m for k in (1, 2))
        A = sum((b[3] + b[0] * (b[2] - h) ** 2 for b in bodies), arb(0))
        B = sum((b[4] + b[0] * (b[1] - x) ** 2 for b in bodies), arb(0))
        D = sum((b[5] + b[0] * (b[1] - x) * (b[2] - h) for b in bodies), arb(0))
        p |= {"m" + i: m, "l" + i: x, "h" + i: h, "A" + i: A, "B" + i: B, "D" + i: D if i == "1" else -D}
    still = [f"C{i}" for i, name in (("1", "IRyy"), ("2", "IFyy")) if not {**bicycle.bodies, **values}[name]]
    return {**p, **dict.fromkeys(still, 0.0)}  # what never spins may be a skate, without a radius


def within(edges: Any, cell: int, share: float) -> float:
    """A double in a cell, at its ends for shares of 0 and 1."""
    low, high = float(edges[cell]), float(edges[cell + 1])
    return min(max(low + share * (high - low), low), high) if share < 1 else high


def stable_of_volume(proof: Proof) -> Any:
    """What a scan stores in ``stable`` at the ends of the proof's cells."""
    lam, sigma, V = (e if e[0] < e[-1] else e[:1] for e in proof.edges)
    design = [each.ravel() for each in np.meshgrid(lam, sigma, indexing="ij")]
    found = exact_table(proof.bicycle, *design)
    mask = violated_between(found.value, critical(found), V)
    return (mask == 0).astype(np.uint8).reshape(len(lam), len(sigma), len(V))


def compare(proof: Proof, rng: random.Random, counts: Counter[str], designs: int) -> None:
    """Points of the proof's cells against balls."""
    verdicts = proof.decided.on_cells()
    for _ in range(designs):
        at = [rng.randrange(n) for n in verdicts.shape]
        share = [rng.choice([0.0, 1.0, rng.random()]) for _ in at]
        point = [within(e, i, s) for e, i, s in zip(proof.edges, at, share, strict=True)]
        values = dict(zip(proof.varied, point[3:], strict=True))
        rows = table(parameters(proof.bicycle, values), point[0], point[1])
        column = verdicts[(at[0], at[1], slice(None), *at[3:])]
        for V, cell, near in _speeds(proof, rng, point, values, proof.edges[2]):
            if column[cell] == UNDECIDED:
                counts["points of undecided cells"] += 1
                continue
            p = [row(arb(V)) for row in rows]
            sides = [*p, hurwitz3(p)]
            counts["points"] += 1
            counts["points within 1e-4 of a critical speed"] += near
            counts["corners"] += all(s in (0, 1) for s in share)
            # asymptotically stable, certainly not, or beyond 400 bits
            stable = all(x > 0 for x in sides)
            unstable = any(x < 0 for x in sides) or any(x == 0 for x in sides)
            if not stable and not unstable:
                counts["zero to 400 bits"] += 1
                counts["WRONG"] += int(column[cell] == STABLE)
            elif (column[cell] == STABLE) != stable:
                counts["WRONG"] += 1
                print("wrong:", proof.bicycle, point, V, values, flush=True)


def _speeds(
    proof: Proof, rng: random.Random, point: list[float], values: dict[str, float], edges: Any
) -> Any:
    """Speeds with their cells: both ends and inside of each, and beside the critical ones of this design."""
    for cell in range(len(edges) - 1):
        for share in (0.0, 1.0, rng.random(), rng.random()):
            yield within(edges, cell, share), cell, False
    if rng.random() > 0.25:
        return
    machine = proof.bicycle.replaced(values) if values else proof.bicycle
    found = intervals_of(exact_table(machine, point[0], point[1]))
    for V in (*found.V1, *found.V2):
        for aside in ASIDE:
            near = V * (1 + aside)
            if edges[0] <= near < edges[-1]:
                yield float(near), int(np.searchsorted(edges, near, side="right")) - 1, abs(aside) < 1e-3


def provable(rng: random.Random) -> Proof:
    """The proof of a random box."""
    while True:
        bicycle, edges, tolerances = random_box(rng)
        with suppress(ValueError):  # no machine at an end of a tolerance
            return prove(bicycle, *edges, tolerances=tolerances)


def run(boxes: int, seed: int, designs: int = 45, most: int = 1, first: int = 0) -> Counter[str]:
    """Check so many boxes."""
    ctx.prec = BITS
    names = ["WRONG", "DENIED BY STABLE", "CERTIFICATES REFUSED", "CHANGED ONES TAKEN", "boxes", "points"]
    counts: Counter[str] = Counter(dict.fromkeys(names, 0))
    for number in range(first, first + boxes):
        rng = random.Random(f"{seed}, {number}")
        proof = provable(rng)
        bicycle, tolerances = proof.bicycle, proof.varied
        counts["boxes"] += 1
        counts[f"with {len(tolerances)} tolerances"] += 1
        counts["boxes with damping"] += bicycle.delta > 0
        for k, name in enumerate(("undecided", "proved stable", "proved unstable")):
            counts[f"cells {name}"] += int(np.count_nonzero(proof.decided.on_cells() == k))
        if not tolerances:
            counts["DENIED BY STABLE"] += int(contradicted(proof.cells, stable_of_volume(proof)).sum())
        compare(proof, rng, counts, designs)
        check_certificate(proof, rng, counts, most)
        if counts["boxes"] % 100 == 0:
            print(dict(counts), flush=True)
    return counts


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--boxes", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    asked = parser.parse_args()
    counts = run(asked.boxes, asked.seed, first=asked.first)
    print("\n".join(f"{name}: {count}" for name, count in sorted(counts.items())))
