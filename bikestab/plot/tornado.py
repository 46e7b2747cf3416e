"""The tornado picture: by how much each parameter moves a result, the largest effects on top."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from bikestab.design.effects import Row
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import legend_below
from bikestab.plot.settings import own_settings

_COLORS = ("#004488", "#DDAA33")  # Tol 2021, high contrast
_LEAST, _SEEN = 0.005, 0.004  # %/%, and share of the largest: smaller bars are none to see
_PANEL, _BAR = 4.6, 0.24  # inches


class Bar(NamedTuple):
    """A parameter, its value and unit, and by how much one per cent more of it moves each result."""

    name: str
    value: float
    unit: str
    effects: tuple[float, ...]


class Panel(NamedTuple):
    """A machine, its bars, and what is said where it has none."""

    name: str
    bars: Sequence[Bar]
    none: str


def draw_tornado(machines: Sequence[tuple[str, Sequence[Row]]]) -> Figure:
    """One panel for each machine: its name, and the rows of one of its stable intervals.

    Bars are per cent of the speed for one per cent of the parameter. Parameters that move neither end by more
    than 0.005, or too little for a bar to be seen, are left out, as are measures of the front that are not in
    the bicycle's notation.
    """
    panels = []
    for name, rows in machines:
        bars = [
            Bar(
                row["name"], row["value"], row["unit"], (row["elasticity_V1"] or 0, row["elasticity_V2"] or 0)
            )
            for row in rows
            if row["notation"]
        ]
        bars = [bar for bar in bars if _size(bar) > max(_LEAST, _SEEN * max(map(_size, bars)))]
        panels.append(Panel(name, bars, "no stable speed"))
    return draw_bars(panels, "% of the speed for 1 % more", ("V₁", "V₂"))


@own_settings()
def draw_bars(panels: Sequence[Panel], words: str, results: Sequence[str] = ("",)) -> Figure:
    """One panel for each machine; ``words`` say what the bars measure, ``results`` what each colour is of."""
    most = max((len(panel.bars) for panel in panels), default=0)
    figure = Figure(figsize=(_PANEL * max(len(panels), 1), 1.4 + _BAR * max(most, 4)), layout="constrained")
    for i, panel in enumerate(panels):
        ax = figure.add_subplot(1, len(panels), i + 1)
        _draw(ax, panel, len(results))
        ax.set_xlabel(words)
        title = short(panel.name) if panel.bars else f"{short(panel.name)}: {panel.none}"
        set_title(ax, title, panels=len(panels))
    seen = [any(bar.effects[i] for panel in panels for bar in panel.bars) for i in range(len(results))]
    handles = [Patch(color=c, label=r) for r, c, some in zip(results, _COLORS, seen, strict=False) if some]
    legend_below(figure, handles if len(results) > 1 else [])
    return figure


def _draw(ax: Axes, panel: Panel, results: int) -> None:
    place, height = np.arange(len(panel.bars)), 0.8 / results
    for i, color in enumerate(_COLORS[:results]):
        at = place + height * (i - 0.5 * (results - 1))
        ax.barh(at, [bar.effects[i] for bar in panel.bars], height=height, color=color)
    ax.axvline(0, color="0.2", lw=0.8)
    ax.set_yticks(place, [_label(bar) for bar in panel.bars])
    ax.set_ylim(max(len(panel.bars), 1) - 0.5, -0.5)
    ax.locator_params(axis="x", nbins=5)
    ax.grid(axis="x", color="0.9")
    ax.set_axisbelow(True)


def _size(bar: Bar) -> float:
    return max(map(abs, bar.effects))


def _label(bar: Bar) -> str:
    value = f"{bar.value:.4g}".replace("-", "−")
    return f"{bar.name} = {value}{'' if bar.unit == '1' else f' {bar.unit}'}"
