"""A file that HDF5 may write to, whatever happens meanwhile."""

from __future__ import annotations

import io
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


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
