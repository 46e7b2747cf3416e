"""bikestab vrange: the stable speed intervals, exact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from bikestab_cli.chosen import Given, design_options, designs_chosen, doubt_designs, is_single
from bikestab_cli.options import json_option, sd_option, tell_once, told_as_options
from bikestab_cli.output import DESIGN_HEAD, certain, design_columns, heading, print_json, table
from bikestab_cli.several import Chosen, Values, machines_chosen, several_machines

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.design.spread import Spread
    from bikestab.model import Model
    from bikestab.region.answers import Answer

MOST_SPREADS = 100  # designs at once


@click.command("vrange")
@design_options("a range")
@several_machines
@sd_option
@json_option
def command(
    given: Given,
    bicycle_name: tuple[str, ...],
    changes: Values,
    model: Model,
    delta: float | None,
    deviations: tuple[bool, dict[str, float]],
    as_json: bool,
) -> None:
    """Print the stable speeds V1 < V < V2.

    The ends are exact roots, not read off a grid, and each is named: weave (an oscillation starts), capsize
    (a slow fall starts), rest (V = 0) or unbounded. Without a tilt or a trail the bicycle's own are
    taken. A range START:STOP:NUM gives a table, and so do several --bicycle and several values of --set.

    Two of head angle, trail and fork offset give the third; an offset alone keeps the bicycle's head angle.

    Printed digits are certain. JSON has a bound on each end, V1_error and V2_error, within which the true
    value for exactly these inputs lies, and says where rounding leaves open how many intervals there are or
    how one ends: "marginal", with the "reason".

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
      bikestab vrange --bicycle meijaard2007 --head-angle 68deg:74deg:7 --offset 45mm
      bikestab vrange --bicycle meijaard2007 --bicycle kooijman2011
      bikestab vrange --bicycle meijaard2007 --set mB=60,75,100
    """
    machines = machines_chosen(bicycle_name, delta, changes)
    single = is_single(given) and len(machines) == 1
    found = [_found(machine, given, model, deviations, as_json or single) for machine in machines]
    if as_json:
        print_json(_record(found, model))
    elif len(machines) == 1:
        _tell_one(found[0], model, single)
    else:
        _tell_all(found, model)


class _Found(NamedTuple):
    machine: Chosen
    answers: list[Answer]
    spreads: list[Spread]


def _found(
    machine: Chosen, given: Given, model: Model, deviations: tuple[bool, dict[str, float]], nearest: bool
) -> _Found:
    """The answers about one machine; a table has no room for what is ``nearest``."""
    from bikestab.region.answers import stable_speeds

    bicycle = machine.bicycle
    lam, sigma = designs_chosen(bicycle, given)
    with told_as_options():
        answers = stable_speeds(bicycle, lam, sigma, model=model, nearest=nearest)
    least = [min((answer[name] for answer in answers), key=abs) for name in ("lam", "sigma")]
    doubt_designs(given, least[0], least[1], bicycle.c)
    return _Found(machine, answers, _spreads(answers, bicycle, model, *deviations))


def _record(found: list[_Found], model: Model) -> dict[str, Any]:
    """What --json prints; of several machines each result tells which it is of."""
    from bikestab.design.spread import plain

    several = len(found) > 1 or found[0].machine.set
    results = []
    for machine, answers, spreads in found:
        whose = {"bicycle": machine.bicycle.name, "set": machine.set} if several else {}
        known = [{"spread": plain(spread)} for spread in spreads] or [{}] * len(answers)
        results += [{**whose, **answer, **more} for answer, more in zip(answers, known, strict=True)]
    bicycles = [each.machine.bicycle for each in found]
    names, deltas = ([*dict.fromkeys(x)] for x in ([b.name for b in bicycles], [b.delta for b in bicycles]))
    return {
        "bicycle": names[0] if len(names) == 1 else names,
        "model": model,
        "delta": deltas[0] if len(deltas) == 1 else deltas,
        "results": results,
    }


def _tell_one(found: _Found, model: Model, single: bool) -> None:
    from bikestab_cli.spread_words import in_one_line

    machine, answers, spreads = found
    changed = f" ({machine.words.partition(' ')[2]})" if machine.set else ""
    click.echo(heading(machine.bicycle, model) + changed + "\n")
    click.echo(table([*DESIGN_HEAD, "V1 [m/s]", "V2 [m/s]"], _rows(answers)))
    for answer in answers:
        if answer["marginal"]:
            click.echo(f"marginal at {_design(answer)}: {answer['reason']}")
    for answer, known in zip(answers, spreads, strict=False):
        click.echo(("" if single else f"{_design(answer)}: ") + in_one_line(known))
    if single and answers[0]["nearest"]:
        click.echo("\n" + _advice(answers[0], machine.bicycle, model))


def _tell_all(found: list[_Found], model: Model) -> None:
    """One table of several machines."""
    from bikestab_cli.spread_words import in_one_line

    rows, notes = [], []
    for machine, answers, spreads in found:
        lines = _rows(answers)
        rows += [[machine.words if i == 0 else "", *line] for i, line in enumerate(lines)]
        open_ = [(answer, f"marginal: {answer['reason']}") for answer in answers if answer["marginal"]]
        known = [(answer, in_one_line(each)) for answer, each in zip(answers, spreads, strict=False)]
        notes += [f"{machine.words} at {_design(answer)}: {text}" for answer, text in (*open_, *known)]
    click.echo(f"{model} model\n")
    click.echo(table(["machine", *DESIGN_HEAD, "V1 [m/s]", "V2 [m/s]"], rows))
    for note in notes:
        click.echo(note)


def _spreads(
    answers: list[Answer], bicycle: Bicycle, model: Model, of_file: bool, given: dict[str, float]
) -> list[Spread]:
    """How far each design's stable speeds are known; none where no standard deviation is asked for."""
    if not (of_file or given):
        if any(sd > 0 for sd in bicycle.deviations.values()):
            text = "the file has standard deviations: --sd file tells what they leave of the digits"
            tell_once(f"note: {bicycle.name}: {text}")
        return []
    from bikestab.design.sensitivity import sensitivity
    from bikestab.design.spread import own_spread
    from bikestab.plausible import deviation_doubts

    for text in deviation_doubts(bicycle, given):
        tell_once(f"warning: {text}")
    if len(answers) > MOST_SPREADS:
        problem = f"--sd draws machines for each design, and {len(answers)} are too many"
        raise click.UsageError(f"{problem}; allowed: {MOST_SPREADS}", click.get_current_context())
    spreads = []
    with told_as_options():
        for answer in answers:
            found = sensitivity(bicycle, answer["lam"], answer["sigma"], model=model)
            spreads.append(own_spread(found, of_file=of_file, given=given))
    if None in spreads:
        problem = f"the bicycle {bicycle.name!r} has no standard deviations in its file"
        raise click.BadParameter(f"{problem}; give some, for example --sd mB=1.5", param_hint="--sd")
    return [known for known in spreads if known]


def _design(answer: Answer) -> str:
    return f"λ = {answer['lam']:.6g}, σ = {answer['sigma']:.6g}"


def _rows(answers: list[Answer]) -> list[list[str]]:
    rows = []
    for result in answers:
        design = design_columns(result)
        for interval in result["intervals"]:
            V1 = f"{certain(interval['V1'], interval['V1_error'])} ({interval['lower']})"
            V2 = interval["upper"]
            if interval["V2"] is not None:
                V2 = f"{certain(interval['V2'], interval['V2_error'])} ({V2})"
            rows.append([*design, V1, V2])
            design = [""] * len(design)
        if not result["intervals"]:
            rows.append([*design, "no stable speed", ""])
    return rows


def _advice(answer: Answer, bicycle: Bicycle, model: Model) -> str:
    """What would help, and what was searched for it; designs are rounded so that they can be typed in."""
    from bikestab.family import Family
    from bikestab.region.nearest import LAM_RANGE, SIGMA_RANGE, V_MAX, rounded

    family = Family(bicycle, model)
    nearest: Any = answer["nearest"]  # read by computed keys
    lam, sigma = answer["lam"], answer["sigma"]
    trails = []
    for key, way, side in (("sigma_min", 1, "above"), ("sigma_max", -1, "below")):
        if nearest[key] is None:
            trails.append(f"none {side}")
        else:
            text = rounded(lambda value: family.table(lam, value), nearest[key], way)
            trails.append(f"σ = {text} {side} (trail {float(text) * bicycle.c:.4f} m)")
    angles = "none"
    if nearest["lam_min"] is not None:
        ends = [
            rounded(lambda value: family.table(value, sigma), nearest[key], way)
            for key, way in (("lam_min", 1), ("lam_max", -1))
        ]
        angles = "λ = {} ... {} rad".format(*ends)
        angles += " (head angle {:.2f} ... {:.2f}°)".format(*(90 - math.degrees(float(end)) for end in ends))
    lines = [
        f"nearest stable speed at this λ: {', '.join(trails)}; searched σ = {_span(SIGMA_RANGE)}",
        f"nearest stable speed at this σ: {angles}; searched λ = {_span(LAM_RANGE)} rad",
    ]
    if nearest["V"] is not None:
        lines.append(
            f"least unstable at {nearest['V']:.3f} m/s of 0 ... {V_MAX:g} m/s searched, "
            f"where it grows at {nearest['growth_rate']:.4g} 1/s"
        )
    return "\n".join(lines)


def _span(ends: tuple[float, float]) -> str:
    return f"{ends[0]:g} ... {ends[1]:g}"
