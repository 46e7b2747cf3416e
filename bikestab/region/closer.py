"""Answers along a range → more of them, closer where intervals begin, end or change their kinds."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np

FEWEST = 201  # values, between which curves are straight
_PARTS = 8  # of a step in which something changes, again and again
_NEAR = 1e-10  # of the range, which no picture shows; the ends of what closes are then 1e-5 apart

A = TypeVar("A", bound=Mapping[str, Any])


def closer(
    values: Sequence[float], answers: Sequence[A], at: Callable[[list[float]], Sequence[A]]
) -> list[A]:
    """Answers, with ``intervals`` each, at the values and in between, in order, for curves of their ends.

    ``at`` gives answers at other values. Steps from one to the next are 1/200 of the range at most, and where
    intervals begin, end or change their kinds so small that their ends seem to meet.
    """
    known = dict(zip(values, answers, strict=True))
    low, high = min(values), max(values)
    near = _NEAR * (high - low)
    even = np.linspace(low, high, FEWEST)
    far = np.abs(even[:, np.newaxis] - np.array(values)).min(axis=1) > near
    new = even[far].tolist()
    while new:
        known.update(zip(new, at(new), strict=True))
        steps = [
            (a, b)
            for a, b in pairwise(sorted(known))
            if b - a > _PARTS * near and not _alike(known[a], known[b])
        ]
        new = [a + (b - a) * k / _PARTS for a, b in steps for k in range(1, _PARTS)]
    return [known[x] for x in sorted(known)]


def _alike(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Whether the intervals of neighbours overlap, one by one, and are of the same kinds."""
    pairs = [*zip(one["intervals"], other["intervals"], strict=False)]
    return len(one["intervals"]) == len(other["intervals"]) and all(
        (a["lower"], a["upper"]) == (b["lower"], b["upper"])
        and min(a["V2"] or math.inf, b["V2"] or math.inf) > max(a["V1"], b["V1"])
        for a, b in pairs
    )
