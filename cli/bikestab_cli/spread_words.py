"""How far stable speeds are known, in a line or a paragraph."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bikestab.design.spread import End, Spread


def in_one_line(result: Spread) -> str:
    """How many machines are stable somewhere, and where nine tenths of their ends lie."""
    exists = f"stable speeds exist in {result['exists']:.1%} of machines within the uncertainties"
    if not result["exists"]:
        return exists
    return f"{exists}; {_quantiles('V1', result['V1'])}, {_quantiles('V2', result['V2'])} m/s (90 %)"


def told_spread(result: Spread) -> str:
    """The same, with the linear rule beside it and the reasons why that is wrong."""
    names = ", ".join(f"{name} ± {sd:.4g}" for name, sd in result["deviations"].items())
    lines = [f"uncertain: {names}", *in_one_line(result).split("; ")]
    lines.append(f"standard deviations: {_deviations('V1', result['V1'])}; {_deviations('V2', result['V2'])}")
    if result["refused"]:
        total = result["samples"] + result["refused"]
        lines.append(f"{result['refused']} of {total} drawn machines cannot exist, and are left out")
    if result["reasons"]:
        lines.append("the linear rule does not hold here: " + "; ".join(result["reasons"]))
    return "\n".join(lines)


def _quantiles(name: str, end: End) -> str:
    low, middle, high = (_speed(end[key]) for key in ("low", "median", "high"))
    return f"{name} = {middle} [{low}, {high}]"


def _speed(value: float | None) -> str:
    if value is None:
        return "none"
    return "unbounded" if math.isinf(value) else f"{value:.2f}"


def _deviations(name: str, end: End) -> str:
    linear, sampled = ("none" if x is None else f"{x:.3g}" for x in (end["linear"], end["sampled"]))
    return f"{name} {linear} m/s by the linear rule, {sampled} sampled"
