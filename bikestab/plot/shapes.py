"""The picture of mode shapes: an arrow each for roll and steer, one compass for each mode."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from bikestab.motion import Shapes
from bikestab.plot.headings import set_title, short
from bikestab.plot.settings import own_settings

_ARROWS = (("roll", "#0072b2", 4.0), ("steer", "#d55e00", 1.8))  # the first is seen under the second
_HEAD = 14.0  # points
_RADIUS = 58.0  # points, of a compass


@own_settings()
def draw_shapes(name: str, found: Shapes) -> Figure:
    """A machine by name: of a complex pair the eigenvalue with the positive imaginary part."""
    shown = [k for k, s in enumerate(found.eigenvalues) if s.imag >= 0]
    figure = Figure(figsize=(2.1 * len(shown), 3.4), layout="constrained")
    figure.suptitle(f"{short(name)} at {found.V:g} m/s: roll and steer in each mode", fontsize=10)
    for place, k in enumerate(shown, 1):
        ax = figure.add_subplot(1, len(shown), place, projection="polar")
        s = found.eigenvalues[k]
        for row, (phasor, (text, color, width)) in enumerate(zip(found.phasors[:, k], _ARROWS, strict=True)):
            size, angle = abs(phasor), float(np.angle(phasor))
            head = min(_HEAD, 0.6 * _RADIUS * size)  # no longer than the arrow
            style = {"color": color, "lw": min(width, head / 3), "mutation_scale": head, "joinstyle": "miter"}
            style |= {"arrowstyle": f"-|>,head_width={0.25 + 0.05 * width}", "shrinkA": 0, "shrinkB": 0}
            ax.annotate("", (angle, size), (angle, 0), arrowprops=style)
            words = f"{text} {size:.3g}" + (f", {math.degrees(angle):.0f}°" if abs(angle) > 1e-9 else "")
            ax.text(
                0.5, -0.12 - 0.12 * row, words.replace("-", "−"), transform=ax.transAxes, color=color,
                fontsize=9, ha="center", va="center",
            )  # fmt: skip
        ax.set_ylim(0, 1.15)
        ax.set_yticks([0.5, 1], [])
        ax.set_xticks(np.radians([0, 90, 180, 270]), ["0°", "90°", "", ""])
        ax.tick_params(labelsize=8)
        ax.grid(color="0.85")
        words = f"{s.real:.3f} ± {s.imag:.3f}i s⁻¹" if s.imag else f"{s.real:.3f} s⁻¹"
        set_title(ax, found.names[k], words.replace("-", "−"), panels=len(shown), fontsize=9)
    return figure
