"""The stable speeds of designs, and what would help those that have none, as records."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from bikestab.arguments import design_of
from bikestab.bicycle import Bicycle
from bikestab.model import Model
from bikestab.records import Design, Interval, Verdict, design_record, interval_records, verdict_record
from bikestab.stability import stable_intervals

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
