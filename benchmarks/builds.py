"""A revision of this program → a virtual environment of its own, in ``build/against`` beside this tree.

Each is installed from what git has of that revision, so that all builds are alike in everything but the code.
"""

from __future__ import annotations

import subprocess
import sys
import tarfile
from io import BytesIO
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
FOLDER = HERE / "build" / "against"
WITH = ["numpy", "scipy", "h5py", "matplotlib", "contourpy", "click", "pyyaml", "pydantic", "isal"]


def sha(revision: str) -> str:
    """The commit that a revision names."""
    return _git("rev-parse", "--verify", f"{revision}^{{commit}}").decode().strip()


def built(revision: str) -> Path:
    """The folder of the programs of a revision's environment, which is made unless it is there."""
    commit = sha(revision)
    folder = FOLDER / commit[:12]
    programs = folder / "venv" / "bin"
    if not (programs / "bikestab").exists():
        with tarfile.open(fileobj=BytesIO(_git("archive", commit))) as archive:
            archive.extractall(folder / "source", filter="data")
        subprocess.run([sys.executable, "-m", "venv", folder / "venv"], check=True)
        same = [f"{name}=={version}" for name, version in _versions().items()]
        pip = [programs / "python", "-m", "pip", "install", "-q"]
        subprocess.run([*pip, *same], check=True)
        subprocess.run([*pip, folder / "source"], check=True)
    return programs


def _versions() -> dict[str, str]:
    """Those of the packages here, for all builds."""
    from importlib.metadata import version

    return {name: version(name) for name in WITH}


def _git(*words: str) -> bytes:
    return subprocess.run(["git", "-C", HERE, *words], check=True, capture_output=True).stdout
