"""The root locus: eigenvalues in the complex plane as the speed grows, with the speeds written on them."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.bicycle import Bicycle
from bikestab.model import Model, exact_table
from bikestab.modes import Modes, follow
from bikestab.plot.axes import HALO, remarks
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.modes import STYLES
from bikestab.plot.settings import own_settings

_SAMPLES = 1201
_MARKS = 11  # speeds that are written, at most


@own_settings()
def draw_locus(
    bicycle: Bicycle, lam: float, sigma: float, start: float, stop: float, *, model: Model = "refined"
) -> Figure:
    """The eigenvalues at tilt λ [rad] and trail σ for speeds from ``start`` to ``stop`` [m/s]."""
    table = exact_table(bicycle, lam, sigma, model=model)
    met = follow(table, start).coalescences
    near = np.outer(met, 1 + np.array([-1e-4, -1e-6, -1e-9, 1e-9, 1e-6, 1e-4])).ravel()
    V = np.union1d(np.linspace(start, stop, _SAMPLES), near[(near > start) & (near < stop)])
    modes = follow(table, V)
    figure = Figure(figsize=(5.6, 5.0), layout="constrained")
    ax = figure.add_subplot()
    s = modes.eigenvalues
    growth = s.real.max(axis=0)
    left = max(float(s.real.min()), -3 * max(float(np.abs(growth).max()), float(s.imag.max()), 1.0))
    right = max(float(growth.max()), -0.1 * left)
    ax.set_xlim(left - 0.05 * (right - left), right + 0.08 * (right - left))
    ax.axvspan(ax.get_xlim()[0], 0, color="#dcebd5", lw=0, zorder=0)
    ax.axvline(0, color="k", lw=0.8, zorder=1)
    ax.axhline(0, color="0.6", lw=0.7, zorder=1)
    drawn = _branches(ax, modes)
    _speeds(ax, modes, start, stop)
    styles = {name: style for name, style in STYLES.items() if name in drawn}
    dot = entry("speed [m/s]", color="0.2", marker=".", ls="none")
    legend_below(figure, [*(entry(n, color=c, lw=w) for n, (c, w) in styles.items()), dot])
    ax.set_xlabel("real part [s⁻¹]  (green: decays)")
    ax.set_ylabel("imaginary part [rad/s]")
    ax.tick_params(direction="in", top=True, right=True)
    away = "" if left <= float(s.real.min()) else f"; what is left of {left:.3g} is not shown"
    words = f"λ = {lam:.4g} rad, σ = {sigma:.4g}{remarks(bicycle, model)}{away}"
    set_title(ax, f"{short(bicycle.name)}: root locus for {start:g} to {stop:g} m/s", words)
    return figure


def _branches(ax: Axes, modes: Modes) -> set[str]:
    """Each branch in the style of its names; the names."""
    for s, names in zip(modes.eigenvalues, modes.names, strict=True):
        for part in np.split(np.arange(len(names)), np.flatnonzero(names[1:] != names[:-1]) + 1):
            color, width = STYLES[str(names[part[0]])]
            ax.plot(s.real[part], s.imag[part], color=color, lw=width)
    return set(modes.names.ravel().tolist())


def _speeds(ax: Axes, modes: Modes, start: float, stop: float) -> None:
    """Dots at round speeds, with numbers where these are apart."""
    steps = np.outer(10.0 ** np.arange(-6, 6), [1, 2, 5]).ravel()
    step = steps[np.searchsorted(steps, (stop - start) / (_MARKS - 1))]
    speeds = np.arange(np.ceil(start / step), np.floor(stop / step) + 1) * step
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    written: list[tuple[float, float]] = []
    for V in speeds:
        k = int(np.argmin(np.abs(modes.V - V)))
        for s in modes.eigenvalues[:, k]:
            if not x0 <= s.real <= x1:
                continue
            ax.plot(s.real, s.imag, ".", color="0.2", ms=5, zorder=4)
            at = ((s.real - x0) / (x1 - x0), (s.imag - y0) / (y1 - y0))
            if s.imag < 0 or any(abs(at[0] - a) < 0.04 and abs(at[1] - b) < 0.035 for a, b in written):
                continue
            written.append(at)
            ax.annotate(
                f"{V:g}", (s.real, s.imag), (4, 4), textcoords="offset points", fontsize=8, path_effects=HALO
            )
