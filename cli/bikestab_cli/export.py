"""bikestab export: the boundary as a triangle mesh, intervals and skeleton as tables."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.options import FILE, NAME, at_option, check_files
from bikestab_cli.output import count, tell_file

if TYPE_CHECKING:
    from bikestab.export.volumes import Counts
    from bikestab.region.curves import Curve
    from bikestab.region.mesh import Mesh
    from bikestab.region.points import Point
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
@click.argument("volume", type=NAME)
@click.option(
    "--mesh",
    "meshes",
    type=FILE,
    metavar="FILE",
    multiple=True,
    help="The boundary surface: .vtp, .vtu, .ply or .stl.",
)
@click.option(
    "--intervals",
    type=FILE,
    metavar="FILE",
    multiple=True,
    help="Every design's stable intervals: .csv or .parquet.",
)
@click.option(
    "--skeleton",
    type=FILE,
    metavar="FILE",
    multiple=True,
    help="Curves where intervals change: .csv or .parquet.",
)
@click.option(
    "--quantiles", type=FILE, metavar="FILE", multiple=True,
    help="An ensemble's quantiles of V1 and V2: .csv or .parquet.",
)  # fmt: skip
@at_option
@click.option(
    "--cells", type=click.IntRange(10, 400), default=100, show_default=True,
    help="Triangles of the mesh along each of the two parameters.",
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
    quantiles: tuple[str, ...],
    machine: dict[str, float],
    cells: int,
    scale: tuple[float, float, float] | None,
) -> None:
    """Write what a volume shows for other programs.

    VOLUME is a volume.h5 or its folder. The ending of each FILE chooses its format; options may be repeated.
    Of a sweep --intervals and --quantiles have all machines, with the values of its axes in the first
    columns, or that of --at; --mesh and --skeleton take one of them.

    The mesh is computed anew in the volume's box, whatever its grid: every vertex lies on the surface to
    rounding, and it has no holes. The factors of its axes are told, and stand in the file.

    The skeleton is the curves where intervals appear, vanish or get another end, and behind them, as curve 0,
    the points where they meet or end: double zero, triple zero, zero-Hopf, double Hopf, cusp of the fold,
    ends at infinity.

    Formats .vtp, .vtu and .parquet need the extra: pip install "bikestab[export]".

    \b
    Examples:
      bikestab export out/quick --mesh region.ply --cells 40
      bikestab export out/quick --intervals intervals.csv --skeleton skeleton.csv
      bikestab export out/quick --mesh region.stl --scale 50,100,1
      bikestab export out/quick --intervals intervals.parquet
    """
    from bikestab.export.formats import file_format
    from bikestab.export.meshes import MESHES, scale_text
    from bikestab.export.tables import TABLES
    from bikestab.export.volumes import export_intervals, export_mesh, export_quantiles, export_skeleton
    from bikestab.volume import Volume

    if not (meshes or intervals or skeleton or quantiles):
        raise click.UsageError(
            "give --mesh, --intervals, --skeleton or --quantiles, for example --mesh region.vtp",
            click.get_current_context(),
        )
    for names, known in ((meshes, MESHES), (intervals + skeleton + quantiles, TABLES)):
        for name in names:
            file_format(name, known)  # before the computation, which takes seconds
    names = (*meshes, *intervals, *skeleton, *quantiles)
    check_files(*names)
    with Volume(volume) as whole:
        every = whole.swept and not machine and not (meshes or skeleton)
        opened = whole if every else whole.at(machine)
        if intervals:
            _echo(intervals, _intervals_told(export_intervals(opened, intervals)))
        if quantiles:
            _echo(quantiles, count(export_quantiles(opened, quantiles), "row"))
        if skeleton:
            _echo(skeleton, _skeleton_told(opened, *export_skeleton(opened, skeleton)))
        if meshes:
            mesh, factors = export_mesh(opened, meshes, cells=cells, scale=scale)
            if len(mesh.triangles):
                _echo(meshes, f"{_mesh_told(mesh)}; {scale_text(factors, opened.axes)}")
            else:
                click.echo(f"no surface in the box: no mesh is written ({', '.join(meshes)})")


def _echo(names: tuple[str, ...], words: str) -> None:
    for name in names:
        tell_file(name, words)


def _intervals_told(found: Counts) -> str:
    without = f"{found.without} of {found.designs} designs have no stable speed and no row"
    return f"{count(found.intervals, 'interval')}; {without}"


def _skeleton_told(volume: Volume, curves: list[Curve], special: list[Point]) -> str:
    if not curves:
        from bikestab.export.volumes import alike

        ends = (volume.axis(name)[[0, -1]] for name in volume.axes[:2])
        box = " and ".join(f"{name} {a:g} ... {b:g}" for name, (a, b) in zip(volume.axes, ends, strict=False))
        why = alike(volume) or "no stable interval begins or changes"
        return f"0 curves: {why} in {box}; a larger box may have some"
    words = f"{count(len(curves), 'curve')} of {count(sum(len(curve.x) for curve in curves), 'point')}"
    kinds = Counter(point.name for point in special)
    shown = ", ".join(f"{number} {name}" for name, number in kinds.items())
    return words + (f"; where they meet or end: {shown}" if shown else "")


def _mesh_told(mesh: Mesh) -> str:
    from bikestab.speeds import CAPSIZE, WEAVE

    weave, capsize = (int((mesh.kind == kind).sum()) for kind in (WEAVE, CAPSIZE))
    size = f"{count(len(mesh.points), 'point')}, {count(len(mesh.triangles), 'triangle')}"
    return f"{size} ({weave} weave, {capsize} capsize)"
