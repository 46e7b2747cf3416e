"""Runs of 'bikestab scan' as processes of their own, for ``scans`` and ``memory``."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from common import BICYCLE, BOX

CHILD = Path(__file__).with_name("timed_scan.py")
MASKS = ("stable", "violated")
ALL = (*MASKS, "growth_rate")


@dataclass
class Run:
    """What one process told: seconds of its parts and in all, and peak memory [bytes]."""

    seconds: dict[str, float]
    total: float
    peak: int
    workers: list[int]
    modules: list[str]

    @property
    def scan(self) -> float:
        """Seconds of ``run_scan``."""
        return self.total - sum(self.seconds.get(name, 0) for name in ("start-up", "pictures", "exit"))

    def share(self, *words: str) -> float:
        """Seconds of the parts whose names begin with one of these words."""
        return sum(s for name, s in self.seconds.items() if name.startswith(words))


def scan(folder: Path, shape: tuple[int, ...], fields: tuple[str, ...], jobs: int, delta: float = 0.0) -> Run:
    """Run the command once on a grid of that shape over the box; the output is removed before it."""
    config, result = folder / "scan.yaml", folder / "result.json"
    axes = zip(BOX.items(), shape, strict=True)
    grid = ", ".join(f"{name}: {{start: {a}, stop: {b}, num: {n}}}" for (name, (a, b)), n in axes)
    config.write_text(
        f"bicycle: {BICYCLE}\ndelta: {delta}\ngrid: {{{grid}}}\nfields: [{', '.join(fields)}]\n"
        f"output: {folder / 'out'}\n"
    )
    (folder / "out" / "volume.h5").unlink(missing_ok=True)
    os.sync()
    start = time.perf_counter()
    _child(str(result), repr(start), str(jobs), str(config))
    total = time.perf_counter() - start
    found = json.loads(result.read_text())
    seconds = found["seconds"]
    seconds["exit"] = total - sum(seconds.values())
    return Run(seconds, total, found["peak"], found["workers"], found["modules"])


def imports(folder: Path, modules: list[str]) -> int:
    """Peak memory [bytes] of a process that imports these modules and does nothing."""
    names, result = folder / "modules.json", folder / "result.json"
    names.write_text(json.dumps(modules))
    _child(str(result), "imports", str(names))
    return json.loads(result.read_text())["peak"]


def _child(*arguments: str) -> None:
    subprocess.run([sys.executable, CHILD, *arguments], check=True, stdout=subprocess.DEVNULL)
