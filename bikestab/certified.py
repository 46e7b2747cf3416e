"""A volume and a proof of the cells between its points → the volume with the field ``certified``."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from itertools import product
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.certify.box import box_of
from bikestab.certify.search import UNDECIDED
from bikestab.errors import InputError
from bikestab.fields import AXES, COORDINATES
from bikestab.files import written
from bikestab.layout import CERTIFIED, cell_axis
from bikestab.letters import Model
from bikestab.model import Floats
from bikestab.proving import prove_in_parts
from bikestab.scan.labels import describe, flags
from bikestab.scan.sink import Sink
from bikestab.volume import Volume

_CHUNK = 64  # cells along each axis


def add_certified(
    path: Path, bicycle: Bicycle, model: Model, progress: Callable[[float], None] = lambda share: None,
    jobs: int | None = None,
) -> int:  # fmt: skip
    """Prove the cells of a volume and write what they are into it, unless that is there.

    ``jobs`` processes prove; what is finished is kept beside it until then, in a file that ends in .proofs.
    Returns how many cells stay undecided because ``stable``, which doubles rounded, says otherwise at their
    corners. Raises InputError for volumes of sweeps and of other axes than λ and σ.
    """
    with Volume(path) as volume:
        if "certified" in volume.file:
            return 0
        if volume.swept or volume.axes != AXES:
            hint = "leave out --certify, or the sweep"
            raise InputError("a proof is of one machine, over lam and sigma", place=str(path), hint=hint)
        axes = [volume.axis(name) for name in AXES]
        lam, sigma, V = map(edges_of, axes)
        box = box_of(bicycle, lam, sigma, V, model, {})
        keep = path.with_name(path.name + ".proofs")
        cells = prove_in_parts(box, jobs=jobs, keep=keep, progress=progress).cells
        denied = 0
        if "stable" in volume.fields:
            denied_cells = contradicted(cells, volume.read("stable"))
            cells, denied = np.where(denied_cells, np.uint8(UNDECIDED), cells), int(denied_cells.sum())
    with written(path) as part:
        shutil.copyfile(path, part)
        with Sink(part, "r+") as sink, sink.uninterrupted():
            with h5py.File(sink, "r+") as file:
                _write(file, axes, cells)
            sink.check()
            os.fsync(sink.fileno())
    return denied


def edges_of(values: Floats) -> Floats:
    """The ends of the cells between values; of one value a cell without width."""
    return values if len(values) > 1 else np.repeat(values, 2)


def contradicted(cells: NDArray[np.uint8], stable: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Which proved cells have a corner at which ``stable`` says otherwise."""
    wrong = np.zeros(cells.shape, bool)
    expected = np.array([2, 1, 0])[cells]  # 2: anything
    ends = [(0, min(1, n - 1)) for n in stable.shape]
    for corner in product(*ends):
        at = tuple(slice(i, i + n) for i, n in zip(corner, cells.shape, strict=True))
        wrong |= (expected < 2) & (stable[at] != expected)
    return wrong


def _write(file: h5py.File, axes: list[Floats], cells: NDArray[np.uint8]) -> None:
    for name, values in zip(AXES, axes, strict=True):
        edges = edges_of(values)
        scale = file.create_dataset(cell_axis(name), data=0.5 * (edges[:-1] + edges[1:]), track_order=True)
        scale.make_scale(cell_axis(name))
        describe(scale, COORDINATES[name][0], f"middles of the cells between values of {name}")
    chunk = tuple(min(n, _CHUNK) for n in cells.shape)
    data = file.create_dataset(
        "certified", data=cells, chunks=chunk, compression="gzip", compression_opts=1, track_order=True
    )
    describe(data, "1", "what is proved of every point between neighbouring points of the grid")
    flags(data, CERTIFIED)
    for i, name in enumerate(AXES):
        data.dims[i].attach_scale(file[cell_axis(name)])
