"""The picture of the eigenvalues against speed, for print: real parts solid, imaginary parts dashed."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, NullLocator

from bikestab.bicycle import Bicycle
from bikestab.model import ExactTable, Floats, Model, exact_table
from bikestab.modenames import OSCILLATING
from bikestab.modes import Modes, follow
from bikestab.plot.arranged import arrange_plane
from bikestab.plot.axes import HALO, LABELS, head_angle, remarks, ticks_inside
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import legend_below
from bikestab.plot.settings import own_settings
from bikestab.speeds import KINDS, intervals_of

# Okabe and Ito (2008), as in pictures of the region and, but for castering, on the page
STYLES: dict[str, tuple[str, float]] = {
    "weave": ("#0072b2", 2.0),
    "capsize": ("#e69f00", 2.0),
    "castering": (
        "#00432f",
        2.6,
    ),  # darker than weave in greyscale, too dark for a dark page
    "real pair": ("#56b4e9", 2.0),
    "real": ("#7b5ea7", 2.0),
    "weave 2": ("#6a8caf", 1.4),
    "capsize 2": ("#d55e00", 1.4),
    "pair 2": ("#cc79a7", 1.4),
}
DASHES = (0, (4.5, 1.8))
BAND = "#dcebd5"
_SAMPLES = 1201
_TICK = 0.05  # least distance of ticks, as a share of the axis
_FIRST_NOTE, _NOTE = 8, 13  # points: above the axes, and of each row of text there
_LETTER = 0.0155  # width of a letter as a share of the picture's, and half the height of a line of text
_HALF_LINE = 0.026
_SEEN = 0.015  # of the axes: a curve that can be seen


class _Line(NamedTuple):
    name: str
    x: Floats
    y: Floats
    imaginary: bool


@own_settings()
def draw_modes(
    bicycle: Bicycle, lam: float, sigma: float, start: float, stop: float, *, model: Model = "refined"
) -> Figure:
    """The eigenvalues at tilt λ [rad] and trail σ [1] for speeds from ``start`` to ``stop`` [m/s]."""
    table = exact_table(bicycle, lam, sigma, model=model)
    met = follow(table, start).coalescences
    near = np.outer(met, 1 + np.array([-1e-4, -1e-6, -1e-9, 1e-9, 1e-6, 1e-4])).ravel()  # steep there
    V = np.union1d(np.linspace(start, stop, _SAMPLES), near[(near > start) & (near < stop)])
    modes = follow(table, V)

    figure = Figure(figsize=(5.6, 4.4))
    ax = figure.add_subplot()
    ax.set_xlim(start, stop)
    _scale(ax, modes)
    ax.axhline(0, color="k", lw=0.8, zorder=1)
    edges, rows = _stable_bands(ax, table)
    lines = _lines(modes)
    for line in lines:
        color, width = STYLES[line.name]
        ax.plot(line.x, line.y, color=color, lw=width, ls=DASHES if line.imaginary else "-")
    missing = _label_lines(ax, lines, edges)
    oscillates = any(line.imaginary for line in lines)

    style: dict[str, Any] = {"color": "0.2", "lw": 1.6}
    handles: list[Any] = [
        Line2D([], [], ls="-", label="real part", **style),
        *([Line2D([], [], ls=DASHES, label="|imaginary part|", **style)] if oscillates else []),
        *(Line2D([], [], color=STYLES[n][0], lw=STYLES[n][1], label=n) for n in missing),
        *([Patch(facecolor=BAND, edgecolor="0.6", lw=0.5, label="stable")] if edges else []),
    ]
    entries = legend_below(figure, handles, handlelength=2.6)
    ax.set_xlabel(LABELS["V"])
    ticks_inside(ax)
    title = (
        f"{short(bicycle.name)}: λ = {lam:.6g} rad (head angle {head_angle(lam):.2f}°), "
        f"σ = {sigma:.6g} (trail {sigma * bicycle.c:.4g} m){remarks(bicycle, model)}"
    )
    above = _FIRST_NOTE + _NOTE * rows
    set_title(ax, title, y=1.0, pad=above)
    arrange_plane(figure, ax, None, entries, above / 72)
    return figure


def _scale(ax: Axes, modes: Modes) -> None:
    """Linear near zero, where stability is decided, and logarithmic beyond it, for castering."""
    s = modes.eigenvalues
    growth = s.real.max(axis=0)
    steps = np.outer(10.0 ** np.arange(-3, 0), [1, 2, 5]).ravel()
    linear = float(steps[max(np.searchsorted(steps, 4 * np.median(np.abs(growth)), "right") - 1, 0)])
    ends = np.array(
        [min(float(s.real.min()), -linear), max(float(growth.max()), float(s.imag.max()), linear)]
    )
    low, high = np.arcsinh(ends / linear) * 1.06
    ax.set_yscale("asinh", linear_width=linear)
    ax.set_ylim(linear * math.sinh(low), linear * math.sinh(high))
    ticks = [0.0]
    powers = range(6, -6, -1)
    for size in (digit * 10.0**power for digit in (1, 5, 2) for power in powers):
        for tick in (size, -size):
            at = np.arcsinh(np.array([tick, *ticks]) / linear) / (high - low)
            if ends[0] * 1.05 <= tick <= ends[1] * 1.05 and np.abs(at[1:] - at[0]).min() > _TICK:
                ticks.append(tick)
    ax.yaxis.set_major_locator(FixedLocator(ticks))
    ax.yaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_major_formatter(lambda tick, _: f"{tick:g}".replace("-", "−"))
    ax.set_ylabel(f"eigenvalue [s⁻¹]  (scale logarithmic beyond ±{linear:g})")


def _lines(modes: Modes) -> list[_Line]:
    """Each branch cut where its name changes; of a complex pair only the upper half."""
    lines = []
    for s, names in zip(modes.eigenvalues, modes.names, strict=True):
        for part in np.split(np.arange(len(names)), np.flatnonzero(names[1:] != names[:-1]) + 1):
            name, x = str(names[part[0]]), modes.V[part]
            oscillates = name in OSCILLATING
            if oscillates and s.imag[part].sum() < 0:
                continue
            lines.append(_Line(name, x, s.real[part], False))
            if oscillates:
                lines.append(_Line(name, x, s.imag[part], True))
    return lines


def _stable_bands(ax: Axes, table: ExactTable) -> tuple[list[float], int]:
    """Shade the stable speeds; write their ends above the frame. The ends, and how many rows of text."""
    start, stop = ax.get_xlim()
    found = intervals_of(table)
    edges: list[float] = []
    notes: list[tuple[float, str, str]] = []  # place from 0 to 1, preferred side, text
    for V1, V2, lower, upper in zip(*(values[: found.number] for values in found), strict=True):
        digits = max(3, 2 - math.floor(math.log10(V2 - V1))) if math.inf > V2 else 3
        first = f"V₁ = {V1:.{digits}f} m/s ({KINDS[lower]})" if V1 > 0 else "stable from rest"
        last = f"V₂ = {V2:.{digits}f} m/s ({KINDS[upper]})" if math.inf > V2 else "no upper limit"
        if start >= V2 or stop <= V1:
            notes.append((0.0, "left", f"← {last}") if start >= V2 else (1.0, "right", f"{first} →"))
            continue
        ax.axvspan(max(V1, start), min(V2, stop), color=BAND, lw=0, zorder=0)
        edges += [float(np.clip(V, start, stop)) for V in (V1, V2)]
        for V in (V1, V2):
            if start < V < stop:
                ax.axvline(V, color="0.3", lw=0.9, ls=":", zorder=1)
        notes.append(((V1 - start) / (stop - start), "right", first) if start < V1 else (0, "left", first))
        notes.append(
            ((V2 - start) / (stop - start), "left", last) if stop > V2 else (1, "right", f"{last} →")
        )
    return edges, _write_above(ax, notes or [(0.5, "center", "no stable speed")])


def _write_above(ax: Axes, notes: list[tuple[float, str, str]]) -> int:
    """Write each note beside its place, on the first row and side on which there is room."""
    taken: list[list[tuple[float, float]]] = []
    for x, side, text in notes:
        width = 0.92 * _LETTER * len(text)
        row = 0
        while True:
            if row == len(taken):
                taken.append([])
            for align in dict.fromkeys((side, "left", "right", "center")):
                left = x - width * {"left": 0, "right": 1, "center": 0.5}[align]
                free = all(left >= b or left + width <= a for a, b in taken[row])
                inside = left >= -0.01 and left + width <= 1.01
                if free and (inside or row > 1):
                    break
            else:
                row += 1
                continue
            break
        taken[row].append((left, left + width))
        gap = {"left": 3, "right": -3, "center": 0}[align] if 0 < x < 1 else 0
        ax.annotate(
            text, (x, 1), (gap, 4 + 13 * row), xycoords="axes fraction", textcoords="offset points",
            ha=align, va="bottom", fontsize=9, annotation_clip=False,
        )  # fmt: skip
    return len(taken)


def _label_lines(ax: Axes, lines: list[_Line], edges: list[float]) -> list[str]:
    """Write each mode's name where the lines leave most room; the names for which there is none."""
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    grid = np.linspace(0, 1, 201)
    to_share = ax.transData + ax.transAxes.inverted()

    def share(x: Any, y: Any) -> Floats:
        return to_share.transform(np.stack([x, y], axis=-1))

    dense = [
        share(x := np.linspace(line.x[0], line.x[-1], 300), np.interp(x, line.x, line.y)) for line in lines
    ]
    fixed = [share(left + (right - left) * grid, 0 * grid)]  # the zero line, then the ends of the bands
    fixed += [share(np.full_like(grid, V), low + (high - low) * grid) for V in edges]
    done: set[tuple[str, float]] = set()  # of two that start together, such as a real pair, one is enough
    for i in sorted(range(len(lines)), key=lambda i: np.ptp(dense[i][:, 0])):
        name = lines[i].name + (" (Im)" if lines[i].imaginary else "")
        if np.ptp(dense[i][:, 0]) < 0.04 or (name, dense[i][0, 0]) in done:
            continue
        half = np.array([0.5 * _LETTER * len(name), _HALF_LINE])
        own = dense[i]
        others = np.concatenate([*fixed, *(d for j, d in enumerate(dense) if j != i)])
        beside = np.array(
            [(0, 1.35), (0, -1.35), (1.15, 0), (-1.15, 0), (1, 1.2), (-1, 1.2), (1, -1.2), (-1, -1.2)]
        )
        places = (own[::10, np.newaxis] + beside * half).reshape(-1, 2)
        inside = np.all((places - half > 0.015) & (places + half < 0.985), axis=1)
        free = np.flatnonzero(inside & (_away(places, own, half) > 0.99))
        room = np.zeros(len(places))
        room[free] = np.minimum(_away(places[free], others, half), 4)
        room -= 0.3 * np.abs(places[:, 0] - 0.6) * (room > 0)  # not at the very ends, if it is all the same
        best = int(np.argmax(room))
        if room[best] < 1.2:
            continue
        done.add((name, own[0, 0]))
        x, y = places[best]
        ax.text(
            x, y, name, transform=ax.transAxes, ha="center", va="center", fontsize=9,
            color=_darker(STYLES[lines[i].name][0]), path_effects=HALO,
        )  # fmt: skip
        fixed.append(places[best] + half * np.array([(a, b) for a in (-1, 0, 1) for b in (-1, 0, 1)]))
    seen = {line.name for line, at in zip(lines, dense, strict=True) if np.ptp(at, axis=0).max() > _SEEN}
    return [name for name in STYLES if name in seen - {n for n, _ in done}]


def _away(places: Floats, points: Floats, half: Floats) -> Floats:
    """How far places (place, 2) are from the nearest of some points, by the halves of a text's sides."""
    x, y = ((places[:, [k]] - points[:, k]) / half[k] for k in (0, 1))
    return np.asarray(np.maximum(np.abs(x), np.abs(y)).min(axis=1))


def _darker(color: str) -> tuple[float, ...]:
    """A colour that can be read as text on white."""
    rgb = np.array([int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    light = float(rgb @ (0.299, 0.587, 0.114))
    return tuple(rgb * min(1.0, 0.45 / light))
