"""A machine from its side, to scale, with the symbols of its parameters."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from bikestab.bicycle import Bicycle
from bikestab.plot.axes import HALO, head_angle
from bikestab.plot.headings import set_title, short
from bikestab.plot.settings import own_settings

_REAR, _FRONT, _AXIS = "#0072b2", "#d55e00", "0.35"  # Okabe and Ito 2008
_ABOVE = 1.25  # the steering axis is drawn up to this share of the highest centre of mass or wheel

Point = tuple[float, float]


@own_settings()
def draw_side(bicycle: Bicycle, lam: float, sigma: float) -> Figure:
    """The machine upright, going to the right, at tilt λ [rad] and trail σ [1]; all lengths in m."""
    figure = Figure(figsize=(6.2, 5.0), layout="constrained")
    ax = figure.add_subplot()
    p = bicycle
    top = _ABOVE * max(p.h1, p.h2, 2 * p.R1, 2 * p.R2)
    trail, c1 = sigma * p.c, sigma * p.c * np.cos(lam)
    foot = (p.c + trail, 0.0)
    up = np.array([-np.sin(lam), np.cos(lam)])

    ax.axhline(0, color="0.2", lw=1)
    _wheel(ax, (0, p.R1), p.R1, _REAR, "R" if p.R1 == p.R2 else "R1")
    _wheel(ax, (p.c, p.R2), p.R2, _FRONT, "" if p.R1 == p.R2 else "R2")
    head = foot + up * top / np.cos(lam)
    ax.plot(*zip(foot, head, strict=True), color=_AXIS, lw=1.4, ls=(0, (8, 2, 2, 2)))
    ax.text(head[0], head[1], "steering axis ", color=_AXIS, ha="right", va="top")
    _tilt(ax, foot, lam, top)

    _mass(ax, (p.l1, p.h1), "M1", f"{p.m1:g} kg", _REAR, [(0, p.R1), _on_axis(foot, up, 0.75 * top)])
    _mass(ax, (p.l2, p.h2), "M2", f"{p.m2:g} kg", _FRONT, [(p.c, p.R2), _on_axis(foot, up, 0.75 * top)])

    step = 0.08 * top
    _length(ax, (0, -step), (p.c, -step), f"c = {_m(p.c)}")
    _length(ax, (p.c, -2 * step), (p.c + trail, -2 * step), f"c2 = σ c = {_m(trail)}")
    _to_axis(ax, (p.c, 0.0), c1, lam, f"c1 = {_m(c1)}")
    if p.R2:  # of a skate it is −c1
        _to_axis(ax, (p.c, p.R2), -(p.R2 * np.sin(lam) - c1), lam, f"b = {_m(p.R2 * np.sin(lam) - c1)}")
    d = p.h2 * np.sin(lam) + (p.l2 - p.c) * np.cos(lam) - c1
    _to_axis(ax, (p.l2, p.h2), -d, lam, f"d = {_m(d)}")

    ax.set_aspect("equal")
    ax.margins(x=0.16, y=0.08)
    ax.set_ylim(-4 * step, None)
    ax.set_xlabel("ahead of the rear contact [m]")
    ax.set_ylabel("above the ground [m]")
    what = f"λ = {lam:.4g} rad (head angle {head_angle(lam):.2f}°), σ = {sigma:.4g}"
    set_title(ax, f"{short(p.name)}: {what}")
    return figure


def _m(length: float) -> str:
    return f"{length:.3g} m".replace("-", "−")


def _on_axis(foot: Point, up: Any, height: float) -> Point:
    x, y = np.asarray(foot) + up * height / up[1]
    return float(x), float(y)


def _wheel(ax: Axes, centre: Point, radius: float, color: str, name: str) -> None:
    ax.add_patch(Circle(centre, radius, fill=False, ec=color, lw=2.2))
    ax.plot(*centre, "o", color=color, ms=4)
    if radius and name:
        ax.plot([centre[0], centre[0] - radius], [centre[1]] * 2, color=color, lw=0.8)
        ax.text(
            centre[0] - radius / 2, centre[1], f"{name} = {_m(radius)}", ha="center", va="bottom", fontsize=9,
            path_effects=HALO,
        )  # fmt: skip


def _mass(ax: Axes, at: Point, name: str, mass: str, color: str, joints: list[Point]) -> None:
    """A centre of mass, its height and distance, and lines to what its part is joined to."""
    for joint in joints:
        ax.plot(*zip(at, joint, strict=True), color=color, lw=1.6, alpha=0.35)
    ax.plot([at[0], at[0]], [0, at[1]], color=color, lw=0.7, ls=":")
    ax.plot(*at, "o", ms=11, mfc="white", mec=color, mew=2)
    ax.plot(*at, "+", ms=9, color=color)
    i = name[1]
    words = f"{name}: {mass}\nl{i} = {_m(at[0])}, h{i} = {_m(at[1])}"
    ax.annotate(words, at, (10, 8), textcoords="offset points", fontsize=9, path_effects=HALO, zorder=6)


def _length(ax: Axes, start: Point, stop: Point, words: str) -> None:
    ax.annotate("", stop, start, arrowprops={"arrowstyle": "<->", "lw": 0.9, "shrinkA": 0, "shrinkB": 0})
    middle = 0.5 * (start[0] + stop[0]), 0.5 * (start[1] + stop[1])
    style: dict[str, Any] = {"fontsize": 9, "path_effects": HALO, "textcoords": "offset points"}
    ax.annotate(words, middle, (0, -4), ha="center", va="top", **style)


def _to_axis(ax: Axes, start: Point, distance: float, lam: float, words: str) -> None:
    """The distance of a point from the steering axis, positive where that is ahead of it."""
    stop = start[0] + distance * np.cos(lam), start[1] + distance * np.sin(lam)
    ax.plot(*zip(start, stop, strict=True), color="0.1", lw=1.6)
    ax.annotate(
        words, (0.5 * (start[0] + stop[0]), 0.5 * (start[1] + stop[1])), (12, -4), textcoords="offset points",
        fontsize=9, path_effects=HALO, va="top", zorder=6,
    )  # fmt: skip


def _tilt(ax: Axes, foot: Point, lam: float, top: float) -> None:
    """The angle λ between the steering axis and the vertical."""
    radius = 0.8 * top
    ax.plot([foot[0]] * 2, [0, 1.05 * radius], color=_AXIS, lw=0.7, ls=":")
    angle = np.linspace(0, lam, 30)
    ax.plot(foot[0] - radius * np.sin(angle), radius * np.cos(angle), color=_AXIS, lw=1)
    ax.text(foot[0] - radius * np.sin(lam / 2), radius * np.cos(lam / 2), "λ", ha="center", va="bottom")
