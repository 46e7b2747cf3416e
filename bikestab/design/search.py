"""Smallest values over a rectangle, from the points of a grid by differential evolution.

What is minimised here has kinks, jumps and parts where nothing is allowed, so no step uses a gradient.
An optimum often lies at the rectangle's rim: steps beyond it end on it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

Costs = Callable[[Floats], Floats]
_SEED = 1981  # the year of the paper; every search is the same each time
ROUNDS, ROUNDS_TOGETHER = 100, 60  # most generations of a few searches, and of many
_ALIKE = 1e-10  # in value, as a standard deviation: so close the population has settled
_POPULATION = 30
_MANY, _SMALLER = 6, 20  # from so many problems at once each has a smaller one
_CLOSE = 0.3  # this share of the points around the best ones starts ten times closer to them


class Found(NamedTuple):
    """The best point (2,) and its value."""

    x: Floats
    value: float


def axes(low: Floats, high: Floats, number: int) -> tuple[Floats, Floats]:
    """Grid values along both sides of a rectangle; a side without length has one, the other then more."""
    flat = low == high
    x, y = (
        np.linspace(a, b, 1 if none else number * (25 if other else 1))
        for a, b, none, other in zip(low, high, flat, flat[::-1], strict=True)
    )
    return x, y


def basins(values: Floats, most: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Indices into a grid of values: its lowest local minima, at most so many."""
    around = np.pad(values, 1, constant_values=np.inf)
    n, m = values.shape
    least = np.min([around[i : i + n, j : j + m] for i in range(3) for j in range(3)], axis=0)
    rank = np.where(values > least, np.inf, values).ravel()
    order = np.argsort(rank, kind="stable")[:most]
    i, j = np.unravel_index(order[np.isfinite(rank[order])], values.shape)
    return i, j


def minimise(
    costs: Costs, low: Floats, high: Floats, starts: Sequence[Floats], spread: Floats
) -> list[Found]:
    """The best points of the rectangle low … high, that of problem k from points ``starts[k]`` (S, 2).

    ``costs`` takes points (2, K, P), P of each of K problems, and gives finite values (K, P): all problems
    advance together, so that a round is one evaluation. The rest of the first population lies as far as
    ``spread`` around the starts, such as a grid's step. A result is never worse than the best of the first
    starts, half of the population, and the same each time.
    """
    random = np.random.default_rng(_SEED)
    many = len(starts) >= _MANY
    size = _SMALLER if many else _POPULATION
    x = np.array([_population(points, spread, low, high, random, size) for points in starts])
    K, P, _ = x.shape
    beyond = 0.1 * (high - low)

    def evaluated(points: Floats) -> Floats:
        return costs(np.moveaxis(np.clip(points, low, high), -1, 0))

    values, row = evaluated(x), np.arange(K)[:, np.newaxis]
    for _ in range(ROUNDS_TOGETHER if many else ROUNDS):
        best = x[row, np.argmin(values, axis=1)[:, np.newaxis]]
        a, b = np.argsort(random.random((K, P, P - 1)), axis=-1)[..., :2].transpose(2, 0, 1)
        a, b = ((np.arange(P) + 1 + each) % P for each in (a, b))  # of two others
        trial = best + random.uniform(0.4, 0.9, (K, 1, 1)) * (x[row, a] - x[row, b])
        new = random.uniform(low - beyond, high + beyond, x.shape)
        trial = np.where((trial < low - beyond) | (trial > high + beyond), new, trial)
        found = evaluated(trial)
        better = found <= values
        x[better], values[better] = trial[better], found[better]
        if (values.std(axis=1) <= _ALIKE).all():
            break
    least = np.argmin(values, axis=1)
    return [Found(np.clip(x[k, i], low, high), float(values[k, i])) for k, i in enumerate(least)]


def _population(
    starts: Floats,
    spread: Floats,
    low: Floats,
    high: Floats,
    random: np.random.Generator,
    size: int,
) -> Floats:
    first = starts[: size // 2]
    more = first[np.arange(size - len(first)) % len(first)]
    away = random.uniform(-1, 1, more.shape) * spread
    away[: int(_CLOSE * len(more))] *= 0.1
    return np.clip(np.concatenate([first, more + away]), low, high)
