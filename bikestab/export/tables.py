"""Stable intervals, the skeleton's curves, modes and the best designs as tables, in CSV or Parquet.

docs/exports.md describes the columns.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from bikestab.export.formats import file_format
from bikestab.files import written
from bikestab.model import Floats
from bikestab.records import design_record
from bikestab.speeds import KINDS, REASONS

if TYPE_CHECKING:
    from bikestab.design.optimum import JudgedDesign
    from bikestab.family import Family
    from bikestab.modes import Modes
    from bikestab.region.curves import Curve
    from bikestab.region.points import Point
    from bikestab.volume import Volume

Indices = NDArray[np.intp]
Block = dict[str, NDArray]  # some rows of a table: the columns, each of shape (row,)
Columns = Mapping[str, tuple[str, str]]  # name → pyarrow's name of the type, unit

TABLES = {".csv": "", ".parquet": "pyarrow"}  # ending → package it needs
_DESIGN = {"lam": ("float64", "rad"), "sigma": ("float64", "1"), "head_angle_deg": ("float64", "degree")}
_DESIGN |= {"trail": ("float64", "m"), "offset": ("float64", "m")}
_TEXT = ("string", "")
INTERVALS: Columns = {
    **_DESIGN, "interval": ("int32", "1"), "V1": ("float64", "m/s"), "V2": ("float64", "m/s"),
    "lower": _TEXT, "upper": _TEXT, "V1_error": ("float64", "m/s"), "V2_error": ("float64", "m/s"),
    "marginal": _TEXT,
}  # fmt: skip
QUANTILES: Columns = {
    **_DESIGN, "probability_somewhere": ("float64", "1"), "probability_unbounded": ("float64", "1"),
    "quantile": ("float64", "1"), "V1": ("float64", "m/s"), "V2": ("float64", "m/s"),
}  # fmt: skip
SKELETON: Columns = {
    "curve": ("int32", "1"), "name": _TEXT, "closes": ("bool", ""), "point": ("int32", "1"), **_DESIGN,
    "V": ("float64", "m/s"), "start": _TEXT, "end": _TEXT,
}  # fmt: skip
MODES: Columns = {
    "V": ("float64", "m/s"), "branch": ("int32", "1"), "name": _TEXT, "re": ("float64", "1/s"),
    "im": ("float64", "1/s"),
}  # fmt: skip
FRONT: Columns = {
    **_DESIGN, "V1": ("float64", "m/s"), "V2": ("float64", "m/s"), "lower": _TEXT, "upper": _TEXT,
    "width": ("float64", "m/s"), "growth_rate": ("float64", "1/s"), "V": ("float64", "m/s"), "at": _TEXT,
}  # fmt: skip
_LAYER = 64  # values of the first axis read at once: a layer of the volume's chunks
_ROWS = 10_000  # turned into text at once


def interval_blocks(volume: Volume) -> Iterator[Block]:
    """The rows of INTERVALS: one per stable interval, so none of a design that has no stable speed.

    In the order of the volume's axes. Raises InputError where the volume is damaged.
    """
    family, (x, y) = volume.family, (volume.axis(name) for name in volume.axes[:2])
    words = np.array(KINDS)
    for start in range(0, len(x), _LAYER):
        part = slice(start, start + _LAYER)
        V1, V2, lower, upper = (volume.read(name, (part,)) for name in ("V1", "V2", "lower", "upper"))
        i, j, k = np.nonzero(upper)
        numbers = {"interval": (k + 1).astype(np.int32), "V1": V1[i, j, k], "V2": V2[i, j, k]}
        kinds = {"lower": words[lower[i, j, k]], "upper": words[upper[i, j, k]]}
        yield {
            **_designs(x[part][i], y[j], family),
            **numbers,
            **kinds,
            **_bounds(volume, part, i, j, k),
        }


def _bounds(volume: Volume, part: slice, i: Indices, j: Indices, k: Indices) -> Block:
    """The columns of what is certain, at intervals of a part of the volume; empty for an earlier build's."""
    if "marginal" not in volume.file:
        none = np.full(len(i), np.nan)
        return {"V1_error": none, "V2_error": none, "marginal": np.full(len(i), "")}
    errors = {name: volume.read(name, (part,))[i, j, k] for name in ("V1_error", "V2_error")}
    return {**errors, "marginal": np.array(REASONS)[volume.read("marginal", (part,))[i, j]]}


def quantile_blocks(volume: Volume) -> Iterator[Block]:
    """The rows of QUANTILES: one per design and quantile, in the order of the volume's axes.

    Raises InputError where the volume is damaged.
    """
    family, (x, y) = volume.family, (volume.axis(name) for name in volume.axes[:2])
    shares = volume.file["quantile"][()]
    names = ("probability_somewhere", "probability_unbounded")
    for start in range(0, len(x), _LAYER):
        part = slice(start, start + _LAYER)
        V1, V2 = (volume.read(f"{end}_quantiles", (part,)) for end in ("V1", "V2"))
        i, j, k = (index.ravel() for index in np.indices(V1.shape))
        shown = {name: volume.read(name, (part,))[i, j] for name in names}
        yield {
            **_designs(x[part][i], y[j], family), **shown,
            "quantile": shares[k], "V1": V1.ravel(), "V2": V2.ravel(),
        }  # fmt: skip


def skeleton_blocks(curves: Sequence[Curve], family: Family, points: Sequence[Point] = ()) -> Iterator[Block]:
    """The rows of SKELETON: one per point of a curve traced in the designs of a family.

    Behind them those of ``points`` where curves meet or end, as of curve 0, with these curves as ``start``.
    """
    for number, curve in enumerate(curves, 1):
        n = len(curve.x)

        def column(value: object, n: int = n) -> NDArray:
            return np.full(n, value)

        yield {
            "curve": np.full(n, number, np.int32), "name": column(curve.name), "closes": column(curve.closes),
            "point": np.arange(1, n + 1, dtype=np.int32), **_designs(curve.x, curve.y, family),
            "V": curve.V, "start": column(curve.ends[0]), "end": column(curve.ends[1]),
        }  # fmt: skip

    if points:
        x, y, V = (np.array([getattr(point, name) for point in points]) for name in ("x", "y", "V"))
        n = len(points)
        yield {
            "curve": np.zeros(n, np.int32), "name": np.array([point.name for point in points], object),
            "closes": np.zeros(n, bool), "point": np.arange(1, n + 1, dtype=np.int32),
            **_designs(x, y, family), "V": V,
            "start": np.array([", ".join(point.curves) for point in points], object), "end": np.full(n, ""),
        }  # fmt: skip


def modes_blocks(modes: Modes) -> Iterator[Block]:
    """The rows of MODES: four for each speed, one per branch."""
    branches, speeds = modes.eigenvalues.shape
    s = modes.eigenvalues.T.ravel()
    branch = np.tile(np.arange(branches, dtype=np.int32), speeds)
    names = modes.names.T.ravel()
    yield {"V": np.repeat(modes.V, branches), "branch": branch, "name": names, "re": s.real, "im": s.imag}


def of_machines(
    columns: Columns, tables: Sequence[tuple[str, str, Iterable[Block]]]
) -> tuple[Columns, Iterator[Block]]:
    """Tables of several machines as one: each a bicycle's name, what was set in it, and its rows.

    Of one machine without anything set it is that table; else the columns ``bicycle`` and ``set`` come first.
    """
    if len(tables) == 1 and not tables[0][1]:
        return columns, iter(tables[0][2])

    def blocks() -> Iterator[Block]:
        for name, changes, own in tables:
            for block in own:
                n = len(next(iter(block.values())))
                yield {"bicycle": np.full(n, name, object), "set": np.full(n, changes, object), **block}

    return {"bicycle": _TEXT, "set": _TEXT, **columns}, blocks()


def front_blocks(front: Sequence[JudgedDesign], over: Sequence[str] = ()) -> Iterator[Block]:
    """The rows of FRONT: one per design, the widest first; a number that is None is missing.

    Of others than tilt and trail they begin with what was searched ``over``.
    """
    rows: list[dict[str, Any]] = [{**design, **design.get("over", {})} for design in front]
    kinds = dict.fromkeys(over, "float64") | {name: kind for name, (kind, _) in FRONT.items()}
    yield {
        name: np.array([row[name] for row in rows], float if kind == "float64" else object)
        for name, kind in kinds.items()
    }


def columns(columns: Columns, family: Family) -> Columns:
    """The columns of a table of designs, behind those of a family's parameters that it does not have."""
    return {p.name: ("float64", p.unit) for p in family.parameters} | {**columns}


def _designs(x: Floats, y: Floats, family: Family) -> Block:
    lam, sigma, machine = family.geometry(x, y)
    lam, sigma, _ = np.broadcast_arrays(lam, sigma, x)
    return {**cast("Block", design_record(lam, sigma, machine)), family.x: x, family.y: y}


def save_table(columns: Columns, blocks: Iterable[Block], path: Path, about: Mapping[str, str]) -> None:
    """Write a table block by block in the format of the file's ending.

    NaN is an empty field in CSV and null in Parquet, where ``about`` is metadata. Raises InputError for an
    unknown ending or a missing package, and as ``files.written``.
    """
    if file_format(path, TABLES) == ".csv":
        save_csv(columns, blocks, path)
    else:
        with written(path) as part:
            _parquet(columns, blocks, part, about)


def save_csv(columns: Columns, blocks: Iterable[Block], path: str | Path) -> None:
    """Write a table as CSV, whatever the file's name; raises as ``files.written``."""
    with written(path) as part:
        _csv(columns, blocks, part)


def _csv(columns: Columns, blocks: Iterable[Block], path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for block in blocks:
            length = len(block[next(iter(columns))])
            for start in range(0, length, _ROWS):
                parts = [_cells(block[name][start : start + _ROWS]) for name in columns]
                writer.writerows(zip(*parts, strict=True))


def _cells(values: NDArray) -> list[object]:
    """Python's values, whose floats csv writes with as many digits as tell them apart."""
    if values.dtype == bool:
        return np.where(values, "true", "false").tolist()
    return ["" if value != value else value for value in values.tolist()]


def _parquet(columns: Columns, blocks: Iterable[Block], path: Path, about: Mapping[str, str]) -> None:
    import pyarrow
    from pyarrow.parquet import ParquetWriter

    schema = pyarrow.schema(
        [
            pyarrow.field(name, pyarrow.type_for_alias(kind), metadata={"unit": unit} if unit else None)
            for name, (kind, unit) in columns.items()
        ],
        metadata=dict(about),
    )
    with path.open("wb") as file, ParquetWriter(file, schema, compression="zstd") as writer:
        for block in blocks:
            arrays = [pyarrow.array(block[f.name], type=f.type, from_pandas=True) for f in schema]
            writer.write_table(pyarrow.Table.from_arrays(arrays, schema=schema))
