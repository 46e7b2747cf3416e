"""Names of curves at the right edge of a picture, apart from each other, tied to where the curves end."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from bikestab.errors import InputError
from bikestab.model import Floats
from bikestab.plot.axes import HALO
from bikestab.plot.headings import short
from bikestab.plot.placing import Room, beside

# Tol 2021, bright, without its grey; behind the last the dashes change
COLOURS = ("#4477AA", "#EE6677", "#228833", "#AA3377", "#CCBB44", "#66CCEE")
DASHES = ("-", (0, (5, 1.5)), (0, (1, 1.2)), (0, (4, 1.2, 1, 1.2)))
MOST = len(COLOURS) * len(DASHES)
_RIGHT = 0.9  # of the axes' width: where what ends is named at their side
_LINE = 13 / 72  # inches of a line of text


class Line(NamedTuple):
    """What a curve looks like."""

    color: str
    ls: object


def lines_for(number: int) -> list[Line]:
    """As many kinds of lines that differ. Raises InputError where there are too many to tell apart."""
    if number > MOST:
        raise InputError(f"{number} curves in one picture cannot be told apart", hint=f"allowed: {MOST}")
    return [Line(COLOURS[i % len(COLOURS)], DASHES[i // len(COLOURS)]) for i in range(number)]


def label_right(
    ax: Axes, names: Sequence[str], x: Sequence[float], y: Sequence[float], colors: Sequence[str]
) -> None:
    """Write each name to the right of the axes, with a line to its curve's end (x, y) in the data.

    Where that is well within the axes, the name stands beside it. The limits and scales of the axes are those
    that stay, and all lines are drawn.
    """
    at = (ax.transData + ax.transAxes.inverted()).transform(np.column_stack([x, y]))
    figure: Any = ax.figure
    height = figure.get_figheight() * ax.get_position().height  # before the layout, which changes little
    right = at[:, 0] > _RIGHT
    places = spread(np.clip(at[right, 1], 0, 1), _LINE / height)
    for i, place in zip(np.flatnonzero(right).tolist(), places, strict=True):
        end = float(np.clip(at[i, 0], 0, 1)), float(np.clip(at[i, 1], 0, 1))
        tie = {"arrowstyle": "-", "color": colors[i], "lw": 0.8, "ls": ":", "shrinkA": 1, "shrinkB": 0}
        ax.annotate(
            short(names[i]), end, (1.03, float(place)), xycoords="axes fraction",
            textcoords="axes fraction", va="center", fontsize=9, color=_dark(colors[i]),
            arrowprops={**tie, "relpos": (0, 0.5)}, annotation_clip=False, parse_math=False,
        )  # fmt: skip
    if right.all():
        return
    figure.draw_without_rendering()  # for the axes' place
    room = Room(ax)
    for line in ax.lines:
        room.line(line)
    for i in np.flatnonzero(~right).tolist():
        style: dict[str, Any] = {"size": 9, "color": _dark(colors[i]), "path_effects": HALO, "zorder": 5}
        beside(room, ax, short(names[i]), x[i], y[i], needed=True, **style)


def spread(wanted: Floats, apart: float) -> Floats:
    """Places near those that are wanted, in their order, none closer than ``apart``: least squares.

    Neighbours that are too close become blocks around their mean, which merge where they meet.
    """
    order = np.argsort(wanted, kind="stable")
    blocks: list[list[float]] = []  # each: sum of wanted starts, number
    for place in wanted[order]:
        blocks.append([float(place), 1])
        while (
            len(blocks) > 1 and _start(blocks[-1], apart) < _start(blocks[-2], apart) + apart * blocks[-2][1]
        ):
            total, number = blocks.pop()
            first = blocks[-1]
            first[0] += total - apart * first[1] * number
            first[1] += number
    sorted_ = np.concatenate(
        [_start(block, apart) + apart * np.arange(int(block[1])) for block in blocks] or [np.empty(0)]
    )
    places = np.empty(len(wanted))
    places[order] = sorted_
    return places


def _start(block: list[float], apart: float) -> float:
    """Where a block of places starts whose members want to be, on the mean, at its first one's place."""
    return block[0] / block[1]


def _dark(color: str) -> tuple[float, ...]:
    rgb = np.array([int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    return tuple(rgb * min(1.0, 0.5 / float(rgb @ (0.299, 0.587, 0.114))))
