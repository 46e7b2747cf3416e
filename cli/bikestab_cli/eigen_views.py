"""What eigen shows at one speed: mode shapes, the motion after a push, and modes against a parameter."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.chosen import Given, design_chosen
from bikestab_cli.designless import told_without, with_design
from bikestab_cli.eigen_against import against
from bikestab_cli.eigen_answer import Answer, Shown
from bikestab_cli.eigen_view_options import View, told_as_views
from bikestab_cli.eigen_view_words import told_motion, told_shapes
from bikestab_cli.several import Chosen, told_apart

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.model import Model

_TIMES = 501  # of a motion


def viewed(
    machines: Sequence[Chosen], lacks: Sequence[str], given: Given, view: View, model: Model
) -> Answer:
    """What is shown at one speed of the machines that do not lack a design."""
    able = with_design(machines, lacks)
    found = [_shown(machine, given, view, model) for machine in able]
    every = [each for own in found for each in own]

    def rows() -> tuple[Any, Any]:
        from bikestab.export.tables import of_machines

        tables = [
            (machine.bicycle.name, machine.changes, chain.from_iterable(each.blocks() for each in own))
            for machine, own in zip(able, found, strict=True)
        ]
        return of_machines(found[0][0].columns, tables)

    text = "\n\n\n".join([*(each.text for each in every), *told_without(machines, lacks)])
    results = [[record for each in own for record in each.results] for own in found]
    ranges = None
    if view.kind == "over":
        rest = iter(found)
        ranges = [[] if lack else [part for each in next(rest) for part in each.ranges] for lack in lacks]
    return Answer(text, results, rows, lambda: _drawn(every, view, model), ranges)


def _drawn(found: Sequence[Shown], view: View, model: Model) -> Any:
    """The picture: of one machine all its eigenvalues or angles, of several a curve or a row each."""
    common, names = told_apart([each.machine for each in found])
    (first, *others), each = found, [(name, own.found) for name, own in zip(names, found, strict=True)]
    if view.shapes:
        from bikestab.plot.shapes import draw_shapes

        return draw_shapes(each, common)
    if view.push:
        from bikestab.plot.motion import draw_motion, draw_motions

        motions = [_before_a_quarter_turn(own, view, model) for own in found]
        if others:
            return draw_motions([*zip(names, motions, strict=True)], view.push, common)
        return draw_motion(first.machine.words, motions[0], view.until, view.push)
    from bikestab.plot.against import draw_against
    from bikestab.plot.axes import label_of
    from bikestab.plot.growth import draw_growth_against
    from bikestab.variants import parameter_of

    parameter = parameter_of(first.machine.bicycle, first.found.name)
    if others:
        return draw_growth_against(each, label_of(parameter), common)
    return draw_against(first.machine.words, first.found, first.found.V, parameter)


def _shown(machine: Chosen, given: Given, view: View, model: Model) -> list[Shown]:
    """What is asked for, of one machine: once, or for each value of the second of two parameters."""
    bicycle = machine.bicycle
    if view.kind == "over":
        V = _speed_over(bicycle, given, model) if view.at is None else view.at
        return against(machine, given, view.over, V, model)
    lam, sigma = design_chosen(bicycle, given)
    V = _middle(bicycle, lam, sigma, model) if view.at is None else view.at
    from bikestab.records import design_record

    design = design_record(lam, sigma, bicycle)
    with told_as_views():
        return [(_shapes if view.shapes else _motion)(machine, design, V, view, model)]


def _shapes(machine: Chosen, design: Any, V: float, view: View, model: Model) -> Shown:
    from bikestab.export.motions import SHAPES, shapes_blocks
    from bikestab.motion import shapes

    found = shapes(machine.bicycle, V, design["lam"], design["sigma"], model=model)

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
    return Shown(machine, found, [record], text, SHAPES, lambda: shapes_blocks(found))


def _motion(machine: Chosen, design: Any, V: float, view: View, model: Model) -> Shown:
    import numpy as np

    from bikestab.export.motions import MOTION, motion_blocks
    from bikestab.motion import motion

    times = np.linspace(0, view.until, _TIMES)
    found = motion(machine.bicycle, V, view.push, times, design["lam"], design["sigma"], model=model)
    columns = next(motion_blocks(found))
    record = {**design, "at": V, "push": view.push, "motion": {k: x.tolist() for k, x in columns.items()}}
    text = told_motion(machine, design, found, view.push, model)
    return Shown(machine, found, [record], text, MOTION, lambda: motion_blocks(found))


def _before_a_quarter_turn(shown: Shown, view: View, model: Model) -> Any:
    """What is drawn of a motion."""
    from bikestab.motion import before_a_quarter_turn, motion

    (record,) = shown.results
    design = record["lam"], record["sigma"]

    def at(times: Any) -> Any:
        return motion(shown.machine.bicycle, record["at"], view.push, times, *design, model=model)

    return before_a_quarter_turn(at, shown.found)


def _speed_over(bicycle: Bicycle, given: Given, model: Model) -> float:
    """The same of a machine before its parameter varies."""
    try:
        lam, sigma = design_chosen(bicycle, given)
    except click.UsageError:
        problem = (
            f"{bicycle.name} has no design of its own to take the middle of its stable speeds: give --at"
        )
        raise click.UsageError(problem, click.get_current_context()) from None
    return _middle(bicycle, lam, sigma, model)


def _middle(bicycle: Bicycle, lam: float, sigma: float, model: Model) -> float:
    """The middle of the widest stable interval that has two ends."""
    from bikestab.stability import stable_intervals

    found = stable_intervals(bicycle, lam, sigma, model=model)
    bounded = [(b - a, a, b) for a, b in zip(found.V1, found.V2, strict=True) if b - a < float("inf")]
    if not bounded:
        problem = f"{bicycle.name} has no stable interval with two ends to take the middle of: give --at"
        raise click.UsageError(problem, click.get_current_context())
    _, a, b = max(bounded)
    return float((a + b) / 2)
