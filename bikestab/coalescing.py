"""(table, V) of few cells → their quadratics in twice double precision, where eigenvalues nearly meet.

Rounding moves a double root by the square root of itself and a triple one by the cube root. In twice double
precision that is 1e-16 and 1e-11 of the largest eigenvalue, so that little more than the rounding of the
result is left.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.quartic import Quadratic
from bikestab.twofold import Twofold

# Where both quadratics have a root in common, Newton's steps take a half or a third of the distance to it
# each, and the first may lead away; elsewhere two or three steps are enough.
STEPS = 200
PATIENCE = 60  # steps without a gain, before the best factors are taken
DONE = 2.0**-102  # what is left of the coefficients by then is the rounding of twice double precision
TOGETHER = 2.0**-5  # how near all four roots are to their mean, where it is taken for zero


class _Numbers(NamedTuple):
    """Four numbers of each cell: z⁴ + a z³ + b z² + c z + d, or (z² + p z + q)(z² + r z + t)."""

    first: Twofold
    second: Twofold
    third: Twofold
    fourth: Twofold

    def at(self, cells: NDArray) -> _Numbers:
        return _Numbers(*(x.at(cells) for x in self))

    def put(self, cells: NDArray, new: _Numbers) -> None:
        for x, y in zip(self, new, strict=True):
            x.value[cells], x.rest[cells] = y.value, y.rest


def coalescing_quadratics(table: Floats, rest: Floats | None, V: Floats) -> tuple[Floats, ...]:
    """The two real quadratics of tables (5, 4, cell) at one speed [m/s] each; NaN where p4 = 0.

    Their fields one after the other. ``rest`` is what the table's doubles lack of the true table, if known.
    """
    with np.errstate(all="ignore"):
        scale, coefficients = _scaled(_monic(table, np.zeros_like(table) if rest is None else rest, V))
        known = np.all([np.isfinite(x.value) for x in coefficients], axis=0)
        shift, shifted = _centred(coefficients)
        more, shifted = _scaled(shifted)
        p, q, r, t = _polished(_rough(shifted, known), shifted)
        powers = np.where(known, scale, 0), more
        factors = (p, q), (r, t)
        one, other = (_quadratic(*factor, shift, *powers) for factor in factors)
        return tuple(np.where(known, x, np.nan) for x in (*one, *other))


def _monic(table: Floats, rest: Floats, V: Floats) -> _Numbers:
    """The coefficients a, b, c, d of s³, s², s and 1 behind s⁴."""
    p = []
    for row, row_rest in zip(table, rest, strict=True):
        value = Twofold(row[3], row_rest[3])
        for x in zip(row[2::-1], row_rest[2::-1], strict=True):
            value = value * V + Twofold(*x)
        for x in zip(row[4:], row_rest[4:], strict=True):  # of V^−1
            value = value + Twofold(*x) / Twofold(V)
        p.append(value)
    return _Numbers(*(p[k] / p[4] for k in (3, 2, 1, 0)))


def _scaled(coefficients: _Numbers) -> tuple[NDArray[np.int_], _Numbers]:
    """The same in units of 2^scale, such that none exceeds 1."""
    sizes = [np.log2(np.abs(x.value)) / n for n, x in enumerate(coefficients, 1)]
    largest = np.max(sizes, axis=0)
    scale = np.where(np.isfinite(largest), np.ceil(largest), 0).astype(int)
    return scale, _Numbers(*(_times(x, -n * scale) for n, x in enumerate(coefficients, 1)))


def _times(x: Twofold, power: NDArray[np.int_]) -> Twofold:
    """The product with 2^power."""
    return Twofold(np.ldexp(x.value, power), np.ldexp(x.rest, power))


def _centred(coefficients: _Numbers) -> tuple[Twofold, _Numbers]:
    """Where all roots are together, their mean as zero: the quartic in y = z + shift; elsewhere as it is."""
    a, b, c, d = coefficients
    e = a * 0.25
    P = b - e * e * 6
    Q = c - e * (b - e * e * 4) * 2
    R = d - e * (c - e * (b - e * e * 3))
    together = np.max([np.abs(x.value) ** (1 / n) for n, x in enumerate((P, Q, R), 2)], axis=0) < TOGETHER

    def chosen(x: Twofold, y: Twofold) -> Twofold:
        return Twofold(np.where(together, x.value, y.value), np.where(together, x.rest, y.rest))

    zero = Twofold(np.zeros(len(together)), np.zeros(len(together)))
    return chosen(e, zero), _Numbers(chosen(zero, a), chosen(P, b), chosen(Q, c), chosen(R, d))


def _rough(coefficients: _Numbers, known: NDArray[np.bool_]) -> _Numbers:
    """p, q, r and t from a matrix's eigenvalues; those that are nearest to each other share a quadratic."""
    companion = np.zeros((len(known), 4, 4))
    companion[:, [1, 2, 3], [0, 1, 2]] = 1
    companion[:, 0] = -np.stack([x.value for x in coefficients], axis=1)
    companion[~known] = 0
    z = np.linalg.eigvals(companion).astype(complex).T
    # real ones ascending, then pairs, which LAPACK has side by side
    z = np.take_along_axis(z, np.lexsort((np.where(z.imag == 0, z.real, 0), np.abs(z.imag)), axis=0), axis=0)
    gaps = np.diff(z.real, axis=0)
    inner = (z.imag == 0).all(axis=0) & (gaps[1] < np.minimum(gaps[0], gaps[2]))
    z = np.where(inner, z[[1, 2, 0, 3]], z)
    factors = (-(z[0] + z[1]), z[0] * z[1], -(z[2] + z[3]), z[2] * z[3])
    return _Numbers(*(Twofold(x.real.copy(), np.zeros(len(known))) for x in factors))


def _polished(best: _Numbers, coefficients: _Numbers) -> _Numbers:
    """The factors by Newton's method (Bairstow), whose product comes nearest to the quartic.

    On the way to roots that both quadratics have a step or two may lead away.
    """
    f, lacks = best.at(np.arange(len(best.first.value))), _lacks(best, coefficients)
    least = _size(lacks, best)
    cells, idle = np.arange(len(least)), np.zeros(len(least), int)
    for _ in range(STEPS):
        f = _stepped(f, lacks)
        lacks = _lacks(f, coefficients.at(cells))
        size = _size(lacks, f)
        nearer = size < least[cells]
        best.put(cells[nearer], f.at(nearer))
        least[cells[nearer]] = size[nearer]
        idle = np.where(nearer, 0, idle + 1)
        active = (least[cells] > DONE) & (idle < PATIENCE)
        if not active.any():
            break
        cells, idle, f, lacks = cells[active], idle[active], f.at(active), lacks.at(active)
    return best


def _lacks(f: _Numbers, coefficients: _Numbers) -> _Numbers:
    """What the coefficients of the product lack."""
    p, q, r, t = f
    a, b, c, d = coefficients
    return _Numbers(a - p - r, b - q - t - p * r, c - p * t - q * r, d - q * t)


def _size(lacks: _Numbers, f: _Numbers) -> Floats:
    """How large that is beside the sums that it is left of."""
    p, q, r, t = (np.abs(x.value) for x in f)
    sums = p + r, q + t + p * r, p * t + q * r, q * t
    tiny = np.finfo(float).tiny
    return np.max([np.abs(x.value) / (size + tiny) for x, size in zip(lacks, sums, strict=True)], axis=0)


def _stepped(f: _Numbers, lacks: _Numbers) -> _Numbers:
    """One step of Newton's method, as in ``quartic``, with the determinant and its minors as precise."""
    p, q, r, t = f
    g0, g1, g2, g3 = lacks
    m, n = p - r, q - t
    g1 = g1 - p * g0
    g2 = g2 - q * g0 - p * g1
    g3 = g3 - q * g1
    x11, x21 = p * m - n, q * m
    det = m * x21 - n * x11
    dp = (m * g3 - n * g2) / det
    dq = (x11 * g3 - x21 * g2) / det
    return _Numbers(p + dp, q + dq, r + (g0 - dp), t + (g1 + m * dp - dq))


def _quadratic(
    p: Twofold, q: Twofold, shift: Twofold, scale: NDArray[np.int_], more: NDArray[np.int_]
) -> Quadratic:
    """Back in s, as doubles: s/2^scale = z = y − shift and y² + p y + q, but for y in units of 2^more."""
    half = p * 0.5
    square = _times(half * half - q, 2 * more)
    half = _times(half, more) + shift
    q = half * half - square
    return Quadratic(np.ldexp(half.value, scale), *(np.ldexp(x.value, 2 * scale) for x in (square, q)))
