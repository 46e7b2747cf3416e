"""What a config expects of stable speeds, held against the exact ones."""

from __future__ import annotations

import math
from time import perf_counter
from typing import Any, NamedTuple

from bikestab.arguments import design_of
from bikestab.bicycle import Bicycle
from bikestab.config.scanconfig import CheckConfig, Expectation, ScanConfig
from bikestab.config.tolerance import allowance
from bikestab.errors import InputError
from bikestab.model import exact_table
from bikestab.records import Design, Interval, design_record, interval_records
from bikestab.speeds import intervals_of
from bikestab.variants import check_names, check_values, varied

_Key = tuple[str | int, ...]


class Outcome(NamedTuple):
    """An expectation, the design it is of, the stable intervals found there, and whether it holds.

    And how many ``seconds`` that took.
    """

    expected: Expectation
    design: Design
    found: list[Interval]
    holds: bool
    seconds: float


def outcomes(config: ScanConfig | CheckConfig) -> list[Outcome]:
    """Every expectation of the config, in its order; InputError if there is none, or one is of no design."""
    if not config.expect:
        raise InputError("has no expectations", hint="add 'expect:', see 'bikestab init'")
    return [_outcome(config, expected, ("expect", i)) for i, expected in enumerate(config.expect)]


def _outcome(config: ScanConfig | CheckConfig, expected: Expectation, key: _Key) -> Outcome:
    start = perf_counter()
    machine, lam, sigma = _designed(config.machine, expected, key)
    found = interval_records(intervals_of(exact_table(machine, lam, sigma, model=config.model)))
    holds = not found if expected.stable else not all(missed(expected, interval) for interval in found)
    return Outcome(expected, design_record(lam, sigma, machine), found, holds, perf_counter() - start)


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


def missed(expected: Expectation, found: Interval) -> list[tuple[str, float, float]]:
    """The ends of an interval that are not as expected: name, found, expected [m/s]; inf where unbounded."""
    V2 = math.inf if found["V2"] is None else found["V2"]
    return [
        (name, V, wanted)
        for name, V, wanted in (("V1", found["V1"], expected.V1), ("V2", V2, expected.V2))
        if wanted is not None and not _agree(wanted, V, expected.within)
    ]


def _agree(wanted: float, V: float, within: float | str) -> bool:
    if math.isinf(wanted):  # of which per cent are without bound, too
        return wanted == V
    return abs(wanted - V) <= allowance(within, wanted)
