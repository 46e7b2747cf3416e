"""Marks of the best designs, and of the bicycle's own, of which none hides another."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.transforms import ScaledTranslation

from bikestab.design.best import Best
from bikestab.design.optimum import place_in_plane
from bikestab.design.wanted import Wanted, where_judged
from bikestab.plot.axes import HALO
from bikestab.plot.colours import OWN
from bikestab.plot.placing import Room

OPTIMA: dict[str, tuple[str, str, float]] = {  # marker, legend, size
    "own": ("*", "own design", 15),
    "widest": ("^", "widest interval", 9),
    "lowest_V1": ("v", "lowest V₁", 9),
    "fastest_decay": ("D", "fastest decay", 7.5),
}
_LEAST = 10.5  # points: marks that are nearer would cover each other
_GAP = 2.0  # points, around a mark beside its place
_AROUND = np.array(  # points, from a mark's place to where it stands beside it, the nearest first
    [
        (far * np.cos(angle), far * np.sin(angle))
        for far in (26.0, 33.0, 40.0, 50.0)
        for angle in np.radians(np.arange(-15, 345, 30))
    ]
)


class Mark(NamedTuple):
    """A mark, and the design (x, y) that it is of."""

    line: Line2D
    place: tuple[float, float]


def draw_optima(ax: Axes, wanted: Wanted, best: Best) -> tuple[list[Line2D], list[Mark]]:
    """The front between width and decay, and marks, each at its place; the legend's entries, the marks."""
    family = wanted.family
    handles: list[Line2D] = []
    frame: dict[str, Any] = {"ls": "", "mec": "black", "clip_on": False, "zorder": 5}
    if len(best.pareto) > 2:
        x, y = zip(*(place_in_plane(family, design) for design in best.pareto), strict=True)
        handles += ax.plot(x, y, marker="o", ms=4.5, mfc="white", mew=0.8, label="width-decay front", **frame)
    marks: list[Mark] = []
    for name, (marker, label, size) in OPTIMA.items():
        design = getattr(best, name)
        if design and design["at"] != "outside the box":
            place = place_in_plane(family, design)
            face = OWN if name == "own" else "white"
            if name == "fastest_decay":
                label += f" {where_judged(wanted) if wanted.judged else 'at its best stable speed'}"
            (drawn,) = ax.plot(*place, marker=marker, ms=size, mew=1.4, mfc=face, label=label, **frame)
            marks.append(Mark(drawn, place))
    if best.closest:
        place = place_in_plane(family, best.closest)
        (drawn,) = ax.plot(*place, marker="X", ms=9, mfc="white", mew=1.4, label="closest", **frame)
        marks.append(Mark(drawn, place))
    return [*handles, *(mark.line for mark in marks)], marks


def part(ax: Axes, marks: list[Mark], room: Room) -> None:
    """Draw a mark that would cover another beside its place, to which an arrow then points.

    All are then in ``room``, which has the curves already.
    """
    figure: Any = ax.figure
    places = [room.at(*mark.place)[0] for mark in marks]
    sizes = [np.full(2, 0.5 * float(mark.line.get_markersize())) for mark in marks]
    apart = [
        min((float(np.hypot(*(place - other))) for other in places[:i]), default=_LEAST)
        for i, place in enumerate(places)
    ]
    for place, half, far in zip(places, sizes, apart, strict=True):
        if far >= _LEAST:
            room.box(place, half)
    for (line, data), place, half, far in zip(marks, places, sizes, apart, strict=True):
        if far < _LEAST:
            free = room.free(place + _AROUND, half + _GAP)
            away = _AROUND[np.flatnonzero(free >= min(1.0, free.max()))[0]]
            room.box(place + away, half)
            arrow = {"arrowstyle": "-|>", "color": "black", "lw": 1.2, "path_effects": HALO}
            arrow |= {"shrinkA": half[0] + 1, "shrinkB": half[0] if far < half[0] else 0}
            ax.annotate("", data, tuple(away), textcoords="offset points", arrowprops=arrow, zorder=6)
            x, y = away / 72
            line.set_transform(ax.transData + ScaledTranslation(x, y, figure.dpi_scale_trans))
