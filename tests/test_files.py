"""Files whole or not at all, and what is said of those that cannot be written."""

import os
import re

import pytest

from bikestab.errors import InputError, ScanError
from bikestab.files import NO_SPACE, unwritable, written


def test_the_file_appears_when_it_is_whole(tmp_path):
    path = tmp_path / "a.csv"
    with written(path) as part:
        part.write_text("new")
        assert part.suffix == ".csv"
        assert not path.exists()
    assert path.read_text() == "new"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("error", [OSError(28, "full"), ValueError("no"), KeyboardInterrupt()])
def test_after_an_error_the_old_file_is_there(tmp_path, error):
    path = tmp_path / "a.csv"
    path.write_text("old")

    def write():
        with written(path) as part:
            part.write_text("ne")
            raise error

    with pytest.raises((ScanError, ValueError, KeyboardInterrupt)):
        write()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", ["none/a.csv", "file/a.csv", "folder", "a" * 256, ".", "/"])
def test_where_no_file_can_be(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    words = "^" + re.escape(name) + r": cannot be written \("
    with pytest.raises(InputError, match=words), written(name) as part:
        part.write_text("new")
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["file", "folder"]


def test_a_name_as_long_as_there_can_be(tmp_path):
    path = tmp_path / ("a" * 251 + ".csv")
    with written(path) as part:
        part.write_text("new")
    assert path.read_text() == "new"


def test_mistakes_name_the_file_and_not_its_part(tmp_path):
    path = tmp_path / "a.csv"
    with pytest.raises(InputError) as caught, written(path) as part:
        raise InputError("is odd", key=("V",), hint="be even", place=str(part))
    assert str(caught.value) == f"{path}: V: is odd\nbe even"
    with pytest.raises(InputError, match=r"^v: is damaged$"), written(path):
        raise InputError("is damaged", place="v")


def test_the_disks_failure_is_nobodys_mistake():
    for number in NO_SPACE:
        assert str(unwritable("a", OSError(number, os.strerror(number)))) == "a: the disk is full"
        assert isinstance(unwritable("a", OSError(number, "")), ScanError)
    assert isinstance(unwritable("a", OSError(5, "Input/output error")), ScanError)
    assert isinstance(unwritable("a", PermissionError(13, "Permission denied")), InputError)
