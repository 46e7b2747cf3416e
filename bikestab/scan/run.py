"""A scan's config → its volume: tiles are computed, kept as they finish, and put together at the end."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import closing, suppress
from dataclasses import dataclass
from math import prod
from pathlib import Path

from bikestab.compiled import check_available
from bikestab.config.scanconfig import ScanConfig
from bikestab.errors import KEPT, NOT_KEPT, InputError, ScanError, WorkersLost
from bikestab.scan.agreement import Agreement
from bikestab.scan.assemble import assemble
from bikestab.scan.cluster import local_processes, on_cluster, versions
from bikestab.scan.output import (
    check_size,
    make_folder,
    own_volume,
    tiles_path,
    unfinished,
    volume_path,
)
from bikestab.scan.plan import Plan
from bikestab.scan.processes import check_number, cores, in_processes, in_turn
from bikestab.scan.spool import Spool
from bikestab.scan.tile import Finished

_START = 1.0  # s of one core's work for each process that is started

Progress = Callable[[int, int], None]  # called with the points finished so far, and all


@dataclass(frozen=True)
class ScanResult:
    """What a scan did. ``computed`` is False where the volume was there already.

    ``agreement`` tells how far the exact speeds agree with the conditions' signs beside them, ``bracketed``
    how far with the zeros that scipy finds between speeds of the grid.
    """

    path: Path
    computed: bool
    points: int
    stable_points: int
    agreement: Agreement
    bracketed: Agreement


def run_scan(
    config: ScanConfig,
    *,
    force: bool = False,
    jobs: int | None = 1,
    scheduler: str = "",
    progress: Progress = lambda done, points: None,
) -> ScanResult:
    """Evaluate the config's grid and write its volume; the same bytes however it is computed.

    ``jobs`` is the number of processes, None for one on each core where the scan is long enough for them;
    ``scheduler`` is a Dask scheduler's address, or ``local:N``. Finished tiles are kept in the output folder
    until the volume is written, so that a scan that was stopped goes on where it was. A complete volume of
    a config that means the same is kept; its title and config text become this one's.

    Raises InputError for too many processes, where the compiled kernel is asked for and not there, for an
    output that belongs to another config (unless ``force``), is being written by another scan, cannot be
    written, or would be too large, and ScanError where the disk is full, a worker is lost, or the exact
    speeds and the conditions do not agree.
    """
    plan, tiles = Plan(config), tiles_path(config)
    check_size(config)
    check_number(jobs or local_processes(scheduler))
    if config.compiled:
        check_available()
    make_folder(config)
    if not force and (kept := _kept(plan)):
        if tiles.exists():
            with suppress(InputError), Spool(tiles, _identity(config)) as spool:  # another's stay
                spool.remove()
        return kept
    try:
        with Spool(tiles, _identity(config), replace=force) as spool:
            if force or not (result := _kept(plan)):  # another scan may just have written it
                try:
                    _compute(plan, spool, jobs, scheduler, progress)
                    result = ScanResult(
                        volume_path(config), True, plan.points, *assemble(plan, spool, volume_path(config))
                    )
                except BaseException as error:
                    if not spool.notes:
                        spool.remove()
                    if isinstance(error, WorkersLost):
                        raise ScanError(f"{error}\n{KEPT if spool.notes else NOT_KEPT}") from None
                    raise
            spool.remove()
            return result
    except OSError as error:
        raise unfinished(config, error) from None


def _kept(plan: Plan) -> ScanResult | None:
    stable_points = own_volume(plan)
    if stable_points is None:
        return None
    return ScanResult(volume_path(plan.config), False, plan.points, stable_points, Agreement(), Agreement())


def _compute(plan: Plan, spool: Spool, jobs: int | None, scheduler: str, progress: Progress) -> None:
    sizes = {number: prod(plan[number].shape) for number in spool.notes}
    done = sum(sizes.values())
    progress(done, plan.points)
    todo = [number for number in range(len(plan)) if number not in sizes]
    tiles = ((number, plan[number]) for number in todo)
    share = len(todo) / len(plan)
    if jobs is None:
        jobs = min(cores(), int(share * plan.seconds() / _START))
    jobs = min(jobs, len(todo))
    finished: Generator[tuple[int, Finished]]
    if scheduler and todo:
        finished = on_cluster(tiles, scheduler)
    else:
        finished = in_processes(tiles, jobs) if jobs > 1 else in_turn(tiles)
    with closing(finished):  # at once, whatever happens: there may be processes
        for number, tile in finished:
            notes = {**tile.notes, "columns_size": len(tile.columns)}
            spool.add(number, notes, tile.columns, tile.chunks)
            done += prod(plan[number].shape)
            progress(done, plan.points)


def _identity(config: ScanConfig) -> dict[str, str]:
    """What has to be the same for the same bytes."""
    return {
        "config": config.sha256,
        **{name if name == "processor" else f"version of {name}": what for name, what in versions().items()},
    }
