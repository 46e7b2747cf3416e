"""How long a command takes to start, beside the least that such a process can take.

    python benchmarks/startup.py [--quick] [--json FILE]

Each round runs all commands in turn.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import sysconfig

import common
from bikestab_cli.main import COMMANDS
from common import BICYCLE, Aim, Report, Table, Task, measure, short

HEAVY = ("scipy", "pydantic", "matplotlib", "h5py")


def heavy(name: str) -> list[str]:
    """Which of these packages the module of a command imports by itself."""
    program = f"import sys, bikestab_cli.{name}\nprint(*sorted({set(HEAVY)} & sys.modules.keys()))"
    return subprocess.run(
        [sys.executable, "-c", program], check=True, capture_output=True, text=True
    ).stdout.split()


def run(quick: bool) -> Report:
    """Time whole processes of the installed command."""
    command = shutil.which("bikestab", path=sysconfig.get_path("scripts")) or "bikestab"
    lines = {
        "vrange": ["bikestab vrange --bicycle " + BICYCLE, command, "vrange", "--bicycle", BICYCLE],
        "help": ["bikestab --help", command, "--help"],
        "numpy, click": ['python -c "import numpy, click"', sys.executable, "-c", "import numpy, click"],
        "python": ['python -c ""', sys.executable, "-c", ""],
        **{f"{name} --help": [f"bikestab {name} --help", command, name, "--help"] for name in COMMANDS},
    }
    tasks = {
        key: Task(name, lambda line=line: subprocess.run(line, check=True, stdout=subprocess.DEVNULL))
        for key, (name, *line) in lines.items()
    }
    measure(tasks.values(), rounds=2 if quick else 30)
    least = tasks["numpy, click"].best
    early = {name: heavy(name) for name in COMMANDS}
    assert not any(early.values()), f"imported before it is needed: {early}"
    rows = [[task.name, short(1e3 * task.best), short(task.best / least)] for task in tasks.values()]
    return Report(
        "Start-up: whole processes",
        [
            Table(["", "ms", "this / import numpy, click"], rows),
            f"No command's module imports {', '.join(HEAVY)} before it is run.",
        ],
        [Aim("vrange / import numpy, click", 1.1, tasks["vrange"].best / least, at_most=True)],
        {key: {"s": task.best} for key, task in tasks.items()},
    )


if __name__ == "__main__":
    common.main(__doc__, {"startup": run})
