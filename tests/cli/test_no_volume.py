"""Files that are no whole volume, given to every command that reads one: what is wrong, and what to do."""

import re
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

from bikestab.scan.run import run_scan
from tests.scans import config_of

COMMANDS = {
    "info": ["info", "{}"],
    "slice": ["slice", "{}", "--lam", "0.1", "-o", "new.png"],
    "export": ["export", "{}", "--intervals", "new.csv"],
    "report": ["report", "{}", "-o", "new.html"],
    "compare": ["compare", "{}", "meijaard2007"],
}
SCAN = "'bikestab scan CONFIG"
FILES = {  # a file, what is said of it, and of what to do
    "text.h5": ("is not an HDF5 file", "writes a volume: volume.h5 in its output folder"),
    "empty.h5": ("is empty", "writes a volume"),
    "noise.h5": ("is not an HDF5 file", "writes a volume"),
    "cut.h5": (r"is cut off: 9000 of its \d+ bytes are there", "copy it again, or 'bikestab scan"),
    "foreign.h5": ("is an HDF5 file, but no volume of bikestab", "a volume is volume.h5 in the folder"),
    "incomplete.h5": ("is incomplete", f"{SCAN} --force' writes it again"),
    "damaged.h5": (".*is damaged and cannot be read", f"{SCAN} --force' computes a"),
    "unfinished": ("holds a scan that is not finished", f"{SCAN}' goes on where it was stopped"),
    "folder": ("there is no such volume", f"{SCAN}' writes one"),
    "whole/volume": ("there is no such volume", "did you mean 'whole/volume.h5'?"),
    "none.h5": ("there is no such volume", "did you mean 'whole'?"),
}  # fmt: skip
WORDS_OF_OTHERS = {  # of compare, which takes bicycles and configs as well
    "text.h5": "is named as a volume, and is neither one nor a bicycle's file",
    "empty.h5": "is named as a volume, and is neither one nor",
    "noise.h5": "is named as a volume, and is neither one nor",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The files, made from one volume."""
    there = tmp_path_factory.mktemp("volumes")
    run_scan(config_of(output=there / "whole"))
    whole = (there / "whole" / "volume.h5").read_bytes()
    for name, content in (
        ("text.h5", b"hello\n"), ("empty.h5", b""), ("cut.h5", whole[:9000]),
        ("noise.h5", np.random.default_rng(1).bytes(3000)), ("incomplete.h5", whole), ("damaged.h5", whole),
    ):  # fmt: skip
        (there / name).write_bytes(content)
    with h5py.File(there / "incomplete.h5", "a") as file:
        file.attrs["complete"] = np.uint8(0)
    (there / "damaged.h5").write_bytes(whole[:2000] + whole[2000:].replace(b"TREE", b"EERT"))
    with h5py.File(there / "foreign.h5", "w") as file:
        file["x"] = [1, 2]
    (there / "folder").mkdir()
    (there / "unfinished").mkdir()
    (there / "unfinished" / "volume.h5.tiles").touch()
    return there


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", FILES)
def test_what_it_is_and_what_to_do(bikestab, folder, name, command):
    shutil.copytree(folder, ".", dirs_exist_ok=True)
    args = [word.format(name) for word in COMMANDS[command]]
    code, out, err = bikestab(*args)
    assert (code, out) == (2, "")
    problem, hint = FILES[name]
    if command == "compare" and name in WORDS_OF_OTHERS:
        problem, hint = WORDS_OF_OTHERS[name], ""
    first, *rest = err.splitlines()
    assert re.match(rf"error: {re.escape(name)}: ({problem})", first)
    assert hint in " ".join(rest)
    assert rest
    assert not list(Path().glob("new.*"))
