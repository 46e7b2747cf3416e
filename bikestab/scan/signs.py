"""Exact roots → the violated conditions at every speed of a grid, without evaluating them there.

Between two neighbouring roots no condition changes its sign, so a column of the grid is a few runs of
one bit mask. ``routh.violated`` is the other way to the same mask; tests hold them against each other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.critical import Critical
from bikestab.model import Floats
from bikestab.rounding import NO_SIGN
from bikestab.routh import CONDITIONS, conditions, conditions_at_rest, violated
from bikestab.scan.agreement import size_of_terms

ALL = np.uint8((1 << len(CONDITIONS)) - 1)
_PART = 1 << 14  # points at which conditions are evaluated at a time
NEAR = 1e-9  # relative; that close to a root rounding might decide, and the conditions are evaluated


def violated_between(table: Floats, critical: Critical, V: Floats) -> NDArray[np.uint8]:
    """The bit mask of ``routh.violated`` for a table (5, 4, cell) at the speeds V [m/s]; (cell, V).

    V ascends and is not negative. At rest, and at the speed next to a root if it is within NEAR of it, the
    conditions themselves decide; so they do in cells that may have other roots, where they are more than
    rounding.
    """
    n = table.shape[-1]
    first = np.zeros(n, np.uint8)  # the mask just above V = 0
    steps, close = [], []
    ends = np.concatenate([[-np.inf], V, [np.inf]])
    for bit, name in enumerate(CONDITIONS):
        first |= (~(critical.sign[name] > 0)).view(np.uint8) << np.uint8(bit)
        for root in critical.speeds[name]:
            place = np.searchsorted(V, root)  # the first speed that is not below; NaN sorts behind all
            steps.append(place << len(CONDITIONS) | bit)
            below, above = root - ends[place], ends[place + 1] - root
            cell = np.flatnonzero(np.minimum(below, above) <= NEAR * root)
            if len(cell):
                close.append((cell, place[cell] - (below[cell] < above[cell])))
    mask = _runs(first, np.sort(np.array(steps, np.intp).reshape(-1, n).T, axis=1), len(V))
    if V[0] == 0:
        mask[:, 0] = violated(conditions_at_rest(table))
    if close:
        cell, place = np.concatenate(close, axis=1)
        mask[cell, place] = violated(conditions(table[..., cell], V[place]))
    cell = np.flatnonzero(undecided(critical))
    for part in np.array_split(cell, 1 + len(cell) * len(V) // _PART) if len(cell) else ():
        mask[part] = _with_clear_signs(mask[part], table[:, :, part, np.newaxis], V)
    return mask


def _with_clear_signs(mask: NDArray[np.uint8], table: Floats, V: Floats) -> NDArray[np.uint8]:
    """The mask (cell, V) with the bits of conditions that are more than rounding there."""
    values = conditions(table, V)
    for bit, name in enumerate(CONDITIONS):
        value = getattr(values, name)
        clear = np.abs(value) > NO_SIGN * size_of_terms(table, name, V)
        mask = np.where(clear, mask & ~np.uint8(1 << bit) | (value < 0).view(np.uint8) << np.uint8(bit), mask)
    return mask


def undecided(critical: Critical) -> NDArray[np.bool_]:
    """Which cells may have other roots than those that are known, as rounding leaves them."""
    return ~np.logical_and.reduce([zeros.sure for zeros in critical.zeros.values()])


def _runs(first: NDArray[np.uint8], steps: NDArray[np.intp], num: int) -> NDArray[np.uint8]:
    """Rows of ``num`` masks that begin with ``first`` and flip a bit at each step.

    ``steps`` (row, step) are ascending: the place in the row, and the bit in the lowest bits.
    """
    place, bit = steps >> len(CONDITIONS), steps & ALL
    n, k = steps.shape
    values, ends = np.empty((n, k + 1), np.uint8), np.empty((n, k + 2), np.intp)
    values[:, 0], values[:, 1:] = first, np.left_shift(1, bit)
    ends[:, 0], ends[:, 1:-1], ends[:, -1] = 0, place, num
    np.bitwise_xor.accumulate(values, axis=1, out=values)
    return np.repeat(values.ravel(), np.diff(ends, axis=1).ravel()).reshape(n, num)
