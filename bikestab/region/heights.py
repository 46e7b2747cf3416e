"""The speeds over each point of a partition, where those that meet on a curve become one."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.region.columns import kind_of, number_of
from bikestab.region.events import Box
from bikestab.region.patches import Partition
from bikestab.region.triangulation import Index
from bikestab.routh import conditions
from bikestab.speeds import CAPSIZE, WEAVE, critical_speeds

_NEAR = 10.0 ** np.arange(-3, -14, -2)  # of the box: speeds so close may be one that rounding parts
ON = 2e-10  # of the box: a point so close to a surface is on it
_BESIDE = 1e-6  # of the box: how far a speed beside a point may be from that at the point
_STEP = 1e-6  # of the box, for slopes


class Heights(NamedTuple):
    """The points of the mesh: one for each speed over each point of the plane, by point, then by speed.

    ``point`` (height,) in the partition, ``V`` (height,). ``at`` (2, record, interval) are the numbers of the
    heights at which a column's intervals end; ``owner`` (record,) is the column's point.
    """

    point: Index
    V: Floats
    at: Index
    owner: Index


class _Found(NamedTuple):
    """Ends of intervals, ordered by point and speed: which they are, and of what kind (NONE: a face)."""

    side: Index
    record: Index
    interval: Index
    point: Index
    V: Floats
    kind: NDArray[np.int64]

    def chosen(self, which: Index | NDArray[np.bool_]) -> _Found:
        values: list[Any] = [every[which] for every in self]
        return _Found(*values)


def heights(box: Box, plane: Partition) -> Heights:
    """The heights of all columns that triangles of a partition use."""
    columns = plane.columns
    used = np.zeros(columns.record.shape, bool)
    used[plane.triangles, plane.structure[:, np.newaxis]] = True
    used &= columns.record >= 0
    owner = np.full(columns.V.shape[1], -1)
    point, structure = np.nonzero(used)
    owner[columns.record[point, structure]] = point
    found = _found(plane, point, structure)
    several = np.count_nonzero(used, axis=1)[found.point] > 1
    V = found.V.copy()
    if several.any():
        beside = found.chosen(several)
        V[several] = _united(box, plane, beside._replace(V=_exact(box, plane, beside)))
    new = np.append(True, (np.diff(found.point) != 0) | (np.diff(V) != 0))[: len(V)]
    number = np.cumsum(new) - 1
    at = np.full(columns.V.shape, -1)
    at[found.side, found.record, found.interval] = number
    return Heights(found.point[new], V[new], at, owner)


def _found(plane: Partition, point: Index, structure: Index) -> _Found:
    columns, code = plane.columns, plane.columns.codes[structure]
    record = columns.record[point, structure]
    parts = []
    for k in range(columns.V.shape[2]):
        some = number_of(code) > k
        for side in (0, 1):
            kind = kind_of(code[some], k, side)
            n = len(kind)
            V = columns.V[side, record[some], k]
            parts.append((np.full(n, side), record[some], np.full(n, k), point[some], V, kind))
    found = _Found(*map(np.concatenate, zip(*parts, strict=True)))
    return found.chosen(np.lexsort((found.V, found.point)))


def _exact(box: Box, plane: Partition, found: _Found) -> Floats:
    """The speeds of ends found beside points on curves, moved to those at the points where there are such."""
    point, index = np.unique(found.point, return_inverse=True)
    roots = critical_speeds(box.table(plane.points[:, point]))
    V = found.V.copy()
    for kind, name in ((WEAVE, "hurwitz3"), (CAPSIZE, "p0")):
        if not len(roots[name]):
            continue
        own = np.flatnonzero(found.kind == kind)
        candidates = np.where(np.isnan(roots[name]), np.inf, roots[name])[:, index[own]]
        best = np.take_along_axis(
            candidates, np.argmin(np.abs(candidates - V[own]), axis=0)[np.newaxis], axis=0
        )[0]
        V[own] = np.where(np.abs(best - V[own]) < _BESIDE * (box.V[1] - box.V[0]), best, V[own])
    return V


def _united(box: Box, plane: Partition, found: _Found) -> Floats:
    """The speeds of ends over points on curves, with one number for those that meet there.

    Ends are one where they are near each other and one speed is on every surface concerned, to rounding.
    """
    V, free = found.V.copy(), np.ones(len(found.V), bool)
    for near in _NEAR:
        index = np.flatnonzero(free)
        if not len(index):
            break
        gap = np.diff(V[index]) > near * (box.V[1] - box.V[0])
        group = np.cumsum(np.append(True, gap | (np.diff(found.point[index]) != 0))) - 1
        spread = np.full((2, group[-1] + 1), [[np.inf], [-np.inf]])
        np.minimum.at(spread[0], group, V[index])
        np.maximum.at(spread[1], group, V[index])
        differ = spread[1] > spread[0]
        index, group = index[differ[group]], np.cumsum(differ)[group[differ[group]]] - 1
        if not len(index):
            continue
        common, good = _common(box, plane, found.chosen(index), group)
        V[index] = np.where(good[group], common[group], V[index])
        free[index[good[group]]] = False
    return V


def _common(box: Box, plane: Partition, found: _Found, group: Index) -> tuple[Floats, NDArray[np.bool_]]:
    """The speed (group,) nearest to all surfaces of each group of ends at one point; and if it is on them."""
    n = group[-1] + 1
    first = np.flatnonzero(np.append(True, np.diff(group) > 0))
    last = np.append(first[1:], len(group)) - 1
    low, high = found.V[first], found.V[last]
    point = plane.points[:, found.point[first]]
    face = np.full(n, np.nan)
    on_face = np.isin(found.V, box.V)
    face[group[on_face]] = found.V[on_face]
    candidates = np.array([low, high, 0.5 * (low + high)])
    candidates = np.where(np.isnan(face), candidates, face)
    worst = np.zeros(candidates.shape)
    for kind, name in ((WEAVE, "hurwitz3"), (CAPSIZE, "p0")):
        concerned = np.zeros(n, bool)
        concerned[group[found.kind == kind]] = True
        away = distance(box, name, point[:, np.newaxis, concerned], candidates[:, concerned])
        worst[:, concerned] = np.maximum(worst[:, concerned], away)
    best = np.argmin(worst, axis=0)
    each = np.arange(n)
    return candidates[best, each], worst[best, each] < ON


def distance(box: Box, name: str, points: Floats, V: Floats) -> Floats:
    """How far points (2, *shape) with speeds (*shape) are from the zero of a condition, in boxes."""
    speed = box.V[1] - box.V[0]

    def value(du: float, dv: float, dV: float) -> Floats:
        step = np.array([du, dv]).reshape(2, *(1,) * (points.ndim - 1))
        table = box.table(points + step)
        return getattr(conditions(np.broadcast_to(table, (*table.shape[:2], *V.shape)), V + dV * speed), name)

    h = _STEP
    slopes = [
        (value(*step) - value(*(-x for x in step))) / (2 * h) for step in ((h, 0, 0), (0, h, 0), (0, 0, h))
    ]
    with np.errstate(divide="ignore", invalid="ignore"):
        away = np.abs(value(0, 0, 0)) / np.linalg.norm(slopes, axis=0)
    return np.where(np.isnan(away), 0.0, away)  # zero wherever one looks
