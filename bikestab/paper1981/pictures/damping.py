"""Conclusion 4: the boundaries against damping."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.bicycle import Bicycle
from bikestab.paper1981.box import V
from bikestab.paper1981.claims import THRESHOLDS
from bikestab.paper1981.damped_designs import first_intervals
from bikestab.paper1981.damping import Damping
from bikestab.paper1981.pictures.places import TITLE, place
from bikestab.plot.axes import HALO, LABELS
from bikestab.plot.settings import own_settings

_STYLES: tuple[Any, ...] = (
    "-",
    (0, (6, 1.5)),
    (0, (3, 1, 1, 1)),
    (0, (1, 1)),
    (0, (8, 1, 1, 1, 1, 1)),
    (0, (2, 2)),
)
_SAMPLES = 200  # of each design's curve
_COLOURS = ("#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9")  # Okabe, Ito


@own_settings()
def draw_damping(bicycle: Bicycle, numbers: Damping) -> Figure:
    """V1 and V2 of single designs, and the region's measures, against δ."""
    figure = Figure(figsize=(11, 4.9))
    left, right = figure.subplots(1, 2)
    _single_designs(left, bicycle, numbers)
    _measures(right, numbers)
    for ax, where in ((left, "upper left"), (right, "lower right")):
        ax.set(
            xscale="log",
            xlim=(numbers.deltas[0], numbers.deltas[-1]),
            xlabel="damping of the steering δ [kg m²/s]",
        )
        _plain_ticks(ax.set_xticks, [0.001, 0.01, 0.1, 1, 10])
        ax.axvspan(numbers.deltas[0], THRESHOLDS["bearings"], color="0.93", zorder=0)
        ax.legend(fontsize=8.5, loc=where)
    figure.suptitle(
        f"{bicycle.name}: the boundaries against damping (grey: up to the measured friction of bearings)",
        y=TITLE,
        fontsize=11,
    )
    place(figure, "damping")
    return figure


def _single_designs(ax: Axes, bicycle: Bicycle, numbers: Damping) -> None:
    for design, colour, style in zip(numbers.single_designs, _COLOURS, _STYLES, strict=True):
        delta = np.geomspace(numbers.deltas[0], numbers.deltas[-1], _SAMPLES)
        delta = np.union1d(delta, [design.at_onset.delta] if design.at_onset else [])
        rows = first_intervals(bicycle, design.lam, design.sigma, delta.tolist())
        V1 = [_or_gap(row.V1) for row in rows]
        V2 = [_or_gap(row.V2) for row in rows]
        label = f"λ = {design.lam:.2f}, σ = {design.sigma:.2f}"
        ax.plot(delta, V1, color=colour, ls=style, lw=1.8, label=label)
        ax.plot(delta, V2, color=colour, ls=style, lw=0.9)
    ax.set_ylabel(LABELS["V"])
    ax.set_title("thick: V₁; thin: V₂ (capsize, but weave at λ = 0.03), where bounded", fontsize=10)
    ax.set_ylim(2, V[1])


def _measures(ax: Axes, numbers: Damping) -> None:
    measures = {
        "volume of the region": [row.volume_change for row in numbers.everywhere.changes],
        "V₁, median over designs": [row.V1_change_median for row in numbers.everywhere.changes],
    }
    for i, lam in enumerate(numbers.folds_at_lam):
        measures[f"smallest stable σ at λ = {lam:g}"] = [
            row.sigma_min_change[i] for row in numbers.everywhere.changes
        ]
    for (label, values), colour, style in zip(measures.items(), _COLOURS, _STYLES, strict=False):
        percent = [100 * abs(_or_gap(value)) for value in values]
        ax.plot(numbers.deltas, percent, color=colour, ls=style, lw=1.8, marker="o", ms=3, label=label)
    marked = 100 * THRESHOLDS["marked"]
    ax.axhline(marked, color="0.3", lw=0.8)
    ax.text(numbers.deltas[0] * 1.2, marked * 1.1, f"a marked change: {marked:g} %", path_effects=HALO)
    ax.set(yscale="log", ylabel="|change| against δ = 0 [%]", ylim=(0.01, 400))
    _plain_ticks(ax.set_yticks, [0.01, 0.1, 1, 10, 100])


def _or_gap(value: float | None) -> float:
    return math.nan if value is None else value


def _plain_ticks(set_ticks: Any, values: list[float]) -> None:
    """Ticks of a logarithmic axis as plain numbers."""
    set_ticks(values, labels=[f"{value:g}" for value in values])
