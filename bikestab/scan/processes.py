"""Tiles → finished tiles: in this process, or in processes of this machine, which do other work too.

Threads gain nothing here: numpy's calls on tiles that fit the cache take some 10 µs, and a thread that waits
for the interpreter's lock is woken only after several of these.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import traceback
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from pathlib import Path
from queue import SimpleQueue
from types import ModuleType
from typing import Any, cast

from bikestab.aside import copyable, end_with
from bikestab.aside import cores as cores
from bikestab.errors import InputError, WorkersLost
from bikestab.scan.tile import Finished, Tile, compute

Numbered = tuple[int, Tile]


def check_number(processes: int) -> None:
    """InputError for so many processes that starting them takes the machine's memory, or for ever."""
    most = max(64, 4 * cores())
    if processes > most:
        raise InputError(
            f"{processes} processes are too many for this machine", hint=f"allowed: up to {most}"
        )


def in_turn(tiles: Iterable[Numbered]) -> Generator[tuple[int, Finished]]:
    """Compute each tile here."""
    for number, tile in tiles:
        yield number, compute(tile)


def in_processes(
    tiles: Iterable[tuple[int, Any]], jobs: int, work: Callable[[Any], Any] = compute
) -> Generator[tuple[int, Any]]:
    """Compute tiles in ``jobs`` processes, in any order. WorkersLost if one of them dies.

    ``work`` is a module's function, for what else is to be computed in parts that can be pickled.
    Each has one tile at work and one in reserve, no more: they hold memory.
    """
    todo = iter(tiles)
    with ExitStack() as stack:
        workers = {stack.enter_context(_worker(work)): deque[int]() for _ in range(jobs)}
        try:
            for worker in 2 * list(workers):
                _hand(worker, todo, workers)
            while busy := [worker for worker, numbers in workers.items() if numbers]:
                for worker in cast("list[Connection]", wait(busy)):
                    answer = worker.recv()
                    number = workers[worker].popleft()
                    _hand(worker, todo, workers)
                    if isinstance(answer, BaseException):
                        raise answer
                    yield number, answer
        except (EOFError, OSError):
            raise WorkersLost("a worker process died; perhaps the memory is full") from None


def _hand(worker: Connection, todo: Iterator[tuple[int, Any]], workers: dict[Connection, deque[int]]) -> None:
    for number, tile in todo:
        worker.send(tile)
        workers[worker].append(number)
        return


@contextmanager
def _worker(work: Callable[[Any], Any]) -> Iterator[Connection]:
    """A process that answers each tile with what ``work`` makes of it."""
    context, copied = _context()
    ours, theirs = context.Pipe()
    target = partial(_copy, first=os.getpid()) if copied else _serve
    process = context.Process(target=target, args=(theirs, work), daemon=True)
    try:
        with undisturbed():
            process.start()
        theirs.close()
        yield ours
    finally:
        if process.pid is not None:
            process.kill()  # it holds nothing, and a tile at work would only be waited for
            process.join()
        ours.close()


def _context() -> tuple[Any, bool]:
    """How processes are made, and whether as copies of this one, which are there at once.

    Beside other threads each is a new program.
    """
    copied = copyable()
    return multiprocessing.get_context("fork" if copied else "spawn"), copied


def _copy(parent: Connection, work: Callable[[Any], Any], first: int) -> None:
    """``_serve`` in a copy of the ``first`` process, without its files: some of them are locked."""
    end_with(first)
    for file in [int(entry.name) for entry in Path("/proc/self/fd").iterdir()]:
        if file > 2 and file != parent.fileno():
            with suppress(OSError):  # the folder itself is closed already
                os.close(file)
    _serve(parent, work)


@contextmanager
def undisturbed() -> Iterator[None]:
    """Let processes that are started here know nothing of Ctrl-C, nor of the script that was started."""
    mask = None
    if hasattr(signal, "pthread_sigmask"):
        resource_tracker.ensure_running()  # which lets signals through again when it starts
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        with without_script():
            yield
    finally:
        if mask is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)


@contextmanager
def without_script() -> Iterator[None]:
    """Let processes that are started here not import the script that was started.

    It may not be made for that, and has nothing that they need.
    """
    main = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


def _serve(parent: Connection, work: Callable[[Any], Any]) -> None:
    """What a worker process does, until nobody is there any more who wants it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    tiles: SimpleQueue[Any] = SimpleQueue()
    threading.Thread(target=_receive, args=(parent, tiles), daemon=True).start()
    while True:
        answer: Any
        try:
            answer = work(tiles.get())
        except Exception as error:  # whatever it is, the parent tells of it
            error.add_note(traceback.format_exc())
            answer = error
        try:
            parent.send(answer)
        except OSError:
            os._exit(0)


def _receive(parent: Connection, tiles: SimpleQueue[Any]) -> None:
    """Take tiles while others are computed, so that the parent never has to wait before it can go on."""
    try:
        while True:
            tiles.put(parent.recv())
    except (EOFError, OSError):
        os._exit(0)  # the parent is gone
