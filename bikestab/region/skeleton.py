"""The curves in a plane of designs where stable intervals appear, vanish or lose an end.

Between these curves the number of a design's stable intervals and the kinds of their ends do not change,
so they say exactly which designs have a stable speed, or one without upper limit. Each curve is
the zero of a function of the table: a discriminant, a resultant or a single coefficient.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple, get_args

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike, NDArray

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.polynomials import derivative, product, settled, total, trimmed
from bikestab.routh import condition_polynomials
from bikestab.speeds import intervals_of

CurveName = Literal[
    "fold", "crossing", "meet", "slow meet", "capsize at infinity", "weave at infinity",
    "capsize at rest", "weave at rest", "singular inertia",
]  # fmt: skip
_UNIT = 5.0  # m/s: roots of about one keep the determinants in range
_PIECE, _NODES = 0.05, 24  # longest Chebyshev piece of a line, and its nodes
_PIECES = 12, 4000  # least and largest number of pieces: lines longer than 200 are followed less closely
_NOISE = 1e-13  # of a function's largest value on a piece: what its determinant is not sure of
_NEARLY_REAL = 1e-6  # of half a piece: a double zero may come as a pair of complex ones


class Skeleton(NamedTuple):
    """The conditions as polynomials in x = V² (or V where damping mixes the powers), lowest power first.

    ``power`` is 2 or 1. Powers that no cell has are stripped from both ends of each.
    """

    polynomials: dict[str, Floats]
    power: int


def reduced(table: Floats) -> Skeleton:
    """The conditions of a table (5, 4, *shape), and q = p2 p3 − p4 p1: at p0 = 0 hurwitz3 is p1 q."""
    found = condition_polynomials(table)
    first, second = product(table[2], table[3]), product(table[4], table[1])
    found["q"] = settled(total(first, -second), total(np.abs(first), np.abs(second)))
    short = {name: trimmed(poly) for name, poly in found.items()}
    odd = any(poly[1::2].any() for poly in short.values())
    return Skeleton({name: poly if odd else poly[::2] for name, poly in short.items()}, 1 if odd else 2)


def curve_functions(
    table: Floats, names: Sequence[CurveName] = get_args(CurveName)
) -> dict[CurveName, Floats]:
    """Functions of shape (*shape) whose zeros are the curves, for a table (5, 4, *shape).

    - fold: hurwitz3 has a double root in V; its discriminant;
    - crossing: p1 and p3 have a common root, where the weave surface crosses itself, a fold as well;
    - meet: p0 and q have a common root, where weave (with a frequency) meets capsize; their resultant;
    - slow meet: the same at zero frequency, where p0 and p1 have a common root;
    - … at infinity, at rest: the highest or lowest coefficient of p0 or hurwitz3;
    - singular inertia: p4 = 0, where an eigenvalue is infinite.
    """
    polynomials, _ = reduced(table)
    p0, p1, p3, weave, q = (polynomials[name] for name in ("p0", "p1", "p3", "hurwitz3", "q"))
    functions: dict[CurveName, Callable[[], Floats]] = {
        "fold": lambda: _discriminant(weave),
        "crossing": lambda: p3[0] if len(p3) == 1 else _resultant(p1, p3),
        "meet": lambda: _resultant(q, p0),
        "slow meet": lambda: _resultant(p1, p0),
        "capsize at infinity": lambda: p0[-1],
        "weave at infinity": lambda: weave[-1],
        "capsize at rest": lambda: p0[0],
        "weave at rest": lambda: weave[0],
        "singular inertia": lambda: table[4, 0],
    }
    return {name: functions[name]() for name in names}


class Line(NamedTuple):
    """Parallel lines in the plane of a family: x or y is None and runs, the other has shape (line,)."""

    family: Family
    x: ArrayLike | None
    y: ArrayLike | None

    @property
    def fixed(self) -> Floats:
        """The values (line,) of the one that does not run."""
        return np.array(self.y if self.x is None else self.x, dtype=float).reshape(-1)

    def table(self, values: Floats) -> Floats:
        """The table (5, 4, line, …) at values (line, …) of the running parameter."""
        fixed = self.fixed.reshape(-1, *(1,) * (values.ndim - 1))
        return self.family.table(*((values, fixed) if self.x is None else (fixed, values)))


def stable_ranges(
    family: Family,
    low: float,
    high: float,
    *,
    x: ArrayLike | None = None,
    y: ArrayLike | None = None,
) -> list[list[tuple[float, float]]]:
    """For each line the ranges of the other parameter, within low … high, with a stable speed.

    Give ``x`` for ranges of y, or ``y`` for ranges of x. The ends are zeros of the curve
    functions, right to rounding (to about 1e-10 where two nearly touch), or low and high themselves; the
    region is not sampled.
    """
    line = Line(family, x, y)
    cuts = crossings(line, low, high)
    found = []
    has = intervals_of(line.table(0.5 * (cuts[:, 1:] + cuts[:, :-1]))).number > 0
    has &= cuts[:, 1:] > cuts[:, :-1]
    for ends, good in zip(cuts, has, strict=True):
        ranges: list[tuple[float, float]] = []
        for i in np.flatnonzero(good):
            start, stop = float(ends[i]), float(ends[i + 1])
            if ranges and ranges[-1][1] == start:
                start = ranges.pop()[0]
            ranges.append((start, stop))
        found.append(ranges)
    return found


def lowest_stable(
    family: Family, low: float, high: float, *, x: ArrayLike | None = None, y: ArrayLike | None = None
) -> Floats:
    """For each line the smallest value from low to high with any stable speed; NaN where there is none."""
    ranges = stable_ranges(family, low, high, x=x, y=y)
    lowest = np.array([of[0][0] if of else np.nan for of in ranges])
    return lowest.reshape(np.asarray(y if x is None else x).shape)


def crossings(line: Line, low: float, high: float) -> Floats:
    """Where lines cross or touch any of the curves: (line, number), ascending from low to high inclusive.

    Lines with fewer crossings than others repeat ``high``. The curve functions are analytic along a
    line, so on short pieces they are polynomials to rounding, all of whose zeros are eigenvalues.
    """
    ends = np.linspace(low, high, int(np.clip(np.ceil((high - low) / _PIECE), *_PIECES)) + 1)
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * (ends[1:] - ends[:-1])
    nodes = middle[:, np.newaxis] + half[:, np.newaxis] * chebyshev.chebpts1(_NODES)
    lines = len(line.fixed)
    values = np.array(_along(line, np.broadcast_to(nodes, (lines, *nodes.shape))))
    curve, row, piece, x = _zeros(values)
    rough = middle[piece] + half[piece] * x  # kept as well: of two close zeros both may move to one
    found = np.concatenate([rough, _polished(line, curve, row, rough, float(half[0]))])
    row = np.concatenate([row, row])
    order = np.lexsort((found, row))
    row, found = row[order], np.clip(found[order], low, high)
    count = np.bincount(row, minlength=lines)
    cuts = np.full((lines, int(count.max(initial=0)) + 2), float(high))
    cuts[:, 0] = low
    cuts[row, 1 + np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)] = found
    return cuts


def _along(line: Line, values: Floats) -> tuple[Floats, ...]:
    return tuple(curve_functions(line.table(values)).values())


def _zeros(values: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp], Floats]:
    """Zeros in [−1, 1] of functions given at Chebyshev nodes, last axis; where among (curve, line, piece)."""
    size = np.abs(values).max(axis=-1, keepdims=True)
    nodes = chebyshev.chebvander(chebyshev.chebpts1(_NODES), _NODES - 1)
    relative = np.moveaxis(values / np.where(size > 0, size, 1), -1, 0).reshape(_NODES, -1)
    series: Floats = np.linalg.solve(nodes, relative).T.astype(float)
    series[np.abs(series) < _NOISE] = 0
    degree = _NODES - 1 - np.argmax(series[:, ::-1] != 0, axis=1)
    possible = np.abs(series[:, 0]) <= np.abs(series[:, 1:]).sum(axis=1) * (1 + 1e-9)
    rows, zeros = [np.empty(0, np.intp)], [np.empty(0)]
    # np.unique would import numpy.ma, which takes longer than this
    for n in np.flatnonzero(np.bincount(degree[possible & (degree > 0)])):
        chosen = np.flatnonzero(possible & (degree == n))
        roots = np.asarray(np.linalg.eigvals(_companions(series[chosen, : n + 1])), dtype=complex)
        real = (np.abs(roots.imag) < _NEARLY_REAL) & (np.abs(roots.real) <= 1 + 1e-9)
        rows.append(chosen[np.nonzero(real)[0]])
        zeros.append(roots.real[real])
    where = np.unravel_index(np.concatenate(rows), values.shape[:-1])
    return where[0], where[1], where[2], np.clip(np.concatenate(zeros), -1, 1)


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


def _polished(line: Line, curve: NDArray[np.intp], row: NDArray[np.intp], x: Floats, half: float) -> Floats:
    """Zeros on the lines moved to those of the functions themselves, where these are simple."""
    if not len(x):
        return x
    fixed = line.fixed[row]
    lines = line._replace(x=fixed) if line.y is None else line._replace(y=fixed)
    each = np.arange(len(x))
    for step in np.array([1e-4, 1e-5, 1e-6, 1e-6]) * half:
        around = x[:, np.newaxis] + step * np.array([-1.0, 0.0, 1.0])
        below, here, above = np.array(_along(lines, around))[curve, each].T
        with np.errstate(divide="ignore", invalid="ignore"):
            move = 2 * step * here / (above - below)
        x = np.where(np.abs(move) < 10 * step, x - move, x)
    return x


def _discriminant(f: Floats) -> Floats:
    """Resultant of a polynomial and its slope, divided by the highest coefficient."""
    n = len(f) - 1
    if n < 2:
        return np.ones(f.shape[1:])
    matrix = _sylvester(f, derivative(f))
    matrix[..., n - 2, -1], matrix[..., -1, -1] = 1, n / _UNIT  # that coefficient out of the last column
    return np.linalg.det(matrix)


def _resultant(f: Floats, g: Floats) -> Floats:
    matrix = _sylvester(f, g)
    return np.linalg.det(matrix) if matrix.shape[-1] else np.ones(f.shape[1:])


def _sylvester(f: Floats, g: Floats) -> Floats:
    """The Sylvester matrix of two polynomials (coefficients along the first axis), in units of _UNIT."""
    m, n = len(f) - 1, len(g) - 1
    matrix = np.zeros((*f.shape[1:], m + n, m + n))
    for count, poly, offset in ((n, f, 0), (m, g, n)):
        scaled = [c * _UNIT**j for j, c in enumerate(poly)]
        for i in range(count):
            for j, c in enumerate(scaled):
                matrix[..., offset + i, i + j] = c
    return matrix
