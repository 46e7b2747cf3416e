"""What the pictures share: axes of λ, σ and V with the head angle and the trail beside them, and words."""

from __future__ import annotations

import math
import re
from collections.abc import Collection
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.patheffects import AbstractPathEffect, withStroke
from matplotlib.ticker import MaxNLocator

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Model
from bikestab.variants import Parameter

LABELS = {
    "lam": "steering-axis tilt λ [rad]", "sigma": "trail / wheelbase σ", "V": "speed V [m/s]",
    "head_angle": "head angle [°]", "trail": "trail [m]", "offset": "fork offset b [m]",
}  # fmt: skip
_SHORTER = (
    (" of the rear part with rider", " of the rear part"), (" ahead of the rear contact", ""),
    (" above the ground", ""), (" about a diameter", ""),
    ("fork and handlebar", "fork"), ("steer torque against the ", "gain on "),
    ("viscous damping of the steering", "steering damping"),
)  # fmt: skip
SYMBOLS = {"lam": "λ", "sigma": "σ", "V": "V"}
_STEPS = [1, 2, 2.5, 5, 10]
_TICKS = 6  # spaces between the numbers below an axis, at most
_UP = 9  # the same beside one that goes up
_LONG = 32  # letters of a parameter's meaning, with which it fits beside an axis
_WHEELBASES = {"w", "c"}  # with which a trail is no fixed multiple of σ
HALO: list[AbstractPathEffect] = [withStroke(linewidth=2.5, foreground="white")]


def label_of(parameter: Parameter) -> str:
    """What stands beside an axis of a parameter, in every picture."""
    name, symbol, meaning, unit = parameter
    if name in LABELS:
        return LABELS[name]
    meaning = re.split("[,;]", meaning)[0]
    for long, short in _SHORTER:
        meaning = meaning.replace(long, short)
    words = f"{meaning} {symbol}" if len(meaning) < _LONG and not meaning.startswith("k_") else symbol
    return f"{words} [{unit}]".removesuffix(" [1]")


def labels_of(family: Family) -> dict[str, str]:
    """What stands beside the axes of a family and V."""
    return {"V": LABELS["V"], **{p.name: label_of(p) for p in family.parameters}}


class _Degrees(MaxNLocator):
    """Round numbers of degrees on an axis in rad."""

    def tick_values(self, vmin: float, vmax: float) -> Any:
        return np.radians(super().tick_values(math.degrees(vmin), math.degrees(vmax)))


def place_ticks(axis: Axis, name: str, most: int = _TICKS, **how: Any) -> None:
    """Round numbers beside an axis of a parameter or V, in the unit of its label: a head angle's degrees."""
    if name != "head_angle":
        axis.set_major_locator(MaxNLocator(most, **how))
        return
    axis.set_major_locator(_Degrees(most, **how))
    axis.set_major_formatter(lambda angle, _: f"{math.degrees(angle):.10g}".replace("-", "−"))


def label_family(ax: Axes, x: str, y: str, family: Family, *, one_wheelbase: bool = True) -> None:
    """Labels for two of a family's parameters and V; of tilt and trail those of ``label_axes``.

    Without the trail in m where what is drawn has not ``one_wheelbase``.
    """
    if {x, y} <= SYMBOLS.keys() and not _WHEELBASES & {family.x, family.y}:
        label_axes(ax, x, y, family.bicycle.c if one_wheelbase else None)
        return
    labels = labels_of(family)
    place_ticks(ax.xaxis, x, steps=_STEPS)
    if y == "head_angle":
        place_ticks(ax.yaxis, y, _UP, steps=_STEPS)
    ax.set_xlabel(labels[x])
    ax.set_ylabel(labels[y])


def label_axes(ax: Axes, x: str, y: str, wheelbase: float | None) -> None:
    """Labels for two of λ, σ and V, the head angle [°] or the trail [m] on top, the trail at the right."""
    c = wheelbase or 1.0
    to_trail = (lambda sigma: np.asarray(sigma) * c, lambda trail: np.asarray(trail) / c)
    ax.xaxis.set_major_locator(MaxNLocator(_TICKS, steps=_STEPS))
    ax.set_xlabel(LABELS[x])
    ax.set_ylabel(LABELS[y])
    if x == "lam":
        top = ax.secondary_xaxis("top", functions=(head_angle, _tilt))
        top.set_xlabel("head angle [°]")
        top.xaxis.set_major_locator(MaxNLocator(_TICKS, steps=_STEPS))
    elif x == "sigma" and wheelbase:
        top = ax.secondary_xaxis("top", functions=to_trail)
        top.set_xlabel("trail [m]")
        top.xaxis.set_major_locator(MaxNLocator(_TICKS, steps=_STEPS))
    if y == "sigma" and wheelbase:
        right = ax.secondary_yaxis("right", functions=to_trail)
        right.set_ylabel("trail [m]")


def ticks_inside(ax: Axes) -> None:
    """Ticks on all four sides, with numbers so far away that none meets another at a corner."""
    ax.tick_params(direction="in", top=True, right=True, pad=4.5)


def remarks(bicycle: Bicycle, model: Model, varied: Collection[str] = ()) -> str:
    """The end of a title: what is unusual about damping, gains, unless they are ``varied``, and model."""
    damping = f", δ = {bicycle.delta:g} kg m²/s" if bicycle.delta and "delta" not in varied else ""
    damping += "".join(f", {name} = {gain:g}" for name, gain in bicycle.gains if name not in varied)
    return damping + (", unrefined model" if model == "unrefined" else "")


def head_angle(lam: Any) -> Any:
    """Head angle [°] of tilt λ [rad]."""
    return 90 - np.degrees(lam)


def _tilt(angle: Any) -> Any:
    return np.pi / 2 - np.radians(angle)
