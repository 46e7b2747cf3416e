"""(bicycle, λ, σ) → the table of its characteristic polynomial.

The table P has P[k, j] = the coefficient of s^k V^j, k = 0…4, j = 0…3, with any trailing shape.
Equation numbers are those of Dikarev, Dikareva and Fufaev (1981); docs/theory.md has the derivation.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.bicycle import Bicycle

if TYPE_CHECKING:
    from bikestab.machines import Machines

Floats: TypeAlias = NDArray[np.float64]
Model = Literal["refined", "unrefined"]
MODELS: tuple[Model, ...] = ("refined", "unrefined")

# A sum of terms that cancel exactly leaves the rounding of its terms instead of zero: some 1e-16 of
# their size for each operation on the way. The longest way from the parameters to an entry of the
# table is about 16 operations; below that share of its terms' size a sum says nothing but its noise.
# A two-mass-skate bicycle, whose V² term of p0 is zero, would otherwise get a capsize speed of 1e8.
NOISE = 16 * np.finfo(float).eps


class Coefficients(NamedTuple):
    """Coefficients of the equations of motion (1.5), without the damping term c δ/V of b1."""

    a0: Tracked
    a1: Tracked
    a2: Tracked
    a3: Tracked
    a4: Tracked
    a5: Tracked
    b0: Tracked
    b1: Tracked
    b2: Tracked
    b3: Tracked
    b4: Tracked
    b5: Tracked
    b6: Tracked


class Tracked:
    """An array with the summed absolute values of the terms that formed it.

    ``settled()`` is the value with exact zeros where it is no more than its terms' rounding.
    """

    __slots__ = ("size", "value")
    __array_ufunc__ = None  # an array times a Tracked is a Tracked

    def __init__(self, value: ArrayLike, size: ArrayLike | None = None) -> None:
        self.value: Floats = np.asarray(value, dtype=float)
        self.size: Floats = np.abs(self.value) if size is None else np.asarray(size)

    def __add__(self, other: Tracked) -> Tracked:
        return Tracked(self.value + other.value, self.size + other.size)

    def __sub__(self, other: Tracked) -> Tracked:
        return Tracked(self.value - other.value, self.size + other.size)

    def __mul__(self, other: Tracked | float) -> Tracked:
        if isinstance(other, Tracked):
            return Tracked(self.value * other.value, self.size * other.size)
        return Tracked(self.value * other, self.size * abs(other))

    __rmul__ = __mul__

    def settled(self) -> Floats:
        return np.where(np.abs(self.value) <= NOISE * self.size, 0.0, self.value)


def coefficients(
    bicycle: Bicycle | Machines, lam: ArrayLike, sigma: ArrayLike, *, model: Model = "refined"
) -> Coefficients:
    """The coefficients a0…a5, b0…b6 of equations (1.5) for arrays of λ [rad] and σ [1].

    ``bicycle`` may be many machines, whose parameters broadcast against λ and σ.
    ``model="unrefined"`` leaves the refinement of the paper's (1.2) out of the gravity terms.
    Source: (1.3), (1.5) and section 2 of the paper, with the OCR's subscripts repaired.
    """
    if model not in MODELS:
        raise ValueError(f"model is {model!r}, not one of {MODELS}")
    p = bicycle
    cos, sin = Tracked(np.cos(lam)), Tracked(np.sin(lam))
    g, c = p.g, p.c

    c1 = Tracked(np.asarray(sigma) * c) * cos
    d = p.h2 * sin + Tracked(p.l2 - c, p.l2 + c) * cos - c1
    C1 = Tracked(p.C1 / (p.R1 + 1 * (p.C1 == 0)))  # C1° and C2°: angular momentum per unit of speed;
    C2 = Tracked(p.C2 / (p.R2 + 1 * (p.C2 == 0)))  # what does not spin may be a skate with R = 0
    l = Tracked(p.m1 * p.l1) + Tracked(p.m2 * p.l2)  # noqa: E741  # the paper's letter
    h = Tracked(p.m1 * p.h1) + Tracked(p.m2 * p.h2)
    md = p.m2 * d
    lc = l * c1 * (1 / c)
    S = md + lc if model == "refined" else md

    D2 = Tracked(p.D2)
    J = md * d + p.A2 * sin * sin - 2 * D2 * sin * cos + p.B2 * cos * cos
    J1 = Tracked(p.m1 * p.h1**2 + p.A1 + p.m2 * p.h2**2 + p.A2)
    J2 = Tracked(p.m1 * p.l1**2 + p.B1 + p.m2 * p.l2**2 + p.B2)
    J3 = p.h2 * md + p.A2 * sin - D2 * cos
    J4 = p.l2 * md - D2 * sin + p.B2 * cos
    J12 = Tracked(p.m1 * p.h1 * p.l1) + Tracked(p.D1) + Tracked(p.m2 * p.h2 * p.l2) - D2  # (1.3)

    return Coefficients(
        a0=c * J1,
        a1=c * g * h,
        a2=c * J3 + c1 * J12,
        a3=(J12 + c * C2) * cos + c1 * (h + C1 + C2),
        a4=c * g * S,
        a5=(h + C1 + C2) * cos,
        b0=c * J + 2 * c1 * J4 + c1 * c1 * J2 * (1 / c),
        b1=J4 * cos + c1 * (md + J2 * cos * (1 / c) + lc),
        b2=(md + C2 * sin + lc) * cos,
        b3=c * g * S * sin,
        b4=c * J3 + c1 * J12,
        b5=c * C2 * cos + c1 * (C1 + C2),
        b6=c * g * S,
    )  # (1.5)


def characteristic_table(
    bicycle: Bicycle | Machines, lam: ArrayLike, sigma: ArrayLike, *, model: Model = "refined"
) -> Floats:
    """The table P[k, j] of s^k V^j for arrays of λ [rad] and σ [1] that broadcast together.

    Returns an array of shape (5, 4, *shape). Entries that are nothing but the rounding of terms
    which cancel are exact zeros (see ``NOISE``). The damping is the bicycle's ``delta``.
    ``bicycle`` may be many machines, whose parameters broadcast against λ and σ.
    Source: (2.1) of the paper, in real time and with ε = 1/V².
    """
    a0, a1, a2, a3, a4, a5, b0, b1, b2, b3, b4, b5, b6 = coefficients(bicycle, lam, sigma, model=model)
    c_delta = Tracked(bicycle.c * bicycle.delta)
    entries = {
        (4, 0): a0 * b0 - a2 * b4,
        (3, 1): a0 * b1 + a2 * b5 - a3 * b4,
        (3, 0): a0 * c_delta,
        (2, 2): a0 * b2 + a3 * b5 - a5 * b4,
        (2, 0): a2 * b6 + a4 * b4 - a0 * b3 - a1 * b0,
        (1, 3): a5 * b5,
        (1, 1): a3 * b6 - a1 * b1 - a4 * b5,
        (1, 0): Tracked(0.0) - a1 * c_delta,
        (0, 2): a5 * b6 - a1 * b2,
        (0, 0): a1 * b3 - a4 * b6,
    }
    table = np.zeros((5, 4, *np.broadcast_shapes(np.shape(lam), np.shape(sigma), bicycle.shape)))
    for index, entry in entries.items():
        table[index] = entry.settled()
    return table


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
