"""The programs and the notebook in examples/, and the Python in the README, run and print what they say."""

import re
import runpy
import shutil
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import pytest

ROOT = Path(__file__).parents[1]
PROGRAMS = sorted((ROOT / "examples").glob("*.py"))
NOTEBOOKS = sorted((ROOT / "examples").glob("*.ipynb"))


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with the configs and the examples' files, the current one; pictures need no screen."""
    shutil.copytree(ROOT / "configs", tmp_path / "configs")
    for file in (ROOT / "examples").iterdir():
        shutil.copy(file, tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["example"])
    matplotlib.use("agg")
    yield tmp_path
    plt.close("all")


def test_there_are_some():
    assert len(PROGRAMS) >= 3
    assert NOTEBOOKS


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.name)
def test_programs(path, folder, capsys):
    text = path.read_text("utf-8")
    if "xarray" in text:
        pytest.importorskip("h5netcdf")
    runpy.run_path(str(path), run_name="__main__")
    assert len(capsys.readouterr().out.splitlines()) >= 2
    for picture in re.findall(r'savefig\("(.*?)"', text):
        assert (folder / picture).stat().st_size > 10_000


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.name)
def test_notebooks_print_what_they_hold(path, folder):
    """To bring their outputs up to date: jupyter execute --inplace examples/*.ipynb."""
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    held = nbformat.read(path, as_version=4)
    cells = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(cells, timeout=120, kernel_name="python3").execute(cwd=str(folder))
    for old, new in zip(held.cells, cells.cells, strict=True):
        assert texts(new) == texts(old), new.source


def texts(cell):
    """What a cell prints, and what it shows, pictures as their size."""
    outputs = cell.get("outputs", [])
    printed = "".join(output.text for output in outputs if output.output_type == "stream")
    return printed, [output.data["text/plain"] for output in outputs if "data" in output]


def blocks():
    return re.findall(r"^```python\n(.*?)^```", (ROOT / "README.md").read_text("utf-8"), re.M | re.S)


@pytest.mark.parametrize("block", blocks(), ids=range(len(blocks())))
def test_readme(block, folder, capsys):
    """What a line prints stands behind it, as ``print(...)  # 4.29``."""
    if "xarray" in block:
        pytest.importorskip("h5netcdf")
    exec(compile(block, "README.md", "exec"), {})
    expected = re.findall(r"^print\(.*\) +# (.*)$", block, re.M)
    assert capsys.readouterr().out.splitlines() == expected
