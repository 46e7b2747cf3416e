"""The structure of triangles that are too narrow to be cut any more."""

from __future__ import annotations

import numpy as np

from bikestab.model import Floats
from bikestab.region.columns import Ends, number_of
from bikestab.region.events import Box
from bikestab.region.patches import Partition
from bikestab.region.triangulation import Index

_NEAR = 0.02  # of the box's speeds: so far from each other may the ends over two corners be,
_STEEP = 5  # or by so many times the way between these
_LITTLE = 1e-4  # of the box's speeds: so much of what is stable may be left out


def borrowed(box: Box, plane: Partition, triangle: Index, small: float) -> int:
    """The structure of a triangle too narrow to be cut: of some corners, where the others have such ends too.

    Of those it is the one that leaves out least of what is stable over the corners; of several the one with
    most intervals, and one whose ends are of no kind only where there is no other. What is shorter than
    ``small`` is one point of the plane.
    """
    columns = plane.columns
    has = columns.has()[triangle]
    candidates = np.flatnonzero(has.any(axis=0))
    candidates = candidates[np.argsort(-number_of(columns.codes[candidates]), kind="stable")]
    code, V, least = 0, np.zeros((2, 3, columns.V.shape[2])), np.inf
    for any_kind in (False, True):
        for structure in candidates.tolist():
            ends = _lent(box, plane, triangle, structure, small, any_kind=any_kind)
            number = int(number_of(columns.codes[structure]))
            lost = sum(_left_out(plane, point, ends[:, i, :number]) for i, point in enumerate(triangle))
            if lost < least - _LITTLE * (box.V[1] - box.V[0]):
                code, V, least = number if any_kind else int(columns.codes[structure]), ends, lost
    codes = np.full(3, code)
    columns.add(triangle, Ends(V, codes), plane.points[:, triangle])
    return int(columns.structure(codes[:1])[0])


def _left_out(plane: Partition, point: int, V: Floats) -> float:
    """How many m/s are stable over a point but in none of the intervals V (2, interval).

    Infinite where V has NaN or is not in order.
    """
    if not (np.diff(V.T.ravel()) >= 0).all():
        return np.inf
    columns = plane.columns
    known = columns.record[point]
    own = columns.V[:, known[known >= 0].min()]
    common = np.minimum(own[1], V[1, :, np.newaxis]) - np.maximum(own[0], V[0, :, np.newaxis])
    return float(np.diff(own, axis=0).sum() - np.maximum(common, 0).sum())


def _lent(
    box: Box, plane: Partition, triangle: Index, structure: int, small: float, *, any_kind: bool
) -> Floats:
    """The ends (2, corner, interval) of a structure that some corners have; NaN where no others are such."""
    columns = plane.columns
    V = np.empty((2, 3, columns.V.shape[2]))
    lent = columns.has()[triangle, structure]
    lenders, speeds = triangle[lent], box.V[1] - box.V[0]
    for corner, point in enumerate(triangle.tolist()):
        if lent[corner]:
            V[:, corner] = columns.V[:, columns.record[point, structure]]
            continue
        away = plane.length(np.column_stack([lenders, np.full(len(lenders), point)]))
        for i in np.argsort(away, kind="stable"):  # ends may change much between a corner and the nearest
            record, beside = int(columns.record[lenders[i], structure]), bool(away[i] < small)
            near = max(_NEAR, _STEEP * away[i]) * speeds
            V[:, corner] = columns.alike(point, record, structure, near, beside=beside, any_kind=any_kind)
            if np.isfinite(V[:, corner]).all():
                break
    return V
