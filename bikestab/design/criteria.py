"""How good designs are by each criterion; arrays of designs at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bikestab.design.wanted import Asked
from bikestab.design.wanted import Wanted as Wanted
from bikestab.model import Floats
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of
from bikestab.undamped import StableSpeeds, stable_speeds

WORSE = 1e6  # what makes a design that is not allowed worse than all that are
_SAMPLES, _CHUNK = 33, 1024
_COARSE, _FINE, _FINEST = 2, 4, 7  # rounds of sampling the speeds, each 16 times as fine as the one before


class Counted(NamedTuple):
    """Stable intervals of designs, which of them count, and how wide [m/s] those are, 0 for the others."""

    intervals: StableSpeeds
    counts: NDArray[np.bool_]
    width: Floats

    def some(self, part: slice) -> Counted:
        """Those of some designs."""
        if part == slice(None):
            return self
        parts: list[Any] = [values[part] for values in self.intervals]
        return Counted(StableSpeeds(*parts), self.counts[part], self.width[part])

    @property
    def any(self) -> NDArray[np.bool_]:
        """Which designs have one that counts."""
        return np.asarray(self.counts.any(axis=-1))


def counted(wanted: Asked, table: Floats) -> Counted:
    """The stable intervals of tables (5, 4, *shape); arrays have shape (*shape, interval)."""
    return counted_of(wanted, StableSpeeds(*intervals_of(table)))


def counted_of(wanted: Asked, found: StableSpeeds) -> Counted:
    """Which of the stable speeds count."""
    counts = wanted.V_max > found.V1
    if wanted.stable:
        counts &= (wanted.stable[0] >= found.V1) & (wanted.stable[1] <= found.V2)
    return Counted(found, counts, np.where(counts, np.minimum(found.V2, wanted.V_max) - found.V1, 0))


class Merit(NamedTuple):
    """What one criterion says of designs (S,), smaller is better, and which designs it allows."""

    value: Floats
    allowed: NDArray[np.bool_]


def width(wanted: Asked, table: Floats, found: Counted) -> Merit:
    """Minus the widest interval [m/s]."""
    widest = found.width.max(axis=-1)
    return Merit(-widest, widest > 0)


def lowest(wanted: Asked, table: Floats, found: Counted) -> Merit:
    """The lowest stable speed V1 [m/s]."""
    V1 = np.where(found.counts, found.intervals.V1, np.inf).min(axis=-1)
    return Merit(V1, np.isfinite(V1))


def decay(wanted: Asked, table: Floats, found: Counted) -> Merit:
    """The growth rate [s⁻¹] as judged. Unstable designs are allowed unless stable speeds are asked for."""
    return Merit(judged(wanted, table, found)[1], np.logical_or(found.any, wanted.stable is None))


def decay_finely(wanted: Asked, table: Floats, found: Counted) -> Merit:
    """As ``decay``, with the speed sampled as finely as for what is told of designs."""
    rate = judged(wanted, table, found, rounds=_FINEST)[1]
    return Merit(rate, np.logical_or(found.any, wanted.stable is None))


def width_if_decaying(wanted: Asked, table: Floats, found: Counted) -> Merit:
    """As ``width``, of designs that are stable at the judged speeds."""
    widest, growth = found.width.max(axis=-1), judged(wanted, table, found)[1]
    return Merit(-widest, (widest > 0) & (growth < 0))


Criterion = Callable[[Asked, Floats, Counted], Merit]


def assessed(wanted: Asked, criteria: Sequence[Criterion], x: Floats) -> Floats:
    """What each criterion gives for designs of its own, x (n, criterion, S), or for the same, x (n, S).

    Returns (criterion, S): the values of allowed designs; for others WORSE and how far they are from allowed.
    """
    own = x.ndim == 3
    table = wanted.table(wanted.within(x.reshape(len(x), -1)))
    found = counted_of(wanted, stable_speeds(table))
    n = x.shape[-1]
    parts = [slice(i * n, (i + 1) * n) if own else slice(None) for i in range(len(criteria))]
    merits = [c(wanted, table[..., part], found.some(part)) for c, part in zip(criteria, parts, strict=True)]
    values, allowed = (np.array(each) for each in zip(*merits, strict=True))
    values = np.minimum(values, WORSE / 2)
    poor = np.asarray(~(allowed.ravel() if own else np.logical_and.reduce(allowed, axis=0)))
    if poor.any():
        away = np.zeros(len(poor))
        away[poor] = np.clip(missed_by(wanted, table[..., poor])[1], 1e-9, WORSE / 2)
        values = np.where(allowed, values, WORSE + (away.reshape(values.shape) if own else away))
    return values


def width_and_decay(wanted: Asked, x: Floats) -> Floats:
    """The widest interval [m/s], 0 without one, and the growth rate [s⁻¹] as judged; shape (2, S)."""
    table = wanted.table(wanted.within(x))
    found = counted_of(wanted, stable_speeds(table))
    growth = judged(wanted, table, found)[1]
    return np.stack([found.width.max(axis=-1), np.minimum(growth, WORSE / 2)])


def miss(wanted: Asked, table: Floats, found: Counted) -> Merit:
    """Nothing but which designs are allowed."""
    return Merit(np.zeros(table.shape[-1]), found.any)


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
