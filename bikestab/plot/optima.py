"""Marks of the best designs, and of the bicycle's own, of which none hides another."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.transforms import ScaledTranslation

from bikestab.design.best import Best
from bikestab.design.optimum import place_in_plane
from bikestab.family import Family
from bikestab.model import Floats
from bikestab.plot.colours import OWN
from bikestab.plot.placing import Room

OPTIMA: dict[str, tuple[str, str, float]] = {  # marker, legend, size
    "own": ("*", "own design", 15),
    "widest": ("^", "widest interval", 9),
    "lowest_V1": ("v", "lowest V₁", 9),
    "fastest_decay": ("D", "fastest decay", 7.5),
}
_APART = 15.0  # points: marks that would cover each other


class Mark(NamedTuple):
    """A mark, and the design (x, y) that it is of."""

    line: Line2D
    place: tuple[float, float]


def draw_optima(ax: Axes, family: Family, best: Best) -> tuple[list[Line2D], list[Mark]]:
    """The front between width and decay, and marks, each at its place; the legend's entries, the marks."""
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
            (drawn,) = ax.plot(*place, marker=marker, ms=size, mew=1.4, mfc=face, label=label, **frame)
            marks.append(Mark(drawn, place))
    if best.closest:
        place = place_in_plane(family, best.closest)
        (drawn,) = ax.plot(*place, marker="X", ms=9, mfc="white", mew=1.4, label="closest", **frame)
        marks.append(Mark(drawn, place))
    return [*handles, *(mark.line for mark in marks)], marks


def part(ax: Axes, marks: list[Mark], room: Room) -> None:
    """Draw a mark beside its place where another is there, tied to it by a line; all are then in ``room``."""
    figure: Any = ax.figure
    taken: list[Floats] = []
    for line, place in marks:
        at = room.at(*place)[0]
        step = _APART if at[0] < room.size[0] / 2 else -_APART
        away = 0.0
        while any(np.hypot(at[0] + away - other[0], at[1] - other[1]) < 0.7 * _APART for other in taken):
            away += step
        taken.append(np.array([at[0] + away, at[1]]))
        size = float(line.get_markersize())
        room.box(taken[-1], np.array([size, size]) / 2)
        if away:
            tie = {"arrowstyle": "-", "color": "black", "lw": 1, "shrinkA": 0, "shrinkB": 0}
            ax.annotate("", place, (away, 0), textcoords="offset points", arrowprops=tie, zorder=4)
            line.set_transform(ax.transData + ScaledTranslation(away / 72, 0, figure.dpi_scale_trans))
