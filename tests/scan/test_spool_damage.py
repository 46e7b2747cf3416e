"""Kept tiles after a kill, a full disk, a bad one: what was whole before, and never a wrong tile."""

import errno
import os
from contextlib import suppress

import pytest

from bikestab.errors import InputError
from bikestab.scan import spool as spools
from bikestab.scan.spool import Spool
from tests.scan.test_spool import IDENTITY, NOTES, PATH, data_of, fill, kept

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")


def test_a_file_cut_anywhere_keeps_what_was_whole_before():
    ends, whole = fill()
    for size in range(len(whole) + 1):
        PATH.write_bytes(whole[:size])
        number = sum(end <= size for end in ends[1:])
        assert kept() == [2, 0, 5][:number]
        assert PATH.stat().st_size == ends[number]


def test_a_cut_file_can_be_filled_up_again():
    ends, whole = fill()
    for size in (0, 5, ends[0] - 1, ends[0], ends[1] + 1, ends[2] - 1):
        PATH.write_bytes(whole[:size])
        with Spool(PATH, IDENTITY) as spool:
            for number in (2, 0, 5):
                if number not in spool.notes:
                    spool.add(number, {**NOTES, "number": number}, data_of(number))
        assert PATH.read_bytes() == whole


@pytest.mark.parametrize("flip", [1, 0x80, 0xFF])
def test_a_byte_that_is_wrong_anywhere_gives_no_wrong_tile(flip):
    """In a record it costs that and those behind; in the first line the file is refused."""
    ends, whole = fill()
    for i in range(len(whole)):
        bad = bytearray(whole)
        bad[i] ^= flip
        PATH.write_bytes(bad)
        if i == ends[0] - 1:  # without its end the first line goes on; where no other one comes, it is half
            with suppress(InputError):
                assert kept() == []
        elif i < ends[0]:
            with pytest.raises(InputError):
                Spool(PATH, IDENTITY)
            assert PATH.read_bytes() == bad
        else:
            assert kept() == [2, 0, 5][: sum(end <= i for end in ends[1:])]


class _Full:
    """A file on a disk that has room for some more bytes."""

    def __init__(self, file, room):
        self.file, self.room = file, room

    def write(self, data):
        if not self.room:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        written = self.file.write(data[: self.room])
        self.room -= written
        return written

    def __getattr__(self, name):
        return getattr(self.file, name)


def test_a_full_disk_leaves_the_earlier_tiles_good():
    ends, whole = fill()
    for room in range(ends[3] - ends[2]):
        PATH.write_bytes(whole[: ends[2]])
        with Spool(PATH, IDENTITY) as spool:
            spool._file = _Full(spool._file, room)
            with pytest.raises(OSError, match="No space"):
                spool.add(5, {**NOTES, "number": 5}, data_of(5))
            assert list(spool.notes) == [2, 0]
            assert spool.read(2) == data_of(2)
            assert PATH.stat().st_size == ends[2]
            spool._file.room = 10_000  # there is room again
            spool.add(5, {**NOTES, "number": 5}, data_of(5))
        assert PATH.read_bytes() == whole


def test_ctrl_c_right_after_a_write_loses_no_tile():
    with Spool(PATH, IDENTITY) as spool:
        write = spool._file.write
        spool._file = _Full(spool._file, 10_000)

        def interrupted(data):
            written = write(data)
            if bytes(data) == data_of(2):  # the record's last part
                raise KeyboardInterrupt
            return written

        spool._file.write = interrupted
        with pytest.raises(KeyboardInterrupt):
            spool.add(2, {**NOTES, "number": 2}, data_of(2))
        assert list(spool.notes) == [2]
    assert kept() == [2]


def test_a_disk_that_takes_a_few_bytes_at_a_time():
    _, whole = fill()
    PATH.unlink()
    with Spool(PATH, IDENTITY) as spool:
        write = spool._file.write
        spool._file = _Full(spool._file, 10_000)
        spool._file.write = lambda data: write(data[:7])
        for number in (2, 0, 5):
            spool.add(number, {**NOTES, "number": number}, data_of(number))
    assert PATH.read_bytes() == whole


@pytest.mark.parametrize("room", [0, 10])
def test_a_disk_too_full_for_the_first_line_is_left_as_it_was(room, monkeypatch):
    locked = spools._locked
    monkeypatch.setattr(spools, "_locked", lambda path: _Full(locked(path), room))
    with pytest.raises(OSError, match="No space"):
        Spool(PATH, IDENTITY)
    assert not PATH.exists()
