"""bikestab export: files, what it tells, and mistakes."""

import csv
import json
import shutil
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from bikestab import yamltext
from bikestab.config.file import load_config, parse_config
from bikestab.files import MAKE_ROOM
from bikestab.scan.run import run_scan

pyvista = pytest.importorskip("pyvista")
parquet = pytest.importorskip("pyarrow.parquet")

SCAN = """\
bicycle: BICYCLE
delta: 0
grid:
  lam: {start: START, stop: 0.3, num: 4}
  sigma: {start: 0.03, stop: 0.15, num: 4}
  V: {values: [0, 3, 10]}
output: OUT
"""


@pytest.fixture(scope="module")
def volumes(tmp_path_factory):
    """The folders of two volumes, and of one whose box has no stable design."""
    folders = {}
    for name, bicycle, start in (
        ("1981", "dikarev1981", "0.1"), ("2007", "meijaard2007", "0.1"), ("empty", "dikarev1981", "0"),
    ):  # fmt: skip
        folder = tmp_path_factory.mktemp(f"volume{name}")
        text = SCAN.replace("OUT", str(folder)).replace("BICYCLE", bicycle).replace("START", start)
        if name == "empty":
            text = text.replace("stop: 0.3", "stop: 0.1").replace("stop: 0.15", "stop: 0.05")
        run_scan(parse_config(yamltext.parse(text, "scan.yaml")))
        folders[name] = folder
    return folders


def mistake(result, *expected):
    code, out, err = result
    assert (code, out) == (2, "")
    assert err.startswith("error: ")
    for words in expected:
        assert words in err
    assert len(err.splitlines()) <= 3


@pytest.mark.parametrize("name", ["1981", "2007"])
def test_all_at_once(bikestab, volumes, tmp_path, name):
    wanted = ["--mesh", "r.vtp", "--mesh", "r.stl", "--intervals", "i.csv", "--skeleton", "s.parquet"]
    code, out, err = bikestab("export", volumes[name], *wanted, "--cells", 30)
    assert (code, err) == (0, "")
    lines = dict(line.split(": ", 1) for line in out.splitlines())
    assert (
        set(lines) == {"r.vtp", "r.stl", "i.csv", "s.parquet"} == {path.name for path in tmp_path.iterdir()}
    )
    surface = pyvista.read("r.vtp")
    weave, capsize = (int((surface.cell_data["kind"] == kind).sum()) for kind in (1, 2))
    assert lines["r.vtp"] == (
        f"{surface.n_points} points, {surface.n_cells} triangles ({weave} weave, {capsize} capsize); "
        "x = 50 lam, y = 100 sigma, z = 1 V"
    )
    assert surface.point_data["V"].max() <= 10
    assert surface.field_data["source"][0].startswith("bikestab ")
    with Path("i.csv").open() as file:
        rows = list(csv.DictReader(file))
    without = 16 - len({(row["lam"], row["sigma"]) for row in rows})
    words = f"{without} of 16 designs have no stable speed and no row"
    assert lines["i.csv"] == f"{len(rows)} intervals; {words}"
    table = parquet.read_table("s.parquet")
    named = list(zip(table["curve"].to_pylist(), table["name"].to_pylist(), strict=True))
    names = {curve: name for curve, name in named if curve}
    ends = [name for curve, name in named if not curve]
    infinite = {"1981": ["capsize at infinity"], "2007": []}[name]  # told whatever the volume's last speed
    assert list(names.values()) == ["weave meets capsize", *infinite]
    told = f"{len(names)} curve{'s' * len(infinite)} of {table.num_rows - len(ends)} points"
    assert lines["s.parquet"].partition("; where they meet or end: ")[0] == told
    assert ("; where they meet or end: " in lines["s.parquet"]) == bool(ends)


def test_intervals_are_those_of_vrange(bikestab, volumes):
    assert bikestab("export", volumes["2007"], "--intervals", "i.csv")[0] == 0
    with Path("i.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["sigma"] == "0.15"]
    _, out, _ = bikestab(
        "vrange", "--bicycle", "meijaard2007", "--lam", "0.1:0.3:4", "--sigma", 0.15, "--json"
    )
    expected = [
        (interval["V1"], interval["V2"], interval["lower"], interval["upper"])
        for cell in json.loads(out)["results"]
        for interval in cell["intervals"]
    ]
    assert len(rows) == len(expected) > 2
    for row, interval in zip(rows, expected, strict=True):
        np.testing.assert_allclose([float(row["V1"]), float(row["V2"])], interval[:2], rtol=1e-11)
        assert (row["lower"], row["upper"]) == interval[2:]


def test_scale_of_ones_own(bikestab, volumes):
    args = ("export", volumes["1981"], "--mesh", "r.vtp", "--cells", 10, "--scale", "1, 2.5,1e-1")
    code, out, _ = bikestab(*args)
    assert code == 0
    assert out.endswith("; x = 1 lam, y = 2.5 sigma, z = 0.1 V\n")
    surface = pyvista.read("r.vtp")
    lam, sigma, V = (surface.point_data[name] for name in ("lam", "sigma", "V"))
    np.testing.assert_array_equal(surface.points.T, [lam, 2.5 * sigma, 0.1 * V])


def test_an_existing_file_is_replaced(bikestab, volumes, tmp_path):
    (tmp_path / "i.csv").write_text("old")
    code, _, err = bikestab("export", volumes["1981"], "--intervals", "i.csv")
    assert code == 0, err
    assert (tmp_path / "i.csv").read_text().startswith("lam,sigma,")


def test_a_box_without_stable_design(bikestab, volumes, tmp_path):
    wanted = ["--mesh", "r.vtp", "--intervals", "i.csv", "--skeleton", "s.parquet"]
    code, out, err = bikestab("export", volumes["empty"], *wanted, "--cells", 20)
    assert (code, err) == (0, "")
    assert out == (
        "i.csv: 0 intervals; 16 of 16 designs have no stable speed and no row\n"
        "s.parquet: 0 curves: no design has a stable speed in lam 0 ... 0.1 and sigma 0.03 ... 0.05; "
        "a larger box may have some\n"
        "no surface in the box: no mesh is written (r.vtp)\n"
    )
    assert {path.name for path in tmp_path.iterdir()} == {"i.csv", "s.parquet"}
    assert (tmp_path / "i.csv").read_text().count("\n") == 1


def test_a_box_whose_designs_are_alike_has_no_curve(bikestab, tmp_path):
    """Of one machine of a sweep, which the skeleton takes by --at."""
    axes = "lam: {start: 12deg, stop: 24deg, num: 3}, sigma: {start: 0.02, stop: 0.14, num: 3}"
    text = f"bicycle: meijaard2007\ngrid: {{{axes}, V: {{values: [1, 5]}}}}\n"
    text += "sweep: {delta: [0, 1]}\noutput: out\nslices: []\n"
    Path("few.yaml").write_text(text)
    run_scan(load_config("few.yaml"))
    mistake(bikestab("export", "out", "--skeleton", "s.csv"), "choose one, for example --at delta=0")
    code, out, _ = bikestab("export", "out", "--skeleton", "s.csv", "--at", "delta=1")
    assert code == 0
    assert out == (
        "s.csv: 0 curves: all designs are stable from weave to capsize in lam 0.20944 ... 0.418879 and "
        "sigma 0.02 ... 0.14; a larger box may have some\n"
    )


# --- mistakes


def test_nothing_wanted(bikestab, volumes):
    mistake(bikestab("export", volumes["1981"]), "give --mesh, --intervals, --skeleton or --quantiles")


@pytest.mark.parametrize(
    ("option", "value", "expected"),
    [
        ("--mesh", "r.vtq", "did you mean '.vt"),
        ("--mesh", "r.csv", "known: .vtp, .vtu, .ply, .stl"),
        ("--mesh", "r", "has no ending"),
        ("--intervals", "i.xlsx", "known: .csv, .parquet"),
        ("--skeleton", "s.cvs", "did you mean '.csv'?"),
        ("--cells", "5", "10<=x<=400"),
        ("--scale", "1,2", "'1,2' is not three numbers from 1e-9 to 1e9 such as 50,100,1"),
        ("--scale", "1,1e300,1", "not three numbers"),
        ("--skeleton", "good.csv", "good.csv is asked for twice"),
        ("--scale", "1,0,1", "not three numbers"),
        ("--scale", "1,inf,1", "not three numbers"),
        ("--scale", "1,nan,1", "not three numbers"),
        ("--scale", "a,b,c", "not three numbers"),
    ],
)
def test_mistakes_in_options(bikestab, volumes, tmp_path, option, value, expected):
    mistake(bikestab("export", volumes["1981"], "--intervals", "good.csv", option, value), expected)
    assert not list(tmp_path.iterdir())  # told before anything is written


@pytest.mark.parametrize(
    ("option", "name", "package"),
    [
        ("--mesh", "r.vtp", "vtkmodules"),
        ("--mesh", "r.vtu", "vtkmodules"),
        ("--intervals", "i.parquet", "pyarrow"),
    ],
)
def test_missing_extra(bikestab, volumes, monkeypatch, tmp_path, option, name, package):
    monkeypatch.setitem(sys.modules, package, None)
    mistake(
        bikestab("export", volumes["1981"], option, name),
        f'error: {name}: needs the extra: pip install "bikestab[export]"\n',
    )
    assert not list(tmp_path.iterdir())


def test_csv_ply_and_stl_need_no_extra(bikestab, volumes, monkeypatch):
    for package in ("pyarrow", "vtkmodules"):
        monkeypatch.setitem(sys.modules, package, None)
    wanted = ["--mesh", "r.ply", "--mesh", "r.stl", "--intervals", "i.csv"]
    code, out, _ = bikestab("export", volumes["1981"], *wanted, "--cells", 10)
    assert (code, len(out.splitlines())) == (0, 3)


@pytest.mark.parametrize("ending", [".vtp", ".ply", ".csv", ".parquet"])
def test_folder_that_is_not_there(bikestab, volumes, ending):
    name = f"nowhere/file{ending}"
    option = "--intervals" if ending in (".csv", ".parquet") else "--mesh"
    mistake(
        bikestab("export", volumes["1981"], option, name, "--cells", 10),
        f"error: {name}: cannot be written (No such file or directory)",
    )


def test_a_full_disk_leaves_no_file(bikestab, volumes, monkeypatch, tmp_path):
    def full(self, content):
        self.touch()
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    code, out, err = bikestab("export", volumes["1981"], "--mesh", "r.ply", "--cells", 10)
    assert (code, out, err) == (3, "", f"error: r.ply: the disk is full\n  {MAKE_ROOM}\n")
    assert not list(tmp_path.iterdir())


def test_no_volume(bikestab, tmp_path):
    mistake(bikestab("export", "nowhere", "--intervals", "i.csv"), "nowhere: there is no such volume")
    (tmp_path / "x.h5").write_bytes(b"text")
    mistake(bikestab("export", "x.h5", "--intervals", "i.csv"), "is not an HDF5 file")


def test_incomplete_volume(bikestab, volumes, tmp_path):
    shutil.copy(volumes["1981"] / "volume.h5", tmp_path / "volume.h5")
    with h5py.File(tmp_path / "volume.h5", "r+") as file:
        file.attrs["complete"] = 0
    mistake(bikestab("export", ".", "--intervals", "i.csv"), "is incomplete", "scan CONFIG --force")


def test_damaged_volume(bikestab, volumes, tmp_path):
    """The message names the volume, not the file that was being written."""
    path = tmp_path / "volume.h5"
    shutil.copy(volumes["1981"] / "volume.h5", path)
    with h5py.File(path) as file:
        chunk = file["V1"].id.get_chunk_info(0)
    content = bytearray(path.read_bytes())
    content[chunk.byte_offset : chunk.byte_offset + chunk.size] = bytes(chunk.size)
    path.write_bytes(content)
    mistake(bikestab("export", ".", "--intervals", "i.csv"), "volume.h5: is damaged: V1 cannot be read")
    assert not (tmp_path / "i.csv").exists()
