"""What is asked of every mesh: closed but for the box's faces, all of one sense, and on the surface."""

import numpy as np

from bikestab.routh import conditions
from bikestab.speeds import CAPSIZE, NONE, WEAVE

NAMES = {WEAVE: "hurwitz3", CAPSIZE: "p0", NONE: "p4"}


def open_edges(mesh, ends):
    """How many edges lack a second triangle, but for those in a face of the box, have a third, or turn."""
    sides = mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    edges, index, count = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True, return_counts=True)
    way = np.bincount(index.ravel(), np.where(sides[:, 0] < sides[:, 1], 1, -1), minlength=len(edges))
    a, b = mesh.points[edges].swapaxes(0, 1)
    on_face = np.any([(a == face) & (b == face) for face in np.transpose(ends)], axis=(0, 2))
    return int(np.sum((count > 2) | ((count == 1) & ~on_face) | ((count == 2) & (way != 0))))


def away_from_surface(family, ends, mesh):
    """The largest |f| / |∇f| of a vertex, f what its triangles' kinds say; in units of the box.

    A triangle of the kind NONE closes what is finer than the mesh: it has its corners on any surface.
    """
    worst = 0.0
    for kind in np.unique(mesh.kind):
        points = mesh.points[np.unique(mesh.triangles[mesh.kind == kind])]
        names = NAMES.values() if kind == NONE else [NAMES[kind]]
        away = np.min([away_of(family, ends, points, name) for name in names], axis=0)
        worst = max(worst, away.max(initial=0))
    return worst


def away_of(family, ends, points, name):
    """|f| / |∇f| of points (point, 3) for a condition f, in units of the box."""

    def value(points):
        return getattr(conditions(family.table(*points[:, :2].T), points[:, 2]), name)

    h = 1e-5 * np.diag(np.ptp(ends, axis=1))
    slope = np.array([(value(points + e) - value(points - e)) / 2e-5 for e in h])
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.abs(value(points)) / np.linalg.norm(slope, axis=0)
