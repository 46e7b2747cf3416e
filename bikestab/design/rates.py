"""The lowest growth rate of a design over the speeds, and its derivatives by every parameter.

At the best speed the largest real part is least. There one eigenvalue's real part is stationary, or those of
two cross, or a real pair meets and parts: each has its own derivative, by the implicit function theorem.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.design.criteria import extreme
from bikestab.design.wanted import V_MAX
from bikestab.model import Floats
from bikestab.slopes import Slopes
from bikestab.spectrum import eigenvalues_of, growth_rate_of

_SAMPLES = 3001  # speeds among which the lowest is looked for
_SAME = 1e-5  # share of the largest eigenvalue within which two real parts are one
_STEPS = 6  # of Newton's method

Complex = NDArray[np.complex128]


class Rate(NamedTuple):
    """The lowest growth rate [s⁻¹] up to V_MAX, at the speed V [m/s]; its derivatives at constant λ and σ.

    ``kind`` is how it is the lowest: ``smooth``, ``crossing`` of two motions, ``meeting`` of a real pair, or
    ``end`` of the speeds.
    """

    value: float
    V: float
    kind: str
    slope: dict[str, float]


class _Local(NamedTuple):
    """The characteristic polynomial and its derivatives at an eigenvalue s and a speed V."""

    P: complex
    P_s: complex
    P_V: complex
    P_ss: complex
    P_sV: complex
    P_VV: complex
    P_p: Complex
    P_sp: Complex

    @property
    def s_V(self) -> complex:
        return -self.P_V / self.P_s

    @property
    def s_VV(self) -> complex:
        return -(self.P_VV + 2 * self.P_sV * self.s_V + self.P_ss * self.s_V**2) / self.P_s

    @property
    def s_p(self) -> Complex:
        return -self.P_p / self.P_s


def best_rate(slopes: Slopes) -> Rate:
    """The lowest growth rate of one design, from its table with slopes."""
    table, by = _tables(slopes)
    V, value = _lowest(table)
    if not np.isfinite(value):  # p4 = 0: an eigenvalue is infinite
        return _rate(slopes, value, V, "end", np.full(len(slopes.variables), np.nan))
    s = eigenvalues_of(table, V)
    size = float(np.abs(s).max())
    leading = s[(s.real > value - _SAME * size) & (s.imag >= 0)]
    real = np.abs(leading.imag) <= np.sqrt(_SAME) * size
    if V in (0.0, V_MAX):
        here = _local(table, by, leading[np.argmax(leading.real)], V)
        return _rate(slopes, value, V, "end", here.s_p.real)
    if real.all() and (len(leading) > 1 or leading[0].imag):
        return _meeting(slopes, table, by, leading.real.mean(), V)
    if len(leading) > 1:
        return _crossing(slopes, table, by, leading[:2], V)
    return _smooth(slopes, table, by, leading[0], V)


def _tables(slopes: Slopes) -> tuple[Floats, Floats]:
    """The table (5, 4) and its derivatives (5, 4, parameter)."""
    lowest = min(j for _, j in slopes.entries)  # −1 where there is 1/V
    table, by = np.zeros((5, 4 - lowest)), np.zeros((5, 4 - lowest, len(slopes.variables)))
    for (k, j), entry in slopes.entries.items():
        table[k, j], by[k, j] = entry.value.value, entry.slope.value
    return table, by


def _lowest(table: Floats) -> tuple[float, float]:
    speeds = np.linspace(0, V_MAX, _SAMPLES)
    best = int(np.argmin(growth_rate_of(table, speeds)))
    ends = speeds[max(best - 1, 0)], speeds[min(best + 1, _SAMPLES - 1)]
    V, value = extreme(table[..., np.newaxis], *(np.array([end]) for end in ends), worst=False, rounds=6)
    return float(V[0]), float(value[0])


def _local(table: Floats, by: Floats, s: complex, V: float) -> _Local:
    k, j = np.arange(5.0), np.array([0.0, 1.0, 2.0, 3.0, -1.0])[: table.shape[1]]

    def powers(order: int, x: complex, n: Floats) -> NDArray:
        """The derivative of this order of x^n."""
        factor = np.ones(len(n))
        for i in range(order):
            factor = factor * (n - i)
        return factor * np.array(x, dtype=complex) ** np.where(factor == 0, 0, n - order)

    S, W = [powers(i, s, k) for i in range(3)], [powers(i, V, j) for i in range(3)]

    def by_both(a: int, b: int) -> complex:
        return complex(S[a] @ table @ W[b])

    return _Local(
        by_both(0, 0), by_both(1, 0), by_both(0, 1), by_both(2, 0), by_both(1, 1), by_both(0, 2),
        *(np.einsum("k,kjp,j->p", S[a], by, W[0]) for a in (0, 1)),
    )  # fmt: skip


def _polished(table: Floats, by: Floats, s: complex, V: float) -> tuple[complex, _Local]:
    for _ in range(3):
        here = _local(table, by, s, V)
        s -= here.P / here.P_s
    return s, _local(table, by, s, V)


def _smooth(slopes: Slopes, table: Floats, by: Floats, s: complex, V: float) -> Rate:
    for _ in range(_STEPS):
        s, here = _polished(table, by, s, V)
        V -= here.s_V.real / here.s_VV.real
    s, here = _polished(table, by, s, V)
    return _rate(slopes, s.real, V, "smooth", here.s_p.real)


def _crossing(slopes: Slopes, table: Floats, by: Floats, pair: Complex, V: float) -> Rate:
    one, other = complex(pair[0]), complex(pair[1])
    for _ in range(_STEPS):
        (one, a), (other, b) = (_polished(table, by, s, V) for s in (one, other))
        V -= (one.real - other.real) / (a.s_V.real - b.s_V.real)
    (one, a), (other, b) = (_polished(table, by, s, V) for s in (one, other))
    u, v = a.s_V.real, b.s_V.real
    return _rate(slopes, one.real, V, "crossing", (u * b.s_p.real - v * a.s_p.real) / (u - v))


def _meeting(slopes: Slopes, table: Floats, by: Floats, s: float, V: float) -> Rate:
    """Where P and its slope by s are zero: a double real eigenvalue."""
    for _ in range(_STEPS):
        here = _local(table, by, s, V)
        step = np.linalg.solve(
            [[here.P_s.real, here.P_V.real], [here.P_ss.real, here.P_sV.real]], [here.P.real, here.P_s.real]
        )
        s, V = s - float(step[0]), V - float(step[1])
    here = _local(table, by, s, V)
    V_p = -here.P_p.real / here.P_V.real
    return _rate(slopes, s, V, "meeting", -(here.P_sp.real + here.P_sV.real * V_p) / here.P_ss.real)


def _rate(slopes: Slopes, value: float, V: float, kind: str, by: Floats) -> Rate:
    return Rate(value, V, kind, dict(zip(slopes.variables[:-1], (by + 0.0).tolist(), strict=False)))
