"""The root locus: eigenvalues in the complex plane as the speed grows, with the speeds written on them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import offset_copy

from bikestab.bicycle import Bicycle
from bikestab.model import ExactTable, Floats, Model, exact_table
from bikestab.modes import Modes, follow
from bikestab.plot.arranged import arrange_plane
from bikestab.plot.arrowheads import draw_arrowheads
from bikestab.plot.axes import HALO, remarks, ticks_inside
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.modes import BAND, STYLES
from bikestab.plot.placing import Room, beside
from bikestab.plot.settings import own_settings
from bikestab.speeds import intervals_of

_SAMPLES = 1201
_MARKS = 11  # speeds that are written, at most
_DOTS = 6.5  # points between dots of one curve, at least
_ABOVE = [(0, 1), (0, -1), (0.6, 1), (-0.6, 1), (0.6, -1), (-0.6, -1), (1, 1), (-1, 1)]  # of real ones
_ALONG = (0, 0.6, -0.6, 1, -1)
_LANE = 3.2  # points from the real axis to eigenvalues that would lie on others there
_COMMON = 0.02  # of the axes' width, that these have in common
_SIDES = [(1, 1), (1, 0), (1, -1), (0, 1), (0, -1), (-1, 1), (-1, 0), (-1, -1)]


@own_settings()
def draw_locus(
    bicycle: Bicycle, lam: float, sigma: float, start: float, stop: float, *, model: Model = "refined"
) -> Figure:
    """The eigenvalues at tilt λ [rad] and trail σ for speeds from ``start`` to ``stop`` [m/s]."""
    table = exact_table(bicycle, lam, sigma, model=model)
    modes = sampled(table, start, stop)
    figure = Figure(figsize=(5.6, 5.0))
    ax = figure.add_subplot()
    left = locus_axes(ax, [modes])
    parts = parts_of(modes)
    drawn = {name: STYLES[name] for name in STYLES if name in {name for name, _, _ in parts}}
    lanes = _lanes(parts, ax.get_xlim())
    handles: list[Any] = [
        entry(f"{name}{_beside(lanes.get(name, 0.0))}", color=color, lw=width)
        for name, (color, width) in drawn.items()
    ]
    handles.append(entry("speed [m/s]", color="0.2", marker=".", ls="none"))
    if ends := ends_within(table, start, stop):
        handles.append(ring_entry())
    words = f"λ = {lam:.4g} rad, σ = {sigma:.4g}{remarks(bicycle, model)}; {_stable(table)}{left}"
    set_title(ax, f"{short(bicycle.name)}: root locus for {start:g} to {stop:g} m/s", words)
    arrange_plane(figure, ax, None, legend_below(figure, [*handles, *common_entries()], handlelength=2))
    room = Room(ax)
    room.curve([0, 0], ax.get_ylim())
    for name, s_part, _ in parts:
        color, width = STYLES[name]
        lane = lanes.get(name, 0.0)
        ax.plot(
            s_part.real, s_part.imag, color=color, lw=width, solid_capstyle="butt",
            transform=_shifted(ax, lane),
        )  # fmt: skip
        room.curve(s_part.real, s_part.imag + _in_data(ax, room, lane))
    places, rings = _draw_rings(ax, room, ends, lanes)
    ringed = np.array(places)
    dots = _dots(ax, room, parts, lanes, start, stop)
    places += [room.at(s.real, y)[0] + [0, lane] for _, s, lane in dots for y in {s.imag, -s.imag}]
    style: dict[str, Any] = {"size": 8, "path_effects": HALO, "zorder": 5}
    for text, y in rings:
        beside(room, ax, text, 0.0, y, away=(4.0, 7.0), marks=ringed, **style)
    style["marks"] = np.array(places)
    for V_dot, s_dot, lane in dots:
        sides = _SIDES if s_dot.imag else _ABOVE if not lane else [(x, np.sign(lane)) for x in _ALONG]
        y = s_dot.imag + _in_data(ax, room, lane)
        beside(room, ax, f"{V_dot:g}", s_dot.real, y, sides=sides, **style)
    for name, s_part, _ in parts:
        draw_arrowheads(ax, room, s_part, lanes.get(name, 0.0))
    return figure


def _draw_rings(
    ax: Axes, room: Room, ends: Sequence[tuple[str, complex]], lanes: dict[str, float]
) -> tuple[list[Floats], list[tuple[str, float]]]:
    """A ring at each eigenvalue where stability ends: their places, and the height of each end's name."""
    places, rings = [], []
    for text, crossing in ends:
        lane = 0.0 if crossing.imag else lanes.get("capsize", 0.0)
        y = crossing.imag + _in_data(ax, room, lane)
        for side in {y, y if not crossing.imag else -y}:
            ax.plot(0, side, "o", ms=6, mfc="none", mec="k", mew=1.1, zorder=5)
            room.mark(0, side, 7)
            places.append(room.at(0, side)[0])
        rings.append((text, y))
    return places, rings


def _lanes(parts: Sequence[tuple[str, Any, Floats]], limits: tuple[float, float]) -> dict[str, float]:
    """How many points above the real axis modes are drawn that would lie on each other there, by name."""
    spans: dict[str, tuple[float, float]] = {}
    for name, s, _ in parts:
        if not s.imag.any():
            x = np.clip(s.real, *limits)
            low, high = spans.get(name, (math.inf, -math.inf))
            spans[name] = min(low, float(x.min())), max(high, float(x.max()))
    least = _COMMON * (limits[1] - limits[0])
    common = [
        name
        for name in sorted(spans, key=[*STYLES].index)
        if any(
            min(high, spans[name][1]) - max(low, spans[name][0]) > least
            for other, (low, high) in spans.items()
            if other != name
        )
    ]
    return {name: _LANE * (2 * i - len(common) + 1) for i, name in enumerate(common)}


def _beside(lane: float) -> str:
    return f" (drawn {'above' if lane > 0 else 'below'} the axis)" if lane else ""


def _shifted(ax: Axes, lane: float) -> Any:
    """The data's transform, so many points higher."""
    figure: Any = ax.figure
    return offset_copy(ax.transData, figure, 0.0, lane, units="points")


def _in_data(ax: Axes, room: Room, lane: float) -> float:
    low, high = ax.get_ylim()
    return lane / float(room.size[1]) * (high - low)


def sampled(table: ExactTable, start: float, stop: float) -> Modes:
    """Modes at speeds that are close to each other, and closer where eigenvalues meet."""
    met = follow(table, start).coalescences
    near = np.outer(met, 1 + np.array([-1e-4, -1e-6, -1e-9, 1e-9, 1e-6, 1e-4])).ravel()
    return follow(table, np.union1d(np.linspace(start, stop, _SAMPLES), near[(near > start) & (near < stop)]))


def locus_axes(ax: Axes, shown: Sequence[Modes], *, upper: bool = False) -> str:
    """The complex plane around all that is shown, or its ``upper`` half; in words what is left out."""
    growth = [modes.eigenvalues.real.max(axis=0) for modes in shown]
    least = min(float(modes.eigenvalues.real.min()) for modes in shown)
    fastest = max(float(np.abs(modes.eigenvalues.imag).max()) for modes in shown)
    sizes = [float(np.abs(rate).max()) for rate in growth]
    left = max(least, float(f"{-(1 if upper else 3) * max(*sizes, fastest, 1.0):.3g}"))
    right = max(*(float(rate.max()) for rate in growth), -0.1 * left)
    high = 1.08 * max(fastest, 0.2 * (right - left))
    beyond = 0.05 * (right - left) if left <= least else 0.0  # the number that is told is the axis' end
    ax.set_xlim(left - beyond, right + 0.08 * (right - left))
    ax.set_ylim(0 if upper else -high, high)
    ax.axvspan(ax.get_xlim()[0], 0, color=BAND, lw=0, zorder=0)
    ax.axvline(0, color="k", lw=0.8, zorder=1)
    ax.axhline(0, color="0.6", lw=0.7, zorder=1)
    ax.set_xlabel("real part [s⁻¹]")
    ax.set_ylabel("imaginary part [rad/s]")
    ticks_inside(ax)
    return "" if left <= least else f"; left of {left:.3g} not shown".replace("-", "−")


def ends_within(table: ExactTable, start: float, stop: float) -> list[tuple[str, complex]]:
    """The ends of stable speeds in a range: in words, and the eigenvalue that crosses, its upper one."""
    found = intervals_of(table)
    ends = []
    for name, values in (("V₁", found.V1), ("V₂", found.V2)):
        for V in values[: found.number].tolist():
            if start < V < stop:
                s = follow(table, V).eigenvalues[:, 0]
                crossing = s[np.argmin(np.abs(s.real))]
                ends.append((f"{name} {V:.3g}", complex(0.0, abs(crossing.imag))))
    return ends


def ring_entry() -> Any:
    """What the legend says of the ends of stable speeds."""
    return entry("V₁ or V₂ [m/s]", color="0.2", marker="o", mfc="none", ls="none")


def common_entries() -> list[Any]:
    """What the legend says of arrowheads and of the shaded half."""
    return [
        Line2D([], [], color="0.2", marker=">", ms=6, ls="none", label="faster"),
        Patch(facecolor=BAND, edgecolor="0.6", lw=0.5, label="dies out"),
    ]


def _stable(table: ExactTable) -> str:
    """At which speeds motion is stable, in words."""
    found = intervals_of(table)
    ends = [
        f"from {V1:.4g} m/s on" if math.inf == V2 else f"from {V1:.4g} to {V2:.4g} m/s"
        for V1, V2 in zip(found.V1[: found.number], found.V2[: found.number], strict=True)
    ]
    return f"stable {', '.join(ends)}" if ends else "never stable"


def parts_of(modes: Modes) -> list[tuple[str, Any, Floats]]:
    """Each branch cut where its name changes: name, eigenvalues, speeds."""
    return [
        (str(names[part[0]]), s[part], modes.V[part])
        for s, names in zip(modes.eigenvalues, modes.names, strict=True)
        for part in np.split(np.arange(len(names)), np.flatnonzero(names[1:] != names[:-1]) + 1)
    ]


def _dots(
    ax: Axes, room: Room, parts: list[tuple[str, Any, Floats]], lanes: dict[str, float],
    start: float, stop: float,
) -> list[tuple[float, complex, float]]:  # fmt: skip
    """Draw dots at round speeds where these are apart on their curve; those above, which get numbers.

    Each with its speed, its eigenvalue, and how many points above this it is drawn.
    """
    steps = np.outer(10.0 ** np.arange(-6, 6), [1, 2, 5]).ravel()
    step = steps[np.searchsorted(steps, (stop - start) / (_MARKS - 1))]
    speeds = np.arange(np.ceil(start / step), np.floor(stop / step) + 1) * step
    (x0, x1), _ = ax.get_xlim(), ax.get_ylim()
    taken = np.empty((0, 2))
    dots = []
    for V in (speeds[0], speeds[-1], *speeds[1:-1]) if len(speeds) > 1 else speeds:
        for name, s, values in parts:
            k = int(np.argmin(np.abs(values - V)))
            if not values[0] <= V <= values[-1] or not x0 <= s[k].real <= x1:
                continue
            lane = lanes.get(name, 0.0)
            place = room.at(s[k].real, s[k].imag) + np.array([0.0, lane])
            if (np.hypot(*(taken - place).T) < _DOTS).any():
                continue
            taken = np.vstack([taken, place])
            ax.plot(s[k].real, s[k].imag, ".", color="0.2", ms=5, zorder=4, transform=_shifted(ax, lane))
            room.mark(s[k].real, s[k].imag + _in_data(ax, room, lane), 3)
            if s[k].imag >= 0:
                dots.append((float(V), complex(s[k]), lane))
    return dots
