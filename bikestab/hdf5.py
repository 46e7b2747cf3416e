"""HDF5 files that others made: what may be in one, and its attributes and datasets, each checked before use.

Raises InputError with the name of the object, for whatever it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from math import ceil, prod
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from bikestab.errors import InputError

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_CUT = re.compile(r"truncated file: eof = (\d+),.* stored_eof = (\d+)")  # the words of HDF5
_WRITES = "'bikestab scan CONFIG' writes a volume: volume.h5 in its output folder"
MOST_OBJECTS = 10_000
_PACKED = 1100  # gzip makes nothing smaller than 1032 times
_FILTERS = {h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE}


def open_file(path: Path) -> h5py.File:
    """Open a file for reading. Raises InputError where it is no HDF5 file, or cannot be read now."""
    try:
        with path.open("rb") as file:
            head = file.read(len(_SIGNATURE))
        return h5py.File(path, "r")
    except PermissionError as error:
        raise InputError(f"cannot be read ({error.strerror})") from None
    except OSError as error:
        if "unable to lock" in str(error):
            raise InputError("is being written to by another program", hint="try again later") from None
        if not head:
            raise InputError("is empty", hint=_WRITES) from None
        if head != _SIGNATURE:
            raise InputError("is not an HDF5 file", hint=_WRITES) from None
        if cut := _CUT.search(str(error)):
            problem = f"is cut off: {cut[1]} of its {cut[2]} bytes are there"
            raise InputError(problem, hint="copy it again, or 'bikestab scan CONFIG --force'") from None
        raise InputError("is a damaged HDF5 file") from None


@contextmanager
def reading(*key: str) -> Iterator[None]:
    """Whatever h5py raises over a damaged object is a mistake of that object: it raises nearly everything."""
    try:
        yield
    except InputError:
        raise
    except Exception as error:
        reason = " ".join(str(error).split())[:100]
        raise InputError(f"is damaged and cannot be read ({reason})", key=key) from None


def check_links(file: h5py.File) -> None:
    """Raise InputError where anything in the file leads out of it, and for more objects than a volume has."""
    todo, seen, count = [("", file.id)], set(), 0
    while todo:
        prefix, group = todo.pop()
        with reading(prefix or "the file"):
            names = list(group)
        for name in names:
            path = prefix + name.decode("utf-8", "replace")
            count += 1
            if count > MOST_OBJECTS:
                raise InputError(f"has more than {MOST_OBJECTS} objects")
            with reading(path):
                kind = group.links.get_info(name).type
                if kind not in (h5py.h5l.TYPE_HARD, h5py.h5l.TYPE_SOFT):
                    raise InputError("is a link out of the file, which is not followed", key=(path,))
                if kind == h5py.h5l.TYPE_SOFT:
                    continue
                about = h5py.h5o.get_info(group, name)
                if about.type == h5py.h5o.TYPE_GROUP and about.addr not in seen:
                    seen.add(about.addr)
                    todo.append((f"{path}/", h5py.h5g.open(group, name)))
                elif about.type == h5py.h5o.TYPE_DATASET and about.addr not in seen:
                    seen.add(about.addr)
                    _check_storage(h5py.h5d.open(group, name), path)


def _check_storage(data: h5py.h5d.DatasetID, path: str) -> None:
    plist = data.get_create_plist()
    if plist.get_layout() == h5py.h5d.VIRTUAL:
        raise InputError("is a virtual dataset, with its values in other files", key=(path,))
    if plist.get_external_count():
        raise InputError("has its values in another file", key=(path,))


def text_of(file: h5py.File, name: str) -> str:
    """A text attribute of the file."""
    value = _attribute(file, name)
    if not isinstance(value, (str, bytes)):
        raise InputError(f"the attribute {name!r} is no text")
    try:
        return value.decode() if isinstance(value, bytes) else value.encode().decode()
    except UnicodeError:  # h5py lets some of it through
        raise InputError(f"the attribute {name!r} is no UTF-8 text") from None


def number_of(item: h5py.Group, name: str, low: float, high: float) -> float:
    """A number between ``low`` and ``high``, an attribute of the file or of a group."""
    value = _attribute(item, name)
    if not isinstance(value, (np.integer, np.floating)):
        raise InputError(f"the attribute {name!r} is no number", key=_key(item))
    if not low <= value <= high:
        problem, hint = f"the attribute {name!r} is {value:g}", f"allowed: {low:g} ... {high:g}"
        raise InputError(problem, key=_key(item), hint=hint)
    return value.item()


def _attribute(item: h5py.Group, name: str) -> Any:
    try:
        if name not in item.attrs:
            raise InputError(f"has no attribute {name!r}", key=_key(item))
        if item.attrs.get_id(name).shape != ():
            raise InputError(f"the attribute {name!r} is not a single value", key=_key(item))
        return item.attrs[name]
    except InputError:
        raise
    except Exception as error:  # as ``reading``
        reason = " ".join(str(error).split())[:100]
        raise InputError(f"the attribute {name!r} is damaged ({reason})", key=_key(item)) from None


def _key(item: h5py.Group) -> tuple[str, ...]:
    return () if item.name == "/" else (item.name[1:],)


def dataset(file: h5py.File, name: str, dtype: type, shape: tuple[int, ...] | None = None) -> h5py.Dataset:
    """A dataset of a type and a shape (one axis of any length for None), which the file can hold."""
    with reading(name):
        try:
            data = file[name]
        except KeyError:
            raise InputError("is missing, damaged, or a link that leads nowhere", key=(name,)) from None
        if not isinstance(data, h5py.Dataset):
            raise InputError("is a group, not a dataset", key=(name,))
        if data.dtype.newbyteorder("=") != np.dtype(dtype):
            problem = f"has values of type {data.dtype}, not {np.dtype(dtype)}"
            raise InputError(problem[:100], key=(name,))
        if (len(data.shape or ()) != 1) if shape is None else (data.shape != shape):
            wanted = "one axis" if shape is None else f"the shape {_times(shape)}"
            raise InputError(f"has the shape {_times(data.shape or ())}, not {wanted}", key=(name,))
        _check_size(file, data, name)
    return data


def _times(shape: tuple[int, ...]) -> str:
    return " × ".join(map(str, shape)) or "of a single value"


def _check_size(file: h5py.File, data: h5py.Dataset, name: str) -> None:
    """Raise InputError for filters that not every reader has, and for more values than the file can hold."""
    plist, stored = data.id.get_create_plist(), data.id.get_storage_size()
    for number in range(plist.get_nfilters()):
        if plist.get_filter(number)[0] not in _FILTERS:
            problem = f"has a filter of kind {plist.get_filter(number)[0]}"
            raise InputError(problem, key=(name,), hint="allowed: gzip and shuffle")
    if stored > Path(file.filename).stat().st_size:
        raise InputError("claims to be larger than the file", key=(name,))
    if not data.chunks:
        if stored < data.nbytes:
            raise InputError("has fewer values than its shape tells", key=(name,))
        return
    if any(step > n for step, n in zip(data.chunks, data.shape, strict=True)):
        raise InputError(f"has chunks larger than itself: {_times(data.chunks)}", key=(name,))
    there = data.id.get_num_chunks()
    if there > prod(ceil(n / step) for n, step in zip(data.shape, data.chunks, strict=True)):
        raise InputError("has more chunks than its shape tells", key=(name,))
    if prod(data.chunks) * data.dtype.itemsize * there > _PACKED * stored:
        raise InputError("claims more values than the file can hold", key=(name,))


def check_whole(data: h5py.Dataset) -> None:
    """Raise InputError where chunks of a dataset are missing."""
    if data.chunks:
        wanted = prod(ceil(n / step) for n, step in zip(data.shape, data.chunks, strict=True))
        if data.id.get_num_chunks() != wanted:
            problem = f"has {data.id.get_num_chunks()} of its {wanted} chunks"
            raise InputError(problem, key=(data.name[1:],))
