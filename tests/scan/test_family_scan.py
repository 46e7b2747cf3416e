"""Scans over any two parameters: what each machine alone has, with axes that every reader knows."""

import h5netcdf
import h5py
import netCDF4
import numpy as np
import pytest
import xarray

import bikestab as bs
from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.geometry import trail_from
from bikestab.model import characteristic_table
from bikestab.plot.slices import draw_slice
from bikestab.routh import conditions, violated
from bikestab.stability import stable_intervals
from tests.configs import load, message

TEXT = """\
bicycle: meijaard2007
grid:
  x: {name: mB, start: 40kg, stop: 110, num: 8}
  y: {name: offset, start: 0mm, stop: 80mm, num: 5}
  V: {start: 0, stop: 36km/h, num: 11}
"""
MEIJAARD = Bicycle.preset("meijaard2007")


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def volume():
    with bs.scan(load(TEXT)).open() as opened:
        yield opened


def one(mass, offset):
    """The machine by its own arithmetic: the trail that this offset gives at the machine's own head angle."""
    trail = float(trail_from(MEIJAARD.lam, offset, MEIJAARD.bodies["rF"]))
    return MEIJAARD.replaced({"mB": mass, "c": trail})


def test_every_point_is_that_of_a_machine_alone(volume):
    assert volume.axes == ("mB", "offset", "V")
    V = volume.axis("V")
    for i, mass in enumerate(volume.axis("mB")):
        for j, offset in enumerate(volume.axis("offset")):
            machine = one(mass, offset)
            found = stable_intervals(machine)
            np.testing.assert_allclose(volume.read("V1")[i, j], found.V1, rtol=1e-13)
            np.testing.assert_allclose(volume.read("V2")[i, j], found.V2, rtol=1e-13)
            table = characteristic_table(machine, machine.lam, machine.sigma)
            expected = violated(conditions(table[..., np.newaxis], V))
            np.testing.assert_array_equal(volume.read("violated")[i, j], expected)
    assert volume.bicycle.given == {**MEIJAARD.given, "delta": 0.0}
    assert volume.family.x == "mB"


def test_readers_know_the_axes(volume):
    for engine in ("h5netcdf", "netcdf4"):
        with xarray.open_dataset(volume.path, engine=engine) as data:
            assert data.growth_rate.dims == ("mB", "offset", "V")
            assert [data[name].attrs["units"] for name in data.growth_rate.dims] == ["kg", "m", "m s-1"]
            assert data.mB.attrs["long_name"] == "body mass"
            assert data.attrs["axes"] == "mB offset V"
    with netCDF4.Dataset(volume.path) as data:
        assert data["V1"].dimensions == ("mB", "offset", "interval")
    with h5netcdf.File(volume.path) as data:
        assert list(data["stable"].dimensions) == ["mB", "offset", "V"]
    with volume.to_xarray() as data:
        assert data.stable.sel(mB=85, offset=0.04, V=5, method="nearest") == 1


def test_the_same_as_tilt_and_trail_where_these_are_named():
    named = load(
        "bicycle: meijaard2007\ngrid:\n  x: {name: lam, start: 0, stop: 18deg, num: 4}\n"
        "  y: {name: sigma, values: [0.05, 0.1]}\n  V: {values: [1, 5]}\n"
    )
    plain = load(
        "bicycle: meijaard2007\ngrid:\n  lam: {start: 0, stop: 18deg, num: 4}\n"
        "  sigma: {values: [0.05, 0.1]}\n  V: {values: [1, 5]}\n"
    )
    assert named.sha256 == plain.sha256
    assert named.sha256 != load(TEXT).sha256
    with bs.scan(named).open() as volume:
        assert "axes" not in volume.file.attrs


def test_a_sweep_and_an_ensemble_of_a_family():
    text = TEXT + "sweep: {lam: [18deg, 20deg]}\nensemble: {xB: {normal: [0.3, 0.02]}, samples: 50}\n"
    done = bs.scan(load(text))
    with done.open() as whole:
        assert whole.read("probability").shape == (2, 8, 5, 11)
        at = whole.at({"lam": np.radians(20)})
        assert at.bicycle.lam == np.radians(20)
        assert at.family.own[0] == 85
        i, j = 4, 2
        draws = load(text).ensemble.drawn["xB"]
        base = Bicycle.from_mapping({**MEIJAARD.given, "lam": np.radians(20), "mB": at.axis("mB")[i]})
        trail = float(trail_from(base.lam, at.axis("offset")[j], base.R2))
        inside = np.zeros(len(at.axis("V")))
        for x in draws:
            machine = base.replaced({"xB": float(x), "c": trail})
            table = characteristic_table(machine, machine.lam, machine.sigma)
            inside += violated(conditions(table[..., np.newaxis], at.axis("V"))) == 0
        np.testing.assert_array_equal(at.read("probability")[i, j], (inside / 50).astype(np.float32))


def test_a_picture_has_the_parameters_on_its_axes(volume):
    figure = draw_slice(volume, "mB", 90.0)
    assert figure.axes[0].get_xlabel().startswith("fork offset")
    assert "mB = 90 kg" in figure.axes[0].get_title()


def test_another_grid_is_another_scan(volume):
    with pytest.raises(InputError, match="axes: mB × offset × V there, xB × offset × V here"):
        bs.scan(load(TEXT, "grid.x={name: xB, start: 0.2, stop: 0.4, num: 8}"))
    path = volume.path
    volume.close()
    with h5py.File(path, "r+") as file:
        file.attrs["axes"] = "mB zB V"
    with pytest.raises(InputError, match="zB: is missing"):
        bs.open_volume(path)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("grid.x.name=mb", "grid.x.name: there is no parameter 'mb'\ndid you mean 'mB'?"),
        ("grid.x={name: offset, values: [0]}", "grid.y.name: offset and offset are one parameter"),
        ("grid.x.start=-1", "grid.x: at mB = -1, offset = 0: -1 is not non-negative"),
        ("grid.x.stop=3m", "grid.x.stop: '3m' is not a number"),
        ("grid.x.nun=3", "grid.x.nun: unknown key\ndid you mean 'num'?"),
        ("grid.lam={values: [1]}", "grid.lam: unknown key\nknown: x, y, V"),
        ("slices=[{lam: 0.2}]", "slices[0].lam: the grid has no axis 'lam'\nknown: mB, offset, V"),
        ("slices=[{mB: 200kg}]", "slices[0].mB: 200 is outside the grid\nallowed: 40 ... 110"),
        ("sweep={c: [0.1]}", "sweep.c: the grid has the trail\ngive its values in grid.offset"),
        ("sweep={mB: [80]}", "sweep.mB: grid varies it already"),
        ("bicycle=dikarev1981", "grid.x.name: the bicycle 'dikarev1981' has no parameter 'mB'"),
    ],
)
def test_mistakes(change, words):
    assert words in message(TEXT, change)


def test_a_machine_without_a_tilt_of_its_own():
    text = TEXT.replace("meijaard2007", "dikarev1981").replace("mB", "m1")
    assert "grid: the bicycle 'dikarev1981' has no lam of its own\ngive it one" in message(text)
