"""Tiles → finished tiles on a Dask cluster: on other machines, or on processes that Dask keeps here."""

from __future__ import annotations

import logging
import re
import threading
import time
import warnings
from collections.abc import Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from contextlib import contextmanager
from importlib.metadata import version
from itertools import islice
from typing import Any

import numpy as np

from bikestab import __version__
from bikestab.errors import InputError, ScanError, WorkersLost
from bikestab.scan.processes import Numbered, check_number, undisturbed, without_script
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


def local_processes(scheduler: str) -> int:
    """N of ``local:N``, 0 of another address. Raises InputError where it is no number, or too large."""
    kind, _, number = scheduler.partition(":")
    if kind != "local":
        return 0
    if not re.fullmatch("0*[1-9][0-9]{0,9}", number):
        problem = f"{scheduler!r} is no number of processes"
        raise InputError(problem, hint="for example --scheduler local:4")
    check_number(int(number))
    return int(number)


def on_cluster(tiles: Iterable[Numbered], scheduler: str) -> Generator[tuple[int, Finished]]:
    """Compute tiles on the Dask cluster at an address, or on ``local:N`` processes, in any order.

    Workers may come and go. Raises InputError for an address at which nobody is and where Dask is not
    installed, and ScanError where who is there does not answer as a scheduler, or the cluster cannot finish.
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
    raise WorkersLost(f"the cluster at {scheduler} {problem}") from None


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
            raise WorkersLost(f"the cluster has had no worker for {PATIENCE:.0f} s")
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

    if processes := local_processes(scheduler):
        with without_script():  # to the end: a worker that is lost is started again
            with undisturbed():
                cluster = LocalCluster(
                    n_workers=processes, threads_per_worker=1, memory_limit=0,
                    dashboard_address="127.0.0.1:0", silence_logs="CRITICAL",
                )  # fmt: skip
            with cluster, Client(cluster, set_as_default=False) as client:
                yield client
        return
    _greet(scheduler)
    with _one_warning():
        client = Client(scheduler, timeout=ANSWER, set_as_default=False)
    with client:
        yield client


def _greet(scheduler: str) -> None:
    """Have a scheduler say who it is, within ANSWER: Dask's client waits for ever for a silent one."""
    import asyncio  # which takes longer to import than all else here

    from distributed import rpc

    async def identity() -> None:
        async with rpc(scheduler, timeout=ANSWER / 2) as there:
            await there.identity()

    answers: list[BaseException | None] = []

    def ask() -> None:
        try:
            answers.append(asyncio.run(asyncio.wait_for(identity(), ANSWER)))
        except Exception as error:  # whoever answers may be no scheduler, and say anything
            answers.append(error)

    asking = threading.Thread(target=ask, daemon=True)  # this one may have a loop already
    asking.start()
    asking.join(2 * ANSWER)
    error = answers[0] if answers else TimeoutError()
    if error is None:
        return
    problem = f"no Dask scheduler answers at {scheduler!r}"
    if isinstance(error, (OSError, ValueError)) and not isinstance(error, TimeoutError):
        reason = str(error).split("\n")[0][:200]
        hint = "for example --scheduler tcp://127.0.0.1:8786"
        raise InputError(f"{problem} ({reason})", hint=hint)
    raise ScanError(f"{problem}: who is there said nothing within {ANSWER:g} s, or nothing of Dask's")


@contextmanager
def _one_warning() -> Iterator[None]:
    """Make one line of Dask's table of other versions; those that change the bytes are refused later."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    for warning in caught:
        text = str(warning.message)
        if type(warning.message).__name__ == "VersionMismatchWarning":
            names = re.findall(r"^\| *(\w[\w.-]*) *\|", text, re.MULTILINE)[1:]
            text = f"the cluster has other versions of {', '.join(names)} than this machine"
        warnings.warn(" ".join(text.split()), stacklevel=2)
