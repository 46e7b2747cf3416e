"""Pictures of a volume. Exact boundary curves over the growth rate, for print and for colour-blind eyes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
from contourpy import contour_generator
from matplotlib.axes import Axes
from matplotlib.colors import FuncNorm, LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, NullLocator

from bikestab.bicycle import Bicycle
from bikestab.config import AXES, Axis
from bikestab.errors import InputError, ScanError, nearest
from bikestab.model import Floats, Model, characteristic_table
from bikestab.plot_axes import head_angle, label_axes, remarks
from bikestab.routh import condition_polynomials, conditions, violated
from bikestab.spectrum import growth_rate
from bikestab.volume import Volume

IN_PLANE: dict[Axis, tuple[Axis, Axis]] = {
    "lam": ("sigma", "V"),
    "sigma": ("lam", "V"),
    "V": ("lam", "sigma"),
}
SYMBOLS = {"lam": "λ", "sigma": "σ", "V": "V"}
# dark blue, white at zero, orange of middle lightness: the two sides differ in greyscale too
GROWTH = LinearSegmentedColormap.from_list(
    "growth", ["#08306b", "#2f79b5", "#a6cbe3", "#ffffff", "#fddbb0", "#f5a35c", "#d9762b"]
)
EDGES = {"hurwitz3": ("weave", "-"), "p0": ("capsize", (0, (5, 1.5)))}
_SAMPLES = 401  # per axis, for finding the curves; their points are then moved onto the exact zero


@dataclass(frozen=True)
class Section:
    """A plane through the space of λ, σ and V: one axis fixed, the two others along x and y."""

    bicycle: Bicycle
    model: Model
    fixed: Axis
    value: float
    x: Axis
    y: Axis

    def table_and_speed(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Characteristic table and V at points of the plane; x and y broadcast together."""
        at: dict[Axis, Floats] = {self.fixed: np.array(self.value), self.x: x, self.y: y}
        table = characteristic_table(self.bicycle, at["lam"], at["sigma"], model=self.model)
        shape = np.broadcast_shapes(np.shape(at["lam"]), np.shape(at["sigma"]))
        return table.reshape(5, 4, *(1,) * (at["V"].ndim - len(shape)), *shape), at["V"]


def draw_slice(volume: Volume, fixed: Axis, value: float) -> Figure:
    """The picture of the plane in which ``fixed`` has ``value``.

    Growth rate from the volume where it holds that plane, else computed for it. Raises InputError for
    a value outside the grid.
    """
    axis = volume.axis(fixed)
    if not axis[0] <= value <= axis[-1]:
        raise InputError(
            f"{SYMBOLS[fixed]} = {value:g} is outside the volume",
            place=str(volume.path),
            hint=f"allowed: {axis[0]:g} ... {axis[-1]:g}",
        )
    x_name, y_name = IN_PLANE[fixed]
    section = Section(volume.bicycle, volume.model, fixed, value, x_name, y_name)
    x, y = volume.axis(x_name), volume.axis(y_name)
    figure = Figure(figsize=(7.4, 5.2), layout="constrained")
    ax = figure.add_subplot()
    _growth(figure, ax, x, y, _plane(volume, section, x, y))
    _stable_region(figure, ax, section, x, y)
    _decorate(ax, volume, section)
    return figure


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


def slice_name(fixed: str, value: float) -> str:
    """The file name of a slice's picture; two values have two names."""
    short = f"{value:.6g}"
    return f"slice_{fixed}_{short if float(short) == value else repr(float(value))}.png"


def _plane(volume: Volume, section: Section, x: Floats, y: Floats) -> Floats:
    """Growth rate at (y, x)."""
    axis = volume.axis(section.fixed)
    at = int(np.argmin(np.abs(axis - section.value)))
    if "growth_rate" in volume.fields and abs(axis[at] - section.value) <= 1e-9 * (axis[-1] - axis[0]):
        index = tuple(at if name == section.fixed else slice(None) for name in AXES)
        return np.transpose(volume.read("growth_rate", index))  # the file's first axis is along x
    return growth_rate(*section.table_and_speed(x[np.newaxis, :], y[:, np.newaxis]))


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
    for name, (label, style) in EDGES.items():
        curves = edge_curves(section, name, X, Y)
        for curve in curves:
            ax.plot(*curve, color="white", lw=4, solid_capstyle="round", alpha=0.8)
        for curve in curves:
            ax.plot(*curve, color="black", lw=1.8, ls=style)
        if curves:
            handles.append(Line2D([], [], color="black", lw=1.8, ls=style, label=f"{label} boundary"))
    if not inside.any() and not handles:
        ax.text(
            0.5, 0.97, "no stable motion in this plane", transform=ax.transAxes, ha="center", va="top",
            bbox={"facecolor": "white", "alpha": 0.85, "edgecolor": "none"},
        )  # fmt: skip
    if handles:
        figure.legend(handles=handles, loc="outside lower center", ncols=3, handlelength=3, frameon=False)


def edge_curves(section: Section, name: str, X: Floats, Y: Floats) -> list[tuple[Floats, Floats]]:
    """The parts (x, y) of the curve on which a condition is zero that are edges of stability.

    X and Y are the samples (n,) among which curves are looked for; the points are exact.
    """
    parts: list[tuple[Floats, Floats]] = []
    for x, y in zero_curves(section, name, X, Y):
        others = conditions(*section.table_and_speed(x, y))._asdict()
        edge = np.all([v > 0 for key, v in others.items() if key != name], axis=0)
        cuts = np.flatnonzero(np.diff(edge)) + 1
        stretches = np.split(np.arange(len(x)), cuts)
        parts.extend((x[part], y[part]) for part in stretches if edge[part[0]] and len(part) > 1)
    return parts


def zero_curves(section: Section, name: str, X: Floats, Y: Floats) -> list[tuple[Floats, Floats]]:
    """The whole curves (x, y) on which a condition is zero, edges or not."""

    def value(x: Floats, y: Floats) -> Floats:
        table, V = section.table_and_speed(x, y)
        polynomial = condition_polynomials(table)[name]
        used = np.flatnonzero(polynomial.any(axis=tuple(range(1, polynomial.ndim))))
        if not len(used):
            return np.ones(np.broadcast_shapes(x.shape, y.shape))
        result = polynomial[used[-1]]
        for j in range(used[-1] - 1, used[0] - 1, -1):  # without the factor V^m, which is no boundary
            result = result * V + polynomial[j]
        return np.broadcast_to(result, np.broadcast_shapes(x.shape, y.shape))

    samples = value(X[np.newaxis, :], Y[:, np.newaxis])
    lines = cast("list[Floats]", contour_generator(X, Y, samples).lines(0.0))
    steps = (X[1] - X[0], Y[1] - Y[0])
    return [_onto_zero(value, line[:, 0], line[:, 1], steps) for line in lines]


def _onto_zero(value: Any, x: Floats, y: Floats, steps: tuple[float, float]) -> tuple[Floats, Floats]:
    """Move points that are near a zero onto it, along the gradient in units of the sample steps."""
    dx, dy = steps
    for _ in range(3):
        f = value(x, y)
        h = 1e-4
        fx = (value(x + h * dx, y) - value(x - h * dx, y)) / (2 * h)
        fy = (value(x, y + h * dy) - value(x, y - h * dy)) / (2 * h)
        with np.errstate(divide="ignore", invalid="ignore"):
            move = f / (fx**2 + fy**2)
        move = np.where(np.abs(move) * np.hypot(fx, fy) < 1, move, 0)  # a sample step at most
        x, y = x - move * fx * dx, y - move * fy * dy
    return x, y


def _decorate(ax: Axes, volume: Volume, section: Section) -> None:
    c = section.bicycle.c
    label_axes(ax, section.x, section.y, c)
    where = {
        "lam": f"λ = {section.value:.6g} rad (head angle {head_angle(section.value):.2f}°)",
        "sigma": f"σ = {section.value:.6g} (trail {section.value * c:.4g} m)",
        "V": f"V = {section.value:.6g} m/s",
    }[section.fixed]
    ax.set_title(
        f"{volume.text('title')}\n{section.bicycle.name}: {where}{remarks(section.bicycle, section.model)}",
        fontsize=10,
    )
