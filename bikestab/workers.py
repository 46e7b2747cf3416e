"""Tiles → finished tiles: in this process, in processes of this machine, or on a Dask cluster.

Threads gain nothing here: numpy's calls on tiles that fit the cache take some 10 µs, and a thread that waits
for the interpreter's lock is woken only after several of these.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import islice
from typing import Any

from bikestab import __version__
from bikestab.errors import InputError, ScanError
from bikestab.tiles import Finished, Tile, compute

Numbered = tuple[int, Tile]


def in_turn(tiles: Iterable[Numbered]) -> Iterator[tuple[int, Finished]]:
    """Compute each tile here."""
    for number, tile in tiles:
        yield number, compute(tile)


def in_processes(tiles: Iterable[Numbered], jobs: int) -> Iterator[tuple[int, Finished]]:
    """Compute tiles in ``jobs`` processes, in any order. ScanError if one of them dies."""
    with _pool(jobs) as pool:
        try:
            yield from _in_flight(pool, tiles, 2 * jobs)
        except BrokenProcessPool:
            raise ScanError("a worker process died; perhaps the machine's memory is full") from None


def on_cluster(tiles: Iterable[Numbered], scheduler: str) -> Iterator[tuple[int, Finished]]:
    """Compute tiles on the Dask cluster at an address, or on ``local:N`` processes, in any order.

    Raises InputError for an address that nobody answers at and where Dask is not installed, and ScanError
    where the cluster cannot finish.
    """
    try:
        import dask
        import distributed
    except ImportError:
        problem = '--scheduler needs the extra: pip install "bikestab[cluster]"'
        raise InputError(problem) from None
    with dask.config.set({"distributed.logging.distributed": "critical"}), _client(scheduler) as client:
        versions = client.run(_version)
        other = {worker: version for worker, version in versions.items() if version != __version__}
        for worker, version in other.items():
            raise ScanError(f"worker {worker} has bikestab {version}, this is {__version__}")
        window = 2 * max(1, sum(client.nthreads().values()))
        try:
            yield from _in_flight(client.get_executor(pure=False), tiles, window)
        except (distributed.KilledWorker, distributed.client.FutureCancelledError, OSError) as error:
            raise ScanError(f"the cluster at {scheduler} could not finish ({error})") from None


def _in_flight(executor: Executor, tiles: Iterable[Numbered], window: int) -> Iterator[tuple[int, Finished]]:
    """Keep ``window`` tiles at work, no more: each holds memory."""
    todo = iter(tiles)
    running: dict[Future[Finished], int] = {}
    try:
        while True:
            for number, tile in islice(todo, window - len(running)):
                running[executor.submit(compute, tile)] = number
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(future), future.result()
    finally:
        for future in running:
            future.cancel()


@contextmanager
def _pool(jobs: int) -> Iterator[Executor]:
    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("forkserver" if "forkserver" in methods else "spawn")
    if "forkserver" in methods:
        context.set_forkserver_preload(["bikestab.tiles"])
    others = set(multiprocessing.active_children())
    pool = ProcessPoolExecutor(jobs, context, initializer=_start)
    try:
        yield pool
    except BaseException:
        for process in set(multiprocessing.active_children()) - others:
            process.terminate()  # its tile would only be waited for
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _start() -> None:
    """Let a worker leave Ctrl-C to the process that started it, and not outlive that."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None

    def follow() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=follow, daemon=True).start()


@contextmanager
def _client(scheduler: str) -> Iterator[Any]:
    from distributed import Client, LocalCluster

    kind, _, rest = scheduler.partition(":")
    if kind == "local":
        if not rest.isdecimal() or int(rest) < 1:
            problem = f"{scheduler!r} is no number of processes"
            raise InputError(problem, hint="for example --scheduler local:4")
        with (
            LocalCluster(
                n_workers=int(rest), threads_per_worker=1, dashboard_address=None, silence_logs="CRITICAL"
            ) as cluster,
            Client(cluster) as client,
        ):
            yield client
        return
    try:
        client = Client(scheduler, timeout=10)
    except (OSError, ValueError) as error:
        problem = f"no Dask scheduler answers at {scheduler!r} ({error})"
        raise InputError(problem, hint="for example --scheduler tcp://127.0.0.1:8786") from None
    with client:
        yield client


def _version() -> str:
    return __version__
