"""Curves with ticks on the side where conditions hold, in the paper's manner."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import TickedStroke

from bikestab.fields import Axis
from bikestab.model import Floats
from bikestab.paper1981.box import LAM, SIGMA, Range, V
from bikestab.region.section import Section
from bikestab.routh import conditions

ENDS: dict[Axis, Range] = {"lam": LAM, "sigma": SIGMA, "V": V}
TICKS: dict[str, Any] = {"spacing": 34, "angle": 60, "length": 0.22}
_ASIDE = 2e-3  # of the axes: how far beside a curve its two sides are looked at


def draw_ticked(
    ax: Axes, section: Section, names: Sequence[str], x: Floats, y: Floats, *, color: Any, ls: Any
) -> None:
    """A curve with ticks on the side where the conditions ``names`` hold."""
    x, y = oriented(section, names, x, y)
    ax.plot(x, y, color=color, lw=1.7, ls=ls, solid_capstyle="round")
    ax.plot(x, y, color=color, lw=0.9, path_effects=[TickedStroke(**TICKS)])


def oriented(section: Section, names: Sequence[str], x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """The curve in the direction that has the points where the conditions hold at its left."""
    width, height = (ENDS[name][1] - ENDS[name][0] for name in section.axes)
    along = np.gradient(x / width), np.gradient(y / height)
    length = np.maximum(np.hypot(*along), 1e-300)
    aside = _ASIDE * width * along[1] / length, _ASIDE * height * along[0] / length
    left = _held(section, names, x - aside[0], y + aside[1])
    right = _held(section, names, x + aside[0], y - aside[1])
    return (x, y) if np.sum(left) >= np.sum(right) else (x[::-1], y[::-1])


def _held(section: Section, names: Sequence[str], x: Floats, y: Floats) -> Any:
    values = conditions(*section.table_and_speed(x, y))._asdict()
    return np.all([values[name] > 0 for name in names], axis=0)
