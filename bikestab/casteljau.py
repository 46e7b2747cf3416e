"""Bernstein coefficients of polynomials (power, interval) → those of parts of intervals, and where to cut."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.twofold import Twofold

_NEWTON, _SETTLED = 6, 1e-9  # steps to an extreme value, and the last one's size
_EDGE = 2.0**-45  # so close to an end of its interval no cut is put at an extreme value


def extremes(
    b: Twofold, start: Floats, share: float, *, alone: bool = False
) -> tuple[Floats, NDArray[np.bool_]]:
    """Where to cut 0 … 1 so that polynomials with an extreme value close to zero are soon decided.

    At that value, found by Newton's method, if it is beyond zero, else on either side of it, where the means
    have its sign; ``start`` if there is none. And whether it may be zero, so that no cut decides; with
    ``alone`` only where there is no other zero beside it.
    """
    slopes, t = np.diff(b.value, axis=0), start
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for _ in range(_NEWTON):
            c = slopes
            while len(c) > 2:
                c = c[:-1] + t * (c[1:] - c[:-1])
            bend = (len(slopes) - 1) * (c[1] - c[0])
            t, move = t - (move := (c[0] + t * (c[1] - c[0])) / bend), move
        found = (t > 0) & (t < 1) & (np.abs(move) < _SETTLED)
        t = np.where(found, t, start)
        left, right = parts(b, t)
        there = left.at(-1)
        away = 0.7 * np.sqrt(np.fmax(2 * there.value / (len(slopes) * bend), 0))
        t = np.where(t > 1.5 * away, t - away, t + away)
    usable = found & (t > _EDGE) & (t < 1 - _EDGE)
    double = found & (np.abs(there.value) <= share * there.size)
    if alone:  # else cut elsewhere, so that they come apart
        other = double & ~(_one_sign(left, share) & _one_sign(right, share))
        usable, double = usable & ~other, double & ~other
    return np.where(usable, t, start), double


def _one_sign(b: Twofold, share: float) -> NDArray[np.bool_]:
    """Whether coefficients beyond that share of their terms are of one sign, so that nothing else is zero."""
    clear = np.abs(b.value) > share * b.size
    return ~((clear & (b.value > 0)).any(axis=0) & (clear & (b.value < 0)).any(axis=0))


def parts(b: Twofold, at: Floats) -> tuple[Twofold, Twofold]:
    """The Bernstein coefficients left and right of the place ``at`` (interval,) by de Casteljau's means."""
    left, right = [b.at(0)], [b.at(-1)]
    while len(b.value) > 1:
        b = _mean(b.at(slice(None, -1)), b.at(slice(1, None)), at)
        left.append(b.at(0))
        right.append(b.at(-1))
    return stacked(left), stacked(right[::-1])


def _mean(a: Twofold, b: Twofold, at: Floats) -> Twofold:
    size = a.size + at * (b.size - a.size)
    if a.rest is None:
        return Twofold(a.value + at * (b.value - a.value), None, size)
    moved = (b - a) * at + a
    return Twofold(moved.value, moved.rest, size)


def stacked(rows: list[Twofold]) -> Twofold:
    """Coefficients, one row for each."""
    value, rest, size = (
        None if getattr(rows[0], name) is None else np.array([getattr(row, name) for row in rows])
        for name in ("value", "rest", "size")
    )
    return Twofold(value, rest, size)


def beside(intervals: list[Twofold]) -> Twofold:
    """The coefficients of some intervals and of others."""
    value, size = (
        np.concatenate([getattr(part, name) for part in intervals], axis=1) for name in ("value", "size")
    )
    rest = None if intervals[0].rest is None else np.concatenate([part.rest for part in intervals], axis=1)
    return Twofold(value, rest, size)
