"""The root locus of several machines: a kind of line each, with the speeds at which its stability ends."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.model import ExactTable, exact_table
from bikestab.modes import follow
from bikestab.plot.arranged import arrange_plane
from bikestab.plot.arrowheads import draw_arrowheads
from bikestab.plot.axes import HALO
from bikestab.plot.growth import Machine
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.locus import common_entries, locus_axes, parts_of, sampled
from bikestab.plot.placing import Room, beside
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import Line, dark, lines_for
from bikestab.speeds import intervals_of

_LANE = 0.045  # of the height: between lines of real eigenvalues
_AWAY = (3.0, 8.0, 14.0)  # points between a curve and its name, or a mark and its speed


@own_settings()
def draw_loci(machines: Sequence[Machine], start: float, stop: float, name: str = "") -> Figure:
    """The upper halves of the loci from ``start`` to ``stop`` [m/s]; ``name`` is common to all.

    Raises InputError for more machines than there are lines that differ.
    """
    lines = lines_for(len(machines))
    tables = [exact_table(bicycle, lam, sigma, model=model) for _, bicycle, lam, sigma, model in machines]
    shown = [sampled(table, start, stop) for table in tables]
    figure = Figure(figsize=(6.2, 5.0))
    ax = figure.add_subplot()
    left = locus_axes(ax, shown, upper=True)
    high = ax.get_ylim()[1]
    lanes = -_LANE * high * (1 + np.arange(len(machines)))  # real ones of all would lie on each other
    ax.set_ylim(lanes[-1] - _LANE * high, high)
    what = f"root locus for {start:g} to {stop:g} m/s"
    ax.set_yticks([tick for tick in ax.get_yticks() if 0 <= tick <= high])
    half = f"upper half, and below it the real eigenvalues of each{left}"
    set_title(ax, f"{short(name)}: {what}" if name else what.capitalize(), half)
    kinds: list[Any] = [
        entry(short(own), color=line.color, ls=line.ls)
        for (own, *_), line in zip(machines, lines, strict=True)
    ]
    kinds.append(entry("V₁ or V₂ [m/s]", color="0.2", marker="o", mfc="white", ls="none"))
    arrange_plane(figure, ax, None, legend_below(figure, [*kinds, *common_entries()], handlelength=3.4))
    room = Room(ax)
    room.curve([0, 0], ax.get_ylim())
    pairs = []
    for modes, line, lane in zip(shown, lines, lanes, strict=True):
        for _, s, _ in parts_of(modes):
            if s.imag.sum() > 0:
                pairs.append(s)
            elif s.imag.any():
                continue
            y = np.where(s.imag > 0, s.imag, lane)
            ax.plot(s.real, y, color=line.color, ls=line.ls, lw=1.8)
            room.curve(s.real, y)
    for table, line, lane in zip(tables, lines, lanes, strict=True):
        _mark_ends(ax, room, table, line, float(lane), (start, stop))
    for s in pairs:
        draw_arrowheads(ax, room, s)
    return figure


def _mark_ends(
    ax: Axes, room: Room, table: ExactTable, line: Line, lane: float, speeds: tuple[float, float]
) -> None:
    """The eigenvalues that cross the axis in the range of speeds, with these."""
    found = intervals_of(table)
    ends = np.concatenate([found.V1[: found.number], found.V2[: found.number]])
    for V in ends[(ends > speeds[0]) & (ends < speeds[1])].tolist():
        s = follow(table, V).eigenvalues[:, 0]
        crossing = s[np.argmin(np.abs(s.real))]
        y = abs(crossing.imag) or lane
        ax.plot(0, y, "o", ms=5, mfc="white", mec=line.color, mew=1.4, zorder=4)
        room.mark(0, y, 6)
        style: dict[str, Any] = {"size": 8, "path_effects": HALO, "zorder": 5, "away": _AWAY}
        beside(room, ax, f"{V:.3g}", 0, y, color=dark(line.color), **style)
