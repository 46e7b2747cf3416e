"""bikestab slice: a PNG of any plane of a volume."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from bikestab_cli.options import FILE, NAME, at_option, told_as_options
from bikestab_cli.output import tell_file
from bikestab_cli.quantities import ANGLE_VALUE, LENGTH_VALUE, SPEED_VALUE, TRAIL_VALUE

if TYPE_CHECKING:
    from bikestab.plot.slices import PlaneField
    from bikestab.volume import Volume


@click.command("slice")
@click.argument("volume", type=NAME)
@click.option("--lam", type=ANGLE_VALUE, help="Fix the tilt: the picture is over trail and speed.")
@click.option("--sigma", type=TRAIL_VALUE, help="Fix the trail: the picture is over tilt and speed.")
@click.option("--head-angle", type=ANGLE_VALUE, help="Fix the tilt by the head angle.")
@click.option("--trail", type=LENGTH_VALUE, help="Fix the trail by its length.")
@click.option("--V", "V", type=SPEED_VALUE, help="Fix the speed: the picture is over tilt and trail.")
@at_option
@click.option(
    "--probability",
    is_flag=True,
    help="Of an ensemble: how probable stability is, not the growth rate.",
)
@click.option(
    "--certified", is_flag=True, help="What 'scan --certify' has proved of the cells, not the growth rate."
)
@click.option(
    "-o",
    "--output",
    type=FILE,
    metavar="FILE",
    help="PNG, PDF or SVG; default slice_AXIS_VALUE.png beside the volume.",
)
def command(
    volume: str, lam: float | None, sigma: float | None, V: float | None,
    head_angle: float | None, trail: float | None, machine: dict[str, float],
    probability: bool, certified: bool, output: str | None,
) -> None:  # fmt: skip
    """Draw any plane of a volume.

    One of the three axes is fixed; of a grid over other parameters by --at, as --at mB=85. VOLUME is a
    volume.h5 or its folder. The value need not be on the grid: the growth rate is then computed for that
    plane, while a probability is that of the nearest plane; what is proved is so of the plane itself. The
    boundary curves are exact in any case.

    \b
    Examples:
      bikestab slice out/quick --lam 0.2
      bikestab slice out/quick --head-angle 78deg -o steep.png
      bikestab slice out/quick/volume.h5 --V 18km/h -o speed.png
      bikestab slice out/proved --sigma 0.08 --certified
    """
    if probability and certified:
        problem = "--probability and --certified are two pictures; give one of them"
        raise click.UsageError(problem, click.get_current_context())
    from bikestab.geometry import design_given
    from bikestab.plot.files import save, slice_name
    from bikestab.plot.slices import draw_slice, on_grid
    from bikestab.volume import Volume

    planes = {"lam": lam, "sigma": sigma, "V": V, "head_angle": head_angle, "trail": trail}
    given = {name: value for name, value in planes.items() if value is not None}
    with Volume(volume) as opened:
        on_axis = {name: machine.pop(name) for name in opened.axes if name in machine}
        fixed, value = _plane(opened, given | on_axis)
        if fixed in ("head_angle", "trail") and fixed not in opened.axes:
            bicycle = opened.at(machine).bicycle
            with told_as_options():
                design = design_given({fixed: value}, bicycle.c, bicycle.R2)
            fixed, value = ("lam", float(design[0])) if fixed == "head_angle" else ("sigma", float(design[1]))
        field: PlaneField = "growth_rate"
        if probability or certified:
            field = "probability" if probability else "certified"
        if probability and (near := on_grid(opened.axis(fixed), value)) != value:
            click.echo(f"note: the nearest plane of the grid is drawn, {fixed} = {near:.6g}", err=True)
            value = near
        name = slice_name({fixed: value, **machine}, field)
        path = Path(output) if output else opened.path.parent / name
        if not path.suffix and not path.exists():
            path = path.with_name(path.name + ".png")
        figure = draw_slice(opened.at(machine), fixed, value, field)
        save(figure, path)
    tell_file(path)


def _plane(volume: Volume, given: dict[str, float]) -> tuple[str, float]:
    """The one axis that is fixed, and its value."""
    if len(given) == 1:
        ((name, value),) = given.items()
        measured = {"head_angle": "lam", "trail": "sigma"}
        if name in volume.axes or measured.get(name) in volume.axes:
            return name, value
    context, (x, y, _) = click.get_current_context(), volume.axes
    if (x, y) == ("lam", "sigma"):
        problem = "give one of --lam, --sigma and --V, for example --lam 0.2; or --head-angle or --trail"
        raise click.UsageError(problem, context)
    middle = float(volume.axis(x)[len(volume.axis(x)) // 2])
    problem = f"the volume is over {x}, {y} and V: give one of --at {x}=VALUE, --at {y}=VALUE and --V"
    raise click.UsageError(f"{problem}, for example --at {x}={middle:g}", context)
