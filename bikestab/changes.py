"""Two machines at their designs → records of what differs: parameters, stable speeds, growth rates."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import zip_longest
from typing import Any, TypedDict

import numpy as np

from bikestab.bicycle import PAPER
from bikestab.comparison import Box, Region, Side, region
from bikestab.model import exact_table
from bikestab.records import design_record, interval_records
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of
from bikestab.variants import parameter_of

_OPEN = 5.0  # m/s above V1: where an interval without upper limit is asked for its growth rate


class Change(TypedDict):
    """One quantity of both: None where one has none, and for V2 where it is unbounded.

    ``change`` is B − A and ``percent`` that of A. For an end of stable speeds ``A_kind`` and ``B_kind`` are
    weave, capsize, rest or unbounded, and ``none`` where there is no such interval. ``within`` says whether
    the change is within what is asked for, and is None where nothing is asked of it.
    """

    what: str
    unit: str
    A: float | None
    B: float | None
    change: float | None
    percent: float | None
    A_kind: str | None
    B_kind: str | None
    within: bool | None


def compare(A: Side, B: Side, box: Box, within: float | str | None = None) -> tuple[dict[str, Any], Region]:
    """All that differs as a record that JSON can hold, and the region that differs.

    ``within`` is a speed [m/s], or per cent as text such as ``1%``: of each end of the stable speeds, and of
    the stable region, by the mean distance of its speeds, or by the share of the union; per cent are of the
    growth rates too. What is zero or infinite may not change at all. ``holds`` says whether all are; without
    ``within`` it is None. Raises InputError as ``region``.
    """
    found = region(A, B, box)
    ends = _ends(A, B, within)
    far = None if within is None else _share_holds(found, within)
    rates = _growth_rates(A, B, within)
    asked = [change["within"] for change in (*ends, *rates)] + [far]
    names = (*box.names, "V")
    record = {
        "A": _side(A), "B": _side(B), "parameters": parameters([A, B])[0], "ends": ends,
        "growth_rate": rates,
        "region": {
            "box": dict(zip(names, map(list, box.ends), strict=True)),
            "designs": [len(box.x), len(box.y)], "unit": _unit(A, box.names),
            "A": found.volumes[0], "B": found.volumes[1], "difference": found.difference,
            "union": found.union, "share": found.share, "mean": found.mean, "within": far,
        },
        "within": within, "holds": None if within is None else all(each is not False for each in asked),
    }  # fmt: skip
    return record, found


def _unit(side: Side, names: tuple[str, str]) -> str:
    """That of a volume in a box."""
    units = [parameter_of(side.bicycle, name).unit for name in names]
    return " ".join([*(unit for unit in units if unit != "1"), "m/s"])


def _share_holds(found: Region, within: float | str) -> bool:
    if isinstance(within, str):
        return 100 * found.share <= float(within[:-1])
    return found.mean <= within


def _side(side: Side) -> dict[str, Any]:
    head = {"name": side.name, "bicycle": side.bicycle.name, "model": side.model, "delta": side.bicycle.delta}
    if side.design is None:
        return {**head, "design": None, "intervals": []}
    found = intervals_of(exact_table(side.bicycle, *side.design, model=side.model))
    return {**head, "design": design_record(*side.design, side.bicycle), "intervals": interval_records(found)}


def parameters(sides: Sequence[Side]) -> list[list[Change]]:
    """Of the first and each other those that differ, in the notation of all, or else the paper's.

    Tilt and trail are those of the designs that are compared.
    """
    one = len({frozenset(side.bicycle.notation) for side in sides}) == 1
    meanings = sides[0].bicycle.notation if one else PAPER
    A, *others = (_numbers(side, own=one) for side in sides)
    return [
        [
            change(name, meanings.get(name, "").rpartition("[")[2].rstrip("]"), A.get(name), B.get(name))
            for name in dict.fromkeys([*A, *B])
            if A.get(name) != B.get(name)
        ]
        for B in others
    ]


def _numbers(side: Side, *, own: bool) -> dict[str, float]:
    """A machine's parameters, at its design, in its ``own`` notation or the paper's."""
    bike = side.bicycle
    numbers = {"g": bike.g, "delta": bike.delta, **bike.given} if own else bike.numbers()
    found = {name: value for name, value in numbers.items() if value is not None}
    if side.design is None or side.design == (bike.lam, bike.sigma):
        return found
    lam, sigma = side.design
    trail = {"c": float(f"{sigma * bike.c:.15g}")} if own and bike.bodies else {"sigma": sigma}
    return {**found, "lam": lam, **trail}


def _ends(A: Side, B: Side, within: float | str | None) -> list[Change]:
    """The ends of the stable intervals, those of one number together."""
    if A.design is None or B.design is None:
        return []
    rows = []
    pairs = zip_longest(_side(A)["intervals"], _side(B)["intervals"])
    for number, pair in enumerate(pairs, 1):
        for end, kind in (("V1", "lower"), ("V2", "upper")):
            a, b = (None if interval is None else interval[end] for interval in pair)
            kinds = ["none" if interval is None else interval[kind] for interval in pair]
            row = change(end if number == 1 else f"{end} of interval {number}", "m/s", a, b)
            row |= {"A_kind": kinds[0], "B_kind": kinds[1]}
            if within is not None:
                row["within"] = kinds[0] == kinds[1] and _near(a, b, within)
            rows.append(row)
    return rows


def _near(a: float | None, b: float | None, within: float | str) -> bool:
    if a is None or b is None:
        return a == b
    allowed = abs(a) * float(within[:-1]) / 100 if isinstance(within, str) else within
    return abs(b - a) <= allowed


def _growth_rates(A: Side, B: Side, within: float | str | None) -> list[Change]:
    """Those in the middle of A's stable intervals, or of B's where A has none; judged in per cent only."""
    if A.design is None or B.design is None:
        return []
    speeds = [
        interval["V1"] + _OPEN if interval["V2"] is None else (interval["V1"] + interval["V2"]) / 2
        for interval in _side(A)["intervals"] or _side(B)["intervals"]
    ]
    rates = [
        growth_rate_of(exact_table(side.bicycle, *design, model=side.model), np.array(speeds))
        for side, design in ((A, A.design), (B, B.design))
    ]
    rows = []
    for V, *both in zip(speeds, *rates, strict=True):
        a, b = (float(x) if math.isfinite(x) else None for x in both)
        row = change(f"growth rate at {V:.4g} m/s", "1/s", a, b)
        if isinstance(within, str):
            row["within"] = _near(a, b, within)
        rows.append(row)
    return rows


def change(what: str, unit: str, a: float | None, b: float | None) -> Change:
    """A quantity of both without kinds and verdict."""
    step = None if a is None or b is None else b - a
    percent = None if step is None or not a else 100 * step / abs(a)
    return {
        "what": what, "unit": unit, "A": a, "B": b, "change": step, "percent": percent,
        "A_kind": None, "B_kind": None, "within": None,
    }  # fmt: skip
