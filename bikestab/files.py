"""Files that are written whole or not at all, and what to say where one cannot be."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from bikestab.errors import BikestabError, InputError, ScanError

NO_SPACE = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}  # make room, and the same command can succeed
_NOT_THERE = {errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOENT, errno.ENOTDIR, errno.EISDIR}
_NOT_THERE |= {errno.ELOOP, errno.ENAMETOOLONG, errno.EINVAL, errno.EEXIST, errno.ENOTEMPTY}


@contextmanager
def written(path: str | Path) -> Iterator[Path]:
    """A file to fill beside ``path``, which takes its place only when the block ends without an error.

    Raises InputError where ``path`` cannot be written, and ScanError where the disk is full or fails.
    """
    target = Path(path)
    part = target.parent / f".{os.getpid()}.part{target.suffix}"  # the ending tells the kind of picture
    try:
        if target.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        with beside(target, part):
            yield part
    except InputError as error:
        if error.place != str(part):  # about something that was read
            raise
        raise InputError(error.problem, key=error.key, hint=error.hint, place=str(path)) from None
    except ScanError as error:
        raise ScanError(str(error).replace(str(part), str(path))) from None
    except OSError as error:
        raise unwritable(path, error) from None


@contextmanager
def beside(path: Path, part: Path) -> Iterator[None]:
    """Give what the block wrote into ``part`` the name ``path``; nothing is left of it after an error."""
    try:
        yield
        part.replace(path)
    finally:
        with suppress(OSError):  # where it cannot be there, it need not be removed
            part.unlink()


def unwritable(path: str | Path, error: OSError) -> BikestabError:
    """What to raise where ``path`` could not be written: the user's mistake, or the disk's failure."""
    if error.errno in NO_SPACE:
        return ScanError(f"{path}: the disk is full")
    if error.errno in _NOT_THERE:
        return InputError(f"cannot be written ({error.strerror})", place=str(path))
    return ScanError(f"{path}: cannot be written ({error.strerror or error})")
