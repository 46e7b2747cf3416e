"""Arrowheads along curves, where they cover no mark and no word."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bikestab.model import Floats
from bikestab.plot.placing import Room

_ARROWS = 90.0  # points along a curve between its arrowheads, and twice as much as before the first
_HEAD = 5.2  # of an arrowhead, which is as wide as it is long
_AROUND = (2.0, 0.0)  # points free around it, if they are
_SHORT = 24.0  # of a curve without one


def draw_arrowheads(ax: Axes, room: Room, s: Any, lane: float = 0.0) -> None:
    """Arrowheads along a curve, the way it goes as the speed grows, where they cover no dot and no number.

    The curve is drawn ``lane`` points higher.
    """
    places = room.at(s.real, s.imag) + np.array([0.0, lane])
    inside = np.all((places > 4) & (places < room.size - 4), axis=1)
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(places, axis=0).T) * (inside[1:]))])
    if length[-1] < _SHORT:
        return
    number = max(round(length[-1] / _ARROWS), 1)
    apart = length[-1] / number
    for at in (np.arange(number) + 0.5) * apart:
        ways = at + np.arange(-0.45 * apart, 0.45 * apart)
        ways = ways[np.argsort(np.abs(ways - at))]  # the nearest first
        tips, tails = (_along(places, length, way) for way in (ways, ways - _HEAD))
        for around in _AROUND:
            half = np.full(2, 0.5 * _HEAD + around)
            free = np.flatnonzero(room.open((tips + tails) / 2, half))
            if len(free):
                _arrowhead(ax, tails[free[0]] / room.size, tips[free[0]] / room.size)
                room.box((tips[free[0]] + tails[free[0]]) / 2, half)
                break


def _along(places: Floats, length: Floats, ways: Floats) -> Floats:
    """Places on a curve after some ways along it [points]."""
    return np.column_stack([np.interp(ways, length, part) for part in places.T])


def _arrowhead(ax: Axes, tail: Floats, tip: Floats) -> None:
    """An arrowhead between two shares of the axes."""
    style = {"arrowstyle": "-|>", "color": "0.2", "lw": 0, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 13}
    ax.annotate("", tuple(tip), tuple(tail), "axes fraction", "axes fraction", arrowprops=style, zorder=4)
