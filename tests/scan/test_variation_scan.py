"""Scans over many machines: a sweep's axes and an ensemble's probabilities in the volume."""

import json

import h5py
import numpy as np
import pytest

from bikestab import yamltext
from bikestab.config.file import parse_config
from bikestab.errors import InputError
from bikestab.plot.slices import draw_slice
from bikestab.scan.ensemble import ensemble_statistics
from bikestab.scan.run import run_scan
from bikestab.volume import Volume

netCDF4 = pytest.importorskip("netCDF4")
xarray = pytest.importorskip("xarray")

GRID = """\
bicycle: BICYCLE
grid:
  lam: {start: 0.1, stop: 0.5, num: 9}
  sigma: {start: 0.03, stop: 0.13, num: 6}
  V: {start: 0, stop: 9, num: 19}
output: OUT
"""
SWEEP = "sweep: {delta: [0, 2], mB: {start: 70, stop: 90, num: 3}}\n"
ENSEMBLE = "ensemble: {mB: {normal: [85, 8]}, delta: {uniform: [0, 1]}, samples: 40, seed: 3}\n"


def config_of(folder, more="", bicycle="meijaard2007"):
    text = GRID.replace("OUT", str(folder)).replace("BICYCLE", bicycle) + more
    return parse_config(yamltext.parse(text, "scan.yaml"))


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    config = config_of(tmp_path_factory.mktemp("swept"), SWEEP)
    return run_scan(config).path, config


@pytest.fixture(scope="module")
def spread(tmp_path_factory):
    config = config_of(tmp_path_factory.mktemp("spread"), ENSEMBLE)
    return run_scan(config).path, config


def datasets(file):
    names = []
    file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
    return names


def test_a_sweep_holds_what_a_scan_of_each_machine_does(swept, tmp_path):
    path, config = swept
    total = 0
    with h5py.File(path) as file:
        assert file["stable"].shape == (2, 3, 9, 6, 19)
        np.testing.assert_array_equal(file["mB"], [70, 80, 90])
        for k, (values, bicycle) in enumerate(config.members):
            own = tmp_path / f"{k}.yaml"
            numbers = {**bicycle.given, "delta": bicycle.delta}
            own.write_text("".join(f"{name}: {value!r}\n" for name, value in numbers.items()))
            one = run_scan(config_of(tmp_path / str(k), bicycle=str(own)))
            total += one.stable_points
            index = (int(values["delta"] == 2), k % 3)
            with h5py.File(one.path) as alone:
                for name in ("stable", "violated", "growth_rate", "V1", "V2", "lower", "upper"):
                    expected = alone[name][()]
                    found = file[name][index][..., : expected.shape[-1]]
                    np.testing.assert_array_equal(found, expected, err_msg=f"{name} {values}")
                for name in datasets(alone["boundary"]):
                    expected = np.sort(alone["boundary"][name], axis=-1)
                    found = np.sort(file["boundary"][name][index], axis=-1)
                    np.testing.assert_array_equal(np.nansum(found, -1), np.nansum(expected, -1))
        assert file.attrs["stable_points"] == total > 0
        assert "VTKHDF" not in file


def test_xarray_chooses_a_machine_by_its_values(swept):
    path, config = swept
    for engine in ("h5netcdf", "netcdf4"):
        with xarray.open_dataset(path, engine=engine) as data:
            assert data.growth_rate.dims == ("delta", "mB", "lam", "sigma", "V")
            assert data.delta.attrs["units"] == "kg m2 s-1"
            assert data.mB.attrs["units"] == "kg"
            one = data.sel(delta=2, mB=90)
            names = data.machine.attrs["names"].split()
            row = dict(zip(names, one.machine.values, strict=True))
            assert row["m1"] == pytest.approx(config.members[-1].bicycle.m1)
            assert (row["delta"], bool(one.stable.any())) == (2, True)


def test_a_volume_of_one_machine(swept):
    path, config = swept
    with Volume(path) as volume:
        for values, bicycle in config.members:
            one = volume.at(values)
            assert one.bicycle.numbers() == bicycle.numbers()
            assert one.read("stable").shape == (9, 6, 19)
            assert one.read("stable", (3,)).shape == (6, 19)
            assert one.axis("lam").shape == (9,)
        assert volume.at({"mB": 80, "delta": 2}).title.endswith("(delta = 2, mB = 80)")
        draw_slice(volume.at({"delta": 2, "mB": 80}), "lam", 0.3)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (
            {},
            "has several machines, with delta = 0, 2 and mB = 70, 80, 90\nchoose one, for example --at delta",
        ),
        ({"delta": 2}, "has several machines, with mB = 70, 80, 90"),
        ({"delta": 1, "mB": 80}, "has no delta = 1\nallowed: 0, 2"),
        ({"detla": 2, "mB": 80}, "has no axis 'detla'\ndid you mean 'delta'?"),
    ],
)
def test_a_machine_that_is_not_there(swept, values, message):
    with Volume(swept[0]) as volume, pytest.raises(InputError) as caught:
        volume.at(values)
    assert message in str(caught.value)


def test_a_volume_without_a_sweep_has_one_machine(spread):
    with Volume(spread[0]) as volume:
        assert volume.at({}).bicycle.numbers() == volume.bicycle.numbers()
        with pytest.raises(InputError, match="its config has no sweep"):
            volume.at({"delta": 1})


def test_an_ensemble_is_that_of_its_module(spread):
    path, config = spread
    lam, sigma, V = (config.grid.values(name) for name in ("lam", "sigma", "V"))
    cells = np.repeat(lam, 6), np.tile(sigma, 9)
    ensemble = config.ensemble
    expected = ensemble_statistics(config.family(), ensemble.drawn, *cells, V, ensemble.quantiles)
    with h5py.File(path) as file:
        np.testing.assert_array_equal(file["probability"][()].reshape(54, 19), expected.probability)
        np.testing.assert_array_equal(file["probability_somewhere"][()].ravel(), expected.somewhere)
        np.testing.assert_array_equal(file["probability_unbounded"][()].ravel(), expected.unbounded)
        for name in ("V1", "V2"):
            found = file[f"{name}_quantiles"][()]
            np.testing.assert_array_equal(found.reshape(54, 5), getattr(expected, name))
        np.testing.assert_array_equal(file["quantile"], [0.05, 0.25, 0.5, 0.75, 0.95])
        assert 0 < file["probability"][()].mean() < 1
        assert file.attrs["ensemble_samples"] == 40
        assert file["probability"] == file["VTKHDF/PointData/probability"]
    with xarray.open_dataset(path, engine="netcdf4") as data:
        assert data.V2_quantiles.dims == ("lam", "sigma", "quantile")


def test_the_other_fields_are_of_the_bicycle_as_it_stands(spread, tmp_path):
    with h5py.File(spread[0]) as a, h5py.File(run_scan(config_of(tmp_path)).path) as b:
        for name in ("stable", "growth_rate", "V1", "boundary/hurwitz3"):
            np.testing.assert_array_equal(a[name][()], b[name][()])


def test_a_sweep_of_ensembles(spread, tmp_path):
    """The draws are the same at each machine, and those of a scan without the sweep."""
    more = "sweep: {mH: [3.9, 4.0]}\n" + ENSEMBLE
    with h5py.File(run_scan(config_of(tmp_path, more)).path) as file, h5py.File(spread[0]) as one:
        np.testing.assert_array_equal(file["probability"][1], one["probability"][()])
        np.testing.assert_array_equal(file["V1_quantiles"][1], one["V1_quantiles"][()])
        assert (file["probability"][0] != file["probability"][1]).any()


def test_a_sweep_of_ensembles_of_several_tiles(tmp_path):
    """A plane that is cut has the sheets of a scan of its machine alone."""
    wide, more = ("num: 9", "num: 19"), ENSEMBLE.replace("40", "4")
    both, one = (
        parse_config(yamltext.parse(text.replace(*wide).replace("OUT", str(tmp_path / name)), "scan.yaml"))
        for name, text in (
            ("both", GRID.replace("BICYCLE", "meijaard2007") + "sweep: {mH: [3.9, 4.0]}\n" + more),
            ("one", GRID.replace("BICYCLE", "meijaard2007") + more),
        )
    )
    with h5py.File(run_scan(both).path) as file, h5py.File(run_scan(one).path) as alone:
        for name in ("stable", "V1", "lower", "probability", "boundary/hurwitz3", "boundary/p0_edge"):
            np.testing.assert_array_equal(file[name][1], alone[name][()], err_msg=name)


def test_pictures_of_the_probability(spread, swept):
    with Volume(spread[0]) as volume:
        axes = draw_slice(volume, "sigma", 0.081, "probability").axes
        assert "σ = 0.09" in axes[0].get_title()  # the nearest plane of the grid, which the title names
        assert axes[1].get_ylabel() == "probability (40 machines)"
    with Volume(swept[0]) as volume, pytest.raises(InputError, match="has no probability"):
        draw_slice(volume.at({"delta": 0, "mB": 70}), "sigma", 0.08, "probability")


def test_the_bicycles_numbers_are_in_the_file(spread):
    with h5py.File(spread[0]) as file:
        assert json.loads(file.attrs["bicycle_parameters"])["c"] == 1.02
