"""The reproduction on grids so coarse that tests can afford it."""

from functools import cache

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.model import canonical_matrices
from bikestab.paper1981 import readings
from bikestab.paper1981.box import Sampling
from bikestab.paper1981.reproduce import BICYCLE
from bikestab.paper1981.study import joined, others, plain, undamped

TINY = Sampling(
    grid=60, lines=24, grid_damping=12, grid_readings=15, machines=8, grid_machines=7, search=15, points=61,
    picture=61, cells=8,
)  # fmt: skip
SPEEDS = np.concatenate([np.linspace(0.05, 15, 300), np.geomspace(15.5, 1e5, 100)])


@cache
def halves():
    """Both halves of the numbers on TINY grids."""
    given = Bicycle.preset(BICYCLE), TINY, lambda words: None
    return undamped(*given), others(*given)


@cache
def record():
    """All numbers on TINY grids."""
    return joined(Bicycle.preset(BICYCLE), TINY, *halves())


@cache
def study():
    """The same as report.json has them."""
    return plain(record())


def numbers(conclusion):
    """Those of one conclusion."""
    return study()["conclusions"][str(conclusion)]["numbers"]


@cache
def all_readings():
    return {r.words: r for r in readings.readings(Bicycle.preset(BICYCLE))}


def brute(bicycle, lam, sigma, speeds, model="refined"):
    """The largest real part of the eigenvalues at many speeds, from the matrices alone."""
    M, C1, K0, K2 = canonical_matrices(bicycle, lam, sigma, model=model)
    V = np.asarray(speeds)[:, np.newaxis, np.newaxis]
    first = np.zeros((len(speeds), 4, 4))
    first[:, :2, 2:] = np.eye(2)
    first[:, 2:, :2] = -np.linalg.solve(M, bicycle.g * K0 + V**2 * K2)
    first[:, 2:, 2:] = -np.linalg.solve(M, V * C1 + np.diag([0.0, bicycle.delta]))
    return np.linalg.eigvals(first).real.max(axis=-1)
