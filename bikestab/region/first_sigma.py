"""(bicycle, λ) → the smallest σ with a stable speed, and its exact derivatives by every parameter.

There a curve of the skeleton is crossed: conditions f(V, σ, p) = 0 that fix V and σ together, so that
dσ/dp and dV/dp are −J⁻¹ f_p with J the slopes of f by σ and V. These are propagated forwards (``slopes``).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from bikestab.arguments import Given, design_of
from bikestab.bicycle import Bicycle
from bikestab.dual import Dual
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.model import ExactTable, Floats, Model
from bikestab.region.lines import stable_ranges
from bikestab.region.nearest import searched
from bikestab.region.pieces import NAMES
from bikestab.region.skeleton import CurveName
from bikestab.routh import condition_polynomials
from bikestab.slopes import Slopes, by_name, condition_of, skates, slopes_of, value_at
from bikestab.speeds import CAPSIZE, REST, UNBOUNDED, WEAVE, intervals_of
from bikestab.twofold import Twofold

_STEPS = 12  # of Newton's method, at most
_SAME = 1e-7  # of σ, between where the intervals begin and where the conditions vanish
_DONE = 1e-13  # of σ and of V: the last step
_AROUND = 0.01  # of σ, where a coefficient that vanishes at the first one is seen
_SINGULAR = 1e-9  # of what the slopes are made of, below which they do not fix σ

Equations = Callable[[Slopes, Twofold], list[Dual]]


class FirstSigma(NamedTuple):
    """The smallest stable σ, the speed [m/s] at which the first interval opens, and the curve that it is on.

    ``slope`` has its derivative by each parameter of the notation and by those of the front, at constant λ:
    zero by σ, trail and offset, on which it does not depend. Where there is no such σ, or no derivative, it
    is None or empty, and ``reason`` says why.

    >>> import bikestab as bs
    >>> bs.first_sigma(bs.Bicycle.preset("meijaard2007"), lam=-0.2).reason
    'no larger σ up to 0.5 has a stable speed at this tilt'
    """

    value: float | None
    V: float | None
    kind: str | None
    slope: dict[str, float]
    reason: str


def first_sigma(
    bicycle: Bicycle,
    lam: Given = None,
    sigma: Given = None,
    *,
    model: Model = "refined",
    delta: float | None = None,
) -> FirstSigma:
    """Where the stable σ begin at a design's tilt, and how that moves with every parameter.

    Parameters
    ----------
    bicycle : Bicycle
        The machine.
    lam, sigma : float or str, optional
        One tilt [rad], and the σ from which is looked: in the range of those with a stable speed around it,
        or else in the next range above it. By default the bicycle's own.
    model, delta
        As in ``stable_intervals``.

    Returns
    -------
    FirstSigma
        The σ, to some units of rounding, and its derivatives.

    Raises
    ------
    InputError
        As ``stable_intervals``, and for several designs.

    Notes
    -----
    Searched over −0.5 ≤ σ ≤ 0.5, or on to the design. By the implicit function theorem, where conditions
    of (2.2) in Dikarev, Dikareva and Fufaev (1981) vanish together, or a coefficient of one does.

    Examples
    --------
    >>> import bikestab as bs
    >>> found = bs.first_sigma(bs.Bicycle.preset("dikarev1981"), 0.1, 0.08)
    >>> round(found.value, 6), found.kind, round(found.slope["m1"], 7)
    (0.105538, 'weave meets capsize', 1.72e-05)
    """
    machine = bicycle.with_delta(delta)
    design = design_of(machine, lam, sigma)
    if any(each.size != 1 for each in design):
        hint = "give one lam and one sigma"
        raise InputError("the first σ is that of one design", key=("lam",), hint=hint)
    tilt, own = (float(each) for each in design)
    _, (low, high) = searched(tilt, own)
    family = Family(machine, model)
    (ranges,) = stable_ranges(family, low, high, x=tilt, among=own)
    start = next((start for start, stop in ranges if stop >= own), None)
    if start is None:
        return _none(f"no larger σ up to {high:g} has a stable speed at this tilt")
    if start == low:
        return _none(f"there are stable speeds down to σ = {low:g}, where the search ends")
    return _solved(family, tilt, start)


def first_sigma_record(found: FirstSigma) -> dict[str, Any]:
    """The same as JSON can hold it: None where there is no derivative."""
    slope = {name: x if math.isfinite(x) else None for name, x in found.slope.items()}
    return {**found._asdict(), "slope": slope}


def _none(reason: str) -> FirstSigma:
    return FirstSigma(None, None, None, {}, reason)


def _solved(family: Family, lam: float, start: float) -> FirstSigma:
    """The event at which the stable σ begin, near ``start``."""
    machine, model = family.bicycle, family.model
    for kind, V in _events(family.exact_table(lam, start)):
        equations = _equations(kind, family.table(lam, start + _AROUND * np.array([-1.0, -0.5, 0.5, 1.0])))
        found = _newton(
            lambda sigma, V, of=equations: of(slopes_of(machine, lam, sigma, model=model, by=()), V),
            start,
            V,
        )
        if found is not None:
            sigma, V = found
            slope = _slope(machine, slopes_of(machine, lam, sigma, model=model), equations, V)
            shown = None if kind.endswith("infinity") or math.isnan(V) else V
            shown = 0.0 if kind.endswith("rest") else shown
            reason = "" if slope else "the conditions that vanish there do not fix σ"
            return FirstSigma(sigma, shown, NAMES[kind], slope, reason)
    return FirstSigma(start, None, None, {}, "no two conditions were found that vanish there")


def _events(table: ExactTable) -> list[tuple[CurveName, float]]:
    """The curves on which a design's stable intervals may end, and at which speed; the likeliest first.

    A rounded table may have no interval any more where the first one opens.
    """
    found = intervals_of(table)
    events: list[tuple[CurveName, float]] = []
    for k in np.argsort(found.V2 - found.V1)[: int(found.number)]:
        V1, V2 = float(found.V1[k]), float(found.V2[k])
        kinds = int(found.lower[k]), int(found.upper[k])
        middle = 0.5 * (V1 + V2)
        if kinds[1] == UNBOUNDED:
            # p0 may have a constant alone, whose sign is then that at all speeds
            events += [("weave at infinity", math.inf), ("capsize at infinity", math.inf)]
        elif kinds[0] == REST:
            events += [("weave at rest", 0.0), ("capsize at rest", 0.0)]
        elif kinds == (WEAVE, WEAVE):
            events += [("crossing", middle), ("fold", middle)]
        elif kinds == (CAPSIZE, CAPSIZE):
            events.append(("capsize fold", middle))
        else:
            events += [("meet", middle), ("slow meet", middle)]
    return [*events, ("singular inertia", math.nan)]


def _equations(kind: CurveName, around: Floats) -> Equations:
    """What vanishes on a curve; ``around`` are tables on it and beside it."""
    if kind == "singular inertia":
        return lambda slopes, V: [slopes.entries[4, 0]]
    if kind.endswith(("infinity", "rest")):
        name = "p0" if kind.startswith("capsize") else "hurwitz3"
        used = np.flatnonzero(condition_polynomials(around)[name].any(axis=1))
        power = int(used[-1 if kind.endswith("infinity") else 0])

        def coefficient(slopes: Slopes, V: Twofold) -> list[Dual]:
            found = condition_of(slopes, name)[power]
            return [found] if found is not None else []

        return coefficient
    if kind in ("fold", "capsize fold"):

        def fold(slopes: Slopes, V: Twofold) -> list[Dual]:
            c = condition_of(slopes, "hurwitz3" if kind == "fold" else "p0")
            by_V = [None if a is None else a * float(j) for j, a in enumerate(c)][1:]
            return [value_at(slopes, c, V), value_at(slopes, by_V, V)]

        return fold
    names = {"crossing": ("p1", "p3"), "meet": ("p0", "q"), "slow meet": ("p0", "p1")}[kind]
    return lambda slopes, V: [value_at(slopes, condition_of(slopes, name), V) for name in names]


def _newton(of: Any, sigma: float, V: float) -> tuple[float, float] | None:
    """Where equations vanish, near σ and V; None where that is not near. One alone does not know V."""
    start = sigma, V
    for _ in range(_STEPS):
        f = of(sigma, Twofold(np.asarray(V)))
        J = np.array([each.slope.value[1:] for each in f])  # by σ and V
        values = np.array([float(each.value.value) for each in f])
        if len(f) == 1:
            J = J[:, :1]
        try:
            step = np.linalg.solve(J, values)
        except np.linalg.LinAlgError:
            return None
        sigma -= float(step[0])
        if len(f) == 2:
            V -= float(step[1])
        near = abs(sigma - start[0]) <= _SAME * max(abs(start[0]), 1.0)
        if not (near and (len(f) == 1 or V > 0)):
            return None
        if abs(step[0]) <= _DONE and (len(f) == 1 or abs(step[1]) <= _DONE * V):
            return sigma, V
    return None


def _slope(machine: Bicycle, slopes: Slopes, equations: Equations, V: float) -> dict[str, float]:
    """The derivatives of σ where equations vanish; empty where they do not fix it."""
    f = [by_name(slopes, each.slope) for each in equations(slopes, Twofold(np.asarray(V)))]
    one = f[0]
    if len(f) == 1:
        weights, total = [1.0], float(one["sigma"])
        size = abs(total)
    else:
        other = f[1]  # Cramer's rule
        weights = [float(other["V"]), -float(one["V"])]
        parts = [weight * float(each["sigma"]) for weight, each in zip(weights, f, strict=True)]
        total, size = sum(parts), sum(map(abs, parts))
    if not abs(total) > _SINGULAR * size:
        return {}
    found = {
        name: -sum(weight * float(each[name]) for weight, each in zip(weights, f, strict=True)) / total + 0.0
        for name in slopes.variables[:-1]
    }
    found |= {"head_angle": -found["lam"], "sigma": 0.0, "trail": 0.0, "offset": 0.0} | skates(machine)
    return found | ({"c": 0.0} if machine.bodies is not None else {})
