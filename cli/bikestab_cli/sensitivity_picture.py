"""Pictures of what each parameter moves, machines side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bikestab_cli.sensitivity_more import bars

if TYPE_CHECKING:
    from bikestab_cli.sensitivity_more import Moved
    from bikestab_cli.several import Chosen

    from bikestab.design.sensitivity import Sensitivity


def draw_speeds(machines: Sequence[Chosen], records: Sequence[Mapping[str, Any]], output: str) -> None:
    """The effects on the ends of each machine's widest stable interval."""
    from bikestab.design.effects import width
    from bikestab.plot.files import save
    from bikestab.plot.tornado import draw_tornado

    panels = []
    for machine, record in zip(machines, records, strict=True):
        widest: Any = max(record["intervals"], key=width, default={"parameters": []})
        panels.append((machine.words, widest["parameters"]))
    save(draw_tornado(panels), Path(output))


def draw_moved(
    machines: Sequence[Chosen], found: Sequence[Sensitivity], moved: Sequence[Moved], output: str
) -> None:
    """The effects on each machine's lowest growth rate, or smallest stable σ."""
    from bikestab.plot.files import save
    from bikestab.plot.tornado import Bar, Panel, draw_bars

    panels = [
        Panel(machine.words, [Bar(*each) for each in bars(own, of)], f"no {of.what}")
        for machine, own, of in zip(machines, found, moved, strict=True)
    ]
    unit = f" [{moved[0].unit.strip()}]" if moved[0].unit else ""
    save(draw_bars(panels, f"change of the {moved[0].what}{unit}\nwith 1 % more"), Path(output))
