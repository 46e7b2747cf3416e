"""Smallest values over a rectangle, from the points of a grid by differential evolution.

What is minimised here has kinks, jumps and parts where nothing is allowed, so no step uses a gradient.
An optimum often lies at the rectangle's rim: steps beyond it end on it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import differential_evolution

from bikestab.model import Floats

Cost = Callable[[Floats], Floats]  # points (2, S) → values (S,), all finite
_SEED = 1981  # the year of the paper; every search is the same each time
ROUNDS, ROUNDS_TOGETHER = 100, 60  # most generations of one search, and of many at once
_POPULATION = 30
_SMALLER = 20  # of each of many problems at once
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


def minimise(cost: Cost, low: Floats, high: Floats, starts: Floats, spread: Floats) -> Found:
    """The best point of the rectangle low … high found from the points ``starts`` (S, 2).

    The rest of the first population lies as far as ``spread`` around them, such as a grid's step. The
    result is never worse than the best of the first 15 starts, and the same each time.
    """
    random = np.random.default_rng(_SEED)
    beyond = 0.1 * (high - low)
    end = differential_evolution(
        lambda x: cost(np.clip(x, low[:, np.newaxis], high[:, np.newaxis])),
        list(zip(low - beyond, high + beyond, strict=True)),
        init=_population(starts, spread, low, high, random), vectorized=True, updating="deferred",
        polish=False, rng=random, maxiter=ROUNDS, tol=0, atol=1e-10, mutation=(0.4, 0.9), recombination=1.0,
    )  # fmt: skip
    return Found(np.clip(end.x, low, high), float(end.fun))


def minimise_all(
    measure: Callable[[Floats], Floats],
    costs: Callable[[Floats], Floats],
    low: Floats,
    high: Floats,
    starts: list[Floats],
    spread: Floats,
) -> Floats:
    """The best points (K, 2) of K problems that measure the same of a point, as in ``minimise``.

    ``measure`` takes points (2, S) and gives (M, S); ``costs`` takes measures (M, K, P) and gives (K, P).
    ``starts`` are K arrays (S, 2). All problems advance together, so that a round is one evaluation.
    """
    random = np.random.default_rng(_SEED)
    x = np.array([_population(points, spread, low, high, random, _SMALLER) for points in starts])
    K, P, _ = x.shape

    def evaluated(points: Floats) -> Floats:
        return costs(measure(points.reshape(-1, 2).T).reshape(-1, K, P))

    values, row = evaluated(x), np.arange(K)[:, np.newaxis]
    for _ in range(ROUNDS_TOGETHER):
        best = x[row, np.argmin(values, axis=1)[:, np.newaxis]]
        a, b = random.integers(P, size=(2, K, P))
        step, pull = random.uniform(0.3, 0.9, (2, K, P, 1))
        trial = np.clip(x + pull * (best - x) + step * (x[row, a] - x[row, b]), low, high)
        found = evaluated(trial)
        better = found <= values
        x[better], values[better] = trial[better], found[better]
    return x[np.arange(K), np.argmin(values, axis=1)]


def _population(
    starts: Floats,
    spread: Floats,
    low: Floats,
    high: Floats,
    random: np.random.Generator,
    size: int = _POPULATION,
) -> Floats:
    first = starts[: size // 2]
    more = first[np.arange(size - len(first)) % len(first)]
    away = random.uniform(-1, 1, more.shape) * spread
    away[: int(_CLOSE * len(more))] *= 0.1
    return np.clip(np.concatenate([first, more + away]), low, high)
