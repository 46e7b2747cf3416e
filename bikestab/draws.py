"""Normal numbers drawn at random, correlated; parameters of them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from bikestab.errors import InputError
from bikestab.machines import standard_normal, uniforms

Floats = NDArray[np.float64]
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
    normal = correlated(names, correlations, samples, seed)
    return {name: values[name] + deviations[name] * normal[name] for name in names}


def correlated(
    names: list[str], correlations: Mapping[tuple[str, str], float], samples: int, seed: int
) -> dict[str, Floats]:
    """Standard normal numbers (sample,) for each name, correlated.

    InputError, with the key ``sd``, for correlations that contradict each other.
    """
    independent = np.array([standard_normal(uniforms(seed, name, samples)) for name in names])
    normal = _factor(correlation_matrix(names, correlations)) @ independent
    return dict(zip(names, normal, strict=True))


def share_below(normal: Floats) -> Floats:
    """The standard normal distribution at these numbers, strictly between 0 and 1."""
    from statistics import NormalDist

    shares = np.fromiter(map(NormalDist().cdf, normal.tolist()), float, len(normal))
    return np.clip(shares, 2.0**-53, 1 - 2.0**-53)


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


def evenly(dimensions: int, number: int) -> Floats:
    """Points (number, dimensions) spread evenly over the unit box: multiples of square roots of primes.

    Quadratic irrationals are far from all fractions, so that no slice along an axis is left out (Richtmyer).
    """
    primes: list[int] = []
    candidate = 2
    while len(primes) < dimensions:
        primes += [candidate] * all(candidate % prime for prime in primes)
        candidate += 1
    return np.arange(1, number + 1)[:, np.newaxis] * np.sqrt(np.array(primes, dtype=float)) % 1.0
