"""Pictures of the reproduction: boundaries with ticks on their stable side, in the paper's manner."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import TickedStroke
from mpl_toolkits.mplot3d import Axes3D

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.fields import Axis
from bikestab.model import Floats, Model
from bikestab.paper1981.box import LAM, SIGMA, V
from bikestab.plot.axes import HALO, LABELS, SYMBOLS, label_axes
from bikestab.plot.region import draw_mesh
from bikestab.region.mesh import Mesh
from bikestab.region.section import Section, edge_curves, zero_curves
from bikestab.routh import CONDITIONS, conditions

ENDS: dict[Axis, tuple[float, float]] = {"lam": LAM, "sigma": SIGMA, "V": V}
FAMILIES: dict[Axis, tuple[float, ...]] = {
    "lam": (0.05, 0.10, 0.15, 0.20, 0.25, 0.30),
    "sigma": (0.06, 0.08, 0.10, 0.12, 0.14, 0.15),
}
EDGES = {"hurwitz3": ("weave", "-"), "p0": ("capsize", (0, (5, 1.5)))}
SURFACES = {  # of each condition: colour (Okabe and Ito 2008), line, words
    "p0": ("#d55e00", (0, (5, 1.5)), "p₀ = 0, capsize"),
    "p1": ("#009e73", (0, (1, 1)), "p₁ = 0"),
    "p2": ("#cc79a7", (0, (3, 1, 1, 1)), "p₂ = 0"),
    "hurwitz3": ("#0072b2", "-", "Δ₃ = 0, weave"),
}
ARROW = ((0.22, 0.125, 12.5), (0.22, 0.125, 4.9))  # λ, σ, V: from outside into the stable region
_ASIDE = 2e-3  # of the axes: how far beside a curve its two sides are looked at
_TICKS: dict[str, Any] = {"spacing": 9, "angle": 60, "length": 0.55}


def draw_sections(bicycle: Bicycle, samples: int) -> Figure:
    """The paper's figure 3 as two families of curves: (σ, V) at several λ, and (λ, V) at several σ."""
    figure = Figure(figsize=(11.5, 5.6), layout="constrained")
    for ax, fixed in zip(figure.subplots(1, 2), FAMILIES, strict=True):
        values = FAMILIES[fixed]
        colours = colormaps["viridis"](np.linspace(0, 0.82, len(values)))
        for value, colour in zip(values, colours, strict=True):
            section = _section(bicycle, fixed, value)
            X, Y = (np.linspace(*ENDS[name], samples) for name in section.axes)
            for name, (_, style) in EDGES.items():
                for x, y in edge_curves(section, name, X, Y):
                    ticked(ax, section, CONDITIONS, x, y, color=colour, ls=style)
        _label(ax, fixed, bicycle)
        handles = [
            Line2D([], [], color=colour, lw=2, label=f"{SYMBOLS[fixed]} = {value:.2f}{_unit(fixed)}")
            for value, colour in zip(values, colours, strict=True)
        ]
        ax.legend(handles=handles, loc="upper left" if fixed == "lam" else "upper right", fontsize=9)
    handles = [Line2D([], [], color="0.2", lw=1.7, ls=ls, label=name) for name, ls in EDGES.values()]
    handles.append(
        Line2D([], [], color="0.2", lw=0.9, path_effects=[TickedStroke(**_TICKS)], label="ticks: stable side")
    )
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False, handlelength=3)
    figure.suptitle(
        f"{bicycle.name}: boundaries of the stability region (figure 3 of the paper)", fontsize=11
    )
    return figure


def draw_space(bicycle: Bicycle, mesh: Mesh) -> Figure:
    """The region in three dimensions, the arrow into it."""
    figure = Figure(figsize=(7.4, 6.4), layout="constrained")
    ax = cast("Axes3D", figure.add_subplot(projection="3d", computed_zorder=False))
    handles = draw_mesh(ax, mesh, list(ENDS.values()))
    start, tip = np.array(ARROW)
    ax.plot(*np.stack([start, tip], axis=-1), color="black", lw=2.2, zorder=9)
    ax.plot(*tip[:, np.newaxis], color="black", marker="v", ms=9, zorder=9)  # the arrow is vertical
    ax.text(*start, "stable", ha="center", va="bottom", zorder=9, path_effects=HALO)
    figure.legend(handles=handles, loc="outside lower center", ncols=2, frameon=False)
    ax.set_title(f"{bicycle.name}: the stability region (figure 3 of the paper)", fontsize=10)
    return figure


def draw_refinement(bicycle: Bicycle, lam: float, meshes: dict[Model, Mesh], samples: int) -> Figure:
    """Both models side by side: the conditions at one λ over (σ, V), and the regions."""
    figure = Figure(figsize=(11, 9.6), layout="constrained")
    grid = figure.add_gridspec(2, 2, height_ratios=[1, 1.25])
    top = V[1] / 2
    sheets: dict[str, Any] = {}
    for column, (model, mesh) in enumerate(meshes.items()):
        ax = figure.add_subplot(grid[0, column])
        section = Section(Family(bicycle, model), "lam", lam)
        X, Y = np.linspace(*SIGMA, samples), np.linspace(0, top, samples)
        table, speed = section.table_and_speed(X[np.newaxis, :], Y[:, np.newaxis])
        inside = np.all([value > 0 for value in conditions(table, speed)], axis=0)
        if inside.any():
            ax.contourf(X, Y, inside, levels=[0.5, 1.5], colors=["#cfe8f7"])
        for name, (colour, style, _) in SURFACES.items():
            for x, y in zero_curves(section, name, X, Y):
                ticked(ax, section, [name], x, y, color=colour, ls=style)
        ax.set(xlim=SIGMA, ylim=(0, top))
        label_axes(ax, "sigma", "V", bicycle.c)
        ax.set_title(f"{model}: conditions at λ = {lam:g} rad", fontsize=10)
        space = cast("Axes3D", figure.add_subplot(grid[1, column], projection="3d", computed_zorder=False))
        sheets |= {str(handle.get_label()): handle for handle in draw_mesh(space, mesh, list(ENDS.values()))}
    handles: list[Any] = [
        Line2D([], [], color=colour, lw=1.7, ls=ls, label=f"{words} (ticks: positive)")
        for colour, ls, words in SURFACES.values()
    ]
    handles.append(Patch(facecolor="#cfe8f7", label="stable"))
    handles += sheets.values()
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False, handlelength=3)
    return figure


def ticked(
    ax: Axes, section: Section, names: Sequence[str], x: Floats, y: Floats, *, color: Any, ls: Any
) -> None:
    """A curve with ticks on the side where the conditions ``names`` hold."""
    x, y = oriented(section, names, x, y)
    ax.plot(x, y, color=color, lw=1.7, ls=ls, solid_capstyle="round")
    ax.plot(x, y, color=color, lw=0.9, path_effects=[TickedStroke(**_TICKS)])


def oriented(section: Section, names: Sequence[str], x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """The curve in the direction that has the points where the conditions hold at its left."""
    width, height = (ENDS[name][1] - ENDS[name][0] for name in section.axes)
    along = np.gradient(x / width), np.gradient(y / height)
    length = np.maximum(np.hypot(*along), 1e-300)
    aside = _ASIDE * width * along[1] / length, _ASIDE * height * along[0] / length
    left = _held(section, names, x - aside[0], y + aside[1])
    right = _held(section, names, x + aside[0], y - aside[1])
    return (x, y) if np.sum(left) >= np.sum(right) else (x[::-1], y[::-1])


def _held(section: Section, names: Sequence[str], x: Floats, y: Floats) -> Any:
    values = conditions(*section.table_and_speed(x, y))._asdict()
    return np.all([values[name] > 0 for name in names], axis=0)


def _section(bicycle: Bicycle, fixed: Axis, value: float) -> Section:
    return Section(Family(bicycle), fixed, value)


def _label(ax: Axes, fixed: Axis, bicycle: Bicycle) -> None:
    x, y = _section(bicycle, fixed, 0.0).axes
    ax.set(xlim=ENDS[x], ylim=ENDS[y])
    label_axes(ax, x, y, bicycle.c)
    ax.set_ylabel(LABELS[y])


def _unit(fixed: Axis) -> str:
    return " rad" if fixed == "lam" else ""
