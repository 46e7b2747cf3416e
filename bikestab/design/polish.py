"""The end of a search in a box: steps that shrink, and onto the limits that are close."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import TypeVar

import numpy as np

from bikestab.model import Floats

_POINTS = 40  # of each step
_FIRST, _LAST = 0.01, 1e-10  # of the ranges: how far steps go
_CLOSE = 1e-3  # of a range: optima so close to a limit are tried on it

D = TypeVar("D", bound=Mapping[str, object])
Cost = Callable[[Floats], Floats]


def polished(
    cost: Cost, fine: Cost, box: tuple[Floats, Floats], x: Floats, random: np.random.Generator
) -> tuple[Floats, float]:
    """A design (n,) near x that is no worse, and its value by ``fine``, which is ``cost`` more exactly.

    Both take designs (n, S). Random steps that shrink: optima lie at kinks and rims, where gradients
    mislead.
    """
    low, high = (end[:, np.newaxis] for end in box)
    value, size = float(cost(x[:, np.newaxis])[0]), _FIRST
    while size > _LAST:
        away = random.standard_normal((_POINTS, len(x))) * random.choice([0.1, 1, 1], (_POINTS, 1))
        points = np.clip(x[:, np.newaxis] + size * (high - low) * away.T, low, high)
        values = cost(points)
        k = int(np.argmin(values))
        if values[k] < value:
            x, value = points[:, k], float(values[k])
        else:
            size *= 0.5
    return _onto_limits(fine, box, x)


def _onto_limits(fine: Cost, box: tuple[Floats, Floats], x: Floats) -> tuple[Floats, float]:
    """The best of x and of what it is on some of the limits that are close, rather on more of them."""
    low, high = box
    limit = np.where(x - low < high - x, low, high)
    close = np.flatnonzero((np.abs(x - limit) <= _CLOSE * (high - low)) & (x != limit))
    which = np.arange(2 ** len(close))[::-1, np.newaxis] >> np.arange(len(close)) & 1  # all of them first
    points = np.repeat(x[:, np.newaxis], len(which), axis=1)
    points[close] = np.where(which, limit[close], x[close]).T
    values = fine(points)
    k = int(np.argmin(values))
    return points[:, k], float(values[k])


def better(best: D | None, others: Iterable[D | None], key: Callable[[D], float]) -> D | None:
    """An optimum, or what another search found that is allowed and better still, by what is told of them."""
    refused = "not stable as asked", "outside of"
    allowed = [each for each in others if each and not any(word in str(each["at"]) for word in refused)]
    return min([best, *allowed], key=key) if best else None


def or_inf(value: float | None) -> float:
    """What records leave out is infinite."""
    return math.inf if value is None else value
