"""(table, V) → the four eigenvalues as continuous branches with the names of their modes.

What happens along the speed axis is known exactly (``stretches``), so a branch at a speed depends on that
speed alone, and its name on where stability begins and ends (``modenames``).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.errors import InputError
from bikestab.model import ExactTable, Floats
from bikestab.modenames import names_of, rows_of
from bikestab.spectrum import eigenvalues_of
from bikestab.stretches import course, in_slots


class Modes(NamedTuple):
    """Eigenvalues at the speeds V [m/s] along four continuous branches, with their names.

    Rows 0 and 1 are weave, 2 is capsize and 3 castering at the highest speeds that have exactly one complex
    pair; ``names`` says for each point which of modenames.NAMES its motion has there. ``coalescences`` are
    all positive speeds at which two eigenvalues meet and go from real to complex or back, and ``meeting``
    the two rows that do; ``below`` and ``above`` are the names of all rows on either side.
    """

    V: Floats
    eigenvalues: NDArray[np.complex128]  # [s⁻¹], (4, n)
    names: NDArray[np.str_]  # (4, n)
    coalescences: Floats  # [m/s]
    meeting: tuple[tuple[int, int], ...]
    below: tuple[tuple[str, ...], ...]
    above: tuple[tuple[str, ...], ...]


def follow(table: Floats | ExactTable, V: ArrayLike) -> Modes:
    """The eigenvalues of one table (5, 4) at speeds V ≥ 0 [m/s], shape (n,), in any order.

    Equal to ``spectrum.eigenvalues_of`` up to their order. Raises InputError for a negative speed and
    where p4 = 0, since an eigenvalue is then infinite.
    """
    V = np.atleast_1d(np.asarray(V, dtype=float))
    if np.any(V < 0) or not np.all(np.isfinite(V)):
        raise InputError("a speed is negative or not finite", key=("V",), hint="allowed: 0 and above")
    if (table.value if isinstance(table, ExactTable) else table)[4, 0] == 0:
        hint = "give the front part some inertia about the steering axis"
        raise InputError("the mass matrix is singular: p4 = 0, and an eigenvalue is infinite", hint=hint)
    if table.shape[1] > 4 and np.any(V == 0):
        raise InputError(
            "a gain in proportion to 1/V is infinite at rest", key=("V",), hint="allowed: above 0"
        )
    events, stretches, meeting = along = course(table)
    rows = rows_of(table, along)
    of_stretch = names_of(table, along, rows)

    values = eigenvalues_of(table, V)
    where = np.searchsorted(events, V)
    eigenvalues, names = np.empty_like(values), np.empty(values.shape, dtype="<U9")
    for i, stretch in enumerate(stretches):
        here = where == i
        at = [rows.index(branch) for branch in stretch.slots]
        eigenvalues[np.ix_(at, here)] = in_slots(values[:, here], stretch.real, stretch.tilt)
        names[:, here] = np.array(of_stretch[i])[:, np.newaxis]
    met = [(i, rows.index(a), rows.index(b)) for i, pairs in enumerate(meeting) for a, b in pairs]
    return Modes(
        V,
        eigenvalues,
        names,
        np.array([events[i] for i, _, _ in met]),
        tuple((a, b) for _, a, b in met),
        tuple(tuple(of_stretch[i]) for i, _, _ in met),
        tuple(tuple(of_stretch[i + 1]) for i, _, _ in met),
    )
