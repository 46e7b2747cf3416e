"""Lines of equal value, with numbers on them where these cover nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from bikestab.model import Floats
from bikestab.plot.placing import Room, half_size, write

_STEPS = np.array([0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100])
_LEVELS = 9  # steps between most of the values
_SIZE = 8  # of numbers
_CANDIDATES = 60  # places along a line
_SHORTEST = 2.5  # of lines with a number, in its widths
_HALO = [withStroke(linewidth=3, foreground="white")]


class Level(NamedTuple):
    """One piece (n, 2) of a line, and the number of its value."""

    text: str
    piece: Floats


def draw_levels(ax: Axes, x: Floats, y: Floats, values: Floats, dashes: Any) -> list[Level]:
    """Lines of values at (y, x), NaN where there are none, a round step apart."""
    finite = values[np.isfinite(values)]
    if not finite.size or np.ptp(finite) == 0:
        return []
    low, high = np.percentile(finite, [1, 99])
    step = _STEPS[np.searchsorted(_STEPS, (high - low) / _LEVELS, "left").clip(max=len(_STEPS) - 1)]
    levels = np.arange(np.ceil(finite.min() / step), np.floor(high / step) + 1) * step
    if not len(levels):
        return []
    lines = ax.contour(x, y, np.ma.masked_invalid(values), levels=levels, colors="black", linewidths=1)
    lines.set_linestyle(dashes)
    return [
        Level(f"{level:g}", np.asarray(piece))
        for level, pieces in zip(levels, lines.allsegs, strict=True)
        for piece in pieces
        if len(piece) > 1
    ]


def label_levels(ax: Axes, levels: Sequence[Level], room: Room) -> None:
    """Write each line's number on it, the longest lines first; none where there is no room for it.

    What else is drawn is in ``room``, and the axes stay as they are.
    """
    paths = [room.along(*level.piece.T) for level in levels]
    drawn = list(range(len(levels)))
    for i in sorted(drawn, key=lambda i: -len(paths[i])):
        half = half_size(levels[i].text, _SIZE)
        if _length(paths[i]) < _SHORTEST * 2 * half[0]:
            continue
        places = paths[i][:: max(len(paths[i]) // _CANDIDATES, 1)]
        others = [paths[j] for j in drawn if j != i and len(paths[j])]
        free = np.minimum(room.free(places, half), _free(places, others, half))
        at = np.linspace(-1, 1, len(places))
        best = int(np.argmax(np.minimum(free, 2) - 0.2 * np.abs(at)))  # rather in a line's middle
        if free[best] >= 1:
            room.box(places[best], half)
            write(room, ax, levels[i].text, places[best], _SIZE, path_effects=_HALO, zorder=3.5)


def _length(path: Floats) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum()) if len(path) > 1 else 0.0


def _free(places: Floats, others: Sequence[Floats], half: Floats) -> Floats:
    """How far places are from other lines, in halves of a number's sides."""
    away = np.full(len(places), np.inf)
    for other in others:
        far = np.abs(places[:, np.newaxis] - other[::2]) / half
        away = np.minimum(away, far.max(axis=2).min(axis=1))
    return away
