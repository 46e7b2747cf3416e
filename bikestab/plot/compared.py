"""The picture of two machines: their growth rates at their designs, and where exactly one is stable."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.comparison import Box, Region, Side
from bikestab.family import Family
from bikestab.plot.axes import HALO, label_family
from bikestab.plot.growth import growth_axes
from bikestab.plot.headings import set_title, short
from bikestab.plot.placing import Room, beside
from bikestab.plot.settings import own_settings

Place = tuple[float, float]
_MARK = 8  # points


@own_settings()
def draw_compared(A: Side, B: Side, box: Box, region: Region) -> Figure:
    """Growth rates where both have a design, and a map over λ and σ where the box has lengths in both."""
    sides = [(f"{letter}: {short(side.name)}", side) for letter, side in (("A", A), ("B", B))]
    curves = [(name, side.bicycle, *side.design, side.model) for name, side in sides if side.design]
    plane = min(len(box.x), len(box.y)) > 1
    number = bool(curves) + plane
    figure = Figure(figsize=(6.2, 4.4 * max(number, 1) + 0.6 * plane), layout="constrained")
    if curves:
        above = figure.add_subplot(number, 1, 1)
        growth_axes(above, curves, *box.ends[2])
        for name, side in sides:
            if not side.design:
                set_title(above, above.get_title(), f"({name} has no design of its own)")
    if plane:
        ax = figure.add_subplot(number, 1, number)
        apart = np.ma.masked_equal(region.apart.T, 0)
        image = ax.pcolormesh(box.x, box.y, apart, cmap="cividis", shading="nearest", vmin=0, rasterized=True)
        if region.apart.any():
            bar = figure.colorbar(image, ax=ax, location="bottom", aspect=30)  # beside there may be the trail
            bar.set_label("speeds at which exactly one is stable [m/s]")
        ax.set_xlim(*box.ends[0])
        ax.set_ylim(*box.ends[1])
        family = Family(A.bicycle, A.model, *box.names)
        label_family(ax, *box.names, family, one_wheelbase=A.bicycle.c == B.bicycle.c)
        words = f"Stable regions differ in {100 * region.share:.3g} % of their union"
        set_title(ax, f"{words}; white: no difference")
        _mark_designs(figure, ax, {name[0]: place for name, side in sides if (place := _place(box, side))})
    return figure


def _mark_designs(figure: Figure, ax: Axes, places: dict[str, Place]) -> None:
    """A mark for each design, with its letter, or one with the letters of two in the same place."""
    letters = {
        place: ", ".join(name for name in places if places[name] == place) for place in places.values()
    }
    if engine := figure.get_layout_engine():
        engine.execute(figure)  # which says where the axes are
    room = Room(ax)
    for place, marker in zip(letters, "os", strict=False):
        ax.plot(*place, marker, ms=_MARK, mfc="white", mec="black", clip_on=False)
        room.mark(*place, _MARK)
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
