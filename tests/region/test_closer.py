"""Curves of the ends of stable intervals along a range, between the values that were asked for."""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.region.answers import stable_speeds, stable_speeds_over
from bikestab.region.closer import FEWEST, closer
from bikestab.region.nearest import nearest_stable
from bikestab.stability import stable_intervals

PAPER = Bicycle.preset("dikarev1981")


def drawn(bicycle, name, values, other):
    def at(new):
        designs = {"lam": other, "sigma": other, name: new}
        return stable_speeds(bicycle, **designs, nearest=False)

    return at(values), closer(values, at(values), at)


@pytest.mark.parametrize("num", [2, 5, 51, 400])
def test_an_interval_is_closed_where_it_begins(num):
    """At the trail and the tilt that another search of the region finds, by other equations."""
    known = nearest_stable(Family(PAPER), 0.1, 0.05)
    for name, values, other, end in (
        ("sigma", np.linspace(0.05, 0.15, num), 0.1, known["sigma_min"]),
        ("lam", np.linspace(0.05, 0.3, num), 0.05, known["lam_min"]),
    ):
        asked, found = drawn(PAPER, name, values.tolist(), other)
        x = [answer[name] for answer in found]
        assert x == sorted(x)
        assert max(np.diff(x)) <= (1 + 1e-9) * (values[-1] - values[0]) / (FEWEST - 1)
        assert [answer for answer in found if answer in asked] == asked
        first = next(answer for answer in found if answer["intervals"])
        (interval,) = first["intervals"]
        assert first[name] == pytest.approx(end, abs=1e-9)
        assert interval["V2"] - interval["V1"] < 1e-4


@pytest.mark.parametrize("lam", [0.1, 0.25])
def test_what_is_drawn_is_so_at_every_value(lam):
    _, found = drawn(PAPER, "sigma", np.linspace(-0.1, 0.2, 4).tolist(), lam)
    exact = stable_intervals(PAPER, lam, np.array([answer["sigma"] for answer in found]))
    assert [len(answer["intervals"]) for answer in found] == exact.number.tolist()
    V1 = [interval["V1"] for answer in found for interval in answer["intervals"][:1]]
    np.testing.assert_array_equal(V1, exact.V1[exact.number > 0, 0])


def test_curves_bend_nowhere_by_more_than_is_seen():
    """A straight line between neighbours misses what is in the middle by less than a quarter of a pixel."""
    bicycle = Bicycle.preset("meijaard2007")
    values = np.radians([60, 70, 80]).tolist()

    def at(new):
        return [answer for _, answer in stable_speeds_over(bicycle, {"head_angle": new})]

    found = closer(values, at(values), at)
    x = np.array([answer["head_angle_deg"] for answer in found])
    V1 = np.array([answer["intervals"][0]["V1"] for answer in found])
    middle = at(np.radians(0.5 * (x[1:] + x[:-1])).tolist())
    true = np.array([answer["intervals"][0]["V1"] for answer in middle])
    pixel = 8.7 / 714  # m/s in the picture
    assert np.abs(true - 0.5 * (V1[1:] + V1[:-1])).max() < 0.25 * pixel
