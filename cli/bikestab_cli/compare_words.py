"""The differences of two machines, or of one and several others, in tables of 80 columns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from bikestab_cli.output import DESIGN_HEAD, design_columns, prose, table, within

from bikestab.records import letter_of

_BESIDE = 4  # machines in a table, at most
_MOST = 1000  # per cent: of what is nearly zero they say nothing
_SIZE = "%: of the size of A's value"
Change = Mapping[str, Any]


def told(record: Mapping[str, Any]) -> str:
    """What the two are, the parameters that differ, and by how much the stable speeds and region do."""
    asked = record["within"] is not None
    parts = _heads([record["A"], record["B"]])
    if record["parameters"]:
        rows = [_row(each, False) for each in record["parameters"]]
        parts.append(table(["parameter", "A", "B", "change", "%", ""], rows))
    rows = [_row(each, asked) for each in (*record["ends"], *record["growth_rate"])]
    if rows:
        parts.append(table(["", "A", "B", "change", "%", ""], rows, fold=0) + f"\n{_SIZE}")
    else:
        none = record["A"]["design"] and record["B"]["design"] and "no stable speed of either design"
        parts.append(none or "one of them has no design of its own: give --lam and --sigma")
    parts.append(prose(_region(record["region"], asked)))
    return "\n\n".join([*parts, *_verdict([record])])


def told_all(records: Sequence[Mapping[str, Any]], parameters: Sequence[Sequence[Change]]) -> str:
    """The first and all others: values of each, and by how much they differ from the first's.

    ``parameters`` are those that differ, in one notation for all.
    """
    sides = [records[0]["A"], *(record["B"] for record in records)]
    asked = records[0]["within"] is not None
    parts = _heads(sides)
    before = len(parts)
    for start in range(0, len(records), _BESIDE - 1):
        some = slice(start, start + _BESIDE - 1)
        letters = ["A", *(letter_of(start + i + 1) for i in range(len(records[some])))]
        if rows := _beside(parameters[some], asked, of_machine=True):
            parts.append(table(["parameter", *letters], rows))
        found = [[*record["ends"], *record["growth_rate"]] for record in records[some]]
        if rows := _beside(found, asked):
            parts.append(table(["", *letters], rows, fold=0))
    if len(parts) > before:
        parts[-1] += f"\n=: as A; {_SIZE}"
    without = [letter_of(i) for i, side in enumerate(sides) if not side["design"]]
    if without:
        has = "has no design of its own" if len(without) == 1 else "have no design of their own"
        parts.append(f"{', '.join(without)} {has}: give --lam and --sigma")
    elif not any(record["ends"] for record in records):
        parts.append("no stable speed of any design")
    parts.append(_regions(records, asked))
    return "\n\n".join([*parts, *_verdict(records)])


def _heads(sides: Sequence[Mapping[str, Any]]) -> list[str]:
    """Who they are, and their designs."""
    letters = [letter_of(i) for i in range(len(sides))]
    heads = [
        f"{letter}: {side['name']}" + ("" if side["name"] == side["bicycle"] else f" ({side['bicycle']})")
        + f", {side['model']} model, damping {side['delta']:g} kg m²/s"
        for letter, side in zip(letters, sides, strict=True)
    ]  # fmt: skip
    parts = [prose("\n".join(heads))]
    designs = [
        [letter, *design_columns(side["design"])]
        for letter, side in zip(letters, sides, strict=True)
        if side["design"]
    ]
    return [*parts, table(["", *DESIGN_HEAD], designs)] if designs else parts


def _verdict(records: Sequence[Mapping[str, Any]]) -> list[str]:
    limit = records[0]["within"]
    if limit is None:
        return []
    holds = all(record["holds"] for record in records)
    return [f"{'within' if holds else 'BEYOND'} {limit if isinstance(limit, str) else f'{limit:g} m/s'}"]


def _beside(found: Sequence[Sequence[Change]], asked: bool, *, of_machine: bool = False) -> list[list[str]]:
    """A row for each quantity that some have; of a machine = where one is the first's, else the change."""
    rows: dict[str, list[str]] = {}
    for i, changes in enumerate(found):
        for change in changes:
            none = ["=" if of_machine else ""] * len(found)
            row = rows.setdefault(_named(change), [_cell(change, "A"), *none])
            shown = [_cell(change, "B")]
            if not of_machine and change["change"] is not None:
                shown.append(f"{percent} %" if (percent := _percent(change)) else f"{change['change']:+.3g}")
            if not of_machine:
                shown.append("BEYOND" if asked and change["within"] is False else "")
            row[i + 1] = "\n".join(filter(None, shown))
    return [[name, *row] for name, row in rows.items()]


def _regions(records: Sequence[Mapping[str, Any]], asked: bool) -> str:
    """The stable region of each, and by how much it differs from the first's."""
    first = records[0]["region"]
    if any((_box(each), each["A"]) != (_box(first), first["A"]) for each in (r["region"] for r in records)):
        return "\n\n".join(
            prose(f"A and {letter_of(i)}, {_region(record['region'], asked)}")
            for i, record in enumerate(records, 1)
        )
    rows = [["A", within(first["A"], 11), *[""] * 4]]
    for i, record in enumerate(records, 1):
        found = record["region"]
        share = f"{100 * found['share']:.3g}" + ("\nBEYOND" if asked and found["within"] is False else "")
        numbers = [within(found[key], 11) for key in ("B", "difference", "union")]
        rows.append([letter_of(i), *numbers, share, f"{found['mean']:.3g}"])
    unit = f"[{first['unit']}]"
    head = ["", *(f"{what}\n{unit}" for what in ("volume", "difference", "union")), "%", "mean\n[m/s]"]
    note = "difference: of this region and A's; mean: by how much the stable speeds differ"
    return f"{prose(_box(first))}\n{table(head, rows)}\n{note}"


def _row(change: Change, asked: bool) -> list[str]:
    step = "" if change["change"] is None else within(change["change"], 10)
    percent = _percent(change) or ("" if change["percent"] is None else "-")
    verdict = "" if not asked or change["within"] is None else "" if change["within"] else "BEYOND"
    return [_named(change), _cell(change, "A"), _cell(change, "B"), step, percent, verdict]


def _percent(change: Change) -> str:
    """The change of what is not nearly zero."""
    percent = change["percent"]
    return "" if percent is None or abs(percent) >= _MOST else f"{percent:+.3g}"


def _named(change: Change) -> str:
    unit = "" if change["unit"] in ("", "1") or change["unit"] in change["what"] else f" [{change['unit']}]"
    return f"{change['what']}{unit}"


def _cell(change: Change, side: str) -> str:
    value, kind = change[side], change[f"{side}_kind"]
    number = ("" if kind else "-") if value is None else f"{value:.6f}" if kind else within(value, 11)
    return "\n".join(filter(None, (number, kind)))


def _box(found: Mapping[str, Any]) -> str:
    box = ", ".join(f"{name} = {low:.4g} ... {high:.4g}" for name, (low, high) in found["box"].items())
    return f"stable region over {box}:"


def _region(found: Mapping[str, Any], asked: bool) -> str:
    verdict = "" if not asked or found["within"] else ": BEYOND"
    return (
        f"{_box(found)}\n"
        f"symmetric difference {found['difference']:.6g} of a union of {found['union']:.6g} {found['unit']}, "
        f"{100 * found['share']:.3g} %{verdict}\n"
        f"volumes {found['A']:.6g} and {found['B']:.6g}; "
        f"stable speeds differ by {found['mean']:.3g} m/s on the mean"
    )
