"""Parameters drawn at random from normal distributions, correlated."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from bikestab.errors import InputError
from bikestab.machines import standard_normal, uniforms
from bikestab.model import Floats


def drawn(
    values: Mapping[str, float],
    names: list[str],
    deviations: Mapping[str, float],
    correlations: Mapping[tuple[str, str], float],
    samples: int,
    seed: int,
) -> dict[str, Floats]:
    """Samples of parameters: numbers that depend on nothing but seed and name, then correlated."""
    independent = np.array([standard_normal(uniforms(seed, name, samples)) for name in names])
    try:
        factor = np.linalg.cholesky(correlation_matrix(names, correlations))
    except np.linalg.LinAlgError:
        problem = "these correlations contradict each other"
        raise InputError(problem, key=("sd",), hint="allowed: a positive definite matrix") from None
    normal = factor @ independent
    return {name: values[name] + deviations[name] * z for name, z in zip(names, normal, strict=True)}


def correlation_matrix(names: list[str], correlations: Mapping[tuple[str, str], float]) -> Floats:
    """The correlations among some parameters, ones on the diagonal."""
    matrix = np.eye(len(names))
    for (a, b), r in correlations.items():
        if a in names and b in names and a != b:
            matrix[names.index(a), names.index(b)] = matrix[names.index(b), names.index(a)] = r
    return matrix
