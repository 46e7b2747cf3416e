"""Conclusion 1: designs with a bounded interval, an unbounded one or none."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.paper1981.box import LAM, SIGMA, DesignBox
from bikestab.paper1981.maps import map_designs
from bikestab.plot.axes import HALO, label_axes
from bikestab.plot.designs import CURVES
from bikestab.plot.lines import draw_on_white, entry, legend_below
from bikestab.region.curves import trace

_KINDS = {"no stable speed": "#ffffff", "bounded interval": "#bcd7ea", "no upper limit": "#e69f00"}
_TOP = 1.6 * SIGMA[1]  # of the picture, above the paper's box


def draw_kinds(bicycle: Bicycle, examples: Sequence[tuple[float, float]], samples: int) -> Figure:
    """Kinds of designs over (λ, σ), with the exact curves between them and counterexamples (λ, σ)."""
    figure = Figure(figsize=(8.2, 6.2), layout="constrained")
    ax = figure.add_subplot()
    sigma = (SIGMA[0], _TOP)
    designs = map_designs(bicycle, samples, DesignBox(LAM, sigma))
    kind = np.where(designs.unbounded, 2, (designs.number > 0).astype(int))
    ax.pcolormesh(
        designs.lam[:, 0], designs.sigma, kind.T, cmap=ListedColormap(list(_KINDS.values())), vmin=0, vmax=2,
        shading="nearest", rasterized=True,
    )  # fmt: skip
    styles = {}
    for curve in trace(Family(bicycle), LAM, sigma, samples=samples):
        styles[curve.name] = color, dashes = CURVES[curve.name]
        draw_on_white(ax, [(curve.x, curve.y)], lw=1.8, color=color, ls=dashes)
    _box(ax)
    _numbered(ax, examples)
    ax.set(xlim=LAM, ylim=sigma)
    label_axes(ax, "lam", "sigma", bicycle.c)
    handles: list[Any] = [
        Patch(facecolor=c, edgecolor="0.4", lw=0.6, label=name) for name, c in _KINDS.items()
    ]
    handles += [entry(name, color=color, ls=dashes) for name, (color, dashes) in styles.items()]
    handles.append(entry("counterexamples", ls="", marker="o", mfc="white", mec="black"))
    legend_below(figure, handles, handlelength=2.8)
    ax.set_title(f"{bicycle.name}: which designs have an upper limit of the stable speed", fontsize=10)
    return figure


def _box(ax: Axes) -> None:
    ax.add_patch(Rectangle((LAM[0], SIGMA[0]), LAM[1], SIGMA[1], fill=False, ec="black", lw=1.6, zorder=4))
    ax.text(
        LAM[1] * 0.985,
        SIGMA[1] * 1.015,
        "the paper's box",
        ha="right",
        va="bottom",
        path_effects=HALO,
        zorder=5,
    )


def _numbered(ax: Axes, designs: Sequence[tuple[float, float]]) -> None:
    for i, design in enumerate(designs, 1):
        ax.plot(*design, "o", ms=6, mfc="white", mec="black", zorder=6)
        ax.annotate(f"{i}", design, xytext=(6, -4), textcoords="offset points", path_effects=HALO, zorder=6)
