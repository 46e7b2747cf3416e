"""The picture of eigenvalues at one speed against a parameter: real parts solid, imaginary parts dashed."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from bikestab.against import Against
from bikestab.modenames import OSCILLATING
from bikestab.plot.axes import ticks_inside
from bikestab.plot.growth import plain_ticks
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.modes import BAND, DASHES, STYLES
from bikestab.plot.settings import own_settings


@own_settings()
def draw_against(name: str, found: Against, V: float, unit: str) -> Figure:
    """A machine by name, at a speed [m/s]; ``unit`` is that of the parameter. Head angles are in degrees."""
    if found.name == "head_angle":
        stable = [(float(np.degrees(start)), float(np.degrees(stop))) for start, stop in found.stable]
        found, unit = found._replace(values=np.degrees(found.values), stable=stable), "°"
    figure = Figure(figsize=(5.6, 4.4), layout="constrained")
    ax = figure.add_subplot()
    x = found.values
    drawn, oscillates = [], False
    for mode in STYLES:
        parts = [modes.eigenvalues[modes.names == mode] for modes in found.modes]
        if not any(len(part) for part in parts):
            continue
        color, width = STYLES[mode]
        drawn.append(entry(mode, color=color, lw=width))
        number = 1 if mode in OSCILLATING else max(map(len, parts))
        for k in range(number):
            real = [sorted(part.real)[k] if len(part) > k else np.nan for part in parts]
            ax.plot(x, real, color=color, lw=width)
        if mode in OSCILLATING:
            oscillates = True
            imag = [float(np.abs(part.imag).max()) if len(part) else np.nan for part in parts]
            ax.plot(x, imag, color=color, lw=width, ls=DASHES)
    ax.axhline(0, color="k", lw=0.8, zorder=1)
    ax.set_xlim(x.min(), x.max())
    for start, stop in found.stable:
        ax.axvspan(start, stop, color=BAND, lw=0, zorder=0)
        for end in (start, stop):
            if x.min() < end < x.max():
                ax.axvline(end, color="0.3", lw=0.9, ls=":", zorder=1)
    ax.set_yscale("asinh", linear_width=1.0)
    plain_ticks(ax)
    ax.set_xlabel(f"{found.name} [{unit}]")
    ax.set_ylabel("eigenvalue [s⁻¹]  (logarithmic beyond ±1)")
    ticks_inside(ax)
    handles: list[Artist] = [*drawn, entry("real part", color="0.3")]
    handles += [entry("|imaginary part|", color="0.3", ls=DASHES)] if oscillates else []
    if found.stable:
        handles.append(Patch(facecolor=BAND, edgecolor="0.6", lw=0.5, label="stable"))
    legend_below(figure, handles)
    ends = ", ".join(f"{start:.6g} to {stop:.6g}" for start, stop in found.stable)
    where = f"stable for {found.name} = {ends} {unit}" if ends else "nowhere stable"
    set_title(ax, f"{short(name)}: eigenvalues at {V:g} m/s", where)
    return figure
