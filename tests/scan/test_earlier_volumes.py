"""The same configs give the same volumes as an earlier build did; tests/references/volumes has both."""

from contextlib import chdir
from pathlib import Path

import h5py
import numpy as np
import pytest

from bikestab.config.file import load_config
from bikestab.scan.run import run_scan

FOLDER = Path(__file__).parents[1] / "references" / "volumes"
NAMES = sorted(path.stem for path in FOLDER.glob("*.h5"))
# relative: the earlier build rounded the table's terms, where this one has the doubles nearest to its entries
ROUNDING = 1e-9  # near a fold, where this grows; elsewhere some 1e-14
ADDED = {"V1_error", "V2_error", "marginal"}  # datasets that the earlier build did not write
DIFFERENT = {"config_sha256", "bikestab_version", "source"}  # what an attribute of the file may differ in
HANDLES = {"REFERENCE_LIST", "DIMENSION_LIST"}  # of HDF5 itself; dims are compared by name


@pytest.fixture(scope="module", params=NAMES)
def pair(request, tmp_path_factory):
    """The earlier volume and the one of this build, open."""
    with chdir(tmp_path_factory.mktemp(request.param)):
        path = run_scan(load_config(FOLDER / f"{request.param}.yaml")).path.absolute()
    with h5py.File(FOLDER / f"{request.param}.h5") as old, h5py.File(path) as new:
        yield old, new


def items(group, prefix=""):
    """All groups and datasets by name, through links of both kinds."""
    found = {prefix.rstrip("/") or "/": group}
    for name, item in group.items():
        found |= items(item, f"{prefix}{name}/") if isinstance(item, h5py.Group) else {prefix + name: item}
    return found


def test_names(pair):
    old, new = map(items, pair)
    assert set(new) - ADDED == set(old)
    assert [name for name in pair[1] if name not in ADDED] == list(pair[0])  # in the order of the file


def test_types_shapes_and_layout(pair):
    old, new = map(items, pair)
    for name, item in old.items():
        if isinstance(item, h5py.Dataset):
            for what in ("dtype", "shape", "compression", "compression_opts", "shuffle"):
                assert getattr(new[name], what) == getattr(item, what), (name, what)
            if item.chunks:  # machines with small grids have shared them since
                lead = len(old["/"]["machine"].shape) - 1 if "machine" in old else 0
                assert new[name].chunks[lead:] == item.chunks[lead:], name
            assert [dim.keys() for dim in new[name].dims] == [dim.keys() for dim in item.dims]
            np.testing.assert_equal(new[name].fillvalue, item.fillvalue)


def test_attributes(pair):
    """Units, meanings and flags; of the file all that the config decides."""
    old, new = map(items, pair)
    for name, item in old.items():
        here, there = dict(new[name].attrs), dict(item.attrs)
        assert set(here) >= set(there), name
        for key in set(there) - HANDLES - DIFFERENT:
            assert np.asarray(here[key]).dtype == np.asarray(there[key]).dtype, (name, key)
            if key == "largest_difference":
                assert here[key] <= 1e-10
                continue
            np.testing.assert_array_equal(here[key], there[key], f"{name}: {key}")


def test_integers_and_flags_are_equal(pair):
    old, new = map(items, pair)
    for name, item in old.items():
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "iu":
            np.testing.assert_array_equal(new[name][()], item[()], name)


def test_floats_are_equal(pair):
    """To the rounding of the earlier build."""
    old, new = map(items, pair)
    for name, item in old.items():
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
            np.testing.assert_allclose(new[name][()], item[()], rtol=ROUNDING, atol=1e-11, err_msg=name)
