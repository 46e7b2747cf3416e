"""What the 1981 paper studied, its box of λ, σ and V, and how finely it is sampled here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bikestab.model import Floats

Range = tuple[float, float]
LAM: Range = (0.0, 0.3)  # rad; section 2 of the paper
SIGMA: Range = (0.0, 0.15)
V: Range = (0.0, 15.0)  # m/s


@dataclass(frozen=True)
class DesignBox:
    """Ranges of λ [rad] and σ."""

    lam: Range
    sigma: Range

    @property
    def wider(self) -> DesignBox:
        """The box twice as long along λ and σ, which shows what lies just beyond."""
        return DesignBox((self.lam[0], 2 * self.lam[1]), (self.sigma[0], 2 * self.sigma[1]))

    @property
    def area(self) -> float:
        """Its area [rad]."""
        return (self.lam[1] - self.lam[0]) * (self.sigma[1] - self.sigma[0])


PAPER_BOX = DesignBox(LAM, SIGMA)


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
    points: int = 201  # in space, for balls; half as many designs for controllability
    picture: int = 401
    cells: int = 48  # of the mesh drawn in three dimensions


FULL = Sampling()
QUICK = Sampling(200, 60, 24, 30, 60, 11, 31, 81, 121, 20)


def middles(ends: Range, n: int) -> Floats:
    """The middles (n,) of n equal parts of a range."""
    return ends[0] + (ends[1] - ends[0]) * (np.arange(n) + 0.5) / n
