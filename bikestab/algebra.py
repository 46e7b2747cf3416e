"""Exact polynomials, and quotients of them, that add and multiply as numbers do.

The formulas of the model are written once: with numbers of twice double precision they give a table, with
the quotients of this file the table's entries as formulas. Coefficients are fractions, as every double is.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any, TypeAlias

_Powers: TypeAlias = tuple[int, ...]


class Polynomial:
    """Coefficients by the powers of ``number`` variables; those that are zero are left out."""

    __slots__ = ("number", "terms")

    def __init__(self, number: int, terms: Mapping[_Powers, Fraction]) -> None:
        self.number = number
        self.terms = {powers: value for powers, value in terms.items() if value}

    @classmethod
    def constant(cls, number: int, value: Any) -> Polynomial:
        """A number, as a polynomial of as many variables."""
        return cls(number, {(0,) * number: Fraction(value)})

    @classmethod
    def variable(cls, number: int, which: int) -> Polynomial:
        """One of the variables itself."""
        return cls(number, {tuple(int(i == which) for i in range(number)): Fraction(1)})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Polynomial) and self.terms == other.terms

    def __hash__(self) -> int:
        return hash(frozenset(self.terms.items()))

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __add__(self, other: Polynomial) -> Polynomial:
        terms = dict(self.terms)
        for powers, value in other.terms.items():
            terms[powers] = terms.get(powers, Fraction()) + value
        return Polynomial(self.number, terms)

    def __neg__(self) -> Polynomial:
        return self.scaled(-1)

    def __sub__(self, other: Polynomial) -> Polynomial:
        return self + -other

    def __mul__(self, other: Polynomial) -> Polynomial:
        terms: dict[_Powers, Fraction] = {}
        for left, a in self.terms.items():
            for right, b in other.terms.items():
                powers = tuple(map(int.__add__, left, right))
                terms[powers] = terms.get(powers, Fraction()) + a * b
        return Polynomial(self.number, terms)

    def __pow__(self, power: int) -> Polynomial:
        result = Polynomial.constant(self.number, 1)
        for _ in range(power):
            result = result * self
        return result

    def scaled(self, factor: Fraction | int) -> Polynomial:
        """The product with a number."""
        return Polynomial(self.number, {powers: factor * value for powers, value in self.terms.items()})

    def degree(self, variable: int) -> int:
        """The highest power of a variable."""
        return max((powers[variable] for powers in self.terms), default=0)

    def divided(self, other: Polynomial) -> Polynomial | None:
        """The quotient by another polynomial that divides this one, else None."""
        first = max(other.terms)
        left, quotient = self, Polynomial(self.number, {})
        while left:
            highest = max(left.terms)
            powers = tuple(map(int.__sub__, highest, first))
            if min(powers) < 0:
                return None
            term = Polynomial(self.number, {powers: left.terms[highest] / other.terms[first]})
            quotient, left = quotient + term, left - term * other
        return quotient


class Ratio:
    """``top`` divided by the product of the polynomials ``below``, each to its power.

    The factors below have leading coefficients of 1; they are kept apart, and cancelled where they divide
    the top.
    """

    __slots__ = ("below", "top")

    def __init__(self, top: Polynomial, below: Mapping[Polynomial, int] | None = None) -> None:
        self.top, self.below = top, {}
        for factor, power in (below or {}).items():
            left = power
            while left and (quotient := self.top.divided(factor)) is not None:
                self.top, left = quotient, left - 1
            if left:
                self.below[factor] = left

    def over(self, below: Mapping[Polynomial, int]) -> Polynomial:
        """The top over a denominator that has all factors of this one's."""
        top = self.top
        for factor, power in below.items():
            top = top * factor ** (power - self.below.get(factor, 0))
        return top

    def __add__(self, other: Any) -> Ratio:
        other = self._ratio(other)
        below = common_denominator((self, other))
        return Ratio(self.over(below) + other.over(below), below)

    def __mul__(self, other: Any) -> Ratio:
        other = self._ratio(other)
        return Ratio(self.top * other.top, _product(self.below, other.below))

    def __truediv__(self, other: Any) -> Ratio:
        other = self._ratio(other)
        scale = other.top.terms[max(other.top.terms)]
        factor = other.top.scaled(1 / scale)
        below = _product(self.below, {factor: 1} if any(map(any, factor.terms)) else {})
        return Ratio(Ratio(self.top.scaled(1 / scale)).over(other.below), below)

    def __neg__(self) -> Ratio:
        return Ratio(-self.top, self.below)

    def __sub__(self, other: Any) -> Ratio:
        return self + -self._ratio(other)

    def __rsub__(self, other: Any) -> Ratio:
        return -self + other

    __radd__, __rmul__ = __add__, __mul__

    def _ratio(self, other: Any) -> Ratio:
        return other if isinstance(other, Ratio) else Ratio(Polynomial.constant(self.top.number, other))


def common_denominator(ratios: Iterable[Ratio]) -> dict[Polynomial, int]:
    """The factors, with their powers, over which all of them can be written."""
    below: dict[Polynomial, int] = {}
    for ratio in ratios:
        below |= {factor: max(power, below.get(factor, 0)) for factor, power in ratio.below.items()}
    return below


def _product(a: Mapping[Polynomial, int], b: Mapping[Polynomial, int]) -> dict[Polynomial, int]:
    return {factor: a.get(factor, 0) + b.get(factor, 0) for factor in (*a, *b)}
