"""The picture of the motion after a push: roll and steer against time, and the wheels' paths on the road."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.model import Floats
from bikestab.motion import LARGE, Motion, leaves
from bikestab.plot.axes import ticks_inside
from bikestab.plot.headings import set_title, short
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import Curve, Line, label_curves, lines_for

_REAR, _FRONT = Line("#0072b2", "-"), Line("#d55e00", (0, (5, 1.5)))  # and of what they do: roll and steer
_STANDING = 0.5  # m, or rad: what is drawn around a machine that does not move
_LEAST = 1e-300  # of less no axis is made
_LEFT = "0.92"  # where the linear model has been left
Drawn = tuple[str, Floats, Floats, Line]


@own_settings()
def draw_motion(name: str, found: Motion, until: float, push: Mapping[str, float]) -> Figure:
    """A machine by name, and what pushed it: states by name, in rad and rad/s.

    Its motion to ``until`` [s], or to a quarter turn before it.
    """
    figure = Figure(figsize=(6.2, 5.4), layout="constrained")
    top, road = figure.subplots(2, 1)
    roll, steer = found.states[:2]
    _curves(top, [("roll", found.t, roll, _REAR), ("steer", found.t, steer, _FRONT)])
    paths = [("rear wheel", found.x, found.y, _REAR), ("front wheel", found.x_front, found.y_front, _FRONT)]
    _curves(road, paths, down=True)
    top.set_xlabel("time [s]")
    top.set_ylabel("to the right [rad]")
    road.set_xlabel("along the road [m]")
    road.set_ylabel("to the right [m]")
    left = leaves(found)
    if left is not None:
        for ax, place in ((top, left), (road, found.V * left)) if found.V else ((top, left),):
            ax.axvspan(place, ax.get_xlim()[1], color=_LEFT, lw=0, zorder=0)
    words = f"{short(name)} at {found.V:g} m/s after a push: {_pushed(push)}"
    set_title(top, words, *_doubts(left, float(found.t[-1]), until))
    set_title(road, "Paths of the wheels on the road, from above; sideways enlarged")
    return figure


@own_settings()
def draw_motions(machines: Sequence[tuple[str, Motion]], push: Mapping[str, float], name: str = "") -> Figure:
    """The same of several machines, a curve each for roll, steer, rear wheel; ``name`` is common to all.

    Each to the same time, or to a quarter turn before it.

    Raises InputError for more machines than there are lines that differ.
    """
    figure = Figure(figsize=(6.2, 7.4), layout="constrained")
    roll, steer, road = figure.subplots(3, 1)
    lines = lines_for(len(machines))
    speeds = {found.V for _, found in machines}
    names = [each if len(speeds) == 1 else f"{each} at {found.V:.4g} m/s" for each, found in machines]
    for ax, x, y in (
        (roll, [m.t for _, m in machines], [m.states[0] for _, m in machines]),
        (steer, [m.t for _, m in machines], [m.states[1] for _, m in machines]),
        (road, [m.x for _, m in machines], [m.y for _, m in machines]),
    ):
        _curves(ax, list(zip(names, x, y, lines, strict=True)), down=ax is road)
    for ax, what in ((roll, "roll"), (steer, "steer")):
        ax.set_xlabel("time [s]")
        ax.set_ylabel(f"{what} to the right [rad]")
    road.set_xlabel("along the road [m]")
    road.set_ylabel("to the right [m]")
    what = f"at {machines[0][1].V:g} m/s " if len(speeds) == 1 else ""
    doubt = [f"beyond {LARGE:g} rad the linear model does not hold"]
    doubt += (
        ["a curve ends at a quarter turn"] if len({float(found.t[-1]) for _, found in machines}) > 1 else []
    )
    doubt = [", and ".join(doubt)] if any(leaves(found) is not None for _, found in machines) else []
    words = f"{f'{short(name)} ' if name else ''}{what}after a push: {_pushed(push)}"
    set_title(roll, words if name else words.capitalize(), *doubt)
    set_title(road, "Path of the rear wheel on the road, from above; sideways enlarged")
    return figure


def _curves(ax: Axes, drawn: Sequence[Drawn], *, down: bool = False) -> None:
    """Curves with their names."""
    for _, x, y, line in drawn:
        ax.plot(x, y, color=line.color, ls=line.ls, lw=1.8)
    ax.axhline(0, color="0.5", lw=0.7, zorder=1)
    right = max(float(x[-1]) for _, x, _, _ in drawn)
    moves = any(x[-1] > x[0] for _, x, _, _ in drawn)
    if not moves:  # no way: marks, beside which names have room
        for _, x, y, line in drawn:
            ax.plot(x[-1:], y[-1:], "o", color=line.color, ms=6)
    ax.set_xlim(0.0 if moves else -_STANDING, right if moves else right + _STANDING)
    low, high = min(0.0, *(y.min() for _, _, y, _ in drawn)), max(0.0, *(y.max() for _, _, y, _ in drawn))
    margin = 0.05 * (high - low)
    low, high = (low - margin, high + margin) if margin > _LEAST else (-_STANDING, _STANDING)
    ax.set_ylim((high, low) if down else (low, high))  # the road as seen from above
    ticks_inside(ax)
    label_curves(ax, [Curve(name, x, y, line.color) for name, x, y, line in drawn])


def _doubts(left: float | None, end: float, until: float) -> list[str]:
    """What is not as a machine moves, and what is not drawn."""
    if left is None:
        return []
    words = f"shaded: leaves the linear model at {left:.3g} s (beyond {LARGE:g} rad)"
    return [
        words + (f"; not drawn: from a quarter turn at {end:.3g} s to {until:g} s" if end < until else "")
    ]


def _pushed(push: Mapping[str, float]) -> str:
    units = {True: "rad/s", False: "rad"}
    return ", ".join(
        f"{key.replace('_', ' ')} = {value:.4g} {units[key.endswith('rate')]}" for key, value in push.items()
    )
