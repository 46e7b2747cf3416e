"""Exact roots → the violated conditions at every speed of a grid, without evaluating them there.

Between two neighbouring roots no condition changes its sign, so a column of the grid is a few runs of
one bit mask. ``routh.violated`` is the other way to the same mask; tests hold them against each other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.critical import Critical, critical
from bikestab.model import ExactTable, Floats
from bikestab.rounding import NO_SIGN
from bikestab.routh import CONDITIONS, conditions, violated
from bikestab.scan.agreement import size_of_terms

ALL = (1 << len(CONDITIONS)) - 1
Indices = NDArray[np.intp]
_PART = 1 << 14  # points at which conditions are evaluated at a time
_FROM = np.triu(np.ones((8, 8), np.uint8)).view(np.uint64).ravel()  # ones from each byte of a word on
NEAR = 1e-9  # relative; that close to a root rounding might decide, and the conditions are evaluated


def violated_between(
    table: Floats | ExactTable,
    exact: Critical,
    V: Floats,
    outside: tuple[float, float] = (-np.inf, np.inf),
    rough: bool = False,
) -> NDArray[np.uint8]:
    """The bit mask of ``routh.violated`` for a table (5, 4, cell) at the speeds V [m/s]; (cell, V).

    V ascends and is not negative, and is part of a grid with the speeds ``outside`` before and behind it. At
    rest, and at the grid's speed next to a root if it is within NEAR or the root's radius of it, the
    conditions themselves decide; so they do in cells that may have other roots, where they are more than
    rounding. Where they might if the roots were better than ``rough``, better ones are found.
    """
    plain = table.value if isinstance(table, ExactTable) else table
    first = np.zeros(plain.shape[-1], np.uint8)  # the mask just above V = 0
    steps, close, few = [], [], np.zeros(len(first), bool)
    ends = np.concatenate([[-np.inf], V, [np.inf]])
    for k, name in enumerate(CONDITIONS):
        bit = np.uint8(1 << k)
        first |= np.where(exact.sign[name] > 0, np.uint8(0), bit)
        zeros = exact.zeros[name]
        for root, radius in zip(zeros.V, zeros.radius, strict=True):
            place, below, above = _placed(root, V, ends)
            steps.append(place << len(CONDITIONS) | bit)
            cell = np.flatnonzero(np.minimum(below, above) <= (1 + rough) * np.fmax(NEAR * root, radius))
            few[cell] = rough
            if len(cell) and not rough:
                close.append(_nearest(cell, place[cell], root[cell], ends, outside))
    mask = _runs(first, steps, len(V))
    if V[0] == 0:
        mask[:, 0] = violated(conditions(plain, 0.0))
    if close:
        cell, place = np.concatenate(close, axis=1)
        mask[cell, place] = violated(conditions(plain[..., cell], V[place]))
    if few.any():
        some = ExactTable(*(each[..., few] for each in table)) if plain is not table else plain[..., few]
        mask[few] = violated_between(some, critical(some), V, outside)
    cell = np.flatnonzero(undecided(exact))
    for part in np.array_split(cell, 1 + len(cell) * len(V) // _PART) if len(cell) else ():
        mask[part] = _with_clear_signs(mask[part], plain[:, :, part, np.newaxis], V)
    return mask


def _nearest(
    cell: Indices, place: Indices, root: Floats, ends: Floats, outside: tuple[float, float]
) -> tuple[Indices, Indices]:
    """The cells whose root is next to one of V, and to which: to the nearer one, of its grid's speeds too."""
    below, above = ends[place], ends[place + 1]
    below[place == 0], above[place == len(ends) - 2] = outside
    place = place - (root - below < above - root)
    inside = (place >= 0) & (place < len(ends) - 2)
    return cell[inside], place[inside]


def _with_clear_signs(mask: NDArray[np.uint8], table: Floats, V: Floats) -> NDArray[np.uint8]:
    """The mask (cell, V) with the bits of conditions that are more than rounding there."""
    values = conditions(table, V)
    for bit, name in enumerate(CONDITIONS):
        value = getattr(values, name)
        clear = np.abs(value) > NO_SIGN * size_of_terms(table, name, V)
        mask = np.where(clear, mask & ~np.uint8(1 << bit) | (value < 0).view(np.uint8) << np.uint8(bit), mask)
    return mask


def undecided(exact: Critical) -> NDArray[np.bool_]:
    """Which cells may have other roots than those that are known, as rounding leaves them."""
    return ~np.logical_and.reduce([zeros.sure for zeros in exact.zeros.values()])


def _placed(root: Floats, V: Floats, ends: Floats) -> tuple[Indices, Floats, Floats]:
    """The first speed that is not below each root, behind all for NaN, and how far both neighbours are.

    ``ends`` are V between infinities. The place is guessed as if speeds were even, and searched for where it
    is another.
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        even = (root - V[0]) * ((len(V) - 1) / (V[-1] - V[0])) + 1
        place = np.fmax(np.fmin(even, len(V)), 0).astype(np.intp)
    below, above = root - ends[place], ends[place + 1] - root
    wrong = np.flatnonzero((below <= 0) | (above < 0))
    if len(wrong):
        place[wrong] = at = np.searchsorted(V, root[wrong])
        below[wrong], above[wrong] = root[wrong] - ends[at], ends[at + 1] - root[wrong]
    return place, below, above


def _runs(first: NDArray[np.uint8], steps: list[Indices], num: int) -> NDArray[np.uint8]:
    """Rows of ``num`` masks that begin with ``first`` and flip a bit at each step.

    A step (row,) has the place in the row, and the bit in its lowest bits. Runs of eight masks at a time are
    laid out first, then come the steps within eight.
    """
    number = -(-num // 8)
    words = _words(first, steps, number)
    flat, begins = words.reshape(-1), np.arange(0, words.size, number)
    for step in steps:
        place = step >> len(CONDITIONS)
        some = np.flatnonzero((place & 7 > 0) & (place < num))
        place = place[some]
        at, bit = begins[some] + (place >> 3), (step[some] & ALL).view(np.uint64)
        flat[at] ^= _FROM[place & 7] * bit
    return np.ascontiguousarray(words.view(np.uint8)[:, :num])


def _words(first: NDArray[np.uint8], steps: list[Indices], number: int) -> NDArray[np.uint64]:
    """The same in words of eight equal masks, in which a step is that of the next whole one."""
    rows = [step + (7 << len(CONDITIONS)) for step in steps]
    for last in range(1, len(rows)):
        for k in range(last, 0, -1):
            a, b = rows[k - 1], rows[k]
            rows[k - 1], rows[k] = np.minimum(a, b), np.maximum(a, b)
    values = np.empty((len(first), len(rows) + 1), np.uint64)
    counts = np.empty(values.shape, np.intp)
    values[:, 0], begin = first, np.zeros(len(first), np.intp)
    for k, step in enumerate(rows):
        end = np.minimum(step >> len(CONDITIONS) + 3, number)
        np.subtract(end, begin, out=counts[:, k])
        np.bitwise_xor(values[:, k], (step & ALL).view(np.uint64), out=values[:, k + 1])
        begin = end
    np.subtract(number, begin, out=counts[:, -1])
    values *= _FROM[0]
    return np.repeat(values.ravel(), counts.ravel()).reshape(-1, number)
