"""Lines of equal value, with symbol and number on them where these cover nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from bikestab.model import Floats
from bikestab.plot.placing import Room, half_size, write

_STEPS = np.array([0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100])
_LEVELS = 9  # steps between most of the values
_SIZE = 8  # of numbers
_CANDIDATES = 60  # places along a line
_SHORTEST = 2.5  # of lines with a number, in its widths
_WHITE = {"facecolor": "white", "edgecolor": "none", "boxstyle": "round,pad=0.1"}


class Level(NamedTuple):
    """One piece (n, 2) of a line, its value, and the symbol of what has it."""

    symbol: str
    value: str
    piece: Floats


def draw_levels(ax: Axes, x: Floats, y: Floats, values: Floats, dashes: Any, symbol: str) -> list[Level]:
    """Lines of values of a symbol at (y, x), NaN where there are none, a round step apart."""
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
        Level(symbol, f"{level:g}", np.asarray(piece))
        for level, pieces in zip(levels, lines.allsegs, strict=True)
        for piece in pieces
        if len(piece) > 1
    ]


def label_levels(ax: Axes, levels: Sequence[Level], room: Room) -> None:
    """Write each line's symbol and value on it, or the value, the longest lines first; none without room.

    What else is drawn is in ``room``, and the axes stay as they are.
    """
    paths = [room.along(*level.piece.T) for level in levels]
    for i in sorted(range(len(levels)), key=lambda i: -len(paths[i])):
        others = [path for j, path in enumerate(paths) if j != i and len(path)]
        symbol, value, _ = levels[i]
        for text in (f"{symbol} {value}", value):
            if (place := _place(text, paths[i], others, room)) is not None:
                room.box(place, half_size(text, _SIZE))
                write(room, ax, text, place, _SIZE, bbox=_WHITE, zorder=3.5)
                break


def _place(text: str, path: Floats, others: Sequence[Floats], room: Room) -> Floats | None:
    """Where on a line a text covers nothing, rather in its middle."""
    half = half_size(text, _SIZE)
    if _length(path) < _SHORTEST * 2 * half[0]:
        return None
    places = path[:: max(len(path) // _CANDIDATES, 1)]
    free = np.minimum(room.free(places, half), _free(places, others, half))
    best = int(np.argmax(np.minimum(free, 2) - 0.2 * np.abs(np.linspace(-1, 1, len(places)))))
    return np.asarray(places[best]) if free[best] >= 1 else None


def _length(path: Floats) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum()) if len(path) > 1 else 0.0


def _free(places: Floats, others: Sequence[Floats], half: Floats) -> Floats:
    """How far places are from other lines, in halves of a number's sides."""
    away = np.full(len(places), np.inf)
    for other in others:
        far = np.abs(places[:, np.newaxis] - other[::2]) / half
        away = np.minimum(away, far.max(axis=2).min(axis=1))
    return away
