"""What a volume shows, written for other programs: its intervals, its skeleton, its boundary as a mesh."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bikestab import __version__
from bikestab.errors import InputError
from bikestab.export.meshes import readable_scale, save_mesh
from bikestab.export.tables import (
    INTERVALS,
    QUANTILES,
    SKELETON,
    Block,
    Columns,
    columns,
    interval_blocks,
    quantile_blocks,
    save_table,
    skeleton_blocks,
)
from bikestab.kinds import KINDS, NONE
from bikestab.region.curves import Curve, trace
from bikestab.region.mesh import Mesh, region_mesh
from bikestab.region.points import Point, points_of
from bikestab.volume import Volume, check_ranges

Paths = Iterable[str | Path]


class Counts(NamedTuple):
    """How many intervals and designs a volume has, and how many of the designs have no interval."""

    intervals: int
    designs: int
    without: int


def export_intervals(volume: Volume, paths: Paths) -> Counts:
    """Write the stable intervals of every design, one per row; of a sweep those of every machine.

    Raises as ``save_table``.
    """
    machines = machines_of(volume)
    _save(volume, INTERVALS, machines, interval_blocks, paths)
    stable = np.stack([one.read("upper") > 0 for _, one in machines])
    designs = stable[..., 0].size
    return Counts(int(stable.sum()), designs, designs - int(stable.any(axis=-1).sum()))


def export_quantiles(volume: Volume, paths: Paths) -> int:
    """Write an ensemble's quantiles of V1 and V2, one row for each of them and design; how many rows.

    Of a sweep those of every machine. Raises InputError without an ensemble, and as ``save_table``.
    """
    if not volume.samples:
        raise InputError("has no ensemble", place=str(volume.path), hint="add 'ensemble:' to its config")
    machines = machines_of(volume)
    _save(volume, QUANTILES, machines, quantile_blocks, paths)
    return int(sum(one.read("V1_quantiles").size for _, one in machines))


def machines_of(volume: Volume) -> list[tuple[dict[str, float], Volume]]:
    """Each machine of a sweep with its values of the sweep; of a chosen one, or without a sweep, itself."""
    if not volume.swept or volume.chosen:
        return [({}, volume)]
    combinations = product(*(axis.tolist() for axis in volume.swept.values()))
    sets = [dict(zip(volume.swept, values, strict=True)) for values in combinations]
    return [(values, volume.at(values)) for values in sets]


def _save(
    volume: Volume, kind: Columns, machines: Sequence[tuple[dict[str, float], Volume]],
    blocks: Callable[[Volume], Iterator[Block]], paths: Paths,
) -> None:  # fmt: skip
    """Write a table of all machines, with the sweep's values in the first columns where there are several."""
    first = machines[0][1]
    names: Columns = dict.fromkeys(machines[0][0], ("float64", ""))
    own = columns(kind, first.family)
    for path in paths:
        rows = (
            {**{name: np.full(len(block["lam"]), value) for name, value in values.items()}, **block}
            for values, one in machines
            for block in blocks(one)
        )
        save_table({**names, **own}, rows, Path(path), about(volume))


def export_skeleton(volume: Volume, paths: Paths) -> tuple[list[Curve], list[Point]]:
    """Write the curves where intervals appear, vanish or get another end, and where these meet or end.

    They are traced through the volume's plane of designs, and at all speeds, since two of them are at
    infinite ones. Raises as ``save_table``.
    """
    check_ranges(volume, volume.axes[:2], "the skeleton")
    x, y, _ = _box(volume)
    family = volume.family
    curves = trace(family, x, y)
    points = points_of(family, curves, x, y)
    for path in paths:
        rows = skeleton_blocks(curves, family, points)
        save_table(columns(SKELETON, family), rows, Path(path), about(volume))
    return curves, points


def alike(volume: Volume) -> str:
    """What all designs of a volume have, in words; nothing where they have different things."""
    lower, upper = volume.read("lower"), volume.read("upper")
    first = zip(lower[0, 0].tolist(), upper[0, 0].tolist(), strict=True)
    ends = [f"{KINDS[low]} to {KINDS[high]}" for low, high in first if low != NONE]
    if (lower != lower[0, 0]).any() or (upper != upper[0, 0]).any():
        return ""
    return (
        f"all designs are stable from {' and from '.join(ends)}" if ends else "no design has a stable speed"
    )


def export_mesh(
    volume: Volume, paths: Paths, *, cells: int = 100, scale: Sequence[float] | None = None
) -> tuple[Mesh, Sequence[float]]:
    """Write the boundary within the volume's box, unless it has none there; the mesh, and its axes' factors.

    ``cells`` are the triangles along each of the two parameters, and ``scale`` (3,) the factors of these
    and V, by default round ones. Raises as ``save_mesh``.
    """
    check_ranges(volume, volume.axes, "a mesh")
    box = _box(volume)
    mesh = region_mesh(volume.family, *box, cells=cells)
    factors = readable_scale(*zip(*box, strict=True)).tolist() if scale is None else scale
    for path in paths if len(mesh.triangles) else ():
        save_mesh(mesh, Path(path), factors, about(volume), units_of(volume))
    return mesh, factors


def about(volume: Volume) -> dict[str, str]:
    """What every file says of where it comes from."""
    bicycle = volume.bicycle
    damping = {} if volume.swept and not volume.chosen else {"delta": repr(bicycle.delta)}  # of one machine
    return {
        "title": volume.title, "bicycle": bicycle.name, "model": volume.model, **damping,
        "source": f"bikestab {__version__}", "kinds": "1 weave, 2 capsize",
    }  # fmt: skip


def units_of(volume: Volume) -> dict[str, str]:
    """The units of the volume's axes, by their names."""
    return {**{p.name: p.unit for p in volume.family.parameters}, "V": "m/s"}


def _box(volume: Volume) -> list[tuple[float, float]]:
    return [(float(axis[0]), float(axis[-1])) for axis in (volume.axis(name) for name in volume.axes)]
