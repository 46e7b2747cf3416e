"""table → the speeds at which the six conditions (2.2) change their signs, each with a bound on its error."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from bikestab import certain
from bikestab.certain import Zeros, square_roots, zero_of_linear, zeros_of
from bikestab.corrected import (
    Condition,
    hurwitz3_at,
    hurwitz3_near,
    p1_at,
    p1_near,
    rough_zeros_of_quadratic,
    zero_of_even,
    zeros_between,
    zeros_of_quadratic,
)
from bikestab.entries import DAMPED, EVEN, Cells, Entries, cells_of, scaled
from bikestab.isolation import guessed
from bikestab.model import ExactTable, Floats
from bikestab.polynomials import of_squares
from bikestab.rounding import CANCELLED
from bikestab.routh import CONDITIONS, hurwitz3_of, without_noise
from bikestab.twofold import Double, Twofold

T = TypeVar("T", Twofold, Double)

Found = tuple[Zeros, Floats]  # of one condition in some cells: its zeros, and its sign before them
_CHUNK = 1 << 13  # cells worked on at a time, so that their temporaries fit the cache


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


def critical(table: Floats | ExactTable, names: Sequence[str] = CONDITIONS, rough: bool = False) -> Critical:
    """The critical speeds and the signs before them of a table (5, 4, *shape).

    Without damping all are square roots of the zeros of linear and quadratic polynomials in V²; with
    damping those of p1 and hurwitz3 are isolated first. A cell's result does not depend on other cells.
    Without damping ``rough`` speeds are as double precision gives them, where it is sure of their number.
    """
    shape = table.shape[2:]
    cells = cells_of(table)
    number = cells.value.shape[-1]
    places = [slice(start, start + _CHUNK) for start in range(0, max(number, 1), _CHUNK)]
    parts = [_critical_of(cells.some(place), names, rough) for place in places]
    speeds, sign, zeros = {}, {}, {}
    for name in names:
        found = [part[name][0] for part in parts]
        most = max(int(np.isfinite(each.V).any(axis=1).sum()) for each in found)
        columns = [
            _joined([_rows_of(values, most) for values in each]).reshape(most, *shape)
            for each in zip(*((z.V, z.rest, z.radius) for z in found), strict=True)
        ]
        sure = _joined([each.sure for each in found])
        zeros[name] = Zeros(columns[0], columns[1], columns[2], sure.reshape(shape))
        speeds[name] = zeros[name].V
        sign[name] = _joined([part[name][1] for part in parts]).reshape(shape)
    return Critical(speeds, sign, zeros)


def _critical_of(table: Cells, names: Sequence[str], rough: bool) -> dict[str, Found]:
    """For each name the zeros (root, cell) of a table (5, 4, cell), and the sign before them."""
    number = table.value.shape[-1]
    damped, odd = np.zeros((2, number), bool)
    keys = [*np.ndindex(5, 4)]
    if table.value.shape[1] > 4:
        keys += [(k, -1) for k in range(5)]  # the last column, of V^−1
    for key in keys:
        if key not in EVEN:
            into = damped if key in DAMPED else odd
            into |= table.has(key)
    even = partial(_even, rough=rough), EVEN, ~(damped | odd)
    groups = (even, (_damped, DAMPED, damped & ~odd), (_any, keys, odd))
    found: dict[str, list[tuple[NDArray[np.bool_], Zeros, Floats]]] = {name: [] for name in names}
    for solve, which, chosen in groups:
        if chosen.any():
            part = table if chosen.all() else table.some(chosen)
            entries, unit = scaled(part, which, closed=which is EVEN)
            for name in names:
                zeros, sign = solve(entries, name)
                found[name].append((chosen, zeros if unit is None else zeros.scaled(unit), sign))
    return {name: _together(each, number) for name, each in found.items()}


def _even(entries: Entries, name: str, rough: bool = False) -> Found:
    """Without damping: p0, p2, p1/V and hurwitz3/V² in V²."""
    if name == "hurwitz3":
        w = _hurwitz3_even(entries.doubles())
        if rough:
            found = _found(rough_zeros_of_quadratic(w), w)
            return _again(found, entries, partial(_even, name=name))
        found = _found(zeros_of_quadratic(entries, _EVEN_HURWITZ3, w), w)
        return _again(found, entries, _fine_even, _left_even, _fine_even)
    numbers = entries.numbers
    if name in ("p3", "p4"):
        return _found(_none(len(entries)), [numbers[(3, 1) if name == "p3" else (4, 0)]])
    a, b = {"p0": ((0, 0), (0, 2)), "p1": ((1, 1), (1, 3)), "p2": ((2, 0), (2, 2))}[name]
    zeros = zero_of_even(numbers[a], numbers[b], fine=name == "p0" and not rough)
    return _found(zeros, [numbers[a], numbers[b]])


def _hurwitz3_even(n: dict[tuple[int, int], T]) -> list[T]:
    """Hurwitz3/V² without damping as a polynomial in V²."""
    f0, f, e0, e, q0, q, k, m = (n[key] for key in EVEN)
    slow, fast = q0 * k - m * e0, q * k - m * e
    square = k * k
    return [e0 * slow - f0 * square, e0 * fast + e * slow - f * square, e * fast]


_EVEN_HURWITZ3 = Condition(lambda n: of_squares(_hurwitz3_even(n)), hurwitz3_near, hurwitz3_at)
_P1 = Condition(lambda n: _rows(n)[1], p1_near, p1_at)
_HURWITZ3 = Condition(lambda n: hurwitz3_of(_rows(n)), hurwitz3_near, hurwitz3_at)


def _fine_even(entries: Entries) -> Found:
    w = _hurwitz3_even(entries.numbers)
    return _found(square_roots(certain.zeros_of_quadratic(*w)), w)


def _left_even(entries: Entries) -> Found:
    w = of_squares(_hurwitz3_even(entries.cancelled()))
    return _found(zeros_of(w, len(entries), CANCELLED), w)


def _damped(entries: Entries, name: str) -> Found:
    """With damping p3 and p1 have both even and odd powers of V, and hurwitz3 is of degree 6."""
    if name in ("p0", "p2", "p4"):
        return _even(entries, name)
    n = entries.numbers
    if name == "p3":
        return _found(zero_of_linear(n[3, 0], n[3, 1]), [n[3, 0], n[3, 1]])
    condition = _P1 if name == "p1" else _HURWITZ3
    c = condition.polynomial(entries.doubles())
    found = _found(zeros_between(entries, condition, c), c)
    fine, guess = partial(_fine, name=name), partial(_guessed, name=name)
    return _again(found, entries, fine, *((_left_hurwitz3, guess) if name == "hurwitz3" else ()))


def _any(entries: Entries, name: str) -> Found:
    """Tables of other systems, with any powers of V."""
    return _again(_fine(entries, name), entries, partial(_guessed, name=name))


def _fine(entries: Entries, name: str) -> Found:
    polynomial = _polynomial(entries, name)
    return _found(zeros_of(polynomial, len(entries)), polynomial)


def _left_hurwitz3(entries: Entries) -> Found:
    """By what is left of entries of which nearly all cancels."""
    polynomial = hurwitz3_of(_rows(entries.cancelled()))
    return _found(zeros_of(polynomial, len(entries), CANCELLED), polynomial)


def _guessed(entries: Entries, name: str) -> Found:
    """By the coefficients' signs as they are computed, so that the sign before and the zeros fit together."""
    polynomial = _polynomial(entries, name)
    return _found(zeros_of(polynomial, len(entries), found=guessed(polynomial, len(entries))), polynomial)


def _again(found: Found, entries: Entries, *ways: Callable[[Entries], Found]) -> Found:
    """With the cells that are not sure done again, in one way after the other; the last one's are kept."""
    zeros, sign = found
    for way in ways:
        poor = np.flatnonzero(~zeros.sure)
        if not len(poor):
            break
        again, sign[poor] = way(entries.at(poor))
        most = max(len(zeros.V), len(again.V))
        V, rest, radius = (_rows_of(values, most) for values in zeros[:3])
        for into, values in zip((V, rest, radius), again[:3], strict=True):
            into[:, poor] = _rows_of(values, most)
        zeros.sure[poor] = again.sure
        zeros = Zeros(V, rest, radius, zeros.sure)
    return zeros, sign


def _polynomial(entries: Entries, name: str) -> list[Twofold | None]:
    """A condition, times a power of V where there is V^−1."""
    rows = _rows(entries.numbers)
    if name != "hurwitz3":
        return rows[CONDITIONS.index(name)]
    return without_noise(hurwitz3_of(rows)) if (4, -1) in entries.numbers else hurwitz3_of(rows)


def _rows(numbers: dict[tuple[int, int], T]) -> list[list[T | None]]:
    """Entries as p0 … p4, polynomials in V; times V where there is V^−1."""
    lowest = min(j for _, j in numbers)
    return [[numbers.get((k, j)) for j in range(lowest, 4)] for k in range(5)]


def _found(zeros: Zeros, polynomial: Sequence[Twofold | Double | None]) -> Found:
    """Zeros, and the sign just right of V = 0."""
    sign = np.zeros(len(zeros.sure))
    for a in polynomial:
        if a is not None:
            sign = np.where(sign == 0, np.sign(a.value), sign)
            if sign.all():
                break
    return zeros, sign


def _none(number: int) -> Zeros:
    nothing = np.empty((0, number))
    return Zeros(nothing, nothing, nothing, np.ones(number, bool))


def _together(parts: list[tuple[NDArray[np.bool_], Zeros, Floats]], number: int) -> Found:
    if len(parts) == 1:
        return parts[0][1:]
    most = max((len(zeros.V) for _, zeros, _ in parts), default=0)
    out, sure, sign = np.full((3, most, number), np.nan), np.ones(number, bool), np.zeros(number)
    for chosen, zeros, before in parts:
        for i in range(3):
            out[i, : len(zeros.V), chosen] = zeros[i].T
        sure[chosen], sign[chosen] = zeros.sure, before
    return Zeros(out[0], out[1], out[2], sure), sign


def _joined(parts: list[NDArray[Any]]) -> NDArray[Any]:
    return parts[0] if len(parts) == 1 else np.concatenate(parts, axis=-1)


def _rows_of(values: Floats, most: int) -> Floats:
    """So many rows, filled up with NaN, or without some that are NaN."""
    missing = most - len(values)
    if missing <= 0:
        return values[:most]
    return np.concatenate([values, np.full((missing, values.shape[1]), np.nan)])
