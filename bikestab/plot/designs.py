"""The picture of the (λ, σ) plane: width and ends of the stable interval, skeleton curves, optima."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, PowerNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from bikestab.design.best import Best
from bikestab.design.criteria import Wanted, counted_of
from bikestab.model import Floats
from bikestab.plot.arranged import arrange_plane, title_place
from bikestab.plot.axes import HALO, label_family, remarks
from bikestab.plot.headings import set_title, short
from bikestab.plot.levels import Level, draw_levels, label_levels
from bikestab.plot.lines import draw_on_white, entry, legend_below, straight_fork
from bikestab.plot.optima import draw_optima, part
from bikestab.plot.placing import Room
from bikestab.plot.settings import own_settings
from bikestab.undamped import stable_speeds

# the upper part of cividis: blue is narrow, yellow is wide, and black lines can be read on all of it
WIDTH = ListedColormap(colormaps["cividis"](np.linspace(0.3, 1, 256)), name="width")
# red and its shades are on no place of the colour scale; the dashes tell them apart in greyscale
CURVES: dict[str, tuple[str, Any]] = {
    "fold": ("#a50026", "-"),
    "fold of capsize": ("#a50026", (0, (1, 1.2))),
    "weave meets capsize": ("#a50026", (0, (6, 1.5))),
    "capsize at infinity": ("#7a0177", (0, (1, 1.2))),
    "weave at infinity": ("#7a0177", (0, (4, 1.2, 1, 1.2))),
    "capsize at rest": ("#c2570c", (0, (1, 1.2))),
    "weave at rest": ("#c2570c", (0, (4, 1.2, 1, 1.2))),
    "singular inertia": ("#555555", "-"),
}
_OTHER = ("#555555", (0, (2, 1)))
_SAMPLES = 241  # per axis


class Curve(Protocol):
    """A curve of the (λ, σ) plane, as bikestab.region.curves traces them."""

    @property
    def name(self) -> str: ...
    @property
    def x(self) -> Floats: ...
    @property
    def y(self) -> Floats: ...


@own_settings()
def draw_designs(wanted: Wanted, best: Best, curves: Sequence[Curve] = ()) -> Figure:
    """The box of ``wanted``, which needs a length in λ and σ, with the designs found and skeleton curves."""
    figure = Figure(figsize=(6.2, 5.9))
    ax = figure.add_subplot()
    x, y = (np.linspace(*ends, _SAMPLES) for ends in (wanted.x, wanted.y))
    ax.set_xlim(*wanted.x)
    ax.set_ylim(*wanted.y)
    ax.set_facecolor("white")
    family = wanted.family
    bar, handles, levels = _widths(figure, ax, wanted, x, y)
    handles += _curves(ax, curves)
    handles += straight_fork(ax, family.bicycle) if family.of_front else []
    label_family(ax, family.x, family.y, family)
    found, marks = draw_optima(ax, wanted, best)
    what = f"widest interval of stable speeds up to {wanted.V_max:g} m/s"
    unusual = remarks(family.bicycle, family.model, {family.x, family.y})
    set_title(ax, f"{short(family.bicycle.name)}{unusual}: {what}", **title_place(ax))
    rows = legend_below(figure, [*handles, *found], handlelength=2.8, fontsize=9)
    arrange_plane(figure, ax, bar, rows)
    room = Room(ax)
    for line in ax.lines:  # skeleton curves, and the front
        room.line(line)
    part(ax, marks, room)
    label_levels(ax, levels, room)
    return figure


def _widths(
    figure: Figure, ax: Axes, wanted: Wanted, x: Floats, y: Floats
) -> tuple[Axes | None, list[Any], list[Level]]:
    """Colours, and lines of equal V1 and V2, of each design's widest interval.

    The axes of the colour bar, entries of the legend, and the lines.
    """
    X, Y = np.meshgrid(x, y)
    designs = counted_of(replace(wanted, stable=None), stable_speeds(wanted.table(np.stack([X, Y]))))
    widest = np.argmax(designs.width, axis=-1)[..., np.newaxis]
    width, V1, V2 = (
        np.take_along_axis(values, widest, axis=-1)[..., 0]
        for values in (designs.width, designs.intervals.V1, designs.intervals.V2)
    )
    some = width > 0
    bar, levels = None, list[Level]()
    handles: list[Any] = []
    if some.any():
        bar = _colour(figure, ax, x, y, width)
        capped = some & (wanted.V_max < V2)
        if capped.any():
            _hatch(ax, x, y, capped, "..", "0.35")
            handles.append(_patch("..", "0.35", f"V₂ above {wanted.V_max:g} m/s or unbounded", WIDTH(0.95)))
        for values, dashes, symbol in (
            (np.where(some, V1, np.nan), "-", "V₁"),
            (np.where(some & ~capped, V2, np.nan), (0, (5, 2)), "V₂"),
        ):
            if drawn := draw_levels(ax, x, y, _without_jumps(values), dashes, symbol):
                levels += drawn
                handles.append(entry(f"{symbol} [m/s]", color="black", lw=1, ls=dashes))
    else:
        ax.text(
            0.5, 0.5, f"no stable speed below {wanted.V_max:g} m/s", transform=ax.transAxes, ha="center",
            path_effects=HALO,
        )  # fmt: skip
    handles += _refused(ax, wanted, x, y)
    if not some.all():
        handles.append(Patch(facecolor="white", edgecolor="0.5", lw=0.6, label="no stable speed"))
    return bar, handles, levels


def _colour(figure: Figure, ax: Axes, x: Floats, y: Floats, width: Floats) -> Axes:
    image = ax.pcolormesh(
        x, y, np.ma.masked_where(width <= 0, width), cmap=WIDTH, shading="nearest", rasterized=True,
        norm=PowerNorm(0.5, vmin=0, vmax=float(width.max())),  # most widths are far below the cap
    )  # fmt: skip
    bar = figure.colorbar(image, ax=ax)
    bar.set_label("width of the widest stable interval [m/s]")
    return bar.ax


def _refused(ax: Axes, wanted: Wanted, x: Floats, y: Floats) -> list[Any]:
    """Hatches over the designs that are not as asked for; what the legend says of them."""
    X, Y = np.meshgrid(x, y)
    allowed = wanted.within(np.stack([X, Y]))
    refused = np.any(np.abs(allowed - [X, Y]) > 1e-9, axis=0)
    outside = [
        f"{name} outside {ends[0]:g} … {ends[1]:g} m"
        for name, ends in (("trail", wanted.trail), ("offset", wanted.offset))
        if ends and refused.any()
    ]
    if wanted.stable:
        refused |= ~counted_of(wanted, stable_speeds(wanted.table(np.stack([X, Y])))).any
    if not refused.any():
        return []
    ax.contourf(x, y, refused.astype(float), levels=[0.5, 1.5], colors=["white"], alpha=0.55)
    _hatch(ax, x, y, refused, "////", "0.45")
    A, B = wanted.stable or (0.0, 0.0)
    asked = [f"not stable from {A:g} to {B:g} m/s"] if wanted.stable else []
    return [_patch("////", "0.45", " or ".join([*asked, *outside]), "0.92")]


def _hatch(ax: Axes, x: Floats, y: Floats, where: Any, pattern: str, color: str) -> None:
    lines = ax.contourf(x, y, where.astype(float), levels=[0.5, 1.5], colors="none", hatches=[pattern])
    lines.set_edgecolor(color)
    lines.set_linewidth(0)


def _patch(pattern: str, color: str, label: str, face: Any) -> Patch:
    return Patch(facecolor=face, hatch=pattern, edgecolor=color, lw=0, label=label)


def _without_jumps(values: Floats) -> Floats:
    """NaN for the samples at a jump from one interval to another, along which contours would pile up."""
    steps = [np.abs(np.diff(values, axis=axis)) for axis in (0, 1)]
    result = values.copy()
    for axis, step in enumerate(steps):
        usual = np.nanmedian(step) if np.isfinite(step).any() else 0.0
        jump = step > max(40 * usual, 0.5)
        first: list[Any] = [slice(None)] * 2
        first[axis] = slice(None, -1)
        result[tuple(first)][jump] = np.nan
    return result


def _curves(ax: Axes, curves: Sequence[Curve]) -> list[Any]:
    styles: dict[str, tuple[str, Any]] = {}
    for curve in curves:
        color, dashes = styles.setdefault(curve.name, CURVES.get(curve.name, _OTHER))
        draw_on_white(ax, [(curve.x, curve.y)], lw=1.9, color=color, ls=dashes, zorder=3)
    return [entry(name, lw=1.9, color=color, ls=dashes) for name, (color, dashes) in styles.items()]
