"""A scan: the same volume from whatever tiles, and what is refused before anything is written."""

import os
import shutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import h5py
import numpy as np
import pytest

from bikestab.critical import critical
from bikestab.errors import InputError, ScanError
from bikestab.fields import AXES
from bikestab.model import exact_table
from bikestab.routh import CONDITIONS, conditions, violated
from bikestab.scan.agreement import AGREEMENT
from bikestab.scan.bracketing import zeros
from bikestab.scan.output import MOST_VALUES, check_size
from bikestab.scan.plan import Plan
from bikestab.scan.run import run_scan
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import critical_speeds, intervals_of
from tests.onecell import with_speeds
from tests.scans import config_of, files, load

pytestmark = pytest.mark.usefixtures("in_an_empty_folder", "small_tiles")


# --- tiles


FIELDS = "stable, violated, growth_rate, conditions, dV1"


def datasets(path):
    """The bytes of every dataset of a file."""
    found = {}

    def add(name, node):
        if isinstance(node, h5py.Dataset):
            found[name] = np.asarray(node[()]).tobytes()

    with h5py.File(path) as file:
        file.visititems(add)
    return found


@pytest.mark.parametrize("shape", [(70, 130, 5), (5, 5, 100), (2, 2, 2), (33, 3, 65)])
def test_tiles_leave_no_trace(shape):
    """The whole grid at once gives the same volume as its tiles do."""
    config = config_of(shape)
    calls = []
    result = run_scan(config, progress=lambda *call: calls.append(call))
    lam, sigma, V = (config.grid.values(name) for name in AXES)
    exact = exact_table(config.machine, lam[:, np.newaxis], sigma)
    table = exact.value
    with h5py.File(result.path) as file:
        mask = violated(conditions(table[..., np.newaxis], V))
        np.testing.assert_array_equal(file["violated"][()], mask)
        np.testing.assert_array_equal(file["stable"][()], mask == 0)
        growth = growth_rate_of(table[..., np.newaxis], V)
        np.testing.assert_array_equal(file["growth_rate"][()], growth.astype("f4"))
        for name in ("V1", "V2", "lower", "upper"):
            np.testing.assert_array_equal(file[name][()], getattr(intervals_of(exact), name))
        assert file.attrs["complete"] == 1
        assert file.attrs["stable_points"] == result.stable_points
    points = int(np.prod(shape))
    assert calls[0] == (0, points)
    assert calls[-1] == (points, points)
    assert len(calls) == len(Plan(config)) + 1
    assert [done for done, _ in calls] == sorted({done for done, _ in calls})
    assert result.points == points
    assert result.stable_points == np.count_nonzero(mask == 0)
    assert result.computed
    assert files() == ["out/volume.h5"]


@pytest.mark.parametrize("more", ["", "delta: 2\n", "bicycle: kooijman2011\n"])
def test_the_size_of_the_tiles_leaves_no_trace(more, monkeypatch):
    """Every dataset of the volume is the same to the bit, the sheets too, and the check finds the same."""
    config = config_of((45, 40, 70), more=f"{more}fields: [{FIELDS}]\n")
    whole = run_scan(config)
    expected = datasets(whole.path)
    assert {"violated", "stable", "growth_rate", "V1", "boundary/hurwitz3"} <= set(expected)
    for size in ((32, 32, 32), (45, 40, 32), (32, 40, 64)):
        monkeypatch.setattr(Plan, "tile", property(lambda _, size=size: size))
        result = run_scan(config, force=True)
        assert datasets(result.path) == expected
        for is_, was in zip(result.agreement[:4], whole.agreement[:4], strict=True):
            # only what is reported: above the lowest tile undamped speeds are those of double precision, with
            # other last digits, where no mask depends on them
            assert is_ == pytest.approx(was, abs=0 if more.startswith("delta") else 1e-12)
        assert result.bracketed == whole.bracketed
        assert result.stable_points == whole.stable_points


def test_boundary_holds_every_critical_speed():
    """Those above the last speed of the grid, too, and those that a step of the grid has in pairs."""
    config = config_of((20, 20, 4))
    lam, sigma, V = (config.grid.values(name) for name in AXES)
    table = exact_table(config.machine, lam[:, np.newaxis], sigma)
    inside = intervals_of(table)
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
    assert 0 < result.agreement.largest <= AGREEMENT
    with h5py.File(result.path) as file:
        assert file["boundary"].attrs["largest_difference"] == result.agreement.largest
        seen = sum(np.count_nonzero(file[f"boundary/{name}"][()] <= 15) for name in CONDITIONS)
        assert result.agreement.roots == seen > 500
        assert 500 < result.bracketed.roots <= seen
        assert file["boundary"].attrs["bracketed_zeros"] == result.bracketed.roots
        assert file["boundary"].attrs["largest_bracketed_difference"] == result.bracketed.largest <= AGREEMENT


def test_a_witness_that_disagrees_is_an_error(monkeypatch):
    """The tiles are kept, and no volume gets its name."""
    monkeypatch.setattr(import_module("bikestab.scan.bracketing"), "zeros", lambda *args: zeros(*args) + 1e-9)
    with pytest.raises(ScanError, match=r"that scipy finds .*please report this with the config"):
        run_scan(config_of((8, 8, 150)))
    assert files() == ["out/volume.h5.tiles"]
    monkeypatch.undo()


@pytest.mark.parametrize(
    ("factor", "message"),
    [(1 + 1e-9, "differ from the exact critical speeds by"), (1.5, "signs at the grid's speeds")],
)
@pytest.mark.parametrize("at", [0, 2])
def test_a_disagreement_is_an_error(factor, message, at, monkeypatch):
    """The tiles that were finished before are kept."""
    calls = []

    def off(table, rough):
        calls.append(table)
        exact = critical(table, rough=rough)
        return with_speeds(
            exact, {name: V * (factor if len(calls) > at else 1) for name, V in exact.speeds.items()}
        )

    monkeypatch.setattr(import_module("bikestab.scan.tile"), "critical", off)
    with pytest.raises(ScanError, match=f"{message}.*please report this with the config"):
        run_scan(config_of((8, 8, 150)))
    assert files() == (["out/volume.h5.tiles"] if at else [])


# --- a disk that is full for a moment

FAILS_FOR_A_WHILE = """
import resource
from pathlib import Path
from bikestab.config.file import load_config
from bikestab.errors import ScanError
from bikestab.scan.run import run_scan

soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
calls = []

def progress(done, points):
    calls.append(done)
    limit = (1_500_000, hard) if 2 <= len(calls) < 4 else (soft, hard)
    resource.setrlimit(resource.RLIMIT_FSIZE, limit)

config = load_config("scan.yaml", [])
try:
    run_scan(config, progress=progress)
except ScanError as error:
    print(str(error).replace(chr(10), "; "))
resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
again = []
run_scan(config, progress=lambda done, points: again.append(done))
print("went on" if again[0] else "began anew")
"""


def test_a_write_that_failed_once_does_not_give_a_wrong_volume(monkeypatch):
    pytest.importorskip("resource")
    monkeypatch.setattr(
        import_module("bikestab.scan.plan"), "_TILE_BYTES", 1 << 24
    )  # as in the other process
    config = config_of((70, 40, 600), "out", "fields: [growth_rate]\n")
    expected = run_scan(config).path.read_bytes()
    shutil.rmtree("out")
    Path("scan.yaml").write_text(config.text)
    done = subprocess.run([sys.executable, "-c", FAILS_FOR_A_WHILE], capture_output=True, text=True)
    assert done.stderr == ""
    assert "out/volume.h5: the disk is full; what is finished is kept" in done.stdout
    assert "went on" in done.stdout
    assert Path("out/volume.h5").read_bytes() == expected
    assert files() == ["out/volume.h5", "scan.yaml"]


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


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_may_not_be_written():
    Path("out").mkdir(mode=0o500)
    with pytest.raises(InputError, match="cannot be written"):
        run_scan(config_of())


@pytest.mark.parametrize(
    ("shape", "axis", "problem"),
    [
        ((1_000_000_000, 5, 6), "lam", "1000000000 values are too many"),
        ((4, 10**9, 6), "sigma", "1000000000 values are too many"),
        ((4000, 5000, 4_000_001), "V", "4000001 values are too many"),
        ((10**30, 5, 6), "lam", f"{10**30} values are too many"),
        (
            (4, 4_000_000, 3_000_000),
            "sigma",
            "the grid 4 × 4000000 × 3000000 needs .* GB of disk, and .* has",
        ),
    ],
)
def test_a_grid_too_large_is_refused_at_once(shape, axis, problem):
    with pytest.raises(InputError, match=problem) as caught:
        run_scan(config_of(shape))
    assert caught.value.key == ("grid", axis, "num")
    assert files() == []


def test_the_hint_of_too_many_values_says_how_many_are_allowed():
    with pytest.raises(InputError) as caught:
        check_size(config_of((4, 5, MOST_VALUES + 1)))
    assert caught.value.hint == "allowed: up to 4000000"
    check_size(config_of((2, 2, MOST_VALUES)))


def test_the_disk_that_counts_is_the_outputs(monkeypatch):
    asked = []
    usage = shutil.disk_usage(".")
    monkeypatch.setattr(
        shutil, "disk_usage", lambda path: asked.append(Path(path)) or usage._replace(free=100)
    )
    with pytest.raises(InputError, match=r"needs [0-9.]+ kB of disk, and .* has 100 B"):
        check_size(config_of(output="there/is/no/such/folder"))
    assert asked == [Path().absolute()]


def test_designs_beyond_double_precision_are_refused():
    text = config_of().text.replace("start: 0, stop: 0.15", "start: -1.0e+200, stop: 1.0e+200")
    with pytest.raises(InputError, match=r"grid\.sigma"):
        run_scan(load(text))
