"""What the benchmarks share: tasks and their best times, tables, aims, the machine, a command line.

Import it before numpy, so that linear algebra stays on one thread.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program is compiled only once

BICYCLE = "meijaard2007"
DELTA = 1.0  # kg m²/s, the steering's damping in the rows that have it
BOX = {"lam": (0.0, 0.6), "sigma": (0.0, 0.15), "V": (0.0, 10.0)}  # rad, 1, m/s


@dataclass
class Task:
    """A call to time, the number of points or columns that it works on, and its best time so far [s]."""

    name: str
    run: Callable[[], Any]
    count: int = 1
    best: float = float("inf")

    @property
    def ns(self) -> float:
        """Nanoseconds for each point or column."""
        return 1e9 * self.best / self.count


def measure(tasks: Iterable[Task], rounds: int, at_least: float = 0.0) -> None:
    """Run every task for ``at_least`` seconds in each round, and keep its best single run.

    A round has all tasks in turn, so that a busy machine slows all of them alike.
    """
    tasks = list(tasks)
    for _ in range(rounds):
        for task in tasks:
            end = time.perf_counter() + at_least
            while True:
                start = time.perf_counter()
                task.run()
                now = time.perf_counter()
                task.best = min(task.best, now - start)
                if now >= end:
                    break


@dataclass(frozen=True)
class Aim:
    """A number to reach, and what was measured."""

    words: str
    aim: float
    measured: float
    at_most: bool = False

    @property
    def reached(self) -> bool:
        return self.measured <= self.aim if self.at_most else self.measured >= self.aim

    def row(self) -> list[str]:
        aim = f"{'≤' if self.at_most else '≥'} {self.aim:g}"
        return [self.words, aim, short(self.measured), "reached" if self.reached else "not reached"]


@dataclass
class Table:
    """Rows of text below a head; the first column is left-aligned."""

    head: list[str]
    rows: list[list[str]]

    def __str__(self) -> str:
        """The table in Markdown, aligned for those who read it as it stands."""
        widths = [max(len(row[i]) for row in [self.head, *self.rows]) for i in range(len(self.head))]
        lines = [
            " | ".join(
                f"{x:{'>' if i else '<'}{w}}" for i, (x, w) in enumerate(zip(row, widths, strict=True))
            )
            for row in [self.head, *self.rows]
        ]
        rule = "|".join(["-" * (widths[0] + 2), *("-" * (w + 1) + ":" for w in widths[1:])])
        return "\n".join([f"| {lines[0]} |", f"|{rule}|", *(f"| {line} |" for line in lines[1:])])


@dataclass
class Report:
    """What a benchmark found: for readers, and ``data`` for programs."""

    title: str
    parts: list[Table | str] = field(default_factory=list)
    aims: list[Aim] = field(default_factory=list)
    data: dict[str, Any] = field(default_factory=dict)

    def __str__(self) -> str:
        parts = [f"## {self.title}", *map(str, self.parts)]
        if self.aims:
            parts.append(str(Table(["aim", "", "measured", ""], [aim.row() for aim in self.aims])))
        return "\n\n".join(parts) + "\n"

    def for_json(self) -> dict[str, Any]:
        aims = [
            {
                "aim": aim.words,
                "at most" if aim.at_most else "at least": aim.aim,
                "measured": aim.measured,
                "reached": aim.reached,
            }
            for aim in self.aims
        ]
        return {**self.data, "aims": aims}


def short(x: float) -> str:
    """Three digits, without an exponent."""
    return f"{x:.0f}" if x >= 100 else f"{x:.3g}" if x >= 1e-3 or x == 0 else f"{x:.1g}"


def machine() -> str:
    """The processor, the system and the packages, in words."""
    model, info = platform.machine(), Path("/proc/cpuinfo")
    if info.exists():
        lines = [line.partition(":") for line in info.read_text().splitlines()]
        model = next((value.strip() for key, _, value in lines if key.strip() == "model name"), model)
    names = ("bikestab", "numpy", "h5py", "isal", "BicycleParameters")
    words = [model, f"{os.cpu_count()} cores", platform.system(), f"Python {platform.python_version()}"]
    return ", ".join([*words, *(f"{name} {version(name)}" for name in names)])


def main(text: str, benchmarks: dict[str, Callable[[bool], Report]]) -> None:
    """The command line of one benchmark or several: run, print, and write as JSON."""
    parser = argparse.ArgumentParser(description=text.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="shows that it runs; its times say little")
    parser.add_argument("--json", metavar="FILE", type=Path, help="also write the results here")
    options = parser.parse_args()
    print(f"{machine()}; bicycle {BICYCLE}\n", flush=True)
    results: dict[str, Any] = {"machine": machine(), "bicycle": BICYCLE, "quick": options.quick}
    for name, benchmark in benchmarks.items():
        report = benchmark(options.quick)
        print(report, flush=True)
        results[name] = report.for_json()
        if options.json:
            text = json.dumps(results, indent=2, ensure_ascii=False)
            options.json.write_text(text + "\n", encoding="utf-8")
