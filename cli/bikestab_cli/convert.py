"""bikestab convert: a bicycle's file in another notation or format."""

from __future__ import annotations

from pathlib import Path

import click
from bikestab_cli.options import BICYCLE, FILE, NAME, bicycle_named, warn


@click.command("convert")
@click.argument("bicycle_name", type=BICYCLE, metavar="NAME|FILE")
@click.option(
    "-o",
    "--output",
    type=FILE,
    metavar="FILE",
    help="Write to FILE, in the format of its ending: .yaml, .json, .ini or .txt.  [default: YAML to stdout]",
)
@click.option("--rider", type=NAME, metavar="FILE", help="Join the rider in a file of BicycleParameters.")
@click.option(
    "--notation",
    type=click.Choice(["given", "paper", "meijaard2007"]),
    default="given",
    show_default=True,
    help="The parameters as given, or reduced to the paper's two parts; or the 25 of four bodies.",
)
@click.option("--force", is_flag=True, help="Replace an existing file.")  # fmt: skip
def command(bicycle_name: str, output: str | None, rider: str | None, notation: str, force: bool) -> None:
    """Write a bicycle in another format or notation.

    Reads whatever --bicycle reads: YAML, JSON and INI of either notation, text and YAML of BicycleParameters,
    its pendulum measurements (extra 'measured'), and bicycles of JBike6. Numbers keep every bit, and their
    uncertainties.

    \b
    Examples:
      bikestab convert meijaard2007 -o mine.json
      bikestab convert meijaard2007 --notation paper

    There is no way back from two parts to four bodies: they do not tell what of a part is its wheel.
    """
    from bikestab.errors import InputError
    from bikestab.files import written
    from bikestab.formats.writing import written as text_of

    bicycle = bicycle_named(bicycle_name)
    if rider:
        from bikestab.ridden import with_rider

        bicycle = with_rider(bicycle, rider)
    if notation == "meijaard2007" and bicycle.bodies is None:
        raise InputError(
            "the paper's two parts cannot be taken apart into the four bodies of the 25 parameters",
            place=bicycle_name, hint="they do not tell what of a part is its wheel; leave --notation out",
        )  # fmt: skip
    numbers, deviations = bicycle.given, dict(bicycle.deviations)
    if notation == "paper" and bicycle.bodies is not None:
        numbers = {key: value for key, value in bicycle.numbers().items() if value is not None}
        if deviations:
            click.echo("note: uncertainties are those of the given parameters; left out", err=True)
            deviations = {}
    if deviations and bicycle.correlations:
        click.echo("note: correlations of the uncertainties cannot be written; left out", err=True)
    warn(bicycle)
    ending = Path(output).suffix.lower() if output else ".yaml"
    if not ending:
        is_folder = Path(str(output)).is_dir()
        hint = "give the format with an ending, e.g. -o out.yaml; without -o it goes to stdout"
        raise InputError("is a folder" if is_folder else "has no ending", place=str(output), hint=hint)
    try:
        text = text_of(ending, numbers, deviations, {"name": bicycle.name, "source": bicycle.source})
    except InputError as error:
        raise error.at(output or "") from None
    if not output:
        click.echo(text, nl=False)
        return
    if Path(output).is_file() and not force:
        raise InputError("exists already", place=output, hint="--force replaces it")
    with written(output) as part:
        part.write_text(text, "utf-8")
    click.echo(output)
