"""(table, V) → the four eigenvalues as continuous branches with the names of their modes.

No step along the speed axis is ever taken. Two eigenvalues meet only where the discriminant D(V) of the
quartic is zero, and the real parts of two complex pairs agree only where Q(V), the linear coefficient of
the depressed quartic, is zero. Both are polynomials in V with exactly known coefficients, since a double
is a fraction; Sturm's theorem finds every root, however close to the next. Between these events the
order of the eigenvalues says which is which, so a branch at a speed depends on that speed alone.

Through a coalescence the larger real eigenvalue and the one with positive imaginary part are the same
branch, and the smaller and the negative one. Where two real eigenvalues merely touch they keep their order.

Names. Weave is the complex pair at the highest speeds that have exactly one, capsize the slower and
castering the faster of the two real eigenvalues beside it; each name stays with its branches. Where these
two are real, the branches of weave are called ``real pair`` (``real`` if only one is), and any other pair
that oscillates, such as one of capsize with castering, ``pair 2``.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache, reduce
from itertools import pairwise
from math import gcd
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.errors import InputError
from bikestab.model import Floats
from bikestab.spectrum import eigenvalues_of

BRANCHES = ("weave", "weave", "capsize", "castering")  # rows of Modes, each called after its own name
NAMES = ("weave", "capsize", "castering", "real pair", "real", "pair 2")
Integers: TypeAlias = NDArray[np.object_]  # a polynomial in V: Python's integers, of V^0, V^1, …


class Modes(NamedTuple):
    """Eigenvalues at the speeds V [m/s] along four continuous branches, named as the module says.

    Rows 0 and 1 are the branches of weave, 2 of capsize, 3 of castering; ``names`` has one of NAMES for
    each point. ``coalescences`` are all positive speeds at which two eigenvalues meet and go from
    real to complex or back, and ``meeting`` the two rows that do.
    """

    V: Floats
    eigenvalues: NDArray[np.complex128]  # [s⁻¹], (4, n)
    names: NDArray[np.str_]  # (4, n)
    coalescences: Floats  # [m/s]
    meeting: tuple[tuple[int, int], ...]


class _Stretch(NamedTuple):
    """Speeds between two events: ``real`` eigenvalues, and the branch in each slot.

    Slots: real ones in descending order behind the complex pairs, each pair with its positive
    imaginary part first, the pair with the larger real part before the other.
    """

    real: int
    tilt: int  # sign of Q: where it is positive, of two pairs the one to the right is the faster too
    slots: tuple[int, ...]


def follow(table: Floats, V: ArrayLike) -> Modes:
    """The eigenvalues of one table (5, 4) at speeds V ≥ 0 [m/s], shape (n,), in any order.

    Equal to ``spectrum.eigenvalues_of`` up to their order. Raises InputError for a negative speed and
    where p4 = 0, since an eigenvalue is then infinite.
    """
    table = np.asarray(table, dtype=float)
    V = np.atleast_1d(np.asarray(V, dtype=float))
    if np.any(V < 0) or not np.all(np.isfinite(V)):
        raise InputError("a speed is negative or not finite", key=("V",), hint="allowed: 0 and above")
    if table[4, 0] == 0:
        raise InputError("the mass matrix is singular: p4 = 0, and an eigenvalue is infinite")
    speeds, stretches, meeting = _stretches(table.tobytes())
    rows = _rows(table, speeds, stretches)

    values = eigenvalues_of(table[..., np.newaxis], V)
    where = np.searchsorted(speeds, V)
    out, names = np.empty_like(values), np.empty(values.shape, dtype="<U9")
    for i, stretch in enumerate(stretches):
        here = where == i
        at = [rows.index(branch) for branch in stretch.slots]
        out[np.ix_(at, here)] = _in_slots(values[:, here], stretch.real, stretch.tilt)
        names[:, here] = np.array(_names(stretch, rows))[:, np.newaxis]
    both = [(s, (rows.index(a), rows.index(b))) for s, m in zip(speeds, meeting, strict=True) for a, b in m]
    return Modes(V, out, names, np.array([s for s, _ in both]), tuple(m for _, m in both))


@lru_cache(maxsize=4)  # a table of numbers and a picture ask about the same bicycle
def _stretches(data: bytes) -> tuple[list[float], list[_Stretch], list[list[tuple[int, int]]]]:
    """The events, the stretches before, between and behind them, and which branches meet at each.

    ``data`` are the bytes of the table, shape (5, 4).
    """
    table = np.frombuffer(data).reshape(5, 4)
    D, Q, seminvariants = _discriminant(table)
    events = _positive_roots(np.convolve(D, Q) if any(D) and any(Q) else D if any(D) else Q)
    edges = [0.0, *events]
    between = [a + (b - a) / 2 for a, b in pairwise(edges)] + [2 * edges[-1] + 1]

    def real_at(V: float) -> int:
        if _sign(D, V) < 0:
            return 2
        return 4 if all(_sign(x, V) < 0 for x in seminvariants) else 0

    stretches = [_Stretch(real_at(between[0]), _sign(Q, between[0]), (0, 1, 2, 3))]
    meeting: list[list[tuple[int, int]]] = []
    for V, after in zip(events, between[1:], strict=True):
        old, real, tilt = stretches[-1], real_at(after), _sign(Q, after)
        p0, p1, p2, p3 = s = old.slots
        met: list[tuple[int, int]] = []
        if (old.real, real) == (4, 2):
            k = _rank(table, V)
            met = [(s[k], s[k + 1])]
            s = (s[k], s[k + 1], *s[:k], *s[k + 2 :])
        elif (old.real, real) == (2, 4):
            k = _rank(table, V)
            met = [(p0, p1)]
            s = (*s[2 : 2 + k], p0, p1, *s[2 + k :])
        elif (old.real, real) == (2, 0):  # the new pair has the smaller imaginary part
            met = [(p2, p3)]
            s = s if tilt > 0 else (p2, p3, p0, p1)
        elif (old.real, real) == (0, 2):
            met = [(p2, p3)] if tilt > 0 else [(p0, p1)]
            s = s if tilt > 0 else (p2, p3, p0, p1)
        elif {old.real, real} == {0, 4}:
            met = [(p0, p1), (p2, p3)]
        elif real == 0 and tilt != old.tilt and _sign(seminvariants[1], V) < 0:
            s = (p2, p3, p0, p1)  # equal real parts: the pairs pass one above the other
        stretches.append(_Stretch(real, tilt, s))
        meeting.append(met)
    return events, stretches, meeting


def _rank(table: Floats, V: float) -> int:
    """How many real eigenvalues are above the double one at V: the other three are real or a real pair."""
    p = table @ V ** np.arange(4)
    turning = -np.sort(-np.roots((p[1:] * np.arange(1, 5))[::-1]).real)  # they separate four real roots
    powers = turning ** np.arange(5)[:, np.newaxis]
    return int(np.argmin(np.abs(p @ powers) / (np.abs(p) @ np.abs(powers))))


def _in_slots(s: NDArray[np.complex128], real: int, tilt: int) -> NDArray[np.complex128]:
    """Eigenvalues (4, n) ordered by the slots of a stretch.

    Within some 1e-8 of a coalescence rounding may have made two real ones of a pair or the reverse; they
    stay as they are and only take the slots of what they are in truth.
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


def _rows(table: Floats, speeds: list[float], stretches: list[_Stretch]) -> list[int]:
    """The branches of weave, capsize and castering, from the highest speeds with exactly one pair."""
    last = len(stretches) - 1
    i = next((i for i in range(last, -1, -1) if stretches[i].real == 2), last)
    low = speeds[i - 1] if i else 0.0
    # far up, capsize falls with 1/V and castering grows with V
    V = np.array([0.5 * (low + speeds[i]) if i < last else 1e3 * max(low, 1.0)])
    real, tilt, slots = stretches[i]
    s = _in_slots(eigenvalues_of(table[..., np.newaxis], V), real, tilt)[:, 0]
    pairs, others = list(slots[: 4 - real]), sorted(range(4 - real, 4), key=lambda k: abs(s[k]))
    if real == 2:
        return [*pairs, *(slots[k] for k in others)]
    if real == 0:  # two pairs: weave is the faster
        return pairs if abs(s[0].imag) >= abs(s[2].imag) else [*pairs[2:], *pairs[:2]]
    slow, fast = others[0], others[-1]
    return [*(slots[k] for k in range(4) if k not in (slow, fast)), slots[slow], slots[fast]]


def _names(stretch: _Stretch, rows: list[int]) -> list[str]:
    """The name of each row on a stretch."""
    complex_ = [rows.index(branch) for branch in stretch.slots[: 4 - stretch.real]]
    names = ["", "", "capsize", "castering"]
    names[0] = names[1] = "real" if {0, 1} & set(complex_) else "real pair"
    for a, b in zip(complex_[::2], complex_[1::2], strict=True):
        names[a] = names[b] = "weave" if {a, b} == {0, 1} else "pair 2"
    return names


def _discriminant(table: Floats) -> tuple[Integers, Integers, tuple[Integers, Integers]]:
    """D and Q of the quartic e + d s + c s² + b s³ + a s⁴, and what tells four real roots from none.

    All roots are real where D > 0 and the two others are negative (Rees 1922). In terms of the depressed
    quartic y⁴ + P y² + Q y + R the others are 8 a² P and 16 a⁴ (4 R − P²), and Q is 8 |a|³ Q here.
    """
    e, d, c, b, a = _integers(table)

    def m(*polynomials: Any) -> Any:
        return reduce(np.convolve, polynomials)

    I = 12 * m(a, e) - 3 * m(b, d) + m(c, c)  # noqa: E741  # the letters of invariant theory: 27 D = 4 I³ − J²
    J = 72 * m(a, c, e) + 9 * m(b, c, d) - 27 * m(a, d, d) - 27 * m(e, b, b) - 2 * m(c, c, c)
    P = 8 * m(a, c) - 3 * m(b, b)
    R = 64 * m(a, a, a, e) - 16 * m(a, a, c, c) + 16 * m(a, b, b, c) - 16 * m(a, a, b, d) - 3 * m(b, b, b, b)
    Q = m(b, b, b) + 8 * m(a, a, d) - 4 * m(a, b, c)
    return 4 * m(I, I, I) - m(J, J), Q if a[0] > 0 else -Q, (P, R)


def _integers(table: Floats) -> Integers:
    """A table times a power of two that makes whole numbers of it."""
    exact = np.array([[Fraction(float(x)) for x in row] for row in table])
    common = max(x.denominator for x in exact.flat)
    return np.array([[int(x * common) for x in row] for row in exact], dtype=object)


def _sign(c: Integers | list[int], V: float) -> int:
    """The exact sign of a polynomial at a double."""
    n, d = V.as_integer_ratio()
    total, power = 0, 1
    for x in reversed(c):
        total, power = total * n + x * power, power * d
    return (total > 0) - (total < 0)


def _positive_roots(polynomial: Integers) -> list[float]:
    """The positive real roots, ascending, each once and to the nearest double or its neighbour."""
    used = np.flatnonzero(polynomial)
    if len(used) < 2:
        return []
    c: list[int] = polynomial[used[0] : used[-1] + 1].tolist()
    chain = _sturm_chain(c)

    def changes(V: float) -> int:
        signs = [s for s in (_sign(f, V) for f in chain) if s]
        return sum(a != b for a, b in pairwise(signs))

    bound = 2.0 + float(max(Fraction(abs(x), abs(c[-1])) for x in c[:-1]))  # Cauchy
    found = []
    todo = [(0.0, bound, changes(0.0), changes(bound))]
    while todo:
        a, b, at_a, at_b = todo.pop()
        if at_a == at_b:
            continue
        middle = a + (b - a) / 2
        if not a < middle < b:  # neighbouring doubles: several roots in between are one event
            found.append(b)
        elif at_a - at_b == 1 and _sign(c, a) * _sign(c, b) < 0:
            sign = _sign(c, b)
            while a < middle < b:
                a, b = (a, middle) if _sign(c, middle) == sign else (middle, b)
                middle = a + (b - a) / 2
            found.append(b)
        else:
            at_middle = changes(middle)
            todo += [(a, middle, at_a, at_middle), (middle, b, at_middle, at_b)]
    return sorted(found)


def _sturm_chain(c: list[int]) -> list[list[int]]:
    """Polynomials whose sign changes count the distinct roots in an interval."""
    chain = [c, [j * x for j, x in enumerate(c)][1:]]
    while len(chain[-1]) > 1:
        rest, by = chain[-2], chain[-1]
        lead = abs(by[-1])  # a positive factor keeps the signs and the coefficients whole
        while len(rest) >= len(by):
            factor = rest[-1] if by[-1] > 0 else -rest[-1]
            shift = len(rest) - len(by)
            rest = [lead * x for x in rest]
            for j, y in enumerate(by):
                rest[shift + j] -= factor * y
            rest.pop()
            while rest and rest[-1] == 0:
                rest.pop()
        if not rest:
            break
        content = gcd(*rest)
        chain.append([-x // content for x in rest])
    return chain
