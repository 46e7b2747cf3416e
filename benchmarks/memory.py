"""How much memory a scan takes above its imports, for grids of different sizes and shapes.

    python benchmarks/memory.py [--quick] [--json FILE]

Peaks are those of whole processes, pictures included.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import common
from command import ALL, MASKS, imports, scan
from common import DELTA, Aim, Report, Table

AIM = 300  # MB above the imports


def run(quick: bool) -> Report:
    """Run the command on each grid in one process and in two."""
    cases: list[tuple[tuple[int, int, int], tuple[str, ...], float]] = [((64, 64, 64), MASKS, 0.0)]
    if not quick:
        cases += [
            ((256, 256, 256), MASKS, 0.0),
            ((512, 512, 512), MASKS, 0.0),
            ((2048, 2048, 8), MASKS, 0.0),
            ((2048, 2048, 8), MASKS, DELTA),
            ((100, 100, 20_000), MASKS, 0.0),
            ((256, 256, 256), ALL, 0.0),
            ((100, 100, 5_000), ALL, 0.0),
        ]
    report, rows, most = Report("Memory: MB above what the imports take"), [], 0.0
    with TemporaryDirectory(prefix="bikestab-benchmark-") as name:
        folder = Path(name)
        for shape, fields, delta in cases:
            runs = {jobs: scan(folder, shape, fields, jobs, delta) for jobs in ((1,) if quick else (1, 2))}
            least = imports(folder, runs[1].modules)
            above = [(run.peak - least) / 1e6 for run in runs.values()]
            workers = [(max(run.workers) / 1e6) for run in runs.values() if run.workers]
            most = max(most, *above)
            words = " × ".join(map(str, shape)) + (" + growth_rate" if fields == ALL else "")
            words += f", δ = {delta:g}" if delta else ""
            cells = [f"{x:.0f}" for x in (*above, *workers)]
            rows.append([words, f"{least / 1e6:.0f}", *cells, *[""] * (3 - len(cells))])
            report.data[words] = {
                "imports": least, "peaks": {jobs: run.peak for jobs, run in runs.items()},
                "largest worker": max(runs[max(runs)].workers, default=None),
            }  # fmt: skip
    head = ["", "imports", "1 process, above", "2 processes, main, above", "largest worker, in all"]
    report.parts.append(Table(head, rows))
    report.aims.append(Aim("MB above the imports, any grid", AIM, most, at_most=True))
    return report


if __name__ == "__main__":
    common.main(__doc__, {"memory": run})
