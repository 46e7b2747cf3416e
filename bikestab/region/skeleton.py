"""The curves in a plane of designs where stable intervals appear, vanish or lose an end.

Between these curves the number of a design's stable intervals and the kinds of their ends do not change,
so they say exactly which designs have a stable speed, or one without upper limit. Each curve is
the zero of a function of the table: a discriminant, a resultant or a single coefficient.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats, in_powers
from bikestab.polynomials import derivative, product, settled, total, trimmed
from bikestab.routh import condition_polynomials

CurveName = Literal[
    "fold", "crossing", "capsize fold", "meet", "slow meet", "capsize at infinity", "weave at infinity",
    "capsize at rest", "weave at rest", "singular inertia",
]  # fmt: skip
_POWERS = np.array([0, 1, 2, 3, -1])  # of V, in the columns of a table
_LOG = 700.0  # of the largest and smallest determinants that are told apart


class SpeedPolynomials(NamedTuple):
    """The conditions as polynomials in x = V² (or V where damping mixes the powers), lowest power first.

    ``power`` is 2 or 1. Powers that no cell has are stripped from both ends of each.
    """

    polynomials: dict[str, Floats]
    power: int


def speed_polynomials(table: Floats) -> SpeedPolynomials:
    """The conditions of a table (5, 4, *shape), and q = p2 p3 − p4 p1: at p0 = 0 hurwitz3 is p1 q."""
    conditions = condition_polynomials(table)
    table = in_powers(table)
    first, second = product(table[2], table[3]), product(table[4], table[1])
    conditions["q"] = settled(total(first, -second), total(np.abs(first), np.abs(second)))
    short = {name: trimmed(poly) for name, poly in conditions.items()}
    odd = any(poly[1::2].any() for poly in short.values())
    return SpeedPolynomials(
        {name: poly if odd else poly[::2] for name, poly in short.items()}, 1 if odd else 2
    )


def curve_functions(
    table: Floats,
    names: Sequence[CurveName] = get_args(CurveName),
    polynomials: dict[str, Floats] | None = None,
) -> dict[CurveName, Floats]:
    """Functions of shape (*shape) whose zeros are the curves, for a table (5, 4, *shape).

    ``polynomials`` are those of ``speed_polynomials``, where they are known.

    - fold: hurwitz3 has a double root in V; its discriminant;
    - crossing: p1 and p3 have a common root, where the weave surface crosses itself, a fold as well;
    - capsize fold: p0 has a double root in V, which needs gains that are not constant; its discriminant;
    - meet: p0 and q have a common root, where weave (with a frequency) meets capsize; their resultant;
    - slow meet: the same at zero frequency, where p0 and p1 have a common root;
    - … at infinity, at rest: the highest or lowest coefficient of p0 or hurwitz3;
    - singular inertia: p4 = 0, where an eigenvalue is infinite.
    """
    polynomials = polynomials or speed_polynomials(table).polynomials
    p0, p1, p3, weave, q = (polynomials[name] for name in ("p0", "p1", "p3", "hurwitz3", "q"))
    functions: dict[CurveName, Callable[[], Floats]] = {
        "fold": lambda: _discriminant(weave),
        "crossing": lambda: p3[0] if len(p3) == 1 else _resultant(p1, p3),
        "capsize fold": lambda: _discriminant(p0 if p0[1::2].any() else p0[::2]),
        "meet": lambda: _resultant(q, p0),
        "slow meet": lambda: _resultant(p1, p0),
        "capsize at infinity": lambda: p0[-1],
        "weave at infinity": lambda: weave[-1],
        "capsize at rest": lambda: p0[0],
        "weave at rest": lambda: weave[0],
        "singular inertia": lambda: table[4, 0],
    }
    return {name: functions[name]() for name in names}


def units(table: Floats) -> NDArray[np.intp]:
    """Binary exponents (3,) of units of s, of V and of the polynomial in which tables are of middling size.

    Those that bring the logarithms of the table's entries (their largest in any cell) nearest to zero.
    """
    size = np.abs(table.reshape(*table.shape[:2], -1)).max(axis=2, initial=0.0)
    k, j = np.nonzero(np.isfinite(size) & (size > 0))
    if len(k) < 3:
        return np.zeros(3, np.intp)
    powers = np.array([k, _POWERS[j], np.ones(len(k))]).T
    best = np.linalg.lstsq(powers, -np.log2(size[k, j]), rcond=1e-9)[0]
    return np.rint(best).astype(np.intp)


def in_units(table: Floats, exponents: NDArray[np.intp] | None = None) -> Floats:
    """The table in other units, those of ``units`` or its own best ones: nothing is rounded."""
    s, V, whole = units(table) if exponents is None else exponents
    shift = s * np.arange(5)[:, np.newaxis] + V * _POWERS[: table.shape[1]] + whole
    return np.ldexp(table, shift.reshape(*shift.shape, *(1,) * (table.ndim - 2)))


def undamped(table: Floats) -> Floats | None:
    """The table without damping; None where there is none to leave out."""
    if not (table[3, 0].any() or table[1, 0].any()):
        return None
    plain = table.copy()
    plain[3, 0] = plain[1, 0] = 0.0
    return plain


def _discriminant(f: Floats) -> Floats:
    """Resultant of a polynomial and its slope, divided by the highest coefficient."""
    n = len(f) - 1
    if n < 2:
        return np.ones(f.shape[1:])
    matrix = _sylvester(f, derivative(f))
    matrix[..., n - 2, -1], matrix[..., -1, -1] = 1, n  # that coefficient out of the last column
    return _determinant(matrix)


def _resultant(f: Floats, g: Floats) -> Floats:
    matrix = _sylvester(f, g)
    return _determinant(matrix) if matrix.shape[-1] else np.ones(f.shape[1:])


def _determinant(matrix: Floats) -> Floats:
    sign, log = np.linalg.slogdet(matrix)
    return np.asarray(sign * np.exp(np.clip(log, -_LOG, _LOG)))


def _sylvester(f: Floats, g: Floats) -> Floats:
    """The Sylvester matrix of two polynomials (coefficients along the first axis)."""
    m, n = len(f) - 1, len(g) - 1
    matrix = np.zeros((*f.shape[1:], m + n, m + n))
    for count, poly, offset in ((n, f, 0), (m, g, n)):
        for i in range(count):
            for j, c in enumerate(poly):
                matrix[..., offset + i, i + j] = c
    return matrix
