"""What a file is that a command cannot use."""

from pathlib import Path

import h5py
import pytest

from bikestab.bicycle import Bicycle
from bikestab.config.file import load_config
from bikestab.errors import InputError
from bikestab.formats.kinds import kind_of
from bikestab.presets import preset_text
from bikestab.volume import Volume
from tests.configs import GOOD

RIDER = "mB = 72.0+/-2.0\nxB = 0.29\nyB = 0.0\nzB = -1.1\nIBxx = 8\nIBxz = -1.9\nIByy = 8.1\nIBzz = 2.4\n"
TEXTS = {
    "config": GOOD,
    "bicycle": preset_text("meijaard2007"),
    "rider": RIDER,
    "bikecad": '<?xml version="1.0"?>\n<!DOCTYPE properties SYSTEM "x">\n<properties>\n</properties>\n',
    "certificate": '{"format": "bikestab certificate 2", "bicycle": 1}',
    "yeadon": "# a rider\nsomersault: 2.2\ntwist: 0\n",
}
READERS = {
    "config": load_config,
    "bicycle": lambda path: Bicycle.load(str(path)),
    "volume": Volume,
}


@pytest.fixture
def files(tmp_path):
    """One file of each kind, with an ending that says nothing."""
    for kind, text in TEXTS.items():
        (tmp_path / kind).with_suffix(".dat").write_text(text, "utf-8")
    with h5py.File(tmp_path / "volume.dat", "w"):
        pass
    (tmp_path / "picture.dat").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(range(256)))
    return {path.stem: path for path in tmp_path.iterdir()}


def test_recognised(files, tmp_path):
    assert {kind_of(path) for path in files.values()} == set(files)
    assert all(kind_of(path) == kind for kind, path in files.items())
    assert kind_of(tmp_path) == kind_of(tmp_path / "none") == kind_of("\0") == ""
    (tmp_path / "words").write_text("just words")
    assert kind_of(tmp_path / "words") == ""
    (tmp_path / "scan").mkdir()
    (tmp_path / "scan/volume.h5").touch()
    assert kind_of(tmp_path / "scan") == "volume"
    assert kind_of(Path("configs/quick.yaml")) == "config"
    one = tmp_path / "b.json"
    one.write_text('{"w": 1, "mB": 2}')
    assert kind_of(one) == "bicycle"


@pytest.mark.parametrize("wanted", READERS)
def test_told_of(files, wanted):
    for kind in files.keys() - {wanted}:
        with pytest.raises(InputError) as caught:
            READERS[wanted](files[kind])
        assert ", not a" in caught.value.problem, (kind, str(caught.value))
        assert caught.value.place == str(files[kind])


def test_a_mistake_in_the_right_kind_is_told_as_such(tmp_path):
    path = tmp_path / "b.yaml"
    path.write_text(preset_text("meijaard2007").replace("mB: 85", "mB: -85"), "utf-8")
    with pytest.raises(InputError, match="mB: -85 is not non-negative"):
        Bicycle.load(str(path))
