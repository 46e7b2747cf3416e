"""bikestab init: a commented config to start from."""

from __future__ import annotations

from pathlib import Path

import click
from bikestab_cli.options import DEFAULT_BICYCLE, NAME


@click.command("init")
@click.argument("path", type=NAME, default="bikestab.yaml")
@click.option(
    "--bicycle",
    "name",
    type=NAME,
    metavar="NAME|FILE",
    default=DEFAULT_BICYCLE,
    show_default=True,
    help="The bicycle.",
)
@click.option("--force", is_flag=True, help="Replace an existing file.")
def command(path: str, name: str, force: bool) -> None:
    """Write a commented scan config to PATH (bikestab.yaml).

    \b
    Examples:
      bikestab init
      bikestab init mine.yaml --bicycle meijaard2007
    """
    from bikestab.config.template import starting_config
    from bikestab.errors import InputError
    from bikestab.files import written

    text = starting_config(name, path)
    if Path(path).exists() and not force:
        raise InputError("exists already", place=path, hint="--force replaces it")
    with written(path) as part:
        part.write_text(text, "utf-8")
    click.echo(f"{path}; now 'bikestab scan {path}'")
