"""Intervals that hold one zero each → the zero between two doubles at which the polynomial's sign is certain.

For zeros that are so badly conditioned that no slope tells where they are: by halving, with values in twice
double precision.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.polynomials import Polynomial
from bikestab.twofold import Twofold

_FARTHEST = 2.0**150  # of which a polynomial of degree six is in range
_CUTS = 70  # eight to a factor of four, and one for each bit


def enclosed(
    polynomial: Polynomial, low: Floats, high: Floats, sign: Floats, error: float
) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Zeros (root,), bounds on their errors, and where both are certain.

    Each polynomial has exactly one zero in low … high, and its ``sign`` at the upper end. The error of a
    coefficient is relative to its size.
    """

    def beyond(V: Floats) -> NDArray[np.bool_]:
        """Whether V (3, root) are: perhaps, as computed, and certainly above the zeros."""
        x, f = Twofold(V), Twofold(np.zeros_like(V))
        for a in polynomial[::-1]:
            f = f * x if a is None else f * x + a
        return sign * f.value > doubt * f.size

    doubt = 2 * error * np.array([[-1.0], [0.0], [1.0]])
    low, high = np.maximum(low, 1 / _FARTHEST), np.minimum(high, _FARTHEST)
    a, b = np.array([low] * 3), np.array([high] * 3)
    for _ in range(_CUTS):
        x = np.where(b > 4 * a, np.sqrt(a) * np.sqrt(b), a + 0.5 * (b - a))
        above = beyond(x)
        a, b = np.where(above, a, x), np.where(above, x, b)
    below, V, above = a[0], b[1], b[2]
    radius = np.maximum(V - below, above - V)
    certain = ~beyond(a)[0] & beyond(b)[2] & (radius <= V / 16)
    return V, radius, certain
