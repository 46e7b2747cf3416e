"""Stable speeds of machines as bars, a row for each, with what bounds them written at both ends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.axes import Axes

from bikestab.plot.axes import LABELS
from bikestab.plot.headings import in_rows
from bikestab.plot.sidelabels import Line

_WORDS = 0.2  # of the axis, which words at an end need
_APART = 0.1  # rows from a bar's middle to where nine tenths of an end lie

Answers = Sequence[Mapping[str, Any]]


def draw_bars(ax: Axes, machines: Sequence[tuple[str, Answers]], lines: Sequence[Line], top: float) -> None:
    """A bar for each interval of each machine's first design, on an axis to ``top``."""
    highs = [
        high for _, answers in machines for V, _ in nine_tenths(answers[0], 0.0, 0.0, 2 * top) for high in V
    ]
    top = max([top, *(high / (1 - _WORDS) for high in highs)])
    for row, ((_, answers), line) in enumerate(zip(machines, lines, strict=True)):
        answer, intervals = answers[0], answers[0]["intervals"]
        whiskers = nine_tenths(answer, row, _APART, top)
        for k, interval in enumerate(intervals):
            V1, V2 = interval["V1"], interval["V2"]
            end = top if V2 is None else min(V2, top)
            ax.barh(row, max(end - V1, 0.0), left=V1, height=0.5, color=line.color, alpha=0.45)
            left = min([V1, *(V for speeds, _ in whiskers for V in speeds)])
            right = max([end, *(V for speeds, _ in whiskers for V in speeds)])
            if len(intervals) > 1 or left < _WORDS * top or (1 - _WORDS) * top < V1:
                _above(ax, row, interval, end, top, side=-1 if k % 2 == 0 else 1)
            else:
                _at_ends(ax, row, interval, left, right, top)
        for speeds, at in whiskers:
            ax.plot(speeds, at, "|-", color="0.2", lw=1, ms=7)
        if not intervals:
            ax.annotate("no stable speed", (0, row), (6, 0), textcoords="offset points", va="center")
    ax.set_yticks(range(len(machines)), [in_rows(name) for name, _ in machines], parse_math=False)
    ax.set_ylim(len(machines) - 0.5, -0.6)
    ax.set_xlim(0, top)
    ax.set_xlabel(LABELS["V"])


def _at_ends(ax: Axes, row: int, interval: Mapping[str, Any], left: float, right: float, top: float) -> None:
    """The lower end's words left of a bar, the upper one's right of it, or in it at the frame."""
    style: dict[str, Any] = {"textcoords": "offset points", "fontsize": 8, "va": "center"}
    ax.annotate(f"{interval['lower']} {interval['V1']:.2f}", (left, row), (-5, 0), ha="right", **style)
    inside = right >= top
    ax.annotate(
        _upper(interval, top),
        (right, row),
        (-9 if inside else 5, 0),
        ha="right" if inside else "left",
        **style,
    )


def _above(ax: Axes, row: int, interval: Mapping[str, Any], end: float, top: float, side: int) -> None:
    """Both in one line above a bar, or below it, where there is no room at its ends."""
    V1 = interval["V1"]
    far = 0.5 * top < V1
    words = f"{V1:.2f} {interval['lower']} … {_upper(interval, top)}"
    ax.annotate(
        words, (end if far else V1, row + 0.25 * side), (-9 if far else 2, -3 * side),
        textcoords="offset points", fontsize=8, ha="right" if far else "left",
        va="bottom" if side < 0 else "top",
    )  # fmt: skip


def _upper(interval: Mapping[str, Any], top: float) -> str:
    V2 = interval["V2"]
    if V2 is None:
        return "no upper limit"
    return f"{V2:.2f} {interval['upper']}" + (" →" if top < V2 else "")


def nine_tenths(
    answer: Mapping[str, Any], at: float, apart: float, top: float
) -> list[tuple[list[float], list[float]]]:
    """Where nine tenths of V1 and of V2 lie, cut at ``top``, and their places on both sides of ``at``."""
    lines = []
    for name, shift in (("V1", -apart), ("V2", apart)):
        end = answer.get("spread", {}).get(name, {})
        if end.get("low") is not None:
            high = top if end["high"] is None else end["high"]
            lines.append(([min(top, end["low"]), min(top, high)], [at + shift] * 2))
    return lines
