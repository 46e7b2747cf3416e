"""What eigen shows along the speed: the modes of each machine, their table, picture and record."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from bikestab_cli.chosen import Given, design_chosen
from bikestab_cli.designless import told_without, with_design
from bikestab_cli.eigen_answer import Answer
from bikestab_cli.eigen_words import Followed, told, told_all
from bikestab_cli.options import told_as_options
from bikestab_cli.several import Chosen, told_apart

if TYPE_CHECKING:
    from bikestab.model import Model


def along(
    machines: Sequence[Chosen], lacks: Sequence[str], given: Given, speeds: list[float], model: Model,
    *, locus: bool,
) -> Answer:  # fmt: skip
    """The modes at some speeds of the machines that do not lack a design."""
    found = [_followed(machine, given, speeds, model) for machine in with_design(machines, lacks)]

    def rows() -> tuple[Any, Any]:
        from bikestab.export.tables import MODES, modes_blocks, of_machines

        blocks = [
            (each.machine.bicycle.name, each.machine.changes, modes_blocks(each.modes)) for each in found
        ]
        return of_machines(MODES, blocks)

    def draw() -> Any:
        return _drawn(found, min(speeds), max(speeds), model, locus)

    one = len(machines) == 1
    text = told(found[0], model) if one else told_all(found, model, told_without(machines, lacks))
    return Answer(text, [[_result(each)] for each in found], rows, draw)


def _followed(machine: Chosen, given: Given, speeds: list[float], model: Model) -> Followed:
    from bikestab.records import design_record, interval_records, verdict_record
    from bikestab.stability import modes, stable_intervals

    bicycle = machine.bicycle
    lam, sigma = design_chosen(bicycle, given)
    with told_as_options():
        found = modes(bicycle, speeds, lam, sigma, model=model)
    stable = stable_intervals(bicycle, lam, sigma, model=model)
    design = design_record(lam, sigma, bicycle)
    return Followed(machine, design, interval_records(stable), verdict_record(stable), found)


def _result(found: Followed) -> dict[str, Any]:
    from bikestab.records import modes_record

    return {**found.design, "intervals": found.intervals, **found.verdict, **modes_record(found.modes)}


def _drawn(found: Sequence[Followed], start: float, stop: float, model: Model, locus: bool) -> Any:
    designs = [(each.machine.bicycle, each.design["lam"], each.design["sigma"]) for each in found]
    common, names = told_apart([each.machine for each in found])
    machines = [(name, *design, model) for name, design in zip(names, designs, strict=True)]
    if locus and len(found) > 1:
        from bikestab.plot.loci import draw_loci

        return draw_loci(machines, start, stop, common)
    if locus:
        from bikestab.plot.locus import draw_locus

        return draw_locus(*designs[0], start, stop, model=model)
    if len(found) > 1:
        from bikestab.plot.growth import draw_growth

        return draw_growth(machines, start, stop, common)
    from bikestab.plot.modes import draw_modes

    return draw_modes(*designs[0], start, stop, model=model)
