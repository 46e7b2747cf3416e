"""Files whole or not at all, and what is said of those that cannot be written."""

import os
import re
import threading
from importlib import import_module
from pathlib import Path

import pytest

from bikestab.errors import InputError, ScanError
from bikestab.files import MAKE_ROOM, NO_SPACE, check_writable, to_stdout, unwritable, written


def test_the_file_appears_when_it_is_whole(tmp_path):
    path = tmp_path / "a.csv"
    with written(path) as part:
        part.write_text("new")
        assert part.suffix == ".csv"
        assert not path.exists()
    assert path.read_text() == "new"
    assert list(tmp_path.iterdir()) == [path]


def test_two_at_once_in_one_folder(tmp_path):
    one, two = tmp_path / "one.csv", tmp_path / "two.csv"
    with written(one) as first, written(two) as second, written(one) as third:
        assert len({first, second, third}) == 3
        for part, text in ((first, "1"), (second, "2"), (third, "3")):
            part.write_text(text)
    assert (one.read_text(), two.read_text()) == ("1", "2")  # the last to be finished stays
    assert sorted(tmp_path.iterdir()) == [one, two]
    (tmp_path / "new").touch()
    assert one.stat().st_mode == (tmp_path / "new").stat().st_mode


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


ADVICE = {
    "none/a.csv": "make it: mkdir -p none",
    "it's/no where/a.csv": """mkdir -p 'it'"'"'s/no where'""",
    "file/a.csv": "file is a file or in one, and no folder",
    "folder": "it is a folder: name a file in it, as folder/NAME", "a" * 256: "choose another name",
    ".": "name a file in it", "/": "name a file in it", "/proc/a.csv": "nothing can be made there",
}  # fmt: skip


@pytest.mark.parametrize("name", ADVICE)
def test_where_no_file_can_be(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    words = "^" + re.escape(name) + r": cannot be written \("
    with pytest.raises(InputError, match=words) as caught, written(name) as part:
        part.write_text("new")
    assert ADVICE[name] in caught.value.hint
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
        assert (
            str(unwritable("a", OSError(number, os.strerror(number)))) == f"a: the disk is full\n{MAKE_ROOM}"
        )
        assert isinstance(unwritable("a", OSError(number, "")), ScanError)
    assert isinstance(unwritable("a", OSError(5, "Input/output error")), ScanError)
    assert isinstance(unwritable("a", PermissionError(13, "Permission denied")), InputError)


def put(path, text="new"):
    with written(path) as part:
        part.write_text(text)


def test_the_file_keeps_its_mode(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("old")
    path.chmod(0o640)
    put(path)
    assert (path.read_text(), path.stat().st_mode & 0o777) == ("new", 0o640)


@pytest.mark.parametrize("there", [True, False], ids=["to a file", "dangling"])
def test_a_link_stays_one(tmp_path, there):
    link, target = tmp_path / "link.csv", tmp_path / "folder" / "a.csv"
    target.parent.mkdir()
    if there:
        target.write_text("old")
    link.symlink_to(Path("folder/a.csv"))
    put(link)
    assert link.is_symlink()
    assert target.read_text() == "new"
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["a.csv", "folder", "link.csv"]


def test_links_that_lead_nowhere(tmp_path):
    for name, target in (("loop", "loop"), ("none", "no/where")):
        (tmp_path / name).symlink_to(target)
        for act in (put, check_writable):
            with pytest.raises(InputError, match=rf"{name}: cannot be written \("):
                act(tmp_path / name)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["loop", "none"]


def test_a_file_that_may_not_be_written(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("old")
    path.chmod(0o444)
    if os.access(path, os.W_OK):
        pytest.skip("this user may write everything")
    with pytest.raises(InputError, match="Permission denied"):
        put(path)
    assert path.read_text() == "old"


def test_a_pipe_is_written_into(tmp_path):
    pipe, got = tmp_path / "pipe", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: got.append(pipe.read_text()))
    reader.start()
    put(pipe, 100_000 * "long ")
    reader.join(10)
    assert got == [100_000 * "long "]
    assert pipe.is_fifo()
    assert list(tmp_path.iterdir()) == [pipe]


def test_a_pipe_that_nobody_reads(tmp_path, monkeypatch):
    monkeypatch.setattr(import_module("bikestab.files"), "PATIENCE", 0.1)
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match=r"pipe: cannot be written \(nobody opened it for reading within"):
        put(tmp_path / "pipe")
    assert (tmp_path / "pipe").is_fifo()


@pytest.mark.parametrize(("name", "error"), [("null", None), ("full", "the disk is full")])
def test_devices_stay(tmp_path, name, error):
    """Real ones: a link leads to them, so that a mistake would replace no more than the link."""
    link = tmp_path / "device"
    if not Path(f"/dev/{name}").is_char_device():
        pytest.skip("not there")
    link.symlink_to(f"/dev/{name}")
    if error:
        with pytest.raises(ScanError, match=error):
            put(link)
    else:
        put(link)
    assert link.is_symlink()
    assert link.is_char_device()
    assert list(tmp_path.iterdir()) == [link]


def test_an_open_file_of_the_shell(tmp_path):
    """Like ``program --csv /dev/fd/N N>>log``: it goes on where the file ends, and is not replaced."""
    log = tmp_path / "log"
    log.write_text("begin ")
    with log.open("a") as open_, log.open() as reader:
        put(f"/dev/fd/{open_.fileno()}")
        assert reader.read() == "begin new"
        assert not to_stdout(log)
    with pytest.raises(InputError, match="cannot be written"):
        put("/dev/fd/9999")


def test_names_that_no_file_has():
    for act in (put, check_writable):
        with pytest.raises(InputError, match="no file has such a name"):
            act("a\0b")


def test_other_mistakes_stay_what_they_are(tmp_path):
    with pytest.raises(ValueError, match=r"^odd$"), written(tmp_path / "a"):
        raise ValueError("odd")
    with pytest.raises(BrokenPipeError), written(tmp_path / "a"):  # whose reader has had enough
        raise BrokenPipeError
    assert list(tmp_path.iterdir()) == []
