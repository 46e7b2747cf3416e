"""The mesh of the boundary: on the surface, closed, oriented, and stable on one side."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import characteristic_table
from bikestab.region.curves import trace
from bikestab.region.events import Box
from bikestab.region.mesh import region_mesh
from bikestab.routh import condition, conditions, stable
from bikestab.speeds import CAPSIZE, WEAVE, critical_speeds, intervals_of
from tests.meshes import away_from_surface, away_of, open_edges
from tests.references.verify_meshes import pairs
from tests.strategies import machines

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
CASES = {
    "1981": (DIKAREV, (0.0, 0.3), (0.0, 0.15), (0.0, 15.0)),
    "1981 unbounded": (DIKAREV, (0.0, 0.2), (0.05, 0.3), (1.0, 20.0)),
    "1981 damped": (DIKAREV.with_delta(1.0), (0.0, 0.3), (0.0, 0.15), (0.0, 15.0)),
    "2007": (MEIJAARD, (0.0, 0.6), (0.0, 0.5), (0.0, 15.0)),
    "2007 damped": (MEIJAARD.with_delta(1.0), (0.0, 0.6), (0.0, 0.5), (1.0, 20.0)),
    "1981 capsize below": (DIKAREV, (0.0, 0.045), (0.13, 0.16), (2.0, 4.5)),
}


def family_case(name):
    bicycle, *ends = CASES[name]
    return Family(bicycle), *ends


@pytest.fixture(scope="module", params=CASES)
def case(request):
    bicycle, *ends = CASES[request.param]
    return bicycle, ends, region_mesh(Family(bicycle), *ends, cells=40)


def eigenvalues(bicycle, points):
    """Of every point (point, 3), from the companion matrix of numpy's own making."""
    lam, sigma, V = points.T
    p = np.array(
        [sum(c * V**j for j, c in enumerate(row)) for row in characteristic_table(bicycle, lam, sigma)]
    )
    matrix = np.zeros((len(V), 4, 4))
    matrix[:, 0] = (-p[3::-1] / p[4]).T
    matrix[:, [1, 2, 3], [0, 1, 2]] = 1
    return np.linalg.eigvals(matrix)


def test_every_point_is_on_its_surface(case):
    """|f| / |∇f| in units of the box: the distance from the zero of the condition."""
    bicycle, ends, mesh = case
    size = np.ptp(ends, axis=1)
    for kind, name in ((WEAVE, "hurwitz3"), (CAPSIZE, "p0")):
        points = mesh.points[np.unique(mesh.triangles[mesh.kind == kind])]

        def value(points, name=name):
            table = characteristic_table(bicycle, points[:, 0], points[:, 1])
            return getattr(conditions(table, points[:, 2]), name)

        h = 1e-5 * np.diag(size)
        slope = np.array([(value(points + e) - value(points - e)) / 2e-5 for e in h])
        assert np.abs(value(points) / np.linalg.norm(slope, axis=0)).max(initial=0) < 1e-9


def test_eigenvalues_are_where_the_kind_says(case):
    """Capsize has an eigenvalue zero, weave a pair on the imaginary axis; nothing is further to the right."""
    bicycle, _, mesh = case
    for kind in (WEAVE, CAPSIZE):
        points = mesh.points[np.unique(mesh.triangles[mesh.kind == kind])]
        s = eigenvalues(bicycle, points[:: max(len(points) // 500, 1)])
        size = np.abs(s).max(axis=1)
        nearest = np.abs(s.real if kind == WEAVE else s).min(axis=1)
        # two eigenvalues meet at zero where weave starts at capsize: there rounding's square root is left
        assert np.quantile(nearest / size, 0.8) < 1e-9
        assert (nearest / size).max() < 1e-5
        assert (s.real.max(axis=1) / size).max() < 1e-5


def test_no_holes_and_no_ragged_edge(case):
    bicycle, ends, mesh = case
    assert open_edges(mesh, ends) == 0
    assert len(mesh.open_edges(Box(Family(bicycle), np.array(ends[:2]), ends[2]))) == 0
    assert np.all(mesh.wall <= ~mesh.upper)
    for end, axis in zip(np.array(ends).T, (mesh.points.min(axis=0), mesh.points.max(axis=0)), strict=True):
        assert np.all(axis >= np.array(ends)[:, 0])
        assert np.all(axis <= np.array(ends)[:, 1]), end


def test_a_torn_mesh_is_noticed(case):
    bicycle, ends, mesh = case
    torn = mesh._replace(triangles=np.delete(mesh.triangles, len(mesh.triangles) // 2, axis=0))
    assert len(torn.open_edges(Box(Family(bicycle), np.array(ends[:2]), ends[2]))) >= 1


def test_the_outside_is_unstable(case):
    """Upwards from an upper sheet, downwards from a lower one, which is where the corners' order points."""
    bicycle, ends, mesh = case
    a, b, c = mesh.points[mesh.triangles].swapaxes(0, 1)
    # but for triangles that are as narrow as their corners are rounded
    rounding = np.finfo(float).eps * np.prod(np.ptp(ends[:2], axis=1))
    assert np.all(np.cross(b - a, c - a)[:, 2] * np.where(mesh.upper, 1, -1) >= -rounding)
    for outwards in (1, -1):
        shared = np.intersect1d(mesh.triangles[mesh.upper], mesh.triangles[~mesh.upper])
        points = mesh.points[np.setdiff1d(mesh.triangles[mesh.upper == (outwards > 0)], shared)]
        points = points[(points[:, 2] > ends[2][0]) & (points[:, 2] < ends[2][1])]
        table = characteristic_table(bicycle, points[:, 0], points[:, 1])
        step = 1e-7 * outwards
        assert np.mean(stable(table, points[:, 2] - step)) > 0.99  # but for what is thinner than the step
        assert not stable(table, points[:, 2] + step).any()


def test_sheets_are_the_ends_of_the_intervals(case):
    """Points off the curves: V is V1 or V2 of that design to the last digit."""
    bicycle, ends, mesh = case
    shared = np.intersect1d(mesh.triangles[mesh.upper], mesh.triangles[~mesh.upper])
    for upper in (False, True):
        # a wall reaches from one end of an interval to the other: its corners are of both sheets
        index = np.setdiff1d(mesh.triangles[(mesh.upper == upper) & ~mesh.wall], shared)
        points = mesh.points[index]
        points = points[np.all((points > np.array(ends)[:, 0]) & (points < np.array(ends)[:, 1]), axis=1)]
        found = intervals_of(Family(bicycle).table(points[:, 0], points[:, 1]))
        gap = np.nanmin(np.abs((found.V2 if upper else found.V1) - points[:, 2:]), axis=1)
        assert np.mean(gap == 0) > 0.9  # the others are on a curve where two sheets change places
        # or where an interval has just closed: there both conditions are zero
        both = np.max([away_of(Family(bicycle), ends, points, name) for name in ("p0", "hurwitz3")], axis=0)
        assert gap[both > 1e-14].max() < 1e-6


def test_the_rim_is_the_skeleton(case):
    bicycle, ends, mesh = case
    # but for walls, which share their upper corners with an upper sheet and stand on other curves as well
    shared = np.intersect1d(mesh.triangles[mesh.upper], mesh.triangles[~mesh.upper & ~mesh.wall])
    rim = mesh.points[shared]
    curves = [
        c for c in trace(Family(bicycle), *ends, samples=321) if c.name in ("fold", "weave meets capsize")
    ]
    for point in rim[:: max(len(rim) // 40, 1)]:
        gaps = []
        for curve in curves:
            a = np.array([curve.x[:-1], curve.y[:-1]])
            d = np.array([curve.x[1:], curve.y[1:]]) - a
            w = point[:2, None] - a
            t = np.clip((w * d).sum(axis=0) / np.maximum((d * d).sum(axis=0), 1e-300), 0, 1)
            gaps.append(np.hypot(*(w - t * d)).min())
        assert min(gaps) < 5e-5  # of the chords between the curve's points


def test_decay_is_the_lowest_growth_rate_of_the_interval(case):
    bicycle, ends, mesh = case
    assert np.all(mesh.decay <= 0)
    assert mesh.decay.min() < -0.01
    shared = np.intersect1d(mesh.triangles[mesh.upper], mesh.triangles[~mesh.upper])
    single = np.setdiff1d(mesh.triangles[mesh.upper], shared)[::97]
    for lam, sigma, V2 in mesh.points[single]:
        found = intervals_of(Family(bicycle).table(lam, sigma))
        k = int(np.nanargmin(np.abs(found.V2 - V2)))
        V = np.linspace(max(found.V1[k], ends[2][0]), V2, 33)
        lowest = eigenvalues(bicycle, np.column_stack([np.full_like(V, lam), np.full_like(V, sigma), V]))
        i = np.flatnonzero(np.all(mesh.points == [lam, sigma, V2], axis=1))[0]
        assert mesh.decay[i] == pytest.approx(lowest.real.max(axis=1).min(), abs=1e-6)


def test_an_empty_box():
    mesh = region_mesh(Family(DIKAREV), (0.0, 0.1), (0.0, 0.05), (0.0, 10.0), cells=20)
    assert mesh.points.shape == (0, 3)
    assert mesh.triangles.shape == (0, 3)
    assert len(mesh.kind) == len(mesh.upper) == len(mesh.decay) == 0


def test_a_vertical_wall():
    """Where p0 does not depend on the speed, capsize starts at all speeds at once, from weave upwards."""
    box = (0.0, 0.3), (0.0, 0.15), (0.0, 10.0)
    skates = Bicycle.preset("kooijman2011")
    mesh = region_mesh(Family(skates), *box, cells=20)
    assert open_edges(mesh, box) == 0
    assert away_from_surface(Family(skates), box, mesh) < 1e-9
    wall = mesh.triangles[mesh.wall]
    assert len(wall) > 40
    assert set(mesh.kind[mesh.wall]) == {CAPSIZE}
    assert not mesh.upper[mesh.wall].any()
    lam, sigma, V = mesh.points[np.unique(wall)].T
    assert V.max() == 10.0
    weave = critical_speeds(characteristic_table(skates, lam[V < 10], sigma[V < 10]))["hurwitz3"]
    assert np.nanmin(np.abs(weave / V[V < 10] - 1), axis=0).max() < 1e-9
    p0 = condition(characteristic_table(skates, lam, sigma), "p0", 5.0)
    assert np.abs(p0).max() < 1e-13
    a, b, c = mesh.points[wall].swapaxes(0, 1)
    outwards = np.cross(b - a, c - a)
    np.testing.assert_array_equal(outwards[:, 2], 0)
    middle = mesh.points[wall].mean(axis=1)
    step = 1e-3 * outwards / np.linalg.norm(outwards, axis=1, keepdims=True)
    for way, expected in ((1, False), (-1, True)):
        lam, sigma, V = (middle + way * step).T
        assert np.all(stable(characteristic_table(skates, lam, sigma), V) == expected)


def test_both_kinds_are_there():
    mesh = region_mesh(*family_case("1981 unbounded"), cells=30)
    assert set(mesh.kind[~mesh.wall]) == {WEAVE, CAPSIZE}
    # walls stand on the weave surface where it folds back within a cell
    assert set(mesh.kind[mesh.wall]) <= {WEAVE}
    top = mesh.points[:, 2] == 20.0
    assert top.any()
    assert not np.any(np.isinf(mesh.points))


def test_four_structures_meet_at_a_point():
    """Where weave leaves through one face of the box, and capsize just there through the other one."""
    family, ends = next(islice(pairs(200, seed=1), 199, None))
    mesh = region_mesh(family, *ends, cells=20)
    assert len(mesh.triangles) > 1000
    assert open_edges(mesh, ends) == 0
    assert away_from_surface(family, ends, mesh) < 1e-9


@pytest.mark.parametrize("number", [30, 206])
def test_surfaces_meet_at_a_face(number):
    """Stripes narrower than a cell between weave and capsize, both of which leave through faces of the box.

    Number 206 has a wedge of two intervals that meets one of them.
    """
    family, ends = next(islice(pairs(320, seed=1), number, None))
    mesh = region_mesh(family, *ends, cells=20)
    assert len(mesh.triangles) > 300
    assert open_edges(mesh, ends) == 0
    assert away_from_surface(family, ends, mesh) < 1e-9


def test_an_interval_that_closes_at_two_corners_of_a_sliver():
    """Three structures meet in it, and over its third corner the interval is a metre per second wide.

    The triangle was then taken for one without intervals, and walls went through the stable region.
    """
    family, ends = next(islice(pairs(320, seed=1), 78, None))
    mesh = region_mesh(family, *ends, cells=20)
    assert len(mesh.triangles) > 900  # it is not empty: curves with a point at each line of a grid gave 1034
    assert open_edges(mesh, ends) == 0
    assert away_from_surface(family, ends, mesh) < 1e-9


def test_a_long_sliver_beside_a_steep_surface():
    """Ends over its corners are further apart than elsewhere; it then got a corner of no surface."""
    family, ends = next(islice(pairs(320, seed=2), 66, None))
    mesh = region_mesh(family, *ends, cells=20)
    assert len(mesh.triangles) > 1000
    assert open_edges(mesh, ends) == 0
    assert away_from_surface(family, ends, mesh) < 1e-9


def test_a_curve_that_turns_within_a_cell():
    """Its end was then looked for along the cell's chord, and found outside of the box."""
    family, ends = next(islice(pairs(320, seed=1), 280, None))
    mesh = region_mesh(family, *ends, cells=100)
    assert open_edges(mesh, ends) == 0
    assert away_from_surface(family, ends, mesh) < 1e-9


def test_more_cells_make_a_finer_mesh():
    sizes = [len(region_mesh(*family_case("2007"), cells=n).triangles) for n in (20, 40)]
    assert 3 < sizes[1] / sizes[0] < 5


@pytest.mark.parametrize("delta", [0.0, 1e-9, 1e-3, 1.0, 2.0])
@pytest.mark.parametrize("name", ["dikarev1981", "kooijman2011", "sharp1971"])
def test_presets_with_any_damping(name, delta):
    family, ends = Family(Bicycle.preset(name).with_delta(delta)), ((0.0, 0.3), (0.0, 0.15), (0.0, 15.0))
    mesh = region_mesh(family, *ends, cells=20)
    assert open_edges(mesh, ends) == 0
    assert away_from_surface(family, ends, mesh) < 1e-9


FAMILIES = {
    ("lam", "delta"): (Family(MEIJAARD, x="lam", y="delta"), ((0.1, 0.5), (0.0, 3.0), (0.0, 12.0))),
    ("mB", "xB"): (Family(MEIJAARD, x="mB", y="xB"), ((10.0, 120.0), (0.0, 0.8), (0.0, 12.0))),
}


@pytest.mark.parametrize("axes", FAMILIES)
def test_other_planes_of_designs(axes):
    """As the dense ends of the intervals say, and closed."""
    family, ends = FAMILIES[axes]
    mesh = region_mesh(family, *ends, cells=30)
    assert len(mesh.triangles) > 500
    assert open_edges(mesh, ends) == 0
    assert away_from_surface(family, ends, mesh) < 1e-9
    a, b, c = mesh.points[mesh.triangles].swapaxes(0, 1)
    area = np.cross(b - a, c - a)[:, 2] / 2  # Gauss: the faces V = 0 and V = 12 add nothing to this
    volume = np.sum(area * ((a + b + c)[:, 2] / 3 - ends[2][1]))
    x, y = ((np.arange(200) + 0.5) / 200 * np.ptp(end) + end[0] for end in ends[:2])
    found = intervals_of(family.table(x[:, np.newaxis], y))
    width = np.nansum(np.clip(found.V2, *ends[2]) - np.clip(found.V1, *ends[2]), axis=-1)
    assert volume == pytest.approx(width.mean() * np.prod(np.ptp(ends[:2], axis=1)), rel=2e-3)


@settings(max_examples=6, deadline=None, derandomize=True)  # verify_meshes tries new ones
@given(machines)
def test_random_machines(machine):
    """No mesh is refused."""
    family = Family(Bicycle.from_mapping(machine))
    ends = (0.0, 0.6), (0.0, 0.3), (0.5, 20.0)
    mesh = region_mesh(family, *ends, cells=25)
    assert open_edges(mesh, ends) == 0
    assert np.isfinite(mesh.points).all()
    assert away_from_surface(family, ends, mesh) < 1e-9
