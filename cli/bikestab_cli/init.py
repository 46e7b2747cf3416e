"""bikestab init: a commented config to start from."""

from __future__ import annotations

import json
import re
from pathlib import Path

import click
from bikestab_cli.options import DEFAULT_BICYCLE

from bikestab.errors import InputError


@click.command("init")
@click.argument("path", default="bikestab.yaml")
@click.option(
    "--bicycle", "name", metavar="NAME|FILE", default=DEFAULT_BICYCLE, show_default=True, help="The bicycle."
)
@click.option("--force", is_flag=True, help="Replace an existing file.")
def command(path: str, name: str, force: bool) -> None:
    """Write a commented scan config to PATH (bikestab.yaml).

    \b
    Examples:
      bikestab init
      bikestab init mine.yaml --bicycle meijaard2007
    """
    from bikestab.bicycle import Bicycle

    bicycle = Bicycle.load(name)
    values = {
        "TITLE": json.dumps(f"Stable motion of {bicycle.name}", ensure_ascii=False),
        "BICYCLE": json.dumps(name, ensure_ascii=False),  # quoted, as any name may need it in YAML
        "OUTPUT": json.dumps(f"out/{Path(path).stem}", ensure_ascii=False),
        "LAM": f"{0.2 if bicycle.lam is None else bicycle.lam:.6g}",
        "SIGMA": f"{0.08 if bicycle.sigma is None else bicycle.sigma:.6g}",
    }
    text = (Path(__file__).parent / "template.yaml").read_text("utf-8")
    text = re.sub("@([A-Z]+)@", lambda match: values[match[1]], text)
    target = Path(path)
    try:
        with target.open("w" if force else "x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise InputError("exists already", place=path, hint="--force replaces it") from None
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", place=path) from None
    click.echo(f"{path}; now 'bikestab scan {path}'")
