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
from bikestab.paper1981.maps import box_curves, map_designs
from bikestab.paper1981.pictures.places import place
from bikestab.plot.axes import HALO, label_axes
from bikestab.plot.designs import CURVES
from bikestab.plot.lines import draw_on_white, entry, legend_below
from bikestab.plot.settings import own_settings
from bikestab.region.curves import Curve, trace

_KINDS = {"no stable speed": "#ffffff", "bounded interval": "#bcd7ea", "no upper limit": "#fbe04a"}
_TOP = 1.6 * SIGMA[1]  # of the picture, above the paper's box
_INSET = DesignBox((0.0460, 0.0510), (0.1485, 0.1545))  # where two intervals are possible
_INSET_AT = (0.77, 0.71, 0.21, 0.25)  # in the picture
_DESIGNS = 301  # per axis: no step of their colours is wider than a curve's line
_LEAST = 0.01  # of a side: a shorter curve is not seen


@own_settings()
def draw_kinds(bicycle: Bicycle, examples: Sequence[tuple[float, float]], samples: int) -> Figure:
    """Kinds of designs over (λ, σ), with the exact curves in the paper's box, and counterexamples (λ, σ).

    The line b = 0 and an inset where two intervals meet the box.
    """
    figure = Figure(figsize=(8.2, 6.6))
    ax = figure.add_subplot()
    around = DesignBox(LAM, (SIGMA[0], _TOP))
    styles = _kinds(ax, bicycle, around, box_curves(bicycle, samples))
    _box(ax)
    _no_offset(ax, bicycle)
    _numbered(ax, examples)
    label_axes(ax, "lam", "sigma", bicycle.c)
    inset = ax.inset_axes(_INSET_AT)
    inside = trace(Family(bicycle), _INSET.lam, _INSET.sigma, samples=samples)
    styles |= _kinds(inset, bicycle, _INSET, inside)
    inset.axhline(SIGMA[1], color="black", lw=1.6)
    inset.set_xticks([0.046, 0.048, 0.05])
    inset.set_yticks([0.15, 0.152, 0.154])
    inset.tick_params(labelsize=8)
    ax.indicate_inset_zoom(inset, edgecolor="0.3")
    handles: list[Any] = [
        Patch(facecolor=color, edgecolor="0.4", lw=0.6, label=name) for name, color in _KINDS.items()
    ]
    handles += [entry(name, color=color, ls=dashes) for name, (color, dashes) in styles.items()]
    handles.append(entry("counterexamples", ls="", marker="o", mfc="white", mec="black"))
    legend_below(figure, handles, handlelength=2.8)
    ax.set_title(f"{bicycle.name}: which designs have an upper limit of the stable speed", fontsize=10)
    place(figure, "kinds")
    return figure


def _kinds(ax: Axes, bicycle: Bicycle, box: DesignBox, curves: list[Curve]) -> dict[str, tuple[str, Any]]:
    """The kinds in a box, and curves between them; what the curves look like."""
    designs = map_designs(bicycle, _DESIGNS, box)
    kind = np.where(designs.unbounded, 2, (designs.number > 0).astype(int))
    ax.pcolormesh(
        designs.lam[:, 0], designs.sigma, kind.T, cmap=ListedColormap(list(_KINDS.values())), vmin=0, vmax=2,
        shading="nearest", rasterized=True,
    )  # fmt: skip
    styles: dict[str, tuple[str, Any]] = {}
    for curve in curves:
        visible = max(np.ptp(curve.x) / np.ptp(box.lam), np.ptp(curve.y) / np.ptp(box.sigma))
        if visible > _LEAST:
            styles[curve.name] = color, dashes = CURVES[curve.name]
            draw_on_white(ax, [(curve.x, curve.y)], lw=1.8, color=color, ls=dashes)
    ax.set(xlim=box.lam, ylim=box.sigma)
    return styles


def _no_offset(ax: Axes, bicycle: Bicycle) -> None:
    """The line b = 0, below which forks are bent forwards."""
    lam = np.linspace(*LAM, 101)
    ax.plot(lam, bicycle.R2 / bicycle.c * np.tan(lam), color="#00795a", lw=1.8, zorder=4)
    ax.text(
        0.285, 0.03, "b > 0: forks bent forwards", color="#00795a", ha="right", path_effects=HALO, zorder=5
    )
    at = (0.12, bicycle.R2 / bicycle.c * np.tan(0.12))
    ax.annotate(
        "b = 0", at, (6, -13), textcoords="offset points", color="#00795a", path_effects=HALO, zorder=5
    )


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
