"""bikestab scan: what it writes, what it prints, what it refuses."""

import json
from functools import partial
from importlib import import_module
from pathlib import Path

import h5py
import pytest
from bikestab_cli import progress

from bikestab.scan import processes

CONFIG = """\
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 7}
  sigma: {start: 0, stop: 0.15, num: 6}
  V: {start: 0, stop: 10, num: 11}
"""
SLICED = CONFIG + "slices: [{lam: 0.2}]\n"


@pytest.fixture
def scan(without_warnings):
    """Run the command in a folder with a.yaml and b.yaml."""
    for name in ("a", "b"):
        Path(f"{name}.yaml").write_text(CONFIG)
    return partial(without_warnings, "scan")


def outputs():
    return sorted(str(path) for path in Path("out").rglob("*") if path.is_file())


def test_one_line_for_each_config(scan):
    code, out, err = scan("a.yaml", "b.yaml")
    assert (code, err) == (0, "")
    first, second = out.splitlines()
    assert first.startswith("a.yaml: out/a/volume.h5, 1 picture: ")
    assert second.startswith("b.yaml: out/b/volume.h5, 1 picture: ")
    assert "of 462 points stable" in first
    assert "boundary points agree with the exact speeds to " in first
    assert outputs() == ["out/a/region.png", "out/a/volume.h5", "out/b/region.png", "out/b/volume.h5"]


def test_pictures(scan):
    Path("a.yaml").write_text(CONFIG + "slices: [{lam: 0.2}, {sigma: 0.08}, {V: 18km/h}]\n")
    code, out, _ = scan("a.yaml")
    assert code == 0
    assert "out/a/volume.h5, 4 pictures: " in out
    assert outputs() == [
        "out/a/region.png",
        "out/a/slice_V_5.png",
        "out/a/slice_lam_0.2.png",
        "out/a/slice_sigma_0.08.png",
        "out/a/volume.h5",
    ]


def test_two_close_planes_are_two_pictures(scan):
    Path("a.yaml").write_text(CONFIG + "slices: [{lam: 0.20000001}, {lam: 0.20000002}]\n")
    scan("a.yaml")
    assert len([name for name in outputs() if "slice_" in name]) == 2


def test_json(scan):
    Path("a.yaml").write_text(SLICED)
    code, out, err = scan("a.yaml", "b.yaml", "--json")
    assert (code, err) == (0, "")
    first, second = json.loads(out)["results"]
    assert list(first) == [
        "config", "bicycle", "volume", "pictures", "report", "computed", "points", "stable_points",
        "largest_boundary_difference", "bracketed_zeros", "largest_bracketed_difference", "warnings",
    ]  # fmt: skip
    assert (first["config"], first["volume"], first["points"]) == ("a.yaml", "out/a/volume.h5", 462)
    assert first["pictures"] == ["out/a/region.png", "out/a/slice_lam_0.2.png"]
    assert second["pictures"] == ["out/b/region.png"]
    assert first["computed"] is True
    assert 0 < first["largest_boundary_difference"] < 1e-10
    assert first["bracketed_zeros"] > 100
    assert 0 < first["largest_bracketed_difference"] < 1e-10
    assert len(first["warnings"]) == 2
    with h5py.File("out/a/volume.h5") as file:
        assert first["stable_points"] == file.attrs["stable_points"] > 0


def test_a_second_run_keeps_the_volume(scan):
    Path("a.yaml").write_text(SLICED)
    scan("a.yaml")
    Path("out/a/slice_lam_0.2.png").unlink()
    before = Path("out/a/volume.h5").stat().st_mtime_ns
    code, out, _ = scan("a.yaml")
    assert code == 0
    assert "was complete already (--force computes again)" in out
    assert Path("out/a/volume.h5").stat().st_mtime_ns == before
    assert "out/a/slice_lam_0.2.png" in outputs()
    (again,) = json.loads(scan("a.yaml", "--json")[1])["results"]
    assert (again["computed"], again["largest_boundary_difference"]) == (False, None)


def test_set(scan):
    code, out, _ = scan("a.yaml", "--set", "grid.V.num=6", "--set", "output=out/coarse")
    assert code == 0
    assert "out/coarse/volume.h5" in out
    assert "of 252 points stable" in out
    with h5py.File("out/coarse/volume.h5") as file:
        assert "num: 6" in file.attrs["config"]


def test_no_stable_point(scan):
    _, out, _ = scan("a.yaml", "--set", "grid.V.stop=1")
    assert "no stable point among 462" in out


def test_another_config_is_refused_unless_forced(scan):
    scan("a.yaml")
    before = Path("out/a/volume.h5").read_bytes()
    code, out, err = scan("a.yaml", "--set", "delta=1")
    assert (code, out) == (2, "")
    assert err.startswith("error: a.yaml: output: out/a/volume.h5 exists, and was made from another config")
    assert "--force" in err
    assert Path("out/a/volume.h5").read_bytes() == before
    assert scan("a.yaml", "--set", "delta=1", "--force")[0] == 0


def test_all_configs_are_read_before_the_first_is_computed(scan):
    Path("b.yaml").write_text(CONFIG.replace("num: 7", "num: 1"))
    code, out, err = scan("a.yaml", "b.yaml")
    assert (code, out) == (2, "")
    assert err.startswith("error: b.yaml, line 3: grid.lam.num: 1 is not")
    assert not Path("out").exists()


def test_two_configs_with_one_output(scan):
    code, _, err = scan("a.yaml", "b.yaml", "--set", "output=out/both")
    assert code == 2
    told = "error: b.yaml: output: out/both is the output of a.yaml too\n"
    assert err == f"{told}  give each config an output of its own\n"
    assert not Path("out").exists()


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ("", "Missing argument"),
        ("none.yaml", "error: none.yaml: there is no such file\n  YAML files in '.': a.yaml, b.yaml\n"),
        (".", "is a folder, not a file"),
        ("a.yaml --set grid.lam.nun=3", "did you mean 'num'?"),
        ("a.yaml --set gird.lam.num=3", "did you mean 'grid'?"),
        ("a.yaml --set grid.lam.num", "is not key=value"),
        ("a.yaml --set output=a.yaml", "a.yaml cannot be made"),
        ("a.yaml --set output=a.yaml/b", "a.yaml/b cannot be made"),
        (
            "a.yaml --set grid.V.num=1000000000000",
            "grid.V.num: 1000000000000 values are too many\n  allowed: up to",
        ),
        (
            "a.yaml --set grid.V.num=4000000 --set grid.lam.num=4000000",
            "grid.lam.num: the grid 4000000 × 6 × 4",
        ),
        ("a.yaml --set grid.lam.num=100000000000000000000000000000000", "grid.lam.num: 1000000000000"),
        ("a.yaml --set grid.V.stop=1e308", "grid.V"),
        ("a.yaml --frce", "--force"),
        ("a.yaml --jobs 0", "--jobs"),
        ("a.yaml --jobs 999999999", "999999999 processes are too many for this machine\n  allowed: up to"),
        ("a.yaml --scheduler local:999999999", "999999999 processes are too many for this machine"),
        (f"a.yaml --scheduler local:{5000 * '9'}", "is no number of processes"),
        ("a.yaml --jobs 2 --scheduler local:2", "give one of them"),
    ],
)
def test_a_mistake_is_told_in_three_lines(scan, args, expected):
    code, out, err = scan(*args.split())
    assert (code, out) == (2, "")
    assert err.startswith("error: ")
    assert expected in err
    assert len(err.splitlines()) <= 3
    assert sorted(path.name for path in Path().iterdir()) == ["a.yaml", "b.yaml"]


@pytest.mark.parametrize("name", ["title", "output"])
def test_a_text_that_cannot_be_written(scan, name):
    code, _, err = scan("a.yaml", "--set", f'{name}="a\\0b"')
    assert code == 2
    assert err.startswith(f'error: --set {name}="a\\0b": {name}: ')


def test_a_name_too_long(scan):
    code, _, err = scan("a.yaml", "--set", "output=" + "a" * 300)
    assert code == 2
    assert "output: " in err


def test_a_picture_that_cannot_be_drawn_costs_nothing_else(scan, monkeypatch):
    def broken(volume):
        raise ValueError("no such luck")

    monkeypatch.setattr("bikestab.plot.region.draw_region", broken)
    Path("a.yaml").write_text(SLICED)
    warned = []
    monkeypatch.setattr("click.echo", lambda text, err=False: warned.append(text))
    assert scan("a.yaml", "b.yaml")[0] == 0
    assert sum("region.png cannot be drawn (ValueError: no such luck)" in text for text in warned) == 2
    assert "out/a/slice_lam_0.2.png" in outputs()
    assert "out/a/region.png" not in outputs()


# --- several tiles: 64 tilts, 128 trails, 32 speeds


@pytest.fixture
def tiles(monkeypatch):
    """Let computing stop with an error at the tiles put in here, by the order in which they are computed."""
    stops, computed = {}, []

    def compute(tile):
        computed.append(tile)
        if len(computed) - 1 in stops:
            raise stops[len(computed) - 1]
        return really_compute(tile)

    really_compute = processes.compute
    monkeypatch.setattr(import_module("bikestab.scan.plan"), "_TILE_BYTES", 1)
    monkeypatch.setattr(import_module("bikestab.scan.processes"), "compute", compute)
    for name in ("a", "b"):
        Path(f"{name}.yaml").write_text(CONFIG.replace("num: 11", "num: 100"))
    return stops


def test_ctrl_c_says_what_is_kept_and_the_next_run_where_it_goes_on(scan, tiles):
    tiles[3] = KeyboardInterrupt()
    code, out, err = scan("a.yaml")
    assert (code, out) == (130, "")
    kept = "a.yaml: what is finished is kept; the same command goes on from there"
    assert err == f"error: interrupted\n  {kept}\n"
    assert outputs() == ["out/a/volume.h5.tiles"]
    code, out, err = scan("a.yaml")
    assert (code, err) == (0, "a.yaml: going on at 96 %\n")
    assert outputs() == ["out/a/region.png", "out/a/volume.h5"]


def test_ctrl_c_before_anything_is_finished_says_no_more(scan, tiles):
    tiles[0] = KeyboardInterrupt()
    assert scan("a.yaml") == (130, "", "error: interrupted\n")
    assert outputs() == []


def test_quiet(scan, tiles):
    tiles[2] = KeyboardInterrupt()
    scan("a.yaml")
    code, out, err = scan("a.yaml", "--quiet")
    assert (code, err) == (0, "")
    assert len(out.splitlines()) == 1


@pytest.mark.parametrize(
    ("error", "code", "told"),
    [
        (KeyboardInterrupt(), 130, "error: interrupted\n  b.yaml: what is finished is kept; "),
        (
            OSError(28, "No space left on device"),
            3,
            "error: out/b/volume.h5: the disk is full\n  what is finished ",
        ),
        (MemoryError(), 3, "error: not enough memory\n"),
    ],
)
def test_json_of_what_was_finished_before_a_failure(scan, tiles, error, code, told):
    tiles[5] = error  # the second of b.yaml
    got, out, err = scan("a.yaml", "b.yaml", "--json")
    assert got == code
    assert err.startswith(told)
    (summary,) = json.loads(out)["results"]
    assert (summary["config"], summary["computed"]) == ("a.yaml", True)
    assert outputs() == ["out/a/region.png", "out/a/volume.h5", "out/b/volume.h5.tiles"]


def test_json_of_nothing_is_nothing(scan, tiles):
    """An error alone, as everywhere else."""
    tiles[0] = MemoryError()
    assert scan("a.yaml", "--json")[:2] == (3, "")


def test_lines_of_what_was_finished_before_a_failure(scan, tiles):
    tiles[5] = MemoryError()
    code, out, _ = scan("a.yaml", "b.yaml")
    assert code == 3
    assert out.startswith("a.yaml: out/a/volume.h5, 1 picture: ")
    assert len(out.splitlines()) == 1


def test_a_log_gets_a_line_now_and_then(scan, tiles, monkeypatch):
    monkeypatch.setattr(progress, "LOG", 0.0)
    code, _, err = scan("a.yaml")
    assert code == 0
    lines = err.splitlines()
    assert [line.split(" of ")[0] for line in lines] == [f"a.yaml: {n} %" for n in (0, 32, 64, 96, 100)]
    assert lines[0] == "a.yaml: 0 % of 4.2 k points"
    assert all(" points/s, 0:0" in line and line.endswith(" left") for line in lines[1:])


def test_processes(scan, monkeypatch):
    monkeypatch.setattr(import_module("bikestab.scan.plan"), "_TILE_BYTES", 1)
    volumes = set()
    for args in (["--jobs", "2"], ["--force", "--jobs", "1"]):
        assert scan("a.yaml", "--set", "grid.V.num=100", *args)[::2] == (0, "")
        volumes.add(Path("out/a/volume.h5").read_bytes())
    assert len(volumes) == 1
