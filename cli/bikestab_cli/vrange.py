"""bikestab vrange: the stable speed intervals, exact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.chosen import Given, design_options, designs_chosen, doubt_designs, is_single
from bikestab_cli.designless import end_of_all, lacking, record_without
from bikestab_cli.options import (
    PICTURE,
    check_curves,
    check_files,
    json_option,
    over_option,
    sd_option,
    told_as_options,
)
from bikestab_cli.output import print_json, tell_file
from bikestab_cli.over import check_meanings, curves_of
from bikestab_cli.several import (
    Chosen,
    Values,
    check_varied,
    machines_chosen,
    record_of,
    several_machines,
    told_apart,
)
from bikestab_cli.spreads import spreads, uncertain_words, with_spreads
from bikestab_cli.vrange_over import show_over
from bikestab_cli.vrange_words import Found, told_all, told_one

if TYPE_CHECKING:
    from bikestab.model import Model

_HELPED = 40  # machines of which a table tells what would help


@click.command("vrange")
@design_options("a range")
@over_option
@several_machines
@sd_option
@click.option(
    "-o", "--output", type=PICTURE, metavar="FILE",
    help="Draw the stable speeds as PNG, PDF or SVG: over one range, however coarse NUM, or a bar for each "
    "machine.",
)  # fmt: skip
@json_option
def command(
    given: Given,
    over: dict[str, list[float]],
    bicycle_name: tuple[str, ...],
    changes: Values,
    model: Model,
    delta: float | None,
    deviations: tuple[bool, dict[str, float]],
    output: str | None,
    as_json: bool,
) -> None:
    """Print the stable speeds V1 < V < V2.

    The ends are exact roots, not read off a grid, and each is named: weave (an oscillation starts), capsize
    (a slow fall starts), rest (V = 0) or unbounded. Without a tilt or a trail the bicycle's own are
    taken. A range START:STOP:NUM gives a table, and so do several --bicycle and several values of --set.

    Of several machines one that has no tilt or trail of its own is left out, and told of: exit code 2.

    Two of head angle, trail and fork offset give the third; an offset alone keeps the bicycle's head angle.

    Printed digits are certain. JSON has a bound on each end, V1_error and V2_error, within which the true
    value for exactly these inputs lies, and says where rounding leaves open how many intervals there are or
    how one ends: "marginal", with the "reason".

    --over takes values of any one or two parameters: those of the bicycle's notation, a rider's, and lam,
    head_angle, sigma, trail, offset, delta. What does not vary is as the bicycle has it. The picture of two
    is over the one with more values, with a curve for each of the other's. A picture is drawn in place of
    the table, as by eigen, and named on stdout; --json is printed beside it.

    --sd tells what standard deviations of parameters leave of that: in how many of 20 000 machines drawn at
    random there is a stable speed, and where nine tenths of the ends lie ('bikestab sensitivity' says more).

    Where there is no stable speed the answer says what would help: the nearest larger and smaller σ and the
    nearest λ that give one (searched over −0.2 ≤ λ ≤ 0.6 rad and −0.5 ≤ σ ≤ 0.5), and the speed up to
    50 m/s at which the motion is least unstable.

    \b
    Examples:
      bikestab vrange --lam 0.2 --sigma 0.08
      bikestab vrange --lam 0.05:0.3:6 --sigma 0.1
      bikestab vrange --bicycle meijaard2007
      bikestab vrange --bicycle meijaard2007 --lam 20deg --json
      bikestab vrange --lam 0.1 --sigma 0.08 --delta 1
      bikestab vrange --bicycle meijaard2007 --sd c=10mm --sd lam=1.5deg
      bikestab vrange --head-angle 71deg --trail 55mm
      bikestab vrange --bicycle meijaard2007 --head-angle 68deg:74deg:7
      bikestab vrange --bicycle meijaard2007 --bicycle kooijman2011
      bikestab vrange --bicycle meijaard2007 --set mB=60,75,100
      bikestab vrange --bicycle meijaard2007 --over mB=60:110:6 --over c=5:9cm:5
      bikestab vrange --bicycle meijaard2007 --over delta=0:8:51 -o damped.png
      bikestab vrange --bicycle meijaard2007 --bicycle sharp1971 -o two.png
    """
    check_files(output)
    machines = machines_chosen(bicycle_name, delta, changes, given)
    if over:
        if given:
            problem = "--over says what varies: set the rest with --set, as --set lam=18deg"
            raise click.UsageError(problem, click.get_current_context())
        for machine in machines:
            check_varied(machine.bicycle, over, changes, delta)
        check_meanings(machines, over)
        lacks = lacking(machines, over)
        check_curves(output, lacks.count("") * curves_of(over))
        show_over(machines, lacks, over, model, deviations, output, as_json)
        end_of_all(machines, lacks)
        return
    axis = _axis_drawn(given) if output else ""
    single = is_single(given)
    helped = as_json or (single and len(machines) <= _HELPED and not output)
    lacks = lacking(machines, given)
    check_curves(output, lacks.count(""))
    found = [
        Found(machine, [], [], lack) if lack else _found(machine, given, model, deviations, helped)
        for machine, lack in zip(machines, lacks, strict=True)
    ]
    shown = [each for each in found if not each.problem]
    files = {}
    if output:
        from bikestab.plot.ends import draw_ends
        from bikestab.plot.files import save

        common, names = told_apart([each.machine for each in shown])
        answers = [_drawn(each, given, model) for each in shown]
        uncertain = uncertain_words([each.machine for each in shown], [each.spreads for each in shown])
        figure = draw_ends([*zip(names, answers, strict=True)], axis, name=common, uncertain=uncertain)
        save(figure, Path(output))
        files["picture"] = output
    if as_json:
        print_json(record_of(machines, model, [_results(each) for each in found], files))
    elif output:
        tell_file(output)
    else:
        click.echo(told_one(found[0], model, single) if len(machines) == 1 else told_all(found, model))
    end_of_all(machines, lacks)


def _results(found: Found) -> Sequence[Mapping[str, Any]]:
    if found.problem:
        return [{**record_without(found.machine, found.problem), "nearest": None}]
    return with_spreads(found.answers, found.spreads)


def _found(
    machine: Chosen, given: Given, model: Model, deviations: tuple[bool, dict[str, float]], nearest: bool
) -> Found:  # fmt: skip
    """The answers about one machine, and what is ``nearest`` if that is told."""
    from bikestab.region.answers import stable_speeds

    bicycle = machine.bicycle
    lam, sigma = designs_chosen(bicycle, given)
    with told_as_options():
        answers = stable_speeds(bicycle, lam, sigma, model=model, nearest=nearest)
    least = [min((answer[name] for answer in answers), key=abs) for name in ("lam", "sigma")]
    doubt_designs(given, least[0], least[1], bicycle.c)
    designs = [(bicycle, answer["lam"], answer["sigma"]) for answer in answers]
    return Found(machine, answers, spreads(bicycle, designs, model, *deviations))


def _drawn(found: Found, given: Given, model: Model) -> Sequence[Mapping[str, Any]]:
    """What a picture shows of one machine: along a range also what is between its values."""
    from bikestab.region.answers import stable_speeds
    from bikestab.region.closer import closer

    own = with_spreads(found.answers, found.spreads)
    bicycle = found.machine.bicycle
    name = next((name for name in given if not is_single({name: given[name]})), "")
    if not name:
        return own

    def at(new: list[float]) -> Sequence[Mapping[str, Any]]:
        lam, sigma = designs_chosen(bicycle, {**given, name: new})
        return stable_speeds(bicycle, lam, sigma, model=model, nearest=False)

    return closer(given[name], own, at)


def _axis_drawn(given: Given) -> str:
    """What a picture's axis is: the one range that is given; nothing where there is none."""
    ranges = [name for name, value in given.items() if not is_single({name: value})]
    if len(ranges) > 1:
        problem = "a picture has one range, and these are " + " and ".join(
            f"--{name.replace('_', '-')}" for name in ranges
        )
        raise click.BadParameter(problem, param_hint="--output")
    return {"head_angle": "head_angle_deg"}.get(ranges[0], ranges[0]) if ranges else ""
