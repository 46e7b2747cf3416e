"""A complete volume of a config that means the same: kept, with the new title and text in it."""

import shutil
from importlib import import_module
from pathlib import Path

import h5py
import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.config.file import load_config, parse_config
from bikestab.config.scanconfig import ScanConfig
from bikestab.errors import InputError, ScanError
from bikestab.scan.output import tiles_path
from bikestab.scan.run import run_scan
from bikestab.volume import Volume
from bikestab.yamltext import parse
from tests.scans import config_of, files, load

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")
EARLIER = Path(__file__).parents[1] / "references" / "volumes"
NAMES = sorted(path.stem for path in EARLIER.glob("*.yaml"))


def datasets(path):
    """Every dataset's bytes and every attribute of a file."""
    found = {}
    with h5py.File(path) as file:
        found |= {f"/{name}": value for name, value in file.attrs.items()}
        file.visititems(lambda name, item: found.__setitem__(name, getattr(item, "shape", "group")))
        found |= {name: file[name][()].tobytes() for name, what in found.items() if isinstance(what, tuple)}
    return found


def only_kept(config):
    """Scan what must be there already."""
    result = run_scan(config, progress=lambda *_: pytest.fail("something was computed"))
    assert not result.computed
    return result


@pytest.mark.parametrize(
    "more",
    ["title: another\n", "# a remark\n", "slices: [{V: 2}]\n", "expect: [{stable: never}]\n", "delta: 0\n"],
)
def test_what_changes_no_number_is_not_computed(more):
    """The file is then the same but for the texts."""
    first = run_scan(config_of())
    before = datasets(first.path)
    result = only_kept(config_of(more=more))
    assert (result.points, result.stable_points) == (first.points, first.stable_points)
    after = datasets(result.path)
    shutil.rmtree("out")
    assert datasets(run_scan(config_of(more=more)).path) == after
    assert after.pop("/config") == config_of(more=more).text != before.pop("/config")
    assert after == before | ({"/title": "another"} if "title" in more else {})
    assert files() == ["out/volume.h5"]


def test_another_name_of_the_bicycle():
    numbers = "\n".join(f"  {name}: {value!r}" for name, value in Bicycle.preset("dikarev1981").given.items())
    preset = "bicycle: dikarev1981\n"
    text = config_of().text.replace(preset, f"bicycle:\n  name: other\n  source: mine\n{numbers}\n")
    run_scan(config_of())
    with Volume(only_kept(load(text)).path) as volume:
        assert (volume.bicycle.name, volume.bicycle.source) == ("other", "mine")
        assert volume.title == "other: region of stable motion"


def test_nothing_is_written_if_the_texts_are_the_same():
    path = run_scan(config_of()).path
    before = path.stat().st_mtime_ns, path.stat().st_ino
    only_kept(config_of())
    assert (path.stat().st_mtime_ns, path.stat().st_ino) == before


def test_someone_reads_the_volume_meanwhile():
    path = run_scan(config_of()).path
    with Volume(path) as volume:
        only_kept(config_of(more="title: another\n"))
        assert volume.text("title") == "dikarev1981: region of stable motion"
        assert np.all(volume.read("stable") <= 1)


@pytest.mark.parametrize(
    ("error", "kind", "message"),
    [
        (OSError(28, "No space left on device"), ScanError, "the disk is full\nthe volume is as it was"),
        (PermissionError(13, "Permission denied"), InputError, "cannot be given this config's texts"),
        (KeyboardInterrupt(), KeyboardInterrupt, None),
    ],
)
def test_texts_that_cannot_be_replaced_leave_the_volume_as_it_was(error, kind, message, monkeypatch):
    path = run_scan(config_of()).path
    before = path.read_bytes()

    def fail(*_):
        raise error

    monkeypatch.setattr(import_module("bikestab.scan.output").shutil, "copyfile", fail)
    with pytest.raises(kind, match=message):
        run_scan(config_of(more="title: another\n"))
    assert path.read_bytes() == before
    assert files() == ["out/volume.h5"]


# --- built in Python

GRID = {
    "lam": {"start": 0, "stop": 0.3, "num": 4},
    "sigma": {"values": [0.1, 0.12]},
    "V": {"start": 0, "stop": 9, "num": 4},
}


def built(**values):
    return ScanConfig(**{"bicycle": Bicycle.preset("dikarev1981"), "grid": GRID, "output": "out", **values})


def test_a_second_grid_built_in_python_is_another_scan():
    run_scan(built())
    only_kept(built())
    with pytest.raises(InputError, match=r"another config \(grid.V: 0 ... 9 in 4 values there, 0 ... 9 in 5"):
        run_scan(built(grid={**GRID, "V": {"start": 0, "stop": 9, "num": 5}}))


def test_the_text_in_a_volume_built_in_python_gives_the_same_scan():
    path = run_scan(built(sweep={"m1": [70, 80]})).path
    with Volume(path) as volume:
        again = parse_config(parse(volume.text("config"), "scan.yaml"))
    only_kept(again)


# --- of an earlier build, whose identity was the hash of the text


@pytest.fixture(params=NAMES)
def earlier(request):
    """A config, and its volume of the earlier build in its place."""
    config = load_config(EARLIER / f"{request.param}.yaml")
    Path(config.output).mkdir(parents=True)
    shutil.copyfile(EARLIER / f"{request.param}.h5", f"{config.output}/volume.h5")
    return config


def test_a_volume_of_an_earlier_build_is_recognised(earlier):
    path = Path(earlier.output) / "volume.h5"
    before = datasets(path)
    only_kept(earlier)
    after = datasets(path)
    assert after["/config_sha256"] == earlier.sha256 != before["/config_sha256"]
    assert {**after, "/config_sha256": ""} == {**before, "/config_sha256": ""}
    only_kept(earlier.model_copy(update={"title": "another"}))
    with Volume(path) as volume:
        assert volume.title == "another"


def test_one_of_another_config_is_not(earlier):
    before = (Path(earlier.output) / "volume.h5").read_bytes()
    other = [{"model": "unrefined", "fields": ["conditions"]}]
    other += [{"fields": ["stable", "conditions"]} if earlier.sweep else {"delta": 0.5}]
    for update in other:
        with pytest.raises(InputError, match="was made from another config"):
            run_scan(earlier.model_copy(update=update))
    if earlier.ensemble:
        with pytest.raises(InputError, match=r"\(ensemble: 50 samples there, other ones here\)"):
            run_scan(load_config(EARLIER / "ensemble.yaml", ["ensemble.seed=2"]))
    assert (Path(earlier.output) / "volume.h5").read_bytes() == before


@pytest.mark.parametrize(
    "content", [b'bikestab tiles 1 {"config": "x"}\n', b'bikestab tiles 1 {"conf', b"bikestab tiles 10 {}\n"]
)
def test_tiles_of_an_earlier_build_are_told_of_and_kept(content):
    Path("out").mkdir()
    tiles = tiles_path(config_of())
    tiles.write_bytes(content)
    with pytest.raises(InputError, match="another version of bikestab left unfinished") as caught:
        run_scan(config_of())
    assert "--force" in caught.value.hint
    assert tiles.read_bytes() == content
    assert run_scan(config_of(), force=True).computed
    assert files() == ["out/volume.h5"]


@pytest.mark.parametrize(
    "content", [b"", b"bike", b"bikestab tiles ", b"bikestab tiles 4", b'bikestab tiles 4 {"a']
)
def test_a_first_line_that_a_kill_cut_off_is_no_hindrance(content):
    Path("out").mkdir()
    tiles_path(config_of()).write_bytes(content)
    assert run_scan(config_of()).computed
