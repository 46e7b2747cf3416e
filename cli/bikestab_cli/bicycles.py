"""bikestab bicycles: the bicycles that come with the package."""

from __future__ import annotations

import textwrap

import click
from bikestab_cli.options import NAME, json_option
from bikestab_cli.output import print_json


@click.command("bicycles")
@click.argument("name", type=NAME, required=False)
@json_option
def command(name: str | None, as_json: bool) -> None:
    """List the bicycles that come with bikestab.

    With NAME, print the YAML file of that one.

    Such a file, changed to taste, serves as --bicycle FILE and as 'bicycle: FILE' in a config.

    \b
    Examples:
      bikestab bicycles
      bikestab bicycles meijaard2007 > mine.yaml
    """
    from bikestab.bicycle import Bicycle, preset_names, preset_text

    chosen = [Bicycle.preset(n) for n in ([name] if name else preset_names())]
    if as_json:
        print_json(
            [
                {"name": b.name, "source": b.source, **b.numbers(), "warnings": list(b.warnings)}
                for b in chosen
            ]
        )
        return
    if name:
        click.echo(preset_text(name), nl=False)
        return
    for bicycle in chosen:
        own = "no own design point: give --lam and --sigma"
        if bicycle.lam is not None and bicycle.sigma is not None:
            own = f"own design point: λ = {bicycle.lam:.6g} rad, σ = {bicycle.sigma:.6g}"
        click.echo(bicycle.name)
        click.echo(textwrap.fill(bicycle.source, 96, initial_indent="  ", subsequent_indent="  "))
        click.echo(f"  {own}")
        for text in bicycle.warnings:
            click.echo(textwrap.fill(f"warning: {text}", 96, initial_indent="  ", subsequent_indent="    "))
