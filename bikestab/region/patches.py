"""The plane of designs as triangles, each with the structure of its stable intervals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.region.columns import Columns
from bikestab.region.triangulation import Index


@dataclass
class Partition:
    """Points (2, point) in units of the box, triangles (triangle, 3) of them, each of one structure.

    ``structure`` (triangle,) are numbers in ``columns``: every corner of a triangle has a record of it,
    unless it is the one without intervals; −1 where it is not known yet.
    """

    points: Floats
    triangles: Index
    structure: Index
    columns: Columns

    def add(self, points: Floats) -> Index:
        """The numbers of new points (2, n)."""
        self.points = np.concatenate([self.points, points], axis=1)
        self.columns.grow(points.shape[1])
        return np.arange(self.points.shape[1] - points.shape[1], self.points.shape[1])

    def share(self, sides: Index) -> NDArray[np.bool_]:
        """Whether all points of each side or triangle (n, corner) have a structure in common."""
        return np.logical_and.reduce(self.columns.has()[sides], axis=1).any(axis=1)

    def length(self, sides: Index) -> Floats:
        """Of sides (n, 2), in units of the box."""
        return np.hypot(*(self.points[:, sides[:, 1]] - self.points[:, sides[:, 0]]))

    def area(self, triangles: Index) -> Floats:
        """Of triangles (n, 3), in units of the box."""
        a, b, c = self.points[:, triangles.T].swapaxes(0, 1)
        return 0.5 * ((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0])
