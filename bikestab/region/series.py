"""All zeros of many functions at once, each known at Chebyshev nodes on [−1, 1]."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from bikestab.model import Floats

NODES = 24
_NOISE = 1e-13  # of a function's largest value: what is not sure of it
_NEARLY_REAL = 1e-6  # a double zero may come as a pair of complex ones


def nodes() -> Floats:
    """Where the functions are needed, ascending."""
    return chebyshev.chebpts1(NODES)


def zeros(values: Floats) -> tuple[NDArray[np.intp], Floats]:
    """The zeros in [−1, 1] of functions (row, node), analytic there; which row each belongs to, and it.

    An analytic function on a short piece is a polynomial to rounding; its Chebyshev series' zeros are
    eigenvalues of the series' companion (colleague) matrix.
    """
    size = np.abs(values).max(axis=1, keepdims=True)
    usable = np.isfinite(size) & (size > 0)
    vander = chebyshev.chebvander(nodes(), NODES - 1)
    relative = np.where(usable, values, 0.0) / np.where(usable, size, 1.0)
    series: Floats = np.linalg.solve(vander, relative.T).T.astype(float)
    series[np.abs(series) < _NOISE] = 0
    degree = NODES - 1 - np.argmax(series[:, ::-1] != 0, axis=1)
    possible = series.any(axis=1)
    possible &= np.abs(series[:, 0]) <= np.abs(series[:, 1:]).sum(axis=1) * (1 + 1e-9)
    rows, found = [np.empty(0, np.intp)], [np.empty(0)]
    # np.unique would import numpy.ma, which takes longer than this
    for n in np.flatnonzero(np.bincount(degree[possible & (degree > 0)])):
        chosen = np.flatnonzero(possible & (degree == n))
        roots = np.asarray(np.linalg.eigvals(_companions(series[chosen, : n + 1])), dtype=complex)
        real = (np.abs(roots.imag) < _NEARLY_REAL) & (np.abs(roots.real) <= 1 + 1e-9)
        rows.append(chosen[np.nonzero(real)[0]])
        found.append(roots.real[real])
    return np.concatenate(rows), np.clip(np.concatenate(found), -1, 1)


def _companions(series: Floats) -> Floats:
    """The matrices (row, n, n) whose eigenvalues are the roots of Chebyshev series (row, n + 1)."""
    n = series.shape[1] - 1
    monic = np.zeros(n + 1)
    monic[-1] = 1
    out = np.repeat(chebyshev.chebcompanion(monic)[np.newaxis], len(series), axis=0)
    scale = np.full(n, np.sqrt(0.5))
    scale[0] = 1
    out[:, :, -1] -= series[:, :-1] / series[:, -1:] * (scale / scale[-1]) * (0.5 if n > 1 else 1)
    return out
