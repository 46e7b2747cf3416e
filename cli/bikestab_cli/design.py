"""bikestab design: the best tilt and trail by several criteria."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click
from bikestab_cli.options import (
    FILE,
    PICTURE,
    check_files,
    free_option,
    json_option,
    over_ends_option,
    sd_option,
    told_as_options,
)
from bikestab_cli.output import print_json, tell_file
from bikestab_cli.quantities import ANGLE_ENDS, LENGTH_ENDS, SPEED_ENDS, SPEED_VALUE, TRAIL_ENDS, Ends
from bikestab_cli.several import Values, machines_chosen, record_of, several_machines

if TYPE_CHECKING:
    from bikestab.model import Model


@click.command("design")
@click.option(
    "--lam",
    type=ANGLE_ENDS,
    metavar="START:STOP",
    default="0:0.6",
    show_default=True,
    help="Tilts of the steering axis, such as 10deg:25deg; one value fixes the tilt.",
)
@click.option(
    "--sigma",
    type=TRAIL_ENDS,
    metavar="START:STOP",
    default="0:0.3",
    show_default=True,
    help="Trails divided by the wheelbase; one value fixes the trail.",
)
@click.option(
    "--trail", type=LENGTH_ENDS, metavar="START:STOP", help="Trails, such as 40mm:80mm; cuts --sigma."
)
@click.option("--head-angle", type=ANGLE_ENDS, metavar="START:STOP", help="Head angles, instead of --lam.")
@click.option(
    "--offset", type=LENGTH_ENDS, metavar="START:STOP", help="Fork offsets, such as 0:80mm; cuts the box."
)
@click.option(
    "--V",
    "judged",
    type=SPEED_ENDS,
    metavar="SPEED|START:STOP",
    help="Where decay is judged, at the worst of a range.  [default: at the best speed of each design]",
)
@click.option(
    "--stable",
    type=SPEED_ENDS,
    metavar="START:STOP",
    help="Only designs that are stable at all these speeds.",
)
@click.option(
    "--V-max",
    "V_max",
    type=SPEED_VALUE,
    metavar="SPEED",
    default="30",
    show_default=True,
    help="Intervals count up to here [m/s]; those that start above do not.",
)
@over_ends_option
@free_option
@sd_option
@click.option(
    "--certified",
    is_flag=True,
    help="The largest box around one design that is proved stable, with sides in the proportions of --sd.",
)
@click.option(
    "--certificate",
    type=FILE,
    metavar="FILE",
    help="With --certified: write the proof for a checker, as JSON.",
)
@several_machines
@click.option(
    "-o",
    "--output",
    type=PICTURE,
    metavar="FILE",
    help="Draw the plane of designs, or what --free found, as PNG, PDF or SVG.",
)
@click.option(
    "--csv",
    "csv_file",
    type=FILE,
    metavar="FILE",
    help="Write the Pareto front, or what --free found, at full precision.",
)
@json_option
def command(
    lam: Ends, sigma: Ends, trail: Ends | None, head_angle: Ends | None, offset: Ends | None,
    judged: Ends | None, stable: Ends | None, V_max: float, over: dict[str, Ends], free: dict[str, Ends],
    deviations: tuple[bool, dict[str, float]], certified: bool, certificate: str | None,
    bicycle_name: tuple[str, ...], changes: Values, model: Model, delta: float | None,
    output: str | None, csv_file: str | None, as_json: bool,
) -> None:  # fmt: skip
    """Find the best tilt and trail, or other parameters.

    The widest interval of stable speeds, the lowest V1, the fastest decay (the lowest growth rate), and the
    Pareto front: designs of which none has both a wider interval and a faster decay than another.

    --over takes any two parameters instead: those of the bicycle's notation, a rider's, and lam, head_angle,
    sigma, trail, offset, delta; the rest is as the bicycle has it.

    --free lets the search choose up to six parameters; with --sd and --stable it also finds the most robust
    design: the largest ball, in these standard deviations, of machines stable at all the speeds asked for.

    --certified finds the largest box around the bicycle's own design, or that of one --lam, --trail and so
    on, that is proved stable: every tilt, trail and speed in it, and every value of other parameters that
    --sd names. Its sides grow in the proportions of --sd, 1deg and 10mm without it; the speeds are those of
    --stable, or else grow from the middle of the stable ones, in proportion to these.

    Several --bicycle and several values of --set give one table, and one picture of their fronts, a curve
    each.

    The search starts from 161 × 161 designs, so a region of allowed designs that is narrower than 1/160 of
    the box can be missed; a smaller box looks closer. The last column says where an optimum lies: at an
    edge of the stable region the interval may shrink to a point, which --stable avoids; at a jump it
    breaks up, or loses its width at once, just beside the optimum.

    \b
    Examples:
      bikestab design --bicycle meijaard2007 --V 5
      bikestab design --lam 10deg:25deg --trail 0.05:0.12 --stable 16km/h:18km/h
      bikestab design --sigma 0.08 --V 4:6 --json
      bikestab design --bicycle meijaard2007 --head-angle 68deg:74deg \\
        --offset 0:80mm --V 5
      bikestab design --bicycle meijaard2007 --set mB=60,110 --V 5 -o fronts.png
      bikestab design --bicycle meijaard2007 --over mB=60:110 \\
        --over offset=0:80mm -o loads.png
      bikestab design --bicycle meijaard2007 --free trail=2cm:15cm \\
        --stable 5:5.4 --sd mB=3
      bikestab design --bicycle meijaard2007 --certified --stable 4.6:5.4
      bikestab design --stable 4:6 --V 4:6 -o design.png --csv front.csv
    """
    from bikestab_cli.design_picture import check_picture, draw, search
    from bikestab_cli.design_words import told, told_all

    from bikestab.design.criteria import Wanted
    from bikestab.export.tables import FRONT, columns, front_blocks, of_machines, save_csv
    from bikestab.family import Family
    from bikestab.files import to_stdout

    if certified or certificate:
        from bikestab_cli.largest import check_certified, tell_largest

        check_certified(certified, free or over or output or csv_file)
        check_files(certificate)
        machines = machines_chosen(bicycle_name, delta, changes)
        tell_largest(machines, deviations, model, (V_max, judged, stable), certificate, as_json)
        return
    if free or any(deviations):
        from bikestab_cli.free import check_free, tell_free

        check_free(free, over)
        machines = machines_chosen(bicycle_name, delta, changes)
        tell_free(machines, free, deviations, model, (V_max, judged, stable), output, csv_file, as_json)
        return
    x, y = _axes(over)
    if head_angle:
        lam = _tilts(head_angle)
    machines = machines_chosen(bicycle_name, delta, changes)
    ends = (over[x], over[y]) if over else (lam, sigma)
    named = dict.fromkeys((*over, "x", "y", "lam", "sigma"), "--over") if over else {}
    with told_as_options(judged="--V", V_max="--V-max", **named):
        asked = [
            Wanted(Family(each.bicycle, model, x, y), *ends, trail, V_max, judged, stable, offset)
            for each in machines
        ]
    if output:
        check_picture(*ends)
    check_files(csv_file, output)
    bests, curves = search(asked, output)
    found = list(zip(machines, asked, bests, strict=True))
    (machine, wanted, best), *others = found
    if not as_json:
        text = told_all(found) if others else told(wanted, best, machine.changes)
        click.echo(text, err=any(to_stdout(name) for name in (csv_file, output) if name))
    files = {}
    if csv_file:
        blocks = [
            (each.bicycle.name, each.changes, front_blocks(own.pareto, [*over])) for each, _, own in found
        ]
        save_csv(*of_machines(columns(FRONT, asked[0].family), blocks), csv_file)
        files["csv"] = csv_file
    if output:
        draw(found, curves, output)
        files["picture"] = output
    if as_json:
        searched: dict[str, object] = {"lam": lam, "sigma": sigma, "trail": trail, "offset": offset}
        if over:
            searched = {**over}
        searched |= {"V_max": V_max, "judged": judged, "stable": stable}
        results = [[{"searched": searched, **own._asdict()}] for _, _, own in found]
        print_json(record_of(machines, model, results, files))
    else:
        for name in files.values():
            tell_file(name)


def _axes(over: dict[str, Ends]) -> tuple[str, str]:
    """The names of the two parameters that are searched over."""
    context = click.get_current_context()
    if not over:
        return "lam", "sigma"
    if len(over) != 2:
        raise click.UsageError("--over is given twice, for two parameters", context)
    others = ("lam", "sigma", "trail", "head_angle", "offset")
    if any(context.get_parameter_source(name) != click.core.ParameterSource.DEFAULT for name in others):
        problem = (
            "--over says all that is searched: leave out --lam, --sigma, --trail, --head-angle and --offset"
        )
        raise click.UsageError(problem, context)
    x, y = over
    return x, y


def _tilts(head_angles: Ends) -> Ends:
    from bikestab.geometry import tilt_of

    if click.get_current_context().get_parameter_source("lam") != click.core.ParameterSource.DEFAULT:
        problem = "--lam and --head-angle are one range: give one of them"
        raise click.UsageError(problem, click.get_current_context())
    low, high = (tilt_of(angle) for angle in head_angles[::-1])
    return low, high
