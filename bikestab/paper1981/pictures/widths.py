"""Conclusion 2: the width of the widest interval along both axes of the box."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.bicycle import Bicycle
from bikestab.model import Floats
from bikestab.paper1981.box import LAM, SIGMA, V
from bikestab.paper1981.pictures.places import TITLE, place
from bikestab.paper1981.widening import LAMS, SIGMAS, widest
from bikestab.plot.axes import label_axes
from bikestab.plot.settings import own_settings

_LEAST_RATIO = 1.2  # of two names' widths: a line of text
_TICKS = [0.1, 0.2, 0.5, 1, 2, 5, 10]  # m/s


@own_settings()
def draw_widths(bicycle: Bicycle, samples: int) -> Figure:
    """The width of the widest interval along λ at several σ, and along σ at several λ."""
    figure = Figure(figsize=(11, 4.8))
    left, right = figure.subplots(1, 2)
    x, y = np.linspace(*LAM, 2 * samples), np.linspace(*SIGMA, 2 * samples)
    _lines(left, x, {f"σ = {sigma:.2f}": widest(bicycle, x, sigma) for sigma in SIGMAS})
    _lines(right, y, {f"λ = {lam:.2f}": widest(bicycle, lam, y) for lam in LAMS})
    for ax, name in ((left, "lam"), (right, "sigma")):
        label_axes(ax, name, "V", bicycle.c)
        ax.set_ylabel(f"width of the widest interval up to {V[1]:g} m/s [m/s]")
    figure.suptitle(f"{bicycle.name}: how the width depends on tilt and trail", y=TITLE, fontsize=11)
    place(figure, "widths")
    return figure


def _lines(ax: Axes, x: Floats, widths: dict[str, Any]) -> None:
    colours = colormaps["viridis"](np.linspace(0, 0.85, len(widths)))
    ends: list[tuple[float, float, str, Any]] = []
    for (label, width), colour in zip(widths.items(), colours, strict=True):
        ax.plot(x, np.where(width > 0, width, np.nan), color=colour, lw=1.7)
        ends.append((float(x[-1]), float(width[-1]), label, colour))
    ax.set(xlim=(x[0], x[-1]), ylim=(0.1, 1.15 * V[1]), yscale="log")
    ax.set_yticks(_TICKS, labels=[f"{tick:g}" for tick in _TICKS])
    ax.minorticks_off()
    ax.grid(color="0.9", lw=0.6)
    _label_ends(ax, ends)


def _label_ends(ax: Axes, ends: list[tuple[float, float, str, Any]]) -> None:
    """Names beside the curves' right ends, no closer than a line of text."""
    lowest = 0.0
    for x, y, name, colour in sorted(ends, key=lambda end: end[1]):
        lowest = max(y, lowest * _LEAST_RATIO)
        line = {"arrowstyle": "-", "color": colour, "lw": 0.6, "shrinkA": 0, "shrinkB": 0, "relpos": (0, 0.5)}
        ax.annotate(
            name, (x, y), (1.03 * x, lowest), color=colour, va="center", fontsize=9, annotation_clip=False,
            arrowprops=line,
        )  # fmt: skip
