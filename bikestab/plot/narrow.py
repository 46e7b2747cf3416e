"""Words that point to stable regions too narrow for their dots to be seen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import numpy as np
from contourpy import FillType, contour_generator
from matplotlib.axes import Axes
from matplotlib.path import Path
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.plot.axes import HALO

_WIDTH = 0.09  # inches, on the mean: dots are so far apart
_MOST = 3  # words in a picture
_HALF = np.array([0.24, 0.08])  # of a word [inches]
_SIDES = [
    np.array([x, y]) for x in (0.62, -0.62, 0.0) for y in (0.24, -0.24, 0.42, -0.42)
]  # inches, of a word
_CORNERS = [_HALF * [x, y] for x in (-1, 0, 1) for y in (-1, 0, 1)]


def point_to_narrow(
    ax: Axes, X: Floats, Y: Floats, inside: NDArray[np.bool_], curves: Sequence[tuple[Floats, Floats]]
) -> None:
    """Write "stable" beside each narrow part of what is ``inside`` (y, x), the widest first.

    Where no sample is, but a boundary, beside the middle of its longest curve.
    """
    size = _inches(ax)
    outlines = _outlines(X, Y, inside)
    low, scale = np.array([X[0], Y[0]]), np.array([np.ptp(X), np.ptp(Y)])
    samples = np.argwhere(inside.T) / [len(X) - 1, len(Y) - 1]
    narrow = []
    for outline in ((each - low) / scale for each in outlines):
        x, y = (outline * size).T
        area = abs(float(np.dot(x[:-1], np.diff(y)) - np.dot(y[:-1], np.diff(x)))) / 2
        if area < _WIDTH * float(np.hypot(np.diff(x), np.diff(y)).sum()) / 2:
            narrow.append((area, _deepest(outline, samples, size)))
    drawn = np.concatenate([*((np.column_stack(each) - low) / scale for each in curves), np.empty((0, 2))])
    if not outlines and curves:
        narrow.append((0.0, drawn[len(drawn) // 2]))
    busy = np.concatenate([drawn, samples])
    for _, place in sorted(narrow, key=lambda each: -each[0])[:_MOST]:
        word = min((place + side / size for side in _SIDES), key=lambda at: _covered(at, busy, size))
        busy = np.vstack([busy, *(word + corner / size for corner in _CORNERS for _ in range(1000))])
        _point(ax, place, word)


def _deepest(outline: Floats, samples: Floats, size: Floats) -> Floats:
    """The sample within an outline that is furthest from it, of equal ones the nearest to their middle."""
    own = samples[Path(outline).contains_points(samples)]
    if not len(own):
        return np.asarray(outline.mean(axis=0))
    apart = [np.hypot(*((outline - each) * size).T).min() for each in own]
    far = own[np.asarray(apart) >= 0.999 * np.max(apart)]
    return np.asarray(far[np.argmin(np.hypot(*((far - own.mean(axis=0)) * size).T))])


def _outlines(X: Floats, Y: Floats, inside: NDArray[np.bool_]) -> list[Floats]:
    """The closed outer boundary (n, 2) of each part."""
    if not inside.any():
        return []
    found = contour_generator(X, Y, inside.astype(float), fill_type=FillType.OuterOffset).filled(0.5, 1.5)
    points, offsets = cast("tuple[list[Floats], list[Any]]", found)
    return [each[: offset[1]] for each, offset in zip(points, offsets, strict=True)]


def _inches(ax: Axes) -> Floats:
    figure: Any = ax.figure
    return np.asarray(figure.get_size_inches() * ax.get_position().size)


def _covered(word: Floats, busy: Floats, size: Floats) -> float:
    """How much of what is there, in shares of the axes, a word covers, and how far it is out of them."""
    half = _HALF / size
    outside = np.maximum(np.abs(word - 0.5) + half - 0.5, 0).sum()
    return float(np.count_nonzero((np.abs(busy - word) < 1.2 * half).all(axis=1)) + 1e6 * outside)


def _point(ax: Axes, place: Floats, word: Floats) -> None:
    ax.annotate(
        "stable", tuple(place), tuple(word), xycoords="axes fraction", textcoords="axes fraction",
        ha="center", va="center", path_effects=HALO, zorder=6,
        arrowprops={"arrowstyle": "-|>", "color": "black", "lw": 1, "shrinkA": 1, "shrinkB": 0},
    )  # fmt: skip
