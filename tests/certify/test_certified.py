"""The field ``certified`` of a volume: never against ``stable``, for every reader, and not taken on trust."""

import shutil

import h5py
import netCDF4
import numpy as np
import pytest

import bikestab as bs
from bikestab.certified import add_certified, contradicted
from bikestab.certify.proof import prove
from bikestab.errors import InputError
from bikestab.scan.run import run_scan
from bikestab.volume import Volume
from tests.volumes import config_of

CELLS = ("lam_cell", "sigma_cell", "V_cell")
CONFIG = """\
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 9}
  sigma: {start: 0, stop: 0.15, num: 7}
  V: {start: 0, stop: 12, num: 17}
fields: [stable]
slices: []
output: OUT
"""


@pytest.fixture(scope="module")
def certified(tmp_path_factory):
    config = config_of(CONFIG, tmp_path_factory.mktemp("certified"))
    path = run_scan(config).path
    assert add_certified(path, config.machine, config.model) == 0
    return path, config


def test_it_is_the_proof_and_never_against_stable(certified):
    path, config = certified
    with Volume(path) as volume:
        cells, stable = volume.read("certified"), volume.read("stable")
        axes = [volume.axis(name) for name in ("lam", "sigma", "V")]
    np.testing.assert_array_equal(cells, prove(config.machine, *axes).cells)
    assert set(np.unique(cells)) == {0, 1, 2}
    assert not contradicted(cells, stable).any()
    turned = np.where(cells == 1, np.uint8(2), np.where(cells == 2, np.uint8(1), cells))
    np.testing.assert_array_equal(contradicted(turned, stable), cells > 0)


def test_readers(certified, tmp_path):
    path, config = certified
    with bs.open_volume(path) as volume, volume.to_xarray() as data:
        assert data.certified.dims == CELLS
        assert float(data.V_cell[0]) == 0.375
        np.testing.assert_array_equal(data.certified, volume.read("certified"))
    with netCDF4.Dataset(path) as data:
        assert data["certified"].dimensions == CELLS
        assert data["certified"].flag_meanings == "undecided proved_stable proved_unstable"
    before = path.read_bytes()
    assert add_certified(path, config.machine, config.model) == 0  # what is there is kept
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("name", "harm", "problem"),
    [
        ("certified", lambda data: data.__setitem__((0, 0, 0), 3), "not within 0 ... 2"),
        ("V_cell", lambda data: data.__setitem__(0, 0.1), "has not the middles between values of V"),
        ("sigma_cell", None, "sigma_cell: is missing"),
        ("certified", np.zeros((8, 6, 15), "u1"), "has the shape 8 × 6 × 15"),
        ("certified", np.zeros((8, 6, 16), "i4"), "has values of type int32"),
    ],
)
def test_strangers(certified, tmp_path, name, harm, problem):
    path = shutil.copy(certified[0], tmp_path / "volume.h5")
    with h5py.File(path, "a") as file:
        if callable(harm):
            harm(file[name])
        else:
            del file[name]
            if harm is not None:
                file[name] = harm
    with pytest.raises(InputError, match=problem), Volume(path) as volume:
        volume.read("certified")


def test_sweeps_have_no_proof(tmp_path):
    config = config_of(CONFIG + "sweep: {delta: [0, 1]}\n", tmp_path)
    path = run_scan(config).path
    with pytest.raises(InputError, match="one machine"):
        add_certified(path, config.machine, config.model)
