"""The tornado picture: by how much each parameter moves a result, the largest effects on top."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from bikestab.design.effects import Row
from bikestab.plot.headings import set_title
from bikestab.plot.lines import legend_below
from bikestab.plot.settings import own_settings
from bikestab.units import BUILDERS, as_built

_COLORS = ("#004488", "#DDAA33")  # Tol 2021, high contrast
_LEAST, _SEEN = 0.005, 0.006  # %/%, and share of the largest: smaller bars are none to see
_PANEL, _BAR, _ROW = 6.3, 0.24, 0.17  # inches: a panel's width, the height of a bar, and of a title's row
_HIGHEST = 7.8  # inches: with a caption on a page of A4
_FRONT = "measures of the front:"
_WHITE = {"facecolor": "white", "edgecolor": "none", "pad": 1}
_TITLE: dict[str, Any] = {"x": 1.0, "ha": "right", "multialignment": "center"}  # over the names too


class Bar(NamedTuple):
    """A parameter, its value and unit, and by how much one per cent more of it moves each result.

    Of a value of zero one per cent is nothing: ``slopes`` are the derivatives. What is of the ``front`` is no
    parameter of the machine's notation.
    """

    name: str
    value: float
    unit: str
    effects: tuple[float, ...]
    slopes: tuple[float, ...] = ()
    front: bool = False


class Panel(NamedTuple):
    """The title's lines, the bars, and what is said where there are none."""

    title: Sequence[str]
    bars: Sequence[Bar]
    none: str


def draw_tornado(title: Sequence[str], rows: Sequence[Row]) -> Figure:
    """The title's lines, and the rows of a stable interval: per cent of a speed for one of the parameter."""
    bars = [
        Bar(
            row["name"], row["value"], row["unit"],
            (row["elasticity_V1"] or 0.0, row["elasticity_V2"] or 0.0),
            (row["dV1"] or 0.0, row["dV2"] or 0.0), not row["notation"],
        )
        for row in rows
    ]  # fmt: skip
    words = "% of the speed for 1 % more\nwider interval: V₁ ←, V₂ →"
    return draw_bars(Panel(title, bars, "no stable speed"), words, ("V₁", "V₂"), "m/s", least=_LEAST)


@own_settings()
def draw_bars(
    panel: Panel, words: str, results: Sequence[str] = ("",), unit: str = "", *, least: float = 0.0
) -> Figure:
    """One machine; ``words`` say what the bars measure, ``results`` of what each colour is, in this ``unit``.

    The title names parameters whose bars are smaller than ``least`` or cannot be seen. Left out are measures
    of the front that say what another does, too.
    """
    shown = _shown(panel.bars, least)
    left = _left_out(panel.bars, shown, "%" if len(results) > 1 else unit)
    panel = panel._replace(bars=shown, title=[*panel.title, *left])
    figure = Figure(figsize=(_PANEL, 1.0), layout="constrained")
    ax = figure.add_subplot()
    bars = _draw(ax, panel, results, unit)
    ax.set_xlabel(words)
    first, *others = panel.title
    set_title(ax, first if panel.bars else f"{first}: {panel.none}", *others, **_TITLE)
    height = 1.5 + _BAR * max(bars, 4) + _ROW * ax.get_title().count("\n")
    figure.set_figheight(min(height, _HIGHEST))
    seen = [any(bar.effects[i] for bar in panel.bars) for i in range(len(results))]
    handles = [Patch(color=c, label=r) for r, c, some in zip(results, _COLORS, seen, strict=False) if some]
    legend_below(figure, handles if len(results) > 1 else [])
    return figure


def _shown(bars: Sequence[Bar], least: float) -> list[Bar]:
    least = max(least, _SEEN * max(map(_size, bars), default=0.0))
    own = [
        bar for bar in bars if not bar.front and (_size(bar) > least or (bar.value == 0 and any(bar.slopes)))
    ]
    shown = own.copy()
    for bar in bars:
        if bar.front and _size(bar) > least and not _said(bar, shown):
            shown.append(bar)
    return shown


def _said(bar: Bar, others: Sequence[Bar]) -> bool:
    return any(np.allclose(bar.effects, other.effects, atol=0) for other in others)


def _left_out(bars: Sequence[Bar], shown: Sequence[Bar], unit: str) -> list[str]:
    """A line of a title that names what has no bar, and how small its effects are."""
    own = [bar for bar in bars if not bar.front]
    left = [bar for bar in bars if bar not in shown and not (bar.front and _said(bar, own))]
    if not left:
        return []
    largest = max(map(_size, left))
    small = "without effect"
    if largest:
        digit = 10.0 ** math.floor(math.log10(largest))
        small = f"each at most {math.ceil(largest / digit) * digit:.1g} {unit}".strip()
    return [f"{len(left)} more, {small}: {', '.join(bar.name for bar in left)}"]


def _draw(ax: Axes, panel: Panel, results: Sequence[str], unit: str) -> int:
    """Bars in rows of axes, those of the front below; how many rows there are."""
    own = [bar for bar in panel.bars if not bar.front]
    names = [_label(bar) for bar in panel.bars]
    place, rows = np.arange(len(panel.bars)), np.arange(len(panel.bars))
    if len(own) < len(panel.bars):
        names.insert(len(own), _FRONT)
        place[len(own) :] += 1
        rows = np.arange(len(names))
    height = 0.8 / len(results)
    for i, color in enumerate(_COLORS[: len(results)]):
        at = place + height * (i - 0.5 * (len(results) - 1))
        ax.barh(at, [bar.effects[i] for bar in panel.bars], height=height, color=color)
    for row, bar in zip(place, panel.bars, strict=True):
        if bar.value == 0:
            style: dict[str, Any] = {"fontsize": 9, "va": "center", "bbox": _WHITE}
            ax.text(
                0.03, float(row), _of_zero(bar, results, unit), transform=ax.get_yaxis_transform(), **style
            )
    ax.axvline(0, color="0.2", lw=0.8)
    ax.set_yticks(rows, names)
    ax.set_ylim(max(len(names), 1) - 0.5, -0.5)
    ax.locator_params(axis="x", nbins=5)
    ax.grid(axis="x", color="0.9")
    ax.set_axisbelow(True)
    return len(names)


def _size(bar: Bar) -> float:
    return max(map(abs, bar.effects))


def _label(bar: Bar) -> str:
    return f"{bar.name} = {as_built(bar.value, bar.unit, 4)}".replace("-", "−")


def _of_zero(bar: Bar, results: Sequence[str], unit: str) -> str:
    """The effects of a unit of a parameter that is zero."""
    one, size = BUILDERS.get(bar.unit, (bar.unit, 1.0))
    effects = (f"{of} {slope / size:+.3g}" for of, slope in zip(results, bar.slopes, strict=True) if slope)
    return f"{', '.join(effects)} {unit} per {one}".replace("  ", " ").replace("-", "−").strip()
