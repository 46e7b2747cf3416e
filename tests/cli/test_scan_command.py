"""bikestab scan: what it writes, what it prints, what it refuses."""

import json
from functools import partial
from pathlib import Path

import h5py
import pytest

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
    first, second = json.loads(out)
    assert list(first) == [
        "config", "bicycle", "volume", "pictures", "computed", "points", "stable_points",
        "largest_boundary_difference", "warnings",
    ]  # fmt: skip
    assert (first["config"], first["volume"], first["points"]) == ("a.yaml", "out/a/volume.h5", 462)
    assert first["pictures"] == ["out/a/region.png", "out/a/slice_lam_0.2.png"]
    assert second["pictures"] == ["out/b/region.png"]
    assert first["computed"] is True
    assert 0 < first["largest_boundary_difference"] < 1e-10
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
    (again,) = json.loads(scan("a.yaml", "--json")[1])
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
    assert err == "error: b.yaml: output: out/both is the output of a.yaml too\n"
    assert not Path("out").exists()


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ("", "Missing argument"),
        ("none.yaml", "error: none.yaml: there is no such file\n  YAML files in '.': a.yaml, b.yaml\n"),
        (".", "is a folder, not a YAML file"),
        ("a.yaml --set grid.lam.nun=3", "did you mean 'num'?"),
        ("a.yaml --set gird.lam.num=3", "did you mean 'grid'?"),
        ("a.yaml --set grid.lam.num", "is not key=value"),
        ("a.yaml --set output=a.yaml", "a.yaml cannot be made"),
        ("a.yaml --set output=a.yaml/b", "a.yaml/b cannot be made"),
        ("a.yaml --set grid.V.num=1000000000000", "grid.V.num: the grid 7 × 6 × 1000000000000 needs"),
        ("a.yaml --set grid.lam.num=100000000000000000000000000000000", "grid.lam.num: the grid 1000"),
        ("a.yaml --set grid.V.stop=1e308", "grid.V"),
        ("a.yaml --frce", "--force"),
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

    monkeypatch.setattr("bikestab.plot_region.draw_region", broken)
    Path("a.yaml").write_text(SLICED)
    warned = []
    monkeypatch.setattr("click.echo", lambda text, err=False: warned.append(text))
    assert scan("a.yaml", "b.yaml")[0] == 0
    assert sum("region.png cannot be drawn (ValueError: no such luck)" in text for text in warned) == 2
    assert "out/a/slice_lam_0.2.png" in outputs()
    assert "out/a/region.png" not in outputs()
