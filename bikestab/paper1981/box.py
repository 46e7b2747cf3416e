"""What the 1981 paper studied, its box of λ, σ and V, and how finely it is sampled here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bikestab.model import Floats

Range = tuple[float, float]
LAM: Range = (0.0, 0.3)  # rad; section 2 of the paper
SIGMA: Range = (0.0, 0.15)
V: Range = (0.0, 15.0)  # m/s
WIDER = 2.0  # the box, this much longer along λ and σ, shows what lies just beyond the paper's
WIDER_LAM: Range = (LAM[0], WIDER * LAM[1])
WIDER_SIGMA: Range = (SIGMA[0], WIDER * SIGMA[1])


@dataclass(frozen=True)
class Sampling:
    """How finely the study is sampled: designs per axis unless something else is said."""

    grid: int = 1000
    lines: int = 400  # of constant σ, along which shares are exact
    grid_damping: int = 60  # for each δ
    grid_readings: int = 80  # for each reading of the printed values
    machines: int = 400  # random ones
    grid_machines: int = 21
    search: int = 161  # what the search for the best designs starts from
    picture: int = 401
    cells: int = 48  # of the mesh drawn in three dimensions
    every: int = 1  # reading of the printed values


FULL = Sampling()
QUICK = Sampling(200, 60, 24, 30, 60, 11, 31, 121, 20, 3)


def middles(ends: Range, n: int) -> Floats:
    """The middles (n,) of n equal parts of a range."""
    return ends[0] + (ends[1] - ends[0]) * (np.arange(n) + 0.5) / n
