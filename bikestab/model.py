"""(bicycle, λ, σ) → the table of its characteristic polynomial.

The table P has P[k, j] = the coefficient of s^k V^j, k = 0…4, j = 0…3, with any trailing shape; of a machine
with gains in proportion to 1/V it has one column more, the last, of V^−1.
Equation numbers are those of Dikarev, Dikareva and Fufaev (1981); docs/theory.md has the derivation.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import prod
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.bicycle import Bicycle
from bikestab.gains import GAINS, infinite_at_rest, rate_and_power
from bikestab.letters import MODELS as MODELS
from bikestab.letters import Model as Model
from bikestab.letters import determinant, letters_of, unordered_letters_of
from bikestab.rounding import ENTRY
from bikestab.unordered import chosen

if TYPE_CHECKING:
    from bikestab.machines import Machines

Floats: TypeAlias = NDArray[np.float64]
_CELLS = 3 << 12  # worked on at a time
_POOR = 2.0**-16  # share of its terms below which the determinant of M is formed otherwise
_POOR_DOUBLE = 2.0**-12  # the same in double precision


class Coefficients(NamedTuple):
    """Coefficients of the equations of motion (1.5), without the damping term c δ/V of b1."""

    a0: Any
    a1: Any
    a2: Any
    a3: Any
    a4: Any
    a5: Any
    b0: Any
    b1: Any
    b2: Any
    b3: Any
    b4: Any
    b5: Any
    b6: Any


class ExactTable(NamedTuple):
    """A table (5, 4, *shape) with bounds: the true one for exactly these inputs is within ``error`` of
    value + rest, and ``value`` is the nearest double. Entries that are zero whatever the numbers are exact
    zeros, without error.
    """

    value: Floats
    rest: Floats
    error: Floats

    @property
    def shape(self) -> tuple[int, ...]:
        return self.value.shape

    def reshape(self, *shape: int) -> ExactTable:
        """The same in another shape."""
        return ExactTable(*(each.reshape(shape) for each in self))


def exact_table(
    bicycle: Bicycle | Machines, lam: ArrayLike, sigma: ArrayLike, *, model: Model = "refined"
) -> ExactTable:
    """The table of s^k V^j for arrays of λ [rad] and σ [1] that broadcast together, with bounds.

    Formed in twice double precision: a sum of terms that cancel keeps what is left of them, however little.
    What cancels identically is left out of the expressions, so that a two-mass-skate bicycle has no V² term
    in p0. ``bicycle`` may be many machines, whose parameters broadcast against λ and σ; those of four
    rigid bodies are reduced to two parts on the way. The damping is the bicycle's ``delta``.
    Source: (2.1) of the paper, in real time and with ε = 1/V²; docs/theory.md, section 6.
    """
    shape, parts = _shape_and_parts(bicycle, lam, sigma)
    table = np.zeros((3, 5, _columns(bicycle), *shape))
    for some, tilt, trail in parts:
        letters = unordered_letters_of(bicycle, tilt, trail, model)
        entries = entries_of(letters)
        p4 = entries[4, 0]
        poor = abs(p4.value + p4.rest) < _POOR * p4.size
        if np.any(poor):
            entries[4, 0] = chosen(poor, determinant(letters), p4)
        for (k, j), entry in entries.items():
            if shape and isinstance(entry.value, np.ndarray):
                entry.put(table[0, k, j, some], table[1, k, j, some])
                np.multiply(ENTRY, entry.size, table[2, k, j, some])
            else:
                a = entry.ordered()
                table[0, k, j, some], table[1, k, j, some] = a.value, a.rest
                table[2, k, j, some] = ENTRY * a.size
    return ExactTable(*table)


def characteristic_table(
    bicycle: Bicycle | Machines, lam: ArrayLike, sigma: ArrayLike, *, model: Model = "refined"
) -> Floats:
    """The table P[k, j] of s^k V^j for arrays of λ [rad] and σ [1] that broadcast together.

    Returns an array of shape (5, 4, *shape). The same expressions as in ``exact_table`` in double precision:
    each entry is right to some units of rounding of its terms, and zero where these cancel identically.
    """
    shape, parts = _shape_and_parts(bicycle, lam, sigma)
    table = np.zeros((5, _columns(bicycle), *shape))
    for some, tilt, trail in parts:
        letters = letters_of(bicycle, tilt, trail, model, twofold=False)
        entries = entries_of(letters)
        product = letters.c * letters.c * letters.J1 * letters.M22
        poor = entries[4, 0] < _POOR_DOUBLE * product
        if np.any(poor):
            entries[4, 0] = np.where(poor, determinant(letters), entries[4, 0])
        for (k, j), entry in entries.items():
            table[k, j, some] = entry
    return table


def _columns(bicycle: Bicycle | Machines) -> int:
    """Those of V^0 … V^3, and of V^−1 where it is needed."""
    return 5 if infinite_at_rest(dict(getattr(bicycle, "gains", ()))) else 4


def in_powers(table: Floats) -> Floats:
    """p0 … p4 as polynomials in V, lowest power along the second axis; times V where there is V^−1."""
    return np.roll(table, 1, axis=1) if table.shape[1] > 4 else table


_Part = tuple[Any, ArrayLike, ArrayLike]


def _shape_and_parts(
    bicycle: Bicycle | Machines, lam: ArrayLike, sigma: ArrayLike
) -> tuple[tuple[int, ...], list[_Part]]:
    """The table's trailing shape; parts of its first axis whose temporaries fit the cache, with λ and σ."""
    lam, sigma = np.asarray(lam, dtype=float), np.asarray(sigma, dtype=float)
    shape = np.broadcast_shapes(lam.shape, sigma.shape, bicycle.shape)
    if not shape:
        return shape, [(..., float(lam), float(sigma))]
    if bicycle.shape:
        return shape, [(..., lam, sigma)]
    step = max(1, _CELLS * shape[0] // max(prod(shape), 1))
    slices = [slice(start, start + step) for start in range(0, shape[0], step)]

    def part(x: Floats, some: slice) -> Floats:
        return x[some] if x.ndim == len(shape) and len(x) > 1 else x

    return shape, [(some, part(lam, some), part(sigma, some)) for some in slices]


def coefficients(
    bicycle: Bicycle | Machines, lam: ArrayLike, sigma: ArrayLike, *, model: Model = "refined"
) -> Coefficients:
    """The coefficients a0…a5, b0…b6 of equations (1.5) for arrays of λ [rad] and σ [1].

    ``bicycle`` may be many machines, whose parameters broadcast against λ and σ.
    ``model="unrefined"`` leaves the refinement of the paper's (1.2) out of the gravity terms.
    Source: (1.3), (1.5) and section 2 of the paper, with the OCR's subscripts repaired.
    """
    return coefficients_of(letters_of(bicycle, lam, sigma, model))


def coefficients_of(n: SimpleNamespace) -> Coefficients:
    """``coefficients`` of letters that are numbers of any kind."""
    c = n.c
    return Coefficients(
        a0=c * n.J1,
        a1=c * n.g * n.h,
        a2=c * n.M12,
        a3=(n.Q + c * n.T) * n.cos,
        a4=c * n.g * n.S,
        a5=(n.h + n.C1 + n.C2) * n.cos,
        b0=c * n.M22,
        b1=n.N * n.cos,
        b2=n.W * n.cos,
        b3=c * n.g * n.S * n.sin,
        b4=c * n.M12,
        b5=c * n.T * n.cos,
        b6=c * n.g * n.S,
    )  # (1.5)


def entries_of(n: SimpleNamespace) -> dict[tuple[int, int], Any]:
    """The entries (k, j) of the table, without terms that cancel identically.

    The wheels' spins do so in p3 and in the V term of p1; p0 is a product but for the refinement.
    """
    c, cos = n.c, n.cos
    along, weight = c * cos, c * n.g
    down = weight * cos
    turning = n.C1 * n.S + n.C2 * n.U  # in the V² term of p0
    if n.missing is not None:
        turning = turning - n.missing
    spins = n.C1 + n.C2
    entries = {
        (4, 0): c * c * (n.J1 * n.M22 - n.M12 * n.M12),
        (3, 1): along * (n.J1 * n.N - n.M12 * n.Q),
        (3, 0): c * c * n.delta * n.J1,
        (2, 2): along * (n.J1 * n.W - (n.h + spins) * n.M12 + cos * (n.T * (n.Q + c * n.T))),
        (2, 0): weight * c * (n.S * (2 * n.M12 - n.J1 * n.sin) - n.h * n.M22),
        (1, 3): along * cos * ((n.h + spins) * n.T),
        (1, 1): down * (n.Q * n.S - n.h * n.N),
        (1, 0): weight * c * n.delta * (-n.h),
        (0, 2): down * turning,
        (0, 0): -(weight * weight * (n.S * n.U)),
    }
    if gains := {name: gain for name, gain in vars(n.p).items() if name in GAINS}:
        _add_feedback(entries, n, gains)
    return entries


def _add_feedback(entries: dict[tuple[int, int], Any], n: SimpleNamespace, gains: Mapping[str, Any]) -> None:
    """Add what a steer torque −k q has in the determinant: its column of M s² + C1 V s + g K0 + V² K2."""
    c, cos = n.c, n.cos
    of_steer = {(2, 0): c * c * n.J1, (0, 0): c * c * n.g * (-n.h)}
    of_roll = {
        (2, 0): c * c * (-n.M12), (1, 1): c * cos * (-(n.Q + c * n.T)),
        (0, 0): c * c * n.g * n.S, (0, 2): c * cos * (-(n.h + n.C1 + n.C2)),
    }  # fmt: skip
    for name, gain in gains.items():
        roll, rate, power = rate_and_power(name)
        for (k, j), factor in (of_roll if roll else of_steer).items():
            key, term = (k + rate, j + power), factor * gain
            entries[key] = entries[key] + term if key in entries else term


def canonical_matrices(
    bicycle: Bicycle, lam: float, sigma: float, *, model: Model = "refined"
) -> tuple[Floats, Floats, Floats, Floats]:
    """M [kg m²], C1 [kg m], K0 [kg m] and K2 [kg] of M q'' + V C1 q' + (g K0 + V² K2) q = 0.

    q = (lean, steer) with the signs of Meijaard et al. (2007), their equation (5.3); no damping.
    """
    a0, a1, a2, a3, a4, a5, b0, b1, b2, b3, b4, b5, b6 = (
        term.value / bicycle.c for term in coefficients(bicycle, lam, sigma, model=model)
    )
    zero = np.zeros_like(a3)
    M = np.array([[a0, a2], [b4, b0]])
    C1 = np.array([[zero, a3], [-b5, b1]])
    K0 = np.array([[-a1, -a4], [-b6, -b3]]) / bicycle.g
    K2 = np.array([[zero, a5], [zero, b2]])
    return M, C1, K0, K2
