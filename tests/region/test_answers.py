"""Stable speeds of many designs as records."""

import pytest

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.records import interval_records
from bikestab.region.answers import stable_speeds
from bikestab.region.nearest import nearest_stable
from bikestab.stability import stable_intervals

PAPER, BENCHMARK = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")


def test_every_combination_in_order():
    found = stable_speeds(PAPER, [0.1, 0.2], [0.08, 0.1, 0.15])
    assert [(a["lam"], a["sigma"]) for a in found] == [
        (lam, sigma) for lam in (0.1, 0.2) for sigma in (0.08, 0.1, 0.15)
    ]
    for answer in found:
        lam, sigma = answer["lam"], answer["sigma"]
        assert answer["intervals"] == interval_records(stable_intervals(PAPER, lam, sigma))
        none = not answer["intervals"]
        assert answer["nearest"] == (nearest_stable(Family(PAPER), lam, sigma) if none else None)
    assert [bool(a["nearest"]) for a in found] == [True, True, False, False, False, False]
    assert all(a["nearest"] is None for a in stable_speeds(PAPER, [0.1], [0.08], nearest=False))


def test_its_own_design():
    (answer,) = stable_speeds(BENCHMARK)
    assert (answer["lam"], answer["sigma"]) == (BENCHMARK.lam, BENCHMARK.sigma)
    assert answer["intervals"][0]["V1"] == pytest.approx(4.29238253634111)
    with pytest.raises(InputError) as caught:
        stable_speeds(PAPER, [0.1])
    assert caught.value.key == ("sigma",)
