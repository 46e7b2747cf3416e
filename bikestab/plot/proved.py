"""What is proved in a plane of a volume: its cells, their colours, and what the legend says of them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch
from numpy.typing import NDArray

from bikestab.errors import InputError
from bikestab.fields import Axis
from bikestab.model import Floats
from bikestab.volume import Subject, Volume

# dark, light and white, as in pictures of the growth rate: told apart by their lightness alone
_KINDS = (("undecided", "#ffffff"), ("proved stable", "#2f79b5"), ("proved unstable", "#fbc98e"))


def proved_in_plane(volume: Subject, fixed: Axis, value: float) -> NDArray[np.uint8]:
    """What is proved of the cells that a plane cuts, at (y, x); between two layers whatever is of either.

    Raises InputError for a volume without proofs.
    """
    if not isinstance(volume, Volume) or "certified" not in volume.file:
        hint = "'bikestab scan --certify' of its config writes them"
        raise InputError("has no proofs", place=str(volume.path), hint=hint)
    axis, at = volume.axis(fixed), volume.axes.index(fixed)
    last = max(len(axis) - 2, 0)
    layers = {min(max(int(np.searchsorted(axis, value, side)) - 1, 0), last) for side in ("left", "right")}
    where: list[int | slice] = [slice(None)] * 3
    found = []
    for where[at] in sorted(layers):
        found.append(volume.read("certified", tuple(where)).T)
    return np.maximum.reduce(found)  # all points of a cell are proved, so that no two layers differ in what


def colour_proved(ax: Axes, x: Floats, y: Floats, cells: NDArray[np.uint8]) -> list[Patch]:
    """Draw the cells between values of x and y; what the legend says, with shares of the plane."""
    colours = [colour for _, colour in _KINDS]
    norm = BoundaryNorm(np.arange(len(colours) + 1) - 0.5, len(colours))
    ax.pcolormesh(x, y, cells, cmap=ListedColormap(colours), norm=norm, shading="flat", rasterized=True)
    ax.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    areas = np.outer(np.diff(y), np.diff(x)) / ((y[-1] - y[0]) * (x[-1] - x[0]))
    shares = _rounded([100 * float(areas[cells == kind].sum()) for kind in range(len(_KINDS))])
    (undecided, *proved) = (
        Patch(facecolor=colour, edgecolor="0.25", lw=0.8, label=f"{name}: {share} %")
        for (name, colour), share in zip(_KINDS, shares, strict=True)
    )
    return [*proved, undecided]


def _rounded(shares: Sequence[float]) -> list[str]:
    """Per cents that add to 100 as they are written, with a digit of the least at least."""
    least = min((share for share in shares if share > 0), default=1.0)
    digits = min(max(1, -math.floor(math.log10(least))), 6)
    ends = np.round(np.cumsum([0.0, *shares]), digits)
    return [f"{share:.{digits}f}".removesuffix(".0") for share in np.diff(ends)]
