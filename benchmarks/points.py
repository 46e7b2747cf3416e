"""How long bikestab takes for a grid point, beside what else computes the same, on one thread.

    python benchmarks/points.py [--quick] [--json FILE]

The signs of all methods are compared before anything is timed. Every time is the best of several
rounds, and every round runs all methods in turn, so that a busy machine slows all of them alike.
The aims are printed, never asserted: a time on a shared machine is no test.
"""

from __future__ import annotations

import os

os.environ["OMP_NUM_THREADS"] = "1"  # before numpy loads its linear algebra
os.environ["OPENBLAS_NUM_THREADS"] = "1"
os.environ["MKL_NUM_THREADS"] = "1"

import argparse
import json
import platform
import shutil
import subprocess
import sys
import sysconfig
import time
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from bicycleparameters.models import Meijaard2007Model
from bicycleparameters.parameter_sets import Meijaard2007ParameterSet
from numpy.typing import NDArray

from bikestab import yamltext
from bikestab.bicycle import Bicycle, preset_text
from bikestab.model import canonical_matrices, characteristic_table
from bikestab.notation import MEIJAARD
from bikestab.routh import stable
from bikestab.scan import COLUMNS, SPEEDS, _keep_heap, evaluate
from bikestab.spectrum import growth_rate
from bikestab.speeds import stable_intervals
from bikestab.units import ANGLE, PURE, quantity

BICYCLE = "meijaard2007"
DELTA = 1.0  # kg m²/s, the steering's damping in the rows that have it
EVERY = 16  # of the points for eigvals: as short runs as the others', so as good a chance of a quiet one
MARGINAL = 1e-9  # s⁻¹, growth rates too small to have a sign in every method
AIMS = {"stable": 300, "growth_rate": 25}  # times faster than eigvals


@dataclass
class Task:
    """A call to time, the number of points or columns that it works on, and its best time so far."""

    name: str
    run: Callable[[], Any]
    count: int
    best: float = float("inf")  # s

    @property
    def ns(self) -> float:
        """Nanoseconds for each point or column."""
        return 1e9 * self.best / self.count


@dataclass
class Sample:
    """A grid in the scan's tiles (one λ, COLUMNS values of σ, SPEEDS values of V) and its matrices."""

    tables: list[NDArray]  # (5, 4, COLUMNS) for each λ
    V: NDArray
    matrices: NDArray  # (points, 4, 4)
    model: Meijaard2007Model
    lam: NDArray  # of every point, as V fastest
    c: NDArray  # trail [m]
    v: NDArray
    some: NDArray  # indices of the points that the slowest methods are timed on

    @property
    def points(self) -> int:
        return len(self.matrices)


def sample(rows: int, few: int) -> Sample:
    """λ from 0 to 0.6 rad, σ from 0 to 0.15 and V from 0 to 10 m/s."""
    bicycle = Bicycle.preset(BICYCLE)
    lam, sigma = np.linspace(0, 0.6, rows), np.linspace(0, 0.15, COLUMNS)
    V = np.linspace(0, 10, SPEEDS)
    A = np.zeros((rows, COLUMNS, SPEEDS, 4, 4))
    A[..., 0, 2] = A[..., 1, 3] = 1
    v = V[:, np.newaxis, np.newaxis]
    for i, j in np.ndindex(rows, COLUMNS):
        M, C1, K0, K2 = canonical_matrices(bicycle, lam[i], sigma[j])
        A[i, j, :, 2:, :2] = -np.linalg.solve(M, bicycle.g * K0 + v**2 * K2)
        A[i, j, :, 2:, 2:] = -np.linalg.solve(M, v * C1)
    preset = yamltext.parse(preset_text(BICYCLE), BICYCLE).data
    values = {
        key: quantity(preset[key], ANGLE if key == "lam" else PURE) for key in MEIJAARD if key in preset
    }
    at_lam, at_sigma, at_V = (a.ravel() for a in np.meshgrid(lam, sigma, V, indexing="ij"))
    points = at_V.size
    return Sample(
        tables=[characteristic_table(bicycle, each, sigma) for each in lam],
        V=V,
        matrices=A.reshape(-1, 4, 4),
        model=Meijaard2007Model(Meijaard2007ParameterSet({**values, "v": 1.0}, True)),
        lam=at_lam,
        c=at_sigma * bicycle.c,
        v=at_V,
        some=np.linspace(0, points - 1, few).astype(int),
    )


def compare(s: Sample) -> str:
    """Assert that the methods agree on the sample; returns what was found, in words."""
    mask = np.concatenate([stable(t[..., np.newaxis], s.V).ravel() for t in s.tables])
    rate = np.concatenate([growth_rate(t[..., np.newaxis], s.V).ravel() for t in s.tables])
    peer = np.linalg.eigvals(s.matrices).real.max(axis=-1)
    clear = np.abs(peer) > MARGINAL
    assert np.array_equal(mask[clear], peer[clear] < 0), "stable and eigvals differ"
    assert np.array_equal(np.signbit(rate[clear]), peer[clear] < 0), "growth_rate and eigvals differ"
    few = s.some[clear[s.some]]
    other = calc_eigen(s, few).real.max(axis=-1)
    assert np.array_equal(mask[few], other < 0), "stable and calc_eigen differ"
    return (
        f"All signs agree at {np.count_nonzero(clear)} points, {np.count_nonzero(mask & clear)} of them "
        f"stable; {np.count_nonzero(~clear)} have a growth rate within ±{MARGINAL:g} 1/s and were left out."
    )


def calc_eigen(s: Sample, points: NDArray) -> NDArray:
    """BicycleParameters' eigenvalues at some points of the sample."""
    return s.model.calc_eigen(lam=s.lam[points], c=s.c[points], v=s.v[points])[0]


def point_tasks(s: Sample) -> dict[str, Task]:
    """What is timed per grid point."""
    own = len(s.tables) * COLUMNS * SPEEDS
    stack = s.matrices[::EVERY].copy()
    tasks = {
        "stable": Task(
            "bikestab: stable + violated", lambda: [evaluate(t, s.V, ["stable"]) for t in s.tables], own
        ),
        "growth_rate": Task(
            "bikestab: growth_rate", lambda: [growth_rate(t[..., np.newaxis], s.V) for t in s.tables], own
        ),
        "eigvals": Task(
            "numpy.linalg.eigvals, 4×4 stack ready made", lambda: np.linalg.eigvals(stack), len(stack)
        ),
        "calc_eigen": Task(
            "BicycleParameters Meijaard2007Model.calc_eigen(lam, c, v)",
            lambda: calc_eigen(s, s.some),
            len(s.some),
        ),
        "calc_eigen_v": Task(
            "BicycleParameters Meijaard2007Model.calc_eigen(v), one λ and c",
            lambda: s.model.calc_eigen(v=s.v[s.some]),
            len(s.some),
        ),
    }
    return tasks


def column_tasks(rows: int) -> dict[str, Task]:
    """What is timed per (λ, σ)."""
    lam, sigma = np.linspace(0, 0.6, rows)[:, np.newaxis], np.linspace(0, 0.15, 400)
    tasks = {}
    for label, delta in (("δ = 0", 0.0), (f"δ = {DELTA:g}", DELTA)):
        bicycle = Bicycle.preset(BICYCLE).with_delta(delta)
        table = characteristic_table(bicycle, lam, sigma)
        count = lam.size * sigma.size
        tasks[f"characteristic_table, {label}"] = Task(
            f"characteristic_table, {label}",
            lambda bicycle=bicycle: characteristic_table(bicycle, lam, sigma),
            count,
        )
        tasks[f"stable_intervals, {label}"] = Task(
            f"stable_intervals, {label}", lambda table=table: stable_intervals(table), count
        )
    return tasks


def start_tasks() -> dict[str, Task]:
    """Whole processes."""
    command = shutil.which("bikestab", path=sysconfig.get_path("scripts")) or "bikestab"
    lines = {
        f"bikestab vrange --bicycle {BICYCLE}": [command, "vrange", "--bicycle", BICYCLE],
        'python -c "import numpy, click"': [sys.executable, "-c", "import numpy, click"],
    }
    return {
        name: Task(name, lambda line=line: subprocess.run(line, check=True, stdout=subprocess.DEVNULL), 1)
        for name, line in lines.items()
    }


def measure(tasks: dict[str, Task], rounds: int, at_least: float) -> None:
    """Run every task for ``at_least`` seconds in each round, and keep its best single run."""
    for _ in range(rounds):
        for task in tasks.values():
            end = time.perf_counter() + at_least
            while True:
                start = time.perf_counter()
                task.run()
                now = time.perf_counter()
                task.best = min(task.best, now - start)
                if now >= end:
                    break


def short(x: float) -> str:
    """Three digits, without an exponent."""
    return f"{x:.0f}" if x >= 100 else f"{x:.3g}"


def aligned(head: list[str], rows: list[list[str]]) -> str:
    """A table: the first column to the left, the others to the right."""
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(len(head))]
    lines = [
        "  ".join([row[0].ljust(widths[0]), *(x.rjust(w) for x, w in zip(row[1:], widths[1:], strict=True))])
        for row in [head, ["-" * w for w in widths], *rows]
    ]
    return "\n".join(lines)


def main() -> None:
    """Compare, time, print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="a few seconds; shows that it runs, no more")
    parser.add_argument("--json", metavar="FILE", type=Path, help="also write the results here")
    options = parser.parse_args()
    quick = options.quick

    s = sample(rows=2 if quick else 4, few=50 if quick else 200)
    agreed = compare(s)
    points, columns, starts = point_tasks(s), column_tasks(25 if quick else 250), start_tasks()
    _keep_heap()
    measure(points, rounds=2 if quick else 40, at_least=0.02 if quick else 0.05)
    measure(columns, rounds=2 if quick else 10, at_least=0.0)
    measure(starts, rounds=3 if quick else 15, at_least=0.0)

    eigvals, peer = points["eigvals"].ns, points["calc_eigen"].ns
    ratios = {key: (eigvals / task.ns, peer / task.ns) for key, task in points.items()}
    shown, bare = starts.values()
    packages = {name: version(name) for name in ("bikestab", "numpy", "BicycleParameters")}
    title = f"{platform.machine()}, Python {platform.python_version()}, " + ", ".join(
        f"{name} {number}" for name, number in packages.items()
    )
    results = {
        "machine": title,
        "bicycle": BICYCLE,
        "quick": quick,
        "points": {
            key: {"ns": task.ns, "eigvals / this": ratios[key][0], "calc_eigen / this": ratios[key][1]}
            for key, task in points.items()
        },
        "columns": {key: {"ns": task.ns} for key, task in columns.items()},
        "start": {key: {"s": task.best} for key, task in starts.items()},
        "start ratio": shown.best / bare.best,
        "aims": {
            key: {"aim": aim, "eigvals / this": ratios[key][0], "reached": ratios[key][0] >= aim}
            for key, aim in AIMS.items()
        },
    }

    rows = [
        [task.name, f"{short(task.ns)} ns", short(ratios[key][0]), short(ratios[key][1])]
        for key, task in points.items()
    ]
    rows += [[f"bikestab: {task.name}", f"{short(task.ns)} ns", "", ""] for task in columns.values()]
    rows += [[task.name, f"{short(1e3 * task.best)} ms", "", ""] for task in starts.values()]
    print(f"{title}; bicycle {BICYCLE}, one thread, best times")
    print(agreed, end="\n\n")
    print(aligned(["per point, column or process", "time", "eigvals / this", "calc_eigen / this"], rows))
    print()
    for key, aim in AIMS.items():
        verdict = "reached" if ratios[key][0] >= aim else "not reached"
        print(f"aim: {key} {aim} times faster than eigvals: {verdict}, {short(ratios[key][0])}")
    print(f"start-up: vrange takes {results['start ratio']:.3g} times as long as importing numpy and click")
    if options.json:
        options.json.write_text(json.dumps(results, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
