"""The picture of a plane of a volume: exact boundary curves over growth rate, probability or proofs."""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from bikestab.errors import InputError
from bikestab.fields import AXES, Axis
from bikestab.model import Floats
from bikestab.plot.arranged import arrange_plane, title_place
from bikestab.plot.axes import SYMBOLS, head_angle, label_family, remarks
from bikestab.plot.colours import GROWTH, OWN, colour_growth_rate, colour_probability, shares
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import EDGES, draw_on_white, entry, legend_below, straight_fork
from bikestab.plot.narrow import point_to_narrow
from bikestab.plot.proved import colour_proved, proved_in_plane
from bikestab.plot.settings import own_settings
from bikestab.region.section import Section, edge_curves
from bikestab.routh import conditions, violated
from bikestab.spectrum import growth_rate_of
from bikestab.volume import Subject, Volume, check_ranges

PlaneField = Literal["growth_rate", "probability", "certified"]
# per axis, for finding the curves, whose points are then moved onto the exact zero
_SAMPLES = 201
_SMOOTH = 150  # steps along an axis, at least, of the growth rate


@own_settings()
def draw_slice(subject: Subject, fixed: Axis, value: float, field: PlaneField = "growth_rate") -> Figure:
    """The picture of the plane in which ``fixed`` has ``value``, of a volume or of what will be one.

    The growth rate is computed for that plane, as it is for a volume; the probability of an ensemble, which
    must be a volume's, is that of the nearest plane of the grid; what is ``certified``, a volume's too, is so
    of the plane itself. Raises InputError for a value outside the grid, for a plane of which the grid has a
    line alone, and where there is no ensemble or no proof.
    """
    axis = subject.axis(fixed)
    if not axis[0] <= value <= axis[-1]:
        raise InputError(
            f"{SYMBOLS.get(fixed, fixed)} = {value:g} is outside the volume",
            place=str(subject.path),
            hint=f"allowed: {axis[0]:g} ... {axis[-1]:g}",
        )
    if field == "probability":
        value = on_grid(axis, value)
    section = Section(subject.family, fixed, value)
    check_ranges(subject, section.axes, "a picture")
    x, y = (subject.axis(name) for name in section.axes)
    figure = Figure(figsize=(5.6, 4.3))
    ax = figure.add_subplot()
    bar, handles = _coloured(figure, ax, subject, section, field)
    if subject.axes == AXES and fixed == "V" and handles:
        ax.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
        handles += straight_fork(ax, subject.family.bicycle, rim=field != "certified")
    handles += _own_design(ax, section)
    _decorate(ax, subject, section)
    arrange_plane(figure, ax, bar, legend_below(figure, handles))
    return figure


def on_grid(axis: Floats, value: float) -> float:
    """The value of the nearest plane of the grid, unless they differ by no more than rounding."""
    near = float(axis[np.argmin(np.abs(axis - value))])
    return value if abs(near - value) <= 1e-9 * (axis[-1] - axis[0]) else near


def _coloured(
    figure: Figure, ax: Axes, subject: Subject, section: Section, field: PlaneField
) -> tuple[Axes | None, list[Any]]:
    """Draw a plane's field and curves; the axes of its colour bar if it has one, and what the legend says."""
    x, y = (subject.axis(name) for name in section.axes)
    if field == "certified":
        cells = proved_in_plane(subject, section.fixed, section.value)
        return None, [*colour_proved(ax, x, y, cells), *_edges(ax, section, x, y, rim=False)]
    if field == "probability":
        if not isinstance(subject, Volume) or field not in subject.fields:
            problem, hint = "has no probability", "a config with 'ensemble:' gives one"
            raise InputError(problem, place=str(subject.path), hint=hint)
        probability = _probability(subject, section.fixed, section.value)
        bar = colour_probability(figure, ax, x, y, probability, subject.samples)
        return bar, _edges(ax, section, x, y, spread=True) + shares(probability)
    fine = _refined(x), _refined(y)
    growth = growth_rate_of(*section.table_and_speed(fine[0][np.newaxis, :], fine[1][:, np.newaxis]))
    bar = colour_growth_rate(figure, ax, *fine, growth)
    return bar, _stable_region(ax, section, x, y)


def _probability(volume: Volume, fixed: Axis, value: float) -> Floats:
    """That of a plane of the grid, at (y, x)."""
    at = int(np.argmin(np.abs(volume.axis(fixed) - value)))
    index = tuple(at if name == fixed else slice(None) for name in volume.axes)
    return np.transpose(volume.read("probability", index))  # the file's first axis is along x


def _stable_region(ax: Axes, section: Section, x: Floats, y: Floats) -> list[Any]:
    """Dots where motion is stable, and its boundary; what the legend says of them."""
    X, Y = _samples(x, y)
    table, V = section.table_and_speed(X[np.newaxis, :], Y[:, np.newaxis])
    inside = np.broadcast_to(violated(conditions(table, V)) == 0, (len(Y), len(X)))
    handles: list[Any] = []
    if inside.any():
        dots = ax.contourf(X, Y, inside, levels=[0.5, 1.5], colors="none", hatches=[".."])
        dots.set_edgecolor("0.25")
        dots.set_linewidth(0)
        handles.append(Patch(facecolor=GROWTH(0.3), hatch="..", edgecolor="0.25", lw=0, label="stable"))
    handles += _edges(ax, section, x, y)
    drawn = [(np.asarray(x), np.asarray(y)) for x, y in (line.get_data() for line in ax.lines)]
    point_to_narrow(ax, X, Y, inside, drawn)
    if not handles:
        ax.text(
            0.5, 0.97, "no stable motion in this plane", transform=ax.transAxes, ha="center", va="top",
            bbox={"facecolor": "white", "alpha": 0.85, "edgecolor": "none"},
        )  # fmt: skip
    return handles


def _refined(axis: Floats) -> Floats:
    """The values of an axis, and as many between them that steps of the colour are not seen."""
    parts = -(-_SMOOTH // max(len(axis) - 1, 1))
    return np.interp(np.arange((len(axis) - 1) * parts + 1) / parts, np.arange(len(axis)), axis)


def _samples(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    return np.linspace(x[0], x[-1], _SAMPLES), np.linspace(y[0], y[-1], _SAMPLES)


def _edges(
    ax: Axes, section: Section, x: Floats, y: Floats, *, rim: bool = True, spread: bool = False
) -> list[Line2D]:
    """Draw the boundary curves, thin where there is a ``spread`` around; what the legend says of them.

    A white ``rim`` would be read as undecided where white means this.
    """
    handles = []
    for name, curves in edge_curves(section, list(EDGES), *_samples(x, y)).items():
        label, style = EDGES[name]
        if curves:
            lw, word = (1.2, ", no spread") if spread else (1.8, " boundary")
            draw_on_white(ax, curves, lw=lw, rim=rim and not spread, color="black", ls=style)
            handles.append(entry(label + word, lw=lw, color="black", ls=style))
    return handles


def _own_design(ax: Axes, section: Section) -> list[Line2D]:
    """Mark the bicycle's own design, where the plane has it; what the legend says of it."""
    names = [parameter.name for parameter in section.family.parameters]
    own = {n: v for n, v in zip(names, section.family.own, strict=True) if v is not None}
    if len(own) < len(names):
        return []
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    if section.fixed == "V":
        x, y = (own[name] for name in section.axes)
        if not (left <= x <= right and bottom <= y <= top):
            return []
        style: dict[str, Any] = {"marker": "*", "ms": 15, "mfc": OWN, "mec": "black", "ls": "none"}
        return ax.plot(x, y, label="own design", zorder=5, clip_on=False, **style)
    here = own.pop(section.fixed)
    (x,) = own.values()
    if not (left <= x <= right and np.isclose(here, section.value, rtol=1e-9, atol=0)):
        return []
    over_frame: dict[str, Any] = {"zorder": 1.5 if left < x < right else 3, "clip_on": False}
    return [ax.axvline(x, color=OWN, lw=1.6, label="own design", **over_frame)]


def _decorate(ax: Axes, subject: Subject, section: Section) -> None:
    family, bicycle, value = section.family, section.family.bicycle, section.value
    label_family(ax, *section.axes, family)
    where = {p.name: f"{p.symbol} = {value:.6g} {p.unit}".removesuffix(" 1") for p in family.parameters}
    if "head_angle" in where:
        where["head_angle"] = f"head angle {math.degrees(value):.6g}°"
    where["V"] = f"V = {value:.6g} m/s"
    if "lam" in where:
        where["lam"] += f" (head angle {head_angle(value):.2f}°)"
    if subject.axes == AXES:
        where["sigma"] += f" (trail {value * bicycle.c:.4g} m)"
    unusual = remarks(bicycle, family.model, {family.x, family.y})
    set_title(ax, subject.title, f"{short(bicycle.name)}: {where[section.fixed]}{unusual}", **title_place(ax))
