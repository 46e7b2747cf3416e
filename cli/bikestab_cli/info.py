"""bikestab info: what is in a volume."""

from __future__ import annotations

import textwrap
from typing import Any

import click
from bikestab_cli.options import NAME, json_option
from bikestab_cli.output import WIDTH, print_json, table

_MOST = 40  # machines in a table


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
        print_json({"results": [found]})
    else:
        click.echo(_told(found))


def _told(summary: dict[str, Any]) -> str:
    """A line for each entry, those of the sweep and of the axes with their values."""
    axes, sweep, drawn, warnings, machines = (
        summary.pop(key) for key in ("axes", "sweep", "drawn", "warnings", "machines")
    )
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
    lines += [(name, _distribution(*each)) for name, one in drawn.items() for each in one.items()]
    if summary["ensemble_samples"] and not drawn:
        lines.append(("drawn", "as a file says that --config names"))
    for name, axis in axes.items():
        steps = "equal steps" if axis["uniform"] else "own values"
        unit = "" if axis["unit"] == "1" else f" {axis['unit']}"
        lines.append((name, f"{axis['first']:g} ... {axis['last']:g}{unit}, {axis['num']} values, {steps}"))
    lines += [("warning", text) for text in warnings]
    told = []
    for name, shown in lines:
        text = f"{shown[:16]} ..." if name == "config sha256" else str(shown)
        words = textwrap.wrap(text, WIDTH - width, break_long_words=False, break_on_hyphens=False)
        first, *others = words or [""]
        told += [f"{name:<{width}}{first}", *(" " * width + other for other in others)]
    if machines:
        told += ["", *_machines(machines)]
    return "\n".join(told)


def _distribution(kind: str, numbers: list[float]) -> str:
    """How a parameter is drawn, in words: the same as in the schema of a config."""
    from bikestab.config.distributions import Distribution

    names = (Distribution.model_fields[kind].description or "").rpartition(": ")[2].split(", ")
    values = (f"{name} {value:g}" for name, value in zip(names, numbers, strict=True))
    return f"{kind}: {', '.join(values)} (drawn)"


def _machines(machines: list[dict[str, Any]]) -> list[str]:
    """A table of the machines of a sweep, and of an ensemble's quantiles at one design."""
    rows = []
    for each in machines[:_MOST]:
        name = "\n".join(f"{name}={value:g}" for name, value in each["set"].items()) or "all"
        points = "" if each["stable_points"] is None else str(each["stable_points"])
        row = [name, str(each["designs_with_a_stable_speed"]), points]
        if each["quantiles"]:
            row += ["\n".join(f"{x['quantile']:g}" for x in each["quantiles"])]
            row += ["\n".join(map(_speed, (x[end] for x in each["quantiles"]))) for end in ("V1", "V2")]
        rows.append(row)
    shares = machines[0]["quantiles"]
    head = ["machine", "stable\ndesigns", "stable\npoints"]
    head += ["quantile", "V1 [m/s]", "V2 [m/s]"] if shares else []
    lines = [table(head, rows, fold=0)]
    if len(machines) > _MOST:
        lines.append(f"and {len(machines) - _MOST} more machines, which --json lists")
    if shares:
        design = ", ".join(f"{name} = {value:.6g}" for name, value in machines[0]["at"].items())
        lines.append(f"quantiles at {design} of the machines that are stable there")
    return lines


def _speed(V: float | None) -> str:
    return "-" if V is None else f"{V:.4f}"
