"""Names of curves at the right edge of a picture, apart from each other, tied to where the curves end."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from bikestab.errors import InputError
from bikestab.model import Floats
from bikestab.plot.axes import HALO
from bikestab.plot.headings import ROW, in_rows
from bikestab.plot.placing import Room, beside
from bikestab.widths import columns

# Tol 2021, bright, without its grey; the dashes change with the colours, for greyscale, and differ from each
# other where curves lie on each other: in the gaps of one the one below is seen
COLOURS = ("#4477AA", "#EE6677", "#228833", "#AA3377", "#CCBB44", "#66CCEE")
DASHES = (
    "-", (0, (5, 2)), (0, (1.2, 1.4)), (0, (7, 1.6, 1.4, 1.6)), (0, (2.6, 1.2)),
    (0, (5, 1.3, 1.2, 1.3, 1.2, 1.3)),
)  # fmt: skip
MARKERS = ("o", "s", "^", "D", "v", "P", "X")  # one more than there are colours
MOST = 24
_RIGHT = 0.9  # of the axes' width: where what ends is named at their side
_LINE = 13 / 72  # inches of a line of text
_SAME = 1.0  # points between curves that lie on each other, at most
_SAMPLES = 201  # of a curve, to compare it with others


class Line(NamedTuple):
    """What a curve, or a mark of the same machine, looks like."""

    color: str
    ls: object
    marker: str = "o"


class Curve(NamedTuple):
    """Whose curve it is, its points in the data, ordered by x, its colour, and what it is of each."""

    name: str
    x: Floats
    y: Floats
    color: str
    what: str = ""


def lines_for(number: int) -> list[Line]:
    """As many kinds of lines that differ. Raises InputError where there are too many to tell apart."""
    if number > MOST:
        raise InputError(f"{number} curves in one picture cannot be told apart", hint=f"allowed: {MOST}")
    n = len(COLOURS)
    return [Line(COLOURS[i % n], DASHES[(i + i // n) % n], MARKERS[i % len(MARKERS)]) for i in range(number)]


def label_curves(ax: Axes, curves: Sequence[Curve]) -> None:
    """Write each curve's name beside its end; of curves that lie on each other the names stand together.

    A curve without any finite point has no end, and so no name.
    The limits and scales of the axes are those that stay, and all lines are drawn.
    """
    curves = [curve for curve in curves if np.isfinite(curve.y).any()]
    if not curves:
        return
    names, x, y, colors = [], [], [], []
    for group in _together(ax, curves):
        first = curves[group[0]]
        names.append(_in_rows(first.what, [in_rows(curves[i].name) for i in group]))
        end = _end(first)
        x.append(end[0])
        y.append(end[1])
        colors.append(first.color)
    _write(ax, names, x, y, colors)


def _together(ax: Axes, curves: Sequence[Curve]) -> list[list[int]]:
    """The numbers of the curves, together those that lie on each other wherever both are, to the end."""
    figure: Any = ax.figure
    size = figure.get_size_inches() * ax.get_position().size * 72
    to_points = ax.transData + ax.transAxes.inverted()
    common = np.linspace(*ax.get_xlim(), _SAMPLES)
    places = []
    for curve in curves:
        y = (
            np.interp(common, curve.x, curve.y, np.nan, np.nan)
            if len(curve.x) > 1
            else np.full(_SAMPLES, np.nan)
        )
        at = to_points.transform(np.column_stack([common, y]))[:, 1]
        end = to_points.transform(_end(curve))
        places.append(np.array([*(at * size[1]), *(end * size)]))
    groups: list[list[int]] = []
    for i, place in enumerate(places):
        for group in groups:
            apart = abs(places[group[0]] - place)  # NaN where one of them is not there
            same = curves[group[0]].what == curves[i].what and max(apart[-2:]) <= _SAME
            if same and not np.nanmax(apart) > _SAME:
                group.append(i)
                break
        else:
            groups.append([i])
    return groups


def _end(curve: Curve) -> tuple[float, float]:
    """The last finite point of a curve."""
    last = np.flatnonzero(np.isfinite(curve.y))[-1]
    return float(curve.x[last]), float(curve.y[last])


def _in_rows(what: str, names: Sequence[str]) -> str:
    """What curves are, and whose: names behind each other, as many in a row as there is room for."""
    rows = [f"{what}: "] if what else [""]
    for i, name in enumerate(names):
        part = name if i == len(names) - 1 else f"{name}, "
        if rows[-1] and columns(rows[-1] + part) > ROW and i:
            rows.append("")
        rows[-1] += part
    return "\n".join(row.strip() for row in rows)


def _write(
    ax: Axes, names: Sequence[str], x: Sequence[float], y: Sequence[float], colors: Sequence[str]
) -> None:
    """Write each name to the right of the axes, with a line to its curve's end (x, y) in the data.

    Where that is well within the axes, the name stands beside it.
    """
    at = (ax.transData + ax.transAxes.inverted()).transform(np.column_stack([x, y]))
    figure: Any = ax.figure
    height = figure.get_figheight() * ax.get_position().height  # before the layout, which changes little
    right = at[:, 0] > _RIGHT
    beside_axes = np.flatnonzero(right).tolist()
    inches = np.array([_LINE * (1 + names[i].count("\n")) for i in beside_axes])
    if inches.sum() > height:  # all names have room beside the axes
        figure.set_figheight(figure.get_figheight() * inches.sum() / height)
        height = inches.sum()
    places = spread(np.clip(at[right, 1], 0, 1), inches / height)
    for i, place in zip(beside_axes, places, strict=True):
        end = float(np.clip(at[i, 0], 0, 1)), float(np.clip(at[i, 1], 0, 1))
        tie = {"arrowstyle": "-", "color": colors[i], "lw": 0.8, "ls": ":", "shrinkA": 1, "shrinkB": 0}
        ax.annotate(
            names[i], end, (1.03, float(place)), xycoords="axes fraction",
            textcoords="axes fraction", va="center", fontsize=9, color=dark(colors[i]),
            arrowprops={**tie, "relpos": (0, 0.5)}, annotation_clip=False, parse_math=False,
        )  # fmt: skip
    if right.all():
        return
    figure.draw_without_rendering()  # for the axes' place
    room = Room(ax)
    for line in ax.lines:
        room.line(line)
    for i in np.flatnonzero(~right).tolist():
        style: dict[str, Any] = {"size": 9, "color": dark(colors[i]), "path_effects": HALO, "zorder": 5}
        beside(room, ax, names[i], x[i], y[i], needed=True, **style)


def spread(wanted: Floats, heights: Floats | float) -> Floats:
    """Places near those that are wanted, in their order, of boxes of these heights that do not overlap.

    Least squares: boxes that would overlap become blocks, each in the middle of where its boxes would be, or
    as near to it as they all are from 0 to 1, if they can.
    """
    order = np.argsort(wanted, kind="stable")
    half = 0.5 * np.broadcast_to(heights, wanted.shape)[order]
    above = np.concatenate([[0.0], np.cumsum(half[1:] + half[:-1])])[: len(wanted)]
    blocks: list[list[float]] = []  # each: sum, without the boxes below, of what is wanted; number
    for start in wanted[order] - above:
        blocks.append([float(start), 1])
        while len(blocks) > 1 and blocks[-1][0] / blocks[-1][1] < blocks[-2][0] / blocks[-2][1]:
            total, number = blocks.pop()
            blocks[-1][0] += total
            blocks[-1][1] += number
    places = np.empty(len(wanted))
    if blocks:
        means = np.concatenate([np.full(int(number), total / number) for total, number in blocks])
        places[order] = np.clip(means, half[0], max(1 - half[-1] - above[-1], half[0])) + above
    return places


def dark(color: str) -> tuple[float, ...]:
    """A colour that can be read as text on white."""
    rgb = np.array([int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    return tuple(rgb * min(1.0, 0.5 / float(rgb @ (0.299, 0.587, 0.114))))
