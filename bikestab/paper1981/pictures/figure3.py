"""The paper's figure 3: boundaries of the stability region in two families of planes, and in space."""

from __future__ import annotations

from typing import cast

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import TickedStroke
from mpl_toolkits.mplot3d import Axes3D

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.fields import Axis
from bikestab.paper1981.pictures.ticks import ENDS, TICKS, draw_ticked
from bikestab.paper1981.study import ARROW, FAMILY_LAM, FAMILY_SIGMA
from bikestab.plot.axes import HALO, SYMBOLS, label_axes
from bikestab.plot.lines import EDGES, entry, legend_below
from bikestab.plot.region import draw_mesh
from bikestab.region.mesh import Mesh
from bikestab.region.section import Section, edge_curves
from bikestab.routh import CONDITIONS

_FAMILIES: dict[Axis, tuple[float, ...]] = {"lam": FAMILY_LAM, "sigma": FAMILY_SIGMA}


def draw_sections(bicycle: Bicycle, samples: int) -> Figure:
    """The paper's figure 3 as two families of curves: (σ, V) at several λ, and (λ, V) at several σ."""
    figure = Figure(figsize=(11.5, 5.6), layout="constrained")
    for ax, (fixed, values) in zip(figure.subplots(1, 2), _FAMILIES.items(), strict=True):
        _family(ax, bicycle, fixed, values, samples)
    handles = [entry(name, color="0.2", lw=1.7, ls=style) for name, style in EDGES.values()]
    handles.append(entry("ticks: stable side", color="0.2", lw=0.9, path_effects=[TickedStroke(**TICKS)]))
    legend_below(figure, handles)
    figure.suptitle(
        f"{bicycle.name}: boundaries of the stability region (figure 3 of the paper)", fontsize=11
    )
    return figure


def _family(ax: Axes, bicycle: Bicycle, fixed: Axis, values: tuple[float, ...], samples: int) -> None:
    """The boundaries in parallel planes, in which λ or σ has one of the values."""
    colours = colormaps["viridis"](np.linspace(0, 0.82, len(values)))
    handles = []
    x_name, y_name = Section(Family(bicycle), fixed, values[0]).axes
    X, Y = (np.linspace(*ENDS[name], samples) for name in (x_name, y_name))
    for value, colour in zip(values, colours, strict=True):
        section = Section(Family(bicycle), fixed, value)
        for name, (_, style) in EDGES.items():
            for x, y in edge_curves(section, name, X, Y):
                draw_ticked(ax, section, CONDITIONS, x, y, color=colour, ls=style)
        unit = " rad" if fixed == "lam" else ""
        handles.append(entry(f"{SYMBOLS[fixed]} = {value:.2f}{unit}", color=colour, lw=2))
    ax.set(xlim=ENDS[x_name], ylim=ENDS[y_name])
    label_axes(ax, x_name, y_name, bicycle.c)
    ax.legend(handles=handles, loc="upper left" if fixed == "lam" else "upper right", fontsize=9)


def draw_space(bicycle: Bicycle, mesh: Mesh) -> Figure:
    """The region in three dimensions, the arrow into it."""
    figure = Figure(figsize=(7.4, 6.4), layout="constrained")
    ax = cast("Axes3D", figure.add_subplot(projection="3d", computed_zorder=False))
    handles = draw_mesh(ax, mesh, list(ENDS.values()))
    start, tip = np.array(ARROW)
    ax.plot(*np.stack([start, tip], axis=-1), color="black", lw=2.2, zorder=9)
    ax.plot(*tip[:, np.newaxis], color="black", marker="v", ms=9, zorder=9)  # the arrow is vertical
    ax.text(*start, "stable", ha="center", va="bottom", zorder=9, path_effects=HALO)
    legend_below(figure, handles, ncols=2, handlelength=2)
    ax.set_title(f"{bicycle.name}: the stability region (figure 3 of the paper)", fontsize=10)
    return figure
