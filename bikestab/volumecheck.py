"""A volume that others may have made → whether it is a whole one: every object of it, checked once.

What is wrong is told with the object's name. Values of fields are checked where they are read (``layout``).
"""

from __future__ import annotations

import hashlib
import json
import string
from collections.abc import Mapping
from dataclasses import MISSING
from itertools import product
from math import inf, prod
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from bikestab.bicycle import PAPER, parameters
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.fields import AXES, COORDINATES, FIELDS, GRADIENTS, Axes, gradient_names
from bikestab.gains import GAINS
from bikestab.hdf5 import check_links, check_whole, dataset, number_of, open_file, reading, text_of
from bikestab.identity import identity
from bikestab.layout import (
    BOUNDS,
    MOST_INTERVALS,
    TEXTS,
    bicycle_of,
    cell_axis,
    expected,
    grid_axes,
    machine_names,
    sweep_names,
)
from bikestab.limits import MOST, check_speed
from bikestab.model import Floats
from bikestab.notation import MEIJAARD, OPTIONAL
from bikestab.rider import RIDER

_BRACKETS = 20  # of a bicycle's numbers, which need two


def check_volume(path: Path) -> None:
    """Raise InputError, which names the object, unless a file is a whole volume."""
    with open_file(path) as file:
        with reading():
            if "config_sha256" not in file.attrs or "V" not in file:
                hint = "a volume is volume.h5 in the folder that a scan names as its output"
                raise InputError("is an HDF5 file, but no volume of bikestab", hint=hint)
            if "complete" not in file.attrs or not number_of(file, "complete", 0, 1):
                raise InputError("is incomplete", hint="'bikestab scan CONFIG --force' writes it again")
        check_links(file)
        texts = {name: text_of(file, name) for name in TEXTS}
        if texts["model"] not in ("refined", "unrefined"):
            raise InputError(f"the attribute 'model' is {texts['model'][:40]!r}")
        axes = grid_axes(file)
        swept = _sweep(file)
        grid: dict[str, Floats] = {
            name: _coordinate(file, name, COORDINATES.get(name, ("",))[0]) for name in axes
        }
        if {*swept} & {*axes}:
            raise InputError("has an axis of the grid", key=("machine",))
        numbers = bicycle_numbers(texts["bicycle_parameters"])
        _check_grid(grid, numbers)
        lengths = {name: len(values) for name, values in (swept | grid).items()}
        _check_datasets(file, lengths, list(swept), axes)
        _check_certified(file, grid, bool(swept))
        _check_numbers(file, prod(lengths.values()))
        _check_identity(file, texts, numbers, swept, grid)


def _sweep(file: h5py.File) -> dict[str, Floats]:
    """The values of the sweep's axes by their names."""
    with reading("machine"):
        names = sweep_names(file)
    known = {**PAPER, **MEIJAARD, **RIDER, **GAINS}
    for name in names:
        if name not in known:
            raise InputError(f"has an axis {name[:40]!r}, which is no parameter", key=("machine",))
    if len(set(names)) < len(names):
        raise InputError("has the same axis twice", key=("machine",))
    return {name: _coordinate(file, name) for name in names}


def _coordinate(file: h5py.File, name: str, unit: str = "") -> Floats:
    data = dataset(file, name, np.float64)
    with reading(name):
        values = data[()]
        there = data.attrs.get("units", b"")
    there = there.decode("utf-8", "replace") if isinstance(there, bytes) else str(there)
    if unit and there != unit:
        raise InputError(f"is in {there[:40]!r}, not in {unit!r}", key=(name,))
    if not len(values) or not np.all(np.isfinite(values)):
        raise InputError("is empty, or has values that are not finite", key=(name,))
    if not np.all(np.diff(values) > 0):
        raise InputError("has values that do not increase", key=(name,))
    return values


def _check_grid(grid: dict[str, Floats], numbers: Mapping[str, Any]) -> None:
    x, y, V = grid
    family = Family(bicycle_of(numbers), x=x, y=y)
    for corner in product(*(grid[name][[0, -1]].tolist() for name in (x, y))):
        family.check(*corner)
    for value in (grid[V][0], grid[V][-1]):
        check_speed(float(value), (V,))


def _check_datasets(file: h5py.File, lengths: dict[str, int], lead: list[str], grid: Axes) -> None:
    with reading():
        fields = [name for name in FIELDS if name in file]
        ensemble = "ensemble_samples" in file.attrs
        bounds = any(name in file for name in BOUNDS)
        gradients = any(name in file for name in gradient_names(grid))
    if not fields:
        raise InputError("has no field")
    for name in ("interval", "root", *(("parameter",) if lead else ())):
        lengths[name] = _counter(file, name)
    if lengths["interval"] > MOST_INTERVALS:
        raise InputError(f"is longer than {MOST_INTERVALS}", key=("interval",))
    if ensemble:
        lengths["quantile"] = len(_coordinate(file, "quantile"))
    if ensemble != ("probability" in fields):
        raise InputError("is there without an ensemble, or the reverse", key=("probability",))
    with reading("boundary"):
        if not isinstance(file.get("boundary"), h5py.Group):
            raise InputError("is no group", key=("boundary",))
    for name, axes, dtype in expected(fields, ensemble, bounds, grid, gradients):
        data = dataset(file, name, dtype, tuple(lengths[axis] for axis in (*lead, *axes)))
        if name in fields:
            with reading(name):
                check_whole(data)
    if lead:
        shape = tuple(lengths[axis] for axis in (*lead, "parameter"))
        _check_machines(dataset(file, "machine", np.float64, shape))


def _check_certified(file: h5py.File, grid: dict[str, Floats], sweep: bool) -> None:
    with reading("certified"):
        if "certified" not in file:
            return
        if sweep or (*grid,) != AXES:
            raise InputError("is there for a sweep, or for other axes than lam, sigma and V")
    for name, values in grid.items():
        edges = values if len(values) > 1 else np.repeat(values, 2)
        if not np.array_equal(_coordinate(file, cell_axis(name)), 0.5 * (edges[:-1] + edges[1:])):
            raise InputError(f"has not the middles between values of {name}", key=(cell_axis(name),))
    data = dataset(file, "certified", np.uint8, tuple(max(1, len(x) - 1) for x in grid.values()))
    with reading("certified"):
        check_whole(data)


def _counter(file: h5py.File, name: str) -> int:
    data = dataset(file, name, np.int32)
    with reading(name):
        values = data[()]
    if not len(values) or not np.array_equal(values, np.arange(1, len(values) + 1)):
        raise InputError("has not the values 1, 2, ...", key=(name,))
    return len(values)


def _check_machines(data: h5py.Dataset) -> None:
    with reading("machine"):
        names = machine_names(data)
    _check_names(names, "machine")
    if len(names) != data.shape[-1]:
        raise InputError(f"has {data.shape[-1]} parameters, but {len(names)} names", key=("machine",))


def _check_names(names: list[str], where: str) -> None:
    known: dict[str, bool] = {p.name: p.default is MISSING for p in parameters()}  # and whether it is needed
    if "w" in names:
        known = {name: name not in OPTIONAL and name not in RIDER for name in (*MEIJAARD, *RIDER)}
    known |= dict.fromkeys(GAINS, False)
    for name in names:
        if name not in known:
            raise InputError(f"{name[:40]!r} is no parameter", key=(where,))
    for name, needed in known.items():
        if needed and name not in names:
            raise InputError(f"has no {name}", key=(where,))


def _check_numbers(file: h5py.File, points: int) -> None:
    with reading():
        number_of(file, "stable_points", 0, points)
        if "ensemble_samples" in file.attrs:
            number_of(file, "ensemble_samples", 1, MOST)
        number_of(file["boundary"], "largest_difference", 0, inf)
        if "largest_bracketed_difference" in file["boundary"].attrs:
            number_of(file["boundary"], "largest_bracketed_difference", 0, inf)


def bicycle_numbers(text: str) -> dict[str, Any]:
    """The parameters in ``bicycle_parameters``; raises InputError unless they are those of a bicycle."""
    key = ("bicycle_parameters",)
    if text.count("[") + text.count("{") > _BRACKETS:  # which may take all the room for recursion
        raise InputError("is no JSON of numbers alone", key=key)
    try:
        numbers = json.loads(text)
    except (ValueError, RecursionError):
        raise InputError("is no JSON", key=key) from None
    if not isinstance(numbers, dict):
        raise InputError("is no JSON object", key=key)
    _check_names(list(numbers), key[0])
    for name, value in numbers.items():
        if not isinstance(value, (int, float)) and not (value is None and name in ("lam", "sigma")):
            raise InputError(f"{name} is no number", key=key)
    try:
        bicycle_of(numbers)
    except InputError as error:
        raise error.at(under=key) from None
    return numbers


def _check_identity(
    file: h5py.File, texts: dict[str, str], numbers: dict[str, Any], swept: dict[str, Floats],
    grid: dict[str, Floats],
) -> None:  # fmt: skip
    """Raise InputError where ``config_sha256`` is not of what is in the file.

    An earlier build's is a hash of the config's text. What is drawn at random stands in that text alone.
    """
    given = texts["config_sha256"]
    if len(given) != 64 or set(given) - set(string.hexdigits.lower()):
        raise InputError("the attribute 'config_sha256' is no SHA-256")
    if "ensemble_samples" in file.attrs or given == hashlib.sha256(texts["config"].encode()).hexdigest():
        return
    with reading("machine" if swept else "bicycle_parameters"):
        machines = file["machine"][()] if swept else np.array([list(numbers.values())], float)
    fields = {FIELDS[name].asked for name in FIELDS if name in file}
    rows = machines.reshape(-1, machines.shape[-1])
    if gradient_names((*grid,))[0] in file:
        fields.add(GRADIENTS)
    named = () if (*grid,) == AXES else (*list(grid)[:2], *numbers)
    fast = "growth_rate" in file and "kernel" in file["growth_rate"].attrs
    if given != identity(texts["model"], rows, [*grid.values()], fields, swept, None, named, fast=fast):
        problem = "the attribute 'config_sha256' is of another scan than the axes, parameters and fields are"
        raise InputError(problem)
