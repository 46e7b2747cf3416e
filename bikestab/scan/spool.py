"""Finished tiles on disk until the volume is written: a file that only grows, so a kill loses nothing.

The first line names the scan that the tiles are of. Each record after it carries a checksum; what a kill
or a full disk left half-written at the end is cut off when the file is opened again.
"""

from __future__ import annotations

import errno
import json
import os
import stat
import struct
from collections.abc import Mapping
from functools import reduce
from io import FileIO
from pathlib import Path
from typing import Any, Self

from isal import isal_zlib

from bikestab.errors import InputError, ScanError
from bikestab.files import NO_SPACE

try:
    import fcntl
except ImportError:  # pragma: no cover  # Windows has no such lock: nobody then hinders a second scan
    fcntl = None  # type: ignore[assignment]

MARK = b"bikestab tiles "
_MAGIC = MARK + b"4 "  # other builds have other numbers: what they keep of a tile is not the same
_HEAD = struct.Struct("<QIQ")  # number of the tile, lengths of its notes and data
_SUM = struct.Struct("<I")  # checksum of all three
_NO_LOCKS = {errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOLCK}  # some network disks


class Spool:
    """The file of the finished tiles of one scan, held by this process alone.

    ``identity`` is what must be the same for old tiles to be used again, in the order in which it is told of;
    the tiles of another scan are dropped if ``replace``. ``notes`` has what was noted with each tile, by its
    number. Raises InputError where another process has the file, it has another scan's tiles, or it cannot
    be written, and OSError where the disk is full.
    """

    def __init__(self, path: Path, identity: Mapping[str, str], *, replace: bool = False) -> None:
        self.path = path
        self.notes: dict[int, Any] = {}
        self._at: dict[int, tuple[int, int]] = {}  # where each tile's data begin in the file, and end
        try:
            self._file = _locked(path)
        except OSError as error:
            if error.errno in NO_SPACE:
                raise
            problem = f"{path} cannot be written ({error.strerror or error})"
            raise InputError(problem, key=("output",), hint="choose another folder") from None
        first = _MAGIC + json.dumps(dict(identity)).encode() + b"\n"
        try:
            if not self._read(first, replace):
                self._file.truncate(0)
                try:
                    self._append([first], 0)
                except OSError:
                    self.remove()
                    raise
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def add(self, number: int, notes: object, *data: bytes) -> None:
        """Keep a finished tile, its data in one or several parts; ``notes`` is anything that JSON can hold.

        Raises OSError where the disk is full, and ScanError where the file is not in its place any more.
        """
        text = json.dumps(notes).encode()
        length = sum(map(len, data))
        record = [_HEAD.pack(number, len(text), length) + text, *data]
        checksum = reduce(lambda so_far, part: isal_zlib.crc32(part, so_far), record, 0)
        begin = self._end + _SUM.size + len(record[0])
        # before it is written: Ctrl-C takes effect right after that, and the tile is finished then
        self.notes[number], self._at[number] = notes, (begin, begin + length)
        try:
            self._append([_SUM.pack(checksum), *record], self._end)
        except OSError:
            del self.notes[number], self._at[number]
            raise
        if not self.in_place():
            raise removed(self.path)

    def read(self, number: int, part: slice = slice(None)) -> bytes:
        """The data of a finished tile, or a part of it."""
        begin, end = self._at[number]
        start, stop, _ = part.indices(end - begin)
        self._file.seek(begin + start)
        return self._file.read(stop - start)

    def close(self) -> None:
        """Let the file go; others may then use it."""
        self._file.close()

    def remove(self) -> None:
        """Delete the file, which still keeps others out until it is closed."""
        if self.in_place():
            self.path.unlink(missing_ok=True)

    def in_place(self) -> bool:
        """Whether the file is where it was made, so that it will be found again."""
        return _is_at(self._file, self.path)

    def _append(self, data: list[bytes], start: int) -> None:
        self._file.seek(start)
        try:
            for part in data:
                rest = memoryview(part)
                while rest:
                    rest = rest[self._file.write(rest) :]
        except OSError:
            self._file.truncate(start)
            raise
        self._end = start + sum(map(len, data))

    def _read(self, first: bytes, replace: bool) -> bool:
        """Take in what is there already; False where there is nothing to keep."""
        size = os.fstat(self._file.fileno()).st_size
        line = self._file.readline(1 << 16)  # someone else's file may have none
        if line != first and replace:
            return False
        if line.startswith(MARK) and line[: len(_MAGIC)] != _MAGIC[: len(line)]:
            problem = f"{self.path} has tiles that another version of bikestab left unfinished"
            hint = "finish that scan with it, choose another output, or drop them with --force"
            raise InputError(problem, key=("output",), hint=hint)
        if not line.startswith(_MAGIC) and not _MAGIC.startswith(line):
            problem = f"{self.path} is no file of bikestab"
            raise InputError(problem, key=("output",), hint="move it away, or replace it with --force")
        if not line.endswith(b"\n"):
            return False
        if line != first:
            raise InputError(
                f"{self.path} has tiles of another scan that was not finished ({_difference(line, first)})",
                key=("output",),
                hint="finish that one first, choose another output, or drop them with --force",
            )
        self._end = len(line)
        most = size - _SUM.size - _HEAD.size
        while self._end <= most:
            (checksum,) = _SUM.unpack(self._file.read(_SUM.size))
            head = self._file.read(_HEAD.size)
            number, noted, length = _HEAD.unpack(head)
            if self._end + noted + length > most:
                break
            body = self._file.read(noted + length)
            if isal_zlib.crc32(body, isal_zlib.crc32(head)) != checksum:
                break
            self._end += _SUM.size + _HEAD.size + noted + length
            self.notes[number], self._at[number] = json.loads(body[:noted]), (self._end - length, self._end)
        self._file.truncate(self._end)
        return True


def removed(path: Path) -> ScanError:
    """What to say where the file, or its folder, was taken away."""
    problem = f"{path} was removed while it was in use, or moved"
    return ScanError(f"{problem}\nif it is put back, the same command goes on from there")


def _locked(path: Path) -> FileIO:
    while True:
        flags = os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0)
        file = FileIO(os.open(path, flags, 0o666), "r+")
        try:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise InputError(f"{path} is no file", key=("output",), hint="move it away")
            _lock(file, path)
            if _is_at(file, path):
                return file  # else the one who had it has just removed it
        except BaseException:
            file.close()
            raise
        file.close()


def _lock(file: FileIO, path: Path) -> None:
    if not fcntl:
        return
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        problem = f"another scan is writing into {path.parent}"
        raise InputError(problem, key=("output",), hint="wait for it, or choose another output") from None
    except OSError as error:
        if error.errno not in _NO_LOCKS:  # where there are none, nobody hinders a second scan
            raise


def _is_at(file: FileIO, path: Path) -> bool:
    """Whether a path leads to an open file."""
    try:
        return os.path.samestat(os.fstat(file.fileno()), path.stat())
    except OSError:
        return False


def _difference(line: bytes, first: bytes) -> str:
    """The first thing in which two scans differ, in words."""
    try:
        there, here = (dict(json.loads(text[len(_MAGIC) :])) for text in (line, first))
    except (TypeError, ValueError):
        there = here = {}
    key = next((key for key in here | there if there.get(key) != here.get(key)), "")
    return f"another {key}" if key else "its first line is damaged"
