"""bikestab bicycles: the bicycles that come with the package."""

from __future__ import annotations

import textwrap
from pathlib import Path

import click
from bikestab_cli.chosen import Given, design_chosen, design_options
from bikestab_cli.options import BICYCLE, PICTURE, bicycle_named, check_files, json_option
from bikestab_cli.output import WIDTH, print_json, tell_file


@click.command("bicycles")
@click.argument("name", type=BICYCLE, required=False)
@click.option(
    "-o", "--output", type=PICTURE, metavar="FILE",
    help="Draw NAME, or the bicycle in a file, from its side: PNG, PDF or SVG.",
)  # fmt: skip
@design_options()
@json_option
def command(name: str | None, output: str | None, given: Given, as_json: bool) -> None:
    """List the bicycles that come with bikestab.

    With NAME, print the YAML file of that one. With -o, draw it to scale with the symbols of its own
    notation, at its own tilt and trail where no others are given.

    Such a file, changed to taste, serves as --bicycle FILE and as 'bicycle: FILE' in a config.

    \b
    Examples:
      bikestab bicycles
      bikestab bicycles meijaard2007 > mine.yaml
      bikestab bicycles mine.yaml -o side.png
      bikestab bicycles dikarev1981 --lam 0.2 --sigma 0.08 -o side.png
      bikestab bicycles mine.yaml --head-angle 71deg --offset 45mm -o side.png
    """
    from bikestab.bicycle import Bicycle
    from bikestab.errors import InputError
    from bikestab.presets import preset_names, preset_text

    if output:
        _draw(name, output, given)
        return
    if given:
        option = f"--{next(iter(given)).replace('_', '-')}"
        raise click.UsageError(f"{option} is for a picture: give -o FILE", click.get_current_context())
    if name and name not in preset_names():
        bicycle_named(name)  # what is no bicycle is told as that
        hint = "-o draws it, and 'bikestab convert' prints it"
        raise InputError("is a file, not a bicycle that comes with bikestab", place=name, hint=hint)
    chosen = [Bicycle.preset(n) for n in ([name] if name else preset_names())]
    if as_json:
        results = [
            {"name": b.name, "source": b.source, **b.numbers(), "warnings": list(b.warnings)} for b in chosen
        ]
        print_json({"results": results})
        return
    if name:
        click.echo(preset_text(name), nl=False)
        return
    for bicycle in chosen:
        own = "no own design point: give --lam and --sigma"
        if bicycle.lam is not None and bicycle.sigma is not None:
            own = f"own design point: λ = {bicycle.lam:.6g} rad, σ = {bicycle.sigma:.6g}"
        click.echo(bicycle.name)
        click.echo(textwrap.fill(bicycle.source, WIDTH, initial_indent="  ", subsequent_indent="  "))
        click.echo(f"  {own}")
        for text in bicycle.warnings:
            click.echo(
                textwrap.fill(f"warning: {text}", WIDTH, initial_indent="  ", subsequent_indent="    ")
            )


def _draw(name: str | None, output: str, given: Given) -> None:
    from bikestab.plot.files import save
    from bikestab.plot.side import draw_side

    if name is None:
        raise click.UsageError("a picture is of one bicycle: give its NAME", click.get_current_context())
    check_files(output)
    bicycle = bicycle_named(name)
    save(draw_side(bicycle, *design_chosen(bicycle, given)), Path(output))
    tell_file(output)
