"""bikestab export: the boundary as a triangle mesh, intervals and skeleton as tables."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.options import Ends, at_option, check_files
from bikestab_cli.output import count

if TYPE_CHECKING:
    from bikestab.volume import Volume


class _Scale(click.ParamType):
    """Three positive numbers with commas between them."""

    name = "factors"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        try:
            factors = tuple(float(part) for part in str(value).split(","))
        except ValueError:
            factors = ()
        if len(factors) != 3 or not all(1e-9 <= factor <= 1e9 for factor in factors):
            self.fail(f"{value!r} is not three numbers from 1e-9 to 1e9 such as 50,100,1", param, ctx)
        return factors


@click.command("export")
@click.argument("volume")
@click.option(
    "--mesh", "meshes", metavar="FILE", multiple=True, help="The boundary surface: .vtp, .vtu, .ply or .stl."
)
@click.option(
    "--intervals", metavar="FILE", multiple=True, help="Every design's stable intervals: .csv or .parquet."
)
@click.option(
    "--skeleton", metavar="FILE", multiple=True, help="Curves where intervals change: .csv or .parquet."
)
@at_option
@click.option(
    "--cells", type=click.IntRange(10, 400), default=100, show_default=True,
    help="Triangles of the mesh along tilt and along trail.",
)  # fmt: skip
@click.option(
    "--scale", type=_Scale(), metavar="LAM,SIGMA,V",
    help="Factors of the mesh's coordinates; 1,1,1 for none.  [default: round ones, a box about 10 wide]",
)  # fmt: skip
def command(
    volume: str,
    meshes: tuple[str, ...],
    intervals: tuple[str, ...],
    skeleton: tuple[str, ...],
    machine: dict[str, float],
    cells: int,
    scale: tuple[float, float, float] | None,
) -> None:
    """Write what a volume shows for other programs.

    VOLUME is a volume.h5 or its folder. The ending of each FILE chooses its format; options may be repeated.
    The mesh is computed anew in the volume's box, whatever its grid: every vertex lies on the surface to
    rounding, and it has no holes. The factors of its axes are told, and stand in the file.

    Formats .vtp, .vtu and .parquet need the extra: pip install "bikestab[export]".

    \b
    Examples:
      bikestab export out/quick --mesh region.ply --cells 40
      bikestab export out/quick --intervals intervals.csv --skeleton skeleton.csv
      bikestab export out/quick --mesh region.vtp --mesh region.stl --scale 50,100,1
      bikestab export out/quick --intervals intervals.parquet
    """
    from bikestab.export.formats import file_format
    from bikestab.export.meshes import MESHES
    from bikestab.export.tables import TABLES
    from bikestab.volume import Volume

    if not (meshes or intervals or skeleton):
        raise click.UsageError(
            "give --mesh, --intervals or --skeleton, for example --mesh region.vtp",
            click.get_current_context(),
        )
    for names, known in ((meshes, MESHES), (intervals + skeleton, TABLES)):
        for name in names:
            file_format(name, known)  # before the computation, which takes seconds
    names = (*meshes, *intervals, *skeleton)
    check_files(*names)
    with Volume(volume) as whole:
        opened = whole.at(machine)
        about = _about(opened)
        if intervals:
            _write_intervals(opened, intervals, about)
        if skeleton:
            _write_skeleton(opened, skeleton, about)
        if meshes:
            _write_mesh(opened, meshes, cells, scale, about)


def _about(volume: Volume) -> dict[str, str]:
    from bikestab import __version__

    bicycle = volume.bicycle
    return {
        "title": volume.title, "bicycle": bicycle.name, "model": volume.model, "delta": repr(bicycle.delta),
        "source": f"bikestab {__version__}", "kinds": "1 weave, 2 capsize",
    }  # fmt: skip


def _box(volume: Volume) -> list[Ends]:
    axes = volume.axis("lam"), volume.axis("sigma"), volume.axis("V")
    return [(float(axis[0]), float(axis[-1])) for axis in axes]


def _write_intervals(volume: Volume, names: tuple[str, ...], about: dict[str, str]) -> None:
    from bikestab.export.tables import INTERVALS, interval_blocks, save_table

    stable = volume.read("upper") > 0
    intervals, designs = int(stable.sum()), stable[..., 0].size
    without = designs - int(stable.any(axis=-1).sum())
    for name in names:
        save_table(INTERVALS, interval_blocks(volume), Path(name), about)
        click.echo(
            f"{name}: {count(intervals, 'interval')}; "
            f"{without} of {designs} designs have no stable speed and no row"
        )


def _write_skeleton(volume: Volume, names: tuple[str, ...], about: dict[str, str]) -> None:
    from bikestab.export.tables import SKELETON, save_table, skeleton_blocks
    from bikestab.family import Family
    from bikestab.region.curves import trace

    bicycle = volume.bicycle
    lam, sigma, _ = _box(volume)  # at all speeds: two of the curves are at infinite ones
    curves = trace(Family(bicycle, volume.model), lam, sigma)
    points = sum(len(curve.x) for curve in curves)
    for name in names:
        save_table(SKELETON, skeleton_blocks(curves, bicycle.c), Path(name), about)
        click.echo(f"{name}: {count(len(curves), 'curve')} of {count(points, 'point')}")


def _write_mesh(
    volume: Volume,
    names: tuple[str, ...],
    cells: int,
    scale: tuple[float, float, float] | None,
    about: dict[str, str],
) -> None:
    from bikestab.export.meshes import readable_scale, save_mesh, scale_text
    from bikestab.family import Family
    from bikestab.region.mesh import region_mesh
    from bikestab.speeds import CAPSIZE, WEAVE

    box = _box(volume)
    mesh = region_mesh(Family(volume.bicycle, volume.model), *box, cells=cells)
    if not len(mesh.triangles):
        click.echo(f"no surface in the box: no mesh is written ({', '.join(names)})")
        return
    factors = readable_scale(*zip(*box, strict=True)) if scale is None else scale
    weave, capsize = (int((mesh.kind == kind).sum()) for kind in (WEAVE, CAPSIZE))
    for name in names:
        save_mesh(mesh, Path(name), factors, about)
        click.echo(
            f"{name}: {count(len(mesh.points), 'point')}, {count(len(mesh.triangles), 'triangle')} "
            f"({weave} weave, {capsize} capsize); {scale_text(factors)}"
        )
