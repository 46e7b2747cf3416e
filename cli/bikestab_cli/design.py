"""bikestab design: the best tilt and trail by several criteria."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click
from bikestab_cli.design_box import Box, box_options
from bikestab_cli.designless import end_of_all, lacking, results_of_all, told_without, with_design
from bikestab_cli.options import FILE, PICTURE, check_curves, check_files, free_option, json_option, sd_option
from bikestab_cli.output import print_json, tell, tell_file
from bikestab_cli.quantities import Ends
from bikestab_cli.several import Chosen, Values, machines_chosen, record_of, several_machines

if TYPE_CHECKING:
    from bikestab.design.best import Best
    from bikestab.design.criteria import Wanted
    from bikestab.model import Model


@click.command("design")
@box_options
@free_option
@sd_option
@click.option(
    "--certified", is_flag=True,
    help="The largest box around one design that is proved stable, with sides in the proportions of --sd.",
)  # fmt: skip
@click.option(
    "--certificate", type=FILE, metavar="FILE",
    help="With --certified: write the proof for a checker, as JSON.",
)  # fmt: skip
@several_machines
@click.option(
    "-o", "--output", type=PICTURE, metavar="FILE",
    help="Draw the plane of designs, or what --free found, as PNG, PDF or SVG.",
)  # fmt: skip
@click.option(
    "--csv", "csv_file", type=FILE, metavar="FILE",
    help="Write the Pareto front, or what --free found, at full precision.",
)  # fmt: skip
@json_option
def command(
    box: Box,
    free: dict[str, Ends],
    deviations: tuple[bool, dict[str, float]],
    certified: bool,
    certificate: str | None,
    bicycle_name: tuple[str, ...],
    changes: Values,
    model: Model,
    delta: float | None,
    output: str | None,
    csv_file: str | None,
    as_json: bool,
) -> None:
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
      bikestab design --head-angle 68deg:78deg --offset 0:80mm --V 5
      bikestab design --bicycle meijaard2007 --set mB=60,110 --V 5 -o fronts.png
      bikestab design --bicycle meijaard2007 --over mB=60:110 --over trail=4cm:9cm
      bikestab design --bicycle sharp1971 --free lam=20deg:35deg --stable 10:20
      bikestab design --bicycle meijaard2007 --certified --stable 4.6:5.4
      bikestab design --stable 4:6 --V 4:6 -o design.png --csv front.csv
    """
    if certified or certificate:
        from bikestab_cli.largest import check_certified, tell_largest

        check_certified(certified, free or box.over or output or csv_file)
        check_files(certificate)
        machines = machines_chosen(bicycle_name, delta, changes)
        tell_largest(machines, deviations, model, box.speeds, certificate, as_json)
    elif free or any(deviations):
        from bikestab_cli.free import check_free, tell_free

        check_free(free, box.over)
        machines = machines_chosen(bicycle_name, delta, changes)
        tell_free(machines, free, deviations, model, box.speeds, output, csv_file, as_json)
    else:
        box = box.checked()
        _tell_best(machines_chosen(bicycle_name, delta, changes), box, model, output, csv_file, as_json)


def _tell_best(
    machines: Sequence[Chosen],
    box: Box,
    model: Model,
    output: str | None,
    csv_file: str | None,
    as_json: bool,
) -> None:
    """Search the box, and tell what was found, draw it and write it."""
    from bikestab_cli.design_picture import check_picture, draw, search
    from bikestab_cli.design_words import told_of_all

    lacks = lacking(machines, box.ends)
    able = with_design(machines, lacks)
    asked = box.wanted(able, model)
    if output:
        check_picture(*box.ends.values())
    check_curves(output, len(able))
    check_files(csv_file, output)
    bests, curves = search(asked, output)
    found = list(zip(able, asked, bests, strict=True))
    if not as_json:
        text = told_of_all(found, told_without(machines, lacks))
        tell(text, csv_file, output)
    if csv_file:
        _save(found, [*box.over], csv_file)
    if output:
        draw(found, curves, output)
    files = {kind: name for kind, name in (("csv", csv_file), ("picture", output)) if name}
    if as_json:
        results = [[{"searched": box.searched(), **own._asdict()}] for own in bests]
        print_json(record_of(machines, model, results_of_all(machines, lacks, results), files))
    else:
        for name in files.values():
            tell_file(name)
    end_of_all(machines, lacks)


def _save(found: Sequence[tuple[Chosen, Wanted, Best]], over: Sequence[str], csv_file: str) -> None:
    """Write the fronts."""
    from bikestab.export.tables import FRONT, columns, front_blocks, of_machines, save_csv

    blocks = [(each.bicycle.name, each.changes, front_blocks(own.pareto, over)) for each, _, own in found]
    save_csv(*of_machines(columns(FRONT, found[0][1].family), blocks), csv_file)
