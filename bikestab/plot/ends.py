"""The picture of several machines' stable speeds: V1 and V2 over one range of designs, or a bar for each."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.transforms import ScaledTranslation

from bikestab.model import Floats
from bikestab.plot.axes import LABELS, ticks_inside
from bikestab.plot.endbars import draw_bars, nine_tenths
from bikestab.plot.framed import inside, largest_told, top_of
from bikestab.plot.headings import set_title, short
from bikestab.plot.held import held_words, kind_words, share_words
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import Curve, Line, label_curves, lines_for

Run = list[tuple[Mapping[str, Any], Mapping[str, Any]]]  # answers, each with one of its intervals
Answers = Sequence[Mapping[str, Any]]  # as region.answers gives them: one for each design
AXES = {
    "lam": LABELS["lam"], "sigma": LABELS["sigma"], "trail": LABELS["trail"], "offset": LABELS["offset"],
    "head_angle_deg": "head angle [°]",
}  # fmt: skip
_LOWER, _UPPER, _SIDE = 2.2, 1.2, 0.6  # widths of the lines of V1 and V2, and between them at a run's end
_ARROW, _SIZE = "$\u2191$", 9  # where there is no upper limit
_APART, _ROOM = 6.0, 0.03  # points between marks of spreads at one place; beside the first and last of them
_ARROWS, _AWAY = 12, 0.04  # along the axis; above V1, as a share of the axis


@own_settings()
def draw_ends(
    machines: Sequence[tuple[str, Answers]], axis: str, label: str = "", name: str = "", uncertain: str = ""
) -> Figure:
    """Machines by name with their designs' stable speeds; ``axis`` is the key of what varies, or empty.

    Where answers have a ``spread``, as ``design.spread.plain`` gives it, lines are over nine tenths of the
    ends. ``label`` says what it is, if it is none of AXES, and ``name`` whose designs they all are;
    ``uncertain`` names the standard deviations of which the spreads are.
    Raises InputError for more machines than there are lines that differ.
    """
    lines = lines_for(len(machines))
    ends = [V for _, answers in machines for a in answers for i in a["intervals"] for V in (i["V1"], i["V2"])]
    top = top_of(*_weighted(machines, axis))
    figure = Figure(
        figsize=(6.2, 4.4 if axis else 1.25 + 0.45 * len(machines) + 0.5 * bool(uncertain)),
        layout="constrained",
    )
    ax = figure.add_subplot()
    ticks_inside(ax)
    if axis:
        _over(ax, machines, axis, lines, top)
        ax.set_xlabel(label or AXES[axis], parse_math=False)
    else:
        draw_bars(ax, machines, lines, top)
    legend_below(figure, _entries(machines, ends, bool(axis)))
    whose = name or (machines[0][0] if axis and len(machines) == 1 else "")
    whose = f"{short(whose)}: stable speeds" if whose else "Stable speeds"
    held = held_words([answers for _, answers in machines], axis, not name) if axis else ""
    whose += "" if any(V is not None for V in ends) else ": none"
    set_title(ax, *filter(None, [whose, held, uncertain and f"standard deviations: {uncertain}"]))
    return figure


def _weighted(machines: Sequence[tuple[str, Answers]], axis: str) -> tuple[list[Any], list[float]]:
    """All ends, and of how much of the axis each is."""
    ends, weights = [], []
    for _, answers in machines:
        x = np.array([answer[axis] if axis else 0.0 for answer in answers], dtype=float)
        widths = np.abs(np.gradient(x)) if len(np.unique(x)) > 1 else np.ones(len(x))
        for answer, width in zip(answers, widths.tolist(), strict=True):
            for interval in answer["intervals"]:
                ends += [interval["V1"], interval["V2"]]
                weights += [width] * 2
    return ends, weights


def _entries(machines: Sequence[tuple[str, Answers]], ends: Sequence[float | None], over: bool) -> list[Any]:
    """What the legend says: of bars, whose words are beside them, nothing but of what was drawn at random."""
    several = len(machines) > 1
    own = [answers for _, answers in machines]
    above, below = (": stable above", ": stable below") if several else ("", "")
    entries: list[Any] = []
    if over:
        entries.append(entry(f"V₁{above}{kind_words(own, 'lower')}", color="0.3", lw=_LOWER))
        if any(V is not None for V in ends[1::2]):
            entries.append(entry(f"V₂{below}{kind_words(own, 'upper')}", color="0.3", lw=_UPPER))
    if over and several and None in ends:
        entries.append(entry("no upper limit", color="0.3", marker=_ARROW, ms=_SIZE, lw=0))
    if over and not several and ends:
        words = "stable, no upper limit at the frame" if None in ends else "stable"
        entries.append(Patch(facecolor=lines_for(1)[0].color, alpha=0.15, label=words))
    if any("spread" in answer for _, answers in machines for answer in answers):
        share = share_words([answers for _, answers in machines])
        words = "90 % of the machines" + (f" ({share})" if share else "")
        entries.append(entry(words, color="0.3", lw=1, marker="|"))
    return entries


def _over(
    ax: Axes, machines: Sequence[tuple[str, Answers]], axis: str, lines: Sequence[Line], top: float
) -> None:
    """V1 (thick) and V2 (thin) against one quantity; each run of intervals of one kind.

    Of one machine it is shaded between them; of several, whose shades would mix, each end has its name, and
    arrows where there is no upper one.
    """
    values = [answer[axis] for _, answers in machines for answer in answers]
    several, curves = len(machines) > 1, []
    for number, ((name, answers), line) in enumerate(zip(machines, lines, strict=True)):
        runs = [_Run(*_drawn(run, axis)) for run in _runs(answers)]
        range_ = min(values), max(values)
        for x, V1, V2 in runs:
            ax.plot(x, V1, color=line.color, ls=line.ls, lw=_LOWER)
            ax.plot(x, V2, color=line.color, ls=line.ls, lw=_UPPER)
            for k in (0, -1) if several else ():
                upper = V2[k] if np.isfinite(V2[k]) else max(V1[k], top)
                if range_[0] < x[k] < range_[1]:
                    ax.plot([x[k]] * 2, [V1[k], upper], color=line.color, ls=line.ls, lw=_SIDE)
            if not several:
                shaded = np.where(np.isfinite(V2), V2, np.maximum(V1, top))
                ax.fill_between(x, V1, shaded, color=line.color, alpha=0.15, lw=0)
        if several:
            _mark_open(ax, runs, line, range_, top)
        curves += _named(name if several else "", runs, line, range_, top)
        middle = _APART * (number - (len(machines) - 1) / 2)
        for answer in answers:
            for k, (speeds, at) in enumerate(nine_tenths(answer, answer[axis], 0.0, top)):
                aside = ScaledTranslation(
                    (middle + _APART * (k - 0.5) / 2) / 72, 0, ax.figure.dpi_scale_trans
                )
                ax.plot(at, speeds, "_-", color=line.color, lw=1, ms=5, transform=ax.transData + aside)
    room = (
        _ROOM * (max(values) - min(values)) if any("spread" in a for _, own in machines for a in own) else 0
    )
    ax.set_xlim(min(values) - room, max(values) + room)
    ax.set_ylim(0, top)
    ax.set_ylabel(LABELS["V"])
    label_curves(ax, curves)


class _Run(NamedTuple):
    """Values along the axis and the ends there [m/s], V2 NaN where there is none."""

    x: Floats
    V1: Floats
    V2: Floats


def _drawn(run: Run, axis: str) -> tuple[Floats, Floats, Floats]:
    ends = [(interval["V1"], interval["V2"]) for _, interval in run]
    V1, V2 = np.array(ends, dtype=float).T
    return np.array([answer[axis] for answer, _ in run]), V1, V2


def _named(
    name: str, runs: Sequence[_Run], line: Line, range_: tuple[float, float], top: float
) -> list[Curve]:
    """Both ends of all runs as curves with gaps between these, and a name for each.

    Of a machine without a ``name``, which the title has, those that leave the axis.
    """
    if not runs:
        return [Curve(f"{name}: never", np.array([range_[1]]), np.zeros(1), line.color)] if name else []
    curves = []
    for end, what in ((1, "V₁"), (2, "V₂")):
        parts = [inside(run.x, run[end], top) for run in runs]
        x, V = (np.concatenate([[*part[k], np.nan] for part in parts]) for k in (0, 1))
        largest = max(
            (v for run in runs if np.isfinite(v := largest_told(run.x, run[end], top, range_))), default=None
        )
        beyond = "" if largest is None else f"↑ {largest:.4g} m/s"
        words = f"{name} {beyond}".strip()
        if not words or not any(np.isfinite(run[end]).any() for run in runs):
            continue
        if np.isfinite(V).any():
            there = np.isfinite(V) | np.isfinite(x)
            curves.append(Curve(words, x[there], V[there], line.color, what))
        else:  # all of it is above the axis
            middle = np.array([0.5 * (range_[0] + range_[1])])
            curves.append(Curve(words, middle, np.array([top]), line.color, what))
    return curves


def _mark_open(ax: Axes, runs: Sequence[_Run], line: Line, ends: tuple[float, float], top: float) -> None:
    """Arrows above V1 where there is no V2."""
    step = (ends[1] - ends[0]) / _ARROWS
    for x, V1, V2 in runs:
        open_ = np.isnan(V2)
        at = [v for v in ends[0] + step * (0.5 + np.arange(_ARROWS)) if x[0] <= v <= x[-1]]
        at = [v for v in at if np.interp(v, x, V1) < (1 - 2 * _AWAY) * top]
        at = at or x[(1 - 2 * _AWAY) * top > V1][:1].tolist()
        at = [v for v in at if open_[np.argmin(np.abs(x - v))]]
        y = np.interp(at, x, V1) + _AWAY * top
        ax.plot(at, y, marker=_ARROW, ms=_SIZE, color=line.color, lw=0)


def _runs(answers: Answers) -> list[Run]:
    """Intervals of neighbouring designs that go on into each other: they overlap, and end in the same way."""
    done: list[Run] = []
    open_: list[Run] = []
    for answer in answers:
        going_on = []
        for interval in answer["intervals"]:
            run: Run = next((run for run in open_ if _goes_on(run[-1][1], interval)), [])
            if run:
                open_.remove(run)
            going_on.append([*run, (answer, interval)])
        done += open_
        open_ = going_on
    return done + open_


def _goes_on(before: Mapping[str, Any], after: Mapping[str, Any]) -> bool:
    inf = math.inf
    overlap = min(before["V2"] or inf, after["V2"] or inf) > max(before["V1"], after["V1"])
    return overlap and before["lower"] == after["lower"]
