"""How good designs are by each criterion; arrays of designs at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.design.wanted import Asked
from bikestab.design.wanted import Wanted as Wanted
from bikestab.model import Floats
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import Intervals, intervals_of

WORSE = 1e6  # what makes a design that is not allowed worse than all that are
_SAMPLES, _CHUNK = 33, 1024
_COARSE, _FINE, _FINEST = 2, 4, 7  # rounds of sampling the speeds, each 16 times as fine as the one before


class Counted(NamedTuple):
    """Stable intervals of designs, which of them count, and how wide [m/s] those are, 0 for the others."""

    intervals: Intervals
    counts: NDArray[np.bool_]
    width: Floats

    @property
    def any(self) -> NDArray[np.bool_]:
        """Which designs have one that counts."""
        return np.asarray(self.counts.any(axis=-1))


def counted(wanted: Asked, table: Floats) -> Counted:
    """The stable intervals of tables (5, 4, *shape); arrays have shape (*shape, interval)."""
    found = intervals_of(table)
    counts = wanted.V_max > found.V1
    if wanted.stable:
        counts &= (wanted.stable[0] >= found.V1) & (wanted.stable[1] <= found.V2)
    return Counted(found, counts, np.where(counts, np.minimum(found.V2, wanted.V_max) - found.V1, 0))


def width(wanted: Asked, x: Floats) -> Floats:
    """Minus the widest interval [m/s] of designs x (2, S); smaller is better in each criterion."""
    table = wanted.table(wanted.within(x))
    widest = counted(wanted, table).width.max(axis=-1)
    return _or_miss(wanted, table, widest > 0, -widest)


def lowest(wanted: Asked, x: Floats) -> Floats:
    """The lowest stable speed V1 [m/s]."""
    table = wanted.table(wanted.within(x))
    found = counted(wanted, table)
    V1 = np.where(found.counts, found.intervals.V1, np.inf).min(axis=-1)
    return _or_miss(wanted, table, np.isfinite(V1), V1)


def decay(wanted: Asked, x: Floats) -> Floats:
    """The growth rate [s⁻¹] as judged. Unstable designs are allowed unless stable speeds are asked for."""
    table = wanted.table(wanted.within(x))
    found = counted(wanted, table)
    allowed = np.logical_or(found.any, wanted.stable is None)
    return _or_miss(wanted, table, allowed, judged(wanted, table, found)[1])


def width_and_decay(wanted: Asked, x: Floats) -> Floats:
    """The widest interval [m/s], 0 without one, and the growth rate [s⁻¹] as judged; shape (2, S)."""
    table = wanted.table(wanted.within(x))
    found = counted(wanted, table)
    growth = judged(wanted, table, found)[1]
    return np.stack([found.width.max(axis=-1), np.minimum(growth, WORSE / 2)])


def width_if_decaying(wanted: Asked, x: Floats) -> Floats:
    """As ``width``, of designs that are stable at the judged speeds."""
    widest, growth = width_and_decay(wanted, x)
    return np.where((widest > 0) & (growth < 0), -widest, WORSE + np.maximum(growth, 0))


def miss(wanted: Asked, x: Floats) -> Floats:
    """How far [s⁻¹] designs are from being allowed, 0 where they are."""
    table = wanted.table(wanted.within(x))
    allowed = counted(wanted, table).any
    return np.maximum(_or_miss(wanted, table, allowed, np.zeros(len(allowed))) - WORSE, 0)


def judged(
    wanted: Asked, table: Floats, found: Counted, *, rounds: int | None = None
) -> tuple[Floats, Floats]:
    """The speed [m/s] at which each design of tables (5, 4, S) is judged, and its growth rate [s⁻¹] there.

    That is the worst of the judged speeds; or the best of the counted intervals up to the cap, and of
    all speeds up to the cap where none counts.
    """
    n = table.shape[-1]
    # the worst of given speeds is smooth there; the best is often a kink; a grid is only a start
    rounds = rounds or (_COARSE if wanted.judged or n > _CHUNK else _FINE)
    if wanted.judged:
        return extreme(table, *(np.full(n, end) for end in wanted.judged), worst=True, rounds=rounds)
    V, growth = np.zeros(n), np.full(n, np.inf)
    for k in range(found.counts.shape[-1]):
        counts = found.counts[:, k]
        used = np.flatnonzero(counts | (~found.any & (k == 0)))
        low = np.where(counts, found.intervals.V1[:, k], 0)[used]
        high = np.where(counts, np.minimum(found.intervals.V2[:, k], wanted.V_max), wanted.V_max)[used]
        speed, rate = extreme(table[..., used], low, high, worst=False, rounds=rounds)
        better = rate < growth[used]
        V[used[better]], growth[used[better]] = speed[better], rate[better]
    return V, growth


def extreme(
    table: Floats, low: Floats, high: Floats, *, worst: bool, rounds: int = _FINEST
) -> tuple[Floats, Floats]:
    """The speed from low to high (S,) at which the growth rate is largest, or smallest, and that rate."""
    n, share = table.shape[-1], np.linspace(0, 1, _SAMPLES)[:, np.newaxis]
    best_V, best_rate = np.empty(n), np.empty(n)
    for part in (slice(i, i + _CHUNK) for i in range(0, n, _CHUNK)):
        a, b = low[part], high[part]
        one = not np.any(b > a)
        for _ in range(1 if one else rounds):
            V = a + (b - a) * (share[:1] if one else share)
            rate = growth_rate_of(table[..., part], V)
            best = np.argmax(rate, axis=0) if worst else np.argmin(rate, axis=0)
            column = np.arange(V.shape[1])
            best_V[part], best_rate[part] = V[best, column], rate[best, column]
            a, b = V[np.maximum(best - 1, 0), column], V[np.minimum(best + 1, len(V) - 1), column]
    return best_V, best_rate


def missed_by(wanted: Asked, table: Floats, *, rounds: int = _COARSE) -> tuple[Floats, Floats]:
    """The speed that decides how far from allowed a design is, and its growth rate [s⁻¹] there."""
    n = table.shape[-1]
    low, high = wanted.stable or (0.0, wanted.V_max)
    return extreme(table, np.full(n, low), np.full(n, high), worst=wanted.stable is not None, rounds=rounds)


def _or_miss(wanted: Asked, table: Floats, allowed: NDArray[np.bool_], values: Floats) -> Floats:
    """The values of allowed designs; for others WORSE and how far they are from allowed."""
    result = np.minimum(values, WORSE / 2)
    if not allowed.all():
        rate = missed_by(wanted, table[..., ~allowed])[1]
        result[~allowed] = WORSE + np.clip(rate, 1e-9, WORSE / 2)
    return result
