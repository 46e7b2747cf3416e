"""The picture of several machines' fronts between width and decay, a curve each, with their own designs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from bikestab.design.best import Best
from bikestab.design.wanted import Wanted, where_judged
from bikestab.plot.axes import ticks_inside
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import legend_below
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import Curve, label_curves, lines_for

_OWN = 9  # points: the mark of a machine's own design


@own_settings()
def draw_fronts(machines: Sequence[tuple[str, Wanted, Best]], name: str = "") -> Figure:
    """Machines by name; ``name`` is common to all. Raises InputError for more than lines that differ."""
    lines = lines_for(len(machines))
    figure = Figure(figsize=(6.2, 4.4), layout="constrained")
    ax = figure.add_subplot()
    curves: list[Curve] = []
    owns: dict[str, str] = {}  # a mark of those at each place
    for (whose, _, best), line in zip(machines, lines, strict=True):
        x, y = np.array([(d["width"], d["growth_rate"]) for d in best.pareto[::-1]]).reshape(-1, 2).T
        ax.plot(x, y, marker=line.marker, ms=4, color=line.color, ls=line.ls)
        own = best.own
        if own and own["V1"] is not None and own["growth_rate"] is not None:
            place = np.array([own["width"]]), np.array([own["growth_rate"]])
            face = "white" if own["at"] else line.color  # hollow: it competes with no design of the front
            edge = line.color if own["at"] else "black"
            ax.plot(*place, line.marker, ms=_OWN, mfc=face, mec=edge, mew=1.2, zorder=4)
            owns.setdefault(own["at"], line.marker)
        else:
            place = np.zeros(1), np.zeros(1)
        curves.append(
            Curve(whose, x, y, line.color) if best.pareto else Curve(f"{whose}: no front", *place, line.color)
        )
    ax.axhline(0, color="k", lw=0.8, zorder=1)
    ax.set_xlabel(f"width of the stable interval up to {machines[0][1].V_max:g} m/s [m/s]  (wider →)")
    judged = where_judged(machines[0][1])
    ax.set_ylabel(f"growth rate [s⁻¹]  (↓ decays faster)\n{judged}")
    ax.set_xlim(left=0)
    ticks_inside(ax)
    label_curves(ax, curves)
    style: dict[str, Any] = {"ms": _OWN, "mew": 1.2, "ls": ""}
    words = {at: f"own design, {at}" if at else "own design of each, in its mark" for at in sorted(owns)}
    faces: dict[str, dict[str, Any]] = {
        at: {"mfc": "white", "mec": "0.4"} if at else {"mfc": "0.6", "mec": "black"} for at in words
    }
    styles = {at: {"label": word, "marker": owns[at], **style, **faces[at]} for at, word in words.items()}
    legend_below(figure, [Line2D([], [], **each) for each in styles.values()])
    title = "width-decay fronts: no other design is better in both"
    set_title(ax, f"{short(name)}: {title}" if name else title.capitalize())
    return figure
