"""The HDF5 file: plain HDF5 that is also netCDF-4 (xarray, MATLAB, Panoply) and VTKHDF (ParaView).

docs/format.md describes it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Self

import h5py
import numpy as np
from numpy.typing import NDArray

from bikestab import __version__
from bikestab.bicycle import Bicycle
from bikestab.boundary import Agreement
from bikestab.config import AXES, Axis, ScanConfig
from bikestab.errors import InputError
from bikestab.model import Floats, Model
from bikestab.routh import CONDITIONS
from bikestab.sheets import Sheets
from bikestab.speeds import KINDS, Intervals

CHUNK = 32  # per axis: a slice across any axis reads one layer of chunks
FIELDS: dict[str, tuple[type[np.generic], str, str]] = {  # dtype, unit, meaning
    "stable": (np.uint8, "1", "rectilinear motion is asymptotically stable"),
    "violated": (np.uint8, "1", "conditions of stability that do not hold"),
    "growth_rate": (np.float32, "s-1", "largest real part of the eigenvalues"),
    **{name: (np.float64, "", f"left side of the condition {name} > 0") for name in CONDITIONS},
}
_AXIS_TEXT = {
    "lam": ("rad", "tilt of the steering axis from the vertical, top backwards"),
    "sigma": ("1", "trail divided by the wheelbase"),
    "V": ("m s-1", "forward speed"),
}


@contextmanager
def new_volume(path: Path, config: ScanConfig, failures: Sequence[object]) -> Iterator[VolumeWriter]:
    """Write a volume under a temporary name; it gets its own name when the block ends without an error.

    Raises InputError where nothing can be written; an OSError while writing goes to the caller, and
    so does a write that failed where h5py cannot raise: the caller collects those in ``failures``.
    """
    partial = path.with_name(path.name + ".partial")
    try:
        file = h5py.File(partial, "w", track_order=True)
    except OSError as error:
        problem = f"{partial} cannot be written ({error.strerror or error})"
        raise InputError(problem, key=("output",), hint="choose another folder") from None
    try:
        with file:
            writer = VolumeWriter(file, config)
            yield writer
            writer.finish(config)
        if failures:
            raise OSError("a part of the file could not be written")
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


class VolumeWriter:
    """Puts axes, fields and columns into an empty HDF5 file."""

    def __init__(self, file: h5py.File, config: ScanConfig) -> None:
        self.file, self.names = file, field_names(config)
        self._axes(config)
        shape = config.grid.shape
        chunks = tuple(min(n, CHUNK) for n in shape)
        for name in self.names:
            dtype, unit, text = FIELDS[name]
            data = self.file.create_dataset(
                name, shape, dtype, chunks=chunks, compression="gzip", compression_opts=1,
                shuffle=np.dtype(dtype).itemsize > 1, track_order=True,
            )  # fmt: skip
            self._describe(data, unit, text, AXES)
        if "stable" in self.names:
            _flags(self.file["stable"], ("unstable", "stable"))
        if "violated" in self.names:
            masks = np.array([1 << bit for bit in range(len(CONDITIONS))], np.uint8)
            self.file["violated"].attrs["flag_masks"] = masks
            self.file["violated"].attrs["flag_meanings"] = _ascii(
                *(f"{name}_not_positive" for name in CONDITIONS)
            )

    def _axes(self, config: ScanConfig) -> None:
        bicycle = config.machine
        attributes: dict[str, Any] = {
            "Conventions": np.bytes_("CF-1.11"),
            "title": config.title or f"{bicycle.name}: region of stable motion",
            "source": f"bikestab {__version__}",
            "references": bicycle.source,
            "bikestab_version": __version__,
            "bicycle": bicycle.name,
            "bicycle_parameters": parameters_text(bicycle),
            "warnings": "\n".join(bicycle.warnings),
            "model": config.model,
            "config": config.text,
            "config_sha256": config.sha256,
            "complete": np.int32(0),
        }
        for key, value in attributes.items():
            self.file.attrs[key] = value
        for name in AXES:
            unit, text = _AXIS_TEXT[name]
            data = self.file.create_dataset(name, data=config.grid.values(name), track_order=True)
            data.make_scale(name)
            self._describe(data, unit, text, ())

    def _describe(self, data: h5py.Dataset, unit: str, text: str, axes: tuple[str, ...]) -> None:
        if unit:
            data.attrs["units"] = np.bytes_(unit)
        data.attrs["long_name"] = np.bytes_(text)
        for i, axis in enumerate(axes):
            data.dims[i].attach_scale(self.file[axis])

    def write(self, name: str, where: tuple[slice, ...], values: NDArray[Any]) -> None:
        """Put one tile of a field into the file."""
        self.file[name][where] = values

    def write_columns(self, intervals: Intervals, surfaces: dict[str, Sheets], agreement: Agreement) -> None:
        """Write what depends on (λ, σ) alone: the intervals and the boundary surfaces."""
        self._counter("interval", intervals.V1.shape[-1], "number of the stable interval")
        for name, values, text in (
            ("V1", intervals.V1, "lower end of each stable speed interval"),
            ("V2", intervals.V2, "upper end of each stable speed interval; inf = unbounded"),
        ):
            data = self.file.create_dataset(
                name, data=values, fillvalue=np.nan, track_order=True, **_packed(values)
            )
            self._describe(data, "m s-1", text, ("lam", "sigma", "interval"))
        for name, kinds in (("lower", intervals.lower), ("upper", intervals.upper)):
            data = self.file.create_dataset(name, data=kinds, track_order=True, **_packed(kinds))
            self._describe(
                data,
                "1",
                f"what happens at the {name} end of each stable interval",
                ("lam", "sigma", "interval"),
            )
            _flags(data, KINDS)
        most = max([1, *(s.V.shape[-1] for s in surfaces.values())])
        self._counter("root", most, "number of the sheet of roots")
        group = self.file.create_group("boundary", track_order=True)
        for name, (V, edge) in surfaces.items():
            shape = (*V.shape[:-1], most)
            wide, flag = np.full(shape, np.nan), np.zeros(shape, np.uint8)
            wide[..., : V.shape[-1]], flag[..., : V.shape[-1]] = V, edge
            data = group.create_dataset(name, data=wide, fillvalue=np.nan, track_order=True, **_packed(wide))
            self._describe(
                data,
                "m s-1",
                f"every speed at which {name} changes sign, sheet by sheet",
                ("lam", "sigma", "root"),
            )
            data = group.create_dataset(f"{name}_edge", data=flag, track_order=True, **_packed(flag))
            self._describe(
                data, "1", f"whether {name} = 0 is an edge of stability there", ("lam", "sigma", "root")
            )
            _flags(data, ("no_edge", "edge"))
        group.attrs["largest_difference"] = agreement.largest
        group.attrs["largest_difference_units"] = np.bytes_("m s-1")

    def _counter(self, name: str, length: int, text: str) -> None:
        data = self.file.create_dataset(name, data=np.arange(1, length + 1, dtype=np.int32), track_order=True)
        data.make_scale(name)
        self._describe(data, "1", text, ())

    def finish(self, config: ScanConfig) -> None:
        """Link the fields for ParaView and mark the file complete."""
        if all(uniform(config.grid.values(name)) for name in AXES):
            _vtk(self.file, self.names)
        self.file.attrs["complete"] = np.int32(1)


class Volume:
    """A complete volume, open for reading. Raises InputError for any other file."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        if self.path.is_dir() and (self.path / "volume.h5").is_file():
            self.path = self.path / "volume.h5"
        place = str(path)
        if not self.path.is_file():
            raise InputError("there is no such volume", place=place, hint="'bikestab scan CONFIG' writes one")
        try:
            self.file = h5py.File(self.path, "r")
        except OSError:
            raise InputError("is not an HDF5 file, or a damaged one", place=place) from None
        attributes = self.file.attrs
        if "config_sha256" not in attributes or "lam" not in self.file:
            self.file.close()
            raise InputError("is an HDF5 file, but no volume of bikestab", place=place)
        if not attributes.get("complete", 0):
            self.file.close()
            raise InputError("is incomplete", place=place, hint="'bikestab scan --force' writes it again")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.file.close()

    def text(self, name: str) -> str:
        """A text attribute of the file."""
        value = self.file.attrs[name]
        return value.decode() if isinstance(value, bytes) else str(value)

    def read(self, name: str, where: tuple[int | slice, ...] = ()) -> NDArray[Any]:
        """A dataset or a part of it; InputError where the file is damaged there."""
        try:
            return self.file[name][where]
        except OSError:
            problem = f"is damaged: {name} cannot be read"
            raise InputError(problem, place=str(self.path), hint="scan again with --force") from None

    def axis(self, name: Axis) -> Floats:
        """The values of λ [rad], σ [1] or V [m/s]."""
        return self.read(name)

    @property
    def fields(self) -> list[str]:
        """The names of the (lam, sigma, V) fields in the file."""
        return [name for name in FIELDS if name in self.file]

    @property
    def bicycle(self) -> Bicycle:
        """The machine that was computed, with the damping used."""
        return Bicycle(
            **json.loads(self.text("bicycle_parameters")),
            name=self.text("bicycle"),
            source=self.text("references"),
        )

    @property
    def model(self) -> Model:
        """``refined`` or ``unrefined``."""
        return self.text("model")  # type: ignore[return-value]  # written from a Model


def field_names(config: ScanConfig) -> list[str]:
    """The datasets that the config's ``fields`` stand for, in the file's order."""
    wanted = set(config.fields) | (set(CONDITIONS) if "conditions" in config.fields else set())
    return [name for name in FIELDS if name in wanted]


def parameters_text(bicycle: Bicycle) -> str:
    """The bicycle's numbers as the volume keeps them."""
    return json.dumps(bicycle.numbers())


def uniform(values: Floats) -> bool:
    """Whether an axis has equal steps, which VTK's image data needs."""
    steps = np.diff(values)
    return bool(np.allclose(steps, steps[0], rtol=1e-9, atol=0))


def _vtk(file: h5py.File, names: list[str]) -> None:
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


def _flags(data: h5py.Dataset, meanings: tuple[str, ...]) -> None:
    data.attrs["flag_values"] = np.arange(len(meanings), dtype=np.uint8)
    data.attrs["flag_meanings"] = _ascii(*meanings)


def _ascii(*words: str) -> np.bytes_:
    return np.bytes_(" ".join(words))


def _packed(values: NDArray[Any]) -> dict[str, Any]:
    chunks = tuple(min(n, limit) for n, limit in zip(values.shape, (64, 64, values.shape[-1]), strict=True))
    return {"chunks": chunks, "compression": "gzip", "compression_opts": 4, "shuffle": values.itemsize > 1}
