"""Points of the plane that are near others, and what hangs together; scipy takes longer to import."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats


def near(points: Floats, others: Floats, distance: float) -> NDArray[np.bool_]:
    """Which points (2, n) have one of the others (2, m) within a distance; all lie between 0 and 1.

    Others are sought in squares of that side: those around a point's own are three ranges of numbers.
    """
    row = int(1 / distance) + 4  # squares, with one beyond each end
    at, of = (np.floor(each / distance).astype(np.intp) + 1 for each in (points, others))
    number = of[0] * row + of[1]
    order = np.argsort(number, kind="stable")
    number = number[order]
    found = np.zeros(points.shape[1], bool)
    for beside in (-1, 0, 1):
        middle = (at[0] + beside) * row + at[1]
        first, last = np.searchsorted(number, middle - 1), np.searchsorted(number, middle + 1, "right")
        count = last - first
        which = np.repeat(np.arange(len(count)), count)
        nth = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
        away = points[:, which] - others[:, order[first[which] + nth]]
        found[which[np.hypot(*away) <= distance]] = True
    return found


def connected(a: NDArray[np.intp], b: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """For each of so many things the lowest number of those that hang together by pairs a, b (pair,)."""
    lowest = np.arange(count)
    while True:
        at_a, at_b = lowest[a], lowest[b]
        if np.array_equal(at_a, at_b):
            return lowest
        np.minimum.at(lowest, np.maximum(at_a, at_b), np.minimum(at_a, at_b))
        while not np.array_equal(lowest, further := lowest[lowest]):
            lowest = further
