"""Chunks compressed here are what HDF5's own filters read, and would have written."""

import h5py
import numpy as np
import pytest

from bikestab.scan.chunks import packed, places

CASES = [
    ((7, 5, 11), (7, 5, 11)),
    ((7, 5, 11), (4, 4, 4)),  # a border on every side
    ((8, 8, 8), (4, 4, 4)),
    ((2, 2, 2), (1, 2, 1)),
    ((5,), (3,)),
]


def values_of(shape, dtype):
    rng = np.random.default_rng(1)
    if dtype == "u1":
        return rng.integers(0, 64, shape).astype(dtype)
    values = rng.normal(size=shape).astype(dtype)
    flat = values.reshape(-1)
    flat[::3], flat[1], flat[2] = np.nan, np.inf, -0.0
    return values


def dataset(path, values, chunk, **options):
    options = {"compression": "gzip", "compression_opts": 1, "shuffle": values.itemsize > 1} | options
    return h5py.File(path, "w").create_dataset("x", values.shape, values.dtype, chunks=chunk, **options)


def read_back(path, values, chunk):
    data = dataset(path, values, chunk)
    for place, part in zip(places(values.shape, chunk), packed(values, chunk), strict=True):
        data.id.write_direct_chunk(place, part)
    data.file.close()
    with h5py.File(path) as file:
        return file["x"][()]


@pytest.mark.parametrize("dtype", ["u1", "f4", "f8"])
@pytest.mark.parametrize(("shape", "chunk"), CASES)
def test_hdf5_reads_what_was_packed(tmp_path, shape, chunk, dtype):
    values = values_of(shape, dtype)
    assert read_back(tmp_path / "a.h5", values, chunk).tobytes() == values.tobytes()  # −0 and NaN too


@pytest.mark.parametrize("dtype", ["u1", "f4", "f8"])
def test_a_chunk_holds_the_bytes_that_hdf5s_own_filters_give(tmp_path, dtype):
    """Unpacked by hand: the same stream that a dataset of gzip and shuffle has, filled up with zeros."""
    import zlib

    values, chunk = values_of((7, 5, 11), dtype), (4, 4, 4)
    data = dataset(tmp_path / "a.h5", values, chunk)
    data[...] = values
    for place, part in zip(places(values.shape, chunk), packed(values, chunk), strict=True):
        mask, theirs = data.id.read_direct_chunk(place)
        assert mask == 0
        assert zlib.decompress(part) == zlib.decompress(theirs)
        assert len(part) < 1.5 * len(theirs) + 150  # it begins with a table of codes
    data.file.close()


@pytest.mark.parametrize("value", [0, 1, 63, 255])
@pytest.mark.parametrize("shape", [(4, 4, 4), (9, 9, 9)])
def test_constant_chunks(tmp_path, value, shape):
    values = np.full(shape, value, np.uint8)
    np.testing.assert_array_equal(read_back(tmp_path / "a.h5", values, (4, 4, 4)), values)
    assert max(map(len, packed(values, (4, 4, 4)))) < 150


@pytest.mark.parametrize("value", [0.0, 1.0, 2.5, np.nan])
def test_constant_chunks_of_wider_numbers(tmp_path, value):
    for dtype in ("f4", "f8"):
        values = np.full((9, 9, 9), value, dtype)
        np.testing.assert_array_equal(read_back(tmp_path / f"{dtype}.h5", values, (4, 4, 4)), values)


def test_constant_chunks_of_one_size_and_of_another():
    """What is remembered of one is not taken for the other."""
    small, large = (packed(np.ones((n, n), np.uint8), (n, n)) for n in (8, 16))
    other = packed(np.zeros((8, 8), np.uint8), (8, 8))
    assert len({*small, *large, *other}) == 3


@pytest.mark.parametrize("order", ["transposed", "reversed", "a part"])
def test_arrays_that_do_not_lie_in_order(tmp_path, order):
    values = values_of((6, 7, 8), "f4")
    view = {"transposed": values.T, "reversed": values[::-1, :, ::-1], "a part": values[1:, ::2, 3:]}[order]
    assert read_back(tmp_path / "a.h5", view, (4, 4, 4)).tobytes() == view.tobytes()


def test_places_cover_an_array_once_in_its_own_order():
    shape, chunk = (7, 5, 4), (4, 2, 4)
    seen = np.zeros(shape, int)
    found = list(places(shape, chunk))
    for place in found:
        seen[tuple(slice(i, i + n) for i, n in zip(place, chunk, strict=True))] += 1
    assert np.all(seen == 1)
    assert found == sorted(found)
    assert len(packed(np.zeros(shape), chunk)) == len(found) == 6


def test_the_same_values_give_the_same_bytes():
    values = values_of((7, 5, 11), "f4")
    assert packed(values, (4, 4, 4)) == packed(values.copy(order="F"), (4, 4, 4))
