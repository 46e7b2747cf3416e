"""The structure of triangles that are too narrow to be cut any more."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.region.columns import Ends, number_of
from bikestab.region.events import Box
from bikestab.region.patches import Partition
from bikestab.region.triangulation import Index

_NEAR = 0.02  # of the box's speeds: so far from each other may the ends over two corners be


def borrowed(box: Box, plane: Partition, triangle: Index, small: float) -> int:
    """The structure of a triangle too narrow to be cut: of some corners, where the others have such ends too.

    Of those that do, the one with most intervals. Where there is none, one whose ends are of no kind,
    those that each corner has itself; and else the one without any. What is shorter than ``small`` is
    one point of the plane.
    """
    columns = plane.columns
    has = columns.has()[triangle]
    candidates = np.flatnonzero(has.any(axis=0))
    candidates = candidates[np.argsort(-number_of(columns.codes[candidates]), kind="stable")]
    for any_kind in (False, True):
        for structure in candidates.tolist():
            lent = has[:, structure]
            V = _lent(box, plane, triangle, structure, lent, small, any_kind=any_kind)
            if not np.isfinite(V).all():
                continue
            code, new = columns.codes[[structure]], ~lent
            if any_kind:
                code, new = number_of(code), np.ones(3, bool)
            ends = Ends(V[:, new], np.repeat(code, np.count_nonzero(new)))
            columns.add(triangle[new], ends, plane.points[:, triangle[new]])
            return int(columns.structure(code)[0])
    return int(columns.structure(np.zeros(1, np.int64))[0])


def _lent(
    box: Box,
    plane: Partition,
    triangle: Index,
    structure: int,
    lent: NDArray[np.bool_],
    small: float,
    *,
    any_kind: bool,
) -> Floats:
    """The ends (2, corner, interval) of a structure that some corners have; NaN where no others are such."""
    columns = plane.columns
    V = np.empty((2, 3, columns.V.shape[2]))
    lenders = np.flatnonzero(lent)
    for corner in range(3):
        if lent[corner]:
            V[:, corner] = columns.V[:, columns.record[triangle[corner], structure]]
            continue
        away = plane.length(np.column_stack([triangle[lenders], np.full(len(lenders), triangle[corner])]))
        record = int(columns.record[triangle[lenders[np.argmin(away)]], structure])
        near, beside = _NEAR * (box.V[1] - box.V[0]), bool(away.min() < small)
        V[:, corner] = columns.alike(
            int(triangle[corner]), record, structure, near, beside=beside, any_kind=any_kind
        )
    return V
