"""The modes of a design in words and a table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from bikestab_cli.output import (
    DESIGN_HEAD,
    WIDTH,
    certain,
    decimals,
    design_columns,
    heading,
    heading_of_all,
    prose,
    table,
)

if TYPE_CHECKING:
    from bikestab_cli.several import Chosen

    from bikestab.model import Model
    from bikestab.modes import Modes
    from bikestab.records import Design, Interval, Verdict

COLUMNS = ("weave", "capsize", "castering")
_ROUNDING = 1e-13  # of an eigenvalue's size: a real part that is no more is zero
_HEAD = ["V\n[m/s]", *(f"{name}\n[1/s]" for name in (*COLUMNS, "others"))]


class Followed(NamedTuple):
    """The modes of one machine's design, and its stable speeds."""

    machine: Chosen
    design: Design
    intervals: list[Interval]
    verdict: Verdict
    modes: Modes


def told(found: Followed, model: Model) -> str:
    """The design, its stable speeds, where eigenvalues meet, and the table of eigenvalues."""
    changed = f" ({found.machine.changes})" if found.machine.set else ""
    parts = [
        prose(heading(found.machine.bicycle, model) + changed),
        table(DESIGN_HEAD, [design_columns(found.design)]),
        prose("\n".join([*_stable(found), *_meetings(found.modes, max(found.modes.V))])),
        narrowed(lambda digits: _table([], _rows(found.modes, digits), 4)),
    ]
    return "\n\n".join(parts)


def told_all(found: Sequence[Followed], model: Model, left_out: Sequence[str]) -> str:
    """The same of several machines in one table of designs and one of eigenvalues, and who is left out."""
    designs = [[each.machine.stacked, *design_columns(each.design)] for each in found]
    notes = [*(f"{each.machine.words}: {'; '.join(_stable(each))}" for each in found), *left_out]

    def eigenvalues(digits: int) -> str:
        rows = []
        for each in found:
            own = _rows(each.modes, digits)
            rows += [[each.machine.stacked if i == 0 else "", *row] for i, row in enumerate(own)]
        return _table(["machine"], rows, 0)

    designs_table = table(["machine", *DESIGN_HEAD], designs, fold=0)
    head = heading_of_all([each.machine.bicycle for each in found], model, found[0].machine.set)
    return "\n\n".join([prose(head), designs_table, prose("\n".join(notes)), narrowed(eigenvalues)])


def _stable(found: Followed) -> list[str]:
    marginal = [f"marginal: {found.verdict['reason']}"] if found.verdict["marginal"] else []
    return [*([*map(interval_words, found.intervals)] or ["no stable speed"]), *marginal]


def narrowed(text: Callable[[int], str]) -> str:
    """The text with as many digits, of six, as 80 columns have room for."""
    for digits in range(6, 0, -1):
        shown = text(digits)
        if max(map(len, shown.splitlines())) <= WIDTH:
            break
    return shown


def interval_words(interval: Interval) -> str:
    """One interval of stable speeds in a sentence."""
    lower = f"{certain(interval['V1'], interval['V1_error'], 6)} m/s ({interval['lower']})"
    if interval["V2"] is None:
        return f"stable from {lower} on, without upper limit"
    return (
        f"stable from {lower} to {certain(interval['V2'], interval['V2_error'], 6)} m/s ({interval['upper']})"
    )


def _meetings(modes: Modes, up_to: float) -> list[str]:
    """What becomes of the eigenvalues that meet, and of the names of the others."""
    from bikestab.modenames import OSCILLATING

    lines = []
    for V, pair, below, above in zip(
        modes.coalescences, modes.meeting, modes.below, modes.above, strict=True
    ):
        before, behind = (", ".join(dict.fromkeys(names[row] for row in pair)) for names in (below, above))
        if above[pair[0]] in OSCILLATING:
            line = f"two real eigenvalues ({before}) become a complex pair ({behind})"
        else:
            line = f"a complex pair ({before}) becomes two real eigenvalues ({behind})"
        others = [
            (below[row], above[row]) for row in range(4) if row not in pair and below[row] != above[row]
        ]
        renamed = [f"; {old} is {new} from there on" for old, new in dict.fromkeys(others)]
        if up_to >= V:
            lines.append(f"at {V:.6f} m/s {line}{''.join(renamed)}")
    return lines


def eigenvalue_table(first: str, rows: Sequence[tuple[str, Modes]]) -> str:
    """A row for each of some modes at one speed, behind the cell of the column ``first``."""

    def shown(digits: int) -> str:
        return _table([], [[cell, *_rows(modes, digits)[0][1:]] for cell, modes in rows], 4, first)

    return narrowed(shown)


def _table(first: list[str], rows: list[list[str]], fold: int, axis: str = _HEAD[0]) -> str:
    """The eigenvalues; the last column is left out where it is empty."""
    head = [*first, axis, *_HEAD[1:]]
    if not any(row[-1] for row in rows):
        head, rows, fold = head[:-1], [row[:-1] for row in rows], 0 if first else -1
    return table(head, rows, fold=None if fold < 0 else fold)


def _rows(modes: Modes, digits: int) -> list[list[str]]:
    """A row for each speed, a column for each of the three modes and one for what else there is."""
    found = zip(modes.V, modes.eigenvalues.T, modes.names.T, strict=True)
    return [[f"{V:.6g}", *_row(s, names, digits)] for V, s, names in found]


def _row(s: Any, names: Any, digits: int) -> list[str]:
    """The eigenvalues at a speed in the columns of their names; those of others have the name below."""
    cells = {name: _motion(s[names == name], digits) for name in dict.fromkeys(names.tolist())}
    if "weave" not in cells and "real pair" in cells:
        cells["weave"] = f"{cells.pop('real pair')}\n(real pair)"
    others = [f"{text}\n({name})" for name, text in cells.items() if name not in COLUMNS]
    return [*(cells.get(name, "") for name in COLUMNS), "\n".join(others)]


def _motion(s: Any, digits: int) -> str:
    """The eigenvalues of one name: pairs as one, real ones each."""
    return ", ".join(eigenvalue(x, digits) for x in s.tolist() if x.imag >= 0)


def eigenvalue(s: complex, digits: int) -> str:
    """An eigenvalue with so many digits, of a pair both."""
    if not s.imag:
        return decimals(s.real, digits)
    return f"{decimals(s.real, digits, _ROUNDING * abs(s))} ± {decimals(s.imag, digits)}i"
