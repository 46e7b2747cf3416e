"""The picture of several machines' growth rates against speed, a curve each; stable speeds are below zero."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from bikestab.bicycle import Bicycle
from bikestab.model import Model, exact_table
from bikestab.plot.axes import LABELS, ticks_inside
from bikestab.plot.headings import set_title
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import label_right, lines_for
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of

Curve = tuple[str, Bicycle, float, float, Model]  # name, machine, λ [rad], σ, and the equations
_SAMPLES = 601
_APART = 0.055  # of the axis: numbers beside it
_LINEAR = 1.0  # 1/s: below it the scale is linear, where stability is decided


@own_settings()
def draw_growth(machines: Sequence[Curve], start: float, stop: float) -> Figure:
    """The curves of machines for speeds from ``start`` to ``stop`` [m/s].

    Raises InputError for more machines than there are lines that differ.
    """
    figure = Figure(figsize=(6.2, 4.4), layout="constrained")
    growth_axes(figure.add_subplot(), machines, start, stop)
    return figure


def growth_axes(ax: Axes, machines: Sequence[Curve], start: float, stop: float) -> None:
    """The same in axes of a picture."""
    lines = lines_for(len(machines))
    ends, low, high = [], 0.0, 0.0
    for (_, bicycle, lam, sigma, model), line in zip(machines, lines, strict=True):
        table = exact_table(bicycle, lam, sigma, model=model)
        found = intervals_of(table)
        edges = np.concatenate([found.V1[: found.number], found.V2[: found.number]])
        edges = edges[(edges > start) & (edges < stop)]
        V = np.union1d(np.linspace(start, stop, _SAMPLES), edges)
        rate = growth_rate_of(table, V)
        rate[np.isin(V, edges)] = 0.0
        shown = rate[np.isfinite(rate)]
        low, high = min(low, float(shown.min(initial=0))), max(high, float(shown.max(initial=0)))
        ax.plot(V, np.where(np.isfinite(rate), rate, np.nan), color=line.color, ls=line.ls, lw=1.2)
        ax.plot(V, np.where(rate <= 0, rate, np.nan), color=line.color, ls=line.ls, lw=3)
        ax.plot(edges, np.zeros(len(edges)), "o", ms=5, mfc="white", mec=line.color, mew=1.4, zorder=4)
        ends.append(float(rate[-1]) if math.isfinite(rate[-1]) else 0.0)
    ax.axhline(0, color="k", lw=0.8, zorder=1)
    ax.set_xlim(start, stop)
    ax.set_yscale("asinh", linear_width=_LINEAR)
    ax.set_ylim(1.15 * min(low, -0.1), 1.1 * max(high, 0.1))
    plain_ticks(ax)
    ax.set_xlabel(LABELS["V"])
    ax.set_ylabel(f"growth rate [s⁻¹]  (scale logarithmic beyond ±{_LINEAR:g})")
    ticks_inside(ax)
    label_right(ax, [name for name, *_ in machines], [stop] * len(ends), ends, [line.color for line in lines])
    set_title(ax, "Largest real part of the eigenvalues; thick below zero: stable")


def plain_ticks(ax: Axes) -> None:
    """Numbers that stand apart on an axis with final limits, linear below one and logarithmic above."""
    low, high = np.arcsinh(ax.get_ylim())
    ticks = [0.0]
    for size in (1, 10, 100, 5, 50, 2, 20, 200, 0.5, 0.2):
        for tick in (size, -size):
            if np.abs(np.arcsinh(ticks) - np.arcsinh(tick)).min() > _APART * (high - low):
                ticks.append(tick)
    ax.yaxis.set_major_locator(FixedLocator(ticks))
    ax.yaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_major_formatter(lambda tick, _: f"{tick:g}".replace("-", "−"))
