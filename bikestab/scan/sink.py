"""A file that HDF5 may write to, whatever happens meanwhile."""

from __future__ import annotations

import io
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import h5py


class Sink(io.FileIO):
    """A file that keeps what went wrong to itself until it is asked: HDF5 crashes over a failed write."""

    error: BaseException | None = None

    def write(self, data: Any) -> int:
        rest = memoryview(data).cast("B")
        try:
            while rest and not self.error:
                rest = rest[super().write(rest) :]
        except OSError as error:
            self.error = error
        return len(data)

    def check(self) -> None:
        if self.error:
            raise self.error

    @contextmanager
    def uninterrupted(self) -> Iterator[None]:
        """Keep Ctrl-C back as well: within h5py the exception would be lost, and what it wrote."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return

        def keep(*_: object) -> None:
            self.error = self.error or KeyboardInterrupt()

        handler = signal.signal(signal.SIGINT, keep)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, handler)


def empty_file(sink: Sink) -> h5py.File:
    """A file with the links of its root in order, as netCDF-4 wants them to append, and its attributes not.

    With ordered attributes, or newer formats, HDF5 indexes more than eight of them apart, where jsfive
    does not look.
    """
    ordered = h5py.h5p.CRT_ORDER_TRACKED | h5py.h5p.CRT_ORDER_INDEXED
    creation, access = h5py.h5p.create(h5py.h5p.FILE_CREATE), h5py.h5p.create(h5py.h5p.FILE_ACCESS)
    creation.set_obj_track_times(False)
    creation.set_link_creation_order(ordered)
    access.set_libver_bounds(h5py.h5f.LIBVER_EARLIEST, h5py.h5f.LIBVER_LATEST)
    access.set_fileobj_driver(h5py.h5fd.fileobj_driver, sink)
    return h5py.File(h5py.h5f.create(b"volume", h5py.h5f.ACC_TRUNC, creation, access))
