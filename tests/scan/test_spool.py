"""Kept tiles: what is put in comes out, of the same scan only, and never two scans at once."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from bikestab.errors import InputError, ScanError
from bikestab.scan import spool as spools
from bikestab.scan.spool import Spool

IDENTITY = {"config": "abc", "bicycle": '{"m1": 80.0}', "version of bikestab": "1.2"}
NOTES = {"stable_points": 7, "agreement": [3, 1e-14, 0, 0.0, 1], "name": "σ"}
PATH = Path("volume.h5.tiles")

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")


def data_of(number):
    return bytes([number]) * (5 + 3 * number)


def fill(numbers=(2, 0, 5), identity=IDENTITY):
    """A spool of some tiles, as one that was killed leaves it: where its records end, and its bytes."""
    with Spool(PATH, identity) as spool:
        ends = [PATH.stat().st_size]
        for number in numbers:
            spool.add(number, {**NOTES, "number": number}, data_of(number))
            ends.append(PATH.stat().st_size)
    return ends, PATH.read_bytes()


def kept():
    """What a spool has when it is opened again; every tile of it is right."""
    with Spool(PATH, IDENTITY) as spool:
        for number, notes in spool.notes.items():
            assert notes == {**NOTES, "number": number}
            assert spool.read(number) == data_of(number)
        return list(spool.notes)


# --- what was put in comes out


def test_round_trip():
    ends, _ = fill()
    assert kept() == [2, 0, 5]
    assert PATH.stat().st_size == ends[-1]


def test_tiles_can_be_read_while_others_are_added():
    with Spool(PATH, IDENTITY) as spool:
        spool.add(1, NOTES, b"one")
        assert spool.read(1) == b"one"
        spool.add(2, NOTES, b"")
        assert (spool.read(1), spool.read(2)) == (b"one", b"")
        spool.add(3, NOTES, b"three")
        assert spool.notes[3] == NOTES


@pytest.mark.parametrize(
    "part", [slice(3), slice(3, None), slice(2, 4), slice(0, 0), slice(99), slice(-2, None)]
)
def test_parts_of_a_tile(part):
    fill()
    with Spool(PATH, IDENTITY) as spool:
        for number in (0, 2, 5):
            assert spool.read(number, part) == data_of(number)[part]


def test_more_can_be_added_to_what_was_kept():
    fill((2, 0))
    with Spool(PATH, IDENTITY) as spool:
        spool.add(5, {**NOTES, "number": 5}, data_of(5))
    assert kept() == [2, 0, 5]


# --- whose tiles they are


@pytest.mark.parametrize("key", IDENTITY)
def test_the_tiles_of_another_scan_are_refused_with_what_differs(key):
    _, whole = fill()
    with pytest.raises(InputError, match=rf"tiles of another scan .*\(another {key}\)") as caught:
        Spool(PATH, {**IDENTITY, key: "other"})
    assert caught.value.key == ("output",)
    assert "--force" in caught.value.hint
    assert PATH.read_bytes() == whole
    assert kept() == [2, 0, 5]


def test_what_is_told_is_the_first_that_differs():
    fill()
    with pytest.raises(InputError, match=r"\(another config\)"):
        Spool(PATH, dict.fromkeys(IDENTITY, "other"))


@pytest.mark.parametrize("other", [{}, {"config": "abc"}, {**IDENTITY, "more": "x"}])
def test_an_identity_of_other_keys_is_another_one(other):
    fill(identity=other)
    with pytest.raises(InputError, match=r"another [a-z]+( of [a-z]+)?\)"):
        Spool(PATH, IDENTITY)


@pytest.mark.parametrize("line", [b"null\n", b"[1]\n", b"{\n", b"\xff\n", b"\n"])
def test_a_first_line_that_is_damaged_is_refused_unless_replaced(line):
    PATH.write_bytes(spools._MAGIC + line)
    with pytest.raises(InputError, match="--force"):
        Spool(PATH, IDENTITY)
    with Spool(PATH, IDENTITY, replace=True) as spool:
        assert not spool.notes


def test_replace_drops_the_tiles_of_others_only():
    fill()
    with Spool(PATH, IDENTITY, replace=True) as spool:
        assert list(spool.notes) == [2, 0, 5]
    with Spool(PATH, {**IDENTITY, "config": "other"}, replace=True) as spool:
        assert not spool.notes
        spool.add(1, NOTES, b"x")
    with pytest.raises(InputError, match="another config"):
        kept()


@pytest.mark.parametrize(
    "content", [b"mine\n" + bytes(5000), b"\x89HDF\r\n\x1a\n" + bytes(100), b"no line at all", b"\n"]
)
def test_a_file_of_someone_else_is_not_touched_unless_replaced(content):
    PATH.write_bytes(content)
    with pytest.raises(InputError, match="is no file of bikestab"):
        Spool(PATH, IDENTITY)
    assert PATH.read_bytes() == content
    with Spool(PATH, IDENTITY, replace=True) as spool:
        spool.add(0, NOTES, b"x")
        assert spool.read(0) == b"x"
    assert PATH.stat().st_size < 1000


# --- one scan at a time


def test_a_spool_that_is_open_is_refused():
    with Spool(PATH, IDENTITY) as spool:
        spool.add(2, {**NOTES, "number": 2}, data_of(2))
        for replace in (False, True):
            with pytest.raises(InputError, match="another scan is writing into") as caught:
                Spool(PATH, IDENTITY, replace=replace)
            assert caught.value.key == ("output",)
    assert kept() == [2]


HOLD = """
import sys
from pathlib import Path
from bikestab.scan.spool import Spool
spool = Spool(Path(sys.argv[1]), {})
print("held", flush=True)
sys.stdin.read()
"""


def test_another_process_keeps_it_until_it_ends():
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(PATH.absolute())], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    with process:
        assert process.stdout.readline() == b"held\n"
        with pytest.raises(InputError, match="another scan is writing"):
            Spool(PATH, {})
        process.kill()
    Spool(PATH, {}).close()


def test_a_removed_file_keeps_nobody_out_once_it_is_closed():
    with Spool(PATH, IDENTITY) as spool:
        spool.remove()
        assert not PATH.exists()
        spool.remove()  # it may be gone
    fill()
    assert kept() == [2, 0, 5]


def test_a_file_removed_while_it_was_waited_for_is_opened_anew(monkeypatch):
    """The one who had it removes it between the other's opening it and locking it."""
    import fcntl

    taken = []

    def flock(file, how):
        if not taken:
            PATH.unlink()
        taken.append(file)
        return lock(file, how)

    lock = fcntl.flock
    monkeypatch.setattr(fcntl, "flock", flock)
    fill((2,))
    monkeypatch.undo()
    os.chdir(PATH.absolute().parent)
    assert len(taken) == 2


# --- the folder


@pytest.mark.parametrize("recreated", [False, True])
def test_a_removed_file_is_noticed_with_the_next_tile(recreated):
    with Spool(PATH, IDENTITY) as spool:
        spool.add(0, NOTES, b"x")
        PATH.unlink()
        if recreated:
            PATH.write_bytes(b"")
        with pytest.raises(ScanError, match=r"volume\.h5\.tiles was removed while it was in use"):
            spool.add(1, NOTES, b"y")


def test_a_place_where_nothing_can_be_written():
    for path in (Path("none/volume.h5.tiles"), Path()):
        with pytest.raises(InputError, match=f"{re.escape(str(path))} cannot be written") as caught:
            Spool(path, IDENTITY)
        assert caught.value.key == ("output",)


def test_the_first_line_is_for_people():
    fill()
    line = PATH.read_bytes().split(b"\n", 1)[0].decode()
    assert line.startswith("bikestab tiles ")
    assert json.loads(line[line.index("{") :]) == IDENTITY
