"""A check of the exact critical speeds against the conditions (2.2) themselves.

``speeds`` finds them as roots of polynomials in V. Here the conditions are evaluated as they stand: on
both sides of every root, which brackets it, and at speeds of the grid, which finds roots that are missing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.critical import Critical
from bikestab.model import Floats
from bikestab.rounding import NO_SIGN
from bikestab.routh import CONDITIONS, condition, conditions, violated
from bikestab.scan.agreement import AGREEMENT, Agreement, by_rounding, size_of_terms
from bikestab.scan.signs import undecided

SAMPLE = 8  # speeds of the grid at which the signs are compared
_FAR = 1e-3  # m/s; a difference above is called infinite


def check(
    table: Floats, critical: Critical, mask: NDArray[np.uint8], V: Floats, above: float = 0.0
) -> Agreement:
    """Compare the critical speeds of a table (5, 4, cell) in above < V ≤ V[-1], and its mask (cell, V).

    A root is as uncertain as the rounding of the condition's terms divided by its slope; where that
    is more than AGREEMENT neither way can tell better. There the two may differ by what the rounding
    allows, or one of them may see two roots and the other none. Nor can they where it is undecided which
    roots there are: what differs in such cells is counted as ``touching``.
    """
    agreement = _signs(table, mask, V)
    open_ = undecided(critical)
    for name in CONDITIONS:
        speeds = critical.speeds[name]
        gap = np.full((len(speeds) + 1, table.shape[-1]), np.inf)
        gap[1:-1] = np.where(np.isnan(d := np.diff(speeds, axis=0)), np.inf, d)
        for root, room in zip(speeds, np.minimum(gap[1:], gap[:-1]), strict=True):
            root = np.where((root > above) & (root <= V[-1]), root, np.nan)
            agreement = agreement.combined(_zeros(table, name, np.where(open_, np.nan, root), room))
            if open_.any():
                of_open = _zeros(table[..., open_], name, root[open_], room[open_])
                agreement = agreement.combined(_tolerated(of_open))
    return agreement


def _tolerated(agreement: Agreement) -> Agreement:
    """The same without the differences, which are no errors."""
    if agreement.largest <= AGREEMENT:
        return agreement
    return agreement._replace(largest=0.0, touching=agreement.touching + agreement.roots)


def _zeros(table: Floats, name: str, root: Floats, room: Floats) -> Agreement:
    """Whether the condition changes its sign within AGREEMENT of each root (cell,); NaN = none."""
    number = int(np.count_nonzero(root > 0))
    if not number:
        return Agreement()
    step = np.fmin(AGREEMENT, 0.5 * np.minimum(root, room))
    below, above = (condition(table, name, root + side * step) for side in (-1, 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        between = np.sign(below) * np.sign(above) < 0
    step, below, above = (x[between] for x in (step, below, above))  # elsewhere they may be equal
    largest = float((step * np.abs((below + above) / (below - above))).max(initial=0))
    agreement = Agreement(number, largest)
    poor = np.flatnonzero((root > 0) & ~between)
    if not len(poor):
        return agreement
    return agreement.combined(_poor(table[..., poor], name, root[poor], room[poor]))


def _poor(table: Floats, name: str, root: Floats, room: Floats) -> Agreement:
    """What is the matter with roots where the condition has one sign on both sides."""
    moved, reach = by_rounding(table, name, root)
    sharp = moved < np.minimum(AGREEMENT, 0.5 * np.minimum(root, room))
    reach = np.where(sharp, _FAR, reach)
    difference = np.full(len(root), np.inf)
    step = np.minimum(AGREEMENT, 0.5 * root)
    while np.any(step < reach):
        step = np.minimum(2 * step, reach)
        below, above = (condition(table, name, root + side * step) for side in (-1, 1))
        zero = (np.sign(below) * np.sign(above) <= 0) & np.isinf(difference)
        difference[zero] = step[zero]
    value = condition(table, name, root)
    loose = ~sharp & np.isfinite(difference)
    touching = ~sharp & ~loose & (np.abs(value) <= NO_SIGN * size_of_terms(table, name, root))
    return Agreement(
        0,
        float(difference[~(loose | touching)].max(initial=0)),
        int(np.count_nonzero(loose)),
        float(difference[loose].max(initial=0)),
        int(np.count_nonzero(touching)),
    )


def _signs(table: Floats, mask: NDArray[np.uint8], V: Floats) -> Agreement:
    """Whether the conditions have the signs of the mask at SAMPLE speeds of the grid."""
    at = np.unique(np.linspace(0, len(V) - 1, SAMPLE).astype(int))
    cell, i = np.nonzero(violated(conditions(table[..., np.newaxis], V[at])) != mask[:, at])
    if not len(cell):
        return Agreement()
    table, V, mask = table[..., cell], V[at[i]], mask[cell, at[i]]
    values = conditions(table, V)
    other = violated(values) ^ mask
    wrong, touching = 0, 0
    for bit, name in enumerate(CONDITIONS):
        zero = np.abs(getattr(values, name)) <= NO_SIGN * size_of_terms(table, name, V)
        differs = (other >> bit) & 1 == 1
        wrong += int(np.count_nonzero(differs & ~zero))
        touching += int(np.count_nonzero(differs & zero))
    return Agreement(0, np.inf if wrong else 0.0, touching=touching)
