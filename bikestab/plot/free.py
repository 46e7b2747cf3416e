"""The picture of a search over several parameters: each best design's stable speeds, and where it lies."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bikestab.design.free import Free, FreeBest, FreeDesign
from bikestab.plot.axes import HALO, LABELS, remarks
from bikestab.plot.colours import OWN
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import entry, legend_below
from bikestab.plot.settings import own_settings
from bikestab.plot.sidelabels import COLOURS
from bikestab.variants import parameter_of, told_deviations

# as in pictures of planes of designs
_MARKS = {"own": "*", "widest": "^", "lowest V1": "v", "fastest decay": "D", "most robust": "o"}
_NAMES = {"own": "own design", "lowest V1": "lowest V₁"}
_NO_PINKS = (0, 2, 5, 4)
_ROOM = 0.25  # of the axis, for the words beside a bar
_BAR, _MARK = 0.4, 0.14  # inches of a bar's row, and of each mark in a parameter's row
_ROWS = 0.7  # of a parameter's row, over which its marks are spread so that none hides another
_BEYOND = 1.1  # where what is unbounded ends in the picture, of the largest end


@own_settings()
def draw_free(free: Free, best: FreeBest) -> Figure:
    """A bar of stable speeds for each design, and for each free parameter where in its range they lie."""
    designs = best.designs
    colours = dict(zip(_MARKS, (OWN, *(COLOURS[i] for i in _NO_PINKS)), strict=True))
    heights = _BAR * max(len(designs), 1), max(_BAR, _MARK * len(designs)) * len(free.ends)
    figure = Figure(figsize=(6.2, 2.6 + sum(heights)), layout="constrained")
    above, below = figure.subplots(2, 1, height_ratios=heights)
    _speeds(above, free, designs, colours)
    set_title(above, *_title(free, best))
    _places(below, free, designs, colours)
    marks = [
        entry(_NAMES.get(name, name), color=colours[name], marker=_MARKS[name], ls="", ms=_size(name))
        for name in designs
    ]
    legend_below(figure, marks)
    return figure


def _title(free: Free, best: FreeBest) -> list[str]:
    """What was searched for, and how robust what was found is."""
    name = f"{short(free.bicycle.name)}{remarks(free.bicycle, free.model, free.ends)}"
    if not best.designs:
        return [f"{name}: no design found"]
    lines = [
        f"{name}: best designs of {len(free.ends)} free parameters".replace(
            "of 1 free parameters", "of one free parameter"
        )
    ]
    if robust := best.most_robust:
        sd = told_deviations(free.bicycle, robust["deviations"])
        lines.append(f"most robust: stable within {robust['radius']:.3g} standard deviations ({sd})")
    return lines


def _speeds(ax: Axes, free: Free, designs: Mapping[str, FreeDesign], colours: Mapping[str, str]) -> None:
    ends = [V for design in designs.values() for V in (design["V1"], design["V2"]) if V is not None]
    top = _BEYOND * max([*ends, *(free.stable or (1.0,))])
    for row, (name, design) in enumerate(designs.items()):
        V1, V2 = design["V1"], design["V2"]
        if V1 is None:
            ax.annotate("no stable speed", (0, row), (6, 0), textcoords="offset points", va="center")
            continue
        ax.barh(row, (top if V2 is None else V2) - V1, left=V1, height=0.5, color=colours[name], alpha=0.6)
        end = top if V2 is None else V2
        words = f"{V1:.2f} … {'no upper limit' if V2 is None else f'{V2:.2f}'}"
        after = end < (1 - _ROOM) * top
        at, shift, side = (end, 4, "left") if after else (V1, -4, "right")
        if not after and _ROOM * top > V1:  # a bar from end to end
            at, shift, side = 0.5 * (V1 + end), 0, "center"
        ax.annotate(
            words, (at, row), (shift, 0), textcoords="offset points", fontsize=8, va="center", ha=side,
            path_effects=HALO,
        )  # fmt: skip
    for V in free.stable or ():
        ax.axvline(V, color="0.2", lw=0.8, ls="--")
    ax.set_yticks(range(len(designs)), [_NAMES.get(name, name) for name in designs])
    ax.set_ylim(max(len(designs), 1) - 0.5, -0.5)
    ax.set_xlim(0, top)
    asked = (
        f"; dashed: all are to be stable from {free.stable[0]:g} to {free.stable[1]:g}" if free.stable else ""
    )
    ax.set_xlabel(LABELS["V"] + asked)


def _places(ax: Axes, free: Free, designs: Mapping[str, FreeDesign], colours: Mapping[str, str]) -> None:
    """Each parameter's range as a line, from its least to its greatest value."""
    labels = []
    apart = _ROWS / max(len(designs) - 1, 1)
    for row, (name, (low, high)) in enumerate(free.ends.items()):
        unit = parameter_of(free.bicycle, name).unit
        labels.append(f"{name}: {low:.4g} … {high:.4g} {unit}".removesuffix(" 1"))
        ax.axhspan(row - 0.5, row + 0.5, color="white" if row % 2 else "0.95", lw=0, zorder=0)
        ax.plot([0, 1], [row, row], color="0.7", lw=1, zorder=1)
        for i, (which, design) in enumerate(designs.items()):
            share = (design["over"][name] - low) / (high - low) if high > low else 0.5
            if 0 <= share <= 1:  # the bicycle's own may be outside
                place = row + apart * (i - (len(designs) - 1) / 2)
                ax.plot(
                    share, place, color=colours[which], marker=_MARKS[which], ms=_size(which), ls="", zorder=2
                )
    ax.set_yticks(range(len(labels)), labels, parse_math=False)
    ax.set_ylim(len(labels) - 0.5, -0.5)
    ax.set_xlim(-0.03, 1.03)
    ax.set_xticks([0, 0.5, 1], ["least", "", "greatest"])
    least, _, greatest = ax.get_xticklabels()
    least.set_horizontalalignment("left")
    greatest.set_horizontalalignment("right")
    ax.set_xlabel("where in the range that is searched")


def _size(name: str) -> float:
    return 9 if name == "own" else 6
