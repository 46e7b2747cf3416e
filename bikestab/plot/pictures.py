"""The pictures of a scan: those its config asks for, of each of its machines.

Most of them need no volume: they can be drawn while it is computed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Literal, NamedTuple

from bikestab.config.parts import AnyGrid
from bikestab.config.scanconfig import ScanConfig
from bikestab.family import Family
from bikestab.fields import Axes, Axis
from bikestab.model import Floats
from bikestab.plot import region
from bikestab.plot.files import drawn, slice_name
from bikestab.plot.slices import draw_slice, on_grid
from bikestab.volume import Volume


@dataclass(frozen=True)
class _Subject:
    """A machine of a scan, whether it is computed yet or not, as ``volume.Subject``."""

    path: Path
    title: str
    family: Family
    grid: AnyGrid

    @property
    def axes(self) -> Axes:
        return self.grid.names

    def axis(self, name: Axis) -> Floats:
        return self.grid.values(name)


class _Picture(NamedTuple):
    """What a picture is called, of which machine it is, what it shows, and in which plane, if in one."""

    name: str
    member: int
    kind: Literal["region", "growth_rate", "probability"]
    fixed: Axis = "V"
    value: float = 0.0


def draw_without_volume(config: ScanConfig, number: int) -> tuple[dict[str, bytes | None], list[str]]:
    """One picture of a scan by its name, as the content of a file, and what is to be told.

    None is the content of one that shows what was drawn at random: only the volume has it. With too high a
    number there is none.
    """
    files: dict[str, bytes | None] = {}
    for name, member, kind, fixed, value in islice(_pictures(config), number, number + 1):
        subject = _subject(config, member)
        if kind == "region":
            try:
                files[name] = drawn(region.draw_region(subject))
            except Exception as error:  # the volume and the other pictures are worth more than this one
                what = f"{subject.path.parent / name} cannot be drawn"
                text = f"{type(error).__name__}: {error}".rstrip(": ")
                return files, [f"warning: {what} ({text}); please report this"]
        else:
            is_there = kind == "growth_rate"
            files[name] = drawn(draw_slice(subject, fixed, value)) if is_there else None
    return files, []


def draw_from_volume(config: ScanConfig, path: str | Path) -> dict[str, bytes]:
    """The other pictures."""
    with Volume(path) as volume:
        return {
            name: drawn(draw_slice(volume.at(config.members[member].values), fixed, value, kind))
            for name, member, kind, fixed, value in _pictures(config)
            if kind == "probability"
        }


def draw_proofs(config: ScanConfig, volume: Volume) -> dict[str, bytes]:
    """The pictures of what is proved in the config's planes."""
    planes = [plane.fixed for plane in config.slices]
    return {
        slice_name({fixed: value}, "certified"): drawn(draw_slice(volume, fixed, value, "certified"))
        for fixed, value in planes
    }


def _subject(config: ScanConfig, member: int) -> _Subject:
    values = ", ".join(f"{name} = {value:g}" for name, value in config.members[member].values.items())
    title = config.heading + (f" ({values})" if values else "")
    return _Subject(Path(config.output) / "volume.h5", title, config.family(member), config.grid)


def _pictures(config: ScanConfig) -> Iterator[_Picture]:
    grid = config.grid
    for i, (values, _) in enumerate(config.members):
        if all(grid.size(name) > 1 for name in grid.names):
            yield _Picture(slice_name(values, "region"), i, "region")
        for plane in config.slices:
            fixed, value = plane.fixed
            yield _Picture(slice_name({fixed: value, **values}), i, "growth_rate", fixed, value)
            if config.ensemble:
                near = on_grid(grid.values(fixed), value)
                name = slice_name({fixed: near, **values}, "probability")
                yield _Picture(name, i, "probability", fixed, value)
