"""table → the speeds at which the six conditions (2.2) change their signs, each with a bound on its error."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.certain import Zeros, square_roots, zero_of_linear, zeros_of, zeros_of_quadratic
from bikestab.model import ExactTable, Floats
from bikestab.polynomials import Polynomial
from bikestab.rounding import ENTRY
from bikestab.routh import CONDITIONS, Rows, hurwitz3_of
from bikestab.twofold import Twofold

_CHUNK = 1 << 13  # cells worked on at a time, so that their temporaries fit the cache
_MODERATE = 60  # binary exponents of entries whose products by three and four stay in range
_EVEN = ((4, 0), (3, 1), (2, 0), (2, 2), (1, 1), (1, 3), (0, 0), (0, 2))  # entries without damping
_DAMPED = (*_EVEN, (3, 0), (1, 0))


class Critical(NamedTuple):
    """Where each condition is zero, and its sign before: by the conditions' names.

    ``speeds`` [m/s], shape (root, *shape), are the positive speeds at which it changes its sign,
    ascending, NaN behind the last; ``sign`` (*shape) is that just above V = 0: −1, 1, or 0 if it is
    zero at every speed. ``zeros`` are the speeds with what double precision leaves of them, with bounds, and
    whether there are no others.
    """

    speeds: dict[str, Floats]
    sign: dict[str, Floats]
    zeros: dict[str, Zeros]


def critical(table: Floats | ExactTable, names: Sequence[str] = CONDITIONS) -> Critical:
    """The critical speeds and the signs before them of a table (5, 4, *shape).

    Without damping all are square roots of the zeros of linear and quadratic polynomials in V²; with
    damping those of p1 and hurwitz3 are isolated first. A cell's result does not depend on other cells.
    """
    exact = as_exact(table)
    shape = exact.shape[2:]
    cells = exact.reshape(5, 4, -1)
    number = cells.shape[-1]
    parts = [
        _critical_of(cells.cells(slice(start, start + _CHUNK)), names)
        for start in range(0, max(number, 1), _CHUNK)
    ]
    speeds, sign, zeros = {}, {}, {}
    for name in names:
        found = [part[name][0] for part in parts]
        most = max(int(np.isfinite(each.V).any(axis=1).sum()) for each in found)
        columns = [
            np.concatenate([_rows(values, most) for values in each], axis=1).reshape(most, *shape)
            for each in zip(*((z.V, z.rest, z.radius) for z in found), strict=True)
        ]
        sure = np.concatenate([each.sure for each in found])
        zeros[name] = Zeros(columns[0], columns[1], columns[2], sure.reshape(shape))
        speeds[name] = zeros[name].V
        sign[name] = np.concatenate([part[name][1] for part in parts]).reshape(shape)
    return Critical(speeds, sign, zeros)


def as_exact(table: Floats | ExactTable) -> ExactTable:
    """A table of doubles as what it is: exactly these."""
    if isinstance(table, ExactTable):
        return table
    return ExactTable(table, np.zeros_like(table), np.abs(table) * ENTRY)


def _critical_of(table: ExactTable, names: Sequence[str]) -> dict[str, tuple[Zeros, Floats]]:
    """For each name the zeros (root, cell) of a table (5, 4, cell), and the sign before them."""
    number = table.shape[-1]
    has = table.error > 0
    others = has.copy()
    for k, j in _EVEN:
        others[k, j] = False
    uneven: NDArray[np.bool_] = np.asarray(others.any(axis=(0, 1)))
    for k, j in ((3, 0), (1, 0)):
        others[k, j] = False
    odd: NDArray[np.bool_] = np.asarray(others.any(axis=(0, 1)))
    groups = ((_even, ~uneven), (_damped, uneven & ~odd), (_any, odd))
    found: dict[str, list[tuple[NDArray[np.bool_], Zeros, Floats]]] = {name: [] for name in names}
    for solve, chosen in groups:
        if chosen.any():
            part = table if chosen.all() else table.cells(chosen)
            rows, unit = _scaled(part, solve is _even)
            for name in names:
                zeros, polynomial = solve(rows, name, len(unit))
                found[name].append((chosen, zeros.scaled(unit), _sign_near_zero(polynomial, len(unit))))
    return {name: _together(each, number) for name, each in found.items()}


def _scaled(table: ExactTable, closed: bool) -> tuple[Rows, Floats]:
    """The entries in units of speed, time and size that bring p4, q0 and k near one, and the unit of speed.

    The units are powers of two, so that no bit changes: they keep products in range. In ``closed`` forms,
    where intervals to be cut do not depend on them, entries that are in range already stay as they are.
    """
    exponent = np.frexp(table.value)[1]
    if closed and np.abs(exponent).max(initial=0) < _MODERATE:
        rows = [
            [Twofold(table.value[i, j], table.rest[i, j], table.error[i, j] / ENTRY) for j in range(4)]
            for i in range(5)
        ]
        return rows, np.ones(table.shape[-1])
    p4, k, q0 = (np.clip(exponent[index], -300, 300) for index in ((4, 0), (3, 1), (2, 0)))
    time = (q0 - p4) // 2
    speed = np.clip(p4 + time - k, -200, 200)
    nothing = Twofold(zero := np.zeros(len(p4)), zero, zero)
    rows = [[nothing] * 4 for _ in range(5)]
    for i, j in np.argwhere(table.error.any(axis=-1)).tolist():
        unit = np.ldexp(1.0, time * (i - 4) + speed * j - p4)
        value, rest, error = (each[i, j] * unit for each in table)
        rows[i][j] = Twofold(value, rest, error / ENTRY)
    return rows, np.ldexp(1.0, speed)


def _even(rows: Rows, name: str, number: int) -> tuple[Zeros, Polynomial]:
    """Without damping: p0, p2, p1/V and hurwitz3/V² in V²."""
    p0, p1, p2, p3, p4 = rows
    f0, f, e0, e, q0, q, k, m = p0[0], p0[2], p1[1], p1[3], p2[0], p2[2], p3[1], p4[0]
    if name == "hurwitz3":
        slow, fast = q0 * k - m * e0, q * k - m * e
        square = k * k
        w = [e0 * slow - f0 * square, e0 * fast + e * slow - f * square, e * fast]
        return square_roots(zeros_of_quadratic(*w)), list(w)
    a, b = {"p0": (f0, f), "p1": (e0, e), "p2": (q0, q)}.get(name, (None, None))
    if a is None or b is None:
        return _none(number), [k if name == "p3" else m]
    return square_roots(zero_of_linear(a, b)), [a, b]


def _damped(rows: Rows, name: str, number: int) -> tuple[Zeros, Polynomial]:
    """With damping p3 and p1 have both even and odd powers of V, and hurwitz3 is of degree 6."""
    if name in ("p0", "p2", "p4"):
        return _even(rows, name, number)
    _, p1, _, p3, _ = rows
    if name == "p3":
        return zero_of_linear(p3[0], p3[1]), [p3[0], p3[1]]
    polynomial: Polynomial = [p1[0], p1[1], None, p1[3]] if name == "p1" else hurwitz3_of(rows, _DAMPED)
    return zeros_of(polynomial, number), polynomial


def _any(rows: Rows, name: str, number: int) -> tuple[Zeros, Polynomial]:
    """Tables of other systems, with any powers of V."""
    polynomial: Polynomial = hurwitz3_of(rows) if name == "hurwitz3" else list(rows[CONDITIONS.index(name)])
    return zeros_of(polynomial, number), polynomial


def _sign_near_zero(polynomial: Polynomial, number: int) -> Floats:
    """The sign just right of zero."""
    sign = np.zeros(number)
    for a in polynomial:
        if a is not None:
            sign = np.where(sign == 0, np.sign(a.value), sign)
    return sign


def _none(number: int) -> Zeros:
    nothing = np.empty((0, number))
    return Zeros(nothing, nothing, nothing, np.ones(number, bool))


def _together(parts: list[tuple[NDArray[np.bool_], Zeros, Floats]], number: int) -> tuple[Zeros, Floats]:
    if len(parts) == 1:
        return parts[0][1:]
    most = max((len(zeros.V) for _, zeros, _ in parts), default=0)
    out, sure, sign = np.full((3, most, number), np.nan), np.ones(number, bool), np.zeros(number)
    for chosen, zeros, before in parts:
        for i in range(3):
            out[i, : len(zeros.V), chosen] = zeros[i].T
        sure[chosen], sign[chosen] = zeros.sure, before
    return Zeros(out[0], out[1], out[2], sure), sign


def _rows(values: Floats, most: int) -> Floats:
    """So many rows, filled up with NaN, or without some that are NaN."""
    missing = most - len(values)
    if missing <= 0:
        return values[:most]
    return np.concatenate([values, np.full((missing, values.shape[1]), np.nan)])
