"""The lengths and angles of the paper's figures 1 and 2, on the side view."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.bicycle import Bicycle
from bikestab.paper1981.pictures.places import place
from bikestab.plot.placing import AROUND
from bikestab.plot.settings import own_settings
from bikestab.plot.side import Words, side_axes, write_words

PITCH = 0.15  # rad: φ0, by which the frame's line is turned down; the paper gives none, and no result has it
_COLOUR = "#00795a"


@own_settings()
def draw_machine(bicycle: Bicycle, lam: float, sigma: float) -> Figure:
    """The side view with the block before (1.2) too: φ0; α, β to M1; L, d1 and d to M2."""
    figure = Figure(figsize=(6.2, 5.0))
    ax = figure.add_subplot()
    words = side_axes(ax, bicycle, lam, sigma)
    p, c1 = bicycle, sigma * bicycle.c * math.cos(lam)
    wheel, along = np.array([0.0, p.R1]), np.array([math.cos(PITCH), -math.sin(PITCH)])
    L = (p.c * math.cos(lam) + c1 - p.R1 * math.sin(lam)) / math.cos(PITCH + lam)
    M1 = np.array([p.l1, p.h1])
    alpha = float((M1 - wheel) @ along)
    d = p.h2 * math.sin(lam) + (p.l2 - p.c) * math.cos(lam) - c1
    joint, foot = wheel + L * along, wheel + alpha * along
    beside = np.array([p.l2, p.h2]) - d * np.array([math.cos(lam), math.sin(lam)])
    words += [
        _line(ax, wheel, joint, "L", 0.75), _line(ax, wheel, foot, "α", 0.6), _line(ax, foot, M1, "β", 0.5),
        _line(ax, joint, beside, "d1", 0.5),
    ]  # fmt: skip
    ax.plot([0, 0.72 * p.c], [p.R1] * 2, color=_COLOUR, lw=0.7, ls=":")
    radius = 0.55 * p.c
    angle = np.linspace(0, PITCH, 20)
    ax.plot(radius * np.cos(angle), p.R1 - radius * np.sin(angle), color=_COLOUR, lw=0.9)
    words.append(Words("φ0", (float(radius), float(p.R1 - 0.05 * p.c)), AROUND, _COLOUR))
    place(figure, "machine")
    write_words(ax, words)
    return figure


def _line(ax: Axes, start: Any, stop: Any, name: str, part: float) -> Words:
    ax.plot(*zip(start, stop, strict=True), color=_COLOUR, lw=1.1, marker="o", ms=2.5)
    x, y = start + part * (stop - start)
    return Words(name, (float(x), float(y)), AROUND, _COLOUR)
