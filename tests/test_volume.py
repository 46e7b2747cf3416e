"""volume.h5: one file that h5py, netCDF-4 readers and VTK understand in the same way."""

import hashlib
import json
import shutil
import subprocess
import sys

import h5py
import numpy as np
import pytest

from bikestab import __version__, yamltext
from bikestab.bicycle import Bicycle
from bikestab.config import AXES
from bikestab.configfile import parse_config
from bikestab.errors import InputError
from bikestab.model import characteristic_table
from bikestab.routh import CONDITIONS, conditions, violated
from bikestab.scan import run_scan
from bikestab.spectrum import growth_rate
from bikestab.speeds import KINDS, stable_intervals
from bikestab.volume import Volume, uniform

netCDF4 = pytest.importorskip("netCDF4")
xarray = pytest.importorskip("xarray")

EQUAL = """\
title: a small scan
bicycle: dikarev1981
grid:
  lam: {start: 0, stop: 0.3, num: 7}
  sigma: {start: 0.05, stop: 0.15, num: 5}
  V: {start: 0, stop: 10, num: 11}
fields: [stable, violated, growth_rate, conditions]
output: OUT
"""
# (0.04834835, 0.15) has two stable intervals, the first of them 2 mm/s wide
OWN = """\
bicycle: dikarev1981
delta: 0
grid:
  lam: {values: [0, 0.015, 0.04834835, 0.2]}
  sigma: {values: [0.08, 0.1475, 0.15]}
  V: {values: [0, 1, 3, 5, 30]}
output: OUT
"""


def config_of(text, folder):
    return parse_config(yamltext.parse(text.replace("OUT", str(folder)), "scan.yaml"))


@pytest.fixture(scope="session")
def equal(tmp_path_factory):
    """A volume with equal steps and all fields, and its config."""
    config = config_of(EQUAL, tmp_path_factory.mktemp("equal"))
    return run_scan(config).path, config


@pytest.fixture(scope="session")
def own(tmp_path_factory):
    """A volume with axes of one's own values and a cell with two intervals, and its config."""
    config = config_of(OWN, tmp_path_factory.mktemp("own"))
    return run_scan(config).path, config


def columns_of(config):
    lam, sigma = config.grid.values("lam"), config.grid.values("sigma")
    return characteristic_table(config.machine, lam[:, np.newaxis], sigma, model=config.model)


def points_of(config):
    return columns_of(config)[..., np.newaxis], config.grid.values("V")


# --- what is in the file


def test_names_and_their_order(equal, own):
    with h5py.File(equal[0]) as file:
        assert list(file) == [
            "lam", "sigma", "V", "stable", "violated", "growth_rate", *CONDITIONS,
            "interval", "V1", "V2", "lower", "upper", "root", "boundary", "VTKHDF",
        ]  # fmt: skip
        assert list(file["boundary"]) == [f"{name}{end}" for name in CONDITIONS for end in ("", "_edge")]
    with h5py.File(own[0]) as file:
        assert list(file)[:6] == ["lam", "sigma", "V", "stable", "violated", "growth_rate"]
        assert not set(CONDITIONS) & set(file)
        assert "VTKHDF" not in file


@pytest.mark.parametrize(
    ("name", "dtype", "axes", "units"),
    [
        ("lam", "f8", ("lam",), "rad"),
        ("sigma", "f8", ("sigma",), "1"),
        ("V", "f8", ("V",), "m s-1"),
        ("stable", "u1", AXES, "1"),
        ("violated", "u1", AXES, "1"),
        ("growth_rate", "f4", AXES, "s-1"),
        ("p0", "f8", AXES, None),
        ("hurwitz3", "f8", AXES, None),
        ("V1", "f8", ("lam", "sigma", "interval"), "m s-1"),
        ("V2", "f8", ("lam", "sigma", "interval"), "m s-1"),
        ("lower", "u1", ("lam", "sigma", "interval"), "1"),
        ("upper", "u1", ("lam", "sigma", "interval"), "1"),
        ("boundary/p0", "f8", ("lam", "sigma", "root"), "m s-1"),
        ("boundary/hurwitz3_edge", "u1", ("lam", "sigma", "root"), "1"),
    ],
)
def test_type_axes_and_unit(equal, name, dtype, axes, units):
    with h5py.File(equal[0]) as file:
        data = file[name]
        assert data.dtype == np.dtype(dtype)
        assert data.shape == tuple(len(file[axis]) for axis in axes)
        assert data.attrs.get("units") == (units and units.encode())
        if len(axes) > 1:
            assert [dim[0].name for dim in data.dims] == [f"/{axis}" for axis in axes]


def test_flags(equal):
    with h5py.File(equal[0]) as file:
        for name, meanings in (
            ("stable", b"unstable stable"),
            ("lower", " ".join(KINDS).encode()),
            ("upper", b"none weave capsize rest unbounded"),
            ("boundary/p0_edge", b"no_edge edge"),
        ):
            attributes = file[name].attrs
            assert attributes["flag_meanings"] == meanings
            np.testing.assert_array_equal(attributes["flag_values"], range(len(meanings.split())))
            assert attributes["flag_values"].dtype == file[name].dtype
        masks = file["violated"].attrs
        np.testing.assert_array_equal(masks["flag_masks"], [1, 2, 4, 8, 16, 32])
        assert masks["flag_meanings"].split() == [f"{name}_not_positive".encode() for name in CONDITIONS]


def test_attributes_of_the_file(equal):
    path, config = equal
    with h5py.File(path) as file:
        a = dict(file.attrs)
    assert (a["title"], a["Conventions"], a["complete"]) == ("a small scan", b"CF-1.11", 1)
    assert a["bikestab_version"] == __version__
    assert a["config"] == config.text
    assert a["config_sha256"] == hashlib.sha256(a["config"].encode()).hexdigest()
    assert (a["bicycle"], a["model"]) == ("dikarev1981", "refined")
    assert Bicycle(**json.loads(a["bicycle_parameters"])).numbers() == config.machine.numbers()
    assert a["warnings"].splitlines() == list(config.machine.warnings)


def test_only_filters_that_every_reader_has(equal):
    def check(name, item):
        if isinstance(item, h5py.Dataset):
            assert item.compression in (None, "gzip"), name

    with h5py.File(equal[0]) as file:
        file.visititems(check)


# --- the values


def test_fields_are_the_conditions_and_the_growth_rate(equal):
    path, config = equal
    values = conditions(*points_of(config))
    with h5py.File(path) as file:
        for name in CONDITIONS:
            np.testing.assert_array_equal(file[name][()], getattr(values, name))
        mask = file["violated"][()]
        np.testing.assert_array_equal(mask, violated(values))
        np.testing.assert_array_equal(file["stable"][()], mask == 0)
        growth = growth_rate(*points_of(config)).astype("f4")
        np.testing.assert_array_equal(file["growth_rate"][()], growth)
        assert file.attrs["stable_points"] == np.count_nonzero(mask == 0) > 0
        assert np.array_equal(growth < 0, mask == 0)


def test_axes_are_in_the_order_lam_sigma_V(equal):
    path, config = equal
    one = characteristic_table(config.machine, 0.2, 0.075)
    with h5py.File(path) as file:
        i, j = (
            int(np.argmin(abs(file[name][()] - value))) for name, value in (("lam", 0.2), ("sigma", 0.075))
        )
        np.testing.assert_allclose(file["p0"][i, j], conditions(one, file["V"][()]).p0, rtol=1e-12, atol=1e-9)


def test_intervals_are_the_exact_ones(equal, own):
    for path, config in (equal, own):
        expected = stable_intervals(columns_of(config))
        with h5py.File(path) as file:
            for name, values in expected._asdict().items():
                np.testing.assert_array_equal(file[name][()], values)
            np.testing.assert_array_equal(file["interval"], range(1, expected.V1.shape[-1] + 1))


def test_none_two_and_unbounded(own):
    with h5py.File(own[0]) as file:
        assert file["V1"].shape == (4, 3, 2)
        assert np.isnan(file["V1"][0, 0]).all()
        assert np.isnan(file["V2"][0, 0]).all()
        np.testing.assert_array_equal(file["upper"][0, 0], [KINDS.index("none")] * 2)
        np.testing.assert_allclose(file["V1"][2, 2], [2.29028220552093, 24.3336629091697], rtol=1e-9)
        np.testing.assert_allclose(file["V2"][2, 2], [2.29184343868330, np.inf], rtol=1e-9)
        assert [KINDS[k] for k in file["lower"][2, 2]] == ["capsize", "weave"]
        assert [KINDS[k] for k in file["upper"][2, 2]] == ["weave", "unbounded"]
        assert np.isnan(file["V1"][1, 1, 1])
        np.testing.assert_allclose(file["V1"][1, 1, 0], 3.62107, atol=5e-6)


def test_stable_points_lie_inside_the_intervals(equal):
    with h5py.File(equal[0]) as file:
        V = file["V"][()]
        inside = (file["V1"][()][..., np.newaxis] < V) & (file["V2"][()][..., np.newaxis] > V)
        np.testing.assert_array_equal(file["stable"][()], inside.any(axis=2))


@pytest.mark.parametrize("fields", ["[stable]", "[growth_rate]", "[violated, stable]", "[conditions]"])
def test_only_the_fields_that_are_asked_for(fields, tmp_path):
    config = config_of(EQUAL.replace("[stable, violated, growth_rate, conditions]", fields), tmp_path)
    with Volume(run_scan(config).path) as volume:
        words = fields.strip("[]").split(", ")
        wanted = set(CONDITIONS) if words == ["conditions"] else set(words)
        assert set(volume.fields) == wanted
        assert set(volume.file["VTKHDF/PointData"]) == wanted


def test_the_same_config_gives_the_same_bytes(equal):
    path, config = equal
    before = path.read_bytes()
    assert run_scan(config, force=True).computed
    assert path.read_bytes() == before


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
        expected = growth_rate(characteristic_table(config.machine, 0.2, 0.075), 5.0)
        assert float(at.growth_rate) == pytest.approx(float(expected), rel=1e-6)
    with xarray.open_dataset(path, engine=engine, group="boundary") as data:
        assert data.p0.dims == ("lam", "sigma", "root")
    with xarray.open_dataset(own[0], engine=engine) as data:
        assert np.isposinf(data.V2[2, 2, 1])
        assert np.isnan(data.V2[0, 0, 0])
        np.testing.assert_array_equal(data.lam, own[1].grid.values("lam"))


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
        (truncate, "is not an HDF5 file, or a damaged one"),
        (foreign, "is an HDF5 file, but no volume of bikestab"),
        (lambda path: path.write_text("lam, sigma, V\n"), "is not an HDF5 file"),
        (lambda path: path.write_bytes(b""), "is not an HDF5 file"),
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
