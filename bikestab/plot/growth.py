"""The picture of several machines' growth rates against speed, a curve each; stable speeds are below zero."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from bikestab.against import Against
from bikestab.bicycle import Bicycle
from bikestab.model import Floats, Model, exact_table
from bikestab.plot.axes import LABELS, place_ticks, ticks_inside
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import Curve, label_curves, lines_for
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of

Machine = tuple[str, Bicycle, float, float, Model]  # name, machine, λ [rad], σ, and the equations
_SAMPLES = 601
_APART = 0.055  # of the axis: numbers beside it
_NEAR = 0.015  # of the axis: between rings that would cover each other
_THICK = "thick below zero: stable"
_LINEAR = 1.0  # 1/s: below it the scale is linear, where stability is decided


class Rates(NamedTuple):
    """A machine by name, its growth rate [1/s] at ascending x, and where along x its stability ends."""

    name: str
    x: Floats
    rate: Floats
    ends: Floats


@own_settings()
def draw_growth(machines: Sequence[Machine], start: float, stop: float, name: str = "") -> Figure:
    """The curves of machines for speeds from ``start`` to ``stop`` [m/s]; ``name`` is common to all.

    Raises InputError for more machines than there are lines that differ.
    """
    figure = Figure(figsize=(6.2, 4.4), layout="constrained")
    ax = figure.add_subplot()
    growth_axes(ax, machines, start, stop, name)
    _explain_rings(figure, ax, "V₁ or V₂")
    return figure


def growth_axes(ax: Axes, machines: Sequence[Machine], start: float, stop: float, name: str = "") -> None:
    """The same in axes of a picture."""
    draw_rates(ax, [_along(machine, start, stop) for machine in machines], start, stop)
    ax.set_xlabel(LABELS["V"])
    what = f"largest real part of the eigenvalues; {_THICK}"
    set_title(ax, f"{short(name)}: {what}" if name else f"{what[0].upper()}{what[1:]}")


@own_settings()
def draw_growth_against(machines: Sequence[tuple[str, Against]], label: str, name: str = "") -> Figure:
    """Machines by name, with growth rates at a speed each against a parameter, of which the axis tells."""
    figure = Figure(figsize=(6.2, 4.4), layout="constrained")
    ax = figure.add_subplot()
    values = machines[0][1].values
    speeds = {found.V for _, found in machines}
    at = f" at {machines[0][1].V:.6g} m/s" if len(speeds) == 1 else ""
    named = [(own if at else f"{own} at {found.V:.4g} m/s", found) for own, found in machines]
    draw_rates(ax, [_against(*each) for each in named], float(values.min()), float(values.max()))
    ax.set_xlabel(label, parse_math=False)
    if machines[0][1].name == "head_angle":
        place_ticks(ax.xaxis, "head_angle")
    what = f"largest real part of the eigenvalues{at}; {_THICK}"
    set_title(ax, f"{short(name)}: {what}" if name else f"{what[0].upper()}{what[1:]}")
    _explain_rings(figure, ax, "stability begins or ends")
    return figure


def _explain_rings(figure: Figure, ax: Axes, what: str) -> None:
    if any(line.get_marker() == "o" for line in ax.lines):
        legend_below(figure, [entry(what, color="0.2", marker="o", mfc="none", ls="none")])


def draw_rates(ax: Axes, machines: Sequence[Rates], start: float, stop: float) -> None:
    """Growth rates from ``start`` to ``stop`` of the axis, thick where motion is stable."""
    lines = lines_for(len(machines))
    curves, low, high = [], 0.0, 0.0
    ringed: list[float] = []
    for (name, x, rate, ends), line in zip(machines, lines, strict=True):
        shown = rate[np.isfinite(rate)]
        low, high = min(low, float(shown.min(initial=0))), max(high, float(shown.max(initial=0)))
        rate = np.where(np.isfinite(rate), rate, np.nan)
        for part, width in ((rate >= 0, 1.4), (rate <= 0, 3)):
            ax.plot(x, np.where(part, rate, np.nan), color=line.color, ls=line.ls, lw=width)
        for end in ends:  # a ring around those of others
            near = sum(abs(end - other) < _NEAR * (stop - start) for other in ringed)
            ax.plot(
                end, 0, "o", ms=5 + 5 * near, mfc="white", mec=line.color, mew=1.4, zorder=4 - 0.05 * near
            )
        ringed += [*ends]
        curves.append(Curve(name if len(shown) else f"{name}: infinite throughout", x, rate, line.color))
    ax.axhline(0, color="k", lw=0.8, zorder=1)
    ax.set_xlim(start, stop)
    ax.set_yscale("asinh", linear_width=_LINEAR)
    ax.set_ylim(1.15 * min(low, -0.1), 1.1 * max(high, 0.1))
    plain_ticks(ax)
    ax.set_ylabel(f"growth rate [s⁻¹]  (scale logarithmic beyond ±{_LINEAR:g})")
    ticks_inside(ax)
    nowhere, top = np.array([stop]), np.array([ax.get_ylim()[1]])
    label_curves(ax, [c if np.isfinite(c.y).any() else Curve(c.name, nowhere, top, c.color) for c in curves])


def _along(machine: Machine, start: float, stop: float) -> Rates:
    name, bicycle, lam, sigma, model = machine
    table = exact_table(bicycle, lam, sigma, model=model)
    found = intervals_of(table)
    ends = np.concatenate([found.V1[: found.number], found.V2[: found.number]])
    ends = ends[(ends > start) & (ends < stop)]
    V = np.union1d(np.linspace(start, stop, _SAMPLES), ends)
    rate = growth_rate_of(table, V)
    rate[np.isin(V, ends)] = 0.0
    return Rates(name, V, rate, ends)


def _against(name: str, found: Against) -> Rates:
    stretches: dict[float, list[Any]] = {}
    for curve in found.curves:
        stretches.setdefault(float(curve.x[0]), []).append(curve)
    x = np.concatenate([stretches[start][0].x for start in sorted(stretches)])
    rate = np.concatenate([
        np.max([curve.s.real for curve in stretches[start]], axis=0) for start in sorted(stretches)
    ])  # fmt: skip
    inside = [end for ends in found.stable for end in ends if x[0] < end < x[-1]]
    x, rate = np.append(x, inside), np.append(rate, np.zeros(len(inside)))
    order = np.argsort(x, kind="stable")
    return Rates(name, x[order], rate[order], np.array(inside))


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
