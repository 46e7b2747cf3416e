"""What eigen shows at one speed: mode shapes, the motion after a push, and modes against a parameter."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from bikestab_cli.chosen import Given, design_chosen
from bikestab_cli.designless import told_without, with_design
from bikestab_cli.eigen_along import Answer
from bikestab_cli.eigen_view_options import View
from bikestab_cli.eigen_view_words import told_against, told_motion, told_shapes
from bikestab_cli.several import Chosen

if TYPE_CHECKING:
    from bikestab.model import Model

_TIMES = 501  # of a motion


class Shown(NamedTuple):
    """What was found of one machine: its record, its words, its table's columns and rows, and its picture."""

    record: dict[str, Any]
    text: str
    columns: Any
    blocks: Callable[[], Iterator[Any]]
    draw: Callable[[], Any]


def viewed(
    machines: Sequence[Chosen], lacks: Sequence[str], given: Given, view: View, model: Model
) -> Answer:
    """What is shown at one speed of the machines that do not lack a design."""
    able = with_design(machines, lacks)
    found = [_shown(machine, given, view, model) for machine in able]

    def rows() -> tuple[Any, Any]:
        from bikestab.export.tables import of_machines

        blocks = [
            (machine.bicycle.name, machine.changes, each.blocks())
            for machine, each in zip(able, found, strict=True)
        ]
        return of_machines(found[0].columns, blocks)

    text = "\n\n\n".join([*(each.text for each in found), *told_without(machines, lacks)])
    results = [each.record.get("all", [each.record]) for each in found]
    ranges = None
    if view.kind == "over":
        each_ = iter(found)
        ranges = [[] if lack else next(each_).record["ranges"] for lack in lacks]
    return Answer(text, results, rows, lambda: found[0].draw(), ranges)


def _shown(machine: Chosen, given: Given, view: View, model: Model) -> Shown:
    """What is asked for, of one machine."""
    if view.kind == "over":
        return _against(machine, given, view, model)
    bicycle = machine.bicycle
    lam, sigma = design_chosen(bicycle, given)
    V = _speed(bicycle, lam, sigma, view, model)
    from bikestab.records import design_record

    design = design_record(lam, sigma, bicycle)
    with _told():
        return (_shapes if view.shapes else _motion)(machine, design, V, view, model)


def _shapes(machine: Chosen, design: Any, V: float, view: View, model: Model) -> Shown:
    from bikestab.export.motions import SHAPES, shapes_blocks
    from bikestab.motion import shapes

    found = shapes(machine.bicycle, V, design["lam"], design["sigma"], model=model)

    def draw() -> Any:
        from bikestab.plot.shapes import draw_shapes

        return draw_shapes(machine.words, found)

    modes = [
        {
            "name": name, "re": s.real, "im": s.imag,
            "roll": {"re": roll.real, "im": roll.imag}, "steer": {"re": steer.real, "im": steer.imag},
        }
        for name, s, (roll, steer) in zip(
            found.names, found.eigenvalues.tolist(), found.phasors.T.tolist(), strict=True
        )
    ]  # fmt: skip
    record = {**design, "at": V, "shapes": modes}
    text = told_shapes(machine, design, found, model)
    return Shown(record, text, SHAPES, lambda: shapes_blocks(found), draw)


def _motion(machine: Chosen, design: Any, V: float, view: View, model: Model) -> Shown:
    import numpy as np

    from bikestab.export.motions import MOTION, motion_blocks
    from bikestab.motion import motion

    times = np.linspace(0, view.until, _TIMES)
    found = motion(machine.bicycle, V, view.push, times, design["lam"], design["sigma"], model=model)

    def draw() -> Any:
        from bikestab.plot.motion import draw_motion

        return draw_motion(machine.words, found, view.push)

    columns = next(motion_blocks(found))
    record = {**design, "at": V, "push": view.push, "motion": {k: x.tolist() for k, x in columns.items()}}
    text = told_motion(machine, design, found, view.push, model)
    return Shown(record, text, MOTION, lambda: motion_blocks(found), draw)


def _against(machine: Chosen, given: Given, view: View, model: Model) -> Shown:
    from bikestab.against import modes_against
    from bikestab.export.motions import against_blocks, against_columns
    from bikestab.records import interval_records, modes_record, verdict_record
    from bikestab.speeds import intervals_of
    from bikestab.variants import parameter_of

    ((name, values),) = view.over.items()
    if view.at is None:
        raise click.UsageError("--over needs a speed: give --at", click.get_current_context())
    with _told(**{name: "--over"}):
        others = {key: value[0] if isinstance(value, list) else value for key, value in given.items()}
        found = modes_against(machine.bicycle, name, values, view.at, others, model=model)
    parameter = parameter_of(machine.bicycle, name)
    records = []
    for value, design, table, modes in zip(
        found.values.tolist(), found.designs, found.tables, found.modes, strict=True
    ):
        stable = intervals_of(table)
        ends = {"intervals": interval_records(stable), **verdict_record(stable)}
        records.append({"over": {name: value}, **design, **ends, **modes_record(modes)})

    def draw() -> Any:
        from bikestab.plot.against import draw_against

        return draw_against(machine.words, found, float(view.at or 0), parameter)

    text = told_against(machine, found, view.at, parameter.unit, model)
    ranges = [{"at": view.at, "start": {name: start}, "stop": {name: stop}} for start, stop in found.stable]
    return Shown(
        {"all": records, "ranges": ranges}, text, against_columns(found), lambda: against_blocks(found), draw
    )


def _speed(bicycle: Any, lam: float, sigma: float, view: View, model: Model) -> float:
    """The speed that is asked for, or the middle of the widest stable interval that has two ends."""
    from bikestab.stability import stable_intervals

    if view.at is not None:
        return view.at
    found = stable_intervals(bicycle, lam, sigma, model=model)
    bounded = [(b - a, a, b) for a, b in zip(found.V1, found.V2, strict=True) if b - a < float("inf")]
    if not bounded:
        problem = f"{bicycle.name} has no stable interval with two ends to take the middle of: give --at"
        raise click.UsageError(problem, click.get_current_context())
    _, a, b = max(bounded)
    return float((a + b) / 2)


@contextmanager
def _told(**others: str) -> Iterator[None]:
    from bikestab_cli.options import told_as_options

    try:
        with told_as_options(V="--at", **others):
            yield
    except click.BadParameter as error:
        if error.param_hint == "--t":
            error.param_hint = "--until"
        raise
