"""The picture of the motion after a push: roll and steer against time, and the wheels' paths on the road."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from bikestab.motion import Motion
from bikestab.plot.axes import ticks_inside
from bikestab.plot.headings import set_title, short
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import label_right

_REAR, _FRONT = "#0072b2", "#d55e00"  # and of what they do: roll and steer
_SMALL = 0.5  # rad: of larger angles the linear equations say little


@own_settings()
def draw_motion(name: str, found: Motion, push: Mapping[str, float]) -> Figure:
    """A machine by name, and what pushed it: states by name, in rad and rad/s."""
    figure = Figure(figsize=(6.2, 5.4), layout="constrained")
    top, road = figure.subplots(2, 1)
    pairs = (("roll", found.states[0], _REAR), ("steer", found.states[1], _FRONT))
    for ax, x, lines in (
        (top, found.t, pairs),
        (road, found.x, (("rear wheel", found.y, _REAR), ("front wheel", found.y_front, _FRONT))),
    ):
        for _, y, color in lines:
            ax.plot(x, y, color=color, lw=1.8)
        ax.axhline(0, color="0.5", lw=0.7, zorder=1)
        ax.set_xlim(float(x[0]), float(x[-1]))
        low, high = ax.get_ylim()
        ax.set_ylim((high, low) if ax is road else (low, high))  # the road as seen from above
        ticks_inside(ax)
        names, ends, colors = zip(*((text, float(y[-1]), color) for text, y, color in lines), strict=True)
        label_right(ax, names, [float(x[-1])] * len(ends), ends, colors)
    top.set_xlabel("time [s]")
    top.set_ylabel("to the right [rad]")
    road.set_xlabel("along the road [m]")
    road.set_ylabel("to the right [m]")
    units = {True: "rad/s", False: "rad"}
    pushed = ", ".join(
        f"{key.replace('_', ' ')} = {value:g} {units[key.endswith('rate')]}" for key, value in push.items()
    )
    large = float(np.abs(found.states[:2]).max()) > _SMALL
    doubt = [f"beyond some {_SMALL:g} rad the linear equations do not hold"] if large else []
    set_title(top, f"{short(name)} at {found.V:g} m/s after a push: {pushed}", *doubt)
    set_title(road, "Paths of the wheels on the road, from above; sideways enlarged")
    return figure
