"""Files that are written whole or not at all, and what to say where one cannot be."""

from __future__ import annotations

import errno
import os
import re
import shlex
import stat
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from bikestab.errors import BikestabError, InputError, ScanError

PATIENCE = 30.0  # s that nobody may read a pipe
PICTURES = (".png", ".pdf", ".svg")  # the endings of a picture's file
NO_SPACE = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}  # make room, and the same command can succeed
NOT_THERE = {errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOENT, errno.ENOTDIR, errno.EISDIR}
NOT_THERE |= {errno.ELOOP, errno.ENAMETOOLONG, errno.EINVAL, errno.EEXIST, errno.ENOTEMPTY, errno.ENXIO}
NOT_THERE |= {errno.ENODEV, errno.ETXTBSY}
MAKE_ROOM = "make room there, and give the same command again"
_SHORTER = "choose another name"
_OPEN = re.compile(r"/dev/(?:(?P<name>stdin|stdout|stderr)|fd/(?P<number>\d{1,6}))")
_NAMES = {"stdin": 0, "stdout": 1, "stderr": 2}


@contextmanager
def written(path: str | Path) -> Iterator[Path]:
    """A file to fill, which takes the place of ``path`` only when the block ends without an error.

    It is beside ``path``, or beside what ``path`` links to, and gets the mode of what it replaces. Where
    ``path`` is no regular file but a pipe or a device, what was written goes into it. Raises InputError where
    ``path`` cannot be written, and ScanError where the disk is full or fails.
    """
    part = Path(path)
    try:
        there = _status(path)
        if there and (descriptor := _descriptor(path, there)) is not None:
            import tempfile  # few files are pipes

            with open(descriptor, "wb") as sink, tempfile.TemporaryDirectory() as folder:  # noqa: PTH123  # open
                part = Path(folder, "part" + Path(path).suffix[:16])
                yield part
                _pour(part, sink)
            return
        target = linked(path)
        part = target.parent / f".{os.urandom(8).hex()}.part{target.suffix[:16]}"  # nobody else's on any host
        with beside(target, part):
            yield part
            _finish(part, there)
    except InputError as error:
        if error.place != str(part):  # about something that was read
            raise
        raise InputError(error.problem, key=error.key, hint=error.hint, place=str(path)) from None
    except ScanError as error:
        raise ScanError(str(error).replace(str(part), str(path))) from None
    except BrokenPipeError:  # whoever read it has had enough
        raise
    except (OSError, ValueError) as error:
        if isinstance(error, ValueError) and "embedded null" not in str(error):
            raise
        raise unwritable(path, error) from None


def check_writable(path: str | Path) -> None:
    """Raise InputError for a ``path`` at which nothing can be written, as far as that is known before."""
    try:
        _status(path)
    except (OSError, ValueError) as error:
        raise unwritable(path, error) from None


@contextmanager
def beside(path: Path, part: Path) -> Iterator[None]:
    """Give what the block wrote into ``part`` the name ``path``; nothing is left of it after an error."""
    try:
        yield
        part.replace(path)
    finally:
        with suppress(OSError, ValueError):  # where it cannot be there, it need not be removed
            part.unlink()


def linked(path: str | Path) -> Path:
    """What ``path`` leads to, links followed; it need not be there."""
    return Path(os.path.realpath(path)) if Path(path).is_symlink() else Path(path)


def folder_of(path: str | Path) -> Path:
    """Where the paths in a file start: in its folder, and of what stdin gives in the current one."""
    return Path() if _OPEN.fullmatch(str(path)) else Path(path).parent


def to_stdout(path: str | Path) -> bool:
    """Whether what is written to ``path`` goes where stdout goes."""
    try:
        there = Path(path).stat()
        return _number(path) == 1 or (not stat.S_ISCHR(there.st_mode) and _same(1, there))
    except (OSError, ValueError):
        return False


def unwritable(path: str | Path, error: OSError | ValueError) -> BikestabError:
    """What to raise where ``path`` could not be written: the user's mistake, or the disk's failure."""
    if isinstance(error, ValueError):
        return InputError("cannot be written (no file has such a name)", place=str(path), hint=_SHORTER)
    if error.errno in NO_SPACE:
        return ScanError(f"{path}: the disk is full\n{MAKE_ROOM}")
    if error.errno in NOT_THERE:
        hint = _advice(path, error.errno)
        return InputError(f"cannot be written ({error.strerror})", place=str(path), hint=hint)
    return ScanError(f"{path}: cannot be written ({error.strerror or error})")


def _advice(path: str | Path, number: int | None) -> str:
    """What to do about a place at which nothing can be written."""
    folder = Path(path).parent
    if number == errno.ENOENT and not folder.exists():
        return f"its folder is not there; make it: mkdir -p {shlex.quote(str(folder))}"
    advice = {
        errno.EISDIR: f"it is a folder: name a file in it, as {Path(path, 'NAME')}",
        errno.ENOTDIR: f"{folder} is a file or in one, and no folder",
        errno.ENAMETOOLONG: _SHORTER,
    }
    return advice.get(number or 0, "nothing can be made there: choose another place")


def _status(path: str | Path) -> os.stat_result | None:
    """What ``path`` leads to; None where nothing is there. Raises OSError where nothing can be written."""
    try:
        there = Path(path).stat()
    except FileNotFoundError:
        linked(path).parent.stat()
        return None
    if stat.S_ISDIR(there.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    return there


def _number(path: str | Path) -> int | None:
    """The descriptor that a name such as /dev/stdout stands for."""
    match = _OPEN.fullmatch(str(path))
    return match and (_NAMES[match["name"]] if match["name"] else int(match["number"]))


def _same(descriptor: int, there: os.stat_result) -> bool:
    try:
        return os.path.samestat(os.fstat(descriptor), there)
    except OSError:
        return False


def _descriptor(path: str | Path, there: os.stat_result) -> int | None:
    """A new descriptor of what is written into and not replaced; None for a regular file. Raises OSError."""
    number = _number(path)
    if number is None and stat.S_ISREG(there.st_mode):  # the shell's ``> a.csv`` of the same file
        number = next((n for n in (1, 2) if _same(n, there)), None)
    if number is not None:
        return os.dup(number)  # opened anew, it would begin at the file's start
    if stat.S_ISREG(there.st_mode):
        return None
    end = time.monotonic() + PATIENCE
    while True:
        try:
            descriptor = os.open(path, os.O_WRONLY | getattr(os, "O_NONBLOCK", 0))
        except OSError as error:
            if error.errno != errno.ENXIO or not stat.S_ISFIFO(there.st_mode):
                raise
            if time.monotonic() > end:
                raise OSError(errno.ENXIO, f"nobody opened it for reading within {PATIENCE:g} s") from None
            time.sleep(0.02)
        else:
            os.set_blocking(descriptor, True)
            return descriptor


def _pour(part: Path, sink: BinaryIO) -> None:
    import shutil

    if sys.stdout is not None:
        sys.stdout.flush()  # what was printed before comes first
    with part.open("rb") as source:
        shutil.copyfileobj(source, sink)
    sink.flush()


def _finish(part: Path, there: os.stat_result | None) -> None:
    """Let it have the mode of what was there, and be on the disk before it takes that one's name."""
    if there:
        part.chmod(stat.S_IMODE(there.st_mode))
    with part.open("rb") as file:
        os.fsync(file.fileno())
