"""The picture of mode shapes: an arrow each for roll and steer, one compass for each mode."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from bikestab.motion import Complex, Shapes
from bikestab.plot.headings import rows_of, set_title, short
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import lines_for

_ARROWS = (("roll", "#0072b2", 4.0), ("steer", "#d55e00", 1.8))  # the first is seen under the second
_HEAD = 14.0  # points
_RADIUS = 58.0  # points, of a compass
_WHITE = {"facecolor": "white", "edgecolor": "none", "pad": 0.8}
_MEANING = (
    "length: share of the larger of the two (rings: 0.5 and 1)",
    "angle: phase; further counterclockwise is earlier",
)


@own_settings()
def draw_shapes(machines: Sequence[tuple[str, Shapes]], name: str = "") -> Figure:
    """A row for each machine, by name: of a complex pair the eigenvalue with the positive imaginary part.

    ``name`` is common to all. Raises InputError for more machines than in other pictures of several.
    """
    lines_for(len(machines))
    shown = [[k for k, s in enumerate(found.eigenvalues) if s.imag >= 0] for _, found in machines]
    rows, columns = len(machines), max(map(len, shown))
    figure = Figure(figsize=(2.05 * columns, 1.0), layout="constrained")
    speeds = {found.V for _, found in machines}
    whose = machines[0][0] if rows == 1 else name
    at = f" at {machines[0][1].V:g} m/s" if len(speeds) == 1 else ""
    title = (
        f"{short(whose)}{at}: roll and steer in each mode" if whose else f"Roll and steer in each mode{at}"
    )
    lines = [row for line in (title, *_MEANING) for row in rows_of(line, figure.get_figwidth())]
    figure.set_figheight(0.3 + 0.17 * len(lines) + 3.0 * rows)
    figure.suptitle("\n".join(lines), fontsize=10)
    for row, ((own, found), modes) in enumerate(zip(machines, shown, strict=True)):
        for column, k in enumerate(modes):
            ax = figure.add_subplot(rows, columns, row * columns + column + 1, projection="polar")
            _draw(ax, found, k, columns)
            if rows > 1 and not column:
                words = short(own) if at else f"{short(own)}\nat {found.V:.4g} m/s"
                style: dict[str, Any] = {
                    "rotation": 90,
                    "fontsize": 9,
                    "ha": "center",
                    "va": "center",
                    "parse_math": False,
                }
                ax.text(-0.32, 0.5, words, transform=ax.transAxes, **style)
    return figure


def _draw(ax: Any, found: Shapes, k: int, columns: int) -> None:
    """The arrows of one mode."""
    s = found.eigenvalues[k]
    for row, (phasor, (text, color, width)) in enumerate(zip(found.phasors[:, k], _ARROWS, strict=True)):
        size, angle = abs(phasor), float(np.angle(phasor))
        head = min(_HEAD, 0.6 * _RADIUS * size)  # no longer than the arrow
        style = {"color": color, "lw": min(width, head / 3), "mutation_scale": head, "joinstyle": "miter"}
        style |= {"arrowstyle": f"-|>,head_width={0.25 + 0.05 * width}", "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", (angle, size), (angle, 0), arrowprops=style)
        words = f"{text} {size:.3g}" + (
            f", {math.degrees(angle):.0f}°".replace("-180", "180") if abs(angle) > 1e-9 else ""
        )
        ax.text(
            0.5, -0.12 - 0.12 * row, words.replace("-", "−"), transform=ax.transAxes, color=color,
            fontsize=9, ha="center", va="center",
        )  # fmt: skip
    ax.set_ylim(0, 1.15)
    ax.set_yticks([0.5, 1], [])
    at = _away(found.phasors[:, k])
    for size in (0.5, 1.0):
        ax.text(at, size, f"{size:g}", fontsize=8, color="0.35", ha="center", va="center", bbox=_WHITE)
    ax.set_xticks(np.radians([0, 90, 180, 270]), ["0°", "90°", "", ""])
    ax.tick_params(labelsize=8, pad=1)
    ax.grid(color="0.85")
    words = f"{s.real:.3f} ± {s.imag:.3f}i s⁻¹" if s.imag else f"{s.real:.3f} s⁻¹"
    set_title(ax, found.names[k], words.replace("-", "−"), panels=columns, fontsize=9)


def _away(phasors: Complex) -> float:
    """The angle of the rings' numbers, furthest from all arrows."""
    angles = np.pi * np.arange(0.25, 2, 0.5)
    apart = np.abs((angles[:, np.newaxis] - np.angle(phasors) + np.pi) % (2 * np.pi) - np.pi)
    return float(angles[np.argmax(apart.min(axis=1))])
