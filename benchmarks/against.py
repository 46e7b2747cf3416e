"""How long the columns, single designs and `vrange` take, beside those of an earlier build of this program.

    python benchmarks/against.py /path/to/earlier/python [--source /path/to/earlier/tree] [--pairs 7]

Both builds run in turn in processes of their own, and the medians of their processor times are compared. The
earlier build needs no more than numpy; names that it has otherwise are looked up.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

BOX = (0.0, 0.6, 64), (0.0, 0.15, 128)  # λ [rad] and σ: a tile of a scan
VRANGE = ["vrange", "--bicycle", "meijaard2007", "--lam", "0.05:0.3:30", "--sigma", "0.05:0.1:30"]


def measured() -> dict[str, float]:
    """Processor times of this build: ns per column, and µs per design."""
    import numpy as np

    from bikestab.bicycle import Bicycle

    model, speeds = importlib.import_module("bikestab.model"), importlib.import_module("bikestab.speeds")
    intervals_of = getattr(speeds, "intervals_of", None) or speeds.stable_intervals
    table_of = model.characteristic_table
    exact_of = getattr(model, "exact_table", table_of)
    lam, sigma = np.linspace(*BOX[0])[:, np.newaxis], np.linspace(*BOX[1])
    flat = np.repeat(lam.ravel(), BOX[1][2]), np.tile(sigma, BOX[0][2])
    np.empty(1 << 21)  # as scans do: glibc keeps what is freed
    out, number = {}, lam.size * sigma.size
    for delta in (0.0, 1.0):
        bicycle = Bicycle.preset("meijaard2007").with_delta(delta)
        table = table_of(bicycle, lam, sigma)
        tasks: dict[str, tuple[Callable[[], Any], int]] = {
            "table": (lambda b=bicycle: table_of(b, lam, sigma), number),
            "table of pairs": (lambda b=bicycle: table_of(b, *flat), number),
            "critical": (lambda t=table: speeds.critical(t), number),
            "intervals": (lambda t=table: intervals_of(t), number),
            "table and intervals": (lambda b=bicycle: intervals_of(exact_of(b, lam, sigma)), number),
            "table of one design": (lambda b=bicycle: table_of(b, 0.3, 0.08), 1),
            "table and intervals of one design": (lambda b=bicycle: intervals_of(exact_of(b, 0.3, 0.08)), 1),
        }  # fmt: skip
        for name, (run, many) in tasks.items():
            best = float("inf")
            for _ in range(4 if many > 1 else 40):
                start = time.process_time()
                run()
                best = min(best, time.process_time() - start)
            out[f"δ = {delta:g}: {name}"] = best / many * 1e9
    return out


def started(python: str, source: str | None) -> dict[str, float]:
    """The times of one process of a build, and of its ``vrange`` [ns]."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program is compiled only once
    if source:
        environment["PYTHONPATH"] = f"{source}:{source}/cli"
    run = subprocess.run([python, __file__, "--child"], env=environment, check=True, capture_output=True)
    found: dict[str, float] = json.loads(run.stdout)
    for words, command in (
        ("one design", [*VRANGE[:3], "--lam", "0.3", "--sigma", "0.08"]),
        ("900 designs", VRANGE),
    ):
        before = os.times()
        subprocess.run(
            [Path(python).with_name("bikestab"), *command], env=environment, check=True, capture_output=True
        )
        now = os.times()
        found[f"vrange, {words}"] = 1e9 * (
            now.children_user + now.children_system - before.children_user - before.children_system
        )
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("python", nargs="?", default=sys.executable)
    parser.add_argument("--source")
    parser.add_argument("--pairs", type=int, default=7)
    parser.add_argument("--child", action="store_true")
    asked = parser.parse_args()
    if asked.child:
        print(json.dumps(measured()))
        return
    here = str(Path(__file__).parent.parent)
    pairs = [(started(asked.python, asked.source), started(sys.executable, here)) for _ in range(asked.pairs)]
    print(f"{'':48} {'before':>10} {'now':>10} {'ratio':>6}   (ns; medians of {asked.pairs})")
    for name in pairs[0][0]:
        old, new = (median(pair[i][name] for pair in pairs) for i in (0, 1))
        print(f"{name:48} {old:10.0f} {new:10.0f} {new / old:6.2f}")


if __name__ == "__main__":
    main()
