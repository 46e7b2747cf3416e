"""Pieces of the skeleton's curves, put together where they belong together."""

from __future__ import annotations

from typing import NamedTuple, get_args

import numpy as np

from bikestab.model import Floats
from bikestab.region.skeleton import CurveName

NAMES: dict[CurveName, str] = {name: name for name in get_args(CurveName)} | {
    "crossing": "fold",  # of two weave speeds, by the weave surface crossing itself
    "capsize fold": "fold of capsize",  # of two capsize speeds, with gains that are not constant
    "meet": "weave meets capsize",
    "slow meet": "weave meets capsize",  # at zero frequency
}
HOP = "hop"  # the end of a piece whose line went on along another branch of the same function
LOST = "not followed"  # the end of a piece where its curve could not be followed further
_SAME = 1e-6  # of the box: the uncertainty of a point where curves touch


class Curve(NamedTuple):
    """One connected piece of a curve across which the stable intervals change.

    ``name`` is a value of NAMES. ``x`` and ``y`` of the family and ``V`` [m/s], shape (point,), are on
    the curve to rounding; V is where it happens: inf for a root that leaves upwards, NaN where p4 = 0.
    ``closes`` tells whether an interval closes there, V1 = V2; else two meet, or one gets another end.
    ``ends`` says what stops the piece at its first and last point: ``box``, ``closed``, the name of
    another curve, or LOST.
    """

    name: str
    x: Floats
    y: Floats
    V: Floats
    closes: bool
    ends: tuple[str, str]

    def reversed(self) -> Curve:
        """The same from its other end."""
        x, y, V = (values[::-1].copy() for values in (self.x, self.y, self.V))
        return Curve(self.name, x, y, V, self.closes, (self.ends[1], self.ends[0]))


def rejoined(pieces: list[Curve]) -> list[Curve]:
    """Pieces put together again where their line hopped to a branch of negative speeds that crosses them."""
    whole = [piece for piece in pieces if HOP not in piece.ends]
    broken = [piece for piece in pieces if HOP in piece.ends]
    while broken:
        first = broken.pop(0)
        if first.ends[1] != HOP:
            first = first.reversed()
        last = np.array([first.x[-1], first.y[-1]])
        others = [
            (other, i)
            for i, piece in enumerate(broken)
            for other in (piece, piece.reversed())
            if other.ends[0] == HOP
        ]
        if not others:
            start = first.name if first.ends[0] == HOP else first.ends[0]
            whole.append(first._replace(ends=(start, first.name)))
            continue
        second, i = min(others, key=lambda pair: np.hypot(pair[0].x[0] - last[0], pair[0].y[0] - last[1]))
        broken.pop(i)
        x, y, V = (
            np.append(a[:-1], b[1:])
            for a, b in ((first.x, second.x), (first.y, second.y), (first.V, second.V))
        )
        joined = Curve(first.name, x, y, V, first.closes, (first.ends[0], second.ends[1]))
        (broken if HOP in joined.ends else whole).append(joined)
    return whole


def met(curves: list[Curve], size: Floats) -> list[Curve]:
    """Curves that meet get one common point there; ``size`` (2,) is that of the box.

    Where they touch, rounding leaves its place along them uncertain; curves at infinity or rest cross.
    """
    ends = [(i, at) for i, curve in enumerate(curves) for at in (0, -1)]
    ends.sort(key=lambda end: not curves[end[0]].name.endswith(("infinity", "rest")))
    common: list[Floats] = []
    for i, at in ends:
        x, y = curves[i].x, curves[i].y
        here = np.array([x[at], y[at]])
        near = [point for point in common if np.abs((point - here) / size).max() < _SAME]
        x[at], y[at] = near[0] if near else here
        if not near:
            common.append(here)
    return curves
