"""The ball is around the design that is told, whichever of tilt, trail and offset are free and uncertain."""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.design.around import around, values_around
from bikestab.design.ball import Ball
from bikestab.design.free import Free, best_free
from bikestab.errors import InputError
from bikestab.stability import stable_intervals

MEIJAARD = Bicycle.preset("meijaard2007")
PAPER = Bicycle.preset("dikarev1981").replaced({"lam": 0.2, "sigma": 0.08})
A, B = STABLE = (5.0, 5.4)
CASES = {
    "trail of an offset": (MEIJAARD, {"offset": (0.0, 0.08)}, {"c": 0.005}),
    "offset of a tilt": (MEIJAARD, {"lam": (0.1, 0.5)}, {"offset": 0.003}),
    "offset of a trail": (MEIJAARD, {"trail": (0.02, 0.15)}, {"offset": 0.003}),
    "tilt of trail and offset": (MEIJAARD, {"c": (0.05, 0.1), "offset": (0.02, 0.08)}, {"offset": 0.003}),
    "sigma of a wheelbase": (MEIJAARD, {"w": (0.9, 1.1)}, {"sigma": 0.01, "mB": 5.0}),
    "trail of a wheelbase": (PAPER, {"c": (0.9, 1.2)}, {"trail": 0.005, "lam": 0.01}),
    "offset of a wheel": (MEIJAARD, {"rF": (0.3, 0.4)}, {"offset": 0.003, "lam": 0.01}),
    "a part's mass of a body's": (MEIJAARD, {"mB": (60.0, 90.0)}, {"m1": 2.0}),
    "both wheels": (PAPER, {"m1": (60.0, 90.0)}, {"R": 0.01}),
}


@pytest.mark.parametrize("case", CASES)
def test_the_centre_is_the_design_and_what_is_told_of_machines_is_theirs(case):
    bicycle, ends, deviations = CASES[case]
    free = Free(bicycle, ends, stable=STABLE)
    ball = Ball(bicycle, "refined", STABLE, ends, deviations)
    x = free.first[:, :200]
    table, good = ball._tables(x, np.zeros((len(deviations), 200)))
    assert good.any()
    np.testing.assert_allclose(table, free.table(x), rtol=1e-12, atol=1e-9)
    design = dict(zip(ends, x[:, 0], strict=True))
    at = values_around(bicycle, design, dict.fromkeys(deviations, 0.0))
    for name, sd in deviations.items():
        moved = values_around(bicycle, design, {name: sd})
        assert moved[name] - at[name] == pytest.approx(sd, rel=1e-9)


def test_moves_are_those_of_other_parameters_as_they_are():
    design = {"offset": np.array([0.03, 0.05])}
    machine, lam, sigma = around(MEIJAARD, design, {})
    _, same, longer = around(MEIJAARD, design, {"c": 0.01})
    np.testing.assert_allclose(longer - sigma, 0.01 / machine.c)
    np.testing.assert_array_equal(same, lam)
    _, same, ahead = around(MEIJAARD, design, {"offset": 0.01})
    np.testing.assert_allclose((sigma - ahead) * machine.c * np.cos(lam), 0.01)
    np.testing.assert_array_equal(same, lam)


@pytest.mark.parametrize("case", ["trail of an offset", "offset of a tilt", "offset of a trail"])
def test_the_radius_is_where_the_design_loses_the_speeds(case):
    """Along the line of the one uncertain parameter, by intervals of single designs."""
    bicycle, ends, deviations = CASES[case]
    robust = best_free(Free(bicycle, ends, stable=STABLE), deviations).most_robust
    ((name, sd),) = deviations.items()
    design, radius = robust["design"], robust["radius"]
    tilt, sigma = design["lam"], design["sigma"]
    of_sigma = sd / bicycle.c if name == "c" else -sd / (bicycle.c * np.cos(tilt))

    def holds(z):
        found = stable_intervals(bicycle, lam=tilt, sigma=sigma + z * of_sigma)
        return bool(np.any((found.V1 <= A) & (found.V2 >= B)))

    assert all(holds(z) for z in np.linspace(-0.9999, 0.9999, 41) * radius)
    assert not holds(1.0001 * radius) or not holds(-1.0001 * radius)
    z = (robust["nearest"][name] - design["trail" if name == "c" else name]) / sd
    assert abs(z) == pytest.approx(radius, rel=1e-9)
    assert not holds(1.0001 * z)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("bicycle", "ends", "name"),
    [
        (MEIJAARD, {"trail": (0.02, 0.15)}, "lam"),
        (MEIJAARD, {"trail": (0.02, 0.15)}, "head_angle"),
        (MEIJAARD, {"lam": (0.1, 0.5)}, "trail"),
        (MEIJAARD, {"lam": (0.1, 0.5)}, "offset"),
        (PAPER, {"lam": (0.1, 0.5)}, "R"),
        (PAPER, {"lam": (0.1, 0.5)}, "m1"),
        *((MEIJAARD, {"lam": (0.1, 0.5)}, name) for name in ("w", "rF", "mB", "mH", "IHxx", "IHxz", "IFyy")),
    ],
)
def test_rays_go_on_where_no_machine_is(bicycle, ends, name):
    """As far as to tilts of which there are no sines, negative masses and wheelbases, and trails of 10 km."""
    ball = Ball(bicycle, "refined", STABLE, ends, {name: 10.0})
    x = np.full((1, 5), np.mean(list(ends.values())))
    z = np.array([[-100.0, -1.0, 0.0, 1.0, 100.0]])
    margin = ball.margin(x, z)
    assert np.isfinite(margin[[0, 2, 4]]).all()
    assert margin[0] == -1 or margin[4] == -1
    assert not ball.certain(x, z)[margin <= 0].any()
    reach = ball.reach(x[:, :2], np.array([[-1.0, 1.0]]))
    assert np.all((reach >= 0) & (reach <= 100))


def test_one_radius_of_wheels_that_differ_cannot_be_uncertain():
    with pytest.raises(InputError, match="two wheels that differ"):
        Ball(MEIJAARD, "refined", STABLE, {"mB": (60.0, 90.0)}, {"R": 0.01})
