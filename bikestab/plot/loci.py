"""The root locus of several machines: a kind of line each, with the speeds at which its stability ends."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.model import ExactTable, Floats, exact_table
from bikestab.modes import Modes, follow
from bikestab.plot.arranged import arrange_plane
from bikestab.plot.arrowheads import draw_arrowheads
from bikestab.plot.axes import HALO
from bikestab.plot.growth import Machine
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.locus import common_entries, locus_axes, parts_of, sampled
from bikestab.plot.placing import AROUND, Room, beside
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import Line, dark, lines_for
from bikestab.speeds import intervals_of

_LANE = 0.03  # of the height: between lines of real eigenvalues
_APART = 1.6  # times as much between those of two machines
_COMMON = 0.02  # of the width, that lines in one lane may have in common
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
    runs = [_in_lanes(_real_runs(modes), ax.get_xlim()) for modes in shown]
    heights = np.array([max((lane for lane, _ in own), default=0) + _APART for own in runs])
    lanes = -_LANE * high * (np.cumsum(heights) - heights + _APART)  # each machine's first
    ax.set_ylim(-_LANE * high * (heights.sum() + _APART), high)
    what = f"root locus for {start:g} to {stop:g} m/s"
    ax.set_yticks([tick for tick in ax.get_yticks() if 0 <= tick <= high])
    half = f"upper half; below it, solid, real eigenvalues in the legend's order{left}"
    set_title(ax, f"{short(name)}: {what}" if name else what.capitalize(), half)
    kinds: list[Any] = [
        entry(short(own), color=line.color, ls=line.ls)
        for (own, *_), line in zip(machines, lines, strict=True)
    ]
    kinds.append(entry("V₁ or V₂ [m/s]", color="0.2", marker="o", mfc="none", ls="none"))
    arrange_plane(figure, ax, None, legend_below(figure, [*kinds, *common_entries()], handlelength=3.4))
    room = Room(ax)
    room.curve([0, 0], ax.get_ylim())
    curves = []
    for modes, line, own, first in zip(shown, lines, runs, lanes, strict=True):
        for _, s, _ in parts_of(modes):
            if s.imag.sum() > 0:
                ax.plot(s.real, s.imag, color=line.color, ls=line.ls, lw=1.8)
                curves.append(s)
        for lane, x in own:
            s = x + 1j * (first - lane * _LANE * high)
            ax.plot(s.real, s.imag, color=line.color, lw=1.2)
            curves.append(s)
    for s in curves:
        room.curve(s.real, s.imag)
    for table, line, lane in zip(tables, lines, lanes, strict=True):
        _mark_ends(ax, room, table, line, float(lane), (start, stop))
    for s in curves:
        draw_arrowheads(ax, room, s)
    return figure


def _real_runs(modes: Modes) -> list[Floats]:
    """The real eigenvalues as the speed grows, each as far as it goes one way."""
    runs = []
    for _, s, _ in parts_of(modes):
        if not s.imag.any():
            ways = np.sign(np.diff(s.real))
            turns = np.flatnonzero(ways[1:] * ways[:-1] < 0) + 1
            ends = [0, *turns.tolist(), len(s) - 1]
            runs += [s.real[i : j + 1] for i, j in pairwise(ends) if j > i]
    return runs


def _in_lanes(runs: Sequence[Floats], limits: tuple[float, float]) -> list[tuple[int, Floats]]:
    """Each with the first lane in which it lies on no other; those that reach zero first."""
    least = _COMMON * (limits[1] - limits[0])
    placed = [(0, run) for run in runs if np.ptp(np.clip(run, *limits)) <= least]
    for run in sorted(runs, key=lambda run: not run.min() <= 0 <= run.max()):
        if np.ptp(np.clip(run, *limits)) <= least:
            continue
        low, high = np.clip([run.min(), run.max()], *limits)
        taken = {lane for lane, other in placed if min(high, other.max()) - max(low, other.min()) > least}
        placed.append((next(i for i in range(len(placed) + 1) if i not in taken), run))
    return placed


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
        ax.plot(0, y, "o", ms=5, mfc="none", mec=line.color, mew=1.4, zorder=4)
        room.mark(0, y, 6)
        style: dict[str, Any] = {"size": 8, "path_effects": HALO, "zorder": 5, "away": _AWAY}
        ways = [AROUND] if crossing.imag else [[(1.0, 0.0), (-1.0, 0.0)], AROUND]  # in its lane, if it can
        for sides in ways:
            if beside(room, ax, f"{V:.3g}", 0, y, color=dark(line.color), sides=sides, **style) is not None:
                break
