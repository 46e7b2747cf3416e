"""bikestab eigen: eigenvalues against speed, with the names of their modes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.options import (
    SPEEDS,
    check_files,
    json_option,
    load_bicycle,
    machine_options,
    tilt_option,
    told_as_options,
    trail_option,
)
from bikestab_cli.output import DESIGN_HEAD, design_columns, heading, print_json, table

if TYPE_CHECKING:
    from bikestab.branches import Modes
    from bikestab.records import Interval

COLUMNS = ("weave", "capsize", "castering")


@click.command("eigen")
@tilt_option
@trail_option
@click.option(
    "--V",
    "speeds",
    type=SPEEDS,
    metavar="SPEED|RANGE",
    default="0:10:21",
    show_default=True,
    help="Speeds [m/s] of the table: START:STOP:NUM, such as 0:36km/h:11, or one.",
)
@machine_options
@click.option(
    "-o", "--output", metavar="FILE", help="Draw a PNG, PDF or SVG from START to STOP, however coarse NUM."
)
@click.option("--csv", "csv_file", metavar="FILE", help="Write V, branch, name, re, im at full precision.")
@json_option
def command(
    lam: float | None,
    sigma: float | None,
    speeds: list[float],
    bicycle_name: str,
    model: Any,
    delta: float | None,
    output: str | None,
    csv_file: str | None,
    as_json: bool,
) -> None:
    """Print or draw the eigenvalues against speed.

    At one tilt and trail, the bicycle's own without --lam or --sigma. Each mode is followed continuously.
    Files are written in place of the table, and named on stdout. JSON is an object with what vrange says of
    one design and, at the speeds V, four branches with name, re and im at each.

    The pair that crosses the imaginary axis at an end of the stable speeds is weave, the real eigenvalue that
    crosses zero at one is capsize, and each keeps its name to where it meets another. What makes no end is
    named after the highest speeds that have exactly one pair: the pair is weave, and of the two real
    eigenvalues beside it castering is the faster and capsize the slower. What is neither is called real pair
    where the two of weave are real (real if only one is), pair 2 if it oscillates, and weave 2 or capsize 2
    beside another of that name.

    \b
    Examples:
      bikestab eigen --bicycle meijaard2007
      bikestab eigen --lam 0.2 --sigma 0.08 --V 0:10:11
      bikestab eigen --bicycle meijaard2007 --V 0:36km/h:361 -o modes.png --csv modes.csv
      bikestab eigen --lam 11deg --sigma 0.08 --delta 1 --V 5 --json
    """
    from bikestab.export.tables import MODES, modes_blocks, save_csv
    from bikestab.records import design_record, interval_records, modes_record
    from bikestab.stability import design_of, modes, stable_intervals

    if output and min(speeds) == max(speeds):
        raise click.BadParameter("a picture needs a range, for example 0:10:21", param_hint="--V")
    if output and not Path(output).suffix:
        raise click.BadParameter(
            f"{output!r} has no ending, such as .png, .pdf or .svg", param_hint="--output"
        )
    check_files(csv_file, output)
    bicycle = load_bicycle(bicycle_name, delta)
    with told_as_options():
        tilt, trail = (float(value) for value in design_of(bicycle, lam, sigma))
        found = modes(bicycle, speeds, tilt, trail, model=model)
    intervals = interval_records(stable_intervals(bicycle, tilt, trail, model=model))
    files = {}
    if csv_file:
        save_csv(MODES, modes_blocks(found), csv_file)
        files["csv"] = csv_file
    if output:
        from bikestab.plot.files import save
        from bikestab.plot.modes import draw_modes

        save(draw_modes(bicycle, tilt, trail, min(speeds), max(speeds), model=model), Path(output))
        files["picture"] = output
    if as_json:
        head = {"bicycle": bicycle.name, "model": model, "delta": bicycle.delta}
        design = design_record(tilt, trail, bicycle.c)
        print_json({**head, **design, "intervals": intervals, **modes_record(found), **files})
    elif files:
        click.echo("\n".join(files.values()))
    else:
        click.echo(heading(bicycle, model) + "\n")
        click.echo(table(DESIGN_HEAD, [design_columns(tilt, trail, bicycle.c)]) + "\n")
        click.echo("\n".join([*map(_told, intervals)] or ["no stable speed"]))
        click.echo("".join(line + "\n" for line in _meetings(found, max(speeds))))
        click.echo(_eigenvalue_table(found))


def _told(interval: Interval) -> str:
    lower = f"{interval['V1']:.6f} m/s ({interval['lower']})"
    if interval["V2"] is None:
        return f"stable from {lower} on, without upper limit"
    return f"stable from {lower} to {interval['V2']:.6f} m/s ({interval['upper']})"


def _meetings(modes: Modes, up_to: float) -> list[str]:
    """What becomes of the eigenvalues that meet, and of the names of the others."""
    from bikestab.modenames import OSCILLATING

    lines = []
    for V, pair, below, above in zip(
        modes.coalescences, modes.meeting, modes.below, modes.above, strict=True
    ):
        before, behind = (", ".join(dict.fromkeys(names[row] for row in pair)) for names in (below, above))
        if above[pair[0]] in OSCILLATING:
            line = f"two real eigenvalues ({before}) become a complex pair ({behind})"
        else:
            line = f"a complex pair ({before}) becomes two real eigenvalues ({behind})"
        others = [
            (below[row], above[row]) for row in range(4) if row not in pair and below[row] != above[row]
        ]
        renamed = [f"; {old} is {new} from there on" for old, new in dict.fromkeys(others)]
        if up_to >= V:
            lines.append(f"at {V:.6f} m/s {line}{''.join(renamed)}")
    return lines


def _eigenvalue_table(modes: Modes) -> str:
    """A row for each speed, a column for each of the three modes and one for what else there is."""
    rows = [_row(s, names) for s, names in zip(modes.eigenvalues.T, modes.names.T, strict=True)]
    head = ["V [m/s]", *(f"{name} [1/s]" for name in COLUMNS), "others [1/s]"]
    cells = [[f"{V:.6g}", *row] for V, row in zip(modes.V, rows, strict=True)]
    used = 5 if any(row[-1] for row in rows) else 4
    return table(head[:used], [row[:used] for row in cells])


def _row(s: Any, names: Any) -> list[str]:
    """The eigenvalues at a speed in the columns of their names; those of others have the name behind."""
    cells = {name: _motion(s[names == name]) for name in dict.fromkeys(names.tolist())}
    if "weave" not in cells and "real pair" in cells:
        cells["weave"] = f"{cells.pop('real pair')} (real pair)"
    others = [f"{text} ({name})" for name, text in cells.items() if name not in COLUMNS]
    return [*(cells.get(name, "") for name in COLUMNS), ", ".join(others)]


def _motion(s: Any) -> str:
    """The eigenvalues of one name: pairs as one, real ones each."""
    return ", ".join(
        f"{x.real:z.6f} ± {x.imag:z.6f}i" if x.imag else f"{x.real:z.6f}" for x in s if x.imag >= 0
    )
