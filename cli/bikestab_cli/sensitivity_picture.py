"""Pictures of what each parameter moves, machines side by side."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bikestab_cli.sensitivity_more import MOVED, panel, title
from bikestab_cli.sensitivity_words import ends_of

if TYPE_CHECKING:
    from bikestab_cli.sensitivity_found import Found

_LETTERS = 34  # beneath bars


def draw(found: Sequence[Found], what: str, output: str) -> None:
    """The effects on the speeds, the lowest growth rate, or the smallest stable σ."""
    from bikestab.plot.files import save

    save(_speeds(found) if what == "speeds" else _moved(found, what), Path(output))


def _speeds(found: Sequence[Found]) -> Any:
    """The effects on the ends of each machine's widest stable interval."""
    from bikestab.design.effects import width
    from bikestab.plot.tornado import draw_tornado

    machines = []
    for each in found:
        widest: Any = max(each.record["intervals"], key=width, default={"parameters": []})
        lines = title(each.of, each.machine.words)
        if widest["parameters"]:
            lines.append(f"stable from {ends_of(widest)}")
        machines.append((lines, widest["parameters"]))
    return draw_tornado(machines)


def _moved(found: Sequence[Found], what: str) -> Any:
    from bikestab.plot.tornado import draw_bars

    moved = [MOVED[what](each.of, each.first) for each in found]
    panels = [panel(each.of, of, each.machine.words) for each, of in zip(found, moved, strict=True)]
    of, unit = moved[0], moved[0].unit.strip()
    words = f"change of the {of.what} with 1 % more{f' [{unit}]' if unit else ''}"
    words = "\n".join([*textwrap.wrap(words, _LETTERS), f"← better: {of.lower}"])
    return draw_bars(panels, words, unit=unit)
