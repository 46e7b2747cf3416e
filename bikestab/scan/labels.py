"""What a volume says of itself: texts, units, meanings, flags, and ParaView's view of the same arrays."""

from __future__ import annotations

from typing import Any

import h5py
import numpy as np

from bikestab import __version__
from bikestab.config.scanconfig import ScanConfig
from bikestab.fields import AXES, Axes
from bikestab.volume import parameters_text

# value k of ``marginal``: speeds.REASONS[k] in a word
MARGINAL = ("certain", "capsize_speed", "weave_speeds", "order_of_speeds", "signs", "width")


def texts(config: ScanConfig) -> dict[str, str]:
    """The identity of a config, and the file's attributes that may differ where it does not."""
    return {
        "title": config.heading,
        "references": config.machine.source,
        "bicycle": config.machine.name,
        "warnings": "\n".join(config.warnings),
        "config": config.text,
        "config_sha256": config.sha256,
    }


def file_attributes(config: ScanConfig) -> dict[str, Any]:
    """All attributes of a file that is not complete yet, in their order."""
    text = texts(config)
    attributes: dict[str, Any] = {
        "Conventions": np.bytes_("CF-1.11"),
        "title": text["title"],
        "source": f"bikestab {__version__}",
        "references": text["references"],
        "bikestab_version": __version__,
        "bicycle": text["bicycle"],
        "bicycle_parameters": parameters_text(config.family(None)),
        "warnings": text["warnings"],
        "model": config.model,
        "config": text["config"],
        "config_sha256": text["config_sha256"],
        "complete": np.int32(0),
    }
    if config.grid.names != AXES:
        attributes["axes"] = " ".join(config.grid.names)
    if config.ensemble:
        attributes["ensemble_samples"] = config.ensemble.samples
    return attributes


def describe(data: h5py.Dataset, unit: str, meaning: str) -> None:
    """Give a dataset its unit, if any, and its meaning, in ASCII as netCDF wants them."""
    if unit:
        data.attrs["units"] = np.bytes_(_ascii_unit(unit))
    data.attrs["long_name"] = np.bytes_(meaning.encode("ascii", "replace"))


def flags(data: h5py.Dataset, meanings: tuple[str, ...]) -> None:
    """Tell what the values 0, 1 … mean."""
    data.attrs["flag_values"] = np.arange(len(meanings), dtype=data.dtype)
    data.attrs["flag_meanings"] = words(meanings)


def masks(data: h5py.Dataset, meanings: tuple[str, ...]) -> None:
    """Tell what the bits mean."""
    data.attrs["flag_masks"] = np.array([1 << bit for bit in range(len(meanings))], data.dtype)
    data.attrs["flag_meanings"] = words(meanings)


def words(names: tuple[str, ...]) -> np.bytes_:
    """Names as one attribute."""
    return np.bytes_(" ".join(names))


def _ascii_unit(unit: str) -> str:
    return unit.replace("²", "2").replace("kg m2/s", "kg m2 s-1").replace("m/s2", "m s-2")


def add_vtk_view(file: h5py.File, names: tuple[str, ...], grid: Axes) -> None:
    """ParaView's view of the same arrays: x = V, y = σ, z = λ, or what the ``grid`` has in place of these."""
    group = file.create_group("VTKHDF", track_order=True)
    axes = [file[name][()] for name in reversed(grid)]
    group.attrs["Version"] = np.array([1, 0])
    group.attrs["Type"] = np.bytes_("ImageData")
    group.attrs["WholeExtent"] = np.array([[0, len(axis) - 1] for axis in axes]).ravel()
    group.attrs["Origin"] = np.array([axis[0] for axis in axes])
    group.attrs["Spacing"] = np.array([(axis[-1] - axis[0]) / (len(axis) - 1) for axis in axes])
    group.attrs["Direction"] = np.eye(3).ravel()
    points = group.create_group("PointData", track_order=True)
    for name in names:
        points[name] = h5py.SoftLink(f"/{name}")  # hard ones let kerchunk lose the fields themselves
