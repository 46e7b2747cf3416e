"""Positive real roots of many small polynomials at once.

A polynomial is an array of coefficients of x^0, x^1, … along the first axis, cells behind it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bikestab.model import Floats
from bikestab.polynomials import derivative, used_powers, value, value_and_slopes

_CHUNK = 1 << 13  # cells worked on at a time: a polynomial of degree 6 and its temporaries fit the L2 cache
_CLOSE = 1e-13  # last relative step to a root; the next one would be far below rounding
_CLOSE_SLOPE = 1e-6  # the same for an extremum, whose value depends on its place only to second order


def positive_roots(coefficients: Floats) -> Floats:
    """The positive x at which each polynomial changes sign, ascending, NaN behind the last.

    ``coefficients`` has shape (n + 1, *shape); the result (m, *shape), where m ≤ n is the largest
    number of roots in any cell. Roots of even multiplicity change no sign and are left out, so the sign
    between two roots follows from the sign near zero. Zero is no positive root.
    """
    shape = coefficients.shape[1:]
    c = coefficients.reshape(len(coefficients), -1)
    parts = [_solve(c[:, start : start + _CHUNK]) for start in range(0, c.shape[1], _CHUNK)]
    most = max((int(np.isfinite(part).any(axis=1).sum()) for part in parts), default=0)
    out = np.full((most, c.shape[1]), np.nan)
    for i, part in enumerate(parts):
        kept = part[:most]
        out[: len(kept), i * _CHUNK : i * _CHUNK + _CHUNK] = kept
    return out.reshape(most, *shape)


def sign_near_zero(coefficients: Floats) -> Floats:
    """The sign of each polynomial just right of zero: −1, 0 (identically zero) or 1."""
    sign = np.zeros(coefficients.shape[1:])
    for c in coefficients:
        if np.any(c):
            sign = np.where(sign == 0, np.sign(c), sign)
    return sign


def _solve(c: Floats) -> Floats:
    used = used_powers(c)
    if len(used) < 2:
        return np.empty((0, c.shape[1]))
    step = int(np.gcd.reduce(np.diff(used)))  # the conditions without damping depend on V² alone
    c = c[used[0] : used[-1] + 1 : step]
    roots = _linear(c) if len(c) == 2 else _quadratic(c) if len(c) == 3 else _bracketed(c)
    return roots if step == 1 else roots ** (1 / step) if step > 2 else np.sqrt(roots)


def _linear(c: Floats) -> Floats:
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        root = c[:1] / -c[1]
    root[~(np.isfinite(root) & (root > 0))] = np.nan
    return root


def _quadratic(c: Floats) -> Floats:
    """The positive sign changes of c0 + c1 x + c2 x², without subtracting nearly equal numbers."""
    c0, c1, c2 = c
    square = c1 * c1 - 4 * c0 * c2
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        q = -0.5 * (c1 + np.copysign(np.sqrt(square), c1))  # NaN without real roots
        pair = np.array([q / c2, c0 / q])
    pair[:, ~(square > 0)] = np.nan
    pair[~(np.isfinite(pair) & (pair > 0))] = np.nan
    pair[0, c2 == 0] = np.nan
    return np.sort(pair, axis=0)  # NaN sorts last


def _bracketed(c: Floats) -> Floats:
    """Between two neighbouring roots of its derivative a polynomial changes sign at most once."""
    lo, hi = _bounds(c)
    knots, found = _sign_changes(c, lo, hi, _CLOSE)
    return np.sort(np.where(found, knots, np.nan), axis=0)


def bracketed_root(c: Floats, low: Floats, high: Floats, sign: Floats, close: float = _CLOSE) -> Floats:
    """The one root of each polynomial (power, root) in low … high, whose sign is known at the upper end.

    The ends may be 0 and inf. To a few units of the last place, if the root is not nearly a multiple one;
    with another ``close`` the last step, relative to the root, is below that.
    """
    a, b = low.copy(), high.copy()
    none, all_ = np.flatnonzero(low == 0), np.flatnonzero(high == np.inf)
    a[none] = np.ldexp(1.0, -_exponent_above(c[::-1, none]))
    b[all_] = np.ldexp(1.0, _exponent_above(c[:, all_]))
    return _bracket(c, np.minimum(a, b), np.maximum(a, b), sign, close)


def _exponent_above(c: Floats) -> NDArray[np.int_]:
    """K with all roots below 2^k in size (Fujiwara 1916), from the exponents of coefficients."""
    exponent = np.where(c == 0, -(1 << 20), np.frexp(c)[1])
    n = len(exponent) - 1 - np.argmax(exponent[::-1] > -(1 << 19), axis=0)  # degree of each cell
    lead = np.take_along_axis(exponent, n[np.newaxis], axis=0)[0]
    most = np.full(lead.shape, -1000)
    for j, e in enumerate(exponent[:-1]):
        below = -((lead - 1 - e) // np.maximum(n - j, 1))  # of the ratio's root, rounded up
        most = np.where((j < n) & (e > -(1 << 19)), np.maximum(most, below), most)
    return np.clip(most + 2, -1000, 1000)


def _bounds(c: Floats) -> tuple[Floats, Floats]:
    """Cells' bounds 0 < lo < hi with every positive root between (Fujiwara 1916, both ways round)."""

    def upper(c: Floats) -> Floats:
        order = len(c) - 1 - np.argmax(c[::-1] != 0, axis=0)  # degree of each cell
        lead = np.abs(np.take_along_axis(c, order[np.newaxis], axis=0)[0])
        bound = np.zeros_like(lead)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            for j, cj in enumerate(c[:-1]):
                ratio = np.abs(cj) / lead
                bound = np.fmax(bound, np.where(j < order, ratio ** (1 / np.maximum(order - j, 1)), 0))
        return 2 * bound

    hi = upper(c)
    low = upper(c[::-1])
    some = (hi > 0) & (low > 0)
    least = np.maximum(0.5 / np.where(some, low, 1), np.finfo(float).tiny)
    return np.where(some, least, 1.0), np.where(some, 2 * hi, 1.0)


def _sign_changes(c: Floats, lo: Floats, hi: Floats, close: float) -> tuple[Floats, np.ndarray]:
    """Ascending knots in [lo, hi], one for each power, and which of them are sign changes.

    A knot that is none is the right end of its bracket: it cuts a monotone stretch, which does no harm.
    """
    n = len(c) - 1
    if n == 1:
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            root = -c[0] / c[1]
        inside = (root > lo) & (root < hi)
        return np.where(inside, root, hi)[np.newaxis], inside[np.newaxis]
    slope = derivative(c)
    knots = np.concatenate([lo[np.newaxis], _sign_changes(slope, lo, hi, _CLOSE_SLOPE)[0], hi[np.newaxis]])
    sign = np.sign(value(c, knots))
    for i in range(1, n + 1):  # a zero at a knot belongs to the bracket on its right
        sign[i] = np.where(sign[i] == 0, sign[i - 1], sign[i])
    found = sign[:-1] * sign[1:] < 0
    roots = knots[1:].copy()
    index, cell = np.nonzero(found)
    ends = knots[index, cell], knots[index + 1, cell], sign[index + 1, cell]
    roots[index, cell] = _bracket(c[:, cell], *ends, close)
    return roots, found


def _bracket(c: Floats, a: Floats, b: Floats, sign_b: Floats, close: float) -> Floats:
    """The one root of each polynomial in [a, b]: Halley's steps, halving in the logarithm where they fail.

    A step that is ``close`` (relative) to its start ends the search; its result is twice as good.
    """
    root = np.empty_like(a)
    cell = np.arange(len(a))
    active = np.ones(len(a), bool)
    x = np.sqrt(a * b)
    while len(cell):
        f, slope, bend = value_and_slopes(c, x)
        right = f * sign_b > 0
        b = np.where(right, x, b)
        a = np.where(right, a, x)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            new = np.where(f == 0, x, x - f / (slope - f * bend / slope))
        inside = ((new > a) & (new < b)) | (new == x)  # from one end to the other steps may go in circles
        new = np.where(inside, new, np.sqrt(a * b))
        new = np.where(active, new, x)  # a root that is found does not depend on its company
        active = (np.abs(new - x) > close * x) & (b - a > 2**-51 * b)
        root[cell] = x = new
        if np.count_nonzero(active) < 0.7 * len(cell):
            cell, a, b, x, sign_b = (v[active] for v in (cell, a, b, x, sign_b))
            c, active = c[:, active], active[active]
    return root
