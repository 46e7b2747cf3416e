"""The tornado picture: by how many per cent each parameter moves V1 and V2, the largest effects on top."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.design.effects import Row
from bikestab.plot.headings import set_title, short
from bikestab.plot.settings import own_settings

_V1, _V2 = "#004488", "#DDAA33"  # Tol 2021, high contrast
_LEAST = 0.005  # %/%: smaller bars are none to see
_PANEL, _BAR = 4.6, 0.24  # inches


@own_settings()
def draw_tornado(machines: Sequence[tuple[str, Sequence[Row]]]) -> Figure:
    """One panel for each machine: its name, and the rows of one of its stable intervals.

    Bars are per cent of the speed for one per cent of the parameter. Parameters that move neither end by more
    than 0.005 are left out, as are measures of the front that are not in the bicycle's notation.
    """
    shown = [
        (name, [row for row in rows if row["notation"] and _size(row) > _LEAST]) for name, rows in machines
    ]
    most = max((len(rows) for _, rows in shown), default=0)
    figure = Figure(figsize=(_PANEL * max(len(shown), 1), 1.4 + _BAR * max(most, 4)), layout="constrained")
    for i, (name, rows) in enumerate(shown):
        _panel(figure.add_subplot(1, len(shown), i + 1), name, rows, panels=len(shown), first=i == 0)
    return figure


def _panel(ax: Axes, name: str, rows: Sequence[Row], *, panels: int, first: bool) -> None:
    place = np.arange(len(rows))
    shares = {"V1": [row["elasticity_V1"] for row in rows], "V2": [row["elasticity_V2"] for row in rows]}
    for end, color, shift in (("V1", _V1, -0.2), ("V2", _V2, 0.2)):
        ax.barh(place + shift, [share or 0.0 for share in shares[end]], height=0.4, color=color, label=end)
    ax.axvline(0, color="0.2", lw=0.8)
    ax.set_yticks(place, [_label(row) for row in rows])
    ax.set_ylim(max(len(rows), 1) - 0.5, -0.5)
    ax.grid(axis="x", color="0.9")
    ax.set_axisbelow(True)
    ax.set_xlabel("% of the speed for 1 % more")
    set_title(ax, short(name) if rows else f"{short(name)}: no stable speed", panels=panels)
    if first:
        ax.legend(loc="lower right")


def _label(row: Row) -> str:
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return f"{row['name']} = {row['value']:.4g}{unit}"


def _size(row: Row) -> float:
    return max(abs(row["elasticity_V1"] or 0.0), abs(row["elasticity_V2"] or 0.0))
