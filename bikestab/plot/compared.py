"""The picture of machines compared with the first: growth rates at their designs, and where one is stable."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.comparison import Box, Region, Side
from bikestab.family import Family
from bikestab.model import exact_table
from bikestab.plot.axes import HALO, label_family, labels_of, place_ticks
from bikestab.plot.growth import growth_axes
from bikestab.plot.headings import set_title, short
from bikestab.plot.placing import Room, beside
from bikestab.plot.settings import own_settings
from bikestab.records import letter_of
from bikestab.speeds import intervals_of

Place = tuple[float, float]
_MARKS = (("o", 10), ("s", 5))  # points
_COLUMNS = 2  # of maps
_WIDTHS, _GROWTH, _MAP = (6.2, 7.6), 4.4, (5.0, 3.4)  # inches, of a map that stands alone and of others
_BEYOND = 1.5  # where growth rates end, of the highest end of stability


@own_settings()
def draw_compared(sides: Sequence[Side], regions: Sequence[Region]) -> Figure:
    """Growth rates of those that have a design, and maps where the box has lengths in both of its parameters.

    Each map shows where the first differs from one of the others, whose ``regions`` these are; all are on one
    scale.
    """
    named = [(f"{letter_of(i)}: {short(side.name)}", side) for i, side in enumerate(sides)]
    growth = any(side.design for side in sides)
    drawn = [k for k, found in enumerate(regions) if min(found.apart.shape) > 1]
    columns = min(len(drawn), _COLUMNS) or 1
    rows = -(-len(drawn) // columns)
    heights = [*([_GROWTH] if growth else []), *[_MAP[columns - 1]] * rows]
    figure = Figure(figsize=(_WIDTHS[columns - 1], sum(heights) or 1.0), layout="constrained")
    grid = figure.add_gridspec(len(heights) or 1, columns, height_ratios=heights or None)
    if growth:
        _growth(figure.add_subplot(grid[0, :]), named, _speeds(sides, regions))
    axes = [figure.add_subplot(grid[i // columns + growth, i % columns]) for i in range(len(drawn))]
    largest = max((float(regions[k].apart.max()) for k in drawn), default=0.0)
    for k, ax in zip(drawn, axes, strict=True):
        _map(ax, regions[k], largest or 1.0)
        _label(ax, [sides[0], sides[k + 1]], regions[k].box, alone=len(drawn) == 1)
        words = f"stable regions differ in {100 * regions[k].share:.3g} % of their union"
        words = f"A and {letter_of(k + 1)}: {words}" + (
            " over these axes and speed" if len(drawn) == 1 else ""
        )
        set_title(ax, *([] if growth else [named[0][0], named[k + 1][0]]), words, panels=columns)
    if axes and largest:
        place: dict[str, Any] = {"location": "bottom", "aspect": 30}  # beside there may be the trail
        bar = figure.colorbar(axes[0].collections[0], ax=axes, shrink=1 / columns, **place)
        white = "\nwhite: at each speed both are stable, or neither"
        bar.set_label(f"speeds at which exactly one is stable [m/s]{white}")
    if engine := figure.get_layout_engine():
        engine.execute(figure)  # which says where the axes are
    for k, ax in zip(drawn, axes, strict=True):
        pair = {"A": sides[0], letter_of(k + 1): sides[k + 1]}
        places = {name: _place(regions[k].box, side) for name, side in pair.items()}
        _mark_designs(ax, {name: at for name, at in places.items() if at})
    return figure


def _map(ax: Axes, found: Region, largest: float) -> None:
    ax.pcolormesh(
        found.box.x, found.box.y, np.ma.masked_equal(found.apart.T, 0), cmap="cividis", shading="nearest",
        vmin=0, vmax=largest, rasterized=True,
    )  # fmt: skip
    if not found.difference:
        ax.text(0.5, 0.5, "identical", transform=ax.transAxes, ha="center", va="center", size=10)


def _growth(ax: Axes, named: Sequence[tuple[str, Side]], speeds: tuple[float, float]) -> None:
    """Growth rates of those that have a design, and who has none."""
    curves = [(name, side.bicycle, *side.design, side.model) for name, side in named if side.design]
    growth_axes(ax, curves, *speeds)
    if without := [name for name, side in named if not side.design]:
        words = f"({', '.join(without)}: no design of {'its' if len(without) == 1 else 'their'} own)"
        set_title(ax, ax.get_title(), words)


def _speeds(sides: Sequence[Side], regions: Sequence[Region]) -> tuple[float, float]:
    """Those of growth rates: from the boxes' lowest to beyond all ends of stability, in the boxes."""
    lows, highs = zip(*(found.box.ends[2] for found in regions), strict=True)
    low, high = min(lows), max(highs)
    ends = [0.0]
    for side in sides:
        if side.design:
            found = intervals_of(exact_table(side.bicycle, *side.design, model=side.model))
            edges = np.concatenate([found.V1[: found.number], found.V2[: found.number]])
            ends += edges[(edges > low) & (edges < high)].tolist()
    if max(ends) > low:
        high = min(high, float(np.ceil(low + _BEYOND * (max(ends) - low))))
    return low, high


def _label(ax: Axes, both: Sequence[Side], box: Box, *, alone: bool) -> None:
    """The axes of a map; beside one that stands ``alone`` also the head angle and the trail."""
    ax.set_xlim(*box.ends[0])
    ax.set_ylim(*box.ends[1])
    family = Family(both[0].bicycle, both[0].model, *box.names)
    if alone:
        label_family(ax, *box.names, family, one_wheelbase=both[0].bicycle.c == both[1].bicycle.c)
        return
    labels = labels_of(family)
    for axis, name in zip((ax.xaxis, ax.yaxis), box.names, strict=True):
        if name == "head_angle":
            place_ticks(axis, name)
    ax.set_xlabel(labels[box.names[0]])
    ax.set_ylabel(labels[box.names[1]])


def _mark_designs(ax: Axes, places: dict[str, Place]) -> None:
    """A mark for each design, with its letter, or one with the letters of two in the same place."""
    letters = {
        place: ", ".join(name for name in places if places[name] == place) for place in places.values()
    }
    room = Room(ax)
    for place, (marker, size) in zip(letters, _MARKS, strict=False):  # the second hides none of the first
        ax.plot(*place, marker, ms=size, mfc="white", mec="black", clip_on=False)
        room.mark(*place, size)
    for place, words in letters.items():
        beside(room, ax, words, *place, size=10, away=(5.0,), needed=True, path_effects=HALO)


def _place(box: Box, side: Side) -> Place | None:
    """Where a side's design is in the box, if there."""
    family = Family(side.bicycle, side.model, *box.names)
    x, y = (side.design or (None, None)) if family.of_front else family.own
    if x is None or y is None:
        return None
    inside = all(low <= at <= high for at, (low, high) in zip((x, y), box.ends[:2], strict=True))
    return (x, y) if inside else None
