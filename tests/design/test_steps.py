"""By how much a parameter must change for V1 to fall by 0.1 m/s, against machines made anew."""

import math

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.design.effects import effects
from bikestab.design.sensitivity import GEOMETRY, sensitivity
from bikestab.design.steps import LOWER, steps_to_lower
from bikestab.errors import InputError
from bikestab.stability import eigenvalues, stable_intervals

_OWN = {"meijaard2007": (), "sharp1971": (), "kooijman2011": (), "dikarev1981": (0.2, 0.08)}


def _machine(found, name, value):
    """The machine, tilt and σ with another value of one parameter, by other formulas than the library's."""
    bicycle, hold = found.bicycle, found.hold
    if name == "c" and bicycle.bodies is not None:
        name = "trail"
    if name not in GEOMETRY:
        bicycle = bicycle.replaced({name: value})
    lam = {"lam": value, "head_angle": math.pi / 2 - value}.get(name, found.lam)
    own = found.values
    offset = value if name == "offset" else own["offset"]
    if name == "sigma" or (hold == "sigma" and name not in ("trail", "offset")):
        sigma = value if name == "sigma" else found.sigma
    elif name == "offset" or (hold == "offset" and name != "trail"):
        sigma = (bicycle.R2 * math.tan(lam) - offset / math.cos(lam)) / bicycle.c
    else:
        sigma = (value if name == "trail" else own["trail"]) / bicycle.c
    return bicycle, lam, sigma


@pytest.mark.parametrize("hold", ["trail", "offset", "sigma"])
@pytest.mark.parametrize("name", [*_OWN])
def test_the_end_is_there_where_it_says(name, hold):
    found = sensitivity(Bicycle.preset(name), *_OWN[name], hold=hold)
    steps = {key: step for key, step in steps_to_lower(found, 0).items() if step is not None}
    assert len(steps) >= 5
    V = float(found.intervals.V1[0]) + LOWER
    for key, step in steps.items():
        machine, lam, sigma = _machine(found, key, found.values[key] + step)
        ends = stable_intervals(machine, lam, sigma)
        assert np.nanmin(np.abs(ends.V1 - V)) < 1e-6, key
        growth = eigenvalues(machine, V, lam, sigma).real.max()
        assert abs(growth) < 1e-5 * abs(eigenvalues(machine, V, lam, sigma)).max(), key
        assert step * found.dV1[key][0] < 0, key


def test_where_v1_turns_before_there_is_no_step():
    """The slope of xH says −69 mm, but V1 rises again; that of w leads to a machine without stable speed."""
    found = sensitivity(Bicycle.preset("meijaard2007"))
    steps = steps_to_lower(found, 0)
    none = {name for name, step in steps.items() if step is None}
    assert none >= {"xH", "w", "g", "rR", "mR", "mH", "IHzz", "IRyy", "delta", "IByy"}
    V = float(found.intervals.V1[0]) + LOWER
    for name in ("xH", "w", "mH", "IRyy"):
        for share in np.linspace(-0.99, 1.0, 40):
            try:
                machine, lam, sigma = _machine(found, name, found.values[name] * (1 + share))
            except InputError:
                continue
            ends = stable_intervals(machine, lam, sigma)
            towards = share * found.values[name] * found.dV1[name][0] < 0
            assert not (towards and ((ends.V1 <= V) & (ends.V2 > V)).any()), (name, share)


def test_a_step_is_in_the_rows_and_none_of_a_speed_below_it():
    found = sensitivity(Bicycle.preset("meijaard2007"))
    rows = {row["name"]: row for row in effects(found, 0)}
    assert rows["c"]["change"] == pytest.approx(-0.008448, abs=1e-6)
    slow = sensitivity(Bicycle.preset("dikarev1981"), 0.04834835, 0.15)
    for k, V1 in enumerate(slow.intervals.V1):
        if V1 < -LOWER:
            assert set(steps_to_lower(slow, k).values()) == {None}
