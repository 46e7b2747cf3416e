"""Machines at the limits: their scans end without a warning, and the ways to the critical speeds agree."""

import math

import numpy as np
import pytest

from bikestab.bicycle import Bicycle, parameters
from bikestab.config.scanconfig import ScanConfig
from bikestab.scan.run import run_scan
from bikestab.volume import Volume

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")
PRESETS = ("dikarev1981", "meijaard2007", "sharp1971", "kooijman2011")
ENDS = (1e-9, 1e-6, 1e-3, 1, 1e3, 1e6, 1e9)


def machine(rng):
    """A preset with some parameters zero, negative, far from what they were or at their limits."""
    n = Bicycle.preset(str(rng.choice(PRESETS))).numbers()
    for p in parameters():
        if p.name in ("lam", "sigma") or rng.random() > 0.3:
            continue
        check = p.metadata["check"]
        value = rng.choice(ENDS) if rng.random() < 0.5 else (n[p.name] or 1) * 10 ** rng.uniform(-4, 4)
        value *= 0 if check != "positive" and rng.random() < 0.3 else 1
        n[p.name] = -value if check == "" and rng.random() < 0.3 else value
    for i in "12":
        limit = math.sqrt(n["A" + i] * n["B" + i])
        if abs(n["D" + i]) > limit or rng.random() < 0.2:
            n["D" + i] = limit * rng.choice([-1, 0, 1])  # a thin rod is at the limit
        if n["R" + i] == 0:
            n["C" + i] = 0.0
    n["delta"] = float(rng.choice([0, 1e-12, 1e-9, 1e-6, 1e-3, 1, 1e3, 1e6]))
    return Bicycle(**{key: value if value is None else min(float(value), 1e9) for key, value in n.items()})


@pytest.mark.parametrize("seed", range(40))
def test_a_scan_of_an_extreme_machine(seed):
    """Pytest turns every warning of numpy into an error; a disagreement would be a ScanError."""
    rng = np.random.default_rng(seed)
    bicycle, width = machine(rng), 10 ** rng.uniform(-4, 2)
    axes = {
        "lam": np.unique([0, *rng.uniform(-1.4, 1.4, 5)]),
        "sigma": np.unique([0, *rng.uniform(-width, width, 5)]),
        "V": np.unique([0, *10 ** rng.uniform(-3, 6, 10)]),
    }
    config = ScanConfig(
        bicycle=bicycle, model=str(rng.choice(["refined", "unrefined"])), output="out",
        grid={name: {"values": values.tolist()} for name, values in axes.items()},
        fields=["stable", "violated", "growth_rate", "conditions"],
    )  # fmt: skip
    result = run_scan(config)
    with Volume(result.path) as volume:
        stable = volume.read("stable")
        assert np.array_equal(stable == 1, volume.read("violated") == 0)
        assert np.count_nonzero(stable) == result.stable_points
        V1, V2 = volume.read("V1"), volume.read("V2")
        assert np.array_equal(np.isnan(V1), np.isnan(V2))
        assert np.all(V1[~np.isnan(V1)] <= V2[~np.isnan(V2)])
