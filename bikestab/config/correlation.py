"""Correlations of parameters that are drawn: a config's, a covariance file's, a bicycle's own."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.config.values import mistake
from bikestab.draws import correlated
from bikestab.errors import InputError
from bikestab.texts import read_text
from bikestab.units import quantity, shown
from bikestab.variants import own_value

_EXAMPLE = "for example correlation: {[mB, IBxx]: 0.8}"


def pair_of(key: str) -> tuple[str, str]:
    """The two names of a key such as ``[mB, IBxx]``; InputError for another one."""
    names = [name.strip() for name in key.strip().removeprefix("[").removesuffix("]").split(",")]
    if len(names) != 2 or not all(names) or names[0] == names[1]:
        raise InputError(f"{key!r} is no pair of two parameters", hint=_EXAMPLE)
    return names[0], names[1]


def correlations_read(given: Any) -> Any:
    """A config's correlations as numbers by pairs."""
    if not isinstance(given, Mapping):
        raise mistake(f"{shown(given)} is not keys with values", _EXAMPLE)
    found = {}
    for key, value in given.items():
        where = ("ensemble", "correlation", str(key))
        try:
            pair_of(str(key))
            r = quantity(value, {"": 1.0})
        except InputError as error:
            raise mistake(error.problem, error.hint, where) from None
        if not -1 <= r <= 1:
            raise mistake(f"{r:g} is no correlation", "allowed: -1 ... 1", where)
        found[str(key)] = r
    return found


def check_pairs(pairs: Mapping[tuple[str, str], float], drawn: list[str]) -> None:
    """Raise the mistake of pairs that are not drawn, are given twice, or contradict each other."""
    where = ("ensemble", "correlation")
    for pair in pairs:
        for name in pair:
            if name not in drawn:
                raise mistake(f"{name} is not drawn", f"drawn: {', '.join(drawn)}", where)
        if pair[::-1] in pairs:
            raise mistake(f"{pair[0]} and {pair[1]} are given twice", "give them once", where)
    try:
        names = [name for name in drawn if any(name in pair for pair in pairs)]
        if names:
            correlated(names, pairs, 2, 0)
    except InputError as error:
        raise mistake(error.problem, error.hint, where) from None


def with_known(given: Any, bicycle: Any, folder: str | Path = "") -> Any:
    """An ensemble as a config has it, with what a covariance file and the bicycle's own file know of it.

    ``covariance`` is the path of a CSV file: names in the first row, then a row of the matrix for each. What
    it names, and has no distribution, is drawn as normal around the bicycle's own value. For each pair the
    config's own ``correlation`` counts, then the covariance file's; those of the bicycle's file do where the
    config has no ``correlation`` at all, and the covariance file does not tell of the pair.
    """
    if not isinstance(given, dict) or not isinstance(bicycle, Bicycle):
        return given
    ensemble = {key: value for key, value in given.items() if key != "covariance"}
    known: dict[frozenset[str], float] = {}
    if "correlation" not in given:
        known = {frozenset(pair): r for pair, r in bicycle.correlations.items()}
    if "covariance" in given:
        names, matrix = _matrix(given["covariance"], folder)
        deviations = np.sqrt(np.diag(matrix))
        for name, deviation in zip(names, deviations, strict=True):
            own = own_value(bicycle, name)
            if own is None:
                problem = f"the bicycle {bicycle.name!r} has no {name} of its own"
                raise InputError(problem, key=("ensemble", "covariance"), hint="give the bicycle one")
            ensemble.setdefault(name, {"normal": [own, float(deviation)]})
        for i, a in enumerate(names):
            for j, b in enumerate(names[:i]):
                r = matrix[i, j] / (deviations[i] * deviations[j])
                known[frozenset((b, a))] = float(np.clip(r, -1, 1))
    typed = ensemble.get("correlation", {})
    if isinstance(typed, Mapping):  # what is none is told of later
        pairs = {_pair(str(key)) for key in typed}
        linked = {
            f"[{', '.join(sorted(pair, key=[*ensemble].index))}]": r
            for pair, r in known.items()
            if r and pair <= ensemble.keys() and pair not in pairs
        }
        if linked:
            ensemble["correlation"] = {**linked, **typed}
    return ensemble


def _pair(key: str) -> frozenset[str]:
    try:
        return frozenset(pair_of(key))
    except InputError:  # told of with its key, later
        return frozenset()


def _matrix(path: Any, folder: str | Path) -> tuple[list[str], Any]:
    where = ("ensemble", "covariance")
    if not isinstance(path, str):
        raise InputError(
            f"{shown(path)} is no file", key=where, hint="a CSV file with names in its first row"
        )
    rows = [row for row in csv.reader(read_text(Path(folder, path)).splitlines()) if row]
    names = [name.strip() for name in rows[0]] if rows else []
    try:
        matrix = np.array([[float(cell) for cell in row] for row in rows[1:]])
    except ValueError:
        matrix = np.empty(0)
    if not names or matrix.shape != (len(names), len(names)) or not np.all(np.isfinite(matrix)):
        problem = f"{path} is no covariance matrix"
        raise InputError(
            problem, key=where, hint="names in the first row, then as many rows of as many numbers"
        )
    if not np.allclose(matrix, matrix.T, rtol=1e-9, atol=0) or not np.all(np.diag(matrix) > 0):
        problem = f"{path} is not symmetric, or has a variance that is not positive"
        raise InputError(problem, key=where, hint="allowed: a symmetric matrix of variances and covariances")
    return names, matrix
