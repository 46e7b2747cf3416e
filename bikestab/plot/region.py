"""The stable region of a volume's box in three dimensions, as in the paper's figure 3."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation
from mpl_toolkits.mplot3d import Axes3D
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection
from numpy.typing import ArrayLike, NDArray

from bikestab.family import Family
from bikestab.fields import AXES
from bikestab.model import Floats
from bikestab.plot.arranged import arrange_region
from bikestab.plot.axes import LABELS, labels_of, remarks
from bikestab.plot.headings import set_title, short
from bikestab.plot.lines import STRAIGHT, legend_below, straight_designs, straight_entry
from bikestab.plot.settings import own_settings
from bikestab.region.mesh import Mesh, region_mesh
from bikestab.region.triangulation import sides_of
from bikestab.speeds import CAPSIZE, KINDS, WEAVE
from bikestab.volume import Subject

# two colours of Okabe and Ito (2008) that differ in greyscale too
SHEETS = {WEAVE: ("#0072b2", "weave boundary"), CAPSIZE: ("#e69f00", "capsize boundary")}
_CELLS = 48  # of the mesh, per axis
_CLEAR = 0.6  # of the upper sheet
_LIGHT = np.array([-0.45, -0.6, 0.66])  # direction to the light, in units of the box
_SCALE = (1.0, 1.0, 0.85)  # of the drawn box


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
    figure = Figure(figsize=(7.4, 6.4))
    ax = cast("Axes3D", figure.add_subplot(projection="3d", computed_zorder=False))
    bicycle = family.bicycle
    straight = subject.axes == AXES
    if straight:
        lam, sigma = straight_designs(bicycle, box[0], box[1])
        ax.plot(lam, sigma, box[2][0], zorder=0, **STRAIGHT)  # on the floor, under the surface
    handles = draw_mesh(ax, mesh, box, [labels[name] for name in subject.axes])
    if straight and not np.isnan(sigma).all():
        handles.append(straight_entry("smaller σ"))
    rows = legend_below(figure, handles, ncols=2, handlelength=2)
    what = (
        f"{short(bicycle.name)}: stable between the lower and the upper sheet{remarks(bicycle, family.model)}"
    )
    set_title(ax, subject.title, what, y=1 / 0.92)  # Axes3D puts it at 0.92 of that
    arrange_region(figure, ax, rows)
    return figure


def draw_mesh(
    ax: Axes3D, mesh: Mesh, box: Sequence[tuple[float, float]], labels: Sequence[str] = (*LABELS.values(),)
) -> list[Patch | Line2D]:
    """The surface in axes that show the box λ [rad] × σ × V [m/s]; words where there is none.

    Returns what the legend has to say. The axes must have been made with ``computed_zorder=False``; they get
    the ``labels``.
    """
    handles: list[Patch | Line2D] = []
    if len(mesh.triangles):
        _surface(ax, mesh, np.array(box))
        handles = _legend(mesh, _rim(ax, mesh))
    else:
        ax.text2D(0.5, 0.5, "no stable motion in this box", transform=ax.transAxes, ha="center")
    ax.set(
        xlim=box[0], ylim=box[1], zlim=box[2],
        xlabel=labels[0], ylabel=labels[1], zlabel=labels[2],
    )  # fmt: skip
    for axis, prune in ((ax.xaxis, None), (ax.yaxis, "lower"), (ax.zaxis, None)):
        axis.set_major_locator(MaxNLocator(6, prune=prune))  # the first labels of x and y would meet
    ax.view_init(elev=25, azim=-125)
    ax.set_box_aspect(_SCALE, zoom=0.95)
    return handles


def _surface(ax: Axes3D, mesh: Mesh, ends: Floats) -> None:
    corners = mesh.points[mesh.triangles]
    unit = (mesh.points - ends[:, 0]) / (ends[:, 1] - ends[:, 0])
    a, b, c = unit[mesh.triangles].swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    light = 0.55 + 0.45 * np.abs(normal @ _LIGHT)  # both sides are seen
    colour = np.full((len(KINDS), 3), 0.5)
    colour[list(SHEETS)] = [to_rgb(name) for name, _ in SHEETS.values()]
    clear = np.where(mesh.upper, _CLEAR, 1.0)  # the lower sheet is seen through the upper
    faces = np.column_stack([colour[mesh.kind] * light[:, np.newaxis], clear])
    surface = Poly3DCollection(corners, facecolors=faces, edgecolors="none", antialiaseds=False)
    ax.add_collection3d(surface)


def _rim(ax: Axes3D, mesh: Mesh) -> list[Line2D]:
    """Where sheets meet and where the surface leaves the box, and what says so."""
    edges, which = sides_of(mesh.triangles)
    sheet = np.repeat(mesh.kind * 4 + mesh.upper + 2 * mesh.wall, 3)
    low, high = np.full(len(edges), 99), np.zeros(len(edges), int)
    np.minimum.at(low, which.ravel(), sheet)
    np.maximum.at(high, which.ravel(), sheet)
    once = np.bincount(which.ravel(), minlength=len(edges)) == 1
    handles = []
    for lines, style, label in (
        (edges[low != high], "-", "the sheets meet"),
        (edges[once], (0, (1.5, 1)), "the region goes on beyond the box"),
    ):
        if len(lines):
            points = mesh.points[lines]
            ax.add_collection3d(Line3DCollection(points, colors="0.1", linewidths=0.9, linestyles=[style]))
            handles.append(Line2D([], [], color="0.1", lw=0.9, ls=style, label=label))
    return handles


def _legend(mesh: Mesh, lines: list[Line2D]) -> list[Patch | Line2D]:
    patches = [
        Patch(facecolor=colour, label=label) for kind, (colour, label) in SHEETS.items() if kind in mesh.kind
    ]
    return [*patches, *lines]
