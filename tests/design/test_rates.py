"""The lowest growth rate: against numpy's eigenvalues on fine grids; derivatives against differences."""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.design.rates import best_rate
from bikestab.model import characteristic_table
from bikestab.slopes import slopes_of

CASES = [
    ("meijaard2007", None, None, "crossing"),
    ("sharp1971", None, None, "crossing"),
    ("kooijman2011", None, None, "smooth"),
    ("dikarev1981", 0.2, 0.08, "crossing"),
]


def rate_of(name, lam, sigma):
    bicycle = Bicycle.preset(name)
    lam, sigma = (bicycle.lam, bicycle.sigma) if lam is None else (lam, sigma)
    return bicycle, lam, sigma, best_rate(slopes_of(bicycle, lam, sigma))


@pytest.mark.parametrize(("name", "lam", "sigma", "kind"), CASES)
def test_no_speed_of_a_fine_grid_is_better(name, lam, sigma, kind):
    bicycle, lam, sigma, found = rate_of(name, lam, sigma)
    table = characteristic_table(bicycle, lam, sigma)
    growth = [np.roots((table @ V ** np.arange(4))[::-1]).real.max() for V in np.linspace(0, 30, 3001)]
    assert found.kind == kind
    assert found.value <= min(growth) + 1e-9
    assert np.roots((table @ found.V ** np.arange(4))[::-1]).real.max() == pytest.approx(
        found.value, abs=1e-9
    )
    assert found.value == pytest.approx(min(growth), abs=0.02)


@pytest.mark.parametrize(("name", "lam", "sigma", "kind"), CASES)
def test_derivatives_are_differences(name, lam, sigma, kind):
    """Of the same search for machines that differ a little: right to the square of the step."""
    bicycle, lam, sigma, found = rate_of(name, lam, sigma)
    for each in ("g", "mB" if bicycle.bodies else "m1", "xB" if bicycle.bodies else "l1", "lam", "sigma"):
        ends = []
        for side in (1, -1):
            at = {"lam": lam, "sigma": sigma}
            value = at[each] if each in at else bicycle.given[each]
            step = 1e-5 * (abs(value) or 0.01)
            machine = bicycle
            if each in at:
                at[each] += side * step
            else:
                machine = bicycle.replaced({each: value + side * step})
            ends.append(best_rate(slopes_of(machine, at["lam"], at["sigma"])).value)
        expected = (ends[0] - ends[1]) / (2 * step)
        assert found.slope[each] == pytest.approx(expected, rel=1e-5, abs=1e-7), each


def test_a_singular_inertia_has_no_derivatives():
    point = {"c": 1, "m1": 10, "l1": 0.5, "h1": 1, "A1": 0, "B1": 0, "C1": 0, "R1": 0, "m2": 1, "l2": 1}
    point |= {"h2": 0, "A2": 0, "B2": 0, "C2": 0, "R2": 0}
    found = best_rate(slopes_of(Bicycle.from_mapping(point), 0.0, 0.0))
    assert np.isinf(found.value)
    assert np.isnan(list(found.slope.values())).all()
