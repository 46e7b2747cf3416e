"""The picture of several machines' fronts between width and decay, a curve each, with their own designs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from bikestab.design.best import Best
from bikestab.design.criteria import Wanted
from bikestab.plot.axes import ticks_inside
from bikestab.plot.headings import set_title
from bikestab.plot.lines import legend_below
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import Curve, label_curves, lines_for


@own_settings()
def draw_fronts(machines: Sequence[tuple[str, Wanted, Best]]) -> Figure:
    """Machines by name. Raises InputError for more than there are lines that differ."""
    lines = lines_for(len(machines))
    figure = Figure(figsize=(6.2, 4.4), layout="constrained")
    ax = figure.add_subplot()
    curves, own_drawn = [], False
    for (name, _, best), line in zip(machines, lines, strict=True):
        points = [(d["width"], d["growth_rate"]) for d in best.pareto]
        ax.plot(
            *zip(*points, strict=True), marker="o", ms=4, color=line.color, ls=line.ls
        ) if points else None
        own = best.own
        if own and own["V1"] is not None and own["growth_rate"] is not None:
            mark = (own["width"], own["growth_rate"])
            ax.plot(*mark, "*", ms=13, color=line.color, mec="black", mew=0.8, zorder=4)
            points, own_drawn = points or [mark], True
        x, y = np.array(points[::-1] or [(0.0, 0.0)]).T
        curves.append(Curve(name if best.pareto else f"{name}: no front", x, y, line.color))
    ax.axhline(0, color="k", lw=0.8, zorder=1)
    ax.set_xlabel(f"width of the stable interval up to {machines[0][1].V_max:g} m/s [m/s]  (wider →)")
    ax.set_ylabel("growth rate where it is judged [s⁻¹]  (↓ decays faster)")
    ax.set_xlim(left=0)
    ticks_inside(ax)
    label_curves(ax, curves)
    star = Line2D([], [], marker="*", ms=12, color="0.6", mec="black", ls="", label="own design")
    legend_below(figure, [star] if own_drawn else [])
    set_title(ax, "Width-decay fronts: no other design is better in both")
    return figure
