"""(bicycle, λ, σ) → the table's entries with their derivatives by every parameter, by forward propagation.

The formulas are those of ``letters`` and ``model``, evaluated with numbers that carry their derivatives.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bikestab.bicycle import Bicycle
from bikestab.dual import Dual, seed
from bikestab.gains import GAINS
from bikestab.letters import letters
from bikestab.model import Model, entries_of
from bikestab.notation import reduced
from bikestab.polynomials import difference_of, product_of
from bikestab.routh import hurwitz3_of
from bikestab.sines import sine_cosine
from bikestab.twofold import Twofold

Entries = dict[tuple[int, int], Dual]
_ZERO = 2.0**-88  # of the terms: some operations more than COEFFICIENT allows for
_LAST = ("lam", "sigma", "V")
_DEFAULTS = {"g": 9.81, "delta": 0.0}


class Slopes(NamedTuple):
    """Entries (k, j) of tables as Dual numbers; their slopes are by ``variables``, along the first axis.

    The last variables are ``lam``, ``sigma`` and ``V``, on which no entry depends: conditions at a speed do.
    Each is varied alone: those before with λ and σ as they are.
    """

    variables: tuple[str, ...]
    entries: Entries


def free_parameters(bicycle: Bicycle) -> dict[str, float]:
    """The numbers of a bicycle in its notation, without tilt and trail, and with what it has by default."""
    given = {**_DEFAULTS, **bicycle.given}
    apart = {"lam", "sigma", "trail"} | ({"c"} if bicycle.bodies is not None else set())
    return {name: given[name] for name in bicycle.notation if name in given and name not in apart}


def slopes_of(
    bicycle: Bicycle,
    lam: ArrayLike,
    sigma: ArrayLike,
    *,
    model: Model = "refined",
    by: Sequence[str] | None = None,
) -> Slopes:
    """The table of designs λ [rad] and σ [1] of one shape, with derivatives by the parameters ``by``.

    By default these are all of the notation. A skate's spin has no derivative, since no skate can spin: it is
    taken for zero.
    """
    lam, sigma = np.broadcast_arrays(np.asarray(lam, dtype=float), np.asarray(sigma, dtype=float))
    given = free_parameters(bicycle)
    variables = (*(given if by is None else by), *_LAST)

    def variable(name: str, value: ArrayLike) -> Dual:
        return Dual(Twofold(np.asarray(value)), seed(variables, name, lam.ndim))

    numbers = {name: variable(name, value) for name, value in given.items()}
    if bicycle.bodies is not None:
        gains = {name: numbers[name] for name in GAINS if name in numbers}
        numbers = reduced(numbers) | gains
    skates = [i for i in "12" if getattr(bicycle, f"R{i}") == 0]
    for i in skates:
        numbers[f"R{i}"] = numbers[f"C{i}"] + 1.0
        numbers[f"C{i}"] = numbers[f"C{i}"] * 0.0
    sin, cos = sine_cosine(lam)
    turn = seed(variables, "lam", lam.ndim)
    sine, cosine = Dual(sin, turn * cos), Dual(cos, -turn * sin)
    p = SimpleNamespace(**numbers, ahead=numbers["l2"] - numbers["c"])
    parts = letters(p, sine, cosine, variable("sigma", sigma), model)
    return Slopes(variables, entries_of(parts))


def skates(bicycle: Bicycle) -> dict[str, float]:
    """NaN for the spin inertias of wheels of no radius, by their names in the bicycle's notation."""
    names = ("IRyy", "IFyy") if bicycle.bodies is not None else ("C1", "C2")
    radii = bicycle.R1, bicycle.R2
    return {name: math.nan for name, radius in zip(names, radii, strict=True) if radius == 0}


def condition_at(slopes: Slopes, name: str, V: Twofold) -> Dual:
    """p0 … p4 or hurwitz3 at speeds V [m/s] of the designs' shape, with its slope by V among the others."""
    return value_at(slopes, condition_of(slopes, name), V)


def condition_of(slopes: Slopes, name: str) -> list[Dual | None]:
    """P0 … p4, hurwitz3, or q = p2 p3 − p4 p1, as a polynomial in V; None for a power that it cannot have.

    Times powers of V where there is V^−1.
    """
    lowest = min(j for _, j in slopes.entries)
    rows: list[list[Any]] = [[slopes.entries.get((k, j)) for j in range(lowest, 4)] for k in range(5)]
    if name == "hurwitz3":
        return hurwitz3_of(rows)
    if name == "q":
        return difference_of(product_of(rows[2], rows[3]), product_of(rows[4], rows[1]))
    return rows[int(name[1])]


def value_at(slopes: Slopes, polynomial: Sequence[Dual | None], V: Twofold) -> Dual:
    """A polynomial at speeds V [m/s] of the designs' shape, with its slope by V among the others."""
    x: Dual = Dual(V, seed(slopes.variables, "V", V.value.ndim))
    total: Any = None
    for a in reversed(polynomial):
        if total is not None:
            total = total * x
        if a is not None:
            total = a if total is None else total + a
    return total


def by_name(slopes: Slopes, slope: Twofold) -> Mapping[str, Any]:
    """The doubles nearest to a slope's parts, by the variables' names; zero where rounding leaves nothing."""
    values = np.where(np.abs(slope.value) <= _ZERO * slope.size, 0.0, slope.value)
    return dict(zip(slopes.variables, values, strict=True))
