"""A grid larger than a tile, what is left behind, and what is refused."""

import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from bikestab import scan, yamltext
from bikestab.boundary import AGREEMENT, Agreement
from bikestab.config import AXES
from bikestab.configfile import parse_config
from bikestab.errors import InputError, ScanError
from bikestab.model import characteristic_table
from bikestab.routh import CONDITIONS, conditions, violated
from bikestab.scan import COLUMNS, SPEEDS, check_size, evaluate, run_scan
from bikestab.sheets import critical_roots
from bikestab.spectrum import growth_rate
from bikestab.speeds import critical_speeds, stable_intervals
from bikestab.volume import Volume


def config_of(shape=(4, 5, 6), output="out", more=""):
    n, m, k = shape
    text = (
        f"bicycle: dikarev1981\ngrid:\n  lam: {{start: 0, stop: 0.3, num: {n}}}\n"
        f"  sigma: {{start: 0, stop: 0.15, num: {m}}}\n  V: {{start: 0, stop: 15, num: {k}}}\n"
        f"output: {output}\n{more}"
    )
    return parse_config(yamltext.parse(text, "scan.yaml"))


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def files():
    return sorted(str(path) for path in Path().rglob("*") if path.is_file())


# --- tiles


@pytest.mark.parametrize("shape", [(COLUMNS + 6, COLUMNS + 2, SPEEDS + 44), (2, 2, 2), (COLUMNS, 3, SPEEDS)])
def test_tiles_leave_no_trace(shape):
    """The whole grid at once gives the same volume as its tiles do."""
    config = config_of(shape)
    points = []
    result = run_scan(config, progress=points.append)
    lam, sigma, V = (config.grid.values(name) for name in AXES)
    table = characteristic_table(config.machine, lam[:, np.newaxis], sigma)
    with h5py.File(result.path) as file:
        mask = violated(conditions(table[..., np.newaxis], V))
        np.testing.assert_array_equal(file["violated"][()], mask)
        np.testing.assert_array_equal(file["stable"][()], mask == 0)
        growth = growth_rate(table[..., np.newaxis], V)
        np.testing.assert_array_equal(file["growth_rate"][()], growth.astype("f4"))
        for name, values in stable_intervals(table)._asdict().items():
            np.testing.assert_array_equal(file[name][()], values)
    assert result.points == sum(points) == np.prod(shape)
    assert result.stable_points == np.count_nonzero(mask == 0)
    assert result.computed


def test_a_sign_change_between_two_tiles_of_speeds(monkeypatch):
    """Roots between the last speed of a tile and the first of the next are refined like the others."""
    config = config_of((5, 5, 2 * SPEEDS + 1))
    tiled = run_scan(config).agreement
    monkeypatch.setattr(scan, "SPEEDS", 9)  # with a border between the tiles at many roots
    assert run_scan(config, force=True).agreement == tiled
    monkeypatch.setattr(scan, "SPEEDS", 2 * SPEEDS + 1)
    assert run_scan(config, force=True).agreement == tiled
    assert tiled.roots > 50


@pytest.mark.parametrize("delta", [0, 2])
def test_the_size_of_the_tiles_leaves_no_trace(delta, monkeypatch):
    """Every dataset of the volume is the same to the bit, the sheets too."""
    config = config_of((45, 40, 12), more=f"delta: {delta}\n")
    path = run_scan(config).path
    with h5py.File(path) as file:
        names = [*file["boundary"], *(f"/{name}" for name in ("V1", "V2", "lower", "upper", "growth_rate"))]
        whole = {name: file["boundary"][name][()].tobytes() for name in names}
    for columns, speeds in ((7, 5), (32, 12)):
        monkeypatch.setattr(scan, "COLUMNS", columns)
        monkeypatch.setattr(scan, "SPEEDS", speeds)
        with h5py.File(run_scan(config, force=True).path) as file:
            for name, data in whole.items():
                assert file["boundary"][name][()].tobytes() == data


def test_boundary_holds_every_critical_speed():
    """Those above the last speed of the grid, too, and those that a step of the grid has in pairs."""
    config = config_of((20, 20, 4))
    lam, sigma, V = (config.grid.values(name) for name in AXES)
    table = characteristic_table(config.machine, lam[:, np.newaxis], sigma)
    inside = stable_intervals(table)
    ends = np.isin(inside.lower, [1, 2]).sum() + np.isin(inside.upper, [1, 2]).sum()
    with h5py.File(run_scan(config).path) as file:
        for name, exact in critical_speeds(table).items():
            found = np.sort(file[f"boundary/{name}"][()], axis=-1)
            expected = np.full(found.shape, np.nan)
            expected[..., : len(exact)] = np.moveaxis(exact, 0, -1)
            np.testing.assert_array_equal(found, expected)
        assert np.nanmax(file["boundary/p0"][()]) > V[-1]
        assert sum(file[f"boundary/{name}_edge"][()].sum() for name in CONDITIONS) == ends > 100


def test_the_agreement_is_reported():
    result = run_scan(config_of((16, 16, 151)))
    assert result.agreement.roots > 500
    assert 0 < result.agreement.largest <= AGREEMENT
    with h5py.File(result.path) as file:
        assert file["boundary"].attrs["largest_difference"] == result.agreement.largest
        seen = sum(np.count_nonzero(file[f"boundary/{name}"][()] <= 15) for name in CONDITIONS)
        assert 0.9 * seen < result.agreement.roots <= seen  # all but what the grid has in pairs


def test_a_disagreement_is_an_error(monkeypatch):
    def worse(*args):
        return Agreement(1, 2e-10)

    monkeypatch.setattr(scan, "agreement", worse)
    with pytest.raises(ScanError, match="differ from the exact critical speeds by 2e-10 m/s"):
        run_scan(config_of())
    assert files() == []


@pytest.mark.parametrize(
    ("factor", "message"),
    [
        (1 + 1e-9, "differ from the exact critical speeds by"),
        (np.nan, "a point that is no exact critical speed"),
    ],
)
def test_wrong_exact_speeds_are_an_error(factor, message, monkeypatch):
    def off(table):
        return {name: roots._replace(V=roots.V * factor) for name, roots in critical_roots(table).items()}

    monkeypatch.setattr(scan, "critical_roots", off)
    with pytest.raises(ScanError, match=f"{message}.*please report this with the config"):
        run_scan(config_of((8, 8, 31)))
    assert files() == []


# --- an output that is there already


def test_the_same_config_is_kept():
    path = run_scan(config_of()).path
    before = path.stat().st_mtime_ns, path.read_bytes()
    again = run_scan(config_of())
    assert not again.computed
    assert again.stable_points == run_scan(config_of(), force=True).stable_points
    assert again.points == 120
    assert before[1] == path.read_bytes()


def test_nothing_is_computed_for_a_volume_that_is_kept(monkeypatch):
    run_scan(config_of())
    monkeypatch.setattr(scan, "evaluate", None)
    assert not run_scan(config_of()).computed
    with pytest.raises(TypeError):
        run_scan(config_of(), force=True)


@pytest.mark.parametrize("more", ["title: another\n", "delta: 1\n", "model: unrefined\n", "# a remark\n"])
def test_the_output_of_another_config_is_refused(more):
    path = run_scan(config_of()).path
    before = path.read_bytes()
    with pytest.raises(InputError, match="made from another config") as caught:
        run_scan(config_of(more=more))
    assert caught.value.key == ("output",)
    assert "--force" in caught.value.hint
    assert path.read_bytes() == before
    assert run_scan(config_of(more=more), force=True).computed
    assert not run_scan(config_of(more=more)).computed


def test_a_bicycles_file_that_has_changed_is_another_config():
    Path("mine.yaml").write_text(
        Path(scan.__file__).with_name("presets").joinpath("dikarev1981.yaml").read_text()
    )
    text = config_of().text.replace("dikarev1981", "mine.yaml")
    config = parse_config(yamltext.parse(text, "scan.yaml"))
    run_scan(config)
    assert not run_scan(config).computed
    Path("mine.yaml").write_text(Path("mine.yaml").read_text().replace("m1: 80", "m1: 81"))
    with pytest.raises(InputError, match="made from another config"):
        run_scan(parse_config(yamltext.parse(text, "scan.yaml")))


@pytest.mark.parametrize("content", [b"", b"not HDF5"])
def test_a_file_that_is_no_volume_is_replaced_with_force_only(content):
    Path("out").mkdir()
    Path("out/volume.h5").write_bytes(content)
    with pytest.raises(InputError, match="exists, and is not an HDF5 file") as caught:
        run_scan(config_of())
    assert "--force" in caught.value.hint
    assert Path("out/volume.h5").read_bytes() == content
    assert run_scan(config_of(), force=True).computed


def test_an_incomplete_volume_is_told():
    path = run_scan(config_of()).path
    with h5py.File(path, "a") as file:
        file.attrs["complete"] = np.int32(0)
    with pytest.raises(InputError, match="exists, and is incomplete"):
        run_scan(config_of())


# --- nothing is left behind


@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError, MemoryError, SystemExit])
def test_what_stops_a_run_leaves_nothing(error):
    def stop(points):
        raise error

    with pytest.raises(error):
        run_scan(config_of(), progress=stop)
    assert files() == []
    assert run_scan(config_of()).computed


def test_what_stops_a_run_leaves_the_old_volume():
    path = run_scan(config_of()).path
    before = path.read_bytes()

    def stop(points):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_scan(config_of(more="delta: 1\n"), force=True, progress=stop)
    assert files() == ["out/volume.h5"]
    assert path.read_bytes() == before


def test_what_a_killed_run_left_is_no_hindrance():
    path = run_scan(config_of()).path
    half = path.read_bytes()[:5000]
    path.unlink()
    Path("out/volume.h5.partial").write_bytes(half)
    assert run_scan(config_of()).computed
    assert files() == ["out/volume.h5"]


def test_a_volume_that_someone_else_reads_can_be_replaced():
    path = run_scan(config_of()).path
    with Volume(path) as volume:
        run_scan(config_of(more="delta: 1\n"), force=True)
        assert volume.bicycle.delta == 0
    with Volume(path) as volume:
        assert volume.bicycle.delta == 1


FAILS_FOR_A_WHILE = """
import resource, sys
import h5py
from bikestab.configfile import load_config
from bikestab.errors import ScanError
from bikestab.scan import run_scan

soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
tiles = []

def progress(points):
    tiles.append(points)
    limit = (1_000_000, hard) if 1 <= len(tiles) < 3 else (soft, hard)
    resource.setrlimit(resource.RLIMIT_FSIZE, limit)

try:
    run_scan(load_config("scan.yaml", ["output=bad"]), progress=progress)
except ScanError:
    print("failed")
else:
    with h5py.File("bad/volume.h5") as bad, h5py.File("good/volume.h5") as good:
        print("equal" if (bad["growth_rate"][()] == good["growth_rate"][()]).all() else "WRONG")
"""


def test_a_write_that_failed_once_does_not_give_a_complete_volume():
    """A disk that is full for a moment: the scan fails, or all is in the file."""
    pytest.importorskip("resource")
    config = config_of((70, 40, 600), "good", "fields: [growth_rate]\n")
    Path("scan.yaml").write_text(config.text)
    run_scan(config)
    done = subprocess.run([sys.executable, "-c", FAILS_FOR_A_WHILE], capture_output=True, text=True)
    assert done.stdout.strip() in ("failed", "equal"), done.stderr[-1000:]


# --- refused before anything is written


def test_an_output_folder_that_is_a_file():
    Path("out").write_text("mine")
    with pytest.raises(InputError, match="out cannot be made") as caught:
        run_scan(config_of())
    assert caught.value.key == ("output",)
    with pytest.raises(InputError, match="out/deeper cannot be made"):
        run_scan(config_of(output="out/deeper"))
    assert Path("out").read_text() == "mine"


def test_a_folder_name_that_no_disk_takes():
    with pytest.raises(InputError) as caught:
        run_scan(config_of(output="a" * 300))
    assert caught.value.key == ("output",)


@pytest.mark.parametrize(
    ("shape", "axis"),
    [
        ((1_000_000_000, 5, 6), "lam"),
        ((4, 10**9, 6), "sigma"),
        ((4000, 5000, 10**9), "V"),
        ((10**30, 5, 6), "lam"),
    ],
)
def test_a_grid_too_large_is_refused_at_once(shape, axis):
    with pytest.raises(InputError, match=r"GB of (disk|memory)") as caught:
        run_scan(config_of(shape))
    assert caught.value.key == ("grid", axis, "num")
    assert files() == []


def test_the_message_of_a_grid_too_large_names_its_size():
    with pytest.raises(InputError, match="the grid 1000000000 × 5 × 6 needs "):
        check_size(config_of((1_000_000_000, 5, 6)))


def test_the_disk_that_counts_is_the_outputs(monkeypatch):
    asked = []
    usage = shutil.disk_usage(".")
    monkeypatch.setattr(
        shutil, "disk_usage", lambda path: asked.append(Path(path)) or usage._replace(free=100)
    )
    with pytest.raises(InputError, match="of disk uncompressed"):
        check_size(config_of(output="there/is/no/such/folder"))
    assert asked == [Path().absolute()]


# --- results that are no numbers are not called stable


def test_what_cannot_be_computed_is_not_stable():
    table = np.full((5, 4, 1), np.nan)
    assert not evaluate(table, np.array([1.0, 5.0]), ["stable"])["stable"].any()


def test_designs_beyond_double_precision_have_no_stable_point():
    config = config_of()
    text = config.text.replace("start: 0, stop: 0.15", "start: -1.0e+200, stop: 1.0e+200")
    with pytest.raises(InputError, match=r"grid\.sigma"):
        run_scan(parse_config(yamltext.parse(text, "scan.yaml")))
