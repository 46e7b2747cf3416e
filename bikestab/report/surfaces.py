"""(family, box) → what the page draws of one machine: its surface, its plane of designs and their curves."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from io import BytesIO
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike
from PIL import Image

from bikestab.family import Family
from bikestab.model import Floats
from bikestab.plot.arranged import arrange_region
from bikestab.plot.lines import legend_below
from bikestab.plot.region import draw_mesh
from bikestab.plot.settings import own_settings
from bikestab.region.curves import trace
from bikestab.region.mesh import Mesh, region_mesh
from bikestab.speeds import intervals_of

if TYPE_CHECKING:
    from mpl_toolkits.mplot3d import Axes3D

_PLANE = 81  # designs per axis of the coloured plane
_TRACED = 2 * _PLANE - 1  # of the grid along which its curves are followed
_CELLS = 36  # of the surface, per axis
_STEPS = 65535  # of a surface's coordinates in the box, and of the plane's colour
_LABELS = ("tilt λ [rad]", "trail σ", "speed V [m/s]")  # short: the picture is printed 89 mm wide
_CURVE = 121  # points of a curve, at most


def surfaces(
    family: Family, lam: tuple[float, float], sigma: tuple[float, float], V: tuple[float, float]
) -> dict[str, Any]:
    """What page/volumes.mjs decodes, of a family over tilt [rad] and σ in a box that reaches to V [m/s]."""
    mesh = region_mesh(family, lam, sigma, V, cells=_CELLS)
    return {
        "plane": _plane(family, lam, sigma, V),
        "curves": _curves(family, lam, sigma, V),
        "mesh": _mesh(mesh, np.array([lam, sigma, V])),
        **_picture(mesh, [lam, sigma, V]),
    }


def _mesh(mesh: Mesh, box: Floats) -> dict[str, Any]:
    """The surface, its points in 65536 steps of the box along each axis: to be looked at."""
    low, high = box.T
    steps = np.rint((mesh.points - low) / (high - low) * _STEPS)
    return {
        "points": _bytes(np.clip(steps, 0, _STEPS), "<u2"),
        "triangles": _bytes(mesh.triangles, "<u2" if len(mesh.points) <= _STEPS else "<u4"),
        "kind": _bytes(mesh.kind, "u1"),
    }


@own_settings()
def _picture(mesh: Mesh, box: Sequence[tuple[float, float]]) -> dict[str, Any]:
    """The same surface as a picture: at once, in print, and for browsers that draw no three dimensions.

    With the matrix (3, 4) that takes (λ, σ, V, 1) to w times the shares of its width and height, and w.
    """
    figure = Figure(figsize=(4.8, 4.2))
    ax = cast("Axes3D", figure.add_subplot(projection="3d", computed_zorder=False))
    arrange_region(figure, ax, legend_below(figure, draw_mesh(ax, mesh, box, _LABELS), handlelength=2))
    drawn, file = BytesIO(), BytesIO()
    figure.savefig(drawn, format="png", dpi=640 / 4.8)
    Image.open(drawn).convert("RGB").quantize(64).save(file, "png", optimize=True)  # a quarter of its size
    flat = (ax.transData + figure.transFigure.inverted()).get_matrix()
    return {
        "picture": base64.b64encode(file.getvalue()).decode(),
        "view": (flat @ ax.get_proj()[[0, 1, 3]]).tolist(),
    }


def _plane(
    family: Family, lam: tuple[float, float], sigma: tuple[float, float], V: tuple[float, float]
) -> Any:
    """The speeds in the box at which each design is stable, added up [m/s]; rows are of σ."""
    x, y = np.linspace(*lam, _PLANE), np.linspace(*sigma, _PLANE)
    found = intervals_of(family.table(x, y[:, np.newaxis]))
    within = np.clip(found.V2, *V) - np.clip(found.V1, *V)
    width = np.nansum(within, axis=-1)
    step = float(np.max(width)) / _STEPS
    return {
        "lam": x.tolist(),
        "sigma": y.tolist(),
        "step": step,
        "width": _bytes(np.rint(width / (step or 1.0)), "<u2"),
    }


def _curves(
    family: Family, lam: tuple[float, float], sigma: tuple[float, float], V: tuple[float, float]
) -> list[dict[str, Any]]:
    """The curves at which intervals appear, vanish or change, with at most ``_CURVE`` points each."""

    def some(values: Floats) -> list[float]:
        chosen = np.unique(np.linspace(0, len(values) - 1, _CURVE).round().astype(int))
        return np.asarray(values[chosen], float).round(7).tolist()

    return [
        {"name": curve.name, "lam": some(curve.x), "sigma": some(curve.y)}
        for curve in trace(family, lam, sigma, V, samples=_TRACED)
    ]


def _bytes(values: ArrayLike, dtype: str) -> str:
    """Numbers as base64 of little-endian bytes, row by row."""
    return base64.b64encode(np.ascontiguousarray(values, dtype).tobytes()).decode()
