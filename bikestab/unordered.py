"""Numbers of twice double precision for many operations in a row: as ``Twofold``, in two thirds of the time.

Their rest may grow to some units of rounding of their terms' sizes, so that they need not be put in order
after each operation, and the halves that products take are kept. With rests of at most k u of a number's size
a product is wrong by at most 3 (1 + k) (1 + k') u² of its size, and its rest has k + k' + 1; a sum by
2 k + 1, with the larger k, and its rest has k + 1. ``tests/test_unordered.py`` follows this through the
formulas of the table and finds less than ENTRY.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bikestab.twofold import Twofold, head_of, two_difference, two_sum


class Unordered:
    """value + rest; ``size`` is the same expression with absolute values, and has no less than both."""

    __slots__ = ("_halves", "_spread", "rest", "size", "value")
    __array_ufunc__ = None  # an array times such a number is one

    def __init__(self, value: Any, rest: Any = 0.0, size: Any = None) -> None:
        self.value, self.rest = value, rest
        self.size = abs(value) if size is None else size
        self._halves: tuple[Any, Any] | None = None
        self._spread: Unordered | None = None

    @classmethod
    def of(cls, a: Twofold) -> Unordered:
        return cls(a.value, a.rest, a.size)

    def ordered(self) -> Twofold:
        """With the nearest double as its value."""
        return Twofold(*two_sum(self.value, self.rest), self.size)

    def put(self, value: Any, rest: Any) -> None:
        """Write what is ``ordered`` into two arrays, which takes less than to copy it there."""
        np.add(self.value, self.rest, value)
        part = value - self.value
        np.subtract(value, part, rest)
        np.subtract(self.value, rest, rest)
        np.subtract(self.rest, part, part)
        rest += part

    def halves(self) -> tuple[Any, Any]:
        """The value as a sum of two numbers of 26 bits."""
        if self._halves is None:
            head = head_of(self.value)
            self._halves = head, self.value - head
        return self._halves

    def over(self, shape: tuple[int, ...], halves: bool) -> Unordered:
        """The same in an array of that shape, kept for the next time; with halves that are spread, too."""
        if self.value.shape == shape:
            return self
        spread = self._spread
        if spread is None or spread.value.shape != shape:
            value, rest, size = (_over(x, shape) for x in (self.value, self.rest, self.size))
            self._spread = spread = Unordered(value, rest, size)
        if halves and spread._halves is None:
            head, tail = self.halves()
            spread._halves = _over(head, shape), _over(tail, shape)
        return spread

    def __add__(self, other: Any) -> Unordered:
        a, b = _alike(self, other)
        s, r = two_sum(a.value, b.value)
        return Unordered(s, _with(r, a.rest, b.rest), a.size + b.size)

    def __sub__(self, other: Any) -> Unordered:
        a, b = _alike(self, other)
        s, r = two_difference(a.value, b.value)
        return Unordered(s, _with(r, a.rest, -b.rest), a.size + b.size)

    def __mul__(self, other: Any) -> Unordered:
        if type(other) is int and not other & (other - 1):  # a power of two, and no bit changes
            return Unordered(self.value * other, self.rest * other, self.size * other)
        a, b = _alike(self, other, halves=True)
        a_value, b_value, (a1, a2), (b1, b2) = a.value, b.value, a.halves(), b.halves()
        p = a_value * b_value
        rest = a1 * b1
        rest -= p
        rest += a2 * b1
        rest += a1 * b2
        rest += a2 * b2
        if type(b.rest) is not float or b.rest:
            rest += a_value * b.rest
        if type(a.rest) is not float or a.rest:
            rest += a.rest * b_value
        return Unordered(p, rest, a.size * b.size)

    def __truediv__(self, other: Unordered) -> Unordered:
        return Unordered.of(self.ordered() / other.ordered())

    def __neg__(self) -> Unordered:
        return Unordered(-self.value, -self.rest, self.size)

    __radd__, __rmul__ = __add__, __mul__


def _alike(a: Unordered, other: Any, halves: bool = False) -> tuple[Unordered, Unordered]:
    """Both as numbers of one shape, or scalars: arrays of two shapes take numpy three times as long."""
    b = other if isinstance(other, Unordered) else Unordered(other)
    x, y = a.value, b.value
    if type(x) is float or type(y) is float or x.shape == y.shape or not x.shape or not y.shape:
        return a, b
    shape = np.broadcast(x, y).shape
    return a.over(shape, halves), b.over(shape, halves)


def _over(x: Any, shape: tuple[int, ...]) -> Any:
    if type(x) is float or not x.shape:
        return x
    out = np.empty(shape)
    out[...] = x
    return out


def _with(rest: Any, a: Any, b: Any) -> Any:
    """The sum of rests, without those that are not there."""
    if type(b) is float and not b:
        return rest if type(a) is float and not a else rest + a
    return rest + (b if type(a) is float and not a else a + b)


def chosen(which: NDArray[np.bool_], a: Unordered, b: Unordered) -> Unordered:
    """Those of ``a`` where ``which`` is true, and of ``b`` elsewhere."""
    return Unordered(
        *(np.where(which, x, y) for x, y in ((a.value, b.value), (a.rest, b.rest), (a.size, b.size)))
    )
