"""Where things stand in pictures of planes and of the region, from the sizes of their texts.

matplotlib's own layouts draw every text twice to measure it, which takes longer than the picture. These texts
are numbers and titles of size 10 in one font, whose widths are known.
"""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure

from bikestab.plot.ticks import plain_numbers

_EM = 10 / 72  # inches
_NARROW, _WIDE, _DIGIT = 0.318, 0.838, 0.636  # em: the letters of DejaVu Sans
_LETTERS = {".": _NARROW, "−": _WIDE, "-": 0.361, "×": _WIDE, "+": _WIDE}
_EDGE = 0.042  # inches, as all below
_BESIDE = 0.29  # between an axis and the outer side of its label, without the ticks' numbers
_UNDER = 0.431  # the same below the axes
_ABOVE = 0.398  # the same above them, numbers and all
_ROW, _FIRST_ROW = 0.167, 0.12  # of a title
_ENTRY_ROW, _ENTRIES = 0.209, 0.125  # of a legend, and its margins
_BAR, _TO_BAR = 0.18, 0.25  # width of a colour bar; from what is left of it
_TITLE = 6 / 72  # between a title and what is below it
_LABEL = 0.06  # of axes in three dimensions, whose labels reach below
_EMPTY = 0.38  # of axes in three dimensions, above the box


def title_place(ax: Axes) -> dict[str, Any]:
    """Where a title stands: above the axes and a second axis there."""
    return {"y": 1.0, "pad": 72 * (_above(ax) + _TITLE)}


def arrange_plane(figure: Figure, ax: Axes, bar: Axes | None, rows: int, above: float = 0.0) -> None:
    """Put axes with a title, their colour bar if any, and a legend of so many rows into a figure.

    ``above`` is the height [inches] of what is between the axes and their title.
    """
    plain_numbers(figure)
    width, height = figure.get_size_inches()
    x0 = _EDGE + _BESIDE + _numbers(ax.yaxis)
    y0 = _legend(rows) + _UNDER
    y1 = height - _title(ax) - _above(ax) - above
    x1 = width - _EDGE
    if bar:
        x1 -= _BESIDE + _numbers(bar.yaxis) + _BAR
        bar.set_aspect("auto")
        bar.set_position((x1 / width, y0 / height, _BAR / width, (y1 - y0) / height))
    second = [child for child in ax.child_axes if child.get_ylabel()]
    for child in second:
        x1 -= _BESIDE + _numbers(child.yaxis)
    x1 -= _TO_BAR if bar or not second else 0.0
    ax.set_position((x0 / width, y0 / height, (x1 - x0) / width, (y1 - y0) / height))
    ax.title.set_x((width / 2 - x0) / (x1 - x0))  # in the middle of the picture, where long ones fit


def arrange_region(figure: Figure, ax: Axes, rows: int) -> None:
    """Put a box in three dimensions, with a title, and a legend of so many rows into a figure."""
    width, height = figure.get_size_inches()
    y0 = _legend(rows) + _LABEL
    side = min(height - _title(ax) - y0 + _EMPTY, width - 2 * _EDGE)
    ax.set_position(((width - side) / 2 / width, y0 / height, side / width, side / height))
    ax.title.set_y((height - _title(ax) - y0) / side)


def _above(ax: Axes) -> float:
    """The height of a second axis above the axes."""
    return _ABOVE if any(child.get_xlabel() for child in ax.child_axes) else 0.0


def _title(ax: Axes) -> float:
    """The height of a title with what is around it."""
    rows = ax.get_title().count("\n")
    return _EDGE + _FIRST_ROW + _ROW * rows + _TITLE


def _legend(rows: int) -> float:
    """The height of a legend with what is around it."""
    return _EDGE + (rows * _ENTRY_ROW + _ENTRIES if rows else 0.0)


def _numbers(axis: Axis) -> float:
    """The width of the widest number beside an axis."""
    return _EM * max(map(_width, (label.get_text() for label in axis.get_ticklabels())), default=0.0)


def _width(text: str) -> float:
    """In em."""
    return sum(_LETTERS.get(letter, _DIGIT) for letter in text)
