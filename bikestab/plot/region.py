"""The stable region of a volume's box in three dimensions, as in the paper's figure 3."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation
from mpl_toolkits.mplot3d import Axes3D
from mpl_toolkits.mplot3d.art3d import Line3DCollection
from mpl_toolkits.mplot3d.proj3d import proj_transform
from numpy.typing import ArrayLike, NDArray

from bikestab.family import Family
from bikestab.fields import AXES
from bikestab.model import Floats
from bikestab.plot.arranged import arrange_region
from bikestab.plot.axes import LABELS, labels_of, place_ticks, remarks
from bikestab.plot.colours import OWN
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import STRAIGHT, entry, legend_below, straight_designs
from bikestab.plot.raster import Raster, rasterize
from bikestab.plot.settings import own_settings
from bikestab.region.mesh import Mesh, region_mesh
from bikestab.region.triangulation import sides_of
from bikestab.speeds import CAPSIZE, KINDS, WEAVE, intervals_of
from bikestab.volume import Subject

# two colours of Okabe and Ito (2008) that differ in greyscale too; which way stripes go, and their hatch
SHEETS = {WEAVE: ("#0072b2", "weave", -1, r"\\\\"), CAPSIZE: ("#e69f00", "capsize", 1, "////")}
_CELLS = 48  # of the mesh, per axis
_LONG = 28  # letters of a label, with which it fits beside an axis
_LIGHT = np.array([-0.45, -0.6, 0.66])  # direction to the light, in units of the box
_SPACES = 5  # between the numbers beside an axis, at most
_SIZE = 9  # of words beside axes
_SCALE = (1.0, 1.0, 0.85)  # of the drawn box
_NAMES = tuple(LABELS[name] for name in AXES)


class _Quick(Family):
    """Designs whose tables are those of double precision, which no eye tells from exact ones."""

    def table(self, x: ArrayLike, y: ArrayLike, others: Mapping[str, Any] | None = None) -> Floats:
        return self.quick_table(x, y, others)


def _triangles(points: Floats) -> NDArray[np.integer]:
    """Delaunay's, by the library that matplotlib has of its own, so that scipy need not be imported."""
    return np.asarray(Triangulation(*points).triangles)


@own_settings()
def draw_region(subject: Subject) -> Figure:
    """The boundary surface within a volume's axes, weave and capsize sheets in two colours."""
    box = [(float(axis[0]), float(axis[-1])) for axis in (subject.axis(name) for name in subject.axes)]
    family = subject.family
    labels = labels_of(family)
    quick = _Quick(family.bicycle, family.model, family.x, family.y)
    mesh = region_mesh(quick, box[0], box[1], box[2], cells=_CELLS, delaunay=_triangles)
    figure = Figure(figsize=(5.6, 5.1))
    ax = cast("Axes3D", figure.add_subplot(projection="3d", computed_zorder=False))
    straight = subject.axes == AXES
    if straight:
        lam, sigma = straight_designs(family.bicycle, box[0], box[1])
        ax.plot(lam, sigma, box[2][0], zorder=0, **STRAIGHT)  # on the floor, under the surface
    short_ones = {p.name: f"{p.symbol} [{p.unit}]" for p in family.parameters if len(labels[p.name]) > _LONG}
    handles = draw_mesh(ax, mesh, box, [{**labels, **short_ones}[name] for name in subject.axes])
    for axis, name in zip((ax.xaxis, ax.yaxis), subject.axes[:2], strict=True):
        if name == "head_angle":
            place_ticks(axis, name, _SPACES, prune="lower" if axis is ax.yaxis else None)
    if straight and not np.isnan(sigma).all():
        handles.append(entry("fork offset b = 0", **STRAIGHT))
    handles += _own_design(ax, family, box)
    rows = legend_below(figure, handles, handlelength=2)
    unusual = remarks(family.bicycle, family.model, {family.x, family.y})
    what = f"{short(family.bicycle.name)}: stable above the lower and below the upper limit{unusual}"
    set_title(ax, subject.title, what, y=1)
    arrange_region(figure, ax, rows)
    return figure


def draw_mesh(
    ax: Axes3D, mesh: Mesh, box: Sequence[tuple[float, float]], labels: Sequence[str] = _NAMES
) -> list[Patch | Line2D]:
    """The surface in axes that show the box λ [rad] × σ × V [m/s]; words where there is none.

    Returns what the legend has to say. The axes must have been made with ``computed_zorder=False``; they get
    the ``labels``.
    """
    ax.set(
        xlim=box[0], ylim=box[1], zlim=box[2],
        xlabel=labels[0], ylabel=labels[1], zlabel=labels[2],
    )  # fmt: skip
    for axis, prune in ((ax.xaxis, None), (ax.yaxis, "lower"), (ax.zaxis, None)):
        axis.label.set_fontsize(_SIZE)
        axis.set_tick_params(labelsize=_SIZE, pad=0)
        axis.set_major_locator(MaxNLocator(_SPACES, prune=prune))  # the first labels of x and y would meet
    ax.zaxis.set_rotate_label(False)  # which else is read downwards
    ax.zaxis.label.set_rotation(90)
    ax.view_init(elev=25, azim=-125)
    ax.set_box_aspect(_SCALE, zoom=1)
    if len(mesh.triangles):
        return _legend(mesh, _rim(ax, mesh, _surface(ax, mesh, np.array(box))))
    ax.text2D(0.5, 0.5, "no stable motion in this box", transform=ax.transAxes, ha="center")
    return []


def _surface(ax: Axes3D, mesh: Mesh, ends: Floats) -> Raster:
    """Draw the surface, each triangle lit, the lower sheets seen between the stripes of the upper."""
    unit = (mesh.points - ends[:, 0]) / (ends[:, 1] - ends[:, 0])
    a, b, c = unit[mesh.triangles].swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    light = 0.55 + 0.45 * np.abs(normal @ _LIGHT)  # both sides are seen
    colour, way = np.full((len(KINDS), 3), 0.5), np.zeros(len(KINDS), int)
    for kind, (name, _, stripes, _) in SHEETS.items():
        colour[kind], way[kind] = to_rgb(name), stripes
    faces = colour[mesh.kind] * light[:, np.newaxis]
    corners = _projected(ax, mesh.points)[mesh.triangles]
    raster = rasterize(corners, faces, np.where(mesh.upper, way[mesh.kind], 0))
    image = AxesImage(ax, extent=raster.extent, origin="lower", interpolation="bilinear", zorder=1)
    image.set_data(raster.pixels)
    image.set_clip_on(False)
    ax.add_artist(image)
    return raster


def _projected(ax: Axes3D, points: Floats) -> Floats:
    """Points (n, 3) in the axes' picture, and how far away they are."""
    return np.column_stack(proj_transform(*points.T, ax.get_proj()))


def _rim(ax: Axes3D, mesh: Mesh, raster: Raster) -> list[Line2D]:
    """Where sheets meet and where the surface leaves the box, unless hidden, and what says so."""
    edges, which = sides_of(mesh.triangles)
    sheet = np.repeat(mesh.kind * 4 + mesh.upper + 2 * mesh.wall, 3)
    low, high = np.full(len(edges), 99), np.zeros(len(edges), int)
    np.minimum.at(low, which.ravel(), sheet)
    np.maximum.at(high, which.ravel(), sheet)
    once = np.bincount(which.ravel(), minlength=len(edges)) == 1
    seen = ~raster.hides(*_projected(ax, mesh.points[edges].mean(axis=1)).T)
    handles = []
    for lines, style, label in (
        (edges[seen & (low != high)], "-", "the sheets meet"),
        (edges[seen & once], (0, (1.5, 1)), "the region goes on beyond the box"),
    ):
        if len(lines):
            points = mesh.points[lines]
            ax.add_collection3d(Line3DCollection(points, colors="0.1", linewidths=0.9, linestyles=[style]))
            handles.append(Line2D([], [], color="0.1", lw=0.9, ls=style, label=label))
    return handles


def _own_design(ax: Axes3D, family: Family, box: Sequence[tuple[float, float]]) -> list[Line2D]:
    """The stable speeds of the bicycle's own design, above its place on the floor; what the legend says."""
    own = [value for value in family.own if value is not None]
    if len(own) < 2 or not all(low <= value <= high for value, (low, high) in zip(own, box[:2], strict=True)):
        return []
    x, y = own
    low, high = box[2]
    found = intervals_of(family.table(*np.array(own)))
    ax.plot([x], [y], [low], marker="*", ms=9, color=OWN, mec="black", mew=0.6, ls="none", zorder=0)
    foot = low
    for V1, V2 in zip(found.V1[: found.number], found.V2[: found.number], strict=True):
        start, stop = max(low, float(V1)), min(high, float(V2))
        if start < stop:
            ax.plot([x, x], [y, y], [foot, start], color=OWN, lw=1, ls=":", zorder=0)
            ax.plot([x, x], [y, y], [start, stop], color=OWN, lw=2.4, marker="o", ms=4, zorder=6)
            foot = stop
    return [entry("own design", color=OWN, lw=2.4, marker="o", ms=4)]


def _legend(mesh: Mesh, lines: list[Line2D]) -> list[Patch | Line2D]:
    """What is said of the sheets that there are, whole ones and striped ones, and of lines."""
    patches = []
    for kind, (colour, name, _, hatch) in SHEETS.items():
        there = mesh.kind == kind
        if np.any(there & ~mesh.upper):
            patches.append(Patch(facecolor=colour, label=f"{name}: lower limit"))
        if np.any(there & mesh.upper):
            label = f"{name}: upper limit (striped)"
            patches.append(Patch(facecolor="white", edgecolor=colour, hatch=hatch, lw=0, label=label))
    return [*patches, *lines]
