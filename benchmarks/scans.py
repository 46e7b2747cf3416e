"""How long a scan takes from end to end, what with, and beside writing the same bytes uncompressed.

    python benchmarks/scans.py [--quick] [--json FILE]

Every run is a process of its own, from its start to its end.
"""

from __future__ import annotations

import os
import time
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import common
import h5py
import numpy as np
from command import ALL, MASKS, Run, scan
from common import DELTA, Aim, Report, Table, short

from bikestab.fields import FIELDS

SIZES = (64, 128, 256, 512)  # points along each axis
AIMED = 512  # of the scan that aims are set for
PARTS = {
    "start-up": ("start-up",),
    "evaluation": ("evaluation",),
    "of it growth_rate": ("evaluation: growth_rate",),
    "compression": ("compression",),
    "keeping tiles": ("keeping tiles",),
    "writing": ("writing",),
    "scipy as a witness": ("scipy as a witness",),
    "pictures": ("pictures",),
    "rest": ("rest", "exit"),
}


def written(folder: Path, size: int, fields: tuple[str, ...], chunked: bool) -> float:
    """Seconds to write fields of that many points along each axis uncompressed with h5py."""
    path = folder / "plain.h5"
    values = {name: np.ones((size,) * 3, FIELDS[name].dtype) for name in fields}
    path.unlink(missing_ok=True)
    os.sync()
    start = time.perf_counter()
    with h5py.File(path, "w") as file:
        for name, array in values.items():
            file.create_dataset(name, data=array, chunks=(min(32, size),) * 3 if chunked else None)
    seconds = time.perf_counter() - start
    path.unlink()
    return seconds


def cases(quick: bool) -> list[tuple[int, tuple[str, ...], float, int]]:
    """Points along each axis, fields, damping, and how often it is run."""
    if quick:
        return [(SIZES[0], fields, 0.0, 1) for fields in (MASKS, ALL)]
    return [
        *((size, MASKS, 0.0, 5) for size in SIZES),
        (AIMED, MASKS, DELTA, 3),
        *((size, ALL, 0.0, 2) for size in SIZES),
    ]


def run(quick: bool) -> Report:
    """Run the command on growing grids, one job and two, and beside it h5py."""
    report = Report("Scans: seconds of the command, each run a process of its own")
    split, whole = [], []
    with TemporaryDirectory(prefix="bikestab-benchmark-") as name:
        folder = Path(name)
        for size, fields, delta, times in cases(quick):
            one, two, plain = [], [], {False: list[float](), True: list[float]()}
            for _ in range(times):
                for chunked, seconds in plain.items():
                    seconds += [written(folder, size, fields, chunked) for _ in range(1 if quick else 4)]
                one.append(scan(folder, (size,) * 3, fields, 1, delta))
                if not quick or fields == MASKS:
                    two.append(scan(folder, (size,) * 3, fields, 2, delta))
            best, other = (min(runs, key=lambda r: r.scan, default=None) for runs in (one, two))
            assert best is not None
            ratios = {chunked: best.scan / min(seconds) for chunked, seconds in plain.items()}
            words = f"{size}³ " + ("+ growth_rate" if fields == ALL else "stable, violated")
            words += f", δ = {delta:g}" if delta else ""
            split.append([words, *(short(best.share(*parts)) for parts in PARTS.values()), short(best.total)])
            whole.append([
                words, short(best.scan), short(other.scan) if other else "", _range(plain[False]),
                _range(plain[True]), short(ratios[False]), short(ratios[True]),
                short(best.share("evaluation") / best.scan),
            ])  # fmt: skip
            report.data[words] = _data(best, other, plain)
            if size == AIMED and fields == MASKS and not delta:
                for chunked, ratio in ratios.items():
                    how = "in chunks as the volume's" if chunked else "contiguous"
                    by = f"run_scan / h5py uncompressed {how}, {words}"
                    report.aims.append(Aim(by, 4, ratio, at_most=True))
            elif size == AIMED and fields == ALL:
                share = best.share("evaluation") / best.scan
                report.aims.append(Aim(f"evaluation / run_scan, {words}", 0.85, share))
    report.parts += [
        "One process, split:", Table(["", *PARTS, "all"], split),
        "run_scan alone, until the volume has its name, and h5py (best … worst):",
        Table(
            ["", "1 process", "2 processes", "h5py contiguous", "h5py in chunks", "1 process / contiguous",
             "1 process / in chunks", "evaluation / 1 process"],
            whole,
        ),
    ]  # fmt: skip
    return report


def _range(seconds: list[float]) -> str:
    return f"{short(min(seconds))} … {short(max(seconds))}"


def _data(one: Run, two: Run | None, plain: dict[bool, list[float]]) -> dict[str, Any]:
    return {
        "1 process": {"s": one.seconds, "run_scan": one.scan, "all": one.total},
        "2 processes": two and {"s": two.seconds, "run_scan": two.scan, "all": two.total},
        "h5py contiguous": plain[False],
        "h5py in chunks": plain[True],
    }


if __name__ == "__main__":
    common.main(__doc__, {"scans": run})
