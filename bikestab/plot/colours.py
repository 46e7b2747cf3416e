"""The colours of fields in a plane, with their bars: the growth rate and the probability of stability."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import FuncNorm, LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, NullLocator

from bikestab.model import Floats
from bikestab.plot.lines import entry

# dark blue, white at zero, orange of middle lightness: the two sides differ in greyscale too
GROWTH = LinearSegmentedColormap.from_list(
    "growth", ["#08306b", "#2f79b5", "#a6cbe3", "#ffffff", "#fddbb0", "#f5a35c", "#d9762b"]
)


# white where no machine is stable, and as blue as what is stable above where all are; black can be read on it
PROBABILITY = LinearSegmentedColormap.from_list("probability", ["#ffffff", "#a6cbe3", "#4a94cb"])
OWN = "#e8308a"  # the bicycle's own design
_SHARE = "#a50026"  # of the machines: read on white and on blue

# one scale for every picture, equal on both sides of zero: linear below the first [1/s], logarithmic above
_LINEAR, _END = 0.05, 5.0
_TICKS = (0.1, 0.3, 1.0)
# shares of machines, and their lines; the middle one is wide, for the bicycle as it stands lies on it
_SHARES: dict[float, dict[str, Any]] = {
    0.05: {"ls": (0, (1, 1.2)), "lw": 1.4},
    0.5: {"ls": "-", "lw": 4.5, "alpha": 0.45},
    0.95: {"ls": (0, (4, 1.2, 1, 1.2)), "lw": 1.4},
}


def colour_growth_rate(figure: Figure, ax: Axes, x: Floats, y: Floats, values: Floats) -> Axes:
    """Draw the growth rate; the axes of its colour bar."""
    norm = FuncNorm((_forward, _inverse), vmin=-_END, vmax=_END)
    image = ax.pcolormesh(
        x, y, np.ma.masked_invalid(values), norm=norm, cmap=GROWTH, shading="nearest", rasterized=True
    )
    ax.set_facecolor("0.6")  # where an eigenvalue is infinite
    bar = figure.colorbar(image, ax=ax)
    bar.set_label(f"growth rate [s⁻¹], logarithmic beyond ±{_LINEAR:g}", fontsize=9)
    ticks = sorted({0.0, *(sign * tick for tick in (*_TICKS, _END) for sign in (-1, 1))})
    bar.ax.yaxis.set_major_locator(FixedLocator(ticks))
    bar.ax.yaxis.set_minor_locator(NullLocator())
    names = [f"{tick:g}".replace("-", "−") for tick in ticks]
    names[0], names[-1] = f"≤{names[0]}", f"≥{names[-1]}"
    bar.ax.set_yticklabels(names)
    bar.ax.axhline(0, color="k", lw=1.2)
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(y[0], y[-1])
    return bar.ax


def _forward(rate: Floats) -> Floats:
    return np.arcsinh(np.asarray(rate) / _LINEAR) / np.arcsinh(_END / _LINEAR)


def _inverse(part: Floats) -> Floats:
    return _LINEAR * np.sinh(np.asarray(part) * np.arcsinh(_END / _LINEAR))


def colour_probability(figure: Figure, ax: Axes, x: Floats, y: Floats, values: Floats, samples: int) -> Axes:
    """Draw the probability of stability, and where it is 5, 50 and 95 %; the axes of its colour bar."""
    image = ax.pcolormesh(x, y, values, vmin=0, vmax=1, cmap=PROBABILITY, shading="nearest", rasterized=True)
    bar = figure.colorbar(image, ax=ax)
    bar.set_label(f"probability ({samples} machines)")
    for share, style in _SHARES.items():
        if _crossed(values, share):
            lines = ax.contour(x, y, values, levels=[share], colors=[_SHARE], zorder=1.8)
            lines.set(**style)
            bar.ax.axhline(share, color=_SHARE, **style)
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(y[0], y[-1])
    return bar.ax


def shares(values: Floats) -> list[Line2D]:
    """What the legend says of the curves of equal probability."""
    return [
        entry(f"{share:.0%} of machines".replace("%", " %"), color=_SHARE, **style)
        for share, style in _SHARES.items()
        if _crossed(values, share)
    ]


def _crossed(values: Floats, share: float) -> bool:
    return min(values.shape) > 1 and bool(values.min() < share < values.max())
