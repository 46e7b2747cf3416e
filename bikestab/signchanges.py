"""What signs the coefficients of polynomials may have → how often they change, if that is certain."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

_TABULATED = 7  # coefficients whose signs are counted beforehand …
_FEW = 1 << 12  # … where there are more polynomials

_Flags = NDArray[np.bool_]
Changes = tuple[NDArray[Any], _Flags, NDArray[np.float64], NDArray[np.float64]]


def sign_changes(positive: _Flags, negative: _Flags) -> Changes:
    """How often the signs of each polynomial's coefficients change, if that is clear, and the outer signs.

    What ``positive`` and ``negative`` (power, polynomial) both hold for may be either; what neither holds
    for is zero. The outer signs are those of the first and last coefficients that have one for sure.
    """
    rows, number = positive.shape
    if rows > _TABULATED or number < _FEW:
        return _counted(positive, negative)
    code = np.zeros(number, np.uint16)
    for i in range(rows):
        code |= positive[i].astype(np.uint16) << np.uint16(2 * i)
        code |= negative[i].astype(np.uint16) << np.uint16(2 * i + 1)
    found = _all_counted(rows).take(code)
    changes, clear = found & 7, (found & 8) > 0
    return changes, clear, (found >> 4 & 3).astype(float) - 1, (found >> 6).astype(float) - 1


@cache
def _all_counted(rows: int) -> NDArray[np.uint8]:
    """``_counted`` of all states of so many coefficients, by their bits: changes, clear, signs + 1."""
    code = np.arange(4**rows)
    positive, negative = (code >> (2 * np.arange(rows)[:, np.newaxis] + bit) & 1 > 0 for bit in (0, 1))
    changes, clear, first, last = _counted(positive, negative)
    out: NDArray[np.int_] = changes | clear * 8 | (first + 1).astype(int) << 4 | (last + 1).astype(int) << 6
    return out.astype(np.uint8)


def _counted(positive: _Flags, negative: _Flags) -> Changes:
    """``sign_changes``, counted."""
    uncertain = positive & negative
    sign = np.subtract(positive, negative, dtype=float)
    changes = np.zeros(sign.shape[1], np.intp)
    before, after = np.zeros_like(sign), np.zeros_like(sign)
    for i in range(1, len(sign)):  # the nearest sign that is known
        before[i] = np.where(sign[i - 1] == 0, before[i - 1], sign[i - 1])
        changes += before[i] * sign[i] < 0
        after[-1 - i] = np.where(sign[-i] == 0, after[-i], sign[-i])
    # between different signs there is one change, whatever a single uncertain coefficient is
    alone = before * after < 0
    alone[1:] &= ~uncertain[:-1]
    clear = ~np.any(uncertain & ~alone, axis=0)
    first, last = np.where(sign[0] == 0, after[0], sign[0]), np.where(sign[-1] == 0, before[-1], sign[-1])
    return changes, clear, first, last
