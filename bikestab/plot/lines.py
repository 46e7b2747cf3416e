"""Lines of pictures, and what the legend says of them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from bikestab.model import Floats

# what bounds the stable region, by the condition that is zero there: its name and its line
EDGES: dict[str, tuple[str, Any]] = {"hurwitz3": ("weave", "-"), "p0": ("capsize", (0, (5, 1.5)))}


def draw_on_white(ax: Axes, curves: Iterable[Sequence[Floats]], *, lw: float, **style: Any) -> None:
    """Curves (x, y) that can be read on any colour: each has a white rim, and no rim covers a curve."""
    curves = list(curves)
    for x, y in curves:
        ax.plot(x, y, color="white", lw=lw + 2, alpha=0.8, solid_capstyle="round", zorder=style.get("zorder"))
    for x, y in curves:
        ax.plot(x, y, lw=lw, **style)


def entry(label: str, *, lw: float = 1.8, **style: Any) -> Line2D:
    """A legend's entry for a line."""
    return Line2D([], [], label=label, lw=lw, **style)


def legend_below(figure: Figure, handles: Sequence[Artist], ncols: int = 3, **style: Any) -> None:
    """The legend under the axes; none without entries."""
    if handles:
        figure.legend(
            handles=list(handles), loc="outside lower center", ncols=ncols, frameon=False,
            **{"handlelength": 3, **style},
        )  # fmt: skip
