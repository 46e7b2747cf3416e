"""What a config expects of stable speeds, held against the exact ones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from time import perf_counter
from typing import Any, Literal, NamedTuple

from bikestab.arguments import design_of
from bikestab.bicycle import Bicycle
from bikestab.config.checkconfig import CheckConfig
from bikestab.config.parts import Expectation
from bikestab.config.scanconfig import ScanConfig
from bikestab.config.tolerance import allowance
from bikestab.errors import InputError
from bikestab.model import exact_table
from bikestab.records import Design, Interval, design_record, interval_records
from bikestab.speeds import intervals_of
from bikestab.variants import check_names, check_values, parameter_of, varied

_Key = tuple[str | int, ...]


class Edge(NamedTuple):
    """An end of stable speeds, V1 or V2: expected, found, and how far the two may be apart [m/s].

    These speeds are inf where unbounded; what was not found is None.
    """

    name: Literal["V1", "V2"]
    expected: float
    found: float | None
    allowed: float

    @property
    def difference(self) -> float | None:
        """By how much what was found is above what is expected [m/s]; None where that is no number."""
        if self.found is None or math.isinf(self.found) or math.isinf(self.expected):
            return None
        return self.found - self.expected

    @property
    def holds(self) -> bool:
        """Whether it was found where it is expected."""
        difference = self.difference
        return self.found == self.expected if difference is None else abs(difference) <= self.allowed


class Outcome(NamedTuple):
    """An expectation, the design it is of, the stable intervals found there, and whether it holds.

    ``edges`` are the ends that are expected, as the ``nearest`` of these intervals has them, told by its
    number; all this took so many ``seconds``. ``units`` are those of the parameters with values of their own.
    """

    expected: Expectation
    design: Design
    found: list[Interval]
    nearest: int | None
    edges: list[Edge]
    holds: bool
    seconds: float
    units: dict[str, str]


def outcome_of(config: ScanConfig | CheckConfig, expected: Expectation, key: _Key) -> Outcome:
    """An expectation at ``key`` held against the exact speeds; InputError if it is of no design."""
    start = perf_counter()
    machine, lam, sigma = _designed(config.machine, expected, key)
    found = interval_records(intervals_of(exact_table(machine, lam, sigma, model=config.model)))
    nearest, edges = nearest_interval(expected, found)
    holds = not found if expected.stable else all(edge.holds for edge in edges)
    design = design_record(lam, sigma, machine)
    units = {name: parameter_of(config.machine, name).unit for name in expected.model_extra or {}}
    return Outcome(expected, design, found, nearest, edges, holds, perf_counter() - start, units)


def _designed(
    bicycle: Bicycle, expected: Expectation, key: tuple[str | int, ...]
) -> tuple[Any, float, float]:
    """The machine of an expectation, with λ and σ."""
    if not expected.model_extra:
        try:
            lam, sigma = (float(x) for x in design_of(bicycle, expected.lam, expected.sigma))
        except InputError as error:
            raise InputError(error.problem, key=key, hint="give lam and sigma in the entry") from None
        return bicycle, lam, sigma
    try:
        check_names(bicycle, {name: name for name in expected.values})
        check_values(bicycle, expected.values)
    except InputError as error:
        raise InputError(error.problem, key=(*key, *error.key), hint=error.hint) from None
    machine, lam, sigma = varied(bicycle, expected.values)
    return machine, float(lam), float(sigma)


def nearest_interval(expected: Expectation, found: Sequence[Interval]) -> tuple[int | None, list[Edge]]:
    """Which of the intervals comes nearest to what is expected, and its ends that are expected.

    None and ends that were not found where there is no interval, or none is expected.
    """
    each = [_edges(expected, interval) for interval in found]
    if not each or expected.stable:
        return None, _edges(expected, None)
    best = min(range(len(each)), key=lambda i: [sum(part) for part in zip(*map(_far, each[i]), strict=True)])
    return best, each[best]


def _edges(expected: Expectation, found: Interval | None) -> list[Edge]:
    """The ends that are expected, as an interval has them."""
    V1, V2 = (found["V1"], found["V2"]) if found else (None, None)
    if found and V2 is None:
        V2 = math.inf
    edges = []
    if expected.V1 is not None:
        edges.append(Edge("V1", expected.V1, V1, allowance(expected.within, expected.V1)))
    if expected.V2 is not None:  # per cent of no bound are without bound, too
        allowed = 0.0 if math.isinf(expected.V2) else allowance(expected.within, expected.V2)
        edges.append(Edge("V2", expected.V2, V2, allowed))
    return edges


def _far(edge: Edge) -> tuple[bool, bool, float]:
    """Whether an end is missed, and by how much: without bound, or this far."""
    difference = edge.difference
    return not edge.holds, not edge.holds and difference is None, abs(difference or 0.0)
