"""A machine from its side, to scale, with the symbols of its parameters in its own notation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from bikestab.bicycle import Bicycle
from bikestab.plot.axes import HALO, head_angle
from bikestab.plot.headings import set_title, short
from bikestab.plot.placing import AROUND, Room, beside, half_size
from bikestab.plot.settings import own_settings

_REAR, _FRONT, _AXIS = "#0072b2", "#d55e00", "0.35"  # Okabe and Ito 2008
_ABOVE = 1.25  # the steering axis is drawn up to this share of the highest centre of mass or wheel

_HIGH = 0.66  # of the axes' width, where words have room
_SIZE = 9  # of words
_AWAY = (3.0, 10.0, 20.0, 32.0, 45.0, 60.0, 80.0, 105.0)  # points, from what they are of
_TIED = 12.0  # points: words that are further away are tied to it
_RIGHT = [(1, -1), (1, 1), (1, 0), (-1, -1), (-1, 1), (-1, 0)]
_LEFT = [(-1, -1), (-1, 0), (1, 0), (1, -1), (-1, 1), (1, 1)]

Point = tuple[float, float]


class Words(NamedTuple):
    """Words, what they are of, and on which of its sides they may stand."""

    text: str
    at: Point
    sides: Sequence[tuple[float, float]]
    color: str = "black"


@own_settings()
def draw_side(bicycle: Bicycle, lam: float, sigma: float) -> Figure:
    """The machine upright, going to the right, at tilt λ [rad] and trail σ [1]; all lengths in m."""
    figure = Figure(figsize=(6.2, 5.0), layout="constrained")
    ax = figure.add_subplot()
    write_words(ax, side_axes(ax, bicycle, lam, sigma))
    return figure


def side_axes(ax: Axes, bicycle: Bicycle, lam: float, sigma: float) -> list[Words]:
    """The same in axes of a picture; the words are yet to be written."""
    p = bicycle
    of = p.bodies or {}
    heights = [-of[z] for m, z in (("mB", "zB"), ("mH", "zH"), ("rider.m", "rider.z")) if of.get(m)]
    top = _ABOVE * max(p.h1, p.h2, 2 * p.R1, 2 * p.R2, *heights)
    trail, c1 = sigma * p.c, sigma * p.c * np.cos(lam)
    foot = (p.c + trail, 0.0)
    up = np.array([-np.sin(lam), np.cos(lam)])

    ax.axhline(0, color="0.2", lw=1)
    words = _wheels(ax, p)
    head = foot + up * top / np.cos(lam)
    ax.plot(*zip(foot, head, strict=True), color=_AXIS, lw=1.4, ls=(0, (8, 2, 2, 2)))
    words.append(_tilt(ax, foot, lam, top))
    masses = _masses(ax, p, _on_axis(foot, up, 0.75 * top))
    step = 0.056 * (p.c + p.R1 + p.R2)
    wheelbase, along = ("c", "c2 = σ c") if p.bodies is None else ("w", "c")
    words += [
        _length(ax, (0, -step), (p.c, -step), f"{wheelbase} = {_m(p.c)}"),
        _length(ax, (p.c, -2 * step), (p.c + trail, -2 * step), f"{along} = {_m(trail)}"),
    ]
    if p.R2:  # of a skate it is −c1
        b = p.R2 * np.sin(lam) - c1
        words.append(_to_axis(ax, (p.c, p.R2), -b, lam, f"b = {_m(b)}"))
    if p.bodies is None:
        d = p.h2 * np.sin(lam) + (p.l2 - p.c) * np.cos(lam) - c1
        words.append(_to_axis(ax, (p.c, 0.0), c1, lam, f"c1 = {_m(c1)}"))
        words.append(_to_axis(ax, (p.l2, p.h2), -d, lam, f"d = {_m(d)}"))
    words = [*masses, *words, Words("steering axis", (float(head[0]), float(head[1])), _LEFT, _AXIS)]

    ax.set_aspect("equal")
    ax.margins(x=0.2, y=0.08)
    left, right = ax.get_xlim()
    ax.set_ylim(-4 * step, max(1.08 * top, _HIGH * (right - left) - 4 * step))
    ax.set_xlabel("ahead of the rear contact [m]")
    ax.set_ylabel("above the ground [m]")
    what = f"λ = {lam:.4g} rad (head angle {head_angle(lam):.2f}°), σ = {sigma:.4g}"
    set_title(ax, f"{short(p.name)}: {what}")
    return words


def write_words(ax: Axes, words: Sequence[Words]) -> None:
    """The words where they cover nothing, tied to what they are of where that is not beside it."""
    figure: Any = ax.figure
    figure.draw_without_rendering()  # for the axes' place
    room = Room(ax)
    room.curve(ax.get_xlim(), (0, 0))
    for line in ax.lines[1:]:  # but for faint ones
        if line.get_linestyle() != ":" and not line.get_alpha():
            room.line(line)
    angle = np.linspace(0, 2 * np.pi, 200)
    for wheel in ax.patches:
        if isinstance(wheel, Circle):
            (x, y), radius = wheel.center, wheel.radius
            room.curve(x + radius * np.cos(angle), y + radius * np.sin(angle))
    for text, (x, y), sides, color in words:
        style: dict[str, Any] = {"size": _SIZE, "color": color, "path_effects": HALO, "zorder": 6}
        place = beside(room, ax, text, x, y, away=_AWAY, sides=sides, needed=True, **style)
        point, half = room.at(x, y)[0], half_size(text, _SIZE)
        near = point if place is None else np.clip(point, place - half, place + half)
        if np.hypot(*(near - point)) > _TIED:
            tie = {"arrowstyle": "-", "color": "0.45", "lw": 0.6, "shrinkA": 0, "shrinkB": 0}
            to = tuple(near / room.size)
            ax.annotate("", (x, y), to, textcoords="axes fraction", arrowprops=tie, zorder=5)


def _m(length: float) -> str:
    return f"{length:.3g} m".replace("-", "−")


def _on_axis(foot: Point, up: Any, height: float) -> Point:
    x, y = np.asarray(foot) + up * height / up[1]
    return float(x), float(y)


def _wheels(ax: Axes, p: Bicycle) -> list[Words]:
    if p.bodies is not None:
        names = ("rR", f"mR = {p.bodies['mR']:.4g} kg"), ("rF", f"mF = {p.bodies['mF']:.4g} kg")
    else:
        names = (("R", ""), ("", "")) if p.R1 == p.R2 else (("R1", ""), ("R2", ""))
    return [
        *_wheel(ax, (0, p.R1), p.R1, _REAR, *names[0]),
        *_wheel(ax, (p.c, p.R2), p.R2, _FRONT, *names[1]),
    ]


def _wheel(ax: Axes, centre: Point, radius: float, color: str, name: str, mass: str) -> list[Words]:
    ax.add_patch(Circle(centre, radius, fill=False, ec=color, lw=2.2))
    ax.plot(*centre, "o", color=color, ms=4)
    if not (radius and name):
        return []
    ax.plot([centre[0], centre[0] - radius], [centre[1]] * 2, color=color, lw=0.8)
    text = f"{name} = {_m(radius)}" + (f"\n{mass}" if mass else "")
    return [Words(text, (centre[0] - radius / 2, centre[1]), [(0, 1), (0, -1)])]


def _masses(ax: Axes, p: Bicycle, on_axis: Point) -> list[Words]:
    """Centres of mass: of the two parts, or of the bodies in the notation of Meijaard et al. (2007)."""
    rear, front = [(0.0, p.R1), on_axis], [(p.c, p.R2), on_axis]
    if p.bodies is None:
        return [
            _mass(ax, (p.l1, p.h1), f"M1: {p.m1:.4g} kg", ("l1", "h1"), _REAR, rear),
            _mass(ax, (p.l2, p.h2), f"M2: {p.m2:.4g} kg", ("l2", "h2"), _FRONT, front),
        ]
    of = p.bodies
    found = []
    for name, mass, x, z, color, joints in (
        ("rider.", "rider.m", "rider.x", "rider.z", _REAR, []), ("B", "mB", "xB", "zB", _REAR, rear),
        ("H", "mH", "xH", "zH", _FRONT, front),
    ):  # fmt: skip
        if of.get(mass):
            joints = joints or [(of["xB"], -of["zB"])]
            words = f"{name.removesuffix('.')}: {mass} = {of[mass]:.4g} kg"
            found.append(_mass(ax, (of[x], -of[z]), words, (x, z), color, joints, down=True))
    return found


def _mass(
    ax: Axes, at: Point, words: str, names: tuple[str, str], color: str, joints: list[Point],
    *, down: bool = False,
) -> Words:  # fmt: skip
    """A centre of mass with its coordinates, the second positive ``down``, and lines to its joints."""
    for joint in joints:
        ax.plot(*zip(at, joint, strict=True), color=color, lw=1.6, alpha=0.35)
    ax.plot([at[0], at[0]], [0, at[1]], color=color, lw=0.7, ls=":")
    ax.plot(*at, "o", ms=11, mfc="white", mec=color, mew=2)
    ax.plot(*at, "+", ms=9, color=color)
    x, y = names
    return Words(f"{words}\n{x} = {_m(at[0])}\n{y} = {_m(-at[1] if down else at[1])}", at, AROUND)


def _length(ax: Axes, start: Point, stop: Point, words: str) -> Words:
    ax.plot(*zip(start, stop, strict=True), color="black", lw=0.9)
    ax.annotate("", stop, start, arrowprops={"arrowstyle": "<->", "lw": 0.9, "shrinkA": 0, "shrinkB": 0})
    middle = 0.5 * (start[0] + stop[0]), 0.5 * (start[1] + stop[1])
    return Words(words, middle, [(0, -1), (1, -1), (-1, -1)])


def _to_axis(ax: Axes, start: Point, distance: float, lam: float, words: str) -> Words:
    """The distance of a point from the steering axis, positive where that is ahead of it."""
    stop = start[0] + distance * np.cos(lam), start[1] + distance * np.sin(lam)
    ax.plot(*zip(start, stop, strict=True), color="0.1", lw=1.6)
    return Words(words, (0.5 * (start[0] + stop[0]), 0.5 * (start[1] + stop[1])), _RIGHT)


def _tilt(ax: Axes, foot: Point, lam: float, top: float) -> Words:
    """The angle λ between the steering axis and the vertical."""
    radius = 0.8 * top
    ax.plot([foot[0]] * 2, [0, 1.05 * radius], color=_AXIS, lw=0.7, ls=":")
    angle = np.linspace(0, lam, 30)
    ax.plot(foot[0] - radius * np.sin(angle), radius * np.cos(angle), color=_AXIS, lw=1)
    middle = float(foot[0] - radius * np.sin(lam / 2)), float(radius * np.cos(lam / 2))
    return Words("λ", middle, [(0, 1), (0, -1), (1, 1), (1, -1), (-1, 1)])
