"""Volumes → what the page shows of them: axes, machines, and for each its plane, curves and surface."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import Any

from bikestab.aside import meanwhile
from bikestab.bicycle import PAPER
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.fields import AXES
from bikestab.gains import GAINS
from bikestab.geometry import GIVEN
from bikestab.notation import MEIJAARD
from bikestab.report.machines import machine_record
from bikestab.report.surfaces import surfaces
from bikestab.rider import RIDER
from bikestab.volume import Volume, check_ranges

Box = dict[str, list[float]]  # ends of λ [rad], σ and V [m/s]
Progress = Callable[[int, int], None]  # machines done, and all
MOST_MACHINES = 24  # of a sweep: each brings some 110 kB


def volume_records(volumes: Sequence[Volume], progress: Progress) -> list[dict[str, Any]]:
    """What page/volumes.mjs takes, one a volume.

    Raises InputError for a grid over other parameters than tilt and trail, for one value of an axis, and for
    too many machines.
    """
    records = [_volume(volume) for volume in volumes]
    every = [
        (family, swept, record["box"])
        for volume, record in zip(volumes, records, strict=True)
        for family, swept in families(volume)
    ]
    with meanwhile(lambda: [_machine(*one) for one in every[1::2]]) as others:
        machines: list[Any] = [None] * len(every)
        progress(0, len(every))
        for i in range(0, len(every), 2):
            machines[i] = _machine(*every[i])
            progress(min(i + 2, len(every)), len(every))
        machines[1::2] = others()
    made = iter(machines)
    for record in records:
        record["machines"] = [next(made) for _ in range(record.pop("number"))]
    return records


def _volume(volume: Volume) -> dict[str, Any]:
    """A record that lacks its machines, but for their number."""
    if volume.axes != AXES:
        x, y, _ = volume.axes
        others = " and ".join(name for name in (x, y) if name not in GIVEN)
        problem = f"has a grid over {x} and {y}, and a page is of tilt and trail"
        hint = "scan over lam and sigma"
        if others:
            hint += f", with a sweep of a few values of {others}, which become sliders"
        raise InputError(problem, place=str(volume.path), hint=hint)
    check_ranges(volume, AXES, "a page")
    number = len(_swept(volume))
    if number > MOST_MACHINES:
        problem = f"has a sweep of {number} machines, and a page shows {MOST_MACHINES} at most"
        raise InputError(problem, place=str(volume.path), hint="sweep fewer values")
    box: Box = {name: [float(volume.axis(name)[0]), float(volume.axis(name)[-1])] for name in AXES}
    return {
        "title": volume.text("title"),
        "model": volume.model,
        "box": box,
        "sweep": [
            {"name": name, **_described(name), "values": values.tolist()}
            for name, values in volume.swept.items()
        ],
        "warnings": [line for line in volume.text("warnings").split("\n") if line],
        "samples": volume.samples,
        "version": volume.text("bikestab_version"),
        "number": number,
    }


def _swept(volume: Volume) -> list[tuple[float, ...]]:
    return list(product(*(values.tolist() for values in volume.swept.values())))


def families(volume: Volume) -> Iterator[tuple[Family, dict[str, float]]]:
    """The machines of a volume, each with what the sweep changes."""
    for values in _swept(volume):
        swept = dict(zip(volume.swept, values, strict=True))
        yield volume.at(swept).family, swept


def _machine(family: Family, swept: dict[str, float], box: Box) -> dict[str, Any]:
    lam, sigma, V = ((low, high) for low, high in box.values())
    return machine_record(family.bicycle, family.model, swept) | surfaces(family, lam, sigma, V)


def _described(name: str) -> dict[str, str]:
    """A parameter's meaning and unit."""
    meaning, _, unit = {**PAPER, **MEIJAARD, **RIDER, **GAINS}.get(name, "").partition(" [")
    return {"meaning": meaning, "unit": unit.rstrip("]")}
