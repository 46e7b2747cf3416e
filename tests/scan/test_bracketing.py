"""Sign changes of the conditions on the grid, refined by scipy, against the exact critical speeds."""

from importlib import import_module

import numpy as np
import pytest
from hypothesis import given, settings

from bikestab.bicycle import Bicycle
from bikestab.errors import ScanError
from bikestab.family import Family
from bikestab.model import characteristic_table
from bikestab.routh import CONDITIONS
from bikestab.scan import bracketing
from bikestab.scan.agreement import AGREEMENT
from bikestab.scan.bracketing import Bracketing, zeros
from bikestab.scan.sheets import Roots, critical_roots
from bikestab.scan.tile import Tile
from tests.onecell import table_of
from tests.strategies import machines

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
LAM, SIGMA, V = np.linspace(0, 0.3, 16), np.linspace(0, 0.15, 12), np.linspace(0.1, 15, 150)


def tile_of(bicycle, lam=LAM, sigma=SIGMA, V=V, model="refined"):
    return Tile(Family(bicycle, model), lam, sigma, V, (), (32, 32, 32), lowest=True)


def roots_of(tile):
    return critical_roots(
        characteristic_table(tile.family.bicycle, tile.x[:, np.newaxis], tile.y, model=tile.family.model)
    )


def seen(tile, roots=None):
    """What is found in a tile that is the whole grid."""
    witness = Bracketing(tile.V, len(tile.x) * len(tile.y))
    witness.add((0, 0), tile, roots_of(tile) if roots is None else roots, np.zeros(tile.shape[:2], bool))
    return witness.agreement()


def changed(roots, name, change):
    return {**roots, name: Roots(change(roots[name].V), roots[name].rising)}


# --- agreement


@pytest.mark.parametrize(
    ("bicycle", "model"),
    [
        (DIKAREV, "refined"),
        (DIKAREV, "unrefined"),
        (MEIJAARD, "refined"),
        (DIKAREV.with_delta(2.0), "refined"),
        (Bicycle.preset("kooijman2011"), "refined"),
        (Bicycle.preset("sharp1971"), "refined"),
    ],
    ids=["1981", "unrefined", "2007", "damped", "skates", "motorcycle"],
)
def test_what_scipy_finds_are_the_exact_speeds(bicycle, model):
    """As many as the grid can tell apart: one for each step in which a condition has an odd number."""
    tile = tile_of(bicycle, model=model)
    found = seen(tile)
    expected = 0
    for roots in roots_of(tile).values():
        step = np.searchsorted(V, roots.V)  # NaN behind all
        inside = (np.arange(1, len(V)) == step[..., np.newaxis]).sum(axis=-2)
        expected += int(np.count_nonzero(inside % 2))
    assert found.roots == expected > 100
    assert found.largest <= 1e-11
    assert (found.loose, found.touching) == (0, 0)


@settings(max_examples=25, deadline=None, derandomize=True)
@given(machines)
def test_random_machines(machine):
    lam, sigma = np.linspace(0, 0.6, 4), np.linspace(0, 0.3, 4)
    assert (
        seen(tile_of(Bicycle.from_mapping(machine), lam, sigma, np.linspace(0, 40, 81))).largest <= AGREEMENT
    )


def test_close_to_a_fold_rounding_moves_what_scipy_finds():
    """Three weave speeds that are nearly one: triple roots move by the cube root of the rounding."""
    polynomial = np.poly([3, 3, 3 + 1e-9])[::-1]  # p0 of a table of one cell: (V − 3)² (V − 3 − 1e-9)
    table = table_of(p0=polynomial)
    x = zeros("p0", table, np.array([1.0]), np.array([4.0]))
    assert 1e-9 < abs(x[0] - 3) < 1e-4
    parts = bracketing.Brackets(table, np.array([1.0]), np.array([4.0]), np.array([[3.0, 3.0, 3.0 + 1e-9]]))
    found = bracketing._compared("p0", parts)
    assert (found.roots, found.largest, found.loose) == (1, 0.0, 1)
    assert found.largest_loose > AGREEMENT


def test_a_change_of_sign_that_rounding_made_is_told_apart():
    """Next to a triple root the condition is nothing but rounding."""
    table = table_of(p0=np.poly([2.7, 2.7, 2.7])[::-1])
    V = np.linspace(2.7 - 1e-6, 2.7 + 1e-6, 2000)
    witness = Bracketing(V, 1)
    witness._look(table, V, dict.fromkeys(CONDITIONS, np.full((1, 1), 2.7)))
    found = witness.agreement()
    assert (found.roots, found.largest) == (0, 0.0)
    assert found.touching > 3


# --- what is wrong is seen


@pytest.mark.parametrize("name", ["p0", "p2", "hurwitz3"])
def test_a_wrong_speed_is_an_error(name):
    tile = tile_of(MEIJAARD)
    wrong = changed(roots_of(tile), name, lambda V: V + 3e-10)
    with pytest.raises(
        ScanError, match=r"that scipy finds .* differ .* by [23](\.\d+)?e-10 m/s, more than the 1e-10"
    ):
        seen(tile, wrong)


def test_a_missing_speed_is_an_error():
    tile = tile_of(MEIJAARD)
    missing = changed(
        roots_of(tile), "p0", lambda V: np.where(np.arange(V.shape[0])[:, None, None] == 7, np.nan, V)
    )
    with pytest.raises(ScanError, match=r"differ .* by inf m/s"):
        seen(tile, missing)


def test_a_root_finder_that_ends_in_nan_has_found_nothing(monkeypatch):
    """Although it says success."""

    def never_zero(table, name, V):
        return np.sqrt(np.where(V < 1, 1 - V, np.nan)) + 1

    monkeypatch.setattr(import_module("bikestab.scan.bracketing"), "condition", never_zero)
    found = zeros("p0", table_of(p0=[1.0, 0, 0, 0]), np.array([0.0]), np.array([2.0]))
    assert np.isnan(found).all()


# --- which columns


@pytest.mark.parametrize("columns", [1, 10, 100, 100_000])
def test_what_is_found_does_not_depend_on_the_tiles(columns, monkeypatch):
    monkeypatch.setattr(import_module("bikestab.scan.bracketing"), "COLUMNS", columns)
    tile = tile_of(DIKAREV.with_delta(0.3))
    whole = seen(tile)
    parts = Bracketing(V, len(LAM) * len(SIGMA))
    for i in (8, 0):
        for j in (0, 5):
            part = tile_of(tile.family.bicycle, LAM[i : i + 8], SIGMA[j : j + (5, 7)[j > 0]])
            parts.add((i, j), part, roots_of(part), np.zeros(part.shape[:2], bool))
    assert parts.agreement() == whole


def test_columns_lie_evenly(monkeypatch):
    """About as many as wanted, in every part of the grid."""
    monkeypatch.setattr(import_module("bikestab.scan.bracketing"), "COLUMNS", 1000)
    chosen = Bracketing(V, 200 * 300)._chosen((0, 0), (200, 300))
    assert np.count_nonzero(chosen) == pytest.approx(1000, rel=0.01)
    parts = chosen.reshape(10, 20, 10, 30).sum(axis=(1, 3))
    assert parts.min() >= 5
    assert parts.max() <= 15
    assert chosen.any(axis=0).sum() > 290
    assert chosen.any(axis=1).all()


def test_long_axes_of_speeds_have_fewer_columns(monkeypatch):
    monkeypatch.setattr(import_module("bikestab.scan.bracketing"), "POINTS", 10 * len(V))
    found = seen(tile_of(DIKAREV))
    monkeypatch.setattr(
        import_module("bikestab.scan.bracketing"), "_PART", 7
    )  # parts of the speeds share their ends
    assert seen(tile_of(DIKAREV)) == found
    assert 10 < found.roots < 80
