"""What a config expects of stable speeds, held against the exact ones."""

from __future__ import annotations

import math
from typing import NamedTuple

from bikestab.arguments import design_of
from bikestab.config.scanconfig import CheckConfig, Expectation, ScanConfig
from bikestab.config.tolerance import allowance
from bikestab.errors import InputError
from bikestab.records import Design, Interval, design_record, interval_records
from bikestab.stability import stable_intervals


class Outcome(NamedTuple):
    """An expectation, the design it is of, the stable intervals found there, and whether it holds."""

    expected: Expectation
    design: Design
    found: list[Interval]
    holds: bool


def outcomes(config: ScanConfig | CheckConfig) -> list[Outcome]:
    """Every expectation of the config, in its order; InputError if there is none, or one is of no design."""
    if not config.expect:
        raise InputError("has no expectations", hint="add 'expect:', see 'bikestab init'")
    return [_outcome(config, expected, ("expect", i)) for i, expected in enumerate(config.expect)]


def _outcome(config: ScanConfig | CheckConfig, expected: Expectation, key: tuple[str | int, ...]) -> Outcome:
    try:
        lam, sigma = (float(x) for x in design_of(config.machine, expected.lam, expected.sigma))
    except InputError as error:
        raise InputError(error.problem, key=key, hint="give lam and sigma in the entry") from None
    found = interval_records(stable_intervals(config.machine, lam, sigma, model=config.model))
    holds = any(_agrees(expected, interval) for interval in found) if expected.stable is None else not found
    return Outcome(expected, design_record(lam, sigma, config.machine), found, holds)


def _agrees(expected: Expectation, found: Interval) -> bool:
    V2 = math.inf if found["V2"] is None else found["V2"]
    return all(
        wanted is None or wanted == V or abs(wanted - V) <= allowance(expected.within, wanted)
        for wanted, V in ((expected.V1, found["V1"]), (expected.V2, V2))
    )
