"""Finished tiles → the HDF5 file: plain HDF5 that is also netCDF-4 (xarray, MATLAB) and VTKHDF (ParaView).

docs/format.md describes it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import product
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from bikestab import __version__
from bikestab.fields import AXES, COORDINATES, FIELDS, Field
from bikestab.files import beside
from bikestab.model import Floats
from bikestab.routh import CONDITIONS
from bikestab.scanning.chunks import packed, places
from bikestab.scanning.crosscheck import Agreement
from bikestab.scanning.plan import Plan
from bikestab.scanning.sheets import Sheets
from bikestab.scanning.sink import Sink
from bikestab.speeds import KINDS, Intervals, widened
from bikestab.volume import parameters_text, uniform


@contextmanager
def new_volume(path: Path, plan: Plan) -> Iterator[VolumeWriter]:
    """Write a volume under a temporary name; it gets its own name when the block ends without an error.

    Raises OSError where it cannot be written. Ctrl-C takes effect between two tiles.
    """
    partial = path.with_name(path.name + ".partial")
    partial.unlink(missing_ok=True)
    with beside(path, partial), Sink(partial, "x+") as sink, sink.uninterrupted():
        with h5py.File(sink, "w", track_order=True) as file:
            yield VolumeWriter(file, plan, sink)
        sink.check()
        os.fsync(sink.fileno())
        sink.check()
    _sync(path.parent)


def _sync(folder: Path) -> None:
    """Let the new name be on disk before the tiles are deleted."""
    with suppress(OSError):  # not every system opens folders
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


class VolumeWriter:
    """Puts axes, fields and columns into an empty HDF5 file."""

    def __init__(self, file: h5py.File, plan: Plan, sink: Sink) -> None:
        self.file, self.plan, self._sink = file, plan, sink
        self._lead = [axis.name for axis in plan.config.axes]
        self._data: dict[str, h5py.Dataset] = {}  # h5py takes long to find them by name
        self._attributes()
        for swept in plan.config.axes:
            self._scale(swept.name, swept.values, swept.unit, swept.meaning)
        if self._lead:
            self._machines()
        for axis in AXES:
            self._scale(axis, plan.config.grid.values(axis), *COORDINATES[axis])
        for name in plan.fields:
            self._field(FIELDS[name])

    def _attributes(self) -> None:
        config = self.plan.config
        bicycle = config.machine
        attributes: dict[str, Any] = {
            "Conventions": np.bytes_("CF-1.11"),
            "title": config.title or f"{bicycle.name}: region of stable motion",
            "source": f"bikestab {__version__}",
            "references": bicycle.source,
            "bikestab_version": __version__,
            "bicycle": bicycle.name,
            "bicycle_parameters": parameters_text(bicycle),
            "warnings": "\n".join(config.warnings),
            "model": config.model,
            "config": config.text,
            "config_sha256": config.sha256,
            "complete": np.int32(0),
        }
        if config.ensemble:
            attributes["ensemble_samples"] = config.ensemble.samples
        for key, value in attributes.items():
            self.file.attrs[key] = value

    def _machines(self) -> None:
        """The parameters of every machine of the sweep, which the axes alone need not tell."""
        rows = [list(member.bicycle.numbers().values()) for member in self.plan.config.members]
        values = np.array(rows, float).reshape(*self.plan.lead, -1)  # NaN for None
        self._counter("parameter", values.shape[-1], "number of the machine's parameter")
        data = self.file.create_dataset("machine", data=values, track_order=True)
        for i, axis in enumerate([*self._lead, "parameter"]):
            data.dims[i].attach_scale(self.file[axis])
        _describe(data, "", "parameters of each machine in SI units, in the order of the attribute 'names'")
        data.attrs["names"] = _ascii(*self.plan.config.machine.numbers())

    def _field(self, field: Field) -> None:
        data = self._create(field.name, AXES, field.dtype, self.plan.chunk, field.unit, field.meaning)
        if field.flags:
            _flags(data, field.flags)
        if field.masks:
            data.attrs["flag_masks"] = np.array([1 << bit for bit in range(len(field.masks))], field.dtype)
            data.attrs["flag_meanings"] = _ascii(*field.masks)

    def write_fields(self, place: tuple[int, ...], shape: tuple[int, ...], chunks: list[memoryview]) -> None:
        """Put a tile's chunks into the fields; ``place`` is its first index, ``shape`` its own."""
        lead, first = place[:-3], place[-3:]
        ids = {name: self._data[name].id for name in self.plan.fields}
        where = [
            (*lead, *(i + k for i, k in zip(first, offset, strict=True)))
            for offset in places(shape, self.plan.chunk)
        ]
        for (name, offset), chunk in zip(product(self.plan.fields, where), chunks, strict=True):
            ids[name].write_direct_chunk(offset, chunk)
        self._sink.check()

    def create_columns(self, intervals: int, sheets: int) -> None:
        """Make room for what depends on (λ, σ) alone: so many intervals, and sheets of a condition."""
        self._counter("interval", max(1, intervals), "number of the stable interval")
        for name, text in (
            ("V1", "lower end of each stable speed interval"),
            ("V2", "upper end of each stable speed interval; inf = unbounded"),
        ):
            self._column(name, "interval", np.float64, "m s-1", text)
        for name in ("lower", "upper"):
            text = f"what happens at the {name} end of each stable interval"
            _flags(self._column(name, "interval", np.uint8, "1", text), KINDS)
        self._counter("root", max(1, sheets), "number of the sheet of roots")
        self.file.create_group("boundary", track_order=True)
        for name in CONDITIONS:
            text = f"every speed at which {name} changes sign, sheet by sheet"
            self._column(f"boundary/{name}", "root", np.float64, "m s-1", text)
            text = f"whether {name} = 0 is an edge of stability there"
            _flags(self._column(f"boundary/{name}_edge", "root", np.uint8, "1", text), ("no_edge", "edge"))
        if self.plan.config.ensemble:
            self._create_spread(self.plan.config.ensemble.quantiles)

    def _create_spread(self, quantiles: list[float]) -> None:
        self._scale("quantile", np.array(quantiles), "1", "share of the machines with a stable speed")
        for name, text in (
            ("probability_somewhere", "share of the ensemble's machines that have a stable speed"),
            ("probability_unbounded", "share of them that are stable without an upper limit"),
        ):
            self._create(name, ("lam", "sigma"), np.float64, self.plan.tile[:2], "1", text)
        for name in ("V1", "V2"):
            end = "lower" if name == "V1" else "upper"
            text = f"quantiles of the {end} end of the widest stable interval, of machines that have one"
            self._column(f"{name}_quantiles", "quantile", np.float64, "m s-1", text)

    def write_columns(
        self, place: tuple[int, ...], intervals: Intervals, surfaces: dict[str, Sheets], spread: Floats
    ) -> None:
        """Put a tile's intervals, boundary surfaces and, for an ensemble, their spread into the file."""
        for name, values in intervals._asdict().items():
            self._write_column(name, place, values)
        for name, (V, edge) in surfaces.items():
            self._write_column(f"boundary/{name}", place, V)
            self._write_column(f"boundary/{name}_edge", place, edge)
        if spread.shape[-1]:
            V1, V2 = np.split(spread[..., 2:], 2, axis=-1)
            self._write_column("V1_quantiles", place, V1)
            self._write_column("V2_quantiles", place, V2)
            for k, name in enumerate(("probability_somewhere", "probability_unbounded")):
                (chunk,) = packed(spread[..., k], self._data[name].chunks[-2:])
                self._data[name].id.write_direct_chunk(place[:-1], chunk)
        self._sink.check()

    def finish(self, stable_points: int, agreement: Agreement) -> None:
        """Note the totals, link the fields for ParaView and mark the file complete."""
        group = self.file["boundary"]
        group.attrs["largest_difference"] = agreement.largest
        group.attrs["largest_difference_units"] = np.bytes_("m s-1")
        if not self._lead and all(uniform(self.file[name][()]) for name in AXES):
            _vtk(self.file, self.plan.fields)
        self.file.attrs["stable_points"] = stable_points
        self.file.attrs["complete"] = np.int32(1)

    def _create(
        self, name: str, axes: tuple[str, ...], dtype: type, chunk: tuple[int, ...], unit: str, text: str
    ) -> h5py.Dataset:
        axes = (*self._lead, *axes)
        float_ = np.issubdtype(dtype, np.floating)
        data = self.file.create_dataset(
            name, tuple(len(self.file[axis]) for axis in axes), dtype, chunks=(1,) * len(self._lead) + chunk,
            compression="gzip", compression_opts=1, shuffle=np.dtype(dtype).itemsize > 1, track_order=True,
            fillvalue=np.nan if float_ else None,
        )  # fmt: skip
        self._data[name] = data
        _describe(data, unit, text)
        for i, axis in enumerate(axes):
            data.dims[i].attach_scale(self.file[axis])
        return data

    def _column(self, name: str, last: str, dtype: type, unit: str, text: str) -> h5py.Dataset:
        chunk = (*self.plan.tile[:2], len(self.file[last]))
        return self._create(name, ("lam", "sigma", last), dtype, chunk, unit, text)

    def _write_column(self, name: str, place: tuple[int, ...], values: NDArray) -> None:
        data, empty = self._data[name], np.nan if values.dtype == float else 0
        if np.all(np.isnan(values) if np.isnan(empty) else values == 0):
            return  # a chunk that is not there reads as the fill value
        (chunk,) = packed(widened(values, data.shape[-1], empty), data.chunks[-3:])
        data.id.write_direct_chunk((*place[:-1], 0), chunk)

    def _scale(self, name: str, values: NDArray, unit: str, text: str) -> None:
        data = self.file.create_dataset(name, data=values, track_order=True)
        data.make_scale(name)
        _describe(data, unit, text)

    def _counter(self, name: str, length: int, text: str) -> None:
        self._scale(name, np.arange(1, length + 1, dtype=np.int32), "1", text)


def _vtk(file: h5py.File, names: tuple[str, ...]) -> None:
    """ParaView's view of the same arrays: x = V, y = σ, z = λ."""
    group = file.create_group("VTKHDF", track_order=True)
    axes = [file[name][()] for name in reversed(AXES)]
    group.attrs["Version"] = np.array([1, 0])
    group.attrs["Type"] = np.bytes_("ImageData")
    group.attrs["WholeExtent"] = np.array([[0, len(axis) - 1] for axis in axes]).ravel()
    group.attrs["Origin"] = np.array([axis[0] for axis in axes])
    group.attrs["Spacing"] = np.array([(axis[-1] - axis[0]) / (len(axis) - 1) for axis in axes])
    group.attrs["Direction"] = np.eye(3).ravel()
    points = group.create_group("PointData", track_order=True)
    for name in names:
        points[name] = file[name]


def _describe(data: h5py.Dataset, unit: str, text: str) -> None:
    if unit:
        data.attrs["units"] = np.bytes_(_ascii_unit(unit))
    data.attrs["long_name"] = np.bytes_(text.encode("ascii", "replace"))


def _ascii_unit(unit: str) -> str:
    return unit.replace("²", "2").replace("kg m2/s", "kg m2 s-1").replace("m/s2", "m s-2")


def _flags(data: h5py.Dataset, meanings: tuple[str, ...]) -> None:
    data.attrs["flag_values"] = np.arange(len(meanings), dtype=data.dtype)
    data.attrs["flag_meanings"] = _ascii(*meanings)


def _ascii(*words: str) -> np.bytes_:
    return np.bytes_(" ".join(words))
