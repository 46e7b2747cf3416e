"""eigen --over: the modes at one speed against a parameter, for each value of a second one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click
from bikestab_cli.chosen import Given
from bikestab_cli.eigen_answer import Shown
from bikestab_cli.eigen_view_options import View, told_as_views
from bikestab_cli.eigen_view_words import told_against
from bikestab_cli.several import Chosen

if TYPE_CHECKING:
    from bikestab.model import Model


def against(machine: Chosen, given: Given, view: View, model: Model) -> list[Shown]:
    """A machine against the parameter with the most values, once or for each value of the other."""
    if view.at is None:
        raise click.UsageError("--over needs a speed: give --at", click.get_current_context())
    along = max(view.over, key=lambda name: len(view.over[name]))
    beside = [{name: value} for name in view.over if name != along for value in view.over[name]] or [{}]
    return [_against(machine, given, along, each, view, model) for each in beside]


def _against(
    machine: Chosen, given: Given, name: str, beside: dict[str, float], view: View, model: Model
) -> Shown:
    """The modes where one parameter varies, and others are ``beside`` it."""
    from bikestab.against import modes_against
    from bikestab.export.motions import against_blocks, against_columns
    from bikestab.records import interval_records, modes_record, verdict_record
    from bikestab.speeds import intervals_of
    from bikestab.variants import parameter_of

    V = float(view.at or 0)
    others = {key: value[0] if isinstance(value, list) else value for key, value in given.items()}
    with told_as_views(**dict.fromkeys(view.over, "--over")):
        found = modes_against(machine.bicycle, name, view.over[name], V, {**others, **beside}, model=model)
    results = []
    for value, design, table, modes in zip(
        found.values.tolist(), found.designs, found.tables, found.modes, strict=True
    ):
        stable = intervals_of(table)
        ends = {"intervals": interval_records(stable), **verdict_record(stable)}
        results.append({"over": {name: value, **beside}, **design, **ends, **modes_record(modes)})
    ranges = [
        {"at": V, **{end: {name: x, **beside} for end, x in (("start", start), ("stop", stop))}}
        for start, stop in found.stable
    ]
    own = Chosen(machine.bicycle, {**machine.set, **beside})
    text = told_against(own, found, V, parameter_of(machine.bicycle, name).unit, model, beside)
    columns = against_columns(found, beside)
    return Shown(own, found, results, text, columns, lambda: against_blocks(found, beside), ranges)
