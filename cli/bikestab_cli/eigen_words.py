"""The modes of a design in words and a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bikestab_cli.output import DESIGN_HEAD, certain, design_columns, heading, table

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.model import Model
    from bikestab.modes import Modes
    from bikestab.records import Design, Interval, Verdict

COLUMNS = ("weave", "capsize", "castering")


def told(
    bicycle: Bicycle, model: Model, design: Design, intervals: list[Interval], verdict: Verdict, modes: Modes
) -> str:
    """The design, its stable speeds, where eigenvalues meet, and the table of eigenvalues."""
    meetings = "".join(line + "\n" for line in _meetings(modes, max(modes.V)))
    return "\n".join(
        [
            heading(bicycle, model) + "\n",
            table(DESIGN_HEAD, [design_columns(design)]) + "\n",
            *([*map(interval_words, intervals)] or ["no stable speed"]),
            *([f"marginal: {verdict['reason']}"] if verdict["marginal"] else []),
            meetings,
            _eigenvalue_table(modes),
        ]
    )


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


def _eigenvalue_table(modes: Modes) -> str:
    """A row for each speed, a column for each of the three modes and one for what else there is."""
    rows = [_row(s, names) for s, names in zip(modes.eigenvalues.T, modes.names.T, strict=True)]
    head = ["V [m/s]", *(f"{name} [1/s]" for name in COLUMNS), "others [1/s]"]
    cells = [[f"{V:.6g}", *row] for V, row in zip(modes.V, rows, strict=True)]
    used = 5 if any(row[-1] for row in rows) else 4
    return table(head[:used], [row[:used] for row in cells])


def _row(s: Any, names: Any) -> list[str]:
    """The eigenvalues at a speed in the columns of their names; those of others have the name behind."""
    cells = {name: _motion(s[names == name]) for name in dict.fromkeys(names.tolist())}
    if "weave" not in cells and "real pair" in cells:
        cells["weave"] = f"{cells.pop('real pair')} (real pair)"
    others = [f"{text} ({name})" for name, text in cells.items() if name not in COLUMNS]
    return [*(cells.get(name, "") for name in COLUMNS), ", ".join(others)]


def _motion(s: Any) -> str:
    """The eigenvalues of one name: pairs as one, real ones each."""
    return ", ".join(
        f"{x.real:z.6f} ± {x.imag:z.6f}i" if x.imag else f"{x.real:z.6f}" for x in s if x.imag >= 0
    )
