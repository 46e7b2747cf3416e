"""Pendulum measurements as BicycleParameters keeps them → the 25 parameters, by that package's own reduction.

Its uncertainties come with their correlations: parameters that are worked out from the same measurements
vary together.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from itertools import combinations
from typing import Any, NamedTuple

from bikestab.errors import InputError
from bikestab.formats.equalities import Measured
from bikestab.notation import MEIJAARD, OPTIONAL

_SURE = {"dF", "dR", "TtP1", "TtB1"}  # travel of the wheels, periods of the torsional pendulum
_LEAST = 1e-9  # of a correlation that is kept: less is rounding


class Reduced(NamedTuple):
    """The parameters, their standard deviations, and the correlations of pairs of them."""

    values: dict[str, float]
    deviations: dict[str, float]
    correlations: dict[tuple[str, str], float]


def looks_like(keys: Mapping[str, Any]) -> bool:
    """Whether these are keys of such measurements, and no parameters."""
    return len(_SURE & keys.keys()) > 1


def reduce(entries: Mapping[str, Measured]) -> Reduced:
    """The parameters that the measurements give; InputError for what is missing, or without the package."""
    try:
        from bicycleparameters.main import calculate_benchmark_from_measured
        from uncertainties import correlation_matrix, ufloat
    except ImportError:
        raise InputError(
            "these are pendulum measurements, which BicycleParameters turns into parameters",
            hint="install it: pip install 'bikestab[measured]'",
        ) from None
    given: dict[str, Any] = {}
    for key, (value, deviation, _) in entries.items():
        if isinstance(value, str):
            raise InputError(f"{value!r} is not a number", key=(key,), hint="allowed: a number +/- another")
        with warnings.catch_warnings(action="ignore"):  # of a deviation of zero
            given[key] = ufloat(value, deviation)
    try:
        with warnings.catch_warnings(action="ignore"):  # of numpy about the package's matrices
            found = calculate_benchmark_from_measured(given)[0]
    except KeyError as error:
        key = str(error.args[0])
        hint = "a file of measurements has lengths, angles, masses and periods of every part"
        raise InputError(f"the measurement {key} is missing", hint=hint) from None
    except (ArithmeticError, AttributeError, ValueError, TypeError, IndexError) as error:
        problem = f"BicycleParameters cannot reduce these measurements ({error})"
        hint = "compare them with a file of its own, such as its RigidRawParameters"
        raise InputError(problem, hint=hint) from None
    missing = [key for key in MEIJAARD if key not in found and key not in OPTIONAL]
    if missing:
        hint = "a file of measurements has lengths, angles, masses and periods of every part"
        raise InputError(f"the measurements give no {', '.join(missing)}", hint=hint)
    parameters = {key: found[key] for key in MEIJAARD if key in found}
    values = {key: float(getattr(value, "nominal_value", value)) for key, value in parameters.items()}
    uncertain = {key: value for key, value in parameters.items() if getattr(value, "std_dev", 0)}
    deviations = {key: float(value.std_dev) for key, value in uncertain.items()}
    matrix: Any = correlation_matrix(list(uncertain.values())) if uncertain else []
    pairs = combinations(enumerate(uncertain), 2)
    correlations = {(a, b): float(matrix[i, j]) for (i, a), (j, b) in pairs if abs(matrix[i, j]) > _LEAST}
    return Reduced(values, deviations, correlations)
