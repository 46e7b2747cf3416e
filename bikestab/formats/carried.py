"""Uncertainties of keys that stand for parameters, such as a head angle → those of the parameters.

The linear rule: derivatives of the parameters by the keys, with the correlations that follow.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from itertools import combinations
from typing import Any, TypeAlias

import numpy as np

from bikestab.errors import InputError
from bikestab.formats.found import Found
from bikestab.notation import MEASURED
from bikestab.units import in_its_unit

_STANDING = {"R", *MEASURED}
_STEP = 1e-6  # of a value: the error of central differences is of its square
_DIGITS = 9  # of a derivative that are kept

Parameters: TypeAlias = Callable[[Mapping[Any, Any]], Mapping[str, float]]


def carried(found: Found, parameters: Parameters) -> Found:
    """The same with standard deviations and correlations of the ``parameters`` that its values stand for.

    ``parameters`` gives these of any values. InputError, with its key, for an uncertainty that none has.
    """
    values, deviations = found.values, found.deviations
    if "rider.inertia_mass" in deviations:
        problem = "is a mass to compare with, and has no uncertainty"
        raise InputError(problem, key=("rider.inertia_mass",), hint="write it without ±")
    if not deviations or not _STANDING & values.keys():
        return found
    keys = list(deviations)
    slopes = {key: _slopes(values, key, parameters) for key in keys}
    for key, column in slopes.items():
        if not any(column.values()):
            problem = "its uncertainty changes nothing, as the other keys give what it stands for"
            raise InputError(problem, key=(key,), hint="write one of them alone, or this one without ±")
    names = [name for name in parameters(values) if any(slopes[key][name] for key in keys)]
    among = np.eye(len(keys))
    for (a, b), r in found.correlations.items():
        if a in keys and b in keys:
            among[keys.index(a), keys.index(b)] = among[keys.index(b), keys.index(a)] = r
    parts = np.array([[slopes[key][name] * deviations[key] for key in keys] for name in names])
    covariance = parts @ among @ parts.T
    sd = np.sqrt(np.diag(covariance))
    correlations = {
        (names[i], names[j]): float(np.clip(covariance[i, j] / (sd[i] * sd[j]), -1, 1))
        for i, j in combinations(range(len(names)), 2)
        if covariance[i, j]
    }
    own = dict(zip(names, sd.tolist(), strict=True))
    return dataclasses.replace(found, deviations=own, correlations=correlations)


def _slopes(values: Mapping[Any, Any], key: str, parameters: Parameters) -> dict[str, float]:
    """Derivatives of the parameters by what stands at a key."""
    own = values[key]
    value = float(in_its_unit(own) or 0.0) if isinstance(own, str) else float(own)
    step = _STEP * max(abs(value), 1e-3)
    above, below = value + step, value - step
    high, low = (parameters({**values, key: x}) for x in (above, below))
    slopes = {name: (high[name] - low[name]) / (above - below) for name in high}
    return {name: float(f"{slope:.{_DIGITS}g}") for name, slope in slopes.items()}
