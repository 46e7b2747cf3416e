"""The stable speeds of designs, and what would help those that have none, as records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from bikestab.arguments import design_of
from bikestab.bicycle import Bicycle
from bikestab.model import Model, exact_table
from bikestab.records import (
    Design,
    Interval,
    Verdict,
    design_of_numbers,
    design_record,
    interval_records,
    verdict_record,
)
from bikestab.speeds import intervals_of
from bikestab.stability import stable_intervals
from bikestab.variants import check_names, check_values, varied

if TYPE_CHECKING:
    from bikestab.region.nearest import Nearest


class Answer(Design, Verdict):
    """A design and its intervals of stable speeds, and whether these are certain.

    ``nearest`` says what would help where there is none, and is None otherwise or where nobody asked.
    """

    intervals: list[Interval]
    nearest: Nearest | None


def stable_speeds(
    bicycle: Bicycle,
    lam: ArrayLike | None = None,
    sigma: ArrayLike | None = None,
    *,
    model: Model = "refined",
    nearest: bool = True,
) -> list[Answer]:
    """The stable speeds at every combination of tilts [rad] and trails, those of one tilt after another.

    Arrays of two axes are not combined but broadcast together. Without them the bicycle's own are taken.
    Raises InputError as ``stability.stable_intervals``.
    """

    def helps(lam: float, sigma: float) -> Nearest:
        from bikestab.family import Family  # most answers need neither
        from bikestab.region.nearest import nearest_stable

        return nearest_stable(Family(bicycle, model), lam, sigma)

    tilts, trails = design_of(bicycle, lam, sigma)
    if tilts.ndim < 2 and trails.ndim < 2:
        tilts = np.atleast_1d(tilts)[:, np.newaxis]
    tilts, trails = np.broadcast_arrays(*np.atleast_2d(tilts, trails))
    found = stable_intervals(bicycle, tilts, trails, model=model)
    answers: list[Answer] = []
    for i, j in np.ndindex(found.number.shape):
        design = design_record(float(tilts[i, j]), float(trails[i, j]), bicycle)
        intervals = interval_records(found, i, j)
        help_ = helps(design["lam"], design["sigma"]) if nearest and not intervals else None
        verdict = verdict_record(found, i, j)
        answers.append({**design, "intervals": intervals, **verdict, "nearest": help_})
    return answers


def stable_speeds_over(
    bicycle: Bicycle, values: Mapping[str, Sequence[float]], *, model: Model = "refined"
) -> list[tuple[dict[str, float], Answer]]:
    """The stable speeds at every combination of values of one or more parameters, the last one's fastest.

    Raises InputError, with a parameter's name as key, for one that the bicycle does not have, and for values
    that no machine can have.
    """
    check_names(bicycle, {name: name for name in values})
    for corner in product(*((min(each), max(each)) for each in values.values())):
        check_values(bicycle, dict(zip(values, corner, strict=True)))
    points = np.array(list(product(*values.values()))).T
    machines, lam, sigma = varied(bicycle, dict(zip(values, points, strict=True)))
    found = intervals_of(exact_table(machines, lam, sigma, model=model))
    wheelbase, radius, tilts, trails = (
        np.broadcast_to(x, points.shape[1:]) for x in (machines.c, machines.R2, lam, sigma)
    )
    answers = []
    for i, point in enumerate(points.T.tolist()):
        design = design_of_numbers(*(float(x[i]) for x in (tilts, trails, wheelbase, radius)))
        answer: Answer = {
            **design, "intervals": interval_records(found, i), **verdict_record(found, i), "nearest": None,
        }  # fmt: skip
        answers.append((dict(zip(values, point, strict=True)), answer))
    return answers
