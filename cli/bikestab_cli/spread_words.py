"""How far stable speeds are known, in a few lines or a paragraph."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from bikestab_cli.options import tell_once

from bikestab.rider import left_behind

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.design.spread import End, Spread


def tell_rider(bicycle: Bicycle, deviations: Mapping[str, float]) -> None:
    """Say where the rider's mass is uncertain, and the inertia is drawn as it is."""
    uncertain = {name: sd for name, sd in deviations.items() if sd}
    if note := left_behind(bicycle.given, uncertain):
        tell_once(f"note: {bicycle.name}: {note}")


def known_lines(result: Spread) -> list[str]:
    """How many machines are stable somewhere; each end ± its deviation, and where nine tenths of them lie."""
    exists = f"stable speeds exist in {result['exists']:.1%} of machines within the uncertainties"
    if not result["exists"]:
        return [exists]
    return [exists, *(_known(name, end) for name, end in _ends(result))]


def told_spread(result: Spread) -> str:
    """The same, with the linear rule beside it and the reasons why that is wrong."""
    names = ", ".join(f"{name} ± {sd:.4g}" for name, sd in result["deviations"].items())
    lines = [f"uncertain: {names}", *known_lines(result)]
    lines.append("standard deviations: " + "; ".join(_deviations(name, end) for name, end in _ends(result)))
    if result["refused"]:
        total = result["samples"] + result["refused"]
        lines.append(f"{result['refused']} of {total} drawn machines cannot exist, and are left out")
    if result["reasons"]:
        lines.append("the linear rule does not hold here: " + "; ".join(result["reasons"]))
    return "\n".join(lines)


def _ends(result: Spread) -> tuple[tuple[str, End], tuple[str, End]]:
    return ("V1", result["V1"]), ("V2", result["V2"])


def _known(name: str, end: End) -> str:
    """An end of the machine as it is, the sampled deviation of it, and where nine tenths of the ends lie."""
    own, sampled = end["own"], end["sampled"]
    digits = max(2, -math.floor(math.log10(sampled))) if sampled else 2
    nine_tenths = f"90 % within [{_speed(end['low'], digits)}, {_speed(end['high'], digits)}] m/s"
    if own is None or math.isinf(own):
        return f"{name} {_speed(own, digits)}, {nine_tenths}"
    deviation = "" if sampled is None else f" ± {sampled:.{digits}f}"
    return f"{name} = {own:.{digits}f}{deviation} m/s, {nine_tenths}"


def _speed(value: float | None, digits: int) -> str:
    if value is None:
        return "none"
    return "unbounded" if math.isinf(value) else f"{value:.{digits}f}"


def _deviations(name: str, end: End) -> str:
    linear, sampled = ("none" if x is None else f"{x:.3g}" for x in (end["linear"], end["sampled"]))
    return f"{name} {linear} m/s by the linear rule, {sampled} sampled"
