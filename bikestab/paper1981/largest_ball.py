"""Conclusion 3: the stability margin as the distance from the boundary of the stable region."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.lean import alone
from bikestab.model import characteristic_table
from bikestab.paper1981.box import LAM, SIGMA, V
from bikestab.speeds import intervals_of


@dataclass(frozen=True)
class Ball:
    """The largest ball of stable points: its centre, and its radius in sides of the box, to 1/``points``."""

    lam: float
    sigma: float
    V: float
    radius: float
    points: int


def largest_ball(bicycle: Bicycle, n: int) -> Ball:
    """The largest ball in the paper's box, each of whose sides counts as one; the box's faces bound it too.

    From n³ points and the exact distance of each stable one from the nearest that is not, or not in the box.
    """
    x, y, z = (np.linspace(*ends, n) for ends in (LAM, SIGMA, V))
    ends = intervals_of(characteristic_table(bicycle, x[:, np.newaxis], y))
    V1, V2 = (speeds[:, :, np.newaxis, :] for speeds in (ends.V1, ends.V2))
    stable = ((z[:, np.newaxis] > V1) & (z[:, np.newaxis] < V2)).any(axis=-1)
    distances = alone("scipy.ndimage", "_morphology", "distance_transform_edt")
    away = distances(np.pad(stable, 1), sampling=1 / (n - 1))[1:-1, 1:-1, 1:-1]
    i, j, k = np.unravel_index(np.argmax(away), away.shape)
    return Ball(float(x[i]), float(y[j]), float(z[k]), float(away[i, j, k]), n)
