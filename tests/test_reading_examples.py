"""The examples of docs/format.md read a volume and print what they say: Python, and Node where it is."""

import re
import shutil
import subprocess
from pathlib import Path

import h5py
import pytest

from bikestab.config.file import load_config
from bikestab.hdf5 import check_whole
from bikestab.scan.run import run_scan

ROOT = Path(__file__).parents[1]
PACKAGES = ROOT / "tests" / "report" / "node_modules"  # where its package.json is installed


def blocks(kind):
    text = (ROOT / "docs" / "format.md").read_text("utf-8")
    return re.findall(rf"^```{kind}\n(.*?)^```", text, re.M | re.S)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the volume of the quick scan."""
    folder = tmp_path_factory.mktemp("reading")
    run_scan(load_config(ROOT / "configs" / "quick.yaml", [f"output={folder / 'out' / 'quick'}"]))
    return folder


def test_every_program_has_an_example():
    kinds = ("python", "js", "matlab", "octave", "r", "julia")
    assert [len(blocks(kind)) for kind in kinds] == [3, 1, 1, 1, 1, 1]


@pytest.mark.parametrize("block", blocks("python"), ids=["xarray", "plain", "pyvista"])
def test_python(block, folder, monkeypatch, capsys):
    for package in re.findall(r"^import (\w+)", block, re.M):
        pytest.importorskip(package)
    monkeypatch.chdir(folder)
    exec(compile(block, "docs/format.md", "exec"), {})
    expected = re.findall(r"^ *print\(.*\)  # (.*)$", block, re.M)
    assert expected
    assert capsys.readouterr().out.splitlines() == expected


@pytest.mark.parametrize("ending", [".hdf", ".vtkhdf"])
def test_what_chooses_by_the_ending(folder, ending):
    """ParaView does too, and 5.11 knows the first alone."""
    pyvista = pytest.importorskip("pyvista")
    link = (folder / "volume").with_suffix(ending)
    link.hardlink_to(folder / "out" / "quick" / "volume.h5")
    assert pyvista.read(link).dimensions == (51, 31, 31)


def in_node(text, package, folder):
    """What a program prints."""
    node = shutil.which("node")
    if not node or not (PACKAGES / package).exists():
        pytest.skip(f"there is no Node, or no {package}: npm install, in tests/report")
    (folder / "node_modules").unlink(missing_ok=True)
    (folder / "node_modules").symlink_to(PACKAGES)
    (folder / "read.mjs").write_text(text, "utf-8")
    done = subprocess.run([node, "read.mjs"], cwd=folder, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


def test_h5wasm(folder):
    (block,) = blocks("js")
    expected = re.findall(r"^console.log\(.*\); // (.*)$", block, re.M)
    assert expected
    assert in_node(block, "h5wasm", folder) == expected


def test_jsfive_shows_the_files_attributes(folder):
    """It shows none of a group that keeps them in an index of their own."""
    program = """\
import { readFileSync } from "node:fs";
import * as hdf5 from "jsfive";
const bytes = new Uint8Array(readFileSync("out/quick/volume.h5"));
const file = new hdf5.File(bytes.buffer, "volume.h5");
for (const [name, value] of Object.entries(file.attrs)) console.log(name, JSON.stringify(value));
console.log("marginal", file.get("marginal").value.join(""));
"""
    with h5py.File(folder / "out" / "quick" / "volume.h5") as file:
        assert len(file.attrs) > 8
        names = set(file.attrs)
        title = file.attrs["title"]
    shown = in_node(program, "jsfive", folder)
    *shown, marginal = shown
    assert marginal.split() == ["marginal", "0" * 31 * 31]
    assert {line.split()[0] for line in shown} == names
    assert f'title "{title}"' in shown


def test_every_chunk_is_stored(folder):
    """In what bikestab wrote: without one jsfive gives nothing, and pyfive breaks."""
    with h5py.File(folder / "out" / "quick" / "volume.h5") as file:
        chunked = []
        file.visititems(lambda name, data: chunked.append(data) if getattr(data, "chunks", None) else None)
        assert len(chunked) > 15
        assert not file["marginal"][()].any()
        for data in chunked:
            check_whole(data)


def test_attributes_are_stored_in_the_files_first_object(folder):
    """That object has HDF5's first kind of header, which knows no index of attributes."""
    with h5py.File(folder / "out" / "quick" / "volume.h5") as file:
        offset = h5py.h5o.get_info(file.id).addr
    content = (folder / "out" / "quick" / "volume.h5").read_bytes()
    assert content[offset : offset + 2] == b"\x01\x00"


def test_links_for_paraview_are_soft(folder):
    """With hard ones kerchunk loses the fields."""
    with h5py.File(folder / "out" / "quick" / "volume.h5") as file:
        points = file["VTKHDF/PointData"]
        for name in points:
            assert points.get(name, getlink=True).path == f"/{name}"
            assert points[name] == file[name]
