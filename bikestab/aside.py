"""A task in a second process, while this one goes on with another.

A copy of this process has all that the task needs, and costs some milliseconds. It is made where there is a
core for it, and only beside no other thread, whose locks it would hold for ever. Where it is ended by
something else, its task is done here; where this process is ended, so is that one.
"""

from __future__ import annotations

import faulthandler
import os
import pickle
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Generic, TypeVar

T = TypeVar("T")
_PR_SET_PDEATHSIG = 1  # of linux/prctl.h


def cores() -> int:
    """How many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def copyable() -> bool:
    """Whether this process has no other thread, whose locks a copy of it would hold for ever.

    Threads of libraries count too, which Python does not know of: those of OpenBLAS, of pyarrow.
    """
    if not sys.platform.startswith("linux"):
        return False
    try:
        return len([*Path("/proc/self/task").iterdir()]) == 1
    except OSError:
        return threading.active_count() == 1


@contextmanager
def meanwhile(task: Callable[[], T]) -> Iterator[Callable[[], T]]:
    """Begin a task; the function that is given waits for what it returns, and raises what it raises.

    Where the block ends without that, nobody wants it any more. What the task returns goes through a pipe.
    """
    second = None
    if cores() > 1 and copyable():
        with suppress(OSError):  # the most processes or files that there may be are there already
            second = _Second(task)
    if second is None:
        yield task
        return
    try:
        yield second.result
    finally:
        second.end()


@contextmanager
def turns(count: int) -> Iterator[Iterator[int]]:
    """The numbers 0 … count − 1, of which this process and one begun within the block get each only once."""
    try:
        file = os.memfd_create("turns")
    except (AttributeError, OSError):  # then a second process gets none
        first = os.getpid()
        yield (number for number in range(count) if os.getpid() == first)
        return
    try:
        os.write(file, b"".join(number.to_bytes(4, "little") for number in range(count)))
        os.lseek(file, 0, os.SEEK_SET)  # which is where both read on
        yield (int.from_bytes(number, "little") for number in iter(partial(os.read, file, 4), b""))
    finally:
        os.close(file)


class _Second(Generic[T]):
    """A process with a task, until its result or its end is asked for."""

    def __init__(self, task: Callable[[], T]) -> None:
        self.task = task
        self.pipe, theirs = os.pipe()
        first = os.getpid()
        try:
            self.child = os.fork()
        except OSError:
            os.close(self.pipe)
            os.close(theirs)
            raise
        if not self.child:
            os.close(self.pipe)  # where the first process is killed, nobody reads, and writing ends
            _answer(task, theirs, first)
        os.close(theirs)

    def result(self) -> T:
        with open(self.pipe, "rb", closefd=False) as pipe:
            answer = pipe.read()
        done: tuple[T] | None = None
        with suppress(EOFError, pickle.UnpicklingError):  # it was ended, by lack of memory for one
            done = pickle.loads(answer)
        return done[0] if done else self.task()

    def end(self) -> None:
        os.close(self.pipe)
        with suppress(ProcessLookupError, ChildProcessError):  # where SIGCHLD is ignored there is none left
            os.kill(self.child, signal.SIGKILL)
            os.waitpid(self.child, 0)


def _answer(task: Callable[[], T], pipe: int, first: int) -> None:
    """What the second process does: nothing of the first one's is closed, flushed or told of twice."""
    try:
        faulthandler.disable()
        end_with(first)
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nowhere, stream)
        answer = memoryview(pickle.dumps((task(),)))
        while answer:
            answer = answer[os.write(pipe, answer) :]
    finally:
        os._exit(0)


def end_with(first: int) -> None:
    """Let the first process's end, however it comes, be that of this one, in the middle of its task."""
    with suppress(ImportError, OSError, AttributeError):  # without it the task is done, for nobody
        from ctypes import CDLL

        CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != first:  # it had ended before
        os._exit(0)
