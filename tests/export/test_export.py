"""Exported files, read back by other programs: on the surface, closed, oriented; tables equal the volume."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.file import parse_config
from bikestab.errors import InputError
from bikestab.export import tables
from bikestab.export.formats import file_format
from bikestab.export.meshes import MESHES, readable_scale, save_mesh
from bikestab.export.tables import INTERVALS, SKELETON, interval_blocks, save_table, skeleton_blocks
from bikestab.family import Family
from bikestab.model import characteristic_table, exact_table
from bikestab.region.curves import Curve, trace
from bikestab.region.mesh import region_mesh
from bikestab.routh import conditions
from bikestab.scan.run import run_scan
from bikestab.speeds import CAPSIZE, KINDS, WEAVE, intervals_of
from bikestab.volume import Volume

pyvista = pytest.importorskip("pyvista")
meshio = pytest.importorskip("meshio")
trimesh = pytest.importorskip("trimesh")
parquet = pytest.importorskip("pyarrow.parquet")

BOXES = {  # bicycle, box, factors of the file
    "dikarev1981": (((0.0, 0.3), (0.0, 0.15), (0.0, 15.0)), (50, 50, 1)),
    "meijaard2007": (((0.0, 0.6), (0.0, 0.5), (0.0, 15.0)), (20, 20, 0.5)),
}
ABOUT = {"bicycle": "Ωmega\n bike", "model": "refined"}
# λ is tilted enough for designs without stable speed, with two intervals and with an unbounded one
SCAN = """\
bicycle: dikarev1981
grid:
  lam: {values: [0, 0.015, 0.04834835, 0.06, 0.1, 0.2]}
  sigma: {values: [0.02, 0.08, 0.1475, 0.15]}
  V: {values: [0, 1, 30]}
output: OUT
"""


@pytest.fixture(scope="module", params=BOXES)
def case(request, tmp_path_factory):
    """Bicycle, box, factors, mesh, and the folder with a file of each format."""
    bicycle, (box, scale) = Bicycle.preset(request.param), BOXES[request.param]
    mesh = region_mesh(Family(bicycle), *box, cells=40)
    folder = tmp_path_factory.mktemp("mesh")
    for ending in MESHES:
        save_mesh(mesh, folder / f"region{ending}", scale, ABOUT)
    return bicycle, np.array(box), np.array(scale, float), mesh, folder


def triangles_of(surface):
    return surface.regular_faces if isinstance(surface, pyvista.PolyData) else surface.cells_dict[5]


def distance(bicycle, points, name):
    """|f| / |∇f| of points (3, point) in λ [rad], σ and V [m/s], the gradient by differences."""

    def value(x):
        return getattr(conditions(characteristic_table(bicycle, x[0], x[1]), x[2]), name)

    h = 1e-6
    slope = [(value(points + e) - value(points - e)) / (2 * h) for e in h * np.eye(3)[:, :, np.newaxis]]
    return np.abs(value(points)) / np.linalg.norm(slope, axis=0)


def eigenvalues(bicycle, points):
    """Of points (3, point), from the companion matrix."""
    lam, sigma, V = points
    p = [sum(c * V**j for j, c in enumerate(row)) for row in characteristic_table(bicycle, lam, sigma)]
    matrix = np.zeros((len(V), 4, 4))
    matrix[:, 0] = (-np.array(p[3::-1]) / p[4]).T
    matrix[:, [1, 2, 3], [0, 1, 2]] = 1
    return np.linalg.eigvals(matrix)


# --- meshes


@pytest.mark.parametrize("ending", [".vtp", ".vtu"])
def test_vtk_reads_every_vertex_on_its_surface(case, ending):
    bicycle, _, scale, mesh, folder = case
    surface = pyvista.read(folder / f"region{ending}")
    assert surface.points.dtype == np.float64
    assert surface.n_cells == len(mesh.triangles) > 500
    triangles = triangles_of(surface)
    unscaled = surface.points.T / scale[:, np.newaxis]
    np.testing.assert_allclose(
        unscaled, [surface.point_data[name] for name in ("lam", "sigma", "V")], rtol=4e-16
    )
    assert set(surface.cell_data["kind"]) <= {WEAVE, CAPSIZE}
    assert len(np.unique(triangles)) == surface.n_points  # none is left over
    for kind, name in ((WEAVE, "hurwitz3"), (CAPSIZE, "p0")):
        points = unscaled[:, np.unique(triangles[surface.cell_data["kind"] == kind])]
        assert distance(bicycle, points, name).max() < 1e-9
        s = eigenvalues(bicycle, points)
        on = np.abs(s.real if kind == WEAVE else s).min(axis=1) / np.abs(s).max(axis=1)
        # where two eigenvalues meet at zero, rounding's square root is left
        assert np.quantile(on, 0.95) < 1e-9
        assert on.max() < 1e-5
        assert s.real.max() < 1e-4  # the surface is the end of a stable interval


def test_attributes(case):
    _, _, scale, mesh, folder = case
    surface = pyvista.read(folder / "region.vtp")
    np.testing.assert_array_equal(surface.point_data["growth_rate"], mesh.decay)
    np.testing.assert_array_equal(surface.cell_data["kind"], mesh.kind)
    np.testing.assert_array_equal(surface.cell_data["upper"], mesh.upper)
    np.testing.assert_array_equal(surface.field_data["scale"], scale)
    x, y, z = scale
    words = f"x = {x:g} lam, y = {y:g} sigma, z = {z:g} V (lam in rad, V in m/s)"
    assert surface.field_data["axes"][0] == words
    assert surface.field_data["bicycle"][0] == "?mega bike"


def test_open_only_at_the_faces_of_the_box(case):
    _, box, _, _, folder = case
    surface = pyvista.read(folder / "region.vtp")
    others = {"feature_edges": False, "manifold_edges": False}
    assert surface.extract_feature_edges(boundary_edges=False, **others).n_cells == 0
    edges = surface.extract_feature_edges(non_manifold_edges=False, **others)
    assert edges.n_cells > 40  # the surface does leave the box
    ends = np.array([edges.point_data[name] for name in ("lam", "sigma", "V")])[
        :, edges.lines.reshape(-1, 3)[:, 1:]
    ]
    on_a_face = (ends[..., np.newaxis] == box[:, np.newaxis, np.newaxis, :]).all(axis=2)
    assert on_a_face.any(axis=(0, 2)).all()


@pytest.mark.parametrize("ending", [".vtp", ".vtu"])
def test_neighbours_run_along_their_side_in_opposite_ways(case, ending):
    triangles = triangles_of(pyvista.read(case[-1] / f"region{ending}"))
    sides = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    assert np.unique(sides, axis=0, return_counts=True)[1].max() == 1
    assert np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)[1].max() == 2


def test_normals_point_to_the_unstable_side(case):
    """VTK's own normals, at the vertices away from the rim and the faces of the box."""
    bicycle, box, scale, _, folder = case
    surface = pyvista.read(folder / "region.vtp")
    triangles, upper = triangles_of(surface), surface.cell_data["upper"] == 1
    shared = np.intersect1d(triangles[upper], triangles[~upper])
    surface = surface.compute_normals(
        cell_normals=False, consistent_normals=False, auto_orient_normals=False, split_vertices=False
    )
    real = surface.points / scale
    away = np.setdiff1d(np.arange(len(real)), shared)
    away = away[np.all((real[away] > box[:, 0]) & (real[away] < box[:, 1]), axis=1)]
    step = 1e-6 * surface.point_normals[away] / scale
    outside, inside = (
        eigenvalues(bicycle, (real[away] + sign * step).T).real.max(axis=1) for sign in (1, -1)
    )
    assert len(away) > 200
    assert np.mean(outside > 0) > 0.99  # the others are next to the rim, in a fold thinner than the step
    assert np.mean(inside < 0) > 0.99


def test_the_rim_is_on_a_closing_curve(case):
    """Where upper and lower triangles share a vertex, an interval closes: V1 = V2."""
    bicycle, box, scale, _, folder = case
    surface = pyvista.read(folder / "region.vtp")
    triangles, upper = triangles_of(surface), surface.cell_data["upper"] == 1
    shared = np.intersect1d(triangles[upper], triangles[~upper])
    assert len(shared) > 40
    lam, sigma, V = rim = (surface.points[shared] / scale).T
    found = intervals_of(characteristic_table(bicycle, lam, sigma))
    near = (np.abs(found.V1 - V[:, np.newaxis]) < 1e-4) & (np.abs(found.V2 - V[:, np.newaxis]) < 1e-4)
    assert np.where(near, found.V2 - found.V1, 0).max() < 1e-6  # rounding may leave an interval, a tiny one
    curves = [curve for curve in trace(Family(bicycle), *box, samples=321) if curve.closes]
    for point in rim.T:
        gaps = []
        for curve in curves:
            line = np.array([curve.x, curve.y])
            a, d = line[:, :-1], np.diff(line, axis=1)
            w = point[:2, np.newaxis] - a
            t = np.clip((w * d).sum(axis=0) / np.maximum((d * d).sum(axis=0), 1e-300), 0, 1)
            gaps.append(np.hypot(*(w - t * d)).min())
        assert min(gaps) < 5e-5  # of the chords between the curve's points


def test_ply_has_double_precision_and_colours(case):
    *_, mesh, folder = case
    content = (folder / "region.ply").read_bytes()
    header, body = content.split(b"end_header\n", 1)
    lines = header.decode("ascii").splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    assert "comment bicycle: ?mega bike" in lines
    vertex = np.dtype([("x", "<f8", 3), ("growth_rate", "<f8"), ("rgb", "u1", 3)])
    face = np.dtype([("n", "u1"), ("i", "<i4", 3)])
    n, m = len(mesh.points), len(mesh.triangles)
    vertices = np.frombuffer(body, vertex, n)
    faces = np.frombuffer(body, face, m, n * vertex.itemsize)
    assert len(body) == n * vertex.itemsize + m * face.itemsize
    vtk = pyvista.read(folder / "region.vtp")
    np.testing.assert_array_equal(vertices["x"], vtk.points)
    np.testing.assert_array_equal(vertices["growth_rate"], mesh.decay)
    # the faces are in the order that a comment tells
    (told,) = (line for line in lines if line.startswith("comment faces: "))
    start = 0
    for part in told.removeprefix("comment faces: ").split(", "):
        number, kind, end = part.split()
        own = (mesh.kind == KINDS.index(kind)) & (mesh.upper == (end == "upper"))
        np.testing.assert_array_equal(faces["i"][start : start + int(number)], mesh.triangles[own])
        start += int(number)
    assert start == m

    read = pyvista.read(folder / "region.ply")  # VTK takes coordinates to single precision
    np.testing.assert_allclose(read.points, vtk.points, rtol=1e-6, atol=1e-6)
    np.testing.assert_array_equal(read.regular_faces, faces["i"])
    colours = np.where(mesh.kind[:, np.newaxis] == WEAVE, (0, 114, 178), (230, 159, 0))
    shared = np.intersect1d(mesh.triangles[mesh.kind == WEAVE], mesh.triangles[mesh.kind == CAPSIZE])
    own = ~np.isin(mesh.triangles, shared).any(axis=1)
    np.testing.assert_array_equal(read.point_data["RGB"][mesh.triangles[own, 0]], colours[own])


def test_meshio_reads_what_vtk_does(case):
    *_, mesh, folder = case
    vtk = pyvista.read(folder / "region.vtp")
    grid = meshio.read(folder / "region.vtu")
    np.testing.assert_array_equal(grid.points, vtk.points)
    np.testing.assert_array_equal(grid.cells_dict["triangle"], mesh.triangles)
    for name in ("lam", "sigma", "V", "growth_rate"):
        np.testing.assert_array_equal(grid.point_data[name], vtk.point_data[name])
    for name in ("kind", "upper"):
        np.testing.assert_array_equal(grid.cell_data[name][0], vtk.cell_data[name])
    np.testing.assert_array_equal(grid.field_data["scale"], vtk.field_data["scale"])
    assert "  bicycle: ?mega bike" in (folder / "region.vtu").read_text().splitlines()
    ply = meshio.read(folder / "region.ply")
    np.testing.assert_array_equal(ply.points, vtk.points)
    np.testing.assert_array_equal(
        np.sort(ply.cells_dict["triangle"], axis=0), np.sort(mesh.triangles, axis=0)
    )
    np.testing.assert_array_equal(ply.point_data["growth_rate"], mesh.decay)
    assert set(ply.point_data["blue"]) <= {178, 0}
    stl = meshio.read(folder / "region.stl")
    assert len(stl.cells_dict["triangle"]) == len(mesh.triangles)


@pytest.mark.filterwarnings("ignore:.meshio. loading is deprecated")  # trimesh's of itself, for .vtu
@pytest.mark.parametrize("ending", [".ply", ".vtu", ".stl"])
def test_trimesh_finds_one_orientation(case, ending):
    *_, mesh, folder = case
    read = trimesh.load(folder / f"region{ending}", process=False)
    read = read if isinstance(read, trimesh.Trimesh) else read.to_mesh()
    assert len(read.faces) == len(mesh.triangles)
    if ending != ".stl":
        np.testing.assert_array_equal(read.vertices, pyvista.read(folder / "region.vtp").points)
        assert read.is_winding_consistent


def test_stl_has_facets_and_their_normals(case):
    *_, mesh, folder = case
    content = (folder / "region.stl").read_bytes()
    assert content.startswith(b"bikestab: x = ")
    facet = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
    facets = np.frombuffer(content, facet, offset=84)
    assert len(facets) == len(mesh.triangles) == int.from_bytes(content[80:84], "little")
    vtk = pyvista.read(folder / "region.vtp")
    np.testing.assert_array_equal(facets["corners"], vtk.points[mesh.triangles].astype(np.float32))
    large = vtk.compute_cell_sizes()["Area"] > 1e-6
    normals = vtk.compute_normals(
        point_normals=False, consistent_normals=False, auto_orient_normals=False
    ).cell_normals
    np.testing.assert_allclose(facets["normal"][large], normals[large], atol=1e-5)
    assert pyvista.read(folder / "region.stl").n_cells == len(mesh.triangles)


def test_scale():
    np.testing.assert_array_equal(readable_scale([0, 0, 0], [0.3, 0.15, 10]), [50, 50, 1])
    np.testing.assert_array_equal(readable_scale([0.1, -0.1, 2], [0.4, 0.4, 60]), [50, 20, 0.2])
    assert readable_scale([0], [0.06])[0] == 200
    lengths = np.geomspace(1e-4, 1e4, 333)
    scaled = readable_scale(0 * lengths, lengths) * lengths
    assert scaled.min() > 10 / math.sqrt(2.5) - 1e-9
    assert scaled.max() < 10 * math.sqrt(2.5) + 1e-9


def test_the_same_mesh_gives_the_same_bytes(case, tmp_path):
    _, _, scale, mesh, folder = case
    for ending in MESHES:
        save_mesh(mesh, tmp_path / f"again{ending}", scale, ABOUT)
        assert (tmp_path / f"again{ending}").read_bytes() == (folder / f"region{ending}").read_bytes()


# --- tables


@pytest.fixture(scope="module")
def volume(tmp_path_factory):
    text = SCAN.replace("OUT", str(tmp_path_factory.mktemp("volume")))
    with Volume(run_scan(parse_config(yamltext.parse(text, "scan.yaml"))).path) as opened:
        yield opened


def read_csv(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def as_text(value):
    """A Parquet value as CSV has it."""
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)


def test_intervals_are_those_of_every_design(volume, tmp_path):
    save_table(INTERVALS, interval_blocks(volume), tmp_path / "i.csv", ABOUT)
    rows = read_csv(tmp_path / "i.csv")
    bicycle = volume.bicycle
    expected = []
    for lam in volume.axis("lam"):
        for sigma in volume.axis("sigma"):
            found = intervals_of(exact_table(bicycle, lam, sigma))
            expected.extend(
                [
                    lam, sigma, k + 1, found.V1[k], found.V2[k], found.V1_error[k], found.V2_error[k],
                    KINDS[found.lower[k]], KINDS[found.upper[k]], "",
                ]
                for k in range(found.number)
            )  # fmt: skip
    names = ("lam", "sigma", "interval", "V1", "V2", "V1_error", "V2_error")
    got = [
        [*(float(row[name]) for name in names), row["lower"], row["upper"], row["marginal"]] for row in rows
    ]
    assert got == expected  # to the last digit
    assert {row["interval"] for row in rows} == {"1", "2"}
    assert {row["V2"] for row in rows if row["upper"] == "unbounded"} == {"inf"}
    designs = {(row["lam"], row["sigma"]) for row in rows}
    assert 4 < len(designs) < 24  # those without stable speed are left out
    for row in rows:
        assert float(row["head_angle_deg"]) == pytest.approx(90 - math.degrees(float(row["lam"])), abs=1e-12)
        assert float(row["trail"]) == float(row["sigma"]) * bicycle.c


def test_parquet_holds_the_same(volume, tmp_path):
    save_table(INTERVALS, interval_blocks(volume), tmp_path / "i.csv", ABOUT)
    save_table(INTERVALS, interval_blocks(volume), tmp_path / "i.parquet", ABOUT)
    table = parquet.read_table(tmp_path / "i.parquet")
    assert table.column_names == list(INTERVALS)
    assert [str(kind) for kind in table.schema.types] == [
        *["double"] * 5, "int32", "double", "double", "string", "string", "double", "double", "string",
    ]  # fmt: skip
    assert math.inf in table["V2"].to_pylist()
    assert [{k: as_text(v) for k, v in row.items()} for row in table.to_pylist()] == read_csv(
        tmp_path / "i.csv"
    )
    assert table.schema.metadata[b"model"] == b"refined"
    assert table.schema.field("V1").metadata == {b"unit": b"m/s"}


def test_the_volume_is_read_in_layers(volume, tmp_path, monkeypatch):
    save_table(INTERVALS, interval_blocks(volume), tmp_path / "whole.csv", ABOUT)
    monkeypatch.setattr(tables, "_LAYER", 4)
    monkeypatch.setattr(tables, "_ROWS", 3)
    largest = []
    read = Volume.read

    def spy(self, name, where=()):
        values = read(self, name, where)
        largest.append(values.shape[0])
        return values

    monkeypatch.setattr(Volume, "read", spy)
    for ending in (".csv", ".parquet"):
        save_table(INTERVALS, interval_blocks(volume), tmp_path / f"layers{ending}", ABOUT)
    assert (tmp_path / "layers.csv").read_bytes() == (tmp_path / "whole.csv").read_bytes()
    assert parquet.ParquetFile(tmp_path / "layers.parquet").num_row_groups == 2
    assert largest == 2 * [
        6,
        4,
        *[4] * 9,
        *[2] * 9,
    ]  # λ, σ; V1, V2, each with upper, lower, upper and the bounds in two layers


def test_a_volume_of_an_earlier_build_has_no_bounds(tmp_path):
    with Volume(Path(__file__).parents[1] / "references" / "volumes" / "damped.h5") as volume:
        save_table(INTERVALS, interval_blocks(volume), tmp_path / "i.csv", ABOUT)
        number = np.count_nonzero(volume.read("upper"))
    rows = read_csv(tmp_path / "i.csv")
    assert len(rows) == number > 50
    assert {(row["V1_error"], row["V2_error"], row["marginal"]) for row in rows} == {("", "", "")}


def test_skeleton_is_every_point_of_every_curve(tmp_path):
    bicycle = Bicycle.preset("dikarev1981")
    curves = trace(Family(bicycle), (0.0, 0.3), (0.0, 0.3), samples=41)
    curves.append(
        Curve("singular inertia", np.array([0.1, 0.2]), np.array([0.1, 0.1]), np.array([np.nan, 2]), False,
              ("box", "fold"))
    )  # fmt: skip
    for ending in (".csv", ".parquet"):
        save_table(SKELETON, skeleton_blocks(curves, Family(bicycle)), tmp_path / f"s{ending}", ABOUT)
    rows = read_csv(tmp_path / "s.csv")
    table = parquet.read_table(tmp_path / "s.parquet")
    assert [{k: as_text(v) for k, v in row.items()} for row in table.to_pylist()] == rows
    for number, curve in enumerate(curves, 1):
        own = [row for row in rows if row["curve"] == str(number)]
        assert [int(row["point"]) for row in own] == list(range(1, len(curve.x) + 1))
        for name, values in (("lam", curve.x), ("sigma", curve.y), ("V", curve.V)):
            got = [float(row[name] or "nan") for row in own]
            np.testing.assert_array_equal(got, values)
        words = {(row["name"], row["closes"], row["start"], row["end"]) for row in own}
        assert words == {(curve.name, str(curve.closes).lower(), *curve.ends)}
    assert "inf" in {row["V"] for row in rows}
    assert rows[-2]["V"] == ""


def test_empty_tables_have_a_head(tmp_path):
    for ending in (".csv", ".parquet"):
        save_table(
            SKELETON,
            skeleton_blocks([], Family(Bicycle.preset("dikarev1981"))),
            tmp_path / f"s{ending}",
            ABOUT,
        )
    assert (tmp_path / "s.csv").read_text() == ",".join(SKELETON) + "\n"
    table = parquet.read_table(tmp_path / "s.parquet")
    assert (table.num_rows, table.column_names) == (0, list(SKELETON))


# --- formats


def test_known_endings():
    assert [file_format(f"a/b.c{ending.upper()}", MESHES) for ending in MESHES] == list(MESHES)


@pytest.mark.parametrize(
    ("name", "problem", "hint"),
    [
        ("region", "has no ending", "it chooses the format: .vtp, .vtu, .ply, .stl"),
        ("region.vt", "no format '.vt' for this; known: .vtp, .vtu, .ply, .stl", "did you mean '.vt"),
        ("region.blend", "no format '.blend' for this; known: .vtp, .vtu, .ply, .stl", ""),
    ],
)
def test_unknown_endings(name, problem, hint):
    with pytest.raises(InputError) as caught:
        file_format(name, MESHES)
    assert problem in caught.value.problem
    assert caught.value.hint.startswith(hint)
    assert bool(caught.value.hint) == bool(hint)
