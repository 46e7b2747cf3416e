"""Pictures of a volume. Exact boundary curves over the growth rate, for print and for colour-blind eyes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import FuncNorm, LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, NullLocator

from bikestab.config.scanconfig import AXES, Axis
from bikestab.errors import InputError, ScanError, nearest
from bikestab.model import Floats
from bikestab.plot.axes import head_angle, label_axes, remarks
from bikestab.region.section import IN_PLANE, Section, edge_curves
from bikestab.routh import conditions, violated
from bikestab.spectrum import growth_rate_of
from bikestab.volume import Volume

SYMBOLS = {"lam": "λ", "sigma": "σ", "V": "V"}
# dark blue, white at zero, orange of middle lightness: the two sides differ in greyscale too
GROWTH = LinearSegmentedColormap.from_list(
    "growth", ["#08306b", "#2f79b5", "#a6cbe3", "#ffffff", "#fddbb0", "#f5a35c", "#d9762b"]
)
EDGES = {"hurwitz3": ("weave", "-"), "p0": ("capsize", (0, (5, 1.5)))}
_SAMPLES = 401  # per axis, for finding the curves; their points are then moved onto the exact zero


def draw_slice(
    volume: Volume, fixed: Axis, value: float, field: Literal["growth_rate", "probability"] = "growth_rate"
) -> Figure:
    """The picture of the plane in which ``fixed`` has ``value``.

    Growth rate from the volume where it holds that plane, else computed for it; the probability of an
    ensemble is that of the nearest plane of the grid. Raises InputError for a value outside the grid, and
    where there is no ensemble.
    """
    if field == "probability" and field not in volume.fields:
        problem, hint = "has no probability", "a config with 'ensemble:' gives one"
        raise InputError(problem, place=str(volume.path), hint=hint)
    axis = volume.axis(fixed)
    if not axis[0] <= value <= axis[-1]:
        raise InputError(
            f"{SYMBOLS[fixed]} = {value:g} is outside the volume",
            place=str(volume.path),
            hint=f"allowed: {axis[0]:g} ... {axis[-1]:g}",
        )
    near = int(np.argmin(np.abs(axis - value)))
    if field == "probability":
        value = on_grid(volume, fixed, value)
    x_name, y_name = IN_PLANE[fixed]
    section = Section(volume.bicycle, volume.model, fixed, value, x_name, y_name)
    x, y = volume.axis(x_name), volume.axis(y_name)
    figure = Figure(figsize=(7.4, 5.2), layout="constrained")
    ax = figure.add_subplot()
    if field == "probability":
        _probability(figure, ax, x, y, _stored(volume, field, fixed, near), volume.samples)
        _legend(figure, _edges(ax, section, x, y, "boundary without the spread"))
    else:
        _growth(figure, ax, x, y, _growth_rate(volume, section, x, y, near))
        _stable_region(figure, ax, section, x, y)
    _decorate(ax, volume, section)
    return figure


def on_grid(volume: Volume, fixed: Axis, value: float) -> float:
    """The value of the nearest plane of the grid, which is what a picture of the probability shows."""
    axis = volume.axis(fixed)
    near = float(axis[np.argmin(np.abs(axis - value))])
    return value if _same(axis, near, value) else near


def _same(axis: Floats, a: float, b: float) -> bool:
    """Whether two values of an axis differ by no more than its values' rounding."""
    return bool(abs(a - b) <= 1e-9 * (axis[-1] - axis[0]))


def save(figure: Figure, path: Path) -> None:
    """Write the picture in the format of the file's ending."""
    try:
        figure.savefig(path, dpi=160)
    except OSError as error:
        if error.errno == 28:
            raise ScanError(f"{path}: the disk is full") from None
        raise InputError(f"cannot be written ({error.strerror})", place=str(path)) from None
    except ValueError as error:  # matplotlib's word for an unknown file ending
        known = sorted(figure.canvas.get_supported_filetypes())
        raise InputError(
            str(error).split("(")[0].strip(), place=str(path), hint=nearest(path.suffix[1:], known)
        ) from None


def slice_name(planes: Mapping[str, float], field: str = "growth_rate") -> str:
    """The file name of a slice's picture: its plane, and the machine of a sweep; no two have one name."""
    words = ["slice" if field == "growth_rate" else field]
    for name, value in planes.items():
        short = f"{value:.6g}"
        words += [name, short if float(short) == value else repr(float(value))]
    return "_".join(words) + ".png"


def _stored(volume: Volume, field: str, fixed: Axis, at: int) -> Floats:
    """A field of the volume in a plane of its grid, at (y, x)."""
    index = tuple(at if name == fixed else slice(None) for name in AXES)
    return np.transpose(volume.read(field, index))  # the file's first axis is along x


def _growth_rate(volume: Volume, section: Section, x: Floats, y: Floats, near: int) -> Floats:
    """Growth rate at (y, x)."""
    axis = volume.axis(section.fixed)
    if "growth_rate" in volume.fields and _same(axis, axis[near], section.value):
        return _stored(volume, "growth_rate", section.fixed, near)
    return growth_rate_of(*section.table_and_speed(x[np.newaxis, :], y[:, np.newaxis]))


def _growth(figure: Figure, ax: Axes, x: Floats, y: Floats, values: Floats) -> None:
    finite = values[np.isfinite(values)]
    low = max(-float(finite.min(initial=0.0)), 0.01)  # each side has its own scale: decay is the smaller
    high = max(float(finite.max(initial=0.0)), 0.01)
    width = min(0.3, high / 3)  # below it the upper scale is linear, above it logarithmic

    def forward(rate: Floats) -> Floats:
        return np.where(rate < 0, rate / low, np.arcsinh(rate / width) / np.arcsinh(high / width))

    def inverse(part: Floats) -> Floats:
        return np.where(part < 0, part * low, width * np.sinh(part * np.arcsinh(high / width)))

    norm = FuncNorm((forward, inverse), vmin=-low, vmax=high)
    image = ax.pcolormesh(
        x, y, np.ma.masked_invalid(values), norm=norm, cmap=GROWTH, shading="nearest", rasterized=True
    )
    ax.set_facecolor("0.6")  # where an eigenvalue is infinite
    bar = figure.colorbar(image, ax=ax)
    bar.set_label("growth rate [s⁻¹]: largest real part of the eigenvalues")
    ticks = [-low, -low / 2, 0.0, *(t for t in (0.1, 0.3, 1, 3, 10, 30, 100, 300) if width / 4 < t < high)]
    bar.ax.yaxis.set_major_locator(FixedLocator(ticks))
    bar.ax.yaxis.set_minor_locator(NullLocator())
    bar.ax.set_yticklabels([f"{tick:.2g}".replace("-", "−") for tick in ticks])
    bar.ax.axhline(0, color="k", lw=1.2)
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(y[0], y[-1])


def _probability(figure: Figure, ax: Axes, x: Floats, y: Floats, values: Floats, samples: int) -> None:
    image = ax.pcolormesh(x, y, values, vmin=0, vmax=1, cmap="cividis", shading="nearest", rasterized=True)
    bar = figure.colorbar(image, ax=ax)
    bar.set_label(f"probability of stability, {samples} machines")
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(y[0], y[-1])


def _stable_region(figure: Figure, ax: Axes, section: Section, x: Floats, y: Floats) -> None:
    X, Y = np.linspace(x[0], x[-1], _SAMPLES), np.linspace(y[0], y[-1], _SAMPLES)
    table, V = section.table_and_speed(X[np.newaxis, :], Y[:, np.newaxis])
    inside = np.broadcast_to(violated(conditions(table, V)) == 0, (_SAMPLES, _SAMPLES))
    handles: list[Any] = []
    if inside.any():
        dots = ax.contourf(X, Y, inside, levels=[0.5, 1.5], colors="none", hatches=[".."])
        dots.set_edgecolor("0.25")
        dots.set_linewidth(0)
        handles.append(Patch(facecolor=GROWTH(0.3), hatch="..", edgecolor="0.25", lw=0, label="stable"))
    handles += _edges(ax, section, x, y)
    if not handles:
        ax.text(
            0.5, 0.97, "no stable motion in this plane", transform=ax.transAxes, ha="center", va="top",
            bbox={"facecolor": "white", "alpha": 0.85, "edgecolor": "none"},
        )  # fmt: skip
    _legend(figure, handles)


def _edges(ax: Axes, section: Section, x: Floats, y: Floats, word: str = "boundary") -> list[Line2D]:
    """Draw the boundary curves; what the legend says of them."""
    handles = []
    X, Y = np.linspace(x[0], x[-1], _SAMPLES), np.linspace(y[0], y[-1], _SAMPLES)
    for name, (label, style) in EDGES.items():
        curves = edge_curves(section, name, X, Y)
        for curve in curves:
            ax.plot(*curve, color="white", lw=4, solid_capstyle="round", alpha=0.8)
        for curve in curves:
            ax.plot(*curve, color="black", lw=1.8, ls=style)
        if curves:
            handles.append(Line2D([], [], color="black", lw=1.8, ls=style, label=f"{label} {word}"))
    return handles


def _legend(figure: Figure, handles: list[Any]) -> None:
    if handles:
        figure.legend(handles=handles, loc="outside lower center", ncols=3, handlelength=3, frameon=False)


def _decorate(ax: Axes, volume: Volume, section: Section) -> None:
    c = section.bicycle.c
    label_axes(ax, section.x, section.y, c)
    where = {
        "lam": f"λ = {section.value:.6g} rad (head angle {head_angle(section.value):.2f}°)",
        "sigma": f"σ = {section.value:.6g} (trail {section.value * c:.4g} m)",
        "V": f"V = {section.value:.6g} m/s",
    }[section.fixed]
    ax.set_title(
        f"{volume.title}\n{section.bicycle.name}: {where}{remarks(section.bicycle, section.model)}",
        fontsize=10,
    )
