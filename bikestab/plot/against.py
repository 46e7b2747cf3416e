"""The picture of eigenvalues at one speed against a parameter: real parts solid, imaginary parts dashed."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from bikestab.against import Against, Curve
from bikestab.modenames import OSCILLATING
from bikestab.plot.axes import label_of, ticks_inside
from bikestab.plot.growth import plain_ticks
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.modes import BAND, DASHES, STYLES
from bikestab.plot.settings import own_settings
from bikestab.variants import Parameter


@own_settings()
def draw_against(name: str, found: Against, V: float, parameter: Parameter) -> Figure:
    """A machine by name, at a speed [m/s], and what varies. Head angles are in degrees."""
    scale = math.degrees(1) if found.name == "head_angle" else 1.0
    label = label_of(parameter)
    figure = Figure(figsize=(5.6, 4.4), layout="constrained")
    ax = figure.add_subplot()
    for curve in _joined(found.curves):
        color, width = STYLES[curve.name]
        ax.plot(scale * curve.x, curve.s.real, color=color, lw=width)
        if curve.name in OSCILLATING:
            ax.plot(scale * curve.x, curve.s.imag, color=color, lw=width, ls=DASHES)
    drawn = {curve.name for curve in found.curves}
    ax.axhline(0, color="k", lw=0.8, zorder=1)
    low, high = scale * float(found.values.min()), scale * float(found.values.max())
    ax.set_xlim(low, high)
    stable = [(scale * start, scale * stop) for start, stop in found.stable]
    for start, stop in stable:
        ax.axvspan(start, stop, color=BAND, lw=0, zorder=0)
        for end in (start, stop):
            if low < end < high:
                ax.axvline(end, color="0.3", lw=0.9, ls=":", zorder=1)
    ax.set_yscale("asinh", linear_width=1.0)
    plain_ticks(ax)
    ax.set_xlabel(label)
    ax.set_ylabel("eigenvalue [s⁻¹]  (logarithmic beyond ±1)")
    ticks_inside(ax)
    handles: list[Artist] = [
        entry(name, color=color, lw=width) for name, (color, width) in STYLES.items() if name in drawn
    ]
    handles.append(entry("real part", color="0.3"))
    handles += [entry("|imaginary part|", color="0.3", ls=DASHES)] if drawn & {*OSCILLATING} else []
    if stable:
        handles.append(Patch(facecolor=BAND, edgecolor="0.6", lw=0.5, label="stable"))
    legend_below(figure, handles)
    what, _, unit = label.removesuffix("]").partition(" [")
    ends = ", ".join(f"{start:.6g} to {stop:.6g}" for start, stop in stable)
    where = f"stable for {what} = {ends} {unit}".replace(" °", "°").strip() if ends else "nowhere stable"
    set_title(ax, f"{short(name)}: eigenvalues at {V:g} m/s", where)
    return figure


def _joined(curves: Sequence[Curve]) -> list[Curve]:
    """Curves that go on where others of their name end as one, so that dashes do not begin anew."""
    chains: list[list[Curve]] = []
    ends: dict[tuple[str, float], list[int]] = {}  # chains by name and where they end so far
    for curve in sorted(curves, key=lambda each: each.x[0]):
        open_ = ends.get((curve.name, curve.x[0]), [])
        near = [i for i in open_ if np.isclose(chains[i][-1].s[-1], curve.s[0], rtol=1e-6, atol=1e-9)]
        if near:
            open_.remove(near[0])
            chains[near[0]].append(curve)
        else:
            near = [len(chains)]
            chains.append([curve])
        ends.setdefault((curve.name, curve.x[-1]), []).append(near[0])
    return [
        Curve(
            chain[0].name,
            np.concatenate([each.x for each in chain]),
            np.concatenate([each.s for each in chain]),
        )
        for chain in chains
    ]
