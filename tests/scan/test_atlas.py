"""Sheets put together from tiles: all roots, continuous, and as in one piece."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.routh import CONDITIONS
from bikestab.scan.sheets import Atlas, Roots, Sheets, critical_roots, most_roots, sheets
from bikestab.speeds import Intervals, intervals_of
from tests.scan.test_sheets import (
    DAMPED_LITTLE,
    DIKAREV,
    IDS,
    MACHINES,
    assert_complete,
    assert_edges,
    assert_slots_are_connected,
    breaks,
    cusp,
    largest_jump,
    no_intervals,
    plane,
)
from tests.strategies import machines

TILES = [(41, 42), (16, 16), (64, 5), (5, 64), (7, 9), (2, 3)]


def in_tiles(name, roots, intervals, tile):
    """The sheets of a plane that comes in tiles of that size, which know only their own roots."""
    n, m, _ = roots.V.shape
    atlas = Atlas(name, most_roots(roots))
    places = [(i, j) for i in range(0, n, tile[0]) for j in range(0, m, tile[1])]
    parts = {}
    for i, j in places:
        part = np.s_[i : i + tile[0], j : j + tile[1]]
        V, rising = roots.V[part], roots.rising[part]
        V = V[..., : int(np.isfinite(V).sum(axis=-1).max(initial=0))]  # none wider than its own most
        parts[i, j] = Roots(V, rising), Intervals(*(values[part] for values in intervals.arrays().values()))
        atlas.add((i, j), parts[i, j][0])
    atlas.finish()
    out = Sheets(np.full((n, m, atlas.width), -1.0), np.zeros((n, m, atlas.width), np.uint8))
    for (i, j), (some, inside) in reversed(parts.items()):
        found = atlas.sheets((i, j), some, inside)
        for whole, values in zip(out, found, strict=True):
            whole[i : i + tile[0], j : j + tile[1]] = values
    return out


def all_in_tiles(table, tile):
    intervals = intervals_of(table)
    return {name: in_tiles(name, roots, intervals, tile) for name, roots in critical_roots(table).items()}


@pytest.mark.parametrize("tile", TILES)
@pytest.mark.parametrize("bicycle", [*MACHINES, DAMPED_LITTLE], ids=[*IDS, "damped little"])
def test_tiles_give_the_sheets_of_one_piece(bicycle, tile):
    table = plane(bicycle)[2]
    found, intervals = all_in_tiles(table, tile), intervals_of(table)
    for name, roots in critical_roots(table).items():
        whole = sheets(name, roots, intervals)
        np.testing.assert_array_equal(found[name].V, whole.V)
        np.testing.assert_array_equal(found[name].edge, whole.edge)


@pytest.mark.parametrize("tile", [(16, 16), (7, 9)])
@pytest.mark.parametrize("bicycle", [MACHINES[2], DAMPED_LITTLE], ids=["damped", "damped little"])
def test_a_slot_is_a_continuous_sheet(bicycle, tile):
    """Roots followed in small steps from cell to cell arrive in the slot that they started from."""
    lam, sigma, table = plane(bicycle)
    followed, wrong = breaks(bicycle, "hurwitz3", lam, sigma, all_in_tiles(table, tile)["hurwitz3"].V)
    assert followed > 20
    assert wrong == []


@settings(max_examples=40, deadline=None, derandomize=True)
@given(machine=machines, tile=st.tuples(st.integers(1, 8), st.integers(1, 9)))
def test_random_machines(machine, tile):
    """Neighbours in one slot are of one sheet, and a sheet that nowhere lies over itself is in one slot."""
    table = plane(Bicycle.from_mapping(machine), 7, 0.9, 0.5)[2]
    found = all_in_tiles(table, tile)
    assert_complete(table, found)
    assert_edges(intervals_of(table), found)
    for name, (V, rising) in critical_roots(table).items():
        assert_slots_are_connected(V, rising[..., 0], found[name].V)


@pytest.mark.parametrize("tile", [(4, 4), (13, 2), (3, 14), (1, 1)])
@pytest.mark.parametrize("delta", [0.01, 0.1, 0.3, 1.0])
@pytest.mark.parametrize("bicycle", [DIKAREV, MACHINES[1]], ids=IDS[:2])
def test_coarse_grids(bicycle, delta, tile):
    table = plane(bicycle.with_delta(delta), 13, 1.2, 0.6)[2]
    found = all_in_tiles(table, tile)
    assert_complete(table, found)
    V, rising = critical_roots(table)["hurwitz3"]
    assert_slots_are_connected(V, rising[..., 0], found["hurwitz3"].V)


@pytest.mark.parametrize("tile", [(81, 82), (41, 41), (27, 30), (10, 82)])
def test_around_a_cusp_nothing_is_lost(tile):
    """A layer that lies over itself may be cut elsewhere than in one piece; it jumps between tiles only."""
    table = cusp()
    found = all_in_tiles(table, tile)
    assert_complete(table, found)
    V = found["p0"].V
    steepest = 2 * (3 / 81) ** (1 / 3) * (1 + 1e-12)  # reached at a = 0; the table's own entries are rounded
    for i in range(0, 81, tile[0]):
        for j in range(0, 82, tile[1]):
            assert largest_jump(V[i : i + tile[0], j : j + tile[1]]) < steepest


def test_a_direction_without_several_roots_anywhere_needs_no_links():
    """One slot for each direction, however far apart its pieces are."""
    V = np.full((9, 8, 2), np.nan)
    V[:3, :, 0], V[6:, :, 0], V[6:, 4:, 1] = 2.0, 9.0, 12.0
    roots = Roots(V, np.ones((9, 8, 1), bool))
    for tile in ((9, 8), (2, 3), (1, 1)):
        found = in_tiles("p0", roots, no_intervals((9, 8)), tile)
        np.testing.assert_array_equal(found.V, V)


def test_tiles_without_roots():
    V = np.full((6, 6, 3), np.nan)
    V[3:, 3:] = 2, 5, 8  # in one tile of four
    roots = Roots(V, np.ones((6, 6, 1), bool))
    np.testing.assert_array_equal(in_tiles("p1", roots, no_intervals((6, 6)), (3, 3)).V, V)
    nothing = Roots(V[..., :0], np.ones((6, 6, 1), bool))
    assert in_tiles("p1", nothing, no_intervals((6, 6)), (3, 3)).V.shape == (6, 6, 0)


def test_the_conditions_are_those_of_the_tiles():
    assert list(all_in_tiles(cusp(9), (4, 4))) == list(CONDITIONS)
