"""Words beside curves and marks: where they cover none of these, nor each other, nor the frame.

Places and sizes are in points from the lower left corner of axes, whose position and limits must be final.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.plot.headings import text_width

AROUND: list[tuple[float, float]] = [
    (1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1),
    (2, 1), (-2, 1), (2, -1), (-2, -1), (0, 2), (0, -2), (0.5, 1), (-0.5, 1), (0.5, -1), (-0.5, -1),
    (1, 0.5), (-1, 0.5), (1, -0.5), (-1, -0.5),
]  # fmt: skip
_LEAST = (1.0, 0.6, 0.3, 0.0)  # of what is free around words, in halves of their sides
_NEARER = 1.9  # times as near a mark as any other are words that are its own
_STEP = 1.5  # of a curve's points, at most
_ROW, _GAP = 0.62, 1.5  # half a line of text, in its size; around it


class Room:
    """What is taken in axes: points of curves, and boxes (x, y, half a width, half a height)."""

    def __init__(self, ax: Axes) -> None:
        figure: Any = ax.figure
        self.size: Floats = figure.get_size_inches() * ax.get_position().size * 72
        self._shares = ax.transData + ax.transAxes.inverted()
        self._points: list[Floats] = []
        self._boxes: list[Floats] = []

    def at(self, x: Any, y: Any) -> Floats:
        """Data as places (n, 2)."""
        data = np.column_stack(np.broadcast_arrays(np.atleast_1d(x), np.atleast_1d(y))).astype(float)
        return np.asarray(self._shares.transform(data) * self.size)

    def along(self, x: Any, y: Any) -> Floats:
        """A curve of data as places that are close together, those in the axes."""
        places = self.at(x, y)
        places = places[np.isfinite(places).all(axis=1)]
        if len(places) < 2:
            return places
        length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(places, axis=0).T))])
        every = np.arange(0.0, length[-1] + _STEP, _STEP)
        places = np.column_stack([np.interp(every, length, part) for part in places.T])
        return np.asarray(places[((places >= -1) & (places <= self.size + 1)).all(axis=1)])

    def curve(self, x: Any, y: Any) -> None:
        """Keep words off a curve."""
        self._points.append(self.along(x, y))

    def mark(self, x: float, y: float, size: float) -> None:
        """Keep words off a mark of so many points."""
        self._boxes.append(np.array([*self.at(x, y)[0], size / 2, size / 2]))

    def line(self, line: Line2D) -> None:
        """Keep words off a curve, or off marks, that are drawn already."""
        data = np.asarray(line.get_xydata(), dtype=float)
        if line.get_linestyle() != "None":
            self.curve(*data.T)
        if line.get_marker() != "None":
            for x, y in data:
                self.mark(x, y, float(line.get_markersize()))

    def box(self, place: Floats, half: Floats) -> None:
        """Keep words off a box."""
        self._boxes.append(np.concatenate([place, half]))

    def free(self, places: Floats, half: Floats, apart: float = 0.0) -> Floats:
        """How far boxes around places (n, 2) are from curves, in halves of their sides; less than 1 covers.

        Zero where one leaves the axes or covers a box.
        """
        away = np.full(len(places), np.inf)
        for points in self._points:
            if len(points):
                far = np.abs(places[:, np.newaxis] - points) / (half + apart)
                away = np.minimum(away, far.max(axis=2).min(axis=1))
        return np.where(self.open(places, half), away, 0.0)

    def open(self, places: Floats, half: Floats) -> NDArray[np.bool_]:
        """Whether boxes around places (n, 2) are in the axes and cover no box; curves they may cover."""
        inside = ((places - half >= 1) & (places + half <= self.size - 1)).all(axis=1)
        for box in self._boxes:
            inside &= (np.abs(places - box[:2]) > half + box[2:]).any(axis=1)
        return np.asarray(inside)


def half_size(text: str, size: float) -> Floats:
    """Half the width and height of words in letters of so many points, with what is free around them."""
    rows = text.split("\n")
    width = max(text_width(row, size) for row in rows) * 72
    return np.array([0.5 * width + _GAP, _ROW * size * len(rows) + 0.5])


def beside(
    room: Room, ax: Axes, text: str, x: float, y: float, *, size: float, away: Sequence[float] = (3.0,),
    needed: bool = False, sides: Sequence[tuple[float, float]] = (*AROUND,), marks: Floats | None = None,
    **style: Any
) -> Floats | None:  # fmt: skip
    """Write words ``away`` from a point of the data, on the first of ``sides`` where they cover nothing.

    Where there is no room they are not written, or, if ``needed``, where they cover little of a curve. The
    place where they are. Of all ``marks``, places (n, 2), their own is the nearest by far.
    """
    half, point = half_size(text, size), room.at(x, y)[0]
    places = np.concatenate([point + np.array(sides) * (half + far) for far in away])
    if marks is not None:
        places = places[_nearest(places, point, marks, half) | _nearest(places, point, marks, 0 * half)]
    free = room.free(places, half)
    good = next(
        (np.flatnonzero(free >= least) for least in _LEAST if np.any(free >= least)), np.empty(0, int)
    )
    if not len(good) or (free[good[0]] < 1 and not needed):
        return None
    place = np.asarray(places[good[0]])
    room.box(place, half)
    write(room, ax, text, place, size, **style)
    return place


def _nearest(places: Floats, point: Floats, marks: Floats, half: Floats) -> NDArray[np.bool_]:
    """Whether boxes around places (n, 2) are by far nearer to a point than to all other marks."""
    others = marks[np.hypot(*(marks - point).T) > 0.1]
    apart = np.maximum(np.abs(places[:, np.newaxis] - [point, *others]) - half + _GAP, 0.0)
    away = np.hypot(*apart.T)
    return np.asarray(away[1:].min(axis=0, initial=np.inf) > _NEARER * away[0])


def write(room: Room, ax: Axes, text: str, place: Floats, size: float, **style: Any) -> None:
    """Write words in the middle of a place."""
    style = {"ha": "center", "va": "center", "parse_math": False, **style}
    x, y = place / room.size
    ax.text(x, y, text, transform=ax.transAxes, fontsize=size, **style)
