"""(bicycle, box of parameters) → the entries of its table as exact polynomials in sin λ, cos λ and σ."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from types import SimpleNamespace
from typing import Any, NamedTuple

from bikestab.algebra import Polynomial, Ratio, common_denominator
from bikestab.bicycle import Bicycle
from bikestab.letters import PARAMETERS, Model, letters
from bikestab.model import Coefficients, coefficients_of, entries_of
from bikestab.notation import reduced

DESIGN = ("sin", "cos", "sigma")


class Formulas(NamedTuple):
    """The table's entries (k, j), each times ``below``, as polynomials in ``variables``.

    The factors of ``below`` are sums of masses and lengths, which are positive.
    """

    variables: tuple[str, ...]
    entries: dict[tuple[int, int], Polynomial]
    below: dict[Polynomial, int]


def table_formulas(bicycle: Bicycle, varied: Sequence[str] = (), *, model: Model = "refined") -> Formulas:
    """The entries P[k, j] of the characteristic table of exactly these doubles.

    Variables are sin λ, cos λ, σ and the parameters ``varied``, of the notation that the bicycle is given in.
    The formulas are those of ``exact_table``: nothing is written twice.
    """
    entries = entries_of(_letters(bicycle, varied, model))
    below = common_denominator(entries.values())
    return Formulas((*DESIGN, *varied), {place: entry.over(below) for place, entry in entries.items()}, below)


def coefficient_formulas(bicycle: Bicycle, *, model: Model = "refined") -> Coefficients:
    """The coefficients of equations (1.5) as polynomials in sin λ, cos λ and σ."""
    return Coefficients(*(term.over({}) for term in coefficients_of(_letters(bicycle, (), model))))


def _letters(bicycle: Bicycle, varied: Sequence[str], model: Model) -> SimpleNamespace:
    variables = (*DESIGN, *varied)
    number = len(variables)

    def constant(value: Any) -> Ratio:
        return Ratio(Polynomial.constant(number, Fraction(float(value))))

    symbols = {name: Ratio(Polynomial.variable(number, i)) for i, name in enumerate(variables)}
    own = bicycle.bodies or {name: getattr(bicycle, name) for name in PARAMETERS}
    given = {name: symbols[name] if name in varied else constant(value) for name, value in own.items()}
    numbers = {name: symbols[name] for name in varied} | given
    if bicycle.bodies:
        numbers = reduced(numbers)
    p = {name: x if isinstance(x, Ratio) else constant(x) for name, x in numbers.items()}
    p |= {name: constant(gain) for name, gain in bicycle.gains}
    for i in "12":
        if not p[f"C{i}"].top:  # what never spins may be a skate, without a radius
            p[f"R{i}"] = constant(1)
    parts = SimpleNamespace(**p, ahead=p["l2"] - p["c"])
    return letters(parts, symbols["sin"], symbols["cos"], symbols["sigma"], model)
