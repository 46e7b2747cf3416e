"""The stable region of a grid of designs, and its smallest trails, of several machines at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import Floats, characteristic_table
from bikestab.paper1981.box import DesignBox, middles
from bikestab.paper1981.forks import bent_forwards
from bikestab.paper1981.maps import Flags, has_unbounded, widths
from bikestab.paper1981.several import groups, together
from bikestab.region.lines import lowest_stable
from bikestab.speeds import WEAVE
from bikestab.undamped import stable_speeds

FOLDS = (1 / 3, 2 / 3, 1.0)  # of the largest λ: where the smallest stable σ is followed
_SAMPLES = (60, 24, 24, 24)  # of a line for its smallest stable σ, and of the step that has it, and so on


class Region(NamedTuple):
    """The stable region of designs (n, n) of one machine, and the smallest stable σ at each λ of FOLDS.

    The first interval's ``V1`` [m/s] is NaN where it does not start with weave.
    """

    p0: Floats
    width: Floats
    V1: Floats
    unbounded: Flags
    sigma_min: list[float | None]


class Choice(NamedTuple):
    """Which designs of the grid, and which (λ, σ) in general, are looked at."""

    grid: Flags
    design: Callable[[float, float], bool]


Smallest = Callable[[Sequence[Bicycle], DesignBox], Floats]


def fold_lams(box: DesignBox) -> Floats:
    """The λ [rad] at which the smallest stable σ is followed."""
    return np.array(FOLDS) * box.lam[1]


def choices(bicycle: Bicycle, n: int, box: DesignBox) -> tuple[Choice, Choice]:
    """All designs, and those whose fork is bent forwards."""
    forwards = bent_forwards(bicycle, middles(box.lam, n)[:, np.newaxis], middles(box.sigma, n))
    return (
        Choice(np.ones_like(forwards), lambda lam, sigma: True),
        Choice(forwards, lambda lam, sigma: bool(bent_forwards(bicycle, lam, sigma))),
    )


def regions(bicycles: Sequence[Bicycle], n: int, box: DesignBox, smallest: Smallest) -> list[Region]:
    """The region of each of several machines."""
    x, y = middles(box.lam, n)[:, np.newaxis], middles(box.sigma, n)
    found: list[Region] = []
    for group in groups(bicycles, n * n):
        table = characteristic_table(together(group), x, y)
        intervals = stable_speeds(table)
        V1 = np.where(intervals.lower[..., 0] == WEAVE, intervals.V1[..., 0], np.nan)
        width = widths(intervals).sum(axis=-1)
        lowest = [
            [None if np.isnan(sigma) else sigma for sigma in row] for row in smallest(group, box).tolist()
        ]
        parts = np.moveaxis(table[0], 0, 1), width, V1, has_unbounded(intervals), lowest
        found += [Region(*each) for each in zip(*parts, strict=True)]
    return found


def exact_sigma_min(bicycles: Sequence[Bicycle], box: DesignBox) -> Floats:
    """The smallest σ (bicycle, λ) with a stable speed at each λ of FOLDS, NaN where there is none.

    The bicycles differ in nothing but damping. Those with it are followed at once.
    """
    lam, delta = fold_lams(box), np.array([bicycle.delta for bicycle in bicycles])
    lowest = np.empty((len(bicycles), len(lam)))
    for alike in (delta == 0, delta > 0):
        if alike.any():
            lines = np.tile(lam, np.count_nonzero(alike))
            others = {"delta": np.repeat(delta[alike], len(lam))}
            found = lowest_stable(Family(bicycles[0]), *box.sigma, x=lines, others=others)
            lowest[alike] = found.reshape(-1, len(lam))
    return lowest


def sampled_sigma_min(bicycles: Sequence[Bicycle], box: DesignBox) -> Floats:
    """As ``exact_sigma_min``, to 2e-6 of the range, where the stable σ are no less than 1/60 of it."""
    machines, lam = together(bicycles), fold_lams(box)[:, np.newaxis]
    low, high = (np.full((len(bicycles), len(FOLDS), 1), end) for end in box.sigma)
    for samples in _SAMPLES:
        sigma = low + (high - low) * np.linspace(0, 1, samples)
        stable = stable_speeds(characteristic_table(machines, lam, sigma)).upper[..., 0] > 0
        first = np.argmax(stable, axis=-1)[..., np.newaxis]
        low, high = (np.take_along_axis(sigma, at, axis=-1) for at in (np.maximum(first - 1, 0), first))
        low, high = (np.where(stable.any(axis=-1, keepdims=True), end, np.nan) for end in (low, high))
    return np.asarray(high[..., 0])
