"""Derivatives of stable speeds as rows, the largest effects first, and some finite changes beside them."""

from __future__ import annotations

import math
from typing import Any, TypedDict

from bikestab.bicycle import Bicycle
from bikestab.design.sensitivity import Sensitivity
from bikestab.design.steps import steps_to_lower
from bikestab.errors import InputError
from bikestab.records import Interval, design_record, interval_records
from bikestab.speeds import UNBOUNDED
from bikestab.stability import stable_intervals


class Row(TypedDict):
    """One parameter's effect on one interval; None where there is no derivative.

    ``dV1`` is in m/s for one unit, ``elasticity_V1`` in per cent for one per cent, and ``change`` is by how
    many units the parameter alone must change for V1 to be LOWER away, None where it cannot: ``steps``.
    ``notation`` tells parameters of the bicycle's notation from other measures of the front.
    """

    name: str
    value: float
    unit: str
    meaning: str
    notation: bool
    dV1: float | None
    dV2: float | None
    elasticity_V1: float | None
    elasticity_V2: float | None
    change: float | None


class Tried(TypedDict):
    """The widest stable interval with other values of some parameters; None where there is none."""

    what: str
    values: dict[str, float]
    interval: Interval | None


def effects(found: Sensitivity, interval: int) -> list[Row]:
    """The rows of one stable interval, by falling size of the larger elasticity; what has none comes last."""
    steps = steps_to_lower(found, interval)
    rows = [_row(found, name, interval, steps[name]) for name in found.values]
    return sorted(rows, key=_size)


def without_interval(found: Sensitivity) -> list[Row]:
    """The rows of a design that has no stable interval: nothing of its ends."""
    return [_plain_row(found, name) for name in found.values]


def _row(found: Sensitivity, name: str, interval: int, change: float | None) -> Row:
    dV1, dV2 = finite(found.dV1[name][interval]), finite(found.dV2[name][interval])
    one, two = (finite(each[interval]) for each in found.elasticity(name))
    unbounded = found.intervals.upper[interval] == UNBOUNDED
    return {
        **_plain_row(found, name),
        "dV1": dV1,
        "dV2": None if unbounded else dV2,
        "elasticity_V1": one,
        "elasticity_V2": None if unbounded else two,
        "change": change,
    }


def _plain_row(found: Sensitivity, name: str) -> Row:
    return {
        "name": name,
        "value": found.values[name],
        "unit": found.units[name],
        "meaning": found.meanings[name],
        "notation": name in found.bicycle.notation and name != "trail",  # which stands for σ there
        "dV1": None, "dV2": None, "elasticity_V1": None, "elasticity_V2": None, "change": None,
    }  # fmt: skip


def _size(row: Row) -> tuple[float, float]:
    def largest(*values: float | None) -> float:
        return -max(abs(value) if value is not None else 0.0 for value in values)

    return largest(row["elasticity_V1"], row["elasticity_V2"]), largest(row["dV1"], row["dV2"])


def finite(value: Any) -> float | None:
    """A number as records hold it: None for one that is not finite."""
    number = float(value)
    return number if math.isfinite(number) else None


def tried(found: Sensitivity) -> list[Tried]:
    """What no rule of thumb gets right: the interval with more damping, and with a heavier body.

    Computed anew, not from derivatives. Without what makes no machine.
    """
    bicycle = found.bicycle
    body = ("mB", "IBxx", "IByy", "IBzz", "IBxz") if bicycle.bodies is not None else ("m1", "A1", "B1", "D1")
    given = bicycle.given
    changes = {
        f"delta {bicycle.delta:g} -> {bicycle.delta + 1:g} kg m²/s": {"delta": bicycle.delta + 1},
        f"{body[0]} and its inertia + 10 %": {name: 1.1 * given[name] for name in body if name in given},
    }
    results: list[Tried] = []
    for what, values in changes.items():
        try:
            other = bicycle.replaced(values)
        except InputError:
            continue
        results.append({"what": what, "values": values, "interval": _widest(other, found)})
    return results


def _widest(bicycle: Bicycle, found: Sensitivity) -> Interval | None:
    intervals = interval_records(stable_intervals(bicycle, found.lam, found.sigma, model=found.model))
    return max(intervals, key=width, default=None)


def width(interval: Interval) -> float:
    """How wide an interval is [m/s]; inf where it is unbounded."""
    return math.inf if interval["V2"] is None else interval["V2"] - interval["V1"]


def sensitivity_record(found: Sensitivity) -> dict[str, Any]:
    """All that was found of a machine, as JSON can hold it."""
    intervals = interval_records(found.intervals)
    return {
        "bicycle": found.bicycle.name,
        "model": found.model,
        "delta": found.bicycle.delta,
        **design_record(found.lam, found.sigma, found.bicycle),
        "hold": found.hold,
        "best": {
            **found.best._asdict(),
            "value": finite(found.best.value),
            "slope": {name: finite(x) for name, x in found.best.slope.items()},
        },
        "intervals": [{**interval, "parameters": effects(found, k)} for k, interval in enumerate(intervals)],
        "tried": tried(found),
    }
