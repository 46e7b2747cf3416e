"""How much faster two workers evaluate the same tiles than one: processes and, for the record, threads.

    python benchmarks/scaling.py [--quick] [--json FILE]

Workers are started and have seen every kind of tile before anything is timed.
"""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import ExitStack
from typing import Any

import common
from common import Aim, Report, Table, Task, measure, short
from points import SHAPE, growth, masks, tile

from bikestab.scan.tile import Tile, compute

MASKS = ("stable", "violated")


def evaluate(t: Tile) -> int:
    """Evaluate a tile's fields and send nothing back."""
    return len(growth(t) if "growth_rate" in t.fields else masks(t))


def start(pool: Executor, work: Callable[[Tile], Any], t: Tile) -> None:
    """Let every worker of a pool have done the work."""
    list(pool.map(work, [t] * 8))


def run(quick: bool) -> Report:
    """Time the pools in turn."""
    speeds, number = (64, 4) if quick else (512, 40)
    few = 16 if quick else 64
    kinds: dict[str, tuple[Callable[[Tile], Any], Tile, int]] = {
        "stable + violated": (evaluate, tile((*SHAPE, speeds), 0.0, MASKS), number),
        "growth_rate": (evaluate, tile((16, 128, few), 0.0, ("growth_rate",)), 2 * number),
        "stable + violated, whole tiles of a scan": (compute, tile((*SHAPE, speeds), 0.0, MASKS), number),
    }
    report = Report(f"Scaling: {number} tiles, workers running before the timing")
    spawn = multiprocessing.get_context("spawn")
    with ExitStack() as stack:
        pools: dict[str, tuple[Executor, Executor]] = {
            "processes": (
                stack.enter_context(ProcessPoolExecutor(1, spawn)),
                stack.enter_context(ProcessPoolExecutor(2, spawn)),
            ),
            "threads": (
                stack.enter_context(ThreadPoolExecutor(1)),
                stack.enter_context(ThreadPoolExecutor(2)),
            ),
        }
        tasks = {}
        for kind, (work, t, count) in kinds.items():
            for name, pair in pools.items():
                for workers, pool in enumerate(pair, 1):
                    start(pool, work, t)
                    tasks[kind, name, workers] = Task(
                        f"{kind}, {workers} {name}",
                        lambda pool=pool, work=work, t=t, count=count: list(pool.map(work, [t] * count)),
                    )
        measure(tasks.values(), rounds=1 if quick else 7)
    rows = []
    for kind in kinds:
        for name in pools:
            one, two = (tasks[kind, name, workers].best for workers in (1, 2))
            rows.append([f"{kind}: {name}", short(1e3 * one), short(1e3 * two), short(one / two)])
            report.data[f"{kind}: {name}"] = {"1": {"s": one}, "2": {"s": two}, "ratio": one / two}
            if name == "processes":
                report.aims.append(Aim(f"{kind}: 1 process / 2 processes", 1.7, one / two))
    report.parts.append(Table(["", "1 worker [ms]", "2 workers [ms]", "ratio"], rows))
    return report


if __name__ == "__main__":
    common.main(__doc__, {"scaling": run})
