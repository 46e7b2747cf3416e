"""The gradients of V1 and V2 in a volume are the exact derivatives of each design."""

import numpy as np
import pytest

import bikestab as bs
from bikestab.bicycle import Bicycle
from bikestab.geometry import trail_from
from tests.configs import load

GRIDS = {
    "tilt and trail": "lam: {values: [0.1, 0.25, 0.3]}\n  sigma: {values: [0.05, 0.08, 0.12]}",
    "load and offset": "x: {name: mB, values: [60, 85]}\n  y: {name: offset, values: [0, 30mm]}",
    "gains": "x: {name: k_phidot, values: [-20, 0]}\n  y: {name: delta, values: [0, 1]}",
}
TEXT = "bicycle: meijaard2007\ngrid:\n  {}\n  V: {{values: [1, 5]}}\nfields: [dV1]\n"
MEIJAARD = Bicycle.preset("meijaard2007")


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def derivatives(axes, values):
    """Those of one design, in twice double precision."""
    if axes == ("lam", "sigma"):
        return bs.sensitivity(MEIJAARD, *values, hold="sigma")
    given = dict(zip(axes, values, strict=True))
    if "offset" in given:
        given["c"] = float(trail_from(MEIJAARD.lam, given.pop("offset"), MEIJAARD.R2))
    return bs.sensitivity(MEIJAARD.replaced(given))


@pytest.mark.parametrize("grid", GRIDS.values(), ids=GRIDS)
def test_gradients_are_the_derivatives_of_each_design(grid):
    config = load(TEXT.format(grid))
    with bs.scan(config).open() as volume:
        x, y, _ = volume.axes
        assert volume.fields == ["stable"]
        for i, a in enumerate(volume.axis(x)):
            for j, b in enumerate(volume.axis(y)):
                found = derivatives((x, y), (float(a), float(b)))
                number = int(found.intervals.number)
                for name in (x, y):
                    for end, slopes in (("V1", found.dV1), ("V2", found.dV2)):
                        stored = volume.read(f"d{end}_d{name}")[i, j]
                        expected = np.full(len(stored), np.nan)
                        if name in slopes:
                            expected[:number] = slopes[name]
                        else:  # a gain that is zero here is no parameter of the machine yet
                            near = [
                                bs.stable_intervals(MEIJAARD.replaced({y: float(b), name: h}))
                                for h in (1e-4, -1e-4)
                            ]
                            expected[:number] = (getattr(near[0], end) - getattr(near[1], end)) / 2e-4
                            np.testing.assert_allclose(stored, expected, rtol=1e-6)
                            continue
                        np.testing.assert_allclose(stored, expected, rtol=2e-9, atol=1e-12)
        assert np.isfinite(volume.read(f"dV1_d{x}")).any()
        with volume.to_xarray() as data:
            assert data[f"dV2_d{y}"].dims == (x, y, "interval")
    assert config.sha256 != load(TEXT.format(grid), "fields=[stable]").sha256


def test_a_sweep_has_gradients_of_each_machine():
    text = TEXT.format(GRIDS["tilt and trail"]) + "sweep: {mB: [60, 85]}\n"
    with bs.scan(load(text)).open() as volume:
        one = volume.at({"mB": 60})
        found = bs.sensitivity(MEIJAARD.replaced({"mB": 60.0}), 0.25, 0.08, hold="sigma")
        stored = one.read("dV1_dlam")[1, 1]
        np.testing.assert_allclose(stored[: len(found.dV1["lam"])], found.dV1["lam"], rtol=2e-9)
