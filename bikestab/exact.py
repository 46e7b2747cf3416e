"""Exact signs and roots of polynomials whose coefficients are doubles, which are fractions.

Sturm's theorem finds every positive root, however close to the next.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import gcd
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats

FASTEST = (
    1e60  # m/s; the powers of greater speeds overflow, and no eigenvalue that matters meets another there
)
Integers: TypeAlias = NDArray[np.object_]  # a polynomial in V: Python's integers, of V^0, V^1, …


def integers(*parts: Floats) -> Integers:
    """The sum of tables, times a power of two that makes whole numbers of it."""
    exact = np.array(
        [
            [sum(map(Fraction, entry)) for entry in zip(*rows, strict=True)]
            for rows in zip(*(x.tolist() for x in parts), strict=True)
        ]
    )
    common = max(x.denominator for x in exact.flat)
    return np.array([[int(x * common) for x in row] for row in exact], dtype=object)


def sign(c: Integers | list[int], V: float) -> int:
    """The exact sign of a polynomial at a double."""
    n, d = V.as_integer_ratio()
    total, power = 0, 1
    for x in reversed(c):
        total, power = total * n + x * power, power * d
    return (total > 0) - (total < 0)


def positive_roots(polynomial: Integers) -> list[float]:
    """The positive real roots up to FASTEST, ascending, each once, to the nearest double or its neighbour."""
    used = np.flatnonzero(polynomial)
    if len(used) < 2:
        return []
    c: list[int] = polynomial[used[0] : used[-1] + 1].tolist()
    chain = _sturm_chain(c)

    def changes(V: float) -> int:
        signs = [s for s in (sign(f, V) for f in chain) if s]
        return sum(a != b for a, b in pairwise(signs))

    cauchy = 2 + max(Fraction(abs(x), abs(c[-1])) for x in c[:-1])
    bound = float(min(cauchy, Fraction(FASTEST)))
    roots = []
    todo = [(0.0, bound, changes(0.0), changes(bound))]
    while todo:
        a, b, at_a, at_b = todo.pop()
        if at_a == at_b:
            continue
        middle = _middle(a, b)
        if not a < middle < b:  # neighbouring doubles: several roots in between are one event
            roots.append(b)
        elif at_a - at_b == 1 and sign(c, a) * sign(c, b) < 0:
            above = sign(c, b)
            while a < middle < b:
                a, b = (a, middle) if sign(c, middle) == above else (middle, b)
                middle = _middle(a, b)
            roots.append(b)
        else:
            at_middle = changes(middle)
            todo += [(a, middle, at_a, at_middle), (middle, b, at_middle, at_b)]
    return sorted(roots)


def _middle(a: float, b: float) -> float:
    """The double with as many doubles between itself and a ≥ 0 as between itself and b."""
    low, high = np.array([a, b]).view(np.int64).tolist()
    return float(np.int64((low + high) // 2).view(np.float64))


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
