"""How long whole commands take, beside those of an earlier build of this program.

    python benchmarks/against.py REV                            the table of benchmarks/README.md
    python benchmarks/against.py REV COMMAND...                 one command: scan configs/quick.yaml --force
    python benchmarks/against.py REV --columns                  columns and single designs in one process
    python benchmarks/against.py REV --now HEAD~1 --pairs 15    of two earlier builds

REV and what git has as HEAD are installed in environments of their own, in build/against, and run in turn in
folders of their own. Compared are the medians of wall times and of processor times (of all their processes).
Pairs end when a row's share of the minutes is over, with three at least.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from builds import HERE, built

CONFIG = "configs/dikarev1981.yaml"
SMALL = (
    "--set grid.lam.num=8 --set grid.sigma.num=8 --set grid.V.num=8 --set slices=[] --set output=out/small"
)
DESIGN = "--bicycle meijaard2007 --V 5"
QUICK = "scan configs/quick.yaml --set slices=[]"
ROWS = {  # the command, what has to be there, and how many times as fast it should be, if that is an aim
    "vrange --bicycle meijaard2007": ("", 0.0),
    f"scan {CONFIG} --force": ("", 2.5),
    f"scan {CONFIG} --force {SMALL}": ("", 2.5),
    "slice out/quick --lam 0.2": (QUICK, 1.8),
    "eigen --lam 0.2 --sigma 0.08 -o modes.png": ("", 1.8),
    f"design {DESIGN}": ("", 2.0),
    f"design {DESIGN} -o design.png": ("", 2.0),
    "export out/quick --mesh m.ply --cells 100": (QUICK, 2.0),
    "reproduce --quick": ("", 3.0),
}
NAMES = {f"scan {CONFIG} --force {SMALL}": "`scan` of 8³ points without slices"}
LEAST = 3  # pairs
OTHERS = "PYTHONDONTWRITEBYTECODE", "PYTHONPATH"  # an installed program is itself, and compiled only once
ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in OTHERS}


def measured(programs: Path, command: str, folder: Path) -> tuple[float, float]:
    """Seconds of processor time and of wall time of one run."""
    before, start = os.times(), perf_counter()
    done = subprocess.run(
        [programs / "bikestab", *command.split()], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True
    )
    wall, now = perf_counter() - start, os.times()
    if done.returncode:
        raise SystemExit(f"bikestab {command}\n{done.stderr}")
    used = now.children_user + now.children_system - before.children_user - before.children_system
    return used, wall


def compared(
    command: str, needs: str, target: float, builds: tuple[Path, Path], pairs: int, seconds: float
) -> str:
    """A row of the table: both builds' seconds, and how often the second one's go into the first's."""
    times: list[list[tuple[float, float]]] = [[], []]
    start = perf_counter()
    with TemporaryDirectory() as name:
        folders = [Path(name, side) for side in ("before", "now")]
        for folder, programs in zip(folders, builds, strict=True):
            shutil.copytree(HERE / "configs", folder / "configs")
            for each in (needs, command):  # the first run finds what is on the disk
                if each:
                    measured(programs, each, folder)
        while len(times[0]) < pairs and (len(times[0]) < LEAST or perf_counter() - start < seconds):
            for k, (folder, programs) in enumerate(zip(folders, builds, strict=True)):
                times[k].append(measured(programs, command, folder))
    old, new = ([median(run[i] for run in runs) for i in (0, 1)] for runs in times)
    cells = [f"{old[i]:.2f} | {new[i]:.2f} | {old[i] / new[i]:.2f}" for i in (1, 0)]
    aim = f"{target:g}: {'' if old[1] / new[1] >= target else 'not '}reached" if target else ""
    return f"| {NAMES.get(command, f'`{command}`')} | {' | '.join(cells)} | {len(times[0])} | {aim} |"


def columns(builds: tuple[Path, Path], pairs: int) -> None:
    """Print what ``calls.py`` measures in both builds."""
    child = Path(__file__).with_name("calls.py")
    found: list[list[dict[str, float]]] = [[], []]
    for _ in range(pairs):
        for k, programs in enumerate(builds):
            run = subprocess.run(
                [programs / "python", child], check=True, capture_output=True, cwd="/", env=ENVIRONMENT
            )
            found[k].append(json.loads(run.stdout))
    print(f"{'':48} {'before':>10} {'now':>10} {'ratio':>6}   (ns; medians of {pairs})")
    for name in found[0][0]:
        old, new = (median(one[name] for one in runs) for runs in found)
        print(f"{name:48} {old:10.0f} {new:10.0f} {old / new:6.2f}")


def main() -> None:
    parser = argparse.ArgumentParser(  # the rest is the revision, and the command with its options
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter, allow_abbrev=False,
        usage="against.py REV [COMMAND...] [--now REV] [--pairs N] [--columns] [--minutes N]",
    )  # fmt: skip
    parser.add_argument("--now", default="HEAD", metavar="REV")
    parser.add_argument("--pairs", type=int, default=7)
    parser.add_argument("--columns", action="store_true")
    parser.add_argument("--minutes", type=float, default=12.0, help="for all rows together (12)")
    asked, words = parser.parse_known_args()
    if not words:
        parser.error("which revision?")
    revision, *command = words
    builds = built(revision), built(asked.now)
    if asked.columns:
        columns(builds, asked.pairs)
        return
    rows = {" ".join(command): ("", 0.0)} if command else ROWS
    end = perf_counter() + 60 * asked.minutes
    print("| command | before: wall [s] | now | ratio | before: processor [s] | now | ratio | pairs | aim |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---|")
    for left, (command, (needs, target)) in zip(range(len(rows), 0, -1), rows.items(), strict=True):
        share = (end - perf_counter()) / left  # what one row leaves over is the others'
        print(compared(command, needs, target, builds, asked.pairs, share), flush=True)


if __name__ == "__main__":
    main()
