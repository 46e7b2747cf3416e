"""Tiles → finished tiles on a Dask cluster: on other machines, or on processes that Dask keeps here."""

from __future__ import annotations

import logging
import time
from collections.abc import Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from contextlib import contextmanager
from importlib.metadata import version
from itertools import islice
from typing import Any

import numpy as np

from bikestab import __version__
from bikestab.errors import KEPT, InputError, ScanError
from bikestab.scan.processes import Numbered, undisturbed, without_script
from bikestab.scan.tile import Finished, compute

ANSWER, PATIENCE = 8.0, 30.0  # s to wait for a scheduler, and for a worker where there is none
_LOOK = 2.0  # s between two looks at how many there are


def versions() -> dict[str, str]:
    """What has to be the same for the same bytes."""
    vector = np.show_config(mode="dicts")["SIMD Extensions"]["found"]
    return {
        "bikestab": __version__, "numpy": np.__version__, "isal": version("isal"),
        "processor": " ".join(vector) or "plain",
    }  # fmt: skip


def on_cluster(tiles: Iterable[Numbered], scheduler: str) -> Generator[tuple[int, Finished]]:
    """Compute tiles on the Dask cluster at an address, or on ``local:N`` processes, in any order.

    Workers may come and go. Raises InputError for an address that nobody answers at and where Dask is not
    installed, and ScanError where the cluster cannot finish.
    """
    try:
        import distributed
    except ImportError:
        problem = '--scheduler needs the extra: pip install "bikestab[cluster]"'
        raise InputError(problem) from None
    with _quiet(), _client(scheduler) as client:
        try:
            yield from _in_flight(client, tiles)
        except distributed.KilledWorker:
            problem = "lost every worker that tried the same part; perhaps their memory is full"
        except CancelledError:
            problem = "was lost"
        except OSError as error:
            problem = f"does not answer any more ({error})"
        else:
            return
    raise ScanError(f"the cluster at {scheduler} {problem}\n{KEPT}") from None


def _in_flight(client: Any, tiles: Iterable[Numbered]) -> Generator[tuple[int, Finished]]:
    """Keep two tiles at work for each thread of the cluster, no more: each holds memory."""
    executor, todo, here = client.get_executor(pure=False), iter(tiles), versions()
    running: dict[Future[Finished], int] = {}
    threads, looked, seen = 0, 0.0, time.monotonic()
    while True:
        now = time.monotonic()
        if now - looked >= _LOOK:
            threads, looked = sum(client.nthreads().values()), now
        if threads:
            seen = now
        elif now - seen > PATIENCE:
            raise ScanError(f"the cluster has had no worker for {PATIENCE:.0f} s\n{KEPT}")
        for number, tile in islice(todo, max(0, 2 * max(1, threads) - len(running))):
            running[executor.submit(_compute, tile, here)] = number
        if not running:
            return
        for future in wait(running, _LOOK, FIRST_COMPLETED).done:
            yield running.pop(future), future.result()


def _compute(tile: Any, wanted: dict[str, str]) -> Finished:
    for name, there in versions().items():
        if there != wanted[name]:
            raise ScanError(f"a worker of the cluster has {name} {there}, and {wanted[name]} is here")
    return compute(tile)


@contextmanager
def _quiet() -> Iterator[None]:
    """Let Dask not tell in its log what is told in one message here."""
    logs = [logging.getLogger(name) for name in ("distributed", "distributed.client")]
    levels = [log.level for log in logs]
    for log in logs:
        log.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for log, level in zip(logs, levels, strict=True):
            log.setLevel(level)


@contextmanager
def _client(scheduler: str) -> Iterator[Any]:
    from distributed import Client, LocalCluster

    kind, _, number = scheduler.partition(":")
    if kind == "local":
        if not number.isdecimal() or int(number) < 1:
            problem = f"{scheduler!r} is no number of processes"
            raise InputError(problem, hint="for example --scheduler local:4")
        with without_script():  # to the end: a worker that is lost is started again
            with undisturbed():
                cluster = LocalCluster(
                    n_workers=int(number), threads_per_worker=1, memory_limit=0,
                    dashboard_address="127.0.0.1:0", silence_logs="CRITICAL",
                )  # fmt: skip
            with cluster, Client(cluster, set_as_default=False) as client:
                yield client
        return
    try:
        client = Client(scheduler, timeout=ANSWER, set_as_default=False)
    except Exception as error:  # whoever answers may be no scheduler, and say anything
        reason = str(error).split("\n")[0][:200]
        problem = f"no Dask scheduler answers at {scheduler!r} ({reason})"
        raise InputError(problem, hint="for example --scheduler tcp://127.0.0.1:8786") from None
    with client:
        yield client
