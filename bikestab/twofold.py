"""Numbers of twice double precision: sums of two doubles, with the size of the terms that formed them.

The error-free transformations of Dekker (1971) and Knuth, and sums and products after Joldes, Muller and
Popescu (2017). They take additions and multiplications alone, so that a number's bits do not depend on the
machine, on the shape of its array or on its neighbours. With u = 2^−53 a sum is right to 4 u² of its terms'
sizes and a product to 8 u² of itself, as long as nothing leaves the range 1e-290 … 1e290.
"""

from __future__ import annotations

from typing import Any

import numpy as np

_SPLITTER = 134217729.0  # 2^27 + 1 cuts a double into two halves of 26 bits


def two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    """A + b as the nearest double and the rest, which is exact."""
    s = a + b
    part = s - a
    rest = a - (s - part)
    rest += b - part
    return s, rest


def two_difference(a: Any, b: Any) -> tuple[Any, Any]:
    """A − b, as ``two_sum``."""
    s = a - b
    part = s - a
    rest = a - (s - part)
    rest -= b + part
    return s, rest


def two_product(a: Any, b: Any) -> tuple[Any, Any]:
    """A b as the nearest double and the rest, which is exact."""
    p = a * b
    a1, a2 = _halves(a)
    b1, b2 = _halves(b)
    rest = a1 * b1
    rest -= p  # in place where it is an array: what is new must come into the cache first
    rest += a2 * b1
    rest += a1 * b2
    rest += a2 * b2
    return p, rest


def head_of(a: Any) -> Any:
    """The first 26 bits."""
    high = _SPLITTER * a
    low = high - a
    high -= low
    return high


def _halves(a: Any) -> tuple[Any, Any]:
    """A as a sum of two numbers of 26 bits."""
    high = head_of(a)
    return high, a - high


def _ordered(a: Any, b: Any) -> tuple[Any, Any]:
    """``two_sum`` where |a| ≥ |b|."""
    s = a + b
    rest = s - a
    return s, b - rest


Pair = tuple[Any, Any]


def pair_sum(a: Pair, b: Pair) -> Pair:
    """The sum of two pairs value + rest, not ordered: the rest may grow to some u of the terms' sizes."""
    s, r = two_sum(a[0], b[0])
    r += a[1] + b[1]
    return s, r


def pair_difference(a: Pair, b: Pair) -> Pair:
    """A − b, as ``pair_sum``."""
    s, r = two_difference(a[0], b[0])
    r += a[1] - b[1]
    return s, r


def pair_product(a: Pair, b: Pair) -> Pair:
    """The product of two pairs value + rest, whose rests are some u of their sizes; as ``pair_sum``."""
    p, r = two_product(a[0], b[0])
    cross = a[0] * b[1]
    cross += a[1] * b[0]
    r += cross
    return p, r


class Twofold:
    """value + rest, |rest| ≤ u |value|; ``size`` is the same expression with absolute values.

    The error of any expression of n operations is so at most 8 n u² of its size, and what has the size zero
    is zero exactly. A plain number is one without rest.
    """

    __slots__ = ("rest", "size", "value")
    __array_ufunc__ = None  # an array times a Twofold is a Twofold

    def __init__(self, value: Any, rest: Any = 0.0, size: Any = None) -> None:
        self.value, self.rest = value, rest
        self.size = abs(value) if size is None else size

    def __add__(self, other: Any) -> Twofold:
        if not isinstance(other, Twofold):
            other = Twofold(other)
        s, r = two_sum(self.value, other.value)
        r += self.rest + other.rest
        return Twofold(*_ordered(s, r), self.size + other.size)

    def __mul__(self, other: Any) -> Twofold:
        if not isinstance(other, Twofold):
            p, r = two_product(self.value, other)
            r += self.rest * other
            return Twofold(*_ordered(p, r), self.size * abs(other))
        p, r = two_product(self.value, other.value)
        cross = self.value * other.rest
        r += cross + self.rest * other.value
        return Twofold(*_ordered(p, r), self.size * other.size)

    def __truediv__(self, other: Twofold) -> Twofold:
        """Right to 32 u²; the size is that of the quotient of a number by one without cancellation."""
        first = self.value / other.value
        left = self - other * first
        return Twofold(*_ordered(first, left.value / other.value), self.size / abs(other.value))

    def times(self, power: Any) -> Twofold:
        """The product with a power of two."""
        return Twofold(self.value * power, self.rest * power, self.size * abs(power))

    def at(self, index: Any) -> Twofold:
        """Some elements of an array of numbers."""
        rest = None if self.rest is None else self.rest[index] if np.ndim(self.rest) else self.rest
        return Twofold(self.value[index], rest, self.size[index])

    def __neg__(self) -> Twofold:
        return Twofold(-self.value, -self.rest, self.size)

    def __sub__(self, other: Any) -> Twofold:
        return self + -other

    def __rsub__(self, other: Any) -> Twofold:
        return -self + other

    __radd__, __rmul__ = __add__, __mul__

    def square_root(self) -> Twofold:
        """Of positive numbers; right to 16 u²."""
        first = np.sqrt(self.value)
        p, r = two_product(first, first)
        left = (self.value - p) - r + self.rest
        return Twofold(*_ordered(first, 0.5 * left / first))


class Double:
    """Numbers with the summed absolute values of the terms that formed them.

    The error of an expression of n operations is at most n + 1 times 2^−53 of its size.
    """

    __slots__ = ("size", "value")

    def __init__(self, value: Any, size: Any) -> None:
        self.value, self.size = value, size

    def __add__(self, other: Double) -> Double:
        return Double(self.value + other.value, self.size + other.size)

    def __sub__(self, other: Double) -> Double:
        return Double(self.value - other.value, self.size + other.size)

    def __mul__(self, other: Double) -> Double:
        return Double(self.value * other.value, self.size * other.size)

    def __neg__(self) -> Double:
        return Double(-self.value, self.size)

    def at(self, index: Any) -> Double:
        """Some elements of an array of numbers."""
        return Double(self.value[index], self.size[index])


def exact_sum(a: Any, b: Any) -> Twofold:
    """The sum of two doubles: without error, so that its size is its own."""
    return Twofold(*two_sum(a, b))
