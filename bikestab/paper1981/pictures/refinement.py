"""The refined and the unrefined model side by side."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import MODELS
from bikestab.paper1981.box import SIGMA, V
from bikestab.paper1981.pictures.places import place
from bikestab.paper1981.pictures.ticks import draw_ticked
from bikestab.plot.axes import label_axes
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.settings import own_settings
from bikestab.region.section import Section, zero_curves
from bikestab.routh import conditions

_SURFACES: dict[str, tuple[str, Any, str]] = {  # of each condition: colour (Okabe and Ito 2008), line, words
    "p0": ("#e69f00", (0, (5, 1.5)), "p₀ = 0, capsize"),
    "p1": ("#009e73", (0, (1, 1)), "p₁ = 0"),
    "p2": ("#cc79a7", (0, (3, 1, 1, 1)), "p₂ = 0"),
    "hurwitz3": ("#0072b2", "-", "Δ₃ = 0, weave"),
}
_STABLE = "#cfe8f7"
_TOP = V[1] / 2  # m/s


@own_settings()
def draw_refinement(bicycle: Bicycle, lam: float, samples: int) -> Figure:
    """Both models side by side: the conditions at one λ over (σ, V)."""
    figure = Figure(figsize=(11, 5))
    for ax, model in zip(figure.subplots(1, 2), MODELS, strict=True):
        _conditions(ax, Section(Family(bicycle, model), "lam", lam), samples)
    handles: list[Any] = [
        entry(f"{words} (ticks: positive)", color=colour, lw=1.7, ls=style)
        for colour, style, words in _SURFACES.values()
    ]
    handles.append(Patch(facecolor=_STABLE, label="stable"))
    legend_below(figure, handles)
    place(figure, "refinement")
    return figure


def _conditions(ax: Axes, section: Section, samples: int) -> None:
    """Where the conditions are zero in one plane, and where all hold."""
    X, Y = np.linspace(*SIGMA, samples), np.linspace(0, _TOP, samples)
    table, speed = section.table_and_speed(X[np.newaxis, :], Y[:, np.newaxis])
    inside = np.all([value > 0 for value in conditions(table, speed)], axis=0)
    if inside.any():
        ax.contourf(X, Y, inside, levels=[0.5, 1.5], colors=[_STABLE])
    curves = zero_curves(section, list(_SURFACES), X, Y)
    for name, (colour, style, _) in _SURFACES.items():
        for x, y in curves[name]:
            draw_ticked(ax, section, [name], x, y, color=colour, ls=style)
    ax.set(xlim=SIGMA, ylim=(0, _TOP))
    label_axes(ax, "sigma", "V", section.family.bicycle.c)
    stable = "" if inside.any() else ", no stable motion"
    ax.set_title(f"{section.family.model}: conditions at λ = {section.value:g} rad{stable}", fontsize=10)
