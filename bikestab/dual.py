"""Numbers that carry their derivatives, so that a formula evaluated with them is differentiated as well.

Value and derivatives are of twice double precision (``twofold``), because derivatives are sums of terms that
cancel, as the entries themselves are. Steps in the complex plane give no more than double precision of the
terms, and the error-free transformations behind ``Twofold`` know no complex numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from bikestab.twofold import Twofold


class Dual:
    """value + Σ slope[i] dx[i]; ``slope`` has the variables along its first axis, before those of ``value``.

    The size of a slope is that of the terms that formed it: one of size zero is zero whatever
    the numbers are.
    """

    __slots__ = ("slope", "value")
    __array_ufunc__ = None  # an array times a Dual is a Dual

    def __init__(self, value: Twofold, slope: Twofold) -> None:
        self.value, self.slope = value, slope

    def __add__(self, other: Any) -> Dual:
        if not isinstance(other, Dual):
            return Dual(self.value + other, self.slope)
        return Dual(self.value + other.value, self.slope + other.slope)

    def __mul__(self, other: Any) -> Dual:
        if not isinstance(other, Dual):
            return Dual(self.value * other, self.slope * other)
        return Dual(self.value * other.value, self.slope * other.value + self.value * other.slope)

    def __truediv__(self, other: Dual) -> Dual:
        quotient = self.value / other.value
        return Dual(quotient, (self.slope - quotient * other.slope) / other.value)

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.slope)

    def __sub__(self, other: Any) -> Dual:
        return self + -other

    def __rsub__(self, other: Any) -> Dual:
        return -self + other

    __radd__, __rmul__ = __add__, __mul__


def seed(variables: Sequence[str], name: str, dimensions: int = 0) -> Twofold:
    """The slope of a variable of this name: one by itself, zero by all others.

    ``dimensions`` is how many axes the values have.
    """
    one_hot = np.array([1.0 * (each == name) for each in variables])
    return Twofold(one_hot.reshape(-1, *(1,) * dimensions), 0.0)
