"""A grid → tiles → fields: evaluates a scan's config into its volume, in bounded memory."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.boundary import (
    AGREEMENT,
    Agreement,
    Brackets,
    agreement,
    refine,
    sign_changes,
)
from bikestab.config import AXES, ScanConfig
from bikestab.errors import InputError, ScanError
from bikestab.model import Floats, Model, characteristic_table
from bikestab.routh import CONDITIONS, conditions, violated
from bikestab.sheets import Roots, critical_roots, sheets
from bikestab.spectrum import growth_rate
from bikestab.speeds import Intervals, joined, stable_intervals
from bikestab.units import shown
from bikestab.volume import FIELDS, Volume, VolumeWriter, field_names, new_volume, parameters_text

COLUMNS, SPEEDS = 64, 256  # a tile: values of λ and of σ, and speeds; multiples of the file's chunks
_COLUMN_FILE = 400  # bytes in the file of the intervals and sheets of one (λ, σ)
_COLUMN_MEMORY = (
    800  # and in memory, where all are kept to the end of the run; with damping 700 were measured
)

R = TypeVar("R", Intervals, Roots)
Progress = Callable[[int], None]  # called with the number of points just finished


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


def run_scan(config: ScanConfig, *, force: bool = False, progress: Progress = lambda _: None) -> ScanResult:
    """Evaluate the config's grid and write its volume.

    A complete volume of the same config is left as it is. Raises InputError for an output that belongs to
    another config (unless ``force``), cannot be written, or would be too large, and ScanError where
    the disk is full or the refined boundaries and the exact speeds do not agree.
    """
    path = volume_path(config)
    points = int(np.prod(config.grid.shape, dtype=float))
    check_size(config)
    if path.exists() and not force and _is_same(path, config):
        with Volume(path) as volume:
            return ScanResult(path, False, points, int(volume.file.attrs["stable_points"]), Agreement())
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"{config.output} cannot be made ({error.strerror})",
            key=("output",),
            hint="choose another folder",
        ) from None
    problem = ""
    with _release_failures() as failures:
        try:
            with new_volume(path, config, failures) as writer:
                stable_points, found = _fill(writer, config, progress)
                writer.file.attrs["stable_points"] = stable_points
        except OSError as error:
            problem = " ".join(str(error).split())[:200]
    if problem:
        full = "No space left" in problem or "errno = 28" in problem
        raise ScanError(f"{path}: {'the disk is full' if full else problem}; nothing was left behind")
    return ScanResult(path, True, points, stable_points, found)


@contextmanager
def _release_failures() -> Iterator[list[object]]:
    """Collect what h5py cannot raise: a write that fails while it releases a part of the file.

    It tells of that in both hooks; an exception of ours goes through neither.
    """
    failures: list[object] = []
    hooks = sys.unraisablehook, sys.excepthook
    sys.unraisablehook, sys.excepthook = failures.append, lambda *event: failures.append(event)
    try:
        yield failures
    finally:
        sys.unraisablehook, sys.excepthook = hooks


def check_size(config: ScanConfig) -> None:
    """Raise InputError if the grid asks for more than the disk or the memory has."""
    shape = config.grid.shape
    largest = AXES[int(np.argmax(shape))]
    each = sum(np.dtype(FIELDS[name][0]).itemsize for name in field_names(config))
    file = each * float(np.prod(shape, dtype=float)) + _COLUMN_FILE * float(shape[0] * shape[1])
    memory = _COLUMN_MEMORY * float(shape[0] * shape[1]) + 8 * float(sum(shape)) + 3e8
    folder = Path(config.output).absolute()
    try:
        while not folder.exists():
            folder = folder.parent
    except OSError as error:  # a name that is too long, say
        problem = f"{shown(config.output)} is no folder name ({error.strerror})"
        raise InputError(problem, key=("output",)) from None
    for needed, there, what in (
        (file, shutil.disk_usage(folder).free, f"of disk uncompressed, and {folder} has"),
        (memory, os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"), "of memory, and this machine has"),
    ):
        if needed > there:
            size = " × ".join(str(n) for n in shape)
            axis = getattr(config.grid, largest)
            raise InputError(
                f"the grid {size} needs {needed / 1e9:.4g} GB {what} {there / 1e9:.4g} GB",
                key=("grid", largest, "num" if hasattr(axis, "num") else "values"),
                hint="take fewer values, or fewer fields",
            )


def evaluate(table: Floats, V: Floats, names: list[str]) -> dict[str, NDArray]:
    """The fields ``names`` (and always ``violated``) of a table (5, 4, cell) at the speeds V: (cell, V)."""
    out: dict[str, NDArray] = {}
    with np.errstate():  # restores the buffer's size, too
        np.setbufsize(16)  # numpy else copies the broadcast columns and speeds into its buffer, each time
        values = conditions(table[..., np.newaxis], V)
        out["violated"] = violated(values)
    for name in names:
        if name == "stable":
            out[name] = (out["violated"] == 0).view(np.uint8)
        elif name == "growth_rate":
            out[name] = growth_rate(table[..., np.newaxis], V).astype(np.float32)
        elif name in CONDITIONS:
            out[name] = getattr(values, name)
    return out


def columns(bicycle: Bicycle, lam: Floats, sigma: Floats, model: Model) -> tuple[Floats, Intervals]:
    """Table (5, 4, λ, σ) and stable intervals (λ, σ, interval) of every pair of λ and σ."""
    table = characteristic_table(bicycle, lam[:, np.newaxis], sigma, model=model)
    return table, stable_intervals(table)


def _fill(writer: VolumeWriter, config: ScanConfig, progress: Progress) -> tuple[int, Agreement]:
    lam, sigma, V = (config.grid.values(name) for name in AXES)
    _keep_heap()
    stable_points, found = 0, Agreement()
    intervals: list[list[Intervals]] = []
    critical: list[list[dict[str, Roots]]] = []
    for i in _steps(len(lam), COLUMNS):
        intervals.append([])
        critical.append([])
        for j in _steps(len(sigma), COLUMNS):
            table, inside = columns(config.machine, lam[i], sigma[j], config.model)
            brackets: list[dict[str, Brackets]] = []
            for mask, k in _tiles(writer, table, i, j, V, progress):
                stable_points += int(np.count_nonzero(mask[:, -(k.stop - k.start) :] == 0))
                first = k.stop - mask.shape[1]
                brackets.append(sign_changes(mask, V[first : k.stop]))
            roots = critical_roots(table)
            found = found.joined(_agreement(table, roots, brackets))
            intervals[-1].append(inside)
            critical[-1].append(roots)
    if found.largest == np.inf:
        raise ScanError(
            "the refined boundaries have a point that is no exact critical speed, which they should never "
            "have; please report this with the config"
        )
    if found.largest > AGREEMENT:
        raise ScanError(
            f"the refined boundaries differ from the exact critical speeds by {found.largest:.3g} m/s, "
            f"more than the {AGREEMENT:g} m/s that both should reach; please report this with the config"
        )
    whole = _joined(Intervals, intervals, (np.nan, np.nan, 0, 0))
    surfaces = {}
    for name in CONDITIONS:
        roots_of = [[tile.pop(name) for tile in row] for row in critical]
        surfaces[name] = sheets(name, _joined(Roots, roots_of, (np.nan, 0)), whole)
    writer.write_columns(whole, surfaces, found)
    return stable_points, found


def _tiles(
    writer: VolumeWriter, table: Floats, i: slice, j: slice, V: Floats, progress: Progress
) -> Iterator[tuple[NDArray[np.uint8], slice]]:
    """Evaluate and write a block of columns; yields each tile's mask (cell, V), with the speed before it."""
    n, m = table.shape[2:]
    before = np.empty((n * m, 0), np.uint8)
    for k in _steps(len(V), SPEEDS):
        rows = [evaluate(table[:, :, row], V[k], writer.names) for row in range(n)]  # a row fits the cache
        for name in writer.names:
            writer.write(name, (i, j, k), np.array([row[name] for row in rows]))
        mask = np.concatenate([row["violated"] for row in rows])
        yield np.concatenate([before, mask], axis=1), k
        before = mask[:, -1:]
        progress(mask.size)


def _agreement(table: Floats, roots: dict[str, Roots], brackets: list[dict[str, Brackets]]) -> Agreement:
    cells, found = table.reshape(5, 4, -1), Agreement()
    for name in CONDITIONS:
        merged = Brackets._make(map(np.concatenate, zip(*(b[name] for b in brackets), strict=True)))
        exact = roots[name].V.reshape(cells.shape[-1], -1).T
        found = found.joined(agreement(cells, name, refine(cells, name, merged), exact))
    return found


def _joined(kind: type[R], blocks: list[list[R]], empty: tuple[float, ...]) -> R:
    """Blocks (row, column) of named tuples of arrays as one, short last axes filled up with ``empty``."""
    fields = range(len(empty))
    return kind._make(joined([[block[f] for block in row] for row in blocks], empty[f]) for f in fields)


def _steps(length: int, step: int) -> list[slice]:
    return [slice(start, min(start + step, length)) for start in range(0, length, step)]


def _is_same(path: Path, config: ScanConfig) -> bool:
    """Whether the volume is this config's; InputError if it is another's."""
    try:
        with Volume(path) as volume:
            if volume.text("config_sha256") == config.sha256 and volume.text(
                "bicycle_parameters"
            ) == parameters_text(config.machine):
                return True
            title = volume.text("title")
    except InputError as error:
        raise InputError(
            f"{path} exists, and {error.problem}", key=("output",), hint="--force replaces it"
        ) from None
    raise InputError(
        f"{path} exists, and was made from another config ({title!r})",
        key=("output",),
        hint="choose another output, or replace it with --force",
    )


def _keep_heap() -> None:
    """Keep freed memory in the process: a tile's temporaries otherwise return to the system one by one.

    glibc raises its limits for that to the size of the largest mapped block freed so far.
    """
    np.empty(1 << 21)
