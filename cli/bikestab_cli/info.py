"""bikestab info: what is in a volume."""

from __future__ import annotations

from typing import Any

import click
from bikestab_cli.options import json_option
from bikestab_cli.output import print_json


@click.command("info")
@click.argument("volume")
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
    from bikestab.volume import Volume

    with Volume(volume) as opened:
        if show_config:
            click.echo(opened.text("config"), nl=False)
            return
        summary = _summary(opened)
    if as_json:
        print_json(summary)
        return
    axes, sweep = summary.pop("axes"), summary.pop("sweep")
    warnings = summary.pop("warnings")
    width = max(map(len, summary)) + 2
    for key, value in summary.items():
        shown = ", ".join(value) if isinstance(value, list) else value
        if value is None or (key == "ensemble_samples" and not value) or key in sweep:
            continue
        if key.endswith("_difference"):
            shown = f"{value:.2g} m/s"
        click.echo(f"{key.replace('_', ' '):<{width}}{shown}")
    for name, values in sweep.items():
        click.echo(f"{name:<{width}}{', '.join(f'{value:g}' for value in values)} (sweep)")
    for name, axis in axes.items():
        steps = "equal steps" if axis["uniform"] else "own values"
        unit = "" if axis["unit"] == "1" else f" {axis['unit']}"
        ends = f"{axis['first']:g} ... {axis['last']:g}{unit}"
        click.echo(f"{name:<{width}}{ends}, {axis['num']} values, {steps}")
    for text in warnings:
        click.echo(f"{'warning':<{width}}{text}")


def _summary(volume: Any) -> dict[str, Any]:
    import numpy as np

    from bikestab.fields import AXES
    from bikestab.volume import uniform

    file = volume.file
    number = np.count_nonzero(volume.read("upper"), axis=-1)
    points = int(np.prod([len(file[name]) for name in (*volume.swept, *AXES)]))
    attributes, checks = file.attrs, dict(file["boundary"].attrs)
    bracketed = checks.get("largest_bracketed_difference")  # earlier volumes have none
    return {
        "volume": str(volume.path),
        "title": volume.text("title"),
        "bicycle": volume.text("bicycle"),
        "model": volume.model,
        "delta": volume.bicycle.delta,
        "fields": volume.fields,
        "ensemble_samples": volume.samples,
        "points": points,
        "stable_points": int(attributes["stable_points"]),
        "designs": int(number.size),
        "designs_with_a_stable_speed": int(np.count_nonzero(number)),
        "designs_with_several_intervals": int(np.count_nonzero(number > 1)),
        "designs_stable_without_upper_limit": int(np.count_nonzero(np.isinf(volume.read("V2")).any(axis=-1))),
        "largest_boundary_difference": float(checks["largest_difference"]),
        "largest_bracketed_difference": None if bracketed is None else float(bracketed),
        "bikestab_version": volume.text("bikestab_version"),
        "config_sha256": volume.text("config_sha256"),
        "sweep": {name: values.tolist() for name, values in volume.swept.items()},
        "axes": {
            name: {
                "first": float(values[0]),
                "last": float(values[-1]),
                "num": len(values),
                "unit": file[name].attrs["units"].decode(),
                "uniform": uniform(values),
            }
            for name, values in ((name, volume.axis(name)) for name in AXES)
        },
        "warnings": volume.text("warnings").splitlines(),
    }
