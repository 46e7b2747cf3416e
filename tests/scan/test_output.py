"""What is in a scan's output folder already: a volume or tiles, its own, another's, or no such thing."""

import os
from importlib import import_module
from pathlib import Path

import h5py
import numpy as np
import pytest

import bikestab
from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.scan import run
from bikestab.scan.output import tiles_path
from bikestab.scan.run import run_scan
from bikestab.scan.spool import Spool
from bikestab.volume import Volume
from tests.scan.test_resume import DONE, KEPT, config, interrupted, whole
from tests.scans import config_of as small
from tests.scans import files, load

pytestmark = pytest.mark.usefixtures("in_an_empty_folder", "small_tiles")


# --- a volume


def test_the_same_config_is_kept():
    path = run_scan(small()).path
    before = path.stat().st_mtime_ns, path.read_bytes()
    again = run_scan(small(), progress=lambda *_: pytest.fail("something was computed"))
    assert not again.computed
    assert before == (path.stat().st_mtime_ns, path.read_bytes())
    forced = run_scan(small(), force=True)
    assert forced.computed
    assert (again.stable_points, again.points) == (forced.stable_points, 120)
    assert before[1] == path.read_bytes()


def test_nothing_is_computed_for_a_volume_that_is_kept(monkeypatch):
    run_scan(small())
    monkeypatch.setattr(import_module("bikestab.scan.processes"), "compute", None)
    assert not run_scan(small()).computed
    with pytest.raises(TypeError):
        run_scan(small(), force=True)


@pytest.mark.parametrize(
    "more", ["delta: 1\n", "model: unrefined\n", "fields: [stable]\n", "sweep: {m1: [80]}\n"]
)
def test_the_output_of_another_config_is_refused(more):
    path = run_scan(small()).path
    before = path.read_bytes()
    with pytest.raises(InputError, match="made from another config") as caught:
        run_scan(small(more=more))
    assert caught.value.key == ("output",)
    assert "--force" in caught.value.hint
    assert path.read_bytes() == before
    assert run_scan(small(more=more), force=True).computed
    assert not run_scan(small(more=more)).computed


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ("delta: 1\n", "(delta: 0 there, 1 here)"),
        ("model: unrefined\n", "(model: refined there, unrefined here)"),
        ("fields: [stable]\n", "(fields: stable violated growth_rate there, stable here)"),
        ("sweep: {m1: [80]}\n", "(sweep: none there, m1 here)"),
        (
            "ensemble: {m1: {normal: [80, 8]}, samples: 9}\n",
            "growth_rate probability here; ensemble: no samples",
        ),
        ("delta: 1\nmodel: unrefined\nsweep: {m1: [79], m2: [2]}\n", "; sweep: none there, m1 × m2 here)"),
    ],
)
def test_what_differs_is_told(more, words):
    run_scan(small())
    with pytest.raises(InputError) as caught:
        run_scan(small(more=more))
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("more", "other", "words"),
    [
        (
            "sweep: {m1: [70, 80]}\n",
            "sweep: {m1: [70, 81]}\n",
            "(sweep.m1: 70 ... 80 in 2 values there, 70 ... 81 in 2",
        ),
        ("sweep: {m1: [70, 80]}\n", "sweep: {m2: [2, 3]}\n", "(sweep: m1 there, m2 here)"),
        (
            "ensemble: {m1: {normal: [80, 8]}, samples: 9}\n",
            "ensemble: {m1: {normal: [80, 9]}, samples: 9}\n",
            "(ensemble: 9 samples there, other ones here)",
        ),
    ],
)
def test_what_differs_of_a_sweep_and_an_ensemble_is_told(more, other, words):
    run_scan(small(more=more))
    assert not run_scan(small(more=more)).computed
    with pytest.raises(InputError) as caught:
        run_scan(small(more=other))
    assert words in str(caught.value)


def test_a_changed_bicycle_of_bodies_is_told_of_once():
    given = Bicycle.preset("meijaard2007").given
    for mass in (85, 92):
        lines = [f"{name}: {value!r}\n" for name, value in {**given, "mB": mass}.items()]
        Path("mine.yaml").write_text("".join(lines))
        changed = small().model_copy(update={"bicycle": Bicycle.load("mine.yaml")})
        if mass == 85:
            run_scan(changed)
    with pytest.raises(InputError) as caught:
        run_scan(changed)
    assert "(the bicycle mine differs: of its two parts m1 is 87 there, 94 here)" in str(caught.value)


def test_another_grid_is_told():
    run_scan(small())
    with pytest.raises(InputError) as caught:
        run_scan(small((4, 5, 7)))
    assert "(grid.V: 0 ... 15 in 6 values there, 0 ... 15 in 7 values here)" in str(caught.value)


def test_the_tiles_of_another_scan_are_no_hindrance_to_a_complete_volume():
    path = run_scan(small()).path
    tiles = path.with_name("volume.h5.tiles")
    with Spool(tiles, {"config": "another"}):
        pass
    before = tiles.read_bytes()
    assert not run_scan(small()).computed
    assert tiles.read_bytes() == before


def test_a_bicycles_file_that_has_changed_is_another_config():
    preset = Path(bikestab.__file__).with_name("presets") / "dikarev1981.yaml"
    Path("mine.yaml").write_text(preset.read_text())
    text = small().text.replace("dikarev1981", "mine.yaml")
    run_scan(load(text))
    assert not run_scan(load(text)).computed
    Path("mine.yaml").write_text(preset.read_text().replace("m1: 80", "m1: 81"))
    with pytest.raises(InputError, match="made from another config"):
        run_scan(load(text))


@pytest.mark.parametrize(("content", "problem"), [(b"", "is empty"), (b"not HDF5", "is not an HDF5 file")])
def test_a_file_that_is_no_volume_is_replaced_with_force_only(content, problem):
    Path("out").mkdir()
    Path("out/volume.h5").write_bytes(content)
    with pytest.raises(InputError, match=f"exists, and {problem}") as caught:
        run_scan(small())
    assert "--force" in caught.value.hint
    assert Path("out/volume.h5").read_bytes() == content
    assert files() == ["out/volume.h5"]
    assert run_scan(small(), force=True).computed


def test_an_incomplete_volume_is_told():
    path = run_scan(small()).path
    with h5py.File(path, "a") as file:
        file.attrs["complete"] = np.int32(0)
    with pytest.raises(InputError, match="exists, and is incomplete"):
        run_scan(small())


def test_a_volume_that_someone_else_reads_can_be_replaced():
    path = run_scan(small()).path
    with Volume(path) as volume:
        run_scan(small(more="delta: 1\n"), force=True)
        assert volume.bicycle.delta == 0
    with Volume(path) as volume:
        assert volume.bicycle.delta == 1


# --- tiles that are kept


def test_tiles_of_another_config_are_refused_or_dropped(computed):
    expected = whole("delta: 1\n")
    interrupted(3)
    tiles_before = tiles_path(config()).read_bytes()
    with pytest.raises(InputError, match=r"tiles of another scan .*\(another config\)") as caught:
        run_scan(config("delta: 1\n"))
    assert caught.value.key == ("output",)
    assert tiles_path(config()).read_bytes() == tiles_before
    computed.clear()
    assert run_scan(config("delta: 1\n"), force=True).path.read_bytes() == expected
    assert len(computed) == 5


@pytest.mark.parametrize("name", ["numpy", "isal", "bikestab"])
def test_tiles_of_other_versions_are_refused(name, monkeypatch):
    """Another version may give other bytes."""
    interrupted(3)
    identity = run._identity(config())
    monkeypatch.setattr(
        import_module("bikestab.scan.run"), "_identity", lambda _: {**identity, f"version of {name}": "9.9"}
    )
    with pytest.raises(InputError, match=f"another version of {name}"):
        run_scan(config())


def test_force_goes_on_with_its_own_tiles(computed):
    """So that the same command goes on, also where it has to replace a volume."""
    old = run_scan(config("delta: 1\n")).path.read_bytes()
    computed.clear()
    interrupted(3, force=True)
    assert files() == [*DONE, *KEPT]
    assert Path(DONE[0]).read_bytes() == old
    with pytest.raises(InputError, match="made from another config"):
        run_scan(config())
    result = run_scan(config(), force=True)
    assert len(computed) == 5
    assert files() == DONE
    assert result.path.read_bytes() == whole()


def test_tiles_beside_a_complete_volume_are_cleaned_up():
    """A kill between the volume's getting its name and the tiles' removal leaves both."""
    interrupted(3)
    kept = tiles_path(config()).read_bytes()
    path = run_scan(config()).path
    before = path.stat().st_mtime_ns
    tiles_path(config()).write_bytes(kept)
    assert not run_scan(config()).computed
    assert files() == DONE
    assert path.stat().st_mtime_ns == before


def test_two_scans_at_once():
    """The second is refused and harms nothing."""
    refused = []

    def second(done, points):
        for force in (False, True):
            with pytest.raises(InputError, match="another scan is writing into out") as caught:
                run_scan(config(), force=force)
            refused.append(caught.value.key)

    run_scan(config(), progress=second)
    assert refused == [("output",)] * 12
    assert files() == DONE


def test_a_file_of_someone_else_in_the_tiles_place():
    Path("out").mkdir()
    tiles_path(config()).write_text("mine\n")
    with pytest.raises(InputError, match="is no file of bikestab"):
        run_scan(config())
    assert tiles_path(config()).read_text() == "mine\n"
    assert run_scan(config(), force=True).computed
    assert files() == DONE


def test_the_folder_is_not_left_open():
    """Descriptors: a library's user may run thousands of scans."""
    if not os.path.isdir("/proc/self/fd"):  # noqa: PTH112
        pytest.skip("no list of descriptors")
    run_scan(config(), force=True)
    before = len(list(Path("/proc/self/fd").iterdir()))
    for _ in range(3):
        run_scan(config(), force=True)
        run_scan(config())
    assert len(list(Path("/proc/self/fd").iterdir())) == before


# --- what cannot be a volume


@pytest.mark.parametrize("force", [False, True])
def test_a_folder_in_the_volumes_place(force):
    Path("out/volume.h5").mkdir(parents=True)
    with pytest.raises(InputError, match=r"out/volume.h5 is no file"):
        run_scan(small(), force=force)
    assert files() == []


def test_links_do_not_lead_out_of_the_folder():
    """What they lead to stays as it is."""
    Path("out").mkdir()
    Path("mine").write_text("mine")
    tiles = Path("out/volume.h5.tiles")
    tiles.symlink_to("../mine")
    with pytest.raises(InputError, match=r"out/volume.h5.tiles cannot be written"):
        run_scan(small(), force=True)
    tiles.unlink()
    Path("out/volume.h5.partial").symlink_to("../mine")
    assert not run_scan(small()).path.is_symlink()
    assert Path("mine").read_text() == "mine"


def test_a_pipe_in_the_tiles_place():
    Path("out").mkdir()
    os.mkfifo("out/volume.h5.tiles")
    with pytest.raises(InputError, match=r"out/volume.h5.tiles is no file"):
        run_scan(small())
