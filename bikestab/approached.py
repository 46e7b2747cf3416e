"""Polynomials in double precision → doubles near their positive zeros, where it is certain how many.

Where C was compiled it does the same operations in the same order, so that no bit depends on it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from bikestab.certain import collected
from bikestab.isolation import DEPTH, MANY, MIDDLES, NARROW, isolated, over_binomials
from bikestab.model import Floats
from bikestab.roots import bracketed_root
from bikestab.rounding import CUT
from bikestab.twofold import Double

_NEAR = 1e-7  # the last relative step to a zero
_POWERS = 4, 7  # of p1 and hurwitz3, which zeros.c is made for
_FEW = 200  # cells, for which the library need not be loaded

Coefficients = Sequence[Double | None]  # of V^0, V^1, …; None where it is zero in all cells


def zeros_near(c: Coefficients, number: int) -> tuple[Floats, NDArray[np.bool_]]:
    """Positive zeros (rank, cell) of polynomials in ``number`` cells, and the cells that are undecided.

    Ascending, NaN behind a cell's last.
    """
    found = _by_kernel(c, number) if number > _FEW and len(c) in _POWERS else None
    if found is not None:
        return found
    (cell, low, high, sign), undecided = isolated(c, number)
    start = bracketed_root(_plain(c, number)[:, cell], low, high, sign, _NEAR)
    return collected(cell, start[np.newaxis], number)[0], undecided


def _by_kernel(c: Coefficients, number: int) -> tuple[Floats, NDArray[np.bool_]] | None:
    """``zeros_near`` by the compiled library; None where it is not there."""
    from bikestab import kernels  # what it imports takes as long as some hundred cells

    if (library := kernels.library()) is None:
        return None
    plain, (values, sizes) = _plain(c, number), over_binomials(c, number)
    limits = np.array([MIDDLES[0], CUT, NARROW[0], _NEAR, MANY, DEPTH], dtype=float)
    V, undecided = np.empty((len(c), number)), np.empty(number, bool)
    arrays = map(kernels.address, (plain, values, sizes, limits, V, undecided))
    return V[: library.zeros_near(len(c), number, *arrays)], undecided


def _plain(c: Coefficients, number: int) -> Floats:
    return np.array([np.zeros(number) if a is None else a.value for a in c])
