"""The boundary's triangle mesh as a file for VTK and ParaView, or for programs that read PLY and STL.

docs/exports.md describes what is in the files. PLY and STL are written here and not by VTK, whose PLY
has single precision and no attributes of one's own, and whose writers tell of a full disk only on stderr.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bikestab.export.formats import file_format
from bikestab.fields import AXES
from bikestab.files import written
from bikestab.model import Floats
from bikestab.region.mesh import Mesh
from bikestab.speeds import CAPSIZE, KINDS, WEAVE

UNITS = {"lam": "rad", "sigma": "1", "V": "m/s"}
MESHES = {".vtp": "vtkmodules", ".vtu": "vtkmodules", ".ply": "", ".stl": ""}  # ending → package it needs
COLOURS = {WEAVE: (0, 114, 178), CAPSIZE: (230, 159, 0)}  # blue and orange of Okabe and Ito
_LENGTH = 10.0  # of each side of the box in the file, as far as round factors allow

_ENDS = ("lower", "upper", "wall")
# as meshio takes it: to it uchar is signed, float64 unknown, and faces have nothing but their corners
_HEADER = (
    "ply\nformat binary_little_endian 1.0\n{comments}element vertex {vertices}\n"
    "property double x\nproperty double y\nproperty double z\nproperty double growth_rate\n"
    "property uint8 red\nproperty uint8 green\nproperty uint8 blue\n"
    "element face {faces}\nproperty list uint8 int32 vertex_indices\nend_header\n"
)


def readable_scale(low: ArrayLike, high: ArrayLike) -> Floats:
    """Round factors (1, 2 or 5 times a power of ten) that make the sides of a box about equally long.

    ``low`` and ``high`` are the ends of the axes, shape (axis,).
    """
    factor = _LENGTH / (np.asarray(high, dtype=float) - np.asarray(low, dtype=float))
    round_numbers = np.array([1.0, 2.0, 5.0, 10.0]) * 10.0 ** np.floor(np.log10(factor))[:, np.newaxis]
    nearest = np.argmin(np.abs(np.log(round_numbers / factor[:, np.newaxis])), axis=1)
    return np.array([float(f"{numbers[i]:.0e}") for numbers, i in zip(round_numbers, nearest, strict=True)])


def scale_text(scale: ArrayLike, names: Iterable[str] = AXES) -> str:
    """How coordinates in a file follow from λ, σ and V, or the axes of these ``names``, in words."""
    pairs = zip("xyz", np.asarray(scale, dtype=float), names, strict=True)
    return ", ".join(f"{axis} = {factor:.15g} {name}" for axis, factor, name in pairs)


def save_mesh(
    mesh: Mesh, path: Path, scale: Sequence[float] | Floats, about: Mapping[str, str],
    units: Mapping[str, str] = UNITS,
) -> None:  # fmt: skip
    """Write a mesh in the format of the file's ending, its points (λ, σ, V) times ``scale`` (3,).

    ``units`` are those of its axes by their names. ``about`` is told in the file as far as the format has
    room. Raises InputError for an unknown ending or a missing package, and as ``files.written``.
    """
    ending = file_format(path, MESHES)
    points = mesh.points * np.asarray(scale, dtype=float)
    of = ", ".join(f"{name} in {unit.replace('²', '2')}" for name, unit in units.items() if unit != "1")
    about = {"axes": f"{scale_text(scale, units)} ({of})", **about}
    # one line of ASCII, as PLY needs and VTK's Python side
    about = {k: " ".join(text.encode("ascii", "replace").decode().split()) for k, text in about.items()}
    if ending == ".stl":
        content = _stl(mesh, points, about)
    elif ending == ".ply":
        content = _ply(mesh, points, about)
    else:
        content = _vtk(mesh, points, (*units,), np.asarray(scale, dtype=float), about, ending)
    with written(path) as part:
        part.write_bytes(content)


def _upper(mesh: Mesh) -> NDArray[np.uint8]:
    """0 lower end, 1 upper end, 2 wall."""
    return np.where(mesh.wall, np.uint8(2), mesh.upper.astype(np.uint8))


def _vtk(
    mesh: Mesh, points: Floats, names: tuple[str, ...], scale: Floats, about: Mapping[str, str], ending: str
) -> bytes:
    from vtkmodules.vtkCommonCore import vtkStringArray
    from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkPolyData, vtkUnstructuredGrid
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

    place, cells = _vtk_surface(points, mesh.triangles)
    data: Any
    writer: Any
    if ending == ".vtp":
        writer, data = vtkXMLPolyDataWriter(), vtkPolyData()
        data.SetPolys(cells)
    else:
        writer, data = vtkXMLUnstructuredGridWriter(), vtkUnstructuredGrid()
        data.SetCells(VTK_TRIANGLE, cells)
    data.SetPoints(place)
    data.GetFieldData().AddArray(_vtk_array(scale, "scale"))
    for name, text in about.items() if ending == ".vtp" else ():
        words = vtkStringArray()
        words.SetName(name)
        words.InsertNextValue(text)
        data.GetFieldData().AddArray(words)
    of_points = dict(zip((*names, "growth_rate"), (*mesh.points.T, mesh.decay), strict=True))
    for part, arrays in (
        (data.GetPointData(), of_points),
        (data.GetCellData(), {"kind": mesh.kind, "upper": _upper(mesh)}),
    ):
        for name, values in arrays.items():
            part.AddArray(_vtk_array(values, name))
        part.SetActiveScalars(next(iter(arrays)))
    writer.SetInputData(data)
    writer.WriteToOutputStringOn()  # so that Python writes the file, and raises its errors
    writer.Write()
    head, body = writer.GetOutputString().split("\n", 1)
    if ending == ".vtu":  # meshio takes no text in field data
        lines = "".join(f"  {name}: {text}\n".replace("--", "- -") for name, text in about.items())
        head += f"\n<!--\n{lines}-->"
    return f"{head}\n{body}".encode()


def _vtk_surface(points: Floats, triangles: NDArray[np.integer]) -> tuple[Any, Any]:
    """VTK's points and cells."""
    from vtkmodules.vtkCommonCore import VTK_ID_TYPE, vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray

    place, cells = vtkPoints(), vtkCellArray()
    place.SetData(_vtk_array(points, "Points"))
    first = np.arange(0, 3 * len(triangles) + 1, 3)
    cells.SetData(*(_vtk_array(each, kind=VTK_ID_TYPE) for each in (first, triangles.ravel())))
    return place, cells


def _vtk_array(values: NDArray[Any], name: str = "", kind: int | None = None) -> Any:
    from vtkmodules.util.numpy_support import numpy_to_vtk

    made = numpy_to_vtk(np.ascontiguousarray(values), deep=True, array_type=kind)
    made.SetName(name)
    return made


def _ply(mesh: Mesh, points: Floats, about: Mapping[str, str]) -> bytes:
    colour = np.zeros((len(KINDS), 3), np.uint8)
    colour[list(COLOURS)] = list(COLOURS.values())
    kind = np.zeros(len(points), np.uint8)
    for each in COLOURS:  # where both kinds meet the last one counts
        kind[mesh.triangles[mesh.kind == each]] = each
    vertex = np.empty(len(points), [("place", "<f8", 3), ("growth_rate", "<f8"), ("colour", "u1", 3)])
    vertex["place"], vertex["growth_rate"], vertex["colour"] = points, mesh.decay, colour[kind]
    order = np.lexsort((_upper(mesh), mesh.kind))
    face = np.empty(len(order), [("n", "u1"), ("i", "<i4", 3)])
    face["n"], face["i"] = 3, mesh.triangles[order]
    sheets, count = np.unique(np.array([mesh.kind, _upper(mesh)]), axis=1, return_counts=True)
    told = (f"{n} {KINDS[k]} {_ENDS[end]}" for n, (k, end) in zip(count, sheets.T, strict=True))
    comments = "".join(f"comment {k}: {text}\n" for k, text in {**about, "faces": ", ".join(told)}.items())
    header = _HEADER.format(comments=comments, vertices=len(vertex), faces=len(face))
    return header.encode() + vertex.tobytes() + face.tobytes()


def _stl(mesh: Mesh, points: Floats, about: Mapping[str, str]) -> bytes:
    corners = points[mesh.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    facet = np.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
    facet["normal"] = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
    facet["corners"] = corners
    header = f"bikestab: {about['axes']}".encode()[:80].ljust(80)  # "solid" first would mean text
    return header + np.array(len(facet), "<u4").tobytes() + facet.tobytes()
