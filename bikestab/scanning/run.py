"""A scan's config → its volume: tiles are computed, kept as they finish, and put together at the end."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Generator, Iterator
from contextlib import closing, suppress
from dataclasses import dataclass
from functools import lru_cache
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from bikestab import yamltext
from bikestab.config.scanconfig import ScanConfig
from bikestab.errors import KEPT, InputError, ScanError, dotted
from bikestab.fields import AXES, FIELDS
from bikestab.files import NO_SPACE
from bikestab.routh import CONDITIONS
from bikestab.scanning.cluster import on_cluster, versions
from bikestab.scanning.crosscheck import Agreement
from bikestab.scanning.plan import Plan
from bikestab.scanning.processes import in_processes, in_turn
from bikestab.scanning.sheets import Atlas
from bikestab.scanning.spool import Spool, removed
from bikestab.scanning.tile import Columns, Finished, keep_heap, parted
from bikestab.scanning.writer import VolumeWriter, new_volume
from bikestab.units import shown
from bikestab.volume import Volume, parameters_text

MOST_VALUES = 4_000_000  # of an axis
_COLUMN_BYTES = 100  # in the file, of the intervals and sheets of one (λ, σ)
_START = 1.0  # s of one core's work for each process that is started

Progress = Callable[[int, int], None]  # called with the points finished so far, and all


@dataclass(frozen=True)
class ScanResult:
    """What a scan did. ``computed`` is False where the volume was there already."""

    path: Path
    computed: bool
    points: int
    stable_points: int
    agreement: Agreement


def volume_path(config: ScanConfig) -> Path:
    """Where the scan's volume goes."""
    return Path(config.output) / "volume.h5"


def tiles_path(config: ScanConfig) -> Path:
    """Where its finished tiles are kept until then."""
    return Path(config.output) / "volume.h5.tiles"


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
    the same config is left as it is.

    Raises InputError for an output that belongs to another config (unless ``force``), is being written by
    another scan, cannot be written, or would be too large, and ScanError where the disk is full, a worker
    is lost, or the exact speeds and the conditions do not agree.
    """
    plan, path = Plan(config), volume_path(config)
    tiles = tiles_path(config)
    check_size(config)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        if error.errno in NO_SPACE:
            raise _unfinished(path, tiles, error) from None
        raise InputError(
            f"{config.output} cannot be made ({error.strerror})",
            key=("output",),
            hint="choose another folder",
        ) from None
    if path.exists() and not path.is_file():
        raise InputError(f"{path} is no file", key=("output",), hint="move it away, or choose another output")
    if not force and (there := _same(path, plan)):
        if tiles.exists():
            with suppress(InputError), Spool(tiles, _identity(config)) as spool:  # another's stay
                spool.remove()
        return there
    try:
        with Spool(tiles, _identity(config), replace=force) as spool:
            if not force and (there := _same(path, plan)):  # another scan has just written it
                spool.remove()
                return there
            try:
                _compute(plan, spool, jobs, scheduler, progress)
                result = _assemble(plan, spool, path)
            except BaseException:
                if not spool.notes:
                    spool.remove()
                raise
            spool.remove()
            return result
    except OSError as error:
        raise _unfinished(path, tiles, error) from None


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
            notes = {**tile.notes, "columns": len(tile.columns)}
            spool.add(number, notes, tile.columns, tile.chunks)
            done += prod(plan[number].shape)
            progress(done, plan.points)


def _assemble(plan: Plan, spool: Spool, path: Path) -> ScanResult:
    """Write the volume from its tiles."""
    keep_heap()
    notes = spool.notes
    agreement, stable_points = Agreement(), 0
    for note in notes.values():
        agreement = agreement.joined(Agreement(*note["agreement"]))
        stable_points += note["stable_points"]

    @lru_cache(maxsize=1)  # they are needed twice, but memory does not bear those of every machine
    def atlases(member: int) -> dict[str, Atlas]:
        return _atlases(plan, spool, member)

    widths = [atlas.width for member in range(plan.members) for atlas in atlases(member).values()]
    with new_volume(path, plan) as writer:
        writer.create_columns(
            max(note["intervals"] for note in notes.values() if note["columns"]), max(widths)
        )
        for number in range(len(plan)):
            _write(writer, plan, spool, number, atlases(plan.member(number)))
        writer.finish(stable_points, agreement)
    return ScanResult(path, True, plan.points, stable_points, agreement)


def _atlases(plan: Plan, spool: Spool, member: int) -> dict[str, Atlas]:
    """The sheets of each condition over the (λ, σ) of one machine of the sweep."""
    tiles = plan.with_columns(member)
    found = {}
    for name in CONDITIONS:
        rising, falling = zip(*(spool.notes[number]["most_roots"][name] for number in tiles), strict=True)
        found[name] = Atlas(name, (max(rising), max(falling)))
    for number in tiles:
        columns = _columns(spool, number)
        for name, atlas in found.items():
            atlas.add(plan.cell(number), columns.roots[name])
    for atlas in found.values():
        atlas.finish()
    return found


def _write(writer: VolumeWriter, plan: Plan, spool: Spool, number: int, atlases: dict[str, Atlas]) -> None:
    place, columns = plan.place(number), spool.notes[number]["columns"]
    writer.write_fields(place, plan[number].shape, parted(spool.read(number, slice(columns, None))))
    if columns:
        found = _columns(spool, number)
        surfaces = {
            name: atlas.sheets(plan.cell(number), found.roots[name], found.intervals)
            for name, atlas in atlases.items()
        }
        writer.write_columns(place, found.intervals, surfaces, found.spread)


def _columns(spool: Spool, number: int) -> Columns:
    return Columns.from_bytes(spool.read(number, slice(spool.notes[number]["columns"])))


def cores() -> int:
    """How many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def check_size(config: ScanConfig) -> None:
    """Raise InputError if an axis is too long, or the grid asks for more than the disk has."""
    plan, shape = Plan(config), config.grid.shape
    largest = AXES[int(np.argmax(shape))]
    axis = getattr(config.grid, largest)
    key = ("grid", largest, "num" if hasattr(axis, "num") else "values")
    if max(shape) > MOST_VALUES:
        raise InputError(f"{max(shape)} values are too many", key=key, hint=f"allowed: up to {MOST_VALUES}")
    each = sum(np.dtype(FIELDS[name].dtype).itemsize / FIELDS[name].packing for name in plan.fields)
    needed = each * float(plan.points) + _COLUMN_BYTES * float(plan.points / shape[-1])
    folder = Path(config.output).absolute()
    try:
        while not folder.exists():
            folder = folder.parent
    except OSError as error:  # a name that is too long, say
        problem = f"{shown(config.output)} is no folder name ({error.strerror})"
        raise InputError(problem, key=("output",)) from None
    there = shutil.disk_usage(folder).free
    for old in (volume_path(config), tiles_path(config)):  # what an earlier run has of it
        with suppress(OSError):
            there += old.stat().st_size
    if needed > there:
        size = " × ".join(str(n) for n in plan.shape)
        raise InputError(
            f"the grid {size} needs {needed / 1e9:.4g} GB of disk, and {folder} has {there / 1e9:.4g} GB",
            key=key,
            hint="make room, choose another output, or take fewer values or fields",
        )


def _identity(config: ScanConfig) -> dict[str, str]:
    """What has to be the same for the same bytes."""
    return {
        "config": config.sha256,
        "bicycle": parameters_text(config.machine),
        **{name if name == "processor" else f"version of {name}": what for name, what in versions().items()},
    }


def _same(path: Path, plan: Plan) -> ScanResult | None:
    """What is known of a volume that is this config's; InputError if it is another's."""
    if not path.exists():
        return None
    config = plan.config
    try:
        with Volume(path) as volume:
            if volume.text("config_sha256") == config.sha256 and volume.text(
                "bicycle_parameters"
            ) == parameters_text(config.machine):
                return ScanResult(
                    path, False, plan.points, int(volume.file.attrs["stable_points"]), Agreement()
                )
            other = _differences(volume, config)
    except InputError as error:
        raise InputError(
            f"{path} exists, and {error.problem}", key=("output",), hint="--force replaces it"
        ) from None
    raise InputError(
        f"{path} exists, and was made from another config ({other})",
        key=("output",),
        hint="choose another output, or replace it with --force",
    )


def _differences(volume: Volume, config: ScanConfig) -> str:
    """In which keys the volume's config differs from another, in words."""
    there, here = (
        dict(_leaves(yamltext.parse(text, "config").data)) for text in (volume.text("config"), config.text)
    )
    keys = [key for key in there | here if there.get(key) != here.get(key)]
    if not keys:
        same = volume.text("bicycle_parameters") == parameters_text(config.machine)
        return "only its comments or layout differ" if same else "the bicycle's parameters differ"
    if {key.partition("[")[0] for key in keys} <= {"slices", "expect"}:
        return f"only {', '.join(keys)}: 'bikestab slice' draws any plane"
    words = [f"{key}: {there.get(key, 'none')} there, {here.get(key, 'none')} here" for key in keys[:3]]
    return "; ".join([*words, *(["..."] if len(keys) > 3 else [])])


def _leaves(node: Any, key: tuple[str | int, ...] = ()) -> Iterator[tuple[str, Any]]:
    if isinstance(node, (dict, list)) and node:
        for name, value in node.items() if isinstance(node, dict) else enumerate(node):
            yield from _leaves(value, (*key, name if isinstance(name, int) else str(name)))
    else:
        yield dotted(key), node


def _unfinished(path: Path, tiles: Path, error: OSError) -> ScanError:
    if isinstance(error, FileNotFoundError):
        return removed(tiles)
    problem = "the disk is full" if error.errno in NO_SPACE else " ".join(str(error).split())[:200]
    return ScanError(f"{path}: {problem}\n{KEPT if tiles.exists() else 'no part of it was finished'}")
