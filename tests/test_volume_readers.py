"""volume.h5 as other programs read it, and bikestab itself."""

import shutil
import subprocess
import sys

import h5py
import numpy as np
import pytest

import bikestab as bs
from bikestab.errors import InputError
from bikestab.fields import AXES
from bikestab.model import characteristic_table
from bikestab.routh import CONDITIONS
from bikestab.scan.run import run_scan
from bikestab.spectrum import growth_rate_of
from bikestab.volume import Volume, uniform
from tests.volumes import EQUAL, config_of

netCDF4 = pytest.importorskip("netCDF4")
xarray = pytest.importorskip("xarray")

# --- other readers


@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_xarray(equal, own, engine):
    path, config = equal
    with xarray.open_dataset(path, engine=engine) as data:
        assert data.growth_rate.dims == AXES
        assert data.V1.dims == ("lam", "sigma", "interval")
        assert {"lam", "sigma", "V", "interval", "root"} <= set(data.coords)
        assert data.V.attrs["units"] == "m s-1"
        assert data.attrs["config_sha256"] == config.sha256
        assert data.stable.dtype == np.uint8
        at = data.sel(lam=0.2, sigma=0.075, V=5, method="nearest")
        expected = growth_rate_of(characteristic_table(config.machine, 0.2, 0.075), 5.0)
        assert float(at.growth_rate) == pytest.approx(float(expected), rel=1e-6)
    with xarray.open_dataset(path, engine=engine, group="boundary") as data:
        assert data.p0.dims == ("lam", "sigma", "root")
    with xarray.open_dataset(own[0], engine=engine) as data:
        assert np.isposinf(data.V2[2, 2, 1])
        assert np.isnan(data.V2[0, 0, 0])
        np.testing.assert_array_equal(data.lam, own[1].grid.values("lam"))


def test_volume_in_xarray(equal, own):
    for path, _ in (equal, own):
        with bs.open_volume(path) as volume, xarray.open_dataset(path, engine="netcdf4") as expected:
            data = volume.to_xarray()
            xarray.testing.assert_identical(data.drop_attrs(), expected.drop_attrs())
            for name in volume.fields:
                assert data[name].dims == AXES
                np.testing.assert_array_equal(data[name], volume.read(name))
            assert data.growth_rate.attrs["units"] == "s-1"
            assert [data[name].attrs["units"] for name in AXES] == ["rad", "1", "m s-1"]
        assert data.V1.isel(lam=0, sigma=0).shape == data.interval.shape  # it outlives the volume
        data.close()


def test_one_machine_of_a_sweep_in_xarray(tmp_path, in_an_empty_folder):
    config = config_of(EQUAL + "sweep: {delta: [0, 1, 2]}\n", tmp_path)
    with (
        bs.open_volume(run_scan(config).path) as volume,
        volume.to_xarray() as every,
        volume.at({"delta": 1}).to_xarray() as one,
    ):
        xarray.testing.assert_identical(one, every.sel(delta=1.0))
        assert one.stable.dims == AXES
        np.testing.assert_array_equal(one.stable, volume.at({"delta": 1}).read("stable"))


def test_without_xarray(equal, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5netcdf", None)
    with bs.open_volume(equal[0]) as volume, pytest.raises(bs.InputError, match=r"bikestab\[xarray\]"):
        volume.to_xarray()


def test_netcdf4(equal):
    path, config = equal
    with netCDF4.Dataset(path) as data:
        assert data.data_model == "NETCDF4"
        assert {name: len(size) for name, size in data.dimensions.items()} == {
            "lam": 7, "sigma": 5, "V": 11, "interval": 1, "root": len(data["root"])
        }  # fmt: skip
        assert data["stable"].dimensions == AXES
        assert data["boundary/hurwitz3"].dimensions == ("lam", "sigma", "root")
        assert data["stable"].flag_meanings == "unstable stable"
        assert data.config == config.text
        with h5py.File(path) as file:
            np.testing.assert_array_equal(data["growth_rate"][:], file["growth_rate"][()])


def test_netcdf4_can_append(equal, tmp_path):
    path = shutil.copy(equal[0], tmp_path / "volume.h5")
    with netCDF4.Dataset(path, "a") as data:
        data.comment = "seen"
        data.createVariable("mine", "f8", AXES)[:] = 3.0
        data["boundary"].createVariable("mine", "i4", ("root",))[:] = 2
    with netCDF4.Dataset(path) as data:
        assert data.comment == "seen"
        assert data["mine"][0, 0, 0] == 3
        assert data["boundary/mine"][0] == 2
    with Volume(path) as volume, h5py.File(equal[0]) as before:
        np.testing.assert_array_equal(volume.file["violated"][()], before["violated"][()])


def test_paraview(equal):
    hdf = pytest.importorskip("vtkmodules.vtkIOHDF")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    path, config = equal
    lam, sigma, V = (config.grid.values(name) for name in AXES)
    reader = hdf.vtkHDFReader()
    assert reader.CanReadFile(str(path))
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    assert image.GetClassName() == "vtkImageData"
    assert image.GetDimensions() == (len(V), len(sigma), len(lam))
    assert image.GetOrigin() == pytest.approx((V[0], sigma[0], lam[0]))
    assert image.GetSpacing() == pytest.approx((V[1] - V[0], sigma[1] - sigma[0], lam[1] - lam[0]))
    points = image.GetPointData()
    names = [points.GetArrayName(i) for i in range(points.GetNumberOfArrays())]
    with h5py.File(path) as file:
        assert set(names) == {"stable", "violated", "growth_rate", *CONDITIONS}
        for name in names:
            values = vtk_to_numpy(points.GetArray(name)).reshape(file[name].shape)
            np.testing.assert_array_equal(values, file[name][()])
        # the value that ParaView shows at a place is the one of that design and speed
        i, j, k = 5, 2, 6
        at = image.FindPoint(V[k], sigma[j], lam[i])
        assert points.GetArray("p0").GetValue(at) == file["p0"][i, j, k]


@pytest.mark.parametrize(
    ("equal_steps", "own_values"),
    [
        ("lam: {start: 0, stop: 0.3, num: 7}", "lam: {values: [0, 0.1, 0.3]}"),
        ("sigma: {start: 0.05, stop: 0.15, num: 5}", "sigma: {values: [0, 0.1, 0.3]}"),
        ("V: {start: 0, stop: 10, num: 11}", "V: {values: [0, 1, 3]}"),
    ],
)
def test_one_axis_of_ones_own_is_too_much_for_paraview(tmp_path, equal_steps, own_values):
    path = run_scan(config_of(EQUAL.replace(equal_steps, own_values), tmp_path)).path
    with h5py.File(path) as file:
        assert file["lam"].size * file["sigma"].size * file["V"].size == file["stable"].size < 385
        assert "VTKHDF" not in file


def test_paraviews_arrays_take_no_place_of_their_own(equal):
    with h5py.File(equal[0]) as file:
        for name, data in file["VTKHDF/PointData"].items():
            assert data == file[name]


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([0, 1, 2], True),
        (np.linspace(0, 0.3, 151), True),
        ([1e-9, 2e-9, 4e-9], False),
        ([0, 1, 2.001], False),
    ],
)
def test_equal_steps(values, expected):
    assert uniform(np.array(values, float)) is expected


# --- reading it with bikestab


def test_volume_tells_what_was_computed(equal):
    path, config = equal
    for given in (path, str(path), path.parent):
        with Volume(given) as volume:
            assert volume.path == path
            assert volume.bicycle.numbers() == config.machine.numbers()
            assert volume.model == "refined"
            assert volume.fields == ["stable", "violated", "growth_rate", *CONDITIONS]
            np.testing.assert_array_equal(volume.axis("sigma"), config.grid.values("sigma"))


def test_volume_keeps_the_damping_and_the_model(tmp_path):
    config = config_of(EQUAL + "delta: 1.5\nmodel: unrefined\n", tmp_path)
    with Volume(run_scan(config).path) as volume:
        assert (volume.bicycle.delta, volume.model) == (1.5, "unrefined")


def test_a_scan_that_is_not_finished(tmp_path):
    (tmp_path / "volume.h5.tiles").touch()
    for path in (tmp_path, tmp_path / "volume.h5"):
        with pytest.raises(
            InputError, match="holds a scan that is not finished\n'bikestab scan CONFIG' goes on"
        ):
            Volume(path)


def set_incomplete(path):
    with h5py.File(path, "a") as file:
        file.attrs["complete"] = np.int32(0)


def drop_complete(path):
    with h5py.File(path, "a") as file:
        del file.attrs["complete"]


def truncate(path):
    path.write_bytes(path.read_bytes()[:-2000])


def foreign(path):
    with h5py.File(path, "w") as file:
        file["lam"] = [1.0]


@pytest.mark.parametrize(
    ("harm", "problem"),
    [
        (set_incomplete, "is incomplete"),
        (drop_complete, "is incomplete"),
        (truncate, r"is cut off: \d+ of its \d+ bytes are there"),
        (foreign, "is an HDF5 file, but no volume of bikestab"),
        (lambda path: path.write_text("lam, sigma, V\n"), "is not an HDF5 file"),
        (lambda path: path.write_bytes(b""), "is empty"),
        (lambda path: path.unlink(), "there is no such volume"),
    ],
    ids=["incomplete", "no complete", "cut off", "foreign", "text", "empty", "none"],
)
def test_what_is_no_whole_volume_is_refused(equal, tmp_path, harm, problem):
    path = tmp_path / "copy.h5"
    shutil.copy(equal[0], path)
    harm(path)
    with pytest.raises(InputError, match=problem) as caught:
        Volume(path)
    assert str(caught.value).startswith(str(path))


def test_a_volume_that_another_program_writes_to(equal, tmp_path):
    path = shutil.copy(equal[0], tmp_path / "copy.h5")
    holder = "import h5py, sys; f = h5py.File(sys.argv[1], 'a'); print('open', flush=True); sys.stdin.read()"
    with subprocess.Popen(
        [sys.executable, "-c", holder, path], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        other.stdout.readline()
        with pytest.raises(InputError, match="is being written to by another program"):
            Volume(path)
        other.stdin.close()
    Volume(path).file.close()


def test_a_flipped_byte_is_noticed(equal, tmp_path):
    path = tmp_path / "copy.h5"
    shutil.copy(equal[0], path)
    with h5py.File(path) as file:
        offset = file["growth_rate"].id.get_chunk_info(0)
    data = bytearray(path.read_bytes())
    data[offset.byte_offset + offset.size // 2] ^= 0x10
    path.write_bytes(data)
    with Volume(path) as volume, pytest.raises(OSError, match="filter"):
        volume.file["growth_rate"][()]
