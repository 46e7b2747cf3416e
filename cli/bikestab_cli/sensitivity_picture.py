"""Pictures of what each parameter moves, machines side by side."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bikestab_cli.sensitivity_more import MOVED, bars

if TYPE_CHECKING:
    from bikestab_cli.sensitivity_found import Found


def draw(found: Sequence[Found], what: str, output: str) -> None:
    """The effects on the speeds, the lowest growth rate, or the smallest stable σ."""
    from bikestab.plot.files import save

    save(_speeds(found) if what == "speeds" else _moved(found, what), Path(output))


def _speeds(found: Sequence[Found]) -> Any:
    """The effects on the ends of each machine's widest stable interval."""
    from bikestab.design.effects import width
    from bikestab.plot.tornado import draw_tornado

    panels = []
    for each in found:
        widest: Any = max(each.record["intervals"], key=width, default={"parameters": []})
        panels.append((each.machine.words, widest["parameters"]))
    return draw_tornado(panels)


def _moved(found: Sequence[Found], what: str) -> Any:
    from bikestab.plot.tornado import Bar, Panel, draw_bars

    moved = [MOVED[what](each.of, each.first) for each in found]
    panels = [
        Panel(each.machine.words, [Bar(*one) for one in bars(each.of, of)], f"no {of.what}")
        for each, of in zip(found, moved, strict=True)
    ]
    unit = f" [{moved[0].unit.strip()}]" if moved[0].unit else ""
    return draw_bars(panels, f"change of the {moved[0].what}{unit}\nwith 1 % more")
