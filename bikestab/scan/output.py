"""A scan's output folder: whose is what is in it, how it differs, and whether the volume has room there."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from bikestab.config.scanconfig import ScanConfig
from bikestab.config.variation import ensemble_in
from bikestab.errors import KEPT, NOT_KEPT, InputError, ScanError, dotted
from bikestab.fields import FIELDS, GRADIENTS, gradient_names
from bikestab.files import NO_SPACE, beside, linked
from bikestab.identity import digest
from bikestab.model import Floats
from bikestab.scan.labels import texts
from bikestab.scan.plan import Plan
from bikestab.scan.spool import removed
from bikestab.units import shown
from bikestab.volume import Volume

MOST_VALUES = 4_000_000  # of an axis
_COLUMN_BYTES = 100  # in the file, of the intervals and sheets of one (λ, σ)
_MOST_TOLD = 3  # differences


def volume_path(config: ScanConfig) -> Path:
    """Where the scan's volume goes."""
    return Path(config.output) / "volume.h5"


def tiles_path(config: ScanConfig) -> Path:
    """Where its finished tiles are kept until then."""
    return Path(config.output) / "volume.h5.tiles"


def make_folder(config: ScanConfig) -> None:
    """Make the output folder, unless it is there. Raises InputError, or ScanError where the disk is full."""
    path = volume_path(config)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        if error.errno in NO_SPACE:
            raise unfinished(config, error) from None
        problem = f"{config.output} cannot be made ({error.strerror})"
        is_file = "it is a file, and no folder: " if isinstance(error, FileExistsError) else ""
        raise InputError(problem, key=("output",), hint=f"{is_file}choose another folder") from None
    if path.exists() and not path.is_file():
        raise InputError(f"{path} is no file", key=("output",), hint="move it away, or choose another output")


def check_size(config: ScanConfig) -> None:
    """Raise InputError if an axis is too long, or the grid asks for more than the disk has."""
    plan, shape = Plan(config), config.grid.shape
    largest = config.grid.key(config.grid.names[int(np.argmax(shape))])
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
    usage = shutil.disk_usage(folder)
    if not usage.total:  # no disk, such as /proc: what cannot be made there is told of when it is
        return
    room = usage.free
    for old in (volume_path(config), tiles_path(config)):  # what an earlier run has of it
        with suppress(OSError):
            room += old.stat().st_size
    if needed > room:
        size = " × ".join(str(n) for n in plan.shape)
        raise InputError(
            f"the grid {size} needs {_size(needed)} of disk, and {folder} has {_size(room)}",
            key=key,
            hint="make room, choose another output, or take fewer values or fields",
        )


def _size(number: float) -> str:
    """Bytes in the unit in which they are at least one."""
    for unit, name in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if number >= unit:
            return f"{number / unit:.4g} {name}"
    return f"{number:.4g} B"


def own_volume(plan: Plan) -> int | None:
    """The number of stable points of the volume that is there; None where there is none.

    It gets the config's texts if it has others. Raises InputError where it is another scan's, or no volume.
    """
    path, config = volume_path(plan.config), plan.config
    if not path.exists():
        return None
    try:
        with Volume(path) as volume:
            if volume.text("config_sha256") != config.sha256 and not _written_alike(volume, plan):
                raise InputError(
                    f"{path} exists, and was made from another config ({_told(volume, plan)})",
                    key=("output",),
                    hint="choose another output, or replace it with --force",
                )
            stable_points = int(volume.file.attrs["stable_points"])
            other = {name: text for name, text in texts(config).items() if volume.text(name) != text}
    except InputError as error:
        if error.key == ("output",):
            raise
        problem = f"{path} exists, and {' '.join([dotted(error.key), error.problem]).strip()}"
        raise InputError(problem, key=("output",), hint="--force replaces it") from None
    if other:
        _replace_texts(path, other)
    return stable_points


def unfinished(config: ScanConfig, error: OSError) -> ScanError:
    """What to raise where the disk failed in the middle of a scan."""
    tiles = tiles_path(config)
    if isinstance(error, FileNotFoundError):
        return removed(tiles)
    problem = "the disk is full" if error.errno in NO_SPACE else " ".join(str(error).split())[:200]
    kept = KEPT if tiles.exists() else NOT_KEPT
    return ScanError(f"{volume_path(config)}: {problem}\n{kept}")


def _written_alike(volume: Volume, plan: Plan) -> bool:
    """Whether it is of a build whose identity was the hash of the text, and means the same."""
    text = volume.text("config").encode()
    return volume.text("config_sha256") == hashlib.sha256(text).hexdigest() and not any(
        _differences(volume, plan)
    )


def _replace_texts(path: Path, other: dict[str, str]) -> None:
    """Put other texts into a complete volume. It is copied: readers may have it open, and a kill may come."""
    path = linked(path)
    copy = path.with_name(f"{path.name}.{os.urandom(8).hex()}.partial")
    try:
        with beside(path, copy):
            shutil.copyfile(path, copy)
            with h5py.File(copy, "r+", track_order=True) as file:
                for name, text in other.items():
                    file.attrs.modify(name, text)
    except OSError as error:
        if error.errno in NO_SPACE:
            raise ScanError(
                f"{path}: the disk is full\nthe volume is as it was, with its own texts"
            ) from None
        problem = f"{path} cannot be given this config's texts ({error.strerror or error})"
        raise InputError(problem, key=("output",), hint="choose another output") from None


def _told(volume: Volume, plan: Plan) -> str:
    """In what the volume's config differs from another, in words."""
    words = list(_differences(volume, plan)) or ["what its samples are drawn around differs"]
    return "; ".join([*words[:_MOST_TOLD], *(["..."] if len(words) > _MOST_TOLD else [])])


def _differences(volume: Volume, plan: Plan) -> Iterator[str]:
    """What differs in a volume from the one that a plan would give, by its content."""
    config = plan.config
    pairs: dict[str, tuple[Any, Any]] = {"model": (volume.model, config.model)}
    pairs["axes"] = (" × ".join(volume.axes), " × ".join(config.grid.names))
    there, here = json.loads(volume.text("bicycle_parameters")), config.family(None).kept
    machine = config.machine
    parts: list[str] = []  # a volume that keeps two parts does not say of which bodies they were
    if machine.bodies is not None and not here.keys() >= machine.bodies.keys():
        parts = [name for name in here if name not in ("g", "delta") and there.get(name) != here[name]]
    if parts:
        old, new = _short(there.get(parts[0])), _short(here[parts[0]])
        yield f"the bicycle {machine.name} differs: of its two parts {parts[0]} is {old} there, {new} here"
    pairs |= {name: (there.get(name), value) for name, value in here.items() if name not in parts}
    slopes = any(name in volume.file for name in gradient_names(config.grid.names))
    asked = [*plan.fields, *([GRADIENTS] if GRADIENTS in config.fields else [])]
    pairs["fields"] = (" ".join([*volume.fields, *([GRADIENTS] if slopes else [])]), " ".join(asked))
    axes = {axis.name: axis.values for axis in config.axes}
    there = any("kernel" in volume.file[name].attrs for name in volume.fields)
    pairs["fast"] = (str(there).lower(), str(config.compiled).lower())
    pairs["sweep"] = (" × ".join(volume.swept) or None, " × ".join(axes) or None)
    for name, (old, new) in pairs.items():
        if old != new:
            yield f"{name}: {_shown(old)} there, {_shown(new)} here"
    grid = {
        f"grid.{name}": (volume.axis(name), config.grid.values(name))
        for name in config.grid.names
        if name in volume.axes
    }
    both = {f"sweep.{name}": (volume.swept[name], axes[name]) for name in axes if name in volume.swept}
    for name, (values, others) in (grid | both).items():
        if not np.array_equal(values, others):
            yield f"{name}: {_range(values)} there, {_range(others)} here"
    if axes and list(axes) == list(volume.swept):
        machines = config.kept[1]
        if not np.array_equal(volume.file["machine"][()].ravel(), machines.ravel(), equal_nan=True):
            yield "the machines of the sweep differ"
    if _ensemble(volume) != (config.ensemble and digest(config.ensemble.meaning)):
        yield f"ensemble: {volume.samples or 'no'} samples there, other ones here"


def _ensemble(volume: Volume) -> str | None:
    """What the volume's ensemble means."""
    if not volume.samples:
        return None
    found = ensemble_in(volume.text("config"))
    return digest(found.meaning) if found else ""


def _shown(value: object) -> str:
    return "none" if value is None else f"{value:.17g}" if isinstance(value, float) else str(value)


def _short(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else _shown(value)


def _range(values: Floats) -> str:
    return f"{values[0]:g} ... {values[-1]:g} in {len(values)} values"
