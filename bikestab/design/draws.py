"""Parameters drawn at random from normal distributions, correlated."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from bikestab.errors import InputError
from bikestab.machines import standard_normal, uniforms
from bikestab.model import Floats

_ROUNDING = 1e-12  # of an eigenvalue, for each row: correlations carry errors of some 1e-16


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
    normal = _factor(correlation_matrix(names, correlations)) @ independent
    return {name: values[name] + deviations[name] * z for name, z in zip(names, normal, strict=True)}


def _factor(matrix: Floats) -> Floats:
    """F with F Fᵀ the matrix, lower triangular where there is such a one; InputError where there is no F.

    Correlations of ±1, of parameters that follow from one measurement, make the matrix singular.
    """
    try:
        return np.asarray(np.linalg.cholesky(matrix), dtype=float)
    except np.linalg.LinAlgError:
        eigenvalues, vectors = np.linalg.eigh(matrix)
    if eigenvalues[0] < -_ROUNDING * len(matrix):
        hint = "allowed: a matrix without negative eigenvalues"
        raise InputError("these correlations contradict each other", key=("sd",), hint=hint)
    factor: Floats = vectors * np.sqrt(np.maximum(eigenvalues, 0.0))
    return factor


def correlation_matrix(names: list[str], correlations: Mapping[tuple[str, str], float]) -> Floats:
    """The correlations among some parameters, ones on the diagonal."""
    matrix = np.eye(len(names))
    for (a, b), r in correlations.items():
        if a in names and b in names and a != b:
            matrix[names.index(a), names.index(b)] = matrix[names.index(b), names.index(a)] = r
    return matrix
