"""Finished tiles → the HDF5 file: plain HDF5 that is also netCDF-4 (xarray, MATLAB) and VTKHDF (ParaView).

docs/format.md describes it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import product
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from bikestab.fields import FIELDS, GRADIENTS, Field, coordinates, gradient_names
from bikestab.files import beside, linked
from bikestab.model import Floats
from bikestab.routh import CONDITIONS
from bikestab.scan.agreement import Agreement
from bikestab.scan.chunks import packed, places
from bikestab.scan.labels import MARGINAL, add_vtk_view, describe, file_attributes, flags, masks, words
from bikestab.scan.linking import widened
from bikestab.scan.plan import Plan
from bikestab.scan.sheets import Sheets
from bikestab.scan.sink import Sink, empty_file
from bikestab.speeds import KINDS, Intervals
from bikestab.volume import uniform


@contextmanager
def new_volume(path: Path, plan: Plan) -> Iterator[VolumeWriter]:
    """Write a volume under a temporary name; it gets its own name when the block ends without an error.

    Raises OSError where it cannot be written. Ctrl-C takes effect between two tiles.
    """
    path = linked(path)
    partial = path.with_name(path.name + ".partial")
    partial.unlink(missing_ok=True)
    with beside(path, partial), Sink(partial, "x+") as sink, sink.uninterrupted():
        with empty_file(sink) as file:
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
        self._grid = plan.config.grid.names
        self._lead = [axis.name for axis in plan.config.axes]
        self._data: dict[str, h5py.Dataset] = {}  # h5py takes long to find them by name
        file.attrs.update(file_attributes(plan.config))
        for swept in plan.config.axes:
            self._scale(swept.name, swept.values, swept.unit, swept.meaning)
        if self._lead:
            self._machines()
        for axis, (unit, meaning) in coordinates(plan.config.family()).items():
            self._scale(axis, plan.config.grid.values(axis), unit, meaning)
        for name in plan.fields:
            self._field(FIELDS[name])

    def _machines(self) -> None:
        """The parameters of every machine of the sweep, which the axes alone need not tell."""
        names, rows = self.plan.config.kept
        values = rows.reshape(*self.plan.lead, -1)
        self._counter("parameter", values.shape[-1], "number of the machine's parameter")
        data = self.file.create_dataset("machine", data=values, track_order=True)
        for i, axis in enumerate([*self._lead, "parameter"]):
            data.dims[i].attach_scale(self.file[axis])
        describe(data, "", "parameters of each machine in SI units, in the order of the attribute 'names'")
        data.attrs["names"] = words(tuple(names))

    def _field(self, field: Field) -> None:
        data = self._create(field.name, self._grid, field.dtype, self.plan.chunk, field.unit, field.meaning)
        if field.name in ("growth_rate", "probability") and self.plan.config.compiled:
            data.attrs["kernel"] = np.bytes_("compiled")
        if field.flags:
            flags(data, field.flags)
        if field.masks:
            masks(data, field.masks)

    def write_fields(self, place: tuple[int, ...], shape: tuple[int, ...], chunks: list[memoryview]) -> None:
        """Put a tile's chunks into the fields; ``place`` is its first index, ``shape`` its own."""
        ids = {name: self._data[name].id for name in self.plan.fields}
        where = [
            tuple(i + k for i, k in zip(place, offset, strict=True))
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
            flags(self._column(name, "interval", np.uint8, "1", text), KINDS)
        for name in ("V1", "V2"):
            text = f"bound of the error of {name}: the true end for exactly these inputs is within it"
            self._column(f"{name}_error", "interval", np.float64, "m s-1", text)
        if GRADIENTS in self.plan.config.fields:
            self._create_gradients()
        text = "what rounding leaves undecided of the number of intervals and of the kinds of their ends"
        flags(self._create("marginal", self._grid[:2], np.uint8, self.plan.tile[:-1], "1", text), MARGINAL)
        self._counter("root", max(1, sheets), "number of the sheet of roots")
        self.file.create_group("boundary", track_order=True)
        for name in CONDITIONS:
            text = f"every speed at which {name} changes sign, sheet by sheet"
            self._column(f"boundary/{name}", "root", np.float64, "m s-1", text)
            text = f"whether {name} = 0 is an edge of stability there"
            flags(self._column(f"boundary/{name}_edge", "root", np.uint8, "1", text), ("no_edge", "edge"))
        if self.plan.config.ensemble:
            self._create_spread(self.plan.config.ensemble.quantiles)

    def _create_gradients(self) -> None:
        parameters = [*self.plan.config.family().parameters] * 2
        for name, parameter in zip(gradient_names(self._grid), parameters, strict=True):
            unit = "m s-1" if parameter.unit == "1" else f"m s-1 / ({parameter.unit})"
            text = f"slope of {name[1:3]} of each stable interval by {parameter.name}"
            self._column(name, "interval", np.float64, unit, text)

    def _create_spread(self, quantiles: list[float]) -> None:
        self._scale("quantile", np.array(quantiles), "1", "share of the machines with a stable speed")
        for name, text in (
            ("probability_somewhere", "share of the ensemble's machines that have a stable speed"),
            ("probability_unbounded", "share of them that are stable without an upper limit"),
        ):
            self._create(name, self._grid[:2], np.float64, self.plan.tile[:-1], "1", text)
        for name in ("V1", "V2"):
            end = "lower" if name == "V1" else "upper"
            text = f"quantiles of the {end} end of the widest stable interval, of machines that have one"
            self._column(f"{name}_quantiles", "quantile", np.float64, "m s-1", text)

    def write_columns(
        self,
        place: tuple[int, ...],
        intervals: Intervals,
        surfaces: dict[str, Sheets],
        spread: Floats,
        gradients: Floats,
    ) -> None:
        """Put a tile's intervals, boundary surfaces and, for an ensemble, their spread into the file."""
        for name, values in intervals.arrays().items():
            if name != "marginal":
                self._write_column(name, place, values)
        self._write_designs("marginal", place, intervals.marginal[..., 0])
        for name, (V, edge) in surfaces.items():
            self._write_column(f"boundary/{name}", place, V)
            self._write_column(f"boundary/{name}_edge", place, edge)
        for k, name in enumerate(gradient_names(self._grid) if gradients.shape[-1] else ()):
            self._write_column(name, place, np.ascontiguousarray(gradients[..., k]))
        if spread.shape[-1]:
            V1, V2 = np.split(spread[..., 2:], 2, axis=-1)
            self._write_column("V1_quantiles", place, V1)
            self._write_column("V2_quantiles", place, V2)
            for k, name in enumerate(("probability_somewhere", "probability_unbounded")):
                self._write_designs(name, place, spread[..., k])
        self._sink.check()

    def finish(self, stable_points: int, agreement: Agreement, bracketed: Agreement) -> None:
        """Note the totals, link the fields for ParaView and mark the file complete."""
        group = self.file["boundary"]
        group.attrs["largest_difference"] = agreement.largest
        group.attrs["largest_difference_units"] = np.bytes_("m s-1")
        group.attrs["bracketed_zeros"] = bracketed.roots
        group.attrs["largest_bracketed_difference"] = bracketed.largest
        group.attrs["largest_bracketed_difference_units"] = np.bytes_("m s-1")
        if not self._lead and all(uniform(self.file[name][()]) for name in self._grid):
            add_vtk_view(self.file, self.plan.fields, self._grid)
        self.file.attrs["stable_points"] = stable_points
        self.file.attrs["complete"] = np.int32(1)

    def _create(
        self, name: str, axes: tuple[str, ...], dtype: type, chunk: tuple[int, ...], unit: str, text: str
    ) -> h5py.Dataset:
        axes = (*self._lead, *axes)
        float_ = np.issubdtype(dtype, np.floating)
        data = self.file.create_dataset(
            name, tuple(len(self.file[axis]) for axis in axes), dtype, chunks=chunk,
            compression="gzip", compression_opts=1, shuffle=np.dtype(dtype).itemsize > 1, track_order=True,
            fillvalue=np.nan if float_ else None,
        )  # fmt: skip
        self._data[name] = data
        describe(data, unit, text)
        for i, axis in enumerate(axes):
            data.dims[i].attach_scale(self.file[axis])
        return data

    def _column(self, name: str, last: str, dtype: type, unit: str, text: str) -> h5py.Dataset:
        chunk = (*self.plan.tile[:-1], len(self.file[last]))
        return self._create(name, (*self._grid[:2], last), dtype, chunk, unit, text)

    def _write_column(self, name: str, place: tuple[int, ...], values: NDArray) -> None:
        # one that holds nothing too: jsfive, pyfive and hidefix do not know chunks that are not there
        data, empty = self._data[name], np.nan if values.dtype == float else 0
        (chunk,) = packed(widened(values, data.shape[-1], empty), data.chunks)
        data.id.write_direct_chunk((*place[:-1], 0), chunk)

    def _write_designs(self, name: str, place: tuple[int, ...], values: NDArray) -> None:
        """What each (λ, σ) has one of."""
        (chunk,) = packed(values, self._data[name].chunks)
        self._data[name].id.write_direct_chunk(place[:-1], chunk)

    def _scale(self, name: str, values: NDArray, unit: str, text: str) -> None:
        data = self.file.create_dataset(name, data=values, track_order=True)
        data.make_scale(name)
        describe(data, unit, text)

    def _counter(self, name: str, length: int, text: str) -> None:
        self._scale(name, np.arange(1, length + 1, dtype=np.int32), "1", text)
