"""table → the events along the speed axis, and which eigenvalue is which between them.

No step along the speed axis is ever taken. Two eigenvalues meet only where the discriminant D(V) of the
quartic is zero, and the real parts of two complex pairs agree only where Q(V), the linear coefficient of
the depressed quartic, is zero. Both are polynomials in V with exactly known coefficients, and every root
is found. Between these events the order of the eigenvalues says which is which, so a branch at a speed
depends on that speed alone.

Through a coalescence the larger real eigenvalue and the one with positive imaginary part are the same
branch, and the smaller and the negative one. Where two real eigenvalues merely touch they keep their order.
"""

from __future__ import annotations

from functools import lru_cache, reduce
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.exact import Integers, integers, positive_roots, sign
from bikestab.model import ExactTable, Floats, in_powers


class Stretch(NamedTuple):
    """Speeds between two events: ``real`` eigenvalues, and the branch in each slot.

    Slots: real ones in descending order behind the complex pairs, each pair with its positive
    imaginary part first, the pair with the larger real part before the other.
    """

    real: int
    tilt: int  # sign of Q: where it is positive, of two pairs the one to the right is the faster too
    slots: tuple[int, ...]


class Course(NamedTuple):
    """What happens along the speed axis: ``stretches`` lie before, between and behind ``events`` [m/s].

    ``meeting`` has for each event the pairs of branches that meet at it, and go from real to complex or back.
    """

    events: list[float]
    stretches: list[Stretch]
    meeting: list[list[tuple[int, int]]]


def course(table: Floats | ExactTable) -> Course:
    """The events and stretches of a table of shape (5, 4), whose p4 is not zero."""
    parts = (table.value, table.rest) if isinstance(table, ExactTable) else (table,)
    return _course(*(np.ascontiguousarray(part, dtype=float).tobytes() for part in parts))


@lru_cache(maxsize=4)  # a table of numbers and a picture ask about the same bicycle
def _course(*parts: bytes) -> Course:
    tables = [in_powers(np.frombuffer(part).reshape(5, -1)) for part in parts]
    table = tables[0]
    D, Q, seminvariants = _discriminant(*tables)
    events = positive_roots(np.convolve(D, Q) if any(D) and any(Q) else D if any(D) else Q)
    edges = [0.0, *events]
    between = [a + (b - a) / 2 for a, b in pairwise(edges)] + [2 * edges[-1] + 1]

    def real_at(V: float) -> int:
        if sign(D, V) < 0:
            return 2
        return 4 if all(sign(x, V) < 0 for x in seminvariants) else 0

    stretches = [Stretch(real_at(between[0]), sign(Q, between[0]), (0, 1, 2, 3))]
    meeting: list[list[tuple[int, int]]] = []
    for V, after in zip(events, between[1:], strict=True):
        old, real, tilt = stretches[-1], real_at(after), sign(Q, after)
        if (old.real, real) == (0, 0):
            passing = tilt != old.tilt and sign(seminvariants[1], V) < 0
            stretches.append(Stretch(real, tilt, _exchanged(old.slots) if passing else old.slots))
            meeting.append([])
            continue
        rank = _rank(table, V) if {old.real, real} == {2, 4} else 0
        slots, met = _behind(old, real, tilt, rank)
        stretches.append(Stretch(real, tilt, slots))
        meeting.append(met)
    return Course(events, stretches, meeting)


def _behind(old: Stretch, real: int, tilt: int, rank: int) -> tuple[tuple[int, ...], list[tuple[int, int]]]:
    """The branch in each slot behind an event, and which branches meet at it.

    ``rank`` is how many real eigenvalues are above the two that meet, where there are others.
    """
    s = old.slots
    pairs = (s[0], s[1]), (s[2], s[3])
    match old.real, real:
        case 4, 2:
            couple = s[rank], s[rank + 1]
            return (*couple, *s[:rank], *s[rank + 2 :]), [couple]
        case 2, 4:
            return (*s[2 : 2 + rank], *pairs[0], *s[2 + rank :]), [pairs[0]]
        case 2, 0:  # the new pair has the smaller imaginary part
            return (s if tilt > 0 else _exchanged(s)), [pairs[1]]
        case 0, 2:
            return (s if tilt > 0 else _exchanged(s)), [pairs[1] if tilt > 0 else pairs[0]]
        case (0, 4) | (4, 0):
            return s, list(pairs)
        case _:
            return s, []


def _exchanged(slots: tuple[int, ...]) -> tuple[int, ...]:
    """The slots where two pairs with equal real parts pass one above the other."""
    return (*slots[2:], *slots[:2])


def _rank(table: Floats, V: float) -> int:
    """How many real eigenvalues are above the double one at V: the other three are real or a real pair."""
    p = table @ V ** np.arange(table.shape[1])
    turning = -np.sort(-np.roots((p[1:] * np.arange(1, 5))[::-1]).real)  # they separate four real roots
    powers = turning ** np.arange(5)[:, np.newaxis]
    return int(np.argmin(np.abs(p @ powers) / (np.abs(p) @ np.abs(powers))))


def in_slots(s: NDArray[np.complex128], real: int, tilt: int) -> NDArray[np.complex128]:
    """Eigenvalues (4, n) ordered by the slots of a stretch.

    Within rounding of a coalescence a pair may have come out as two real ones or the reverse; they stay as
    they are and only take the slots of what they are in truth.
    """

    def by(*keys: Floats) -> NDArray[np.complex128]:
        return np.take_along_axis(s, np.lexsort(keys[::-1], axis=0), axis=0)

    if real == 4:
        return by(-s.real, -s.imag)
    if real == 0:
        s = by(-s.imag, -s.real * np.sign(s.imag), -s.real)[[0, 3, 1, 2]]
        first, second = s[0], s[2]
        right = first.real + (tilt or 1) * first.imag >= second.real + (tilt or 1) * second.imag
        return np.where(right, s, s[[2, 3, 0, 1]])
    s = by(-s.real, -s.imag)
    size = np.abs(s.imag)
    closest = np.argmin(-np.diff(s.real, axis=0), axis=0)
    rank = np.arange(4)[:, np.newaxis]
    size = np.where(size.any(axis=0), size, (rank == closest) | (rank == closest + 1))
    return np.take_along_axis(s, np.argsort(-size, axis=0, kind="stable"), axis=0)


def _discriminant(*tables: Floats) -> tuple[Integers, Integers, tuple[Integers, Integers]]:
    """D and Q of the quartic e + d s + c s² + b s³ + a s⁴, and what tells four real roots from none.

    All roots are real where D > 0 and the two others are negative (Rees 1922). In terms of the depressed
    quartic y⁴ + P y² + Q y + R the others are 8 a² P and 16 a⁴ (4 R − P²), and Q is 8 |a|³ Q here.
    """
    e, d, c, b, a = integers(*tables)

    def m(*polynomials: Any) -> Any:
        return reduce(np.convolve, polynomials)

    I = 12 * m(a, e) - 3 * m(b, d) + m(c, c)  # noqa: E741  # the letters of invariant theory: 27 D = 4 I³ − J²
    J = 72 * m(a, c, e) + 9 * m(b, c, d) - 27 * m(a, d, d) - 27 * m(e, b, b) - 2 * m(c, c, c)
    P = 8 * m(a, c) - 3 * m(b, b)
    R = 64 * m(a, a, a, e) - 16 * m(a, a, c, c) + 16 * m(a, b, b, c) - 16 * m(a, a, b, d) - 3 * m(b, b, b, b)
    Q = m(b, b, b) + 8 * m(a, a, d) - 4 * m(a, b, c)
    return 4 * m(I, I, I) - m(J, J), Q if a.sum() > 0 else -Q, (P, R)
