"""How long whole commands take, beside those of an earlier build of this program.

    python benchmarks/against.py REV                            the rows of benchmarks/README.md
    python benchmarks/against.py REV COMMAND...                 one command: scan configs/quick.yaml --force
    python benchmarks/against.py REV --columns                  columns and single designs in one process
    python benchmarks/against.py REV --now HEAD~1 --pairs 15    of two earlier builds

REV and what git has as HEAD are installed in environments of their own, in build/against, and run in turn in
folders of their own. Compared are the medians of processor times (of all their processes) and of wall times.
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
ROWS = {  # the command, and what has to be there
    "vrange --bicycle meijaard2007": "",
    f"scan {CONFIG} --force": "",
    f"scan {CONFIG} --force {SMALL}": "",
    "slice out/dikarev1981 --lam 0.2": f"scan {CONFIG} --set slices=[]",
    "eigen --lam 0.2 --sigma 0.08 -o modes.png": "",
    f"design {DESIGN}": "",
    f"design {DESIGN} -o design.png": "",
    "reproduce --quick": "",
}


def measured(programs: Path, command: str, folder: Path) -> tuple[float, float]:
    """Seconds of processor time and of wall time of one run."""
    environment = dict(os.environ)
    for name in ("PYTHONDONTWRITEBYTECODE", "PYTHONPATH"):  # an installed program is compiled only once
        environment.pop(name, None)
    before, start = os.times(), perf_counter()
    done = subprocess.run(
        [programs / "bikestab", *command.split()], cwd=folder, env=environment, capture_output=True, text=True
    )
    wall, now = perf_counter() - start, os.times()
    if done.returncode:
        raise SystemExit(f"bikestab {command}\n{done.stderr}")
    used = now.children_user + now.children_system - before.children_user - before.children_system
    return used, wall


def compared(command: str, needs: str, builds: tuple[Path, Path], pairs: int) -> str:
    """A row of the table: both builds' seconds, and how often the first one's hold the second's."""
    times: list[list[tuple[float, float]]] = [[], []]
    with TemporaryDirectory() as name:
        folders = [Path(name, side) for side in ("before", "now")]
        for folder, programs in zip(folders, builds, strict=True):
            shutil.copytree(HERE / "configs", folder / "configs")
            for each in (needs, command):  # the first run finds what is on the disk
                if each:
                    measured(programs, each, folder)
        for _ in range(pairs):
            for k, (folder, programs) in enumerate(zip(folders, builds, strict=True)):
                times[k].append(measured(programs, command, folder))
    old, new = ([median(run[i] for run in runs) for i in (0, 1)] for runs in times)
    cells = [f"{old[i]:.2f} | {new[i]:.2f} | {old[i] / new[i]:.2f}" for i in (0, 1)]
    return f"| `{command}` | {' | '.join(cells)} |"


def columns(builds: tuple[Path, Path], pairs: int) -> None:
    """Print what ``calls.py`` measures in both builds."""
    child = Path(__file__).with_name("calls.py")
    found: list[list[dict[str, float]]] = [[], []]
    for _ in range(pairs):
        for k, programs in enumerate(builds):
            run = subprocess.run([programs / "python", child], check=True, capture_output=True, cwd="/")
            found[k].append(json.loads(run.stdout))
    print(f"{'':48} {'before':>10} {'now':>10} {'ratio':>6}   (ns; medians of {pairs})")
    for name in found[0][0]:
        old, new = (median(one[name] for one in runs) for runs in found)
        print(f"{name:48} {old:10.0f} {new:10.0f} {old / new:6.2f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("revision", metavar="REV")
    parser.add_argument("command", nargs=argparse.REMAINDER, metavar="COMMAND")
    parser.add_argument("--now", default="HEAD", metavar="REV")
    parser.add_argument("--pairs", type=int, default=7)
    parser.add_argument("--columns", action="store_true")
    asked = parser.parse_args()
    builds = built(asked.revision), built(asked.now)
    if asked.columns:
        columns(builds, asked.pairs)
        return
    rows = {" ".join(asked.command): ""} if asked.command else ROWS
    print("| command | before: processor [s] | now | ratio | before: wall [s] | now | ratio |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for command, needs in rows.items():
        print(compared(command, needs, builds, asked.pairs), flush=True)


if __name__ == "__main__":
    main()
