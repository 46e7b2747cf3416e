"""The six conditions as exact polynomials, whose signs are those of the conditions.

With t = tan(λ/2), sin λ = 2t/(1 + t²) and cos λ = (1 − t²)/(1 + t²): multiplied by a power of 1 + t² each
condition is a polynomial in t, σ, the speed and the parameters that vary. What it is multiplied or divided
by is positive: powers of 1 + t², of the masses and lengths below a fraction, and of V > 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import NamedTuple

from bikestab.algebra import Polynomial
from bikestab.formulas import Formulas
from bikestab.routh import CONDITIONS

_T, _SIGMA, _V = range(3)


class Condition(NamedTuple):
    """A polynomial in t, σ, V or V² and what varies; ``at_rest``: without a power of V, it is zero there."""

    polynomial: Polynomial
    squared: bool
    at_rest: bool


def condition_formulas(formulas: Formulas) -> dict[str, Condition]:
    """The left sides of (2.2), times what is positive, as polynomials in t, σ, V or V², and what varies."""
    number = len(formulas.variables)
    rows = [Polynomial(number + 1, {}) for _ in range(5)]
    for (k, j), entry in formulas.entries.items():
        rows[k] = rows[k] + Polynomial(
            number + 1, {(*powers[:3], j, *powers[3:]): value for powers, value in entry.terms.items()}
        )
    p0, p1, p2, p3, p4 = rows
    hurwitz3 = p1 * (p2 * p3 - p4 * p1) - p0 * p3 * p3
    return {name: _in_half_angle(sides) for name, sides in zip(CONDITIONS, [*rows, hurwitz3], strict=True)}


def _in_half_angle(side: Polynomial) -> Condition:
    """From the variables sin, cos, σ, V, … to t, σ, V or V², …; the degree gives the power of 1 + t²."""
    number = side.number - 1
    degree = max((powers[0] + powers[1] for powers in side.terms), default=0)
    speeds = [powers[3] for powers in side.terms]
    least = min(speeds, default=0)
    squared = all((speed - least) % 2 == 0 for speed in speeds)
    t2 = Polynomial(number, {(2,) + (0,) * (number - 1): Fraction(1)})
    one = Polynomial.constant(number, 1)
    plus, minus = [one], [one]
    for _ in range(degree):
        plus.append(plus[-1] * (one + t2))
        minus.append(minus[-1] * (one - t2))
    parts: dict[tuple[int, int], dict[tuple[int, ...], Fraction]] = {}
    for (sin, cos, sigma, speed, *others), value in side.terms.items():
        powers = (sin, sigma, (speed - least) // (2 if squared else 1), *others)
        parts.setdefault((sin, cos), {})[powers] = value * 2**sin
    total = Polynomial(number, {})
    for (sin, cos), terms in parts.items():
        total = total + Polynomial(number, terms) * minus[cos] * plus[degree - sin - cos]
    return Condition(total, squared, least > 0)


def degrees(conditions: Mapping[str, Condition]) -> dict[str, tuple[int, ...]]:
    """The degree of each condition in each variable."""
    return {
        name: tuple(each.polynomial.degree(i) for i in range(each.polynomial.number))
        for name, each in conditions.items()
    }
