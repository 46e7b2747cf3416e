"""The lengths and angles of the paper's figures 1 and 2, on the side view."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.bicycle import Bicycle
from bikestab.plot.axes import HALO
from bikestab.plot.settings import own_settings
from bikestab.plot.side import draw_side

PITCH = 0.15  # rad: φ0, by which the frame's line is turned down; the paper gives none, and no result has it
_COLOUR = "#00795a"


@own_settings()
def draw_machine(bicycle: Bicycle, lam: float, sigma: float) -> Figure:
    """The side view with the block before (1.2) too: φ0; α, β to M1; L, d1 and d to M2."""
    figure = draw_side(bicycle, lam, sigma)
    ax = figure.axes[0]
    p, c1 = bicycle, sigma * bicycle.c * math.cos(lam)
    wheel, along = np.array([0.0, p.R1]), np.array([math.cos(PITCH), -math.sin(PITCH)])
    L = (p.c * math.cos(lam) + c1 - p.R1 * math.sin(lam)) / math.cos(PITCH + lam)
    M1 = np.array([p.l1, p.h1])
    alpha = float((M1 - wheel) @ along)
    d = p.h2 * math.sin(lam) + (p.l2 - p.c) * math.cos(lam) - c1
    joint, foot = wheel + L * along, wheel + alpha * along
    beside = np.array([p.l2, p.h2]) - d * np.array([math.cos(lam), math.sin(lam)])
    _line(ax, wheel, joint, "L", 0.75)
    _line(ax, wheel, foot, "α", 0.6)
    _line(ax, foot, M1, "β", 0.5)
    _line(ax, joint, beside, "d1", 0.5)
    ax.plot([0, 0.72 * p.c], [p.R1] * 2, color=_COLOUR, lw=0.7, ls=":")
    radius = 0.55 * p.c
    angle = np.linspace(0, PITCH, 20)
    ax.plot(radius * np.cos(angle), p.R1 - radius * np.sin(angle), color=_COLOUR, lw=0.9)
    ax.text(1.02 * radius, p.R1 - 0.05 * p.c, "φ0", color=_COLOUR, va="center", path_effects=HALO)
    return figure


def _line(ax: Axes, start: Any, stop: Any, name: str, part: float) -> None:
    ax.plot(*zip(start, stop, strict=True), color=_COLOUR, lw=1.1, marker="o", ms=2.5)
    at = start + part * (stop - start)
    ax.annotate(
        name, at, (-3, 4), textcoords="offset points", color=_COLOUR, ha="right", path_effects=HALO, zorder=6
    )
