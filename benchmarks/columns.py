"""How long the exact critical speeds, intervals and sheets of many (λ, σ) take.

    python benchmarks/columns.py [--quick] [--json FILE]

The speeds are compared with numpy.roots at the columns that both are timed on.
"""

from __future__ import annotations

from math import isqrt

import common
import numpy as np
from common import BICYCLE, BOX, DELTA, Report, Table, Task, measure, short
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.critical import critical
from bikestab.model import characteristic_table
from bikestab.routh import CONDITIONS, condition_polynomials
from bikestab.scan.sheets import Atlas, Roots, most_roots
from bikestab.speeds import Intervals, intervals_between, intervals_of

TILE = (64, 128)  # λ and σ, as a scan has them
SAMPLE = 200  # columns for numpy.roots
NEAR = 1e-6  # relative; a double root moves by some 1e-8 of itself


def tables(number: int, delta: float) -> list[tuple[tuple[int, int], NDArray]]:
    """The tables of about so many columns in the scan's tiles, and where each begins."""
    n = isqrt(number)
    lam, sigma = np.linspace(*BOX["lam"], n)[:, np.newaxis], np.linspace(*BOX["sigma"], number // n)
    bicycle = Bicycle.preset(BICYCLE).with_delta(delta)
    return [
        ((i, k), characteristic_table(bicycle, lam[i : i + TILE[0]], sigma[k : k + TILE[1]]))
        for i in range(0, n, TILE[0])
        for k in range(0, len(sigma), TILE[1])
    ]


def boundary(parts: list[tuple[tuple[int, int], NDArray]]) -> int:
    """All critical speeds and intervals, the sheets of each condition and which are edges, as in a scan."""
    found = []
    for place, table in parts:
        flat = table.reshape(5, 4, -1)
        exact = critical(flat)
        shape = table.shape[2:]
        inside = intervals_between(flat, exact)
        inside = Intervals(*(each.reshape(*shape, each.shape[-1]) for each in inside.arrays().values()))
        roots = {
            name: Roots(
                exact.speeds[name].T.reshape(*shape, len(exact.speeds[name])),
                (exact.sign[name] < 0).reshape(*shape, 1),
            )
            for name in CONDITIONS
        }
        found.append((place, roots, inside))
    width = 0
    for name in CONDITIONS:
        most = [most_roots(roots[name]) for _, roots, _ in found]
        atlas = Atlas(name, tuple(max(each) for each in zip(*most, strict=True)))
        for place, roots, _ in found:
            atlas.add(place, roots[name])
        atlas.finish()
        for place, roots, inside in found:
            atlas.sheets(place, roots[name], inside)
        width += atlas.width
    return width


def numpy_roots(table: NDArray) -> list[NDArray]:
    """The positive real roots of p0 and hurwitz3 in each column (5, 4, column), one after the other."""
    polynomials = condition_polynomials(table)
    found = []
    for name in ("p0", "hurwitz3"):
        for coefficients in polynomials[name].T:
            z = np.roots(coefficients[::-1])
            found.append(np.sort(z.real[(np.abs(z.imag) <= NEAR * np.abs(z)) & (z.real > 0)]))
    return found


def compare(table: NDArray) -> str:
    """Assert that numpy.roots finds every critical speed; returns what was found, in words."""
    exact = critical(table, ("p0", "hurwitz3")).speeds
    own = [column[np.isfinite(column)] for name in ("p0", "hurwitz3") for column in exact[name].T]
    for ours, peer in zip(own, numpy_roots(table), strict=True):
        near = np.abs(ours[:, np.newaxis] - peer) <= NEAR * ours[:, np.newaxis]
        assert near.any(axis=1).all(), "critical and numpy.roots differ"
    return f"numpy.roots finds all {sum(map(len, own))} critical speeds of {table.shape[-1]} columns."


def run(quick: bool) -> Report:
    """Compare, time, report."""
    report = Report("Columns: ns per (λ, σ), one process")
    sizes = (10_000,) if quick else (10_000, 100_000, 1_000_000)
    tasks: dict[tuple[float, str, int], Task] = {}
    for delta in (0.0, DELTA):
        for size in sizes:
            parts = tables(size, delta)
            number = sum(table.shape[2] * table.shape[3] for _, table in parts)
            whole = np.concatenate([table.reshape(5, 4, -1) for _, table in parts], axis=-1)
            if size == sizes[0]:
                some = whole[..., :: number // SAMPLE]
                report.parts.append(f"δ = {delta:g}: {compare(some)}")
                peer = Task("numpy.roots", lambda some=some: numpy_roots(some), some.shape[-1])
                tasks[delta, "peer", 0] = peer
                measure([peer], rounds=1 if quick else 5)
            these = {
                "critical": Task("critical", lambda parts=parts: [critical(t) for _, t in parts], number),
                "intervals_of": Task("intervals_of", lambda whole=whole: intervals_of(whole), number),
                "boundary": Task("boundary", lambda parts=parts: boundary(parts), number),
            }
            measure(these.values(), rounds=1 if quick else 10_000_000 // size // 20 + 2)
            tasks |= {(delta, name, size): task for name, task in these.items()}
    rows = []
    for (delta, name, size), task in tasks.items():
        if name == "peer":
            words = "a loop of numpy.roots over p0 and hurwitz3"
            rows.append([f"δ = {delta:g}: {words}", str(task.count), short(task.ns), ""])
        else:
            ratio = tasks[delta, "peer", 0].ns / task.ns
            rows.append([f"δ = {delta:g}: {name}", str(task.count), short(task.ns), short(ratio)])
        key = f"delta {delta:g}: {name}" + (f", {size} columns" if size else "")
        report.data[key] = {"ns": task.ns, "s": task.best}
    report.parts.append(Table(["", "columns", "ns per column", "numpy.roots / this"], rows))
    return report


if __name__ == "__main__":
    common.main(__doc__, {"columns": run})
