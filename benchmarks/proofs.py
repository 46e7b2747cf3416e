"""How much of the paper's box is proved, how fast, in how much memory; and the same step by arb.

    python benchmarks/proofs.py [--quick] [--json FILE]

The floor is the share of cells that have stable and other points, which no method can decide. It is counted
at 13³ points of each undecided cell. One step of hurwitz3 is done in balls of 64 bits too, by python-flint.
"""

from __future__ import annotations

import resource
import time
from typing import Any

import common  # first, for its environment
import numpy as np
from common import Aim, Report, Table

from bikestab.bicycle import Bicycle
from bikestab.certify.bernstein import Bernstein, bounds
from bikestab.certify.box import Box, box_of
from bikestab.certify.search import UNDECIDED, search
from bikestab.model import exact_table
from bikestab.routh import conditions, violated

ENDS = (0.30, 0.15, 15.0)  # rad, 1, m/s
PROTOTYPE = 216.0  # µs per decided cell at 64³
_POINTS = 13


def paper_box(number: int) -> Box:
    """The paper's bicycle and box, cut into so many cells along each axis."""
    edges = [np.linspace(0, end, number + 1) for end in ENDS]
    return box_of(Bicycle.preset("dikarev1981"), *edges, "refined", {})


def floor(box: Box, cells: Any) -> int:
    """How many of the undecided cells have the boundary in them for certain."""
    share = np.linspace(0, 1, _POINTS)
    found = 0
    for part in np.array_split(np.argwhere(cells == UNDECIDED), len(cells) // 3):
        lam, sigma, V = (
            e[i, np.newaxis] + share * (e[i + 1] - e[i])[:, np.newaxis]
            for e, i in zip(box.edges, part.T, strict=True)
        )
        table = exact_table(box.bicycle, lam[:, :, np.newaxis], sigma[:, np.newaxis]).value
        stable = violated(conditions(table[..., np.newaxis], V[:, np.newaxis, np.newaxis])) == 0
        stable = stable.reshape(len(part), -1)
        found += int((stable.any(axis=1) & ~stable.all(axis=1)).sum())
    return found


def arb_step(whole: Bernstein) -> float:
    """Seconds for the coefficients on one part of the box in balls of 64 bits, its weights being ready."""
    from flint import arb, arb_mat, ctx

    ctx.prec = 64
    a, b, c = whole.coefficients.shape
    rng = np.random.default_rng(1)
    weights = [arb_mat(n, n, [arb(float(x)) for x in rng.uniform(size=n * n)]) for n in (a, b, c)]
    coefficients = arb_mat(a, b * c, [arb(float(x)) for x in whole.coefficients.ravel()])
    start, steps = time.process_time(), 200
    for _ in range(steps):
        values = weights[0] * coefficients
        values = weights[1] * arb_mat(b, a * c, values.entries())
        values = weights[2] * arb_mat(c, a * b, values.entries())
        all(x > 0 for x in values.entries())
    return (time.process_time() - start) / steps


def numpy_step(whole: Bernstein) -> float:
    """Seconds for the same, weights and bounds of rounding included, on one of many parts."""
    ends = np.sort(np.random.default_rng(1).uniform(size=(4800, 3, 2)), axis=2)
    start = time.process_time()
    for part in np.split(ends, 10):
        bounds(whole, part[..., 0], part[..., 1])
    return (time.process_time() - start) / len(ends)


def run(quick: bool) -> Report:
    """Prove the box at several resolutions."""
    report, rows = Report("Proofs: the paper's box"), []
    for number in (16, 32) if quick else (16, 32, 64, 128):
        box = paper_box(number)
        start, seconds = time.process_time(), time.perf_counter()
        decided = search(box.prover())
        spent, seconds = time.process_time() - start, time.perf_counter() - seconds
        cells = decided.on_cells()
        undecided, least = int((cells == UNDECIDED).sum()), floor(box, cells) if number < 128 else None
        each = 1e6 * spent / (cells.size - undecided)
        ratio = f"{undecided / least:.3f}" if least else ""
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
        share = f"{100 * undecided / cells.size:.2f}"
        rows.append([f"{number}³", share, ratio, f"{spent:.2f}", f"{each:.2f}", f"{peak:.0f}"])
        report.data[str(number)] = {"undecided": undecided, "floor": least, "s": spent, "peak MB": peak}
        if number == 64 and least:
            report.aims.append(
                Aim("undecided share, of the floor, 64³", 1.05, undecided / least, at_most=True)
            )
            report.aims.append(Aim("the prototype's µs per decided cell, of this, 64³", 20, PROTOTYPE / each))
        if number == 128:
            report.aims.append(Aim("seconds for 128³", 6, seconds, at_most=True))
    head = ["cells", "undecided, %", "of the floor", "processor s", "µs per decided cell", "peak MB so far"]
    whole = paper_box(8).prover()._whole["hurwitz3"]
    steps = [1e6 * step(whole) for step in (arb_step, numpy_step)]
    report.data["µs of a step"] = dict(zip(("arb", "numpy"), steps, strict=True))
    report.parts += [
        Table(head, rows),
        "One step of hurwitz3, {} coefficients: {:.0f} µs by arb, {:.1f} µs here.".format(
            " × ".join(map(str, whole.coefficients.shape)), *steps
        ),
    ]
    return report


if __name__ == "__main__":
    common.main(__doc__, {"proofs": run})
