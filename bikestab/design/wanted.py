"""What is asked of a design: a box of designs, limits within it, and speeds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.geometry import offset_of, sigma_limits
from bikestab.limits import check_speed
from bikestab.model import Floats

Range = tuple[float, float]
LAM_RANGE, SIGMA_RANGE, V_MAX = (0.0, 0.6), (0.0, 0.3), 30.0  # rad, 1, m/s


class Asked(Protocol):
    """Designs that can be judged, and what is asked of them: see ``Wanted``."""

    @property
    def V_max(self) -> float: ...
    @property
    def judged(self) -> Range | None: ...
    @property
    def stable(self) -> Range | None: ...
    def within(self, x: Floats) -> Floats: ...
    def table(self, x: Floats) -> Floats: ...


def where_judged(wanted: Asked) -> str:
    """At which speeds decay is judged, in words."""
    if not wanted.judged:
        return f"at each design's best stable speed up to {wanted.V_max:g} m/s"
    start, stop = wanted.judged
    return f"at {start:g} m/s" if start == stop else f"at the worst speed from {start:g} to {stop:g} m/s"


@dataclass(frozen=True)
class Wanted:
    """A box of designs of a family, perhaps cut by ranges of trail and fork offset [m], and what is asked.

    The default box is one of λ [rad] and σ; ``trail`` and ``offset`` cut such a box only.

    Stable intervals count up to ``V_max`` [m/s], and those that start above it not at all; with ``stable``
    only one that contains these speeds [m/s] counts. Decay is judged at the worst of the speeds
    ``judged``, or, where that is None, at each design's best speed. Raises InputError for contradictions.
    """

    family: Family
    x: Range = LAM_RANGE
    y: Range = SIGMA_RANGE
    trail: Range | None = None
    V_max: float = V_MAX
    judged: Range | None = None
    stable: Range | None = None
    offset: Range | None = None

    def __post_init__(self) -> None:
        _check(self)

    @property
    def box(self) -> tuple[Floats, Floats]:
        """The lowest and the highest (x, y) of designs within all limits."""
        (left, right), (low, high), bicycle = self.x, self.y, self.family.bicycle
        if self.trail:
            low, high = max(low, self.trail[0] / bicycle.c), min(high, self.trail[1] / bicycle.c)
        if self.offset:  # which grows with λ at any σ
            left = max(left, _tilt_with(low * bicycle.c, self.offset[0], bicycle.R2))
            right = min(right, _tilt_with(high * bicycle.c, self.offset[1], bicycle.R2))
        return np.array([left, low]), np.array([right, high])

    def within(self, x: Floats) -> Floats:
        """Points (2, *shape) moved into the box and, along σ, to the nearest offset that is allowed."""
        low, high = self.box
        lam = np.clip(x[0], low[0], high[0])
        if not self.offset:
            return np.stack([lam, np.clip(x[1], low[1], high[1])])
        bicycle = self.family.bicycle
        least, most = sigma_limits(lam, self.offset, bicycle.c, bicycle.R2)
        return np.stack([lam, np.clip(x[1], np.maximum(low[1], least), np.minimum(high[1], most))])

    def contains(self, x: Floats) -> bool:
        """Whether a design (2,) is within all limits."""
        low, high = self.box
        inside = bool(np.all((low <= x) & (x <= high)))
        return inside and (not self.offset or self.offset[0] <= self.offset_at(x) <= self.offset[1])

    def offset_at(self, x: Floats) -> float:
        """The fork offset [m] of a design (2,)."""
        lam, sigma, machine = self.family.geometry(*x)
        return float(offset_of(lam, sigma, machine.c, machine.R2))

    def table(self, x: Floats) -> Floats:
        """Characteristic tables of designs x (2, *shape)."""
        return self.family.quick_table(x[0], x[1])


def _check(wanted: Wanted) -> None:
    family = wanted.family
    ranges = {family.x: wanted.x, family.y: wanted.y}
    ranges |= {
        name: getattr(wanted, name)
        for name in ("trail", "offset", "judged", "stable")
        if getattr(wanted, name)
    }
    for name, ends in ranges.items():
        if not ends[0] <= ends[1]:
            problem = f"the range {ends[0]:g}:{ends[1]:g} ends before it starts"
            raise InputError(problem, key=(name,), hint=f"did you mean {ends[1]:g}:{ends[0]:g}?")
        if name in ("judged", "stable") and ends[0] < 0:
            raise InputError(f"{ends[0]:g} m/s is negative", key=(name,), hint="allowed: 0 and above")
        if name in ("judged", "stable"):
            check_speed(ends[1], (name,))
    for x in wanted.x:
        for y in wanted.y:
            family.check(x, y)
    if not 0 < wanted.V_max <= 1e4:
        hint = "allowed: above 0, up to 10000 m/s"
        raise InputError(f"{wanted.V_max:g} m/s is no cap for the speed", key=("V_max",), hint=hint)
    if wanted.stable and wanted.stable[1] > wanted.V_max:
        problem = f"{wanted.stable[1]:g} m/s is above {wanted.V_max:g} m/s, up to which intervals count"
        raise InputError(problem, key=("stable",), hint=f"raise V_max to {wanted.stable[1]:g} at least")
    for name in ("trail", "offset"):
        if getattr(wanted, name) and (family.x, family.y) != ("lam", "sigma"):
            problem = f"a range of {name} cuts one of lam and sigma, not of {family.x} and {family.y}"
            raise InputError(problem, key=(name,), hint="leave it out")
    if wanted.trail:
        _check_trail_range(wanted, wanted.trail)
    if wanted.offset:
        _check_offset_range(wanted, wanted.offset)


def _check_trail_range(wanted: Wanted, trail: Range) -> None:
    if wanted.box[0][1] > wanted.box[1][1]:
        c = wanted.family.bicycle.c
        low, high = (end / c for end in trail)
        raise InputError(
            f"on a wheelbase of {c:g} m this is σ = {low:g} ... {high:g}, "
            f"none of which is in σ = {wanted.y[0]:g} ... {wanted.y[1]:g}",
            key=("trail",), hint="widen one of the two",
        )  # fmt: skip


def _check_offset_range(wanted: Wanted, offset: Range) -> None:
    c, radius = wanted.family.bicycle.c, wanted.family.bicycle.R2
    for end, way in ((wanted.x[0], -1), (wanted.x[1], 1)):
        for sigma in wanted.y:
            turn = math.atan2(sigma * c, radius) + way * math.pi / 2  # where it grows no more
            if way * (end - turn) > 0:
                problem = f"with a limit of the offset, lam = {end:g} is out of range"
                raise InputError(
                    problem, key=("lam",), hint=f"allowed: {'from' if way < 0 else 'up to'} {turn:.4g}"
                )
    low, high = wanted.box
    if low[0] > high[0]:
        found = [float(offset_of(x, y, c, radius)) for x, y in zip(wanted.x, wanted.y[::-1], strict=True)]
        raise InputError(
            f"no design of the box has an offset of {offset[0]:g} ... {offset[1]:g} m",
            key=("offset",), hint=f"in it are {found[0]:.4g} ... {found[1]:.4g} m; 45 mm are written 45mm",
        )  # fmt: skip


def _tilt_with(trail: float, offset: float, radius: float) -> float:
    """The tilt [rad] from which on a trail [m] has at least an offset [m]; R2 sin λ − trail cos λ grows."""
    most = math.hypot(radius, trail)
    share = offset / most if most else math.copysign(1, offset)
    return math.atan2(trail, radius) + math.asin(min(1.0, max(-1.0, share)))
