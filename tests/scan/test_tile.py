"""One tile: its fields, its columns, and what is said where the two ways disagree."""

import pickle
import zlib
from importlib import import_module

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.critical import critical
from bikestab.errors import ScanError
from bikestab.family import Family
from bikestab.model import exact_table
from bikestab.routh import CONDITIONS, conditions, violated
from bikestab.scan.chunks import bundled, places, unbundled
from bikestab.scan.sheets import critical_roots, most_roots
from bikestab.scan.tile import Columns, Tile, compute
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of
from tests.onecell import with_speeds

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
FIELDS = ("stable", "violated", "growth_rate", *CONDITIONS)
DTYPES = {"stable": "u1", "violated": "u1", "growth_rate": "f4", **dict.fromkeys(CONDITIONS, "f8")}
CHUNK = (4, 4, 8)


def tile_of(bicycle=DIKAREV, shape=(9, 7, 30), fields=FIELDS, lowest=True, model="refined", **more):
    n, m, k = shape
    lam, sigma, V = np.linspace(0, 0.3, n), np.linspace(0, 0.15, m), np.linspace(0, 15, k)
    return Tile(Family(bicycle, model), lam, sigma, V, fields, CHUNK, lowest, **more)


def table_of(tile):
    return tile.family.table(tile.x[:, np.newaxis], tile.y)


def fields_of(tile, finished):
    """The fields again, by name, from the chunks of a finished tile."""
    chunks = iter(unbundled(finished.chunks))
    found = {}
    for name in tile.fields:
        dtype, size = np.dtype(DTYPES[name]), int(np.prod(CHUNK))
        found[name] = np.empty(tile.shape, dtype)
        for place in places(tile.shape, CHUNK):
            raw = np.frombuffer(zlib.decompress(next(chunks)), np.uint8)
            chunk = np.ascontiguousarray(raw.reshape(dtype.itemsize, size).T).view(dtype).reshape(CHUNK)
            part = found[name][tuple(slice(i, i + n) for i, n in zip(place, CHUNK, strict=True))]
            part[...] = chunk[tuple(map(slice, part.shape))]
    assert next(chunks, None) is None
    return found


# --- what is in it


@pytest.mark.parametrize("shape", [(9, 7, 30), (2, 2, 2), (3, 2, 600), (40, 30, 20)])
@pytest.mark.parametrize(
    ("bicycle", "model"),
    [(DIKAREV, "refined"), (MEIJAARD.with_delta(1.0), "refined"), (DIKAREV, "unrefined")],
    ids=["1981", "2007 damped", "unrefined"],
)
def test_fields_are_what_a_direct_evaluation_gives(bicycle, model, shape):
    tile = tile_of(bicycle, shape, model=model)
    finished = compute(tile)
    found, table = fields_of(tile, finished), table_of(tile)[..., np.newaxis]
    values = conditions(table, tile.V)
    np.testing.assert_array_equal(found["violated"], violated(values))
    np.testing.assert_array_equal(found["stable"], violated(values) == 0)
    np.testing.assert_array_equal(found["growth_rate"], growth_rate_of(table, tile.V).astype("f4"))
    for name in CONDITIONS:
        np.testing.assert_array_equal(found[name], getattr(values, name))
    assert finished.notes["stable_points"] == np.count_nonzero(violated(values) == 0)


def test_only_the_fields_that_are_wanted_and_in_their_order():
    tile = tile_of(fields=("violated", "p2"))
    found, table = fields_of(tile, compute(tile)), table_of(tile)[..., np.newaxis]
    assert list(found) == ["violated", "p2"]
    np.testing.assert_array_equal(found["p2"], conditions(table, tile.V).p2)


@pytest.mark.parametrize("bicycle", [DIKAREV, DIKAREV.with_delta(2.0)], ids=["undamped", "damped"])
def test_columns_are_the_intervals_and_roots(bicycle):
    tile = tile_of(bicycle)
    finished = compute(tile)
    found = Columns.from_bytes(finished.columns)
    table = exact_table(tile.family.bicycle, tile.x[:, np.newaxis], tile.y, model=tile.family.model)
    for values, expected in zip(found.intervals, intervals_of(table), strict=True):
        np.testing.assert_array_equal(values, expected)
        assert values.dtype == expected.dtype
    for name, roots in critical_roots(table).items():
        np.testing.assert_array_equal(found.roots[name].V, roots.V)
        np.testing.assert_array_equal(found.roots[name].rising, roots.rising)
        assert tuple(finished.notes["most_roots"][name]) == most_roots(roots)
    assert finished.notes["intervals"] == found.intervals.V1.shape[-1]
    assert list(found.roots) == list(CONDITIONS)


def test_columns_survive_their_bytes():
    data = compute(tile_of(DIKAREV.with_delta(0.3))).columns
    again = Columns.from_bytes(data)
    assert again.to_bytes() == data
    assert [roots.V.shape[-1] for roots in again.roots.values()] == [1, 1, 1, 1, 0, 3]
    assert again.intervals.lower.dtype == np.uint8


def test_a_tile_above_another_has_no_columns():
    finished = compute(tile_of(lowest=False, above=3.0))
    assert finished.columns == b""
    assert set(finished.notes) == {"stable_points", "agreement"}


def test_roots_are_looked_at_above_the_tile_before():
    number = [compute(tile_of(lowest=False, above=above)).notes["agreement"].roots for above in (0, 5, 15)]
    assert number[0] > number[1] > number[2] == 0


def test_a_tile_and_what_came_of_it_can_go_to_another_process_and_back():
    tile = tile_of()
    finished = compute(pickle.loads(pickle.dumps(tile)))
    assert pickle.loads(pickle.dumps(finished)) == compute(tile) == finished


# --- bundled chunks


@pytest.mark.parametrize("chunks", [[b"a"], [b"", b"ab", b"c" * 1000], [b"x" * 7] * 9])
def test_what_is_bundled_can_be_unbundled(chunks):
    assert unbundled(bundled(chunks)) == chunks


# --- the two ways disagree


@pytest.mark.parametrize(
    ("factor", "message"),
    [
        (1 + 1e-9, "differ from the exact critical speeds by [0-9.]*e-0[89] m/s, more than"),
        (1.1, "the conditions' signs at the grid's speeds"),
    ],
)
def test_wrong_exact_speeds_are_an_error(factor, message, monkeypatch):
    def off(table, rough):
        exact = critical(table, rough=rough)
        return with_speeds(exact, {name: V * factor for name, V in exact.speeds.items()})

    monkeypatch.setattr(import_module("bikestab.scan.tile"), "critical", off)
    with pytest.raises(ScanError, match=f"{message}.*please report this with the config"):
        compute(tile_of())
