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
from matplotlib.transforms import ScaledTranslation, Transform

from bikestab.design.best import Best
from bikestab.design.criteria import Wanted, counted_of
from bikestab.design.optimum import place_in_plane
from bikestab.family import Family
from bikestab.model import Floats
from bikestab.plot.axes import HALO, label_family, remarks
from bikestab.plot.colours import OWN
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import draw_on_white, entry, legend_below, straight_fork
from bikestab.plot.settings import own_settings
from bikestab.undamped import stable_speeds

# the upper part of cividis: blue is narrow, yellow is wide, and black lines can be read on all of it
WIDTH = ListedColormap(colormaps["cividis"](np.linspace(0.3, 1, 256)), name="width")
OPTIMA: dict[str, tuple[str, str, float]] = {  # marker, legend, size
    "own": ("*", "own design", 15),
    "widest": ("^", "widest interval", 9),
    "lowest_V1": ("v", "lowest V₁", 9),
    "fastest_decay": ("D", "fastest decay", 7.5),
}
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
_APART = 15.0  # points: marks that would cover each other
_SAMPLES = 241  # per axis
_STEPS = np.array([0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100])


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
    figure = Figure(figsize=(6.2, 5.9), layout="constrained")
    ax = figure.add_subplot()
    x, y = (np.linspace(*ends, _SAMPLES) for ends in (wanted.x, wanted.y))
    ax.set_xlim(*wanted.x)
    ax.set_ylim(*wanted.y)
    ax.set_facecolor("white")
    handles = _widths(figure, ax, wanted, x, y)
    handles += _curves(ax, curves)
    handles += straight_fork(ax, wanted.family.bicycle) if wanted.family.of_front else []
    handles += _optima(ax, wanted.family, best)
    family = wanted.family
    label_family(ax, family.x, family.y, family)
    legend_below(figure, handles, handlelength=2.8, fontsize=9)
    what = f"widest interval of stable speeds up to {wanted.V_max:g} m/s"
    unusual = remarks(family.bicycle, family.model, {family.x, family.y})
    set_title(ax, f"{short(family.bicycle.name)}{unusual}: {what}")
    return figure


def _widths(figure: Figure, ax: Axes, wanted: Wanted, x: Floats, y: Floats) -> list[Any]:
    """Colours, and lines of equal V1 and V2, of each design's widest interval; entries of the legend."""
    X, Y = np.meshgrid(x, y)
    designs = counted_of(replace(wanted, stable=None), stable_speeds(wanted.table(np.stack([X, Y]))))
    widest = np.argmax(designs.width, axis=-1)[..., np.newaxis]
    width, V1, V2 = (
        np.take_along_axis(values, widest, axis=-1)[..., 0]
        for values in (designs.width, designs.intervals.V1, designs.intervals.V2)
    )
    some = width > 0
    handles: list[Any] = []
    if some.any():
        _colour(figure, ax, x, y, width)
        capped = some & (wanted.V_max < V2)
        if capped.any():
            _hatch(ax, x, y, capped, "..", "0.35")
            handles.append(_patch("..", "0.35", f"V₂ above {wanted.V_max:g} m/s or unbounded", WIDTH(0.95)))
        for values, dashes, label in (
            (np.where(some, V1, np.nan), "-", "V₁ [m/s]"),
            (np.where(some & ~capped, V2, np.nan), (0, (5, 2)), "V₂ [m/s]"),
        ):
            if _contours(ax, x, y, _without_jumps(values), dashes):
                handles.append(entry(label, color="black", lw=1, ls=dashes))
    else:
        ax.text(
            0.5, 0.5, f"no stable speed below {wanted.V_max:g} m/s", transform=ax.transAxes, ha="center",
            path_effects=HALO,
        )  # fmt: skip
    handles += _refused(ax, wanted, x, y)
    if not some.all():
        handles.append(Patch(facecolor="white", edgecolor="0.5", lw=0.6, label="no stable speed"))
    return handles


def _colour(figure: Figure, ax: Axes, x: Floats, y: Floats, width: Floats) -> None:
    image = ax.pcolormesh(
        x, y, np.ma.masked_where(width <= 0, width), cmap=WIDTH, shading="nearest", rasterized=True,
        norm=PowerNorm(0.5, vmin=0, vmax=float(width.max())),  # most widths are far below the cap
    )  # fmt: skip
    figure.colorbar(image, ax=ax, pad=0.02).set_label("width of the widest stable interval [m/s]")


def _refused(ax: Axes, wanted: Wanted, x: Floats, y: Floats) -> list[Any]:
    """Hatches over the designs that are not as asked for; what the legend says of them."""
    X, Y = np.meshgrid(x, y)
    allowed = wanted.within(np.stack([X, Y]))
    refused = np.any(np.abs(allowed - [X, Y]) > 1e-9, axis=0)
    elsewhere = bool(refused.any())
    if wanted.stable:
        refused |= ~counted_of(wanted, stable_speeds(wanted.table(np.stack([X, Y])))).any
    if not refused.any():
        return []
    ax.contourf(x, y, refused.astype(float), levels=[0.5, 1.5], colors=["white"], alpha=0.55)
    _hatch(ax, x, y, refused, "////", "0.45")
    A, B = wanted.stable or (0.0, 0.0)
    asked = [f"not stable from {A:g} to {B:g} m/s"] if wanted.stable else []
    asked += [
        " or ".join(f"other {name}" for name in ("trail", "offset") if getattr(wanted, name))
    ] * elsewhere
    return [_patch("////", "0.45", " or ".join(asked), "0.92")]


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


def _contours(ax: Axes, x: Floats, y: Floats, values: Floats, dashes: Any) -> bool:
    finite = values[np.isfinite(values)]
    if not finite.size or np.ptp(finite) == 0:
        return False
    low, high = np.percentile(finite, [1, 99])
    step = _STEPS[np.searchsorted(_STEPS, (high - low) / 9, "left").clip(max=len(_STEPS) - 1)]
    levels = np.arange(np.ceil(finite.min() / step), np.floor(high / step) + 1) * step
    if not len(levels):
        return False
    lines = ax.contour(x, y, np.ma.masked_invalid(values), levels=levels, colors="black", linewidths=1)
    lines.set_linestyle(dashes)
    texts = ax.clabel(lines, fmt=lambda level: f"{level:g}", fontsize=8, inline_spacing=3)
    for text in texts or []:
        text.set_path_effects(HALO)
    return True


def _curves(ax: Axes, curves: Sequence[Curve]) -> list[Any]:
    styles: dict[str, tuple[str, Any]] = {}
    for curve in curves:
        color, dashes = styles.setdefault(curve.name, CURVES.get(curve.name, _OTHER))
        draw_on_white(ax, [(curve.x, curve.y)], lw=1.9, color=color, ls=dashes, zorder=3)
    return [entry(name, lw=1.9, color=color, ls=dashes) for name, (color, dashes) in styles.items()]


def _optima(ax: Axes, family: Family, best: Best) -> list[Any]:
    handles: list[Any] = []
    frame: dict[str, Any] = {"ls": "", "mec": "black", "clip_on": False, "zorder": 5}
    if len(best.pareto) > 2:
        x, y = zip(*(place_in_plane(family, design) for design in best.pareto), strict=True)
        handles += ax.plot(x, y, marker="o", ms=4.5, mfc="white", mew=0.8, label="width-decay front", **frame)
    taken: list[Floats] = []
    for name, (marker, label, size) in OPTIMA.items():
        design = getattr(best, name)
        if design and design["at"] != "outside the box":
            place = place_in_plane(family, design)
            handles += ax.plot(
                *place, marker=marker, ms=size, mew=1.4, transform=_beside(ax, place, taken),
                mfc=OWN if name == "own" else "white", label=label, **frame,
            )  # fmt: skip
    if best.closest:
        closest = best.closest
        handles += ax.plot(
            *place_in_plane(family, closest), marker="X", ms=9, mfc="white", mew=1.4, label="closest", **frame
        )
    return handles


def _beside(ax: Axes, place: tuple[float, float], taken: list[Floats]) -> Transform:
    """Where a mark is drawn: at its place, or beside it if a mark is there, tied to it by a line."""
    figure: Any = ax.figure
    size = figure.get_size_inches() * ax.get_position().size * 72
    at = (ax.transData + ax.transAxes.inverted()).transform(place) * size
    step = _APART if at[0] < size[0] / 2 else -_APART
    away = 0.0
    while any(np.hypot(at[0] + away - other[0], at[1] - other[1]) < 0.7 * _APART for other in taken):
        away += step
    taken.append(np.array([at[0] + away, at[1]]))
    if away:
        line = {"arrowstyle": "-", "color": "black", "lw": 1, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", place, (away, 0), textcoords="offset points", arrowprops=line, zorder=4)
    return ax.transData + ScaledTranslation(away / 72, 0, figure.dpi_scale_trans)
