"""Numbers beside axes: with the digits they need, or what is left of them beyond a round number.

matplotlib writes what it takes from numbers, such as 1e−5+1e−1, at the end of an axis, where few look.
"""

from __future__ import annotations

import math
from typing import Any

from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import Formatter, ScalarFormatter

_LETTERS = 8  # of a number, at most
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class _Reduced(Formatter):
    """Numbers less ``origin``, in units of ``unit``, with so many decimals."""

    def __init__(self, origin: float, unit: float, decimals: int) -> None:
        self.origin, self.unit, self.decimals = origin, unit, decimals

    def __call__(self, x: float, pos: int | None = None) -> str:
        return f"{(x - self.origin) / self.unit:.{self.decimals}f}".replace("-", "−")


def plain_numbers(figure: Figure) -> None:
    """Write all digits beside a figure's axes, whose limits are final, or say in a label what is less."""
    axes: list[Any] = list(figure.axes)
    while axes:
        ax = axes.pop()
        axes += ax.child_axes
        ax.apply_aspect()  # which gives a second axis its limits
        for axis in ax._axis_map.values():
            _plain(axis)


def _plain(axis: Axis) -> None:
    formatter = axis.get_major_formatter()
    low, high = sorted(axis.get_view_interval())
    if type(formatter) is not ScalarFormatter or not low < high:
        return
    ticks = [x for x in axis.get_majorticklocs() if low <= x <= high]
    formatter.set_locs(ticks)
    if len(ticks) < 2 or not formatter.get_offset():
        return
    step = ticks[1] - ticks[0]
    decimals = _decimals(step)
    if max(len(f"{x:.{decimals}f}") for x in ticks) <= _LETTERS:
        axis.set_major_formatter(_Reduced(0.0, 1.0, decimals))
        return
    size = 10.0 ** math.ceil(math.log10(high - low))
    origin = math.floor(low / size) * size if max(abs(low), abs(high)) > 10 * size else 0.0
    power = math.floor(math.log10(1.001 * max(high - origin, origin - low)))
    axis.set_major_formatter(_Reduced(origin, 10.0**power, _decimals(step / 10.0**power)))
    words, _, unit = axis.get_label().get_text().removesuffix("]").partition(" [")
    taken = f"{origin:.{_decimals(size)}f}"
    taken = taken.rstrip("0").rstrip(".") if "." in taken else taken
    less = f" − {taken}".replace("− -", "+ ") if origin else ""
    times = f"10{str(power).translate(_RAISED)} " if power else ""
    axis.set_label_text(f"{words}{less} [{times}{unit}".rstrip(" [") + ("]" if times or unit else ""))


def _decimals(step: float) -> int:
    """How many decimals show multiples of a step."""
    return next((n for n in range(16) if math.isclose(round(step, n), step, rel_tol=1e-3)), 16)
