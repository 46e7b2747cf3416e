"""(bicycle, model) → what the page computes from: its table and its motion as exact formulas.

Coefficients go over as two doubles each, nearest to the exact fractions.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from bikestab.algebra import Polynomial
from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.formulas import coefficient_formulas, table_formulas
from bikestab.gains import GAINS, rate_and_power
from bikestab.letters import Model
from bikestab.presets import preset_names

Formula = list[list[float]]
_ANY = "dikarev1981"  # in the notation of two parts, without feedback: each of its numbers is set
_DESIGN = ("lam", "sigma")
_SPEEDS = 4  # powers of V in the table of a machine without feedback


def machine_record(bicycle: Bicycle, model: Model, swept: Mapping[str, float]) -> dict[str, Any]:
    """A machine as page/table.mjs takes it: formulas are lists of (powers of sin λ, cos λ, σ, value, rest).

    ``swept`` is what a sweep changes. Where gains are in proportion to 1/V, the whole table is times V.
    """
    table = table_formulas(bicycle, model=model).entries
    lowest = min(j for _, j in table)
    return {
        "name": bicycle.name,
        "source": bicycle.source,
        "command": command_options(bicycle, model, swept),
        "table": [[_formula(table.get((k, j))) for j in range(lowest, _SPEEDS)] for k in range(5)],
        "motion": _motion(bicycle, model),
        "own": None if bicycle.lam is None or bicycle.sigma is None else [bicycle.lam, bicycle.sigma],
        "delta": bicycle.delta,
        "parameters": bicycle.numbers(),
        "c": bicycle.c,
        "R1": bicycle.R1,
        "R2": bicycle.R2,
        "parts": [
            {"m": bicycle.m1, "l": bicycle.l1, "h": bicycle.h1},
            {"m": bicycle.m2, "l": bicycle.l2, "h": bicycle.h2},
        ],
    }


def command_options(bicycle: Bicycle, model: Model, swept: Mapping[str, float]) -> str:
    """The options of the command line that mean this machine for whoever has the page alone.

    They name a preset where it is one, with what a sweep gives it, or else each number of its two parts.
    """
    named = _preset(bicycle, swept)
    options = [f"--bicycle {bicycle.name if named else _ANY}"]
    if named is not None:
        values = {name: value for name, value in swept.items() if name != "delta"}
        values |= _changed(named, bicycle)
    else:
        values = {name: x for name, x in bicycle.numbers().items() if x is not None and name not in _DESIGN}
    for name, value in values.items():
        options.append(f"--delta {value!r}" if name == "delta" else f"--set {name}={value!r}")
    if model != "refined":
        options.append(f"--model {model}")
    return " ".join(options)


def _preset(bicycle: Bicycle, swept: Mapping[str, float]) -> Bicycle | None:
    """The preset of this name with the values of a sweep but for damping, if the bicycle is it.

    Its damping and gains may be others: both notations have the same names for these.
    """
    if bicycle.name not in preset_names():
        return None
    values = {name: value for name, value in swept.items() if name != "delta"}
    try:
        preset = Bicycle.preset(bicycle.name).replaced(values)
    except InputError:  # a parameter that the preset has not
        return None
    return preset if _changed(preset, bicycle).keys() <= {"delta", *GAINS} else None


def _changed(one: Bicycle, other: Bicycle) -> dict[str, float]:
    """What must be set for the one to be the other, but its design; what is no parameter is a gain of 0."""
    before, then = one.numbers(), other.numbers()
    names = [name for name in {**before, **then} if name not in _DESIGN]
    return {name: then.get(name) or 0.0 for name in names if then.get(name) != before.get(name)}


def _motion(bicycle: Bicycle, model: Model) -> dict[str, list[list[Formula]]]:
    """M q'' + (C0 + V C1) q' + (K0 + V² K2) q = 0 with q = (roll, steer), each times the wheelbase.

    The signs are those of Meijaard et al. (2007), equation (5.3); the entries are those of (1.5). Gains add
    to what their power of V is named by, K1 or K-1 among them.
    """
    n = coefficient_formulas(bicycle, model=model)
    zero = Polynomial(n.a0.number, {})
    damping = Polynomial.constant(n.a0.number, bicycle.c * bicycle.delta)
    matrices = {
        "M": [[n.a0, n.a2], [n.b4, n.b0]],
        "C0": [[zero, zero], [zero, damping]],
        "C1": [[zero, n.a3], [-n.b5, n.b1]],
        "K0": [[-n.a1, -n.a4], [-n.b6, -n.b3]],
        "K2": [[zero, n.a5], [zero, n.b2]],
    }
    for name, gain in bicycle.gains:
        of_roll, rate, power = rate_and_power(name)
        torque = matrices.setdefault(f"{'KC'[rate]}{power}", [[zero, zero], [zero, zero]])[1]
        added = Polynomial.constant(n.a0.number, Fraction(bicycle.c) * Fraction(gain))
        column = 0 if of_roll else 1
        torque[column] = torque[column] + added
    return {name: [[_formula(entry) for entry in row] for row in matrix] for name, matrix in matrices.items()}


def _formula(polynomial: Polynomial | None) -> Formula:
    terms = sorted(polynomial.terms.items()) if polynomial else []
    rows = []
    for powers, coefficient in terms:
        value = float(coefficient)
        rows.append([*powers[:3], value, float(coefficient - type(coefficient)(value))])
    return rows
