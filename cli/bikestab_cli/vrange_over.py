"""vrange --over: the stable speeds at every combination of values of one or two parameters."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.designless import results_of_all, told_without, with_design
from bikestab_cli.options import told_as_options
from bikestab_cli.output import print_json, tell_file
from bikestab_cli.over import along, beside
from bikestab_cli.parameters import MOST_VALUES
from bikestab_cli.several import Chosen, record_of, told_apart
from bikestab_cli.spreads import spreads, uncertain_words, with_spreads
from bikestab_cli.vrange_words import told_over

if TYPE_CHECKING:
    from bikestab.design.spread import Spread
    from bikestab.model import Model
    from bikestab.region.answers import Answer

Points = list[tuple[dict[str, float], "Answer"]]


def show_over(
    machines: list[Chosen], lacks: Sequence[str], over: dict[str, list[float]], model: Model,
    deviations: tuple[bool, dict[str, float]], output: str | None, as_json: bool,
) -> None:  # fmt: skip
    """Tell of every combination of the parameters' values, or draw it, but of machines without a design."""
    if math.prod(len(values) for values in over.values()) > MOST_VALUES:
        context = click.get_current_context()
        raise click.UsageError(f"--over gives more than {MOST_VALUES} designs", context)
    able = with_design(machines, lacks)
    points = [_points(machine, over, model) for machine in able]
    known = [_spreads(machine, each, model, deviations) for machine, each in zip(able, points, strict=True)]
    files = {}
    if output:
        _draw(able, points, known, over, model, output)
        files["picture"] = output
    if as_json:
        answers = [[{"over": point, **answer} for point, answer in each] for each in points]
        results = [with_spreads(each, own) for each, own in zip(answers, known, strict=True)]
        every = results_of_all(machines, lacks, results)
        print_json(
            record_of(machines, model, [[{**x, "nearest": None} for x in own] for own in every], files)
        )
    elif output:
        tell_file(output)
    else:
        parts = zip(able, points, known, strict=True)
        tables = [told_over(machine, each, model, own) for machine, each, own in parts]
        click.echo("\n\n".join([*tables, *told_without(machines, lacks)]))


def _points(machine: Chosen, over: dict[str, list[float]], model: Model) -> Points:
    from bikestab.region.answers import stable_speeds_over

    with told_as_options(**dict.fromkeys((*over, "lam", "sigma"), "--over")):
        return stable_speeds_over(machine.bicycle, over, model=model)


def _spreads(
    machine: Chosen, points: Points, model: Model, deviations: tuple[bool, dict[str, float]]
) -> list[Spread]:
    from bikestab.variants import FRONT, machine_at

    bicycle = machine.bicycle
    designs = []
    if any(deviations):
        for name in points[0][0]:
            if name not in bicycle.notation and name not in FRONT:
                problem = f"--over {name} is not of the bicycle's notation, of which standard deviations are"
                raise click.BadParameter(problem, param_hint="--sd")
        designs = [machine_at(bicycle, point) for point, _ in points]
    return spreads(bicycle, designs, model, *deviations)


def _draw(
    machines: Sequence[Chosen], points: Sequence[Points], known: Sequence[list[Spread]],
    over: Mapping[str, list[float]], model: Model, output: str,
) -> None:  # fmt: skip
    """Over the parameter with the most values, a curve for each value of the other one."""
    from bikestab.plot.axes import label_of
    from bikestab.plot.ends import AXES, draw_ends
    from bikestab.plot.files import save
    from bikestab.variants import parameter_of

    name = along(over)
    axis = {"head_angle": "head_angle_deg"}.get(name, name) if len(over[name]) > 1 else ""
    whose, curves = [], []
    for machine, each, spreads_ in zip(machines, points, known, strict=True):
        answers = with_spreads([answer for _, answer in each], spreads_)
        for others, own in beside(machine, over, name if axis else ""):
            at = [
                {**answer, **({} if axis in AXES else {name: point[name]})}
                for (point, _), answer in zip(each, answers, strict=True)
                if others.items() <= point.items()
            ]
            whose.append(own)
            curves.append(_closer(machine, over[name], at, name, others, model) if axis else at)
    common, names = told_apart(whose)
    label = "" if axis in AXES else label_of(parameter_of(machines[0].bicycle, name))
    uncertain = uncertain_words(machines, known)
    save(draw_ends([*zip(names, curves, strict=True)], axis, label, common, uncertain), Path(output))


def _closer(
    machine: Chosen, values: Sequence[float], answers: Sequence[Mapping[str, Any]], name: str,
    others: Mapping[str, float], model: Model,
) -> Sequence[Mapping[str, Any]]:  # fmt: skip
    """The answers along one parameter, and more in between them, for a curve."""
    from bikestab.region.answers import stable_speeds_over
    from bikestab.region.closer import closer

    def at(new: list[float]) -> list[Mapping[str, Any]]:
        every = {**{other: [value] for other, value in others.items()}, name: new}
        return [{name: p[name], **a} for p, a in stable_speeds_over(machine.bicycle, every, model=model)]

    return closer(values, answers, at)
