"""Exact roots in sheets: all of them, continuous where the surface is, and the edges marked."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.routh import CONDITIONS, condition_polynomials
from bikestab.scan.links import SPEED
from bikestab.scan.sheets import Roots, critical_roots, sheets
from bikestab.speeds import CAPSIZE, WEAVE, Intervals, critical_speeds, intervals_of
from tests.strategies import machines

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
MACHINES = [DIKAREV, MEIJAARD, DIKAREV.with_delta(2.0), MEIJAARD.with_delta(1.0)]
IDS = ["1981", "2007", "1981 damped", "2007 damped"]


def plane(bicycle, n=41, lam=0.3, sigma=0.15):
    """λ, σ, and the table of their pairs."""
    lam, sigma = np.linspace(0, lam, n), np.linspace(0, sigma, n + 1)
    return lam, sigma, characteristic_table(bicycle, lam[:, np.newaxis], sigma)


def sheets_of(table):
    intervals = intervals_of(table)
    return {name: sheets(name, roots, intervals) for name, roots in critical_roots(table).items()}


def no_intervals(shape):
    return Intervals(*(np.full((*shape, 1), fill) for fill in (np.nan, np.nan, 0, 0, np.nan, np.nan, 0)))


def place(V):
    """Where a speed is between rest (0) and infinity (1)."""
    return V / (V + SPEED)


def largest_jump(V):
    return max(np.nanmax(np.abs(np.diff(V, axis=axis)), initial=0) for axis in (0, 1))


# --- every root, once, in a slot of its direction


def assert_complete(table, found):
    polynomials = condition_polynomials(table)
    for name, exact in critical_speeds(table).items():
        V = found[name].V
        expected = np.moveaxis(exact, 0, -1)
        padding = [(0, 0), (0, 0), (0, V.shape[-1] - expected.shape[-1])]
        np.testing.assert_array_equal(np.sort(V, axis=-1), np.pad(expected, padding, constant_values=np.nan))
        terms = [c[..., np.newaxis] * V**j for j, c in enumerate(polynomials[name])]
        slope, size = sum(j * t for j, t in enumerate(terms)), sum(map(np.abs, terms))
        sure = np.abs(slope) > 1e-9 * size  # not too close to a fold; False for NaN
        for k in range(V.shape[-1]):
            assert len(np.unique(np.sign(slope[..., k][sure[..., k]]))) <= 1


@pytest.mark.parametrize("bicycle", MACHINES, ids=IDS)
def test_every_root_is_in_a_slot_of_its_direction(bicycle):
    table = plane(bicycle)[2]
    found = sheets_of(table)
    assert_complete(table, found)
    means = np.nanmean(place(found["hurwitz3"].V), axis=(0, 1))
    assert len(means) == (2 if bicycle.delta == 0 else 3)
    assert np.all(np.diff(means) > 0)


def test_without_roots_there_are_no_slots():
    found = sheets_of(plane(DIKAREV)[2])
    assert found["p4"].V.shape == found["p4"].edge.shape == (41, 42, 0)


# --- continuity, against roots followed in small steps from cell to cell


def breaks(bicycle, name, lam, sigma, V, fine=128):
    """How many roots were followed to the next cell, and which arrive in another slot of V (λ, σ, slot).

    So does one whose sheet ends while its slot goes on, and the other way round; not counted are sheets
    that go below rest (V = 0) on the way and come back to less than 0.1 m/s, which is no jump. Followed
    are those of cells where something ends, or moves by over a fiftieth of the way from rest to infinity.
    """
    followed, wrong = 0, []
    f = np.linspace(0, 1, fine + 1)
    for di, dj in ((1, 0), (0, 1)):
        start, stop = V[: len(lam) - di, : len(sigma) - dj], V[di:, dj:]
        moved = np.abs(place(start) - place(stop)) > 0.02
        i, j = np.nonzero(np.any(moved | (np.isnan(start) != np.isnan(stop)), axis=-1))
        table = characteristic_table(
            bicycle,
            lam[i, np.newaxis] + f * (lam[i + di] - lam[i])[:, np.newaxis],
            sigma[j, np.newaxis] + f * (sigma[j + dj] - sigma[j])[:, np.newaxis],
        )
        roots = critical_roots(table)[name]  # (pair, step, root)
        rises = roots.rising ^ (np.arange(roots.V.shape[-1]) % 2 == 1)
        start, stop = start[i, j], stop[i, j]  # (pair, slot)
        first = np.argmin(
            np.abs(np.nan_to_num(roots.V[:, 0], nan=1e9)[:, np.newaxis] - start[..., np.newaxis]), -1
        )
        direction = np.take_along_axis(rises[:, 0], first, axis=-1)
        x, at_rest = place(start), np.zeros(start.shape, bool)
        for step in range(1, fine + 1):
            others = place(roots.V[:, step])
            far = np.abs(others[:, np.newaxis] - x[..., np.newaxis])
            far[(rises[:, step][:, np.newaxis] != direction[..., np.newaxis]) | np.isnan(far)] = np.inf
            nearest = np.argmin(far, axis=-1)
            new = np.where(far.min(axis=-1) < 0.05, np.take_along_axis(others, nearest, axis=-1), np.nan)
            at_rest |= np.isnan(new) & (x < 1e-3)
            x = new
        at_rest &= place(stop) < 0.02
        followed += np.count_nonzero(np.isfinite(start) & ~at_rest)
        right = np.where(np.isnan(x), np.isnan(stop), np.abs(place(stop) - x) < 1e-6)
        wrong += [
            (i[p], j[p], i[p] + di, j[p] + dj, k)
            for p, k in zip(*np.nonzero(np.isfinite(start) & ~right & ~at_rest), strict=True)
        ]
    return followed, wrong


DAMPED_LITTLE = DIKAREV.with_delta(0.1)


@pytest.mark.parametrize("name", ["p0", "hurwitz3"])
@pytest.mark.parametrize("bicycle", [*MACHINES, DAMPED_LITTLE], ids=[*IDS, "damped little"])
def test_a_slot_is_a_continuous_sheet(bicycle, name):
    lam, sigma, table = plane(bicycle)
    followed, wrong = breaks(bicycle, name, lam, sigma, sheets_of(table)[name].V)
    assert followed > 20
    assert wrong == []


@pytest.mark.parametrize("bicycle", [DIKAREV, MEIJAARD, DAMPED_LITTLE], ids=[*IDS[:2], "damped little"])
def test_ascending_roots_are_no_sheets(bicycle):
    """What the order of the roots would do in the same places; else the test above could not fail."""
    lam, sigma, table = plane(bicycle)
    _, wrong = breaks(bicycle, "hurwitz3", lam, sigma, critical_roots(table)["hurwitz3"].V)
    assert len(wrong) > 5


def test_damped_sheets_become_smooth_on_a_finer_grid():
    """In a quarter of the step the largest jump of a continuous surface is at most half (at a fold)."""
    jumps = [
        largest_jump(place(sheets_of(plane(DIKAREV.with_delta(2.0), n)[2])["hurwitz3"].V))
        for n in (21, 81, 321)
    ]
    assert jumps[0] < 0.2
    assert jumps[1] < 0.55 * jumps[0]
    assert jumps[2] < 0.55 * jumps[1]


# --- several roots of one direction


def test_a_pair_born_below_shifts_nothing():
    i, j = np.mgrid[:12, :10]
    upper = 8 + 0.05 * i + 0.02 * j  # there everywhere
    born = i + j > 10  # a rising and a falling root below it, in a part of the plane
    V = np.full((12, 10, 3), np.nan)
    V[..., 0] = upper
    V[born] = np.stack([3 - 0.05 * i, 3.5 + 0.05 * i, upper], axis=-1)[born]
    found = sheets("hurwitz3", Roots(V, np.ones((12, 10, 1), bool)), no_intervals((12, 10)))
    assert found.V.shape == (12, 10, 3)
    np.testing.assert_array_equal(found.V[..., 2], upper)  # the slots are in the order of their speeds
    np.testing.assert_array_equal(found.V[..., 0], np.where(born, 3 - 0.05 * i, np.nan))
    np.testing.assert_array_equal(found.V[..., 1], np.where(born, 3.5 + 0.05 * i, np.nan))
    assert largest_jump(found.V) < 0.06
    assert largest_jump(V) > 4  # the ascending order jumps from the upper sheet to the lower


def test_sheets_that_nowhere_meet_share_a_slot():
    V = np.full((9, 4, 3), np.nan)
    V[..., 0] = 9  # a rising one; above it a falling one everywhere, and lower pairs at either end
    V[..., 1] = 12
    V[:2, :, :] = V[6:, :, :] = [9, 12, 15]
    found = sheets("p1", Roots(V, np.ones((9, 4, 1), bool)), no_intervals((9, 4)))
    np.testing.assert_array_equal(found.V[0, 0], [9, 12, 15])
    np.testing.assert_array_equal(found.V, V)


def cusp(n=81):
    """p0 = (V − 5)³ + a (V − 5) + b: over a < 0 between two folds there are two rising roots."""
    a, b = np.linspace(-3, 3, n)[:, np.newaxis], np.linspace(-3, 3, n + 1)
    table = np.zeros((5, 4, n, n + 1))
    table[0] = -125 - 5 * a + b, 75 + a + 0 * b, -15 + 0 * a * b, 1 + 0 * a * b
    return table


def test_around_a_cusp_a_sheet_goes_on_in_another_slot_and_nothing_jumps():
    table = cusp()
    V = sheets_of(table)["p0"].V
    assert_complete(table, sheets_of(table))
    assert V.shape[-1] == 3
    lower, _, upper = np.moveaxis(V, -1, 0)
    both = np.isfinite(lower) & np.isfinite(upper)
    assert 500 < np.count_nonzero(both) < both.size / 3
    assert np.all(lower[both] < upper[both])
    assert np.all(np.isfinite(lower) | np.isfinite(upper))
    # u³ = −b is the steepest: 2 (h/2)^(1/3) from −h/2 to h/2
    steepest = 2 * (3 / 81) ** (1 / 3) * (1 + 1e-12)  # the table's own entries are rounded
    assert largest_jump(V) < steepest
    assert largest_jump(critical_roots(table)["p0"].V) > 1.5  # at a fold, from one layer to the other
    # the cut is in front of the cusp, where a > 0
    cut = np.diff(np.isfinite(lower) & ~both, axis=1) & np.diff(np.isfinite(upper) & ~both, axis=1)
    assert np.all(np.count_nonzero(cut, axis=1)[42:] == 1)
    assert not np.any(cut[:38])


def test_a_spiral_is_cut_along_one_line():
    """Around the middle each rising root becomes the next higher one: layers that lie over themselves."""
    y, x = np.mgrid[-8:9, -8:9] + 0.25
    turn = np.arctan2(y, x) / (2 * np.pi)
    V = 10 + 3 * turn[..., np.newaxis] + np.arange(5) * 1.5  # rising, falling, …: three rising, 3 m/s apart
    V[np.hypot(x, y) < 3] = np.nan
    found = sheets("p2", Roots(V, np.ones((17, 17, 1), bool)), no_intervals((17, 17))).V
    np.testing.assert_array_equal(np.sort(found, axis=-1)[..., :5], V)
    jump = np.abs(np.diff(found, axis=0)) > 0.4
    seam = (y[:-1] < 0) & (y[1:] > 0) & (x[1:] < 0)  # where the turn goes from 1/2 to −1/2
    assert jump.any()  # three layers that fill their slots all around cannot but jump somewhere
    assert not jump[~seam].any()
    assert np.nanmax(np.abs(np.diff(found, axis=1))) < 0.4


@settings(max_examples=40, deadline=None)
@given(machines)
def test_random_machines(machine):
    """Against a search by hand: partners are each other's nearest, and all of a sheet are in one slot."""
    table = plane(Bicycle.from_mapping(machine), 7, 0.9, 0.5)[2]
    found = sheets_of(table)
    assert_complete(table, found)
    for name, (V, rising) in critical_roots(table).items():
        assert_slots_are_connected(V, rising[..., 0], found[name].V)


@pytest.mark.parametrize("delta", [0.01, 0.1, 0.3, 1.0])
@pytest.mark.parametrize("bicycle", [DIKAREV, MEIJAARD], ids=IDS[:2])
def test_coarse_grids(bicycle, delta):
    table = plane(bicycle.with_delta(delta), 13, 1.2, 0.6)[2]
    found = sheets_of(table)
    assert_complete(table, found)
    V, rising = critical_roots(table)["hurwitz3"]
    assert_slots_are_connected(V, rising[..., 0], found["hurwitz3"].V)


def assert_slots_are_connected(V, rising, arranged):
    n, m, _ = V.shape
    slot = {(i, j, v): k for (i, j, k), v in np.ndenumerate(arranged) if np.isfinite(v)}
    up = {(i, j, v): rising[i, j] ^ (k % 2 == 1) for (i, j, k), v in np.ndenumerate(V) if np.isfinite(v)}
    parent = {root: root for root in slot}

    def sheet(root):
        while parent[root] != root:
            root = parent[root]
        return root

    def nearest(root, cell):
        others = [r for r in up if r[:2] == cell and up[r] == up[root]]
        return min(others, key=lambda r: abs(place(r[2]) - place(root[2])), default=None)

    cells = {(i, j): [r for r in up if r[:2] == (i, j)] for i in range(n) for j in range(m)}
    pairs = [(a, b) for a in cells for b in ((a[0] + 1, a[1]), (a[0], a[1] + 1)) if b in cells]
    for a, b in pairs:
        for root in cells[a]:
            partner = nearest(root, b)
            if partner is not None and nearest(partner, a) == root:
                parent[sheet(partner)] = sheet(root)
    over_itself = {
        sheet(root)
        for roots in cells.values()
        for root in roots
        if [sheet(r) for r in roots].count(sheet(root)) > 1
    }
    slots = {}
    for root in slot:
        slots.setdefault(sheet(root), set()).add(slot[root])
    for top, numbers in slots.items():
        assert (len(numbers) == 1) or top in over_itself
    for a, b in pairs:
        for root in cells[a]:
            for other in cells[b]:
                if slot[root] == slot[other]:
                    assert sheet(root) == sheet(other)


# --- which roots are edges


@pytest.mark.parametrize("bicycle", MACHINES, ids=IDS)
def test_edges_are_the_ends_of_the_stable_intervals(bicycle):
    table = plane(bicycle)[2]
    assert_edges(intervals_of(table), sheets_of(table))
    edge, V = sheets_of(table)["hurwitz3"].edge, sheets_of(table)["hurwitz3"].V
    assert edge.any()
    assert np.any((edge == 0) & np.isfinite(V))  # not every root is an edge


def assert_edges(inside, found):
    for name in CONDITIONS:
        kind = {"p0": CAPSIZE, "hurwitz3": WEAVE}.get(name, -1)
        ends = np.concatenate(
            [
                np.where(inside.lower == kind, inside.V1, np.nan),
                np.where(inside.upper == kind, inside.V2, np.nan),
            ],
            axis=-1,
        )
        V, edge = found[name]
        np.testing.assert_array_equal(edge.sum(axis=-1), np.isfinite(ends).sum(axis=-1))
        marked = np.sort(np.where(edge == 1, V, np.nan), axis=-1)
        ends = np.sort(ends, axis=-1)
        most = min(
            marked.shape[-1], ends.shape[-1]
        )  # both are roots of the same polynomials: equal to the bit
        np.testing.assert_array_equal(marked[..., :most], ends[..., :most])
        assert np.all(np.isnan(marked[..., most:]))
        assert np.all(np.isnan(ends[..., most:]))


@settings(max_examples=60, deadline=None)
@given(machines)
def test_edges_of_random_machines(machine):
    table = plane(Bicycle.from_mapping(machine), 12, 0.9, 0.5)[2]
    assert_edges(intervals_of(table), sheets_of(table))


def test_edges_are_found_however_the_ends_are_rounded():
    table = plane(DIKAREV)[2]
    inside, roots = intervals_of(table), critical_roots(table)
    off = replace(inside, V1=inside.V1 * (1 + 1e-12), V2=inside.V2 * (1 - 1e-12))
    for name in ("p0", "hurwitz3"):
        exact = sheets(name, roots[name], inside).edge
        assert exact.any()
        np.testing.assert_array_equal(sheets(name, roots[name], off).edge, exact)


def test_a_narrow_interval_has_two_edges():
    """Two weave speeds as close as they come are still one rising and one falling."""
    V = np.array([[[2.0, np.nextafter(2.0, 3.0)]]])
    kinds, zero = (np.full((1, 1, 1), WEAVE, np.uint8),) * 2, np.zeros((1, 1, 1))
    inside = Intervals(V[..., :1], V[..., 1:], *kinds, zero, zero, zero.astype(np.uint8))
    found = sheets("hurwitz3", Roots(V, np.ones((1, 1, 1), bool)), inside)
    np.testing.assert_array_equal(found.edge, [[[1, 1]]])
    np.testing.assert_array_equal(sheets("p1", Roots(V, np.ones((1, 1, 1), bool)), inside).edge, [[[0, 0]]])


def test_the_benchmarks_edges():
    table = characteristic_table(MEIJAARD, np.array([[MEIJAARD.lam]]), np.array([MEIJAARD.sigma]))
    found = sheets_of(table)
    for name, speed in (("hurwitz3", 4.292382536341), ("p0", 6.024262015388)):
        np.testing.assert_allclose(found[name].V[found[name].edge == 1], [speed], atol=1e-12)


# --- the order in which cells are solved leaves no trace


@pytest.mark.parametrize("bicycle", MACHINES, ids=IDS)
def test_roots_do_not_depend_on_their_company(bicycle):
    table = plane(bicycle)[2]
    whole = critical_roots(table)
    for part in (np.s_[3:9, 5:30], np.s_[20:21, 7:8]):
        alone = critical_roots(table[:, :, *part])
        for name in CONDITIONS:
            roots = whole[name].V[part]
            some = alone[name].V.shape[-1]
            np.testing.assert_array_equal(roots[..., :some], alone[name].V)
            assert np.all(np.isnan(roots[..., some:]))
