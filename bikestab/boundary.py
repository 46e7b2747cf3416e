"""The boundary surfaces of (2.2) over (λ, σ), refined from sign changes on the grid.

A second way to the critical speeds, independent of the polynomials in ``speeds``: the conditions
themselves are evaluated at the grid's speeds, and each sign change is refined by scipy.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import elementwise

from bikestab.errors import ScanError
from bikestab.model import Floats
from bikestab.routh import CONDITIONS, condition_polynomials, conditions
from bikestab.speeds import CAPSIZE, WEAVE, Intervals

AGREEMENT = 1e-10  # m/s, between this way and the exact one


class Brackets(NamedTuple):
    """Sign changes of one condition: in which cell, and between which two speeds [m/s]."""

    cell: NDArray[np.intp]
    low: Floats
    high: Floats


class Surface(NamedTuple):
    """Refined roots of one condition, shape (cell, root), NaN where there is none; which are edges."""

    V: Floats
    edge: NDArray[np.uint8]


class Agreement(NamedTuple):
    """How far the refined roots are from the exact speeds.

    ``largest`` [m/s] is over the roots that double precision fixes to AGREEMENT; of the ``loose``
    others, close to a fold, ``largest_loose`` is the same.
    """

    roots: int = 0
    largest: float = 0.0
    loose: int = 0
    largest_loose: float = 0.0

    def joined(self, other: Agreement) -> Agreement:
        return Agreement(
            self.roots + other.roots,
            max(self.largest, other.largest),
            self.loose + other.loose,
            max(self.largest_loose, other.largest_loose),
        )


def sign_changes(mask: NDArray[np.uint8], V: Floats) -> dict[str, Brackets]:
    """Where each bit of ``violated``, shape (cell, len(V)), changes from one speed to the next."""
    change = mask[:, 1:] ^ mask[:, :-1]
    found = {}
    for bit, name in enumerate(CONDITIONS):
        cell, i = np.nonzero(change & (1 << bit))
        found[name] = Brackets(cell, V[i], V[i + 1])
    return found


def refine(table: Floats, name: str, brackets: Brackets) -> Brackets:
    """The roots in the brackets as ``low`` = ``high``; those at V = 0 are dropped.

    ``table`` has shape (5, 4, cell). Raises ScanError if a root is not found.
    """

    def value(V: Floats, *entries: Floats) -> Floats:
        return getattr(conditions(np.array(entries).reshape(5, 4, -1), V), name)

    cell, low, high = brackets
    entries = tuple(table[..., cell].reshape(20, -1))
    if len(cell):  # at rest every odd coefficient is zero, which is no crossing of the surface
        at_rest = (low == 0) & (value(low, *entries) == 0)
        cell, low, high = cell[~at_rest], low[~at_rest], high[~at_rest]
        entries = tuple(table[..., cell].reshape(20, -1))
    if not len(cell):
        return Brackets(cell, low, high)
    found = elementwise.find_root(
        value, (low, high), args=entries, tolerances={"xrtol": 1e-15, "xatol": 1e-15}
    )
    if not found.success.all():
        worst = int(np.argmin(found.success))
        raise ScanError(
            f"{name}: {np.count_nonzero(~found.success)} of {len(cell)} sign changes could not be refined, "
            f"the first between {low[worst]:.9g} and {high[worst]:.9g} m/s (status {found.status[worst]})"
        )
    return Brackets(cell, found.x, found.x)


def surface(name: str, roots: Brackets, cells: int, intervals: Intervals) -> Surface:
    """The refined roots by cell, ascending, and which of them are an end of a stable interval."""
    order = np.lexsort((roots.low, roots.cell))
    cell, V = roots.cell[order], roots.low[order]
    count = np.bincount(cell, minlength=cells)
    rank = np.arange(len(cell)) - np.repeat(np.cumsum(count) - count, count)
    out = np.full((cells, int(count.max(initial=0))), np.nan)
    out[cell, rank] = V
    kind = {"p0": CAPSIZE, "hurwitz3": WEAVE}.get(name)
    edge = np.zeros(out.shape, bool)
    for ends, kinds in ((intervals.V1, intervals.lower), (intervals.V2, intervals.upper)):
        for k in range(ends.shape[1]):
            close = np.abs(out - ends[:, k : k + 1]) <= 1e-7 * out
            edge |= close & (kinds[:, k : k + 1] == kind)
    return Surface(out, edge.astype(np.uint8))


def agreement(table: Floats, name: str, roots: Brackets, exact: Floats) -> Agreement:
    """Compare refined roots with the exact speeds (root, cell) of the same condition.

    A root is as uncertain as the rounding of the condition's terms divided by its slope; where that
    is more than AGREEMENT neither way can tell better.
    """
    cell, V, _ = roots
    if not len(cell):
        return Agreement()
    padded = np.concatenate([exact[:, cell], np.full((1, len(cell)), np.inf)])
    difference = np.nanmin(np.abs(padded - V), axis=0)
    polynomial = condition_polynomials(table[..., cell])[name]
    slope = sum(j * c * V ** (j - 1) for j, c in enumerate(polynomial) if j)
    a = conditions(np.abs(table[..., cell]), V)
    size = getattr(a, name) if name != "hurwitz3" else a.p1 * (a.p2 * a.p3 + a.p4 * a.p1) + a.p0 * a.p3**2
    with np.errstate(divide="ignore", invalid="ignore"):
        loose = ~(16 * np.finfo(float).eps * size / np.abs(slope) < AGREEMENT)
    return Agreement(
        len(cell),
        float(difference[~loose].max(initial=0)),
        int(np.count_nonzero(loose)),
        float(difference[loose].max(initial=0)),
    )
