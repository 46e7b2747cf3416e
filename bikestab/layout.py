"""What a volume holds: the names, types and axes of its datasets, and what their values may be.

docs/format.md says the same in words. Volumes of earlier builds lack some of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import PAPER, Bicycle
from bikestab.errors import InputError
from bikestab.fields import AXES, FIELDS, Axes, gradient_names
from bikestab.gains import GAINS
from bikestab.hdf5 import text_of
from bikestab.kinds import KINDS, REASONS, UNBOUNDED
from bikestab.notation import MEIJAARD
from bikestab.rider import RIDER
from bikestab.routh import CONDITIONS
from bikestab.variants import FRONT

TEXTS = (
    "title", "references", "bicycle", "bicycle_parameters", "warnings", "model", "config", "config_sha256",
    "bikestab_version",
)  # fmt: skip
MOST_INTERVALS = 20  # of one design: hurwitz3 and p0 have fewer roots than that
BOUNDS = ("V1_error", "V2_error", "marginal")  # which earlier builds did not write
# what values may at most be
LARGEST = {"lower": len(KINDS) - 1, "upper": len(KINDS) - 1, "marginal": len(REASONS) - 1, "probability": 1}
LARGEST |= {f"boundary/{name}_edge": 1 for name in CONDITIONS}
LARGEST |= {field.name: len(field.flags) - 1 for field in FIELDS.values() if field.flags}
LARGEST |= {field.name: (1 << len(field.masks)) - 1 for field in FIELDS.values() if field.masks}

CERTIFIED = ("undecided", "proved_stable", "proved_unstable")  # what cells between points are
LARGEST["certified"] = len(CERTIFIED) - 1


def cell_axis(name: str) -> str:
    """The name of the axis of cells between values of an axis."""
    return f"{name}_cell"


def expected(
    fields: list[str], ensemble: bool, bounds: bool, axes: Axes = AXES, gradients: bool = False
) -> Iterator[tuple[str, tuple[str, ...], type]]:
    """The datasets of a volume that are no coordinates: name, axes behind those of the sweep, type.

    ``axes`` are those of the grid.
    """
    x, y, _ = axes
    for name in fields:
        yield name, axes, FIELDS[name].dtype
    ends = ("V1", "V2", *(BOUNDS[:2] if bounds else ()))
    yield from ((name, (x, y, "interval"), np.float64) for name in ends)
    yield from ((name, (x, y, "interval"), np.uint8) for name in ("lower", "upper"))
    if bounds:
        yield "marginal", (x, y), np.uint8
    for name in CONDITIONS:
        yield f"boundary/{name}", (x, y, "root"), np.float64
        yield f"boundary/{name}_edge", (x, y, "root"), np.uint8
    if gradients:
        yield from ((name, (x, y, "interval"), np.float64) for name in gradient_names(axes))
    if ensemble:
        yield from ((f"{name}_quantiles", (x, y, "quantile"), np.float64) for name in ("V1", "V2"))
        for name in ("probability_somewhere", "probability_unbounded"):
            yield name, (x, y), np.float64


def grid_axes(file: h5py.File) -> Axes:
    """The names of the grid's axes; InputError for what is none."""
    if "axes" not in file.attrs:
        return AXES
    names = text_of(file, "axes").split()
    known = {**PAPER, **MEIJAARD, **RIDER, **FRONT, **GAINS}
    if len(names) != 3 or names[2] != "V" or names[0] == names[1] or not {*names[:2]} <= known.keys():
        raise InputError(
            f"the attribute 'axes' is {' '.join(names)[:40]!r}", hint="allowed: two parameters and V"
        )
    return names[0], names[1], names[2]


def sweep_names(file: h5py.File) -> list[str]:
    """The names of the sweep's axes, which are those of the dataset of its machines."""
    if "machine" not in file:
        return []
    return [dim[0].name[1:] for dim in file["machine"].dims][:-1]


def bicycle_of(numbers: Mapping[str, float | None], name: str = "bicycle", source: str = "") -> Bicycle:
    """The bicycle of numbers as a volume keeps them: the paper's, or those of bodies."""
    if "w" in numbers:
        return Bicycle.from_mapping({**numbers, "source": source}, name=name)
    gains = tuple((key, float(numbers[key] or 0.0)) for key in GAINS if numbers.get(key))
    numbers = {key: value for key, value in numbers.items() if key not in GAINS}
    return Bicycle(**numbers, name=name, source=source, gains=gains)  # type: ignore[arg-type]  # λ and σ may be None


def machine_names(data: h5py.Dataset) -> list[str]:
    """The names of the parameters that a volume has of each machine of its sweep."""
    return data.attrs["names"].decode().split()


def check_values(name: str, values: NDArray[Any]) -> None:
    """Raise InputError where values read from a dataset cannot be its own."""
    if name in LARGEST and values.size and not 0 <= np.min(values) <= np.max(values) <= LARGEST[name]:
        problem = f"has values that are not within 0 ... {LARGEST[name]}"
        raise InputError(problem, key=(name,))
    if name == "growth_rate" and np.isnan(values).any():
        raise InputError("has values that are no numbers", key=(name,))


def check_ends(name: str, values: NDArray[Any], upper: NDArray[np.uint8]) -> None:
    """Raise InputError where V1 or V2 is there without an interval, or not as ``upper`` says of it."""
    endless = (upper == UNBOUNDED) & (name == "V2")
    right = (np.isnan(values) == (upper == 0)) & (np.isinf(values) == endless) & ~(values < 0)
    if not np.all(right):
        raise InputError("has values that are not what upper says of their intervals", key=(name,))
