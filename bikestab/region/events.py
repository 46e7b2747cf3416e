"""What happens to the stable intervals at points of the skeleton's curves, and whether it matters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.polynomials import derivative, value
from bikestab.region.sides import side_of_each, sides
from bikestab.region.skeleton import CurveName, in_units, speed_polynomials, units
from bikestab.roots import positive_roots
from bikestab.routh import conditions
from bikestab.speeds import intervals_of

_UNIT_SAMPLES = 17  # of the box, per axis
_ROUNDED = 1e-9  # of the largest coefficient, of tables of middling size: what is less may be zero


@dataclass(frozen=True)
class Box:
    """The box with coordinates (u, v) from 0 to 1; ``ends`` are its x and y, shape (2, 2)."""

    family: Family
    ends: Floats
    V: tuple[float, float]

    @cached_property
    def units(self) -> NDArray[np.intp]:
        """The units in which the tables of its designs are of middling size."""
        nodes = np.linspace(0, 1, _UNIT_SAMPLES)
        return units(self.table(np.array(np.meshgrid(nodes, nodes))))

    @cached_property
    def mixed(self) -> bool:
        """Whether damping or gains mix odd and even powers of V in the conditions."""
        nodes = np.linspace(0, 1, _UNIT_SAMPLES)
        return speed_polynomials(self.table(np.array(np.meshgrid(nodes, nodes)))).power == 1

    def real(self, points: Floats) -> Floats:
        low, high = self.ends.T.reshape(2, 2, *(1,) * (points.ndim - 1))
        return low * (1 - points) + high * points  # the ends exactly

    def table(self, points: Floats) -> Floats:
        return self.family.table(*self.real(points))

    def value(self, key: CurveName, points: Floats) -> Floats:
        return self.values(points, [key])[key]

    def values(
        self, points: Floats, names: Sequence[CurveName] = get_args(CurveName)
    ) -> dict[CurveName, Floats]:
        """The functions of curves, whose scale is the same at all points of the box."""
        return sides(in_units(self.table(points), self.units), names)

    def value_of_each(self, keys: Sequence[CurveName], points: Floats, which: NDArray[np.intp]) -> Floats:
        """At points (2, n) the functions of the curves keys[which], all of one table."""
        return side_of_each(in_units(self.table(points), self.units), keys, which)


class Event(NamedTuple):
    """What happens at points of a curve: where, and which other conditions must hold to matter.

    ``V`` (point,); ``holds`` and ``ends`` name, for each of these conditions, whether it does (condition,
    point) and which curve a piece meets where it ceases to; ``closes`` (point,).
    """

    V: Floats
    holds: NDArray[np.bool_]
    ends: tuple[str, ...]
    closes: NDArray[np.bool_]

    @property
    def state(self) -> NDArray[np.intp]:
        """0 where the stable intervals stay the same, 2 where one closes, 1 where they change otherwise."""
        return np.where(self.holds.all(axis=0), 1 + self.closes, 0)


def event_at(box: Box, key: CurveName, points: Floats, V: Floats | None = None) -> Event:
    """What happens at points (2, point) of a curve, at speeds V (point,) where these are known."""
    if key.endswith(("infinity", "rest")):
        table = in_units(box.table(points), box.units)
        event = _event_at_an_end(key, speed_polynomials(table).polynomials)
    elif key == "singular inertia":
        return _event_of_inertia(box, points)
    else:
        event = _event_within(key, box.table(points), V)
    V, (low, high) = event.V, box.V
    inside = (low <= V) & (high >= V)
    return event._replace(holds=np.vstack([event.holds, inside]), ends=(*event.ends, "box"))


def _event_within(key: CurveName, table: Floats, V: Floats | None) -> Event:
    # designs to the right, V upwards, s = stable, w = weave and c = capsize speeds:
    #
    #    fold: closes     or two become one      meet: closes      or an end changes
    #
    #      w ----.            s       s            w ----.          w ----.  .---- c
    #        s    )         w ----.   s              s    >                ><
    #      w ----'                 )  s            c ----'          c ----'  '---- w
    #                       w ----'   s                                 s      s
    #                         s       s
    #
    # The curvature of hurwitz3 tells the first two apart, the slopes of p0 and hurwitz3 the others.
    polynomials, power = speed_polynomials(table)
    x = _common_root(key, polynomials) if V is None else V**power
    V, exists = x ** (1 / power), np.isfinite(x)
    weave, p0 = polynomials["hurwitz3"], polynomials["p0"]
    with np.errstate(invalid="ignore"):
        p = conditions(table, V)
        needed = {
            "fold": {"weave": exists, "meet": (p.p0 > 0) & (p.p1 > 0), "crossing": p.p3 > 0},
            "crossing": {"weave": exists, "meet": p.p0 > 0, "fold": (p.p2 > 0) & (p.p2**2 > 4 * p.p4 * p.p0)},
            "capsize fold": {
                "capsize": exists,
                "meet": p.hurwitz3 > 0,
                "slow meet": p.p1 > 0,
                "crossing": p.p3 > 0,
            },
            "meet": {"capsize": exists, "slow meet": p.p1 > 0, "crossing": p.p3 > 0},
            "slow meet": {"capsize": exists, "meet": p.p2 > 0, "crossing": p.p3 > 0},
        }[key] | {"singular inertia": p.p4 > 0}
        if key in ("fold", "capsize fold"):  # else two intervals meet and become one
            closes = value(derivative(derivative(weave if key == "fold" else p0)), x) < 0
        elif key == "crossing":
            closes = exists
        else:  # else weave and capsize change places at one end
            closes = value(derivative(p0), x) * value(derivative(weave), x) < 0
    return Event(V, np.array(list(needed.values())), tuple(needed), closes)


def _event_at_an_end(key: CurveName, polynomials: dict[str, Floats]) -> Event:
    """A root of p0 or hurwitz3 leaves to infinity or to rest: the others must be positive there."""
    infinite = key.endswith("infinity")
    at = -1 if infinite else 0
    own = "p0" if key.startswith("capsize") else "hurwitz3"
    names = [name for name in ("p0", "p1", "p2", "p3", "p4", "hurwitz3") if name != own]
    values = np.array([polynomials[name][at] for name in names])
    # p1 is a factor of hurwitz3's coefficient, and then zero but for rounding
    rounded = _ROUNDED * np.abs(polynomials["p1"]).max()
    allowed = np.array([rounded if name == "p1" else 0.0 for name in names])
    where = key.split(" ", 1)[1]
    ends = {
        "p0": f"capsize {where}",
        "hurwitz3": f"weave {where}",
        "p1": f"weave {where}",
        "p4": "singular inertia",
    }
    V = np.full(values.shape[1], np.inf if infinite else 0.0)
    return Event(
        V, values > -allowed[:, np.newaxis], tuple(ends.get(name, "crossing") for name in names), V < 0
    )


def _event_of_inertia(box: Box, points: Floats) -> Event:
    """All motion becomes unstable where p4 changes sign."""
    along = np.gradient(points, axis=1) if points.shape[1] > 1 else np.ones_like(points)
    aside = np.array([-along[1], along[0]]) / np.maximum(np.hypot(*along), 1e-300) * 1e-7
    number = [intervals_of(box.table(points + sign * aside)).number for sign in (1, -1)]
    V = np.full(points.shape[1], np.nan)
    return Event(V, (number[0] != number[1])[np.newaxis], ("weave",), np.zeros(len(V), bool))


def _common_root(key: CurveName, polynomials: dict[str, Floats]) -> Floats:
    """The positive x (point,) at which two of the conditions vanish together; NaN where none does."""
    weave, p0, p1, p3, q = (polynomials[name] for name in ("hurwitz3", "p0", "p1", "p3", "q"))
    candidates, other = {
        "fold": (derivative(weave), weave),
        "crossing": (p1, p3),
        "capsize fold": (derivative(p0), p0),
        "meet": (p0, q),
        "slow meet": (p0, p1),
    }[key]
    x = positive_roots(candidates)
    if not len(x):
        return np.full(p0.shape[1], np.nan)
    with np.errstate(invalid="ignore"):
        residual = np.abs(value(other, x)) / value(np.abs(other), np.abs(x))
    common = np.argmin(np.where(np.isnan(residual), np.inf, residual), axis=0)
    x = x[common, np.arange(x.shape[1])]
    return np.where(x > 0, x, np.nan)
