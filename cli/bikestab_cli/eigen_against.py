"""eigen --over: the modes at one speed against a parameter, for each value of a second one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bikestab_cli.chosen import Given
from bikestab_cli.eigen_answer import Shown
from bikestab_cli.eigen_view_options import told_as_views
from bikestab_cli.eigen_view_words import told_against
from bikestab_cli.over import along, beside
from bikestab_cli.several import Chosen

if TYPE_CHECKING:
    from bikestab.model import Model


def against(
    machine: Chosen, given: Given, over: dict[str, list[float]], V: float, model: Model
) -> list[Shown]:
    """A machine against the parameter with the most values, once or for each value of the other."""
    axis = along(over)
    with told_as_views(**dict.fromkeys(over, "--over")):
        return [
            _against(own, given, axis, over[axis], others, V, model)
            for others, own in beside(machine, over, axis)
        ]


def _against(
    own: Chosen, given: Given, name: str, values: list[float], others: dict[str, float],
    V: float, model: Model,
) -> Shown:  # fmt: skip
    """The modes of the ``own`` machine where one parameter has some values, and ``others`` have one each."""
    from bikestab.against import modes_against
    from bikestab.export.motions import against_blocks, against_columns
    from bikestab.records import interval_records, modes_record, verdict_record
    from bikestab.speeds import intervals_of
    from bikestab.variants import parameter_of

    held = {key: value[0] if isinstance(value, list) else value for key, value in given.items()}
    found = modes_against(own.bicycle, name, values, V, {**held, **others}, model=model)
    results = []
    for value, design, table, modes in zip(
        found.values.tolist(), found.designs, found.tables, found.modes, strict=True
    ):
        stable = intervals_of(table)
        ends = {"intervals": interval_records(stable), **verdict_record(stable)}
        results.append({"over": {name: value, **others}, **design, **ends, **modes_record(modes)})
    ranges = [
        {"at": V, **{end: {name: x, **others} for end, x in (("start", start), ("stop", stop))}}
        for start, stop in found.stable
    ]
    text = told_against(own, found, V, parameter_of(own.bicycle, name).unit, model, others)
    columns = against_columns(found, others)
    return Shown(own, found, results, text, columns, lambda: against_blocks(found, others), ranges)
