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
    lam = 0.2 if bicycle.lam is None else bicycle.lam
    sigma = 0.08 if bicycle.sigma is None else bicycle.sigma
    values = {
        "LAM_START": f"{min(0.0, 1.5 * lam):.3g}",
        "LAM_STOP": f"{max(0.4, min(1.5 * lam, 0.5 * lam + 0.78)):.3g}",  # below a right angle
        "SIGMA_START": f"{min(0.0, 1.5 * sigma):.3g}",
        "SIGMA_STOP": f"{max(0.15, 1.5 * sigma):.3g}",
        "TITLE": json.dumps(f"Stable motion of {bicycle.name}", ensure_ascii=False),
        "BICYCLE": json.dumps(name, ensure_ascii=False),  # quoted, as any name may need it in YAML
        "OUTPUT": json.dumps(f"out/{Path(path).stem}", ensure_ascii=False),
        "LAM": f"{lam:.6g}",
        "SIGMA": f"{sigma:.6g}",
    }
    text = (Path(__file__).parent / "template.yaml").read_text("utf-8")
    text = re.sub("@([A-Z_]+)@", lambda match: values[match[1]], text)
    target = Path(path)
    try:
        with target.open("w" if force else "x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise InputError("exists already", place=path, hint="--force replaces it") from None
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", place=path) from None
    click.echo(f"{path}; now 'bikestab scan {path}'")
