"""Pictures of the conclusions: kinds of designs over (λ, σ), widths along both axes, and damping."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import characteristic_table
from bikestab.paper1981 import box as paper
from bikestab.paper1981.box import LAM, SIGMA, V
from bikestab.plot.axes import HALO, LABELS, label_axes
from bikestab.plot.designs import CURVES
from bikestab.region.curves import trace
from bikestab.speeds import intervals_of

_KINDS = {"no stable speed": "#ffffff", "bounded interval": "#bcd7ea", "no upper limit": "#e69f00"}
_TALLER = 1.6  # the picture's box over the paper's, along σ
_STYLES: tuple[Any, ...] = ("-", (0, (6, 1.5)), (0, (3, 1, 1, 1)), (0, (1, 1)), (0, (8, 1, 1, 1, 1, 1)))
_DARK = ("#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7")  # Okabe and Ito 2008


def draw_kinds(bicycle: Bicycle, examples: list[dict[str, Any]], samples: int) -> Figure:
    """Designs with a bounded interval, an unbounded one or none, with the exact curves between them."""
    figure = Figure(figsize=(8.2, 6.2), layout="constrained")
    ax = figure.add_subplot()
    top = (SIGMA[0], _TALLER * SIGMA[1])
    found = paper.designs(bicycle, samples, sigma=top)
    kind = np.where(found.unbounded, 2, (found.number > 0).astype(int))
    ax.pcolormesh(
        found.lam[:, 0], found.sigma, kind.T, cmap=ListedColormap(list(_KINDS.values())), vmin=0, vmax=2,
        shading="nearest", rasterized=True,
    )  # fmt: skip
    names = {}
    for curve in trace(Family(bicycle), LAM, top, samples=samples):
        names[curve.name] = colour, dashes = CURVES[curve.name]
        ax.plot(curve.x, curve.y, color="white", lw=3.2, alpha=0.8)
        ax.plot(curve.x, curve.y, color=colour, lw=1.8, ls=dashes)
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
    for i, example in enumerate(examples, 1):
        ax.plot(example["lam"], example["sigma"], "o", ms=6, mfc="white", mec="black", zorder=6)
        ax.annotate(
            f"{i}", (example["lam"], example["sigma"]), xytext=(6, -4), textcoords="offset points",
            path_effects=HALO, zorder=6,
        )  # fmt: skip
    ax.set(xlim=LAM, ylim=top)
    label_axes(ax, "lam", "sigma", bicycle.c)
    handles: list[Any] = [Patch(facecolor=c, edgecolor="0.4", lw=0.6, label=n) for n, c in _KINDS.items()]
    handles += [Line2D([], [], color=c, lw=1.8, ls=ls, label=name) for name, (c, ls) in names.items()]
    handles.append(Line2D([], [], ls="", marker="o", mfc="white", mec="black", label="counterexamples"))
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False, handlelength=2.8)
    ax.set_title(f"{bicycle.name}: which designs have an upper limit of the stable speed", fontsize=10)
    return figure


def draw_widths(bicycle: Bicycle, sigmas: tuple[float, ...], lams: tuple[float, ...], samples: int) -> Figure:
    """The width of the widest interval along λ at several σ, and along σ at several λ."""
    figure = Figure(figsize=(11, 4.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    x, y = np.linspace(*LAM, 2 * samples), np.linspace(*SIGMA, 2 * samples)
    _widths(left, bicycle, x, sigmas, "σ", lambda sigma: (x, sigma))
    _widths(right, bicycle, y, lams, "λ", lambda lam: (lam, y))
    label_axes(left, "lam", "V", bicycle.c)
    label_axes(right, "sigma", "V", bicycle.c)
    for ax, ends in ((left, LAM), (right, SIGMA)):
        ax.set(xlim=ends, ylim=(0.1, 1.15 * V[1]), yscale="log")
        ax.set_ylabel(f"width of the widest interval up to {V[1]:g} m/s [m/s]")
        ax.set_yticks([0.1, 0.2, 0.5, 1, 2, 5, 10], labels=["0.1", "0.2", "0.5", "1", "2", "5", "10"])
        ax.minorticks_off()
        ax.grid(color="0.9", lw=0.6)
    figure.suptitle(f"{bicycle.name}: how the width depends on tilt and trail", fontsize=11)
    return figure


def _widths(ax: Axes, bicycle: Bicycle, x: Any, values: tuple[float, ...], symbol: str, at: Any) -> None:
    colours = colormaps["viridis"](np.linspace(0, 0.85, len(values)))
    for value, colour in zip(values, colours, strict=True):
        width = paper.widths(intervals_of(characteristic_table(bicycle, *at(value)))).max(axis=-1)
        ax.plot(x, np.where(width > 0, width, np.nan), color=colour, lw=1.7, label=f"{symbol} = {value:.2f}")
    ax.legend(fontsize=8.5, ncols=2, loc="upper right" if symbol == "σ" else "upper left")


def draw_damping(bicycle: Bicycle, whole: dict[str, Any], single: list[dict[str, Any]]) -> Figure:
    """V1 and V2 of single designs, and the region's measures, against δ."""
    figure = Figure(figsize=(11, 4.9), layout="constrained")
    left, right = figure.subplots(1, 2)
    for design, colour, style in zip(single, _DARK, _STYLES, strict=True):
        rows = [row for row in design["sweep"] if row["V1"] is not None]
        delta = [row["delta"] for row in rows]
        V2 = [row["V2"] if row["V2"] is not None else np.nan for row in rows]
        label = f"λ = {design['lam']:.2f}, σ = {design['sigma']:.2f}"
        left.plot(delta, [row["V1"] for row in rows], color=colour, ls=style, lw=1.8, label=label)
        left.plot(delta, V2, color=colour, ls=style, lw=0.9)
    left.set_ylabel(LABELS["V"])
    left.set_title("thick: V₁ (weave); thin: V₂ (capsize), where bounded", fontsize=10)
    left.set_ylim(0, None)
    delta = whole["deltas"]
    measures = {
        "volume of the region": [row["volume_change"] for row in whole["sweep"]],
        "V₁, median over designs": [row["V1_change_median"] for row in whole["sweep"]],
    }
    for i, lam in enumerate(whole["folds_at_lam"]):
        measures[f"smallest stable σ at λ = {lam:g}"] = [row["sigma_min_change"][i] for row in whole["sweep"]]
    for (label, values), colour, style in zip(measures.items(), _DARK, _STYLES, strict=True):
        percent = [np.nan if value is None else 100 * abs(value) for value in values]
        right.plot(delta, percent, color=colour, ls=style, lw=1.8, label=label)
    right.axhline(100 * whole["marked"], color="0.3", lw=0.8)
    right.text(
        delta[0] * 1.2, 100 * whole["marked"] * 1.1, f"marked: {100 * whole['marked']:g} %", path_effects=HALO
    )
    right.set(yscale="log", ylabel="|change| against δ = 0 [%]", ylim=(0.01, 400))
    right.set_yticks([0.01, 0.1, 1, 10, 100], labels=["0.01", "0.1", "1", "10", "100"])
    for ax in (left, right):
        ax.set(xscale="log", xlim=(delta[0], delta[-1]), xlabel="damping of the steering δ [kg m²/s]")
        ax.set_xticks([0.001, 0.01, 0.1, 1, 10], labels=["0.001", "0.01", "0.1", "1", "10"])
        ax.axvspan(delta[0], whole["bearings"], color="0.93", zorder=0)
        ax.legend(fontsize=8.5, loc="lower left" if ax is left else "lower right")
    figure.suptitle(
        f"{bicycle.name}: the boundaries against damping (grey: friction of bearings)", fontsize=11
    )
    return figure
