"""The colours of fields in a plane, with their bars: the growth rate and the probability of stability."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import FuncNorm, LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from bikestab.model import Floats

# dark blue, white at zero, orange of middle lightness: the two sides differ in greyscale too
GROWTH = LinearSegmentedColormap.from_list(
    "growth", ["#08306b", "#2f79b5", "#a6cbe3", "#ffffff", "#fddbb0", "#f5a35c", "#d9762b"]
)


def colour_growth_rate(figure: Figure, ax: Axes, x: Floats, y: Floats, values: Floats) -> Axes:
    """Draw the growth rate; the axes of its colour bar."""
    finite = values[np.isfinite(values)]
    low = max(-float(finite.min(initial=0.0)), 0.01)  # each side has its own scale: decay is the smaller
    high = max(float(finite.max(initial=0.0)), 0.01)
    width = min(0.3, high / 3)  # below it the upper scale is linear, above it logarithmic

    def forward(rate: Floats) -> Floats:
        return np.where(rate < 0, rate / low, np.arcsinh(rate / width) / np.arcsinh(high / width))

    def inverse(part: Floats) -> Floats:
        return np.where(part < 0, part * low, width * np.sinh(part * np.arcsinh(high / width)))

    norm = FuncNorm((forward, inverse), vmin=-low, vmax=high)
    image = ax.pcolormesh(
        x, y, np.ma.masked_invalid(values), norm=norm, cmap=GROWTH, shading="nearest", rasterized=True
    )
    ax.set_facecolor("0.6")  # where an eigenvalue is infinite
    bar = figure.colorbar(image, ax=ax)
    bar.set_label("growth rate [s⁻¹]: largest real part of the eigenvalues")
    ticks = [-low, -low / 2, 0.0, *(t for t in (0.1, 0.3, 1, 3, 10, 30, 100, 300) if width / 4 < t < high)]
    bar.ax.yaxis.set_major_locator(FixedLocator(ticks))
    bar.ax.yaxis.set_minor_locator(NullLocator())
    bar.ax.set_yticklabels([f"{tick:.2g}".replace("-", "−") for tick in ticks])
    bar.ax.axhline(0, color="k", lw=1.2)
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(y[0], y[-1])
    return bar.ax


def colour_probability(figure: Figure, ax: Axes, x: Floats, y: Floats, values: Floats, samples: int) -> Axes:
    """Draw the probability of stability; the axes of its colour bar."""
    image = ax.pcolormesh(x, y, values, vmin=0, vmax=1, cmap="cividis", shading="nearest", rasterized=True)
    bar = figure.colorbar(image, ax=ax)
    bar.set_label(f"probability of stability, {samples} machines")
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(y[0], y[-1])
    return bar.ax
