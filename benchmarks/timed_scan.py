"""The command 'bikestab scan' with a clock around its parts: what ``scans`` and ``memory`` run as a process.

    python benchmarks/timed_scan.py RESULT.json START jobs ARGUMENTS...
    python benchmarks/timed_scan.py RESULT.json imports MODULES.json

START is the ``time.perf_counter`` of the one who starts it. With one job the evaluation is split, too. The
second form only imports what a run has imported, to tell how much memory that takes.
"""

from __future__ import annotations

import importlib
import json
import multiprocessing
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

KEPT_OUT = ("__main__", "__mp_main__")


class Clock:
    """Seconds spent in each part, without those in a part within it."""

    def __init__(self, start: float) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self._open = ["start-up"]
        self._since = start

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        self._count()
        self._open.append(name)
        try:
            yield
        finally:
            self._count()
            self._open.pop()

    def stop(self) -> None:
        self._count()

    def _count(self) -> None:
        now = time.perf_counter()
        self.seconds[self._open[-1]] += now - self._since
        self._since = now

    def around(self, owner: Any, name: str, part: str | Callable[..., str]) -> None:
        """Put a function in another's place that does the same and is counted."""
        inner = getattr(owner, name)

        def counted(*args: Any, **keywords: Any) -> Any:
            with self.part(part if isinstance(part, str) else part(*args)):
                return inner(*args, **keywords)

        setattr(owner, name, counted)


def peak(pid: int | str = "self") -> int:
    """The largest resident memory of a process so far [bytes]; ``ru_maxrss`` has the parent's in it."""
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmHWM"):
            return 1024 * int(line.split()[1])
    return 0


def put_clocks(clock: Clock, jobs: int, workers: list[int]) -> None:
    """Around the parts of a scan; at the end ``workers`` has the peak memory of each process."""
    from bikestab import aside
    from bikestab.plot import pictures
    from bikestab.scan import processes, run, tile
    from bikestab.scan.bracketing import Bracketing
    from bikestab.scan.spool import Spool

    clock.around(run, "run_scan", "rest")
    clock.around(run, "assemble", "writing")
    clock.around(Bracketing, "add", "scipy as a witness")
    clock.around(Bracketing, "agreement", "scipy as a witness")
    clock.around(Spool, "add", "keeping tiles")
    clock.around(pictures, "draw_without_volume", "pictures")
    aside.cores = lambda: 1  # else they are drawn while the scan runs, by a process of their own
    if jobs == 1:
        clock.around(processes, "compute", "evaluation: stable, violated")
        clock.around(tile, "check", "evaluation: the check")
        clock.around(tile, "_columns", "evaluation: intervals")
        clock.around(
            tile, "field_values",
            lambda name, *_: f"evaluation: {name if name == 'growth_rate' else 'stable, violated'}",
        )  # fmt: skip
        clock.around(tile, "packed", "compression")
        return
    process = multiprocessing.process.BaseProcess
    kill = process.kill

    def noted(self: Any) -> None:
        with suppress(OSError):
            workers.append(peak(self.pid))
        kill(self)

    process.kill = noted  # type: ignore[method-assign]  # so a worker ends


def timed(start: float, jobs: int, arguments: list[str]) -> dict[str, Any]:
    clock, workers = Clock(start), list[int]()
    put_clocks(clock, jobs, workers)
    from bikestab_cli.main import main

    sys.argv = ["bikestab", "scan", *arguments, "--jobs", str(jobs), "--quiet"]
    try:
        main()
    except SystemExit as end:
        if end.code:
            raise
    clock.stop()
    modules = [name for name in sys.modules if name not in KEPT_OUT]
    return {"seconds": clock.seconds, "peak": peak(), "workers": workers, "modules": modules}


def imported(modules: list[str]) -> dict[str, Any]:
    for name in modules:
        with suppress(Exception):
            importlib.import_module(name)
    return {"peak": peak()}


if __name__ == "__main__":
    result, first, *rest = sys.argv[1:]
    if first == "imports":
        found = imported(json.loads(Path(rest[0]).read_text()))
    else:
        found = timed(float(first), int(rest[0]), rest[1:])
    Path(result).write_text(json.dumps(found))
