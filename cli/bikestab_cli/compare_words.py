"""Two machines' differences in a table of 80 columns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bikestab_cli.output import DESIGN_HEAD, design_columns, prose, table, within


def told(record: Mapping[str, Any]) -> str:
    """What the two are, the parameters that differ, and by how much the stable speeds and region do."""
    sides = {letter: record[letter] for letter in ("A", "B")}
    heads = [
        f"{letter}: {side['name']}" + ("" if side["name"] == side["bicycle"] else f" ({side['bicycle']})")
        + f", {side['model']} model, damping {side['delta']:g} kg m²/s"
        for letter, side in sides.items()
    ]  # fmt: skip
    parts = [prose("\n".join(heads))]
    designs = [[letter, *design_columns(side["design"])] for letter, side in sides.items() if side["design"]]
    if designs:
        parts.append(table(["", *DESIGN_HEAD], designs))
    asked = record["within"] is not None
    if record["parameters"]:
        rows = [_row(each, False) for each in record["parameters"]]
        parts.append(table(["parameter", "A", "B", "change", "%", ""], rows))
    rows = [_row(each, asked) for each in (*record["ends"], *record["growth_rate"])]
    if rows:
        parts.append(table(["", "A", "B", "change", "%", ""], rows, fold=0))
    elif len(designs) == 2:
        parts.append("no stable speed of either design")
    else:
        parts.append("one of them has no design of its own: give --lam and --sigma")
    parts.append(prose(_region(record["region"], asked)))
    if asked:
        limit = record["within"] if isinstance(record["within"], str) else f"{record['within']:g} m/s"
        parts.append(f"{'within' if record['holds'] else 'BEYOND'} {limit}")
    return "\n\n".join(parts)


def _row(change: Mapping[str, Any], asked: bool) -> list[str]:
    cells = [
        "\n".join(filter(None, (_number(change[side], change[f"{side}_kind"]), change[f"{side}_kind"])))
        for side in ("A", "B")
    ]
    step = "" if change["change"] is None else within(change["change"], 10)
    percent = "" if change["percent"] is None else f"{change['percent']:+.3g}"
    verdict = "" if not asked or change["within"] is None else "" if change["within"] else "BEYOND"
    unit = "" if change["unit"] in ("", "1") or change["unit"] in change["what"] else f" [{change['unit']}]"
    return [change["what"] + unit, *cells, step, percent, verdict]


def _number(value: float | None, kind: str | None) -> str:
    if value is None:
        return "" if kind else "-"
    return f"{value:.6f}" if kind else within(value, 11)


def _region(found: Mapping[str, Any], asked: bool) -> str:
    box = ", ".join(f"{name} = {low:.4g} ... {high:.4g}" for name, (low, high) in found["box"].items())
    verdict = "" if not asked or found["within"] else ": BEYOND"
    unit = "rad m/s" if [*found["box"]][:2] == ["lam", "sigma"] else "in units of the three"
    return (
        f"stable region over {box}:\n"
        f"symmetric difference {found['difference']:.6g} of a union of {found['union']:.6g} {unit}, "
        f"{100 * found['share']:.3g} %{verdict}\n"
        f"volumes {found['A']:.6g} and {found['B']:.6g}; "
        f"stable speeds differ by {found['mean']:.3g} m/s on the mean"
    )
