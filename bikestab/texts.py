"""Texts that are read up to a size and for a time, whatever is at their path."""

from __future__ import annotations

import codecs
import errno
import os
import select
import stat
import time
from contextlib import suppress
from pathlib import Path

from bikestab.errors import InputError, similar

MOST_BYTES = 2_000_000
PATIENCE = 30.0  # s that a pipe may take
_MOST_NAMES = 8


def read_text(path: str | Path, most: int = MOST_BYTES) -> str:
    """The text of the file, pipe or device at ``path``, with newlines for all ends of lines.

    Raises InputError where it cannot be read, is longer than ``most`` bytes, or is no text in UTF-8.
    """
    file = str(path)
    try:
        content = _read(path, most)
    except FileNotFoundError:
        raise InputError(
            "there is no such file", place=file, hint=_neighbours(Path(path).parent, Path(path))
        ) from None
    except IsADirectoryError:
        hint = _neighbours(Path(path), Path())
        raise InputError("is a folder, not a file", place=file, hint=hint) from None
    except OSError as error:
        denied = "its mode allows no reading: 'chmod u+r' does" if error.errno == errno.EACCES else ""
        raise InputError(f"cannot be read ({error.strerror})", place=file, hint=denied) from None
    except ValueError:
        raise InputError("cannot be read (no file has such a name)", place=file) from None
    if len(content) > most:
        raise InputError(f"is longer than {most / 1e6:g} MB, the most that is read", place=file)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        place = f"{file}, line {line}"
        raise InputError("is not a text file in UTF-8", place=place, hint=_encoding(content)) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _encoding(content: bytes) -> str:
    """What to do about bytes that are no UTF-8."""
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "it is in UTF-16: save it as UTF-8, as 'iconv -f utf-16 -t utf-8' does"
    if any(byte < 32 and byte not in b"\t\n\f\r" for byte in content[:4096]):
        return "it is no text at all"
    return "save it as UTF-8, as 'iconv -f latin1 -t utf-8' does of what Western Windows writes"


def is_file(path: str | Path) -> bool:
    """Whether something that may be read as a file is there; also False for what no file can be named."""
    with suppress(OSError, ValueError):
        return Path(path).exists() and not Path(path).is_dir()
    return False


def is_there(path: str | Path) -> bool:
    """Whether anything is there, a folder too; also False for what no file can be named."""
    with suppress(OSError, ValueError):
        return Path(path).exists()
    return False


def _read(path: str | Path, most: int) -> bytes:
    """At most one byte more than ``most``. Raises OSError, also where a pipe takes too long."""
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0))
    with open(descriptor, "rb", buffering=0) as file:  # noqa: PTH123  # open already
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        parts, left, end = [], most + 1, time.monotonic() + PATIENCE
        while left:
            if not stat.S_ISREG(os.fstat(descriptor).st_mode):
                _wait(descriptor, end)
            part = file.read(min(left, 1 << 20))
            if part is None:  # something else took what was there
                continue
            if not part:
                break
            parts.append(part)
            left -= len(part)
        return b"".join(parts)


def _wait(descriptor: int, end: float) -> None:
    """Wait until there is something to read. Raises OSError where that takes too long."""
    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    if not poll.poll(max(0.0, 1e3 * (end - time.monotonic()))):
        raise OSError(errno.ETIMEDOUT, f"it did not end within {PATIENCE:g} s")


def _neighbours(folder: Path, path: Path) -> str:
    """The file in a folder that ``path`` is similar to, or else which are there."""
    others = {path.suffix} & {".txt", ".json", ".ini"}
    try:
        names = sorted(p.name for p in folder.iterdir() if p.suffix in {".yaml", ".yml"} | others)
    except OSError as error:
        if isinstance(error, FileNotFoundError):
            return f"the folder {str(folder)!r} does not exist either"
        return f"the folder {str(folder)!r} cannot be read ({error.strerror})"
    if near := similar(path.stem, {Path(name).stem: name for name in names}):
        return f"did you mean {str(folder / near)!r}?"
    told = [*names[:_MOST_NAMES], *(["..."] if len(names) > _MOST_NAMES else [])]
    kinds = " and ".join(["YAML", *others])
    return f"{kinds} files in {str(folder)!r}: {', '.join(told) or 'none'}"
