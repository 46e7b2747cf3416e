"""Sensitivities in words and tables of 80 columns."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from bikestab_cli.output import design_columns, heading, prose, table
from bikestab_cli.sensitivity_more import growth_moved, line, sigma_moved

from bikestab.units import BUILDERS

if TYPE_CHECKING:
    from bikestab.design.effects import Row, Tried
    from bikestab.design.sensitivity import Sensitivity
    from bikestab.records import Interval
    from bikestab.region.first_sigma import FirstSigma

_LEAST = 4  # listed as those that lower V1 most easily
_NAMES = 6  # listed as those that widen the interval most
HELD = {
    "trail": "trail held: it stays where tilt, wheelbase and front wheel vary",
    "offset": "offset held: the fork stays; the trail follows tilt and front wheel",
    "sigma": "σ held: the trail grows with the wheelbase",
}


def told(found: Sensitivity, first: FirstSigma, record: Mapping[str, Any], changes: str) -> str:
    """One machine: what the design is, a table for each stable interval, and what it says in words."""
    parts = [opening(found, changes)]
    for interval in record["intervals"]:
        rows = interval["parameters"]
        parts.append(f"stable from {ends_of(interval)}")
        doubts = _doubts(found, rows)
        parts.append(_table([row for row in rows if row["notation"]], "parameter", doubts))
        parts.append(_table([row for row in rows if not row["notation"]], "front", doubts))
        parts.append(_words(rows, doubts))
    if not record["intervals"]:
        parts.append("no stable speed, and so no end of one to move; 'bikestab vrange' says what is nearest")
    parts += [line(found, growth_moved(found)), line(found, sigma_moved(first))]
    parts.append("computed anew, not by derivatives:\n" + _tried(record["tried"], record["intervals"]))
    return "\n\n".join(prose(part) for part in parts if part)


def opening(found: Sensitivity, changes: str) -> str:
    """Which machine and design it is, and what is held."""
    changed = f" ({changes})" if changes else ""
    return f"{heading(found.bicycle, found.model)}{changed}\n{_design(found)}\n{HELD[found.hold]}"


def _design(found: Sensitivity) -> str:
    from bikestab.records import design_record

    design = design_record(found.lam, found.sigma, found.bicycle)
    (lam, head), (sigma, trail), (_, offset) = (cell.split("\n") for cell in design_columns(design))
    return f"λ = {lam} rad, σ = {sigma}\nhead angle {head}°, trail {trail} m, offset {offset} m"


def ends_of(interval: Interval) -> str:
    """An interval in words."""
    above = "on, without an upper limit"
    if interval["V2"] is not None:
        above = f"to {interval['V2']:.6f} m/s ({interval['upper']})"
    return f"{interval['V1']:.6f} m/s ({interval['lower']}) {above}"


def _doubts(found: Sensitivity, rows: Sequence[Row]) -> dict[str, str]:
    """What is doubtful of the machine with a parameter changed by its ``change``, where it is not without."""
    own = {_without_numbers(text) for text in found.bicycle.warnings}
    doubts = {}
    for row in rows:
        if row["change"] and row["notation"] and row["name"] not in ("lam", "sigma"):
            other = found.bicycle.replaced({row["name"]: row["value"] + row["change"]})
            new = [text for text in other.warnings if _without_numbers(text) not in own]
            if new:
                doubts[row["name"]] = "; ".join(new)
    return doubts


def _without_numbers(text: str) -> str:
    return re.sub(r"\d[\d.e+-]*", "", text)


def _table(rows: Sequence[Row], first: str, doubts: Mapping[str, str]) -> str:
    head = [first, "value", "unit", "dV1/dp", "%/%", "dV2/dp", "%/%", "V1 -0.1"]
    cells = [
        [
            row["name"], f"{row['value'] * size:.5g}", unit,
            _number(row["dV1"], 1 / size), share(row["elasticity_V1"]),
            _number(row["dV2"], 1 / size), share(row["elasticity_V2"]),
            _number(row["change"], size, "+.3g") + ("*" if row["name"] in doubts else " " if doubts else ""),
        ]
        for row in rows
        for unit, size in [BUILDERS.get(row["unit"], (row["unit"], 1.0))]
    ]  # fmt: skip
    return table(head, cells)


def _number(value: float | None, size: float, style: str = ".4g") -> str:
    return "-" if value is None else f"{value * size:{style}}"


def share(value: float | None) -> str:
    return "-" if value is None else f"{value:z.3f}"


def _words(rows: Sequence[Row], doubts: Mapping[str, str]) -> str:
    """What the last column is, and which parameters widen the interval most."""
    change = (
        "V1 -0.1: by how much it alone must change for V1 to fall by 0.1 m/s; -: none does that was tried, "
    )
    change += "up to its own value; not tried for g, which nobody can change"
    lines = [
        "%/%: per cent of the speed for one per cent of the parameter",
        change,
        *(f"* {name}: {text}" for name, text in doubts.items()),
    ]
    if least := _least(rows, doubts):
        lines.append(f"to lower V1 by 0.1 m/s these change least, as a share of themselves: {least}")
    unmoved = [row["name"] for row in rows if row["dV1"] == 0 and row["dV2"] in (0, None)]
    if unmoved:
        lines.append(f"these do not move the ends: {', '.join(unmoved)}")
    gains = {row["name"]: gain for row in rows if row["notation"] and (gain := _gain(row))}
    for way, word in ((1, "increase"), (-1, "decrease")):
        names = sorted((name for name in gains if way * gains[name] > 0), key=lambda name: -abs(gains[name]))
        if names:
            lines.append(f"wider when these {word}: {', '.join(names[:_NAMES])}")
    return "\n".join(lines)


def _least(rows: Sequence[Row], doubts: Mapping[str, str]) -> str:
    """The parameters of which the smallest changes, as shares of their values, lower V1."""
    found = []
    for row in rows:
        if row["change"] and row["value"] and row["notation"]:
            unit, size = BUILDERS.get(row["unit"], (row["unit"], 1.0))
            share = abs(row["change"] / row["value"])
            mark = "*" if row["name"] in doubts else ""
            found.append((share, f"{row['name']} {row['change'] * size:+.3g}{mark} {unit} ({share:.1%})"))
    return ", ".join(text for _, text in sorted(found)[:_LEAST])


def _gain(row: Row) -> float | None:
    """How much wider the interval gets, in m/s where the number increases by one per cent of its size."""
    if row["dV1"] is None or row["dV2"] is None:
        return None
    return 0.01 * abs(row["value"]) * (row["dV2"] - row["dV1"])


def _tried(results: Sequence[Tried], own: Sequence[Interval]) -> str:
    rows = [["as it is", *_interval(widest_of(own))]]
    rows += [[each["what"], *_interval(each["interval"])] for each in results]
    return table(["", "V1 [m/s]", "V2 [m/s]", "width [m/s]"], rows)


def widest_of(own: Sequence[Interval]) -> Interval | None:
    return max(own, key=lambda i: math.inf if i["V2"] is None else i["V2"] - i["V1"], default=None)


def _interval(interval: Interval | None) -> list[str]:
    if interval is None:
        return ["none", "", ""]
    if interval["V2"] is None:
        return [f"{interval['V1']:.3f}", "unbounded", ""]
    return [f"{interval['V1']:.3f}", f"{interval['V2']:.3f}", f"{interval['V2'] - interval['V1']:.3f}"]
