"""bikestab info: what is in a volume."""

from __future__ import annotations

from typing import Any

import click
from bikestab_cli.options import NAME, json_option
from bikestab_cli.output import print_json


@click.command("info")
@click.argument("volume", type=NAME)
@click.option(
    "--config", "show_config", is_flag=True, help="Print the YAML config that the volume was made from."
)
@json_option
def command(volume: str, show_config: bool, as_json: bool) -> None:
    """Tell what is in VOLUME, a volume.h5 or its folder.

    \b
    Examples:
      bikestab info out/quick
      bikestab info out/quick/volume.h5 --json
      bikestab info out/quick --config > again.yaml
    """
    from bikestab.export.summary import summary
    from bikestab.volume import Volume

    with Volume(volume) as opened:
        if show_config:
            click.echo(opened.text("config"), nl=False)
            return
        found = summary(opened)
    if as_json:
        print_json(found)
    else:
        click.echo(_told(found))


def _told(summary: dict[str, Any]) -> str:
    """A line for each entry, those of the sweep and of the axes with their values."""
    axes, sweep, warnings = (summary.pop(key) for key in ("axes", "sweep", "warnings"))
    width = max(map(len, summary)) + 2
    lines = []
    for key, value in summary.items():
        shown = ", ".join(value) if isinstance(value, list) else value
        if value is None or (key == "ensemble_samples" and not value) or key in sweep:
            continue
        if key.endswith("_difference"):
            shown = f"{value:.2g} m/s"
        lines.append((key.replace("_", " "), shown))
    for name, values in sweep.items():
        lines.append((name, f"{', '.join(f'{value:g}' for value in values)} (sweep)"))
    for name, axis in axes.items():
        steps = "equal steps" if axis["uniform"] else "own values"
        unit = "" if axis["unit"] == "1" else f" {axis['unit']}"
        lines.append((name, f"{axis['first']:g} ... {axis['last']:g}{unit}, {axis['num']} values, {steps}"))
    lines += [("warning", text) for text in warnings]
    return "\n".join(f"{name:<{width}}{shown}" for name, shown in lines)
