"""Lines of pictures, and what the legend says of them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from bikestab.bicycle import Bicycle
from bikestab.geometry import trail_from
from bikestab.model import Floats
from bikestab.plot.headings import text_width

# what bounds the stable region, by the condition that is zero there: its name and its line
EDGES: dict[str, tuple[str, Any]] = {"hurwitz3": ("weave", "-"), "p0": ("capsize", (0, (5, 1.5)))}
_LONG = 3  # rows of a legend that is set smaller where that halves them
_SPACING, _TO_TEXT, _MARGIN = 1.6, 0.8, 0.9  # em: of a legend's columns, handles and frame

STRAIGHT: dict[str, Any] = {"color": "0.25", "lw": 1.2, "ls": (0, (7, 2, 1, 2))}  # where the fork is straight


def draw_on_white(
    ax: Axes, curves: Iterable[Sequence[Floats]], *, lw: float, rim: bool = True, **style: Any
) -> None:
    """Curves (x, y) that can be read on any colour: each has a white rim, and no rim covers a curve."""
    curves = list(curves)
    for x, y in curves if rim else ():
        ax.plot(x, y, color="white", lw=lw + 2, alpha=0.8, solid_capstyle="round", zorder=style.get("zorder"))
    for x, y in curves:
        ax.plot(x, y, lw=lw, **style)


def straight_fork(ax: Axes, bicycle: Bicycle, *, rim: bool = True) -> list[Line2D]:
    """The line in axes of λ and σ where the fork offset b is zero; what the legend says of it, if drawn."""
    lam, sigma = straight_designs(bicycle, ax.get_xlim(), ax.get_ylim())
    if np.isnan(sigma).all():
        return []
    draw_on_white(ax, [(lam, sigma)], rim=rim, **STRAIGHT)
    return [straight_entry()]


def straight_designs(
    bicycle: Bicycle, lam: tuple[float, float], sigma: tuple[float, float]
) -> tuple[Floats, Floats]:
    """λ and σ of the designs in a box whose fork offset b is zero: σ = R2 tan λ / c; NaN outside.

    Above this line forks are bent backwards, below it forwards.
    """
    x = np.linspace(*lam, 241)
    y = trail_from(x, 0.0, bicycle.R2) / bicycle.c
    return x, np.where((sigma[0] <= y) & (y <= sigma[1]), y, np.nan)


def straight_entry(forwards: str = "below") -> Line2D:
    """The legend's entry for this line, beside which forks are bent ``forwards``."""
    return entry(f"fork offset b = 0 ({forwards}: forwards)", **STRAIGHT)


def entry(label: str, *, lw: float = 1.8, **style: Any) -> Line2D:
    """A legend's entry for a line."""
    return Line2D([], [], label=label, lw=lw, **style)


def legend_below(figure: Figure, handles: Sequence[Artist], **style: Any) -> int:
    """The legend under the axes, none without entries, in columns that fit; how many rows it has."""
    if not handles:
        return 0
    style = {"handlelength": 3, "fontsize": 10, **style}
    columns = _columns(handles, figure.get_figwidth(), style["handlelength"], style["fontsize"])
    if columns == 1 and len(handles) > _LONG:
        style |= {"handlelength": 2, "fontsize": 9}
        columns = _columns(handles, figure.get_figwidth(), 2, 9)
    figure.legend(
        handles=list(handles), loc="outside lower center", ncols=columns, frameon=False,
        columnspacing=_SPACING, **style,
    )  # fmt: skip
    return -(-len(handles) // columns)


def _columns(handles: Sequence[Artist], width: float, handlelength: float, size: float) -> int:
    """As many columns as fit a width [inches]."""
    em = size / 72
    widths = [
        text_width(str(handle.get_label()), size) + (handlelength + _TO_TEXT) * em for handle in handles
    ]
    for columns in range(len(handles), 1, -1):
        parts = [max(part) for part in np.array_split(widths, columns)]
        if sum(parts) + ((columns - 1) * _SPACING + 2 * _MARGIN) * em < width:
            return columns
    return 1
