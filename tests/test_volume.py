"""volume.h5: one file that h5py, netCDF-4 readers and VTK understand in the same way."""

import json

import h5py
import numpy as np
import pytest

from bikestab import __version__
from bikestab.bicycle import Bicycle
from bikestab.export.summary import summary
from bikestab.fields import AXES
from bikestab.model import exact_table
from bikestab.routh import CONDITIONS, conditions, violated
from bikestab.scan.labels import MARGINAL
from bikestab.scan.run import run_scan
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import KINDS, REASONS, intervals_of
from bikestab.volume import Volume
from tests.volumes import EQUAL, OWN, config_of


def columns_of(config):
    lam, sigma = config.grid.values("lam"), config.grid.values("sigma")
    return exact_table(config.machine, lam[:, np.newaxis], sigma, model=config.model).value


def points_of(config):
    return columns_of(config)[..., np.newaxis], config.grid.values("V")


# --- what is in the file


def test_names_and_their_order(equal, own):
    with h5py.File(equal[0]) as file:
        assert list(file) == [
            "lam", "sigma", "V", "stable", "violated", "growth_rate", *CONDITIONS,
            "interval", "V1", "V2", "lower", "upper", "V1_error", "V2_error", "marginal",
            "root", "boundary", "VTKHDF",
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
        ("V1_error", "f8", ("lam", "sigma", "interval"), "m s-1"),
        ("V2_error", "f8", ("lam", "sigma", "interval"), "m s-1"),
        ("marginal", "u1", ("lam", "sigma"), "1"),
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
            ("marginal", b"certain capsize_speed weave_speeds order_of_speeds signs width"),
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
    assert a["config_sha256"] == config_of(a["config"], path.parent).sha256
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
        growth = growth_rate_of(*points_of(config)).astype("f4")
        np.testing.assert_array_equal(file["growth_rate"][()], growth)
        assert file.attrs["stable_points"] == np.count_nonzero(mask == 0) > 0
        assert np.array_equal(growth < 0, mask == 0)


def test_axes_are_in_the_order_lam_sigma_V(equal):
    path, config = equal
    one = exact_table(config.machine, 0.2, 0.075).value
    with h5py.File(path) as file:
        i, j = (
            int(np.argmin(abs(file[name][()] - value))) for name, value in (("lam", 0.2), ("sigma", 0.075))
        )
        np.testing.assert_allclose(file["p0"][i, j], conditions(one, file["V"][()]).p0, rtol=1e-12, atol=1e-9)


def test_intervals_are_the_exact_ones(equal, own):
    for path, config in (equal, own):
        lam, sigma = config.grid.values("lam"), config.grid.values("sigma")
        expected = intervals_of(exact_table(config.machine, lam[:, np.newaxis], sigma, model=config.model))
        with h5py.File(path) as file:
            for name in ("V1", "V2", "lower", "upper", "V1_error", "V2_error"):
                np.testing.assert_array_equal(file[name][()], getattr(expected, name))
            np.testing.assert_array_equal(file["marginal"][()], expected.marginal[..., 0])
            np.testing.assert_array_equal(file["interval"], range(1, expected.V1.shape[-1] + 1))


def test_what_is_marginal(tmp_path):
    """The nearest double to a design where an interval appears, and a design beside it."""
    text = OWN.replace("[0, 0.015, 0.04834835, 0.2]", "[0.16676200182099016, 0.16676200182099019, 0.2]")
    config = config_of(text, tmp_path)
    with Volume(run_scan(config).path) as volume:
        lam, sigma = config.grid.values("lam"), config.grid.values("sigma")
        exact = intervals_of(exact_table(config.machine, lam[:, np.newaxis], sigma))
        np.testing.assert_array_equal(volume.read("marginal"), exact.marginal[..., 0])
        assert MARGINAL[volume.read("marginal", (1, 0))] == "width"
        assert np.count_nonzero(volume.read("marginal")) == 1
        assert volume.read("V1", (1, 0, 0)) == volume.read("V2", (1, 0, 0))
        assert summary(volume)["designs_marginal"] == 1
    assert len(MARGINAL) == len(REASONS)


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
