"""The options --certified and --certificate of ``design``: the largest box that is proved stable."""

from __future__ import annotations

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.designless import end_of_all, lacking, results_of_all, told_without, with_design
from bikestab_cli.options import told_as_options
from bikestab_cli.output import heading, print_json, prose, tell, tell_file
from bikestab_cli.quantities import Ends
from bikestab_cli.several import Chosen, record_of

from bikestab.errors import InputError

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.certify.largest import Around, Largest
    from bikestab.model import Model

_DESIGN = ("lam", "sigma", "trail", "head_angle", "offset")
_SIDES = {"head_angle": math.radians(1), "trail": 0.01}  # without --sd
_DIGITS = 3  # of a speed [m/s] after the point, at least


def check_certified(certified: bool, others: object) -> None:
    """Refuse options that leave others unheeded."""
    context = click.get_current_context()
    if not certified:
        raise click.UsageError("--certificate is of the box that --certified finds", context)
    if others:
        raise click.UsageError(
            "--certified is around one design: leave out --free, --over, -o and --csv", context
        )
    for name in _DESIGN:
        ends = context.params[name]
        if _typed(name) and ends[0] != ends[1]:
            problem = f"--certified is around one design: give --{name.replace('_', '-')} one value"
            raise click.UsageError(problem, context)


def tell_largest(
    machines: list[Chosen], deviations: tuple[bool, dict[str, float]], model: Model,
    speeds: tuple[float, Ends | None, Ends | None], certificate: str | None, as_json: bool,
) -> None:  # fmt: skip
    """Find the largest proved box of each machine and tell of it."""
    from bikestab import __version__
    from bikestab.certify.largest import largest_box

    if certificate and len(machines) > 1:
        raise click.UsageError("--certificate is of one machine", click.get_current_context())
    lacks = lacking(machines, _given())
    results, told = [], []
    for machine in with_design(machines, lacks):
        with told_as_options(stable="--stable", judged="--V", sd="--sd"):
            around = _around(machine.bicycle, deviations, model, speeds)
            found = largest_box(around)
        results.append([_result(found, speeds)])
        told.append(_words(found, machine.changes))
        if certificate:
            from bikestab.files import written

            with written(certificate) as part:
                part.write_text(found.proof.certificate(__version__) + "\n", encoding="utf-8")
    files = {"certificate": certificate} if certificate else {}
    if as_json:
        print_json(record_of(machines, model, results_of_all(machines, lacks, results), files))
    else:
        tell("\n\n".join([*told, *told_without(machines, lacks)]), certificate)
        if certificate:
            tell_file(certificate)
    end_of_all(machines, lacks)


def _given() -> list[str]:
    """Which of the design was typed."""
    return [name for name in _DESIGN if _typed(name)]


def _typed(name: str) -> bool:
    source = click.get_current_context().get_parameter_source(name)
    return source != click.core.ParameterSource.DEFAULT


def _around(
    bicycle: Bicycle, deviations: tuple[bool, dict[str, float]], model: Model,
    speeds: tuple[float, Ends | None, Ends | None],
) -> Around:  # fmt: skip
    from bikestab.arguments import design_of
    from bikestab.certify.largest import around_design
    from bikestab.geometry import design_given

    given = {name: click.get_current_context().params[name][0] for name in _given()}
    design = design_given(given, bicycle.c, bicycle.R2, (bicycle.lam, bicycle.sigma))
    lam, sigma = (float(x) for x in design_of(bicycle, *design))
    of_file, typed = deviations
    known = {name: sd for name, sd in bicycle.deviations.items() if sd > 0} if of_file else {}
    if of_file and not known and not typed:
        problem = f"the bicycle {bicycle.name!r} has no standard deviations in its file"
        raise InputError(problem, key=("sd",), hint="give some, for example --sd trail=5mm")
    V_max, judged, stable = speeds
    if judged and judged[0] != judged[1]:
        raise InputError("is one speed of the box", key=("judged",), hint="a range is --stable")
    V = judged[0] if judged else None
    return around_design(bicycle, model, (lam, sigma), {**known, **typed} or _SIDES, stable, V, V_max)


def _result(found: Largest, speeds: tuple[float, Ends | None, Ends | None]) -> dict[str, Any]:
    V_max, judged, stable = speeds
    around, proof = found.around, found.proof.record()
    none = dict.fromkeys(("own", "widest", "lowest_V1", "fastest_decay", "closest"))
    return {
        "searched": {
            "lam": (around.lam, around.lam), "sigma": (around.sigma, around.sigma),
            "V_max": V_max, "judged": judged, "stable": stable,
        },
        **none, "pareto": [],
        "certified": {
            "factor": found.factor, "sides": dict(around.sides), "box": proof["box"],
            "verdict": proof["verdict"], "method": proof["method"], "cells": proof["cells"],
            "beyond": found.beyond, "no_machine": found.why or None,
            "unstable_from": found.spoiled, "unstable": found.point,
        },
    }  # fmt: skip


def _words(found: Largest, changes: str) -> str:
    """Rounded inwards: what is printed is within what is proved."""
    around, proof = found.around, found.proof
    box = proof.record()["box"]
    angles = [90 - math.degrees(x) for x in box["lam"][::-1]]
    trails = [1000 * around.bicycle.c * x for x in box["sigma"]]
    parts = [f"head angle {_within(*angles)}°", f"trail {_within(*trails)} mm"]
    for name in proof.varied:
        unit = around.bicycle.notation[name].rpartition("[")[2][:-1]
        parts.append(f"{name} {_within(*box[name])} {unit}")
    speeds = told_speeds(*box["V"], given="V" not in around.sides)
    head = heading(around.bicycle, around.model) + (f" ({changes})" if changes else "")
    what = f"all designs, speeds and machines in this box, {found.factor:.4g} times the sides"
    told = f"{head}\nproved stable: {', '.join(parts)}, {speeds} m/s"
    return "\n\n".join(map(prose, [told, f"{what}, by {proof.box.method}; {_beyond(found)}"]))


def told_speeds(low: float, high: float, *, given: bool) -> str:
    """Two speeds as they were given, else rounded inwards, with as many digits as keep their order."""
    if given or low == high:
        short = {V: f"{V:.{_DIGITS}f}" for V in (low, high)}
        return " ... ".join(short[V] if float(short[V]) == V else repr(V) for V in (low, high))
    digits = _DIGITS
    while True:
        unit = Decimal(1).scaleb(-digits)
        ends = Decimal(low).quantize(unit, ROUND_CEILING), Decimal(high).quantize(unit, ROUND_FLOOR)
        if ends[0] <= ends[1]:
            return f"{ends[0]} ... {ends[1]}"
        digits += 1


def _beyond(found: Largest) -> str:
    """What is known of larger boxes."""
    if found.why:
        return f"larger ones end at machines that cannot be ({found.why})"
    if found.beyond is None:
        return "larger ones were not tried"
    if not found.point or not found.spoiled:
        return "larger ones are undecided"
    point = dict(found.point)
    rate = point.pop("growth_rate")
    where = ", ".join(f"{name} = {value:.6g}" for name, value in point.items())
    return (
        f"one {100 * (found.spoiled / found.factor - 1):.2g} % larger is not: {where} grows at {rate:.2g} 1/s"
    )


def _within(low: float, high: float) -> str:
    """A middle and half a width, ± what lies between the ends; the middle alone where they are one."""
    half = 0.5 * (high - low)
    if not half > 1e-12 * abs(high):
        return f"{low:.6g}"
    digits = 2 - math.floor(math.log10(half))
    middle = round(0.5 * (low + high), digits)
    inside = math.floor(min(high - middle, middle - low) * 10.0**digits) / 10.0**digits
    return f"{middle:.{max(digits, 0)}f} ± {inside:.{max(digits, 0)}f}"
