"""Positive zeros of many small polynomials in twice double precision, each with a bound on its error.

A polynomial is a list of coefficients of V^0, V^1, …, each a ``Twofold`` of shape (cell,) whose error is at
most COEFFICIENT times its size, or None where it is zero in all cells.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.enclosing import enclosed
from bikestab.isolation import Brackets, brackets
from bikestab.model import Floats
from bikestab.polynomials import Polynomial
from bikestab.roots import bracketed_root
from bikestab.rounding import COEFFICIENT, SLOPE
from bikestab.twofold import Twofold

_POOR = 2.0**-72  # relative error of a zero, far below that of a double, above which a better bound is tried


class Zeros(NamedTuple):
    """Where polynomials change their sign: V + rest, within ``radius`` of the truth; shape (root, cell).

    Ascending, NaN behind a cell's last. ``sure`` (cell,): there are so many, and no others.
    """

    V: Floats
    rest: Floats
    radius: Floats
    sure: NDArray[np.bool_]

    def scaled(self, unit: Floats) -> Zeros:
        """In another unit of speed, a power of two."""
        return Zeros(self.V * unit, self.rest * unit, self.radius * unit, self.sure)


def signs(a: Twofold) -> tuple[Floats, NDArray[np.bool_]]:
    """The signs of numbers, and whether they are certain; zero is where there are no terms."""
    return np.sign(a.value), (np.abs(a.value) > 2 * COEFFICIENT * a.size) | (a.size == 0)


def zero_of_linear(a: Twofold, b: Twofold) -> Zeros:
    """Of a + b x."""
    (sign_a, sure_a), (sign_b, sure_b) = signs(a), signs(b)
    exists = sign_a * sign_b < 0
    x = -_where(exists, a) / _where(exists, b)
    return _ascending([(exists, x, _share(a) + _share(b) + COEFFICIENT)], sure_a & sure_b)


def zeros_of_quadratic(c0: Twofold, c1: Twofold, c2: Twofold) -> Zeros:
    """Of c0 + c1 x + c2 x², without subtracting nearly equal numbers."""
    square = c1 * c1 - (c0 * c2).times(4.0)
    error = 4 * COEFFICIENT * square.size  # of the square
    real = square.value > 0
    root = _where(real, square).square_root()
    sign = np.where(c1.value < 0, -1.0, 1.0)
    q = (c1 + root * sign).times(-0.5)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (COEFFICIENT * c1.size + error / root.value) / np.abs(q.value)
    pair = []
    for a, b, own in ((q, c2, _share(c2)), (c0, q, _share(c0))):
        exists = real & (np.sign(a.value) * np.sign(b.value) > 0)
        x = _where(exists, a) / _where(exists, b)
        pair.append((exists, x, _nearer([c0, c1, c2], x, np.where(exists, share + own + COEFFICIENT, 0.0))))
    (s0, sure0), (s1, sure1), (s2, sure2) = signs(c0), signs(c1), signs(c2)
    # with ends of the same sign there are two zeros or none
    apart = (s0 * s2 < 0) | (np.abs(square.value) > error) | (sure1 & (s0 * s2 > 0) & (s1 * s2 >= 0))
    short = (s0 == 0) | (s2 == 0)
    return _ascending(pair, sure0 & sure2 & np.where(short, sure1, apart))


def square_roots(zeros: Zeros) -> Zeros:
    """The zeros of polynomials in V², from those in x = V²."""
    exists = np.isfinite(zeros.V)
    x = np.where(exists, zeros.V, 1.0)
    V = Twofold(x, np.where(exists, zeros.rest, 0.0)).square_root()
    radius = zeros.radius / x * V.value + COEFFICIENT * V.value
    V_, rest, radius = (np.where(exists, each, np.nan) for each in (V.value, V.rest, radius))
    return Zeros(V_, rest, radius, zeros.sure)


def zeros_of(
    polynomial: Polynomial,
    number: int,
    error: float = COEFFICIENT,
    found: tuple[Brackets, NDArray[np.bool_]] | None = None,
) -> Zeros:
    """Of any polynomials in ``number`` cells: isolated by the signs of their Bernstein coefficients.

    Between two doubles that are neighbours at most one zero is found; then, and where a sign is not certain,
    the cell is not ``sure``. A coefficient's ``error`` is relative to its size. Brackets that are ``found``
    already are taken as they are.
    """
    (cell, low, high, sign), sure = found or brackets(polynomial, number, error)
    c = [None if a is None else a.at(cell) for a in polynomial]
    plain = np.array([np.zeros(len(cell)) if a is None else a.value for a in c])
    start = bracketed_root(plain, low, high, sign)
    x, radius, simple = _polished(c, plain, start, error)
    sure = sure.copy()
    poor = np.flatnonzero(~simple & sure[cell])
    if len(poor):
        some = [None if a is None else a.at(poor) for a in c]
        x.value[poor], radius[poor], good = enclosed(some, low[poor], high[poor], sign[poor], error)
        x.rest[poor] = 0.0
        radius[poor[~good]], sure[cell[poor[~good]]] = np.inf, False
    V, rest, radius = collected(cell, np.array([x.value, x.rest, radius]), number)
    for i in range(1, len(V)):
        gap = (V[i] - V[i - 1]) + (rest[i] - rest[i - 1])
        sure &= ~(gap <= radius[i] + radius[i - 1])
    return Zeros(V, rest, radius, sure)


def collected(cell: NDArray[np.intp], found: Floats, number: int) -> Floats:
    """Rows (row, root) of zeros and of what belongs to them, by their cells: (row, rank, cell).

    The zeros, in the first row, and then those in the second one ascend; NaN behind a cell's last.
    """
    count = np.bincount(cell, minlength=number)
    order = np.argsort(cell.astype(np.uint16 if number < 1 << 16 else np.intp), kind="stable")
    cell = cell[order]
    nth = np.arange(len(cell)) - (np.cumsum(count) - count)[cell]
    out = np.full((len(found), int(count.max(initial=0)), number), np.nan)
    out[:, nth, cell] = found[:, order]
    ascending(*out)
    return out


def ascending(V: Floats, *others: NDArray[Any]) -> None:
    """Put the few rows (root, cell) of V, and others with them, into their order in place; NaN last.

    Equal V are in the order of the next rows. numpy sorts each column by itself, which takes ten times as
    long.
    """
    for last in range(len(V) - 1, 0, -1):
        for i in range(last):
            wrong = V[i] > V[i + 1]
            for rest in others[:1]:
                wrong |= (V[i] == V[i + 1]) & (rest[i] > rest[i + 1])
            cells = np.flatnonzero(wrong)
            if len(cells):
                for values in (V, *others):
                    values[i, cells], values[i + 1, cells] = values[i + 1, cells], values[i, cells]


def _polished(
    c: Polynomial, plain: Floats, start: Floats, error: float
) -> tuple[Twofold, Floats, NDArray[np.bool_]]:
    """Zeros near ``start`` (root,), bounds on their errors, and whether each is a simple one."""
    x = Twofold(start, np.zeros_like(start))
    radius, simple = np.full(len(start), np.inf), np.zeros(len(start), bool)
    todo = np.arange(len(start))
    for step in range(12):
        if not len(todo):
            break
        here = x.at(todo)
        f, slope, slope_error, bend = _values(
            [None if a is None else a.at(todo) for a in c], here, step > 1, error
        )
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            move = -f / Twofold(slope)
        far, certain = _distance(here, f, slope, slope_error, bend, error)
        radius[todo], simple[todo] = np.where(certain, far, np.inf), certain
        good = certain & (far <= 2.0**-70 * here.value) & (step > 0)
        # a zero that is as good as its terms allow moves no more
        good |= certain & (np.abs(f.value) <= 8 * error * f.size)
        moved = here + move
        usable = ~good & np.isfinite(moved.value) & (moved.value > 0)
        todo = todo[usable]
        x.value[todo], x.rest[todo] = moved.value[usable], moved.rest[usable]
    return x, radius, simple


def _nearer(c: Polynomial, x: Twofold, share: Floats) -> Floats:
    """The relative error of a zero, or a smaller bound that the value and slope there prove.

    The error of a discriminant's root is that of products of coefficients, the value's that of one.
    """
    poor = np.flatnonzero(share > _POOR)
    if not len(poor):
        return share
    here, share = Twofold(x.value[poor], x.rest[poor]), share.copy()
    far, certain = _distance(here, *_values([None if a is None else a.at(poor) for a in c], here, fine=False))
    with np.errstate(divide="ignore", invalid="ignore"):
        share[poor] = np.where(certain, np.fmin(far / np.abs(here.value), share[poor]), share[poor])
    return share


def _distance(
    x: Twofold, f: Twofold, slope: Floats, slope_error: Floats, bend: Floats, error: float = COEFFICIENT
) -> tuple[Floats, NDArray[np.bool_]]:
    """How far a zero is at most, and where that is certain: there the slope changes by little."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        far = 1.25 * (np.abs(f.value) + error * f.size) / np.abs(slope)
        return far, (np.abs(slope) > 16 * (slope_error + far * bend)) & (far <= np.abs(x.value) / 16)


def _values(
    c: Polynomial, x: Twofold, fine: bool, error: float = COEFFICIENT
) -> tuple[Twofold, Floats, Floats, Floats]:
    """Value and slope at x, a bound on the slope's error, and one on the second derivative near x."""
    zero = Twofold(np.zeros_like(x.value))
    f = slope = zero
    plain, size, bend = (np.zeros_like(x.value) for _ in range(3))
    for a in c[::-1]:
        if fine:
            slope = slope * x + f
        plain = plain * x.value + f.value
        bend = bend * x.value + 2 * size
        size = size * x.value + f.size
        f = f * x if a is None else f * x + a
    if fine:
        return f, slope.value, 2 * error * slope.size, 2 * bend
    return f, plain, SLOPE * size, 2 * bend


def _where(chosen: NDArray[np.bool_], a: Twofold) -> Twofold:
    """The number where chosen, else 1, to compute with."""
    return Twofold(np.where(chosen, a.value, 1.0), np.where(chosen, a.rest, 0.0), a.size)


def _share(a: Twofold) -> Floats:
    """A bound on the relative error."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return 2 * COEFFICIENT * a.size / np.abs(a.value)


def _ascending(found: list[tuple[NDArray[np.bool_], Twofold, Floats]], sure: NDArray[np.bool_]) -> Zeros:
    """One or two zeros of each cell in their order, by whether they exist, value and relative error."""
    rows = []
    for exists, x, share in found:
        radius = 2 * share * np.abs(x.value)
        rows.append([np.where(exists, each, np.nan) for each in (x.value, x.rest, radius)])
    if len(rows) == 2:
        first, second = rows
        with np.errstate(invalid="ignore"):
            less = (second[0] - first[0]) + (second[1] - first[1]) < 0
        swap = less | np.isnan(first[0])
        rows = [
            [np.where(swap, b, a) for a, b in zip(first, second, strict=True)],
            [np.where(swap, a, b) for a, b in zip(first, second, strict=True)],
        ]
    V, rest, radius = (np.array(each) for each in zip(*rows, strict=True))
    return Zeros(V, rest, radius, sure)
