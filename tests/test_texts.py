"""Texts are read up to a size and for a time, whatever is at their path."""

import os
import threading
from contextlib import suppress
from importlib import import_module
from pathlib import Path

import pytest

from bikestab.errors import InputError
from bikestab.texts import MOST_BYTES, is_file, read_text


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(import_module("bikestab.texts"), "PATIENCE", 0.2)


def told(path):
    with pytest.raises(InputError) as error:
        read_text(path)
    assert not is_file("a" * 300)
    return str(error.value)


def test_ends_of_lines_and_the_mark_of_an_order_of_bytes():
    Path("a").write_bytes(b"\xef\xbb\xbfa\r\nb\rc\n")
    assert read_text("a") == "a\nb\nc\n"
    assert is_file("a")


def test_the_most_that_is_read():
    Path("a").write_bytes(b"#" * MOST_BYTES)
    assert len(read_text("a")) == MOST_BYTES
    Path("a").write_bytes(b"#" * (MOST_BYTES + 1))
    assert told("a") == "a: is longer than 2 MB, the most that is read"


def test_an_endless_device():
    if not Path("/dev/zero").is_char_device():
        pytest.skip("not there")
    assert told("/dev/zero") == "/dev/zero: is longer than 2 MB, the most that is read"
    assert read_text("/dev/null") == ""


def test_a_pipe_is_read_to_its_end():
    os.mkfifo("pipe")
    writer = threading.Thread(target=lambda: Path("pipe").write_text(100_000 * "long "))
    writer.start()
    assert read_text("pipe") == 100_000 * "long "
    writer.join(10)


def test_an_endless_pipe():
    ours, theirs = os.pipe()

    def write():
        with suppress(BrokenPipeError):
            while True:
                os.write(theirs, b"#" * 4096)

    writer = threading.Thread(target=write)
    writer.start()
    assert "is longer than 2 MB" in told(f"/dev/fd/{ours}")
    os.close(ours)
    writer.join(10)
    os.close(theirs)


def test_a_pipe_into_which_nobody_writes():
    os.mkfifo("pipe")
    assert told("pipe") == "pipe: cannot be read (it did not end within 0.2 s)"
    ours, theirs = os.pipe()  # one that begins and does not end
    os.write(theirs, b"bicycle: ")
    assert told(f"/dev/fd/{ours}").endswith("cannot be read (it did not end within 0.2 s)")
    os.close(ours)
    os.close(theirs)


def test_what_is_no_text():
    Path("a").write_bytes(b"a: 1\nb: \xff\n")
    problem = "a, line 2: is not a text file in UTF-8"
    assert told("a").startswith(f"{problem}\nsave it as UTF-8, as 'iconv -f latin1 -t utf-8'")
    Path("a").write_bytes(b"a: 1\nb: \xff\0")
    assert told("a") == f"{problem}\nit is no text at all"
    Path("b.yaml").touch()
    assert told(".") == ".: is a folder, not a file\nYAML files in '.': b.yaml"
    Path("folder").mkdir()
    Path("folder/file.yaml").touch()
    assert told("folder") == "folder: is a folder, not a file\nYAML files in 'folder': file.yaml"


def test_what_is_not_there(monkeypatch):
    Path("loop").symlink_to("loop")
    assert told("loop") == "loop: cannot be read (Too many levels of symbolic links)"
    assert told("a" * 300).endswith("cannot be read (File name too long)")
    assert told("a" * 300 + "/b").endswith("cannot be read (File name too long)")
    assert told("a\0b").endswith("cannot be read (no file has such a name)")
    assert told("none/b") == "none/b: there is no such file\nthe folder 'none' does not exist either"
    assert told("b") == "b: there is no such file\nYAML files in '.': none"
    for name in [*(f"{i}.yaml" for i in range(9)), "8.txt", "9.json"]:
        Path(name).touch()
    assert told("b.yaml").endswith("'.': 0.yaml, 1.yaml, 2.yaml, 3.yaml, 4.yaml, 5.yaml, 6.yaml, 7.yaml, ...")
    Path("heavy.yaml").touch()
    for name in ("heavyy.yaml", "Heavy.yml", "heavy"):
        assert told(name) == f"{name}: there is no such file\ndid you mean 'heavy.yaml'?"
    Path("heavy.yaml").unlink()
    for name in range(8):
        Path(f"{name}.yaml").unlink()
    assert told("b.txt").endswith("YAML and .txt files in '.': 8.txt, 8.yaml")

    def denied(folder):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "iterdir", denied)
    assert told("b").endswith("the folder '.' cannot be read (Permission denied)")
