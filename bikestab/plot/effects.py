"""The picture of what each parameter moves of several machines: a mark for each, a row for each parameter."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.model import Floats
from bikestab.plot.headings import rows_of, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import lines_for

_ROWS = 16  # at most
_SEEN = 0.01  # of the largest effect: a row with less shows nothing
_WIDTH, _ROW, _MARK = 3.0, 0.27, 0.055  # inches: of an axis, of a row, and of a mark in it
_LINE = 0.17  # inches of a line of text
_APART = 0.6  # of a row: over which the marks of its machines stand


class Machine(NamedTuple):
    """A machine by name, and by parameter the effects on each result of one per cent more of it.

    ``none`` says of each result why there may be no effects on it.
    """

    name: str
    effects: Mapping[str, tuple[float | None, ...]]
    none: tuple[str, ...] = ()


@own_settings()
def draw_effects(
    machines: Sequence[Machine], names: Sequence[str], title: str, results: Sequence[str]
) -> Figure:
    """Machines side by side, on one scale; ``names`` has the parameters, the largest effects first.

    ``results`` say below each axis what is moved. Raises InputError for more machines than there are lines
    that differ.
    """
    lines = lines_for(len(machines))
    table = {name: _effects(machines, name, len(results)) for name in names}
    rows = _rows(table)
    shown = [*rows][:_ROWS]
    results = [f"{result}{_without(machines, k)}" for k, result in enumerate(results)]
    notes = max(result.count("\n") for result in results) + title.count("\n")
    height = 1.5 + _LINE * notes + max(_ROW, _MARK * len(machines)) * max(len(shown), 4)
    figure = Figure(figsize=(1.4 + _WIDTH * max(len(results), 1.6), height), layout="constrained")
    axes = figure.subplots(1, len(results), sharex=True, sharey=True, squeeze=False)[0]
    at = np.arange(len(shown))
    shifts = _APART * (np.arange(len(machines)) / max(len(machines) - 1, 1) - 0.5)
    marks: list[dict[str, Any]] = [
        {"color": line.color, "marker": line.marker, "ms": 5, "ls": ""} for line in lines
    ]
    for k, (ax, result) in enumerate(zip(axes, results, strict=True)):
        for i, mark in enumerate(marks):
            ax.plot([table[name][k, i] for name in shown], at + shifts[i], **mark)
        _frame(ax, [rows[name] for name in shown])
        ax.set_xlabel(result)
    handles = [entry(short(each.name), **mark) for each, mark in zip(machines, marks, strict=True)]
    legend_below(figure, handles, fontsize=9, handlelength=1)
    left = sum(rows[name].count(",") + 1 for name in rows if name not in shown) + len(names)
    left -= sum(words.count(",") + 1 for words in rows.values())
    less = f"{left} more {'parameter has' if left == 1 else 'parameters have'} less effect"
    figure.suptitle("\n".join([title, *([less] if left else [])]), fontsize=10)
    return figure


def _frame(ax: Axes, names: Sequence[str]) -> None:
    """Rows with their names, apart from each other."""
    ax.axvline(0, color="0.2", lw=0.8, zorder=1)
    ax.set_yticks(np.arange(len(names)), names)
    ax.set_ylim(max(len(names), 1) - 0.5, -0.5)
    between = np.arange(len(names) - 1) + 0.5
    ax.hlines(between, 0, 1, transform=ax.get_yaxis_transform(), color="0.75", lw=0.6, zorder=0)
    ax.tick_params(axis="y", length=0)
    ax.grid(axis="x", color="0.9")
    ax.set_axisbelow(True)
    ax.locator_params(axis="x", nbins=5)


def _without(machines: Sequence[Machine], k: int) -> str:
    """Lines that say which machines have no effects on a result, and why."""
    reasons: dict[str, list[str]] = {}
    for name, effects, none in machines:
        if none and all(values[k] is None for values in effects.values()):
            reasons.setdefault(none[k], []).append(short(name))
    lines = [f"{', '.join(names)}: {reason}" for reason, names in reasons.items()]
    return "".join(f"\n{row}" for line in lines for row in rows_of(line, _WIDTH))


def _effects(machines: Sequence[Machine], name: str, results: int) -> Floats:
    """The effects of a parameter at (result, machine), NaN for none."""
    none = (None,) * results
    rows = [each.effects.get(name, none) for each in machines]
    return np.array([[math.nan if x is None else x for x in row] for row in rows]).T


def _rows(table: Mapping[str, Floats]) -> dict[str, str]:
    """The parameters whose effects can be seen, with the names of others that have the same effects."""
    largest = max((float(np.nanmax(abs(x), initial=0)) for x in table.values()), default=0.0)
    rows: dict[str, str] = {}
    for name, effects in table.items():
        if np.nanmax(abs(effects), initial=0) > _SEEN * largest:
            same = next((one for one in rows if np.allclose(table[one], effects, equal_nan=True)), "")
            rows[same or name] = f"{rows[same]}, {name}" if same else name
    return rows
