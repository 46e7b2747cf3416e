"""The pictures of a scan: those its config asks for, of each of its machines."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Literal

from bikestab.config.scanconfig import ScanConfig
from bikestab.plot import region
from bikestab.plot.files import save, slice_name
from bikestab.plot.slices import draw_slice, on_grid
from bikestab.volume import Volume

MOST_DRAWN = 8  # machines of a sweep


def draw_pictures(config: ScanConfig, path: str | Path, tell: Callable[[str], None]) -> list[Path]:
    """Draw the pictures of the volume at ``path`` beside it; ``tell`` is called with what cannot be drawn."""
    if len(config.members) > MOST_DRAWN:
        values = " ".join(f"--at {name}={value:g}" for name, value in config.members[0].values.items())
        x, _, _ = config.grid.names
        plane = "--lam VALUE" if x == "lam" else f"--at {x}=VALUE"
        tell(
            f"note: pictures of {len(config.members)} machines are not drawn; draw one with, for example, "
            f"'bikestab slice {path} {plane} {values}'"
        )
        return []
    with Volume(path) as volume:
        return [
            picture
            for member in config.members
            for picture in _of_one(config, volume.at(member.values), member.values, tell)
        ]


def _region(volume: Volume, path: Path, tell: Callable[[str], None]) -> list[Path]:
    try:
        figure = region.draw_region(volume)
    except Exception as error:  # the volume and the other pictures are worth more than this one
        text = f"{type(error).__name__}: {error}".rstrip(": ")
        tell(f"warning: {path} cannot be drawn ({text}); please report this")
        return []
    save(figure, path)
    return [path]


def _of_one(
    config: ScanConfig, volume: Volume, values: Mapping[str, float], tell: Callable[[str], None]
) -> list[Path]:
    folder = volume.path.parent
    pictures: list[Path] = []
    if all(len(volume.axis(name)) > 1 for name in volume.axes):
        pictures += _region(volume, folder / slice_name(values, "region"), tell)
    fields: tuple[Literal["growth_rate", "probability"], ...] = ("growth_rate", "probability")
    for plane in config.slices:
        fixed, value = plane.fixed
        for field in fields[: 2 if config.ensemble else 1]:
            at = value if field == "growth_rate" else on_grid(volume, fixed, value)
            pictures.append(folder / slice_name({fixed: at, **values}, field))
            save(draw_slice(volume, fixed, value, field), pictures[-1])
    return pictures
