"""The paper's figure 3: boundaries of the stability region in two families of planes, and in space."""

from __future__ import annotations

from typing import cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import TickedStroke
from mpl_toolkits.mplot3d import Axes3D

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.fields import Axis
from bikestab.paper1981.pictures.places import TITLE, place
from bikestab.paper1981.pictures.ticks import ENDS, TICKS, draw_ticked
from bikestab.paper1981.study import ARROW, FAMILY_LAM, FAMILY_SIGMA
from bikestab.plot.axes import HALO, SYMBOLS, label_axes
from bikestab.plot.lines import EDGES, entry, legend_below
from bikestab.plot.region import draw_mesh
from bikestab.plot.settings import own_settings
from bikestab.region.mesh import Mesh
from bikestab.region.section import Section, edge_curves
from bikestab.routh import CONDITIONS

# black, blue, vermilion, green, purple, orange of Okabe and Ito (2008), darkened where text needs it
_COLOURS = ("#000000", "#0072b2", "#d55e00", "#00795a", "#a8558a", "#b07700")
_IN_LEGEND = {"spacing": 12, "length": 0.6}
_LEAST_APART = 0.037  # of the speeds' axis: a line of text
_FAMILIES: dict[Axis, tuple[float, ...]] = {"lam": FAMILY_LAM, "sigma": FAMILY_SIGMA}


@own_settings()
def draw_sections(bicycle: Bicycle, samples: int) -> Figure:
    """The paper's figure 3 as two families of curves: (σ, V) at several λ, and (λ, V) at several σ."""
    figure = Figure(figsize=(11.5, 5.6))
    for ax, (fixed, values) in zip(figure.subplots(1, 2), _FAMILIES.items(), strict=True):
        _family(ax, bicycle, fixed, values, samples)
    handles = [entry(name, color="0.2", lw=1.7, ls=style) for name, style in EDGES.values()]
    handles.append(
        entry("ticks: stable side", color="0.2", lw=0.9, path_effects=[TickedStroke(**TICKS | _IN_LEGEND)])
    )
    legend_below(figure, handles)
    figure.suptitle(
        f"{bicycle.name}: boundaries of the stability region, computed for the box of figure 3",
        y=TITLE,
        fontsize=11,
    )
    place(figure, "sections")
    return figure


def _family(ax: Axes, bicycle: Bicycle, fixed: Axis, values: tuple[float, ...], samples: int) -> None:
    """The boundaries in parallel planes, in which λ or σ has one of the values."""
    x_name, y_name = Section(Family(bicycle), fixed, values[0]).axes
    X, Y = (np.linspace(*ENDS[name], samples) for name in (x_name, y_name))
    ends: list[tuple[float, float, str, str]] = []
    for value, colour in zip(values, _COLOURS, strict=True):
        section = Section(Family(bicycle), fixed, value)
        drawn = edge_curves(section, list(EDGES), X, Y)
        for name, (_, style) in EDGES.items():
            for x, y in drawn[name]:
                draw_ticked(ax, section, CONDITIONS, x, y, color=colour, ls=style)
        points = np.concatenate(drawn["p0"] or drawn["hurwitz3"], axis=1)
        last = points[:, np.argmax(points[0] / X[-1] + points[1] / Y[-1])]  # where it leaves the picture
        ends.append((float(last[0]), float(last[1]), f"{SYMBOLS[fixed]} = {value:.2f}", colour))
    ax.set(xlim=ENDS[x_name], ylim=ENDS[y_name])
    label_axes(ax, x_name, y_name, bicycle.c)
    _label_ends(ax, ends, X[-1], Y[-1])


def _label_ends(ax: Axes, ends: list[tuple[float, float, str, str]], right: float, top: float) -> None:
    """Names beside the curves' ends (x, y, name, colour): right of the picture, or at its top."""
    lowest = -np.inf
    for x, y, name, colour in sorted(ends, key=lambda end: end[1]):
        if x < 0.97 * right or y > 0.97 * top:
            ax.text(
                x - 0.022 * right,
                top * 0.985,
                name,
                color=colour,
                ha="right",
                va="top",
                rotation=90,
                fontsize=9,
                path_effects=HALO,
            )
            continue
        lowest = max(y, lowest + _LEAST_APART * top)
        line = {"arrowstyle": "-", "color": colour, "lw": 0.6, "shrinkA": 0, "shrinkB": 0, "relpos": (0, 0.5)}
        ax.annotate(
            name, (x, y), (1.03 * right, lowest), color=colour, va="center", fontsize=9,
            annotation_clip=False, arrowprops=line,
        )  # fmt: skip


@own_settings()
def draw_space(bicycle: Bicycle, mesh: Mesh) -> Figure:
    """The region in three dimensions, the arrow into it."""
    figure = Figure(figsize=(7.4, 6.4))
    ax = cast("Axes3D", figure.add_subplot(projection="3d", computed_zorder=False))
    handles = draw_mesh(ax, mesh, list(ENDS.values()))
    start, tip = np.array(ARROW)
    ax.plot(*np.stack([start, tip], axis=-1), color="black", lw=2.2, zorder=9)
    ax.plot(*tip[:, np.newaxis], color="black", marker="v", ms=9, zorder=9)  # the arrow is vertical
    ax.text(*start, "stable", ha="center", va="bottom", zorder=9, path_effects=HALO)
    legend_below(figure, handles, handlelength=2)
    ax.set_title(f"{bicycle.name}: the stability region, computed for the box of figure 3", fontsize=10)
    place(figure, "space")
    return figure
