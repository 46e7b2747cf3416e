"""What would help a design that has no stable speed."""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.limits import MOST_SPEED
from bikestab.model import exact_table
from bikestab.region import lines
from bikestab.region.lines import Line, Samples
from bikestab.region.nearest import LAM_RANGE, SIGMA_RANGE, V_MAX, nearest_stable, rounded
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of
from tests.references.run_extremes import machine

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")


def stable(bicycle, lam, sigma, model="refined"):
    return intervals_of(exact_table(bicycle, lam, sigma, model=model)).number > 0


@pytest.fixture(scope="module")
def found():
    """The paper's bicycle at (0.1, 0.08), which it calls never stable."""
    return nearest_stable(Family(DIKAREV), 0.1, 0.08)


def test_keys_and_their_order(found):
    assert list(found) == ["sigma_min", "sigma_max", "lam_min", "lam_max", "V", "growth_rate"]
    assert found["sigma_max"] is None
    assert all(type(value) is float for key, value in found.items() if key != "sigma_max")


def test_sigma_min_separates(found):
    sigma = found["sigma_min"]
    assert stable(DIKAREV, 0.1, sigma)
    assert not stable(DIKAREV, 0.1, sigma - 1e-12)
    assert not stable(DIKAREV, 0.1, np.linspace(0.08, sigma - 1e-9, 5001)).any()


def test_lam_min_separates(found):
    lam = found["lam_min"]
    assert stable(DIKAREV, lam, 0.08)
    assert not stable(DIKAREV, lam - 1e-12, 0.08)
    assert not stable(DIKAREV, np.linspace(0.1, lam - 1e-9, 5001), 0.08).any()
    assert stable(DIKAREV, np.linspace(lam, found["lam_max"], 5001), 0.08).all()


def test_the_upper_end_of_the_search_is_the_upper_end(found):
    assert found["lam_max"] == LAM_RANGE[1]


def test_a_range_of_lam_with_two_ends():
    """The benchmark bicycle with damping is stable at σ = 0.25 for λ around 0.07 and above 0.11 rad."""
    bicycle = MEIJAARD.with_delta(2.0)
    near = nearest_stable(Family(bicycle), 0.05, 0.25)
    low, high = near["lam_min"], near["lam_max"]
    assert 0.05 < low < high < 0.1
    for inside, outside in ((low, low - 1e-12), (high, high + 1e-12)):
        assert stable(bicycle, inside, 0.25)
        assert not stable(bicycle, outside, 0.25)
    assert nearest_stable(Family(bicycle), 0.1, 0.25)["lam_min"] > 0.1


def test_the_nearer_of_two_ranges_of_lam():
    """At σ = 0.1475 the paper's bicycle has stable speeds at small and at larger λ, with a gap between."""
    sigma, lams = 0.1475, np.linspace(*LAM_RANGE, 6001)
    good = stable(DIKAREV, lams, sigma)
    assert good[np.searchsorted(lams, 0.015)]
    starts = np.flatnonzero(np.diff(good.astype(int)) == 1)
    assert len(starts) == 2
    gap = np.flatnonzero(~good & (lams > 0.015) & (lams < 0.2))
    for index, side in ((gap[0], "lower"), (gap[-1], "upper")):
        near = nearest_stable(Family(DIKAREV), float(lams[index]), sigma)
        assert (near["lam_max"] < lams[index]) == (side == "lower")
        ends = np.array([near["lam_min"], near["lam_max"]])
        assert np.abs(ends - lams[index]).min() < 2 * (lams[1] - lams[0])


def test_nothing_helps():
    """Without the refinement, and without spinning wheels, no upright steering axis is stable."""
    bicycle = Bicycle(
        c=1, m1=80, l1=0.4, h1=0.9, A1=3, B1=6, C1=0, R1=0.35,
        m2=3, l2=0.9, h2=0.5, A2=0.1, B2=0.1, C2=0, R2=0.35,
    )  # fmt: skip
    lam, sigma = np.linspace(*LAM_RANGE, 601), np.linspace(*SIGMA_RANGE, 501)
    assert not stable(bicycle, 0.0, sigma, "unrefined").any()
    assert not stable(bicycle, lam, 0.0, "unrefined").any()
    near = nearest_stable(Family(bicycle, "unrefined"), 0.0, 0.0)
    assert [near[key] for key in ("sigma_min", "sigma_max", "lam_min", "lam_max")] == [None] * 4
    assert near["growth_rate"] > 0


def test_smaller_trails():
    """The benchmark bicycle at λ = 0.165 is stable around σ = 0.15, but no longer at 0.35."""
    near = nearest_stable(Family(MEIJAARD), 0.165, 0.35)
    assert near["sigma_min"] is None
    assert 0.15 < near["sigma_max"] < 0.35
    assert stable(MEIJAARD, 0.165, near["sigma_max"])
    assert not stable(MEIJAARD, 0.165, np.linspace(near["sigma_max"] + 1e-12, 0.35, 5001)).any()


def test_beyond_the_searched_trails():
    near = nearest_stable(Family(MEIJAARD), 0.165, 0.6)
    assert near["sigma_min"] is None
    assert stable(MEIJAARD, 0.165, near["sigma_max"])
    assert near["sigma_max"] == pytest.approx(nearest_stable(Family(MEIJAARD), 0.165, 0.35)["sigma_max"])
    far = nearest_stable(Family(MEIJAARD), MEIJAARD.lam, 1.5)["sigma_max"]
    assert not stable(MEIJAARD, MEIJAARD.lam, np.linspace(far + 1e-9, 1.5, 5001)).any()
    beside = nearest_stable(Family(MEIJAARD), 0.3, -0.6)
    assert (beside["sigma_min"] >= SIGMA_RANGE[0], beside["sigma_max"]) == (True, None)


def test_negative_trails():
    """The benchmark bicycle at σ = −0.005 is stable from 2.787 to 2.860 m/s; at −0.01 it is not."""
    near = nearest_stable(Family(MEIJAARD), MEIJAARD.lam, -0.01)
    V1, V2, _, _ = intervals_of(exact_table(MEIJAARD, MEIJAARD.lam, -0.005))
    np.testing.assert_allclose([V1[0], V2[0]], [2.786837876101, 2.860242007369], rtol=1e-12)
    assert -0.01 < near["sigma_min"] < -0.005
    assert not stable(MEIJAARD, MEIJAARD.lam, np.linspace(-0.01, near["sigma_min"] - 1e-12, 5001)).any()
    assert near["sigma_max"] is None
    assert not stable(MEIJAARD, MEIJAARD.lam, np.linspace(SIGMA_RANGE[0], -0.01, 5001)).any()


@pytest.mark.parametrize("seed", [7420, 7490])
def test_rounding_of_the_table_makes_no_ranges(seed, monkeypatch):
    """What it decides over the intervals of a table of doubles was narrowed down without end."""
    values, lam, sigma = machine(np.random.default_rng([1981, seed]))
    bicycle, looked = Bicycle.from_mapping(values), []

    def counted(table):
        looked.append(table.value[0, 0].size)
        return intervals_of(table)

    monkeypatch.setattr("bikestab.region.lines.intervals_of", counted)
    near = nearest_stable(Family(bicycle), lam, sigma)
    assert sum(looked) < 5000 + 500 * abs(sigma)  # σ = ±100: the search goes on to the design, piece by piece
    for trail in (near["sigma_min"], near["sigma_max"]):
        assert trail is None or stable(bicycle, lam, trail)


def test_what_rounding_decides_is_not_narrowed_down():
    """Two weave speeds that are one in a whole range: sharing it out finds as many changes as samples."""
    found = Samples(np.zeros(3, int), np.array([0.0, 0.5, 1.0]), np.array([0, 1, 0]), np.zeros(3, bool))
    assert lines._enclosed(Line(Family(MEIJAARD), [0.3], None), found, 1e-15) is found
    half = found._replace(clear=np.array([True, False, False]))
    assert len(lines._enclosed(Line(Family(MEIJAARD), [0.3], None), half, 1e-15).value) > 3


@pytest.mark.parametrize(
    ("preset", "values", "lam", "sigma"),
    [
        ("dikarev1981", {"k_delta_V": -40.0, "delta": 1.0}, 0.054, -0.155),
        ("dikarev1981", {"k_phi_V": -43.5, "delta": 1.0}, -0.09, 0.108),
    ],
)
def test_stable_speeds_begin_at_speeds_of_this_world(preset, values, lam, sigma):
    """Next to the trail at which they go to infinity they would begin at 1e18 m/s."""
    bicycle = Bicycle.preset(preset).replaced(values)
    trail = nearest_stable(Family(bicycle), lam, sigma)["sigma_min"]
    inside, outside = (intervals_of(exact_table(bicycle, lam, each)).V1[0] for each in (trail, trail - 1e-12))
    assert MOST_SPEED * (1 - 1e-6) < inside <= MOST_SPEED < outside
    assert growth_rate_of(exact_table(bicycle, lam, trail).value, MOST_SPEED) < 1e-3
    text = rounded(lambda value: exact_table(bicycle, lam, value), trail, 1)
    assert intervals_of(exact_table(bicycle, lam, float(text))).V1[0] < MOST_SPEED


def test_rounded_ends_are_stable():
    """Even where a range of stable designs is narrower than a unit of the sixth decimal."""
    lam, sigma = MEIJAARD.lam, nearest_stable(Family(MEIJAARD), MEIJAARD.lam, -0.01)["sigma_min"]

    def strip(values):  # stable within 1e-8 only
        table = Family(MEIJAARD).table(lam, np.asarray(values))
        return np.where(np.asarray(values) < sigma + 1e-8, table, np.nan_to_num(-np.abs(table)))

    assert (
        rounded(lambda value: Family(MEIJAARD).table(lam, value), sigma, 1)
        == f"{np.ceil(sigma * 1e6) / 1e6:.6f}"
    )
    text = rounded(strip, sigma, 1)
    assert sigma <= float(text) < sigma + 1e-8
    assert len(text.split(".")[1]) > 6


@pytest.mark.parametrize("lam", [0.0, 0.1, 0.15])
@pytest.mark.parametrize(
    "bicycle", [DIKAREV, DIKAREV.with_delta(1.0), MEIJAARD], ids=["1981", "damped", "2007"]
)
def test_the_speed_of_the_smallest_growth_rate(bicycle, lam):
    near = nearest_stable(Family(bicycle), lam, 0.02)
    table = exact_table(bicycle, lam, 0.02).value
    dense = growth_rate_of(table, np.linspace(0, V_MAX, 100_001))
    assert near["growth_rate"] == pytest.approx(float(growth_rate_of(table, near["V"])), rel=1e-12)
    assert near["growth_rate"] <= dense.min() + 1e-12
    assert near["growth_rate"] > 0
    assert 0 <= near["V"] <= V_MAX


def test_the_model_counts():
    refined, plain = (nearest_stable(Family(DIKAREV, model), 0.1, 0.08) for model in ("refined", "unrefined"))
    assert refined["sigma_min"] != plain["sigma_min"]
    if plain["sigma_min"] is not None:
        assert stable(DIKAREV, 0.1, plain["sigma_min"], "unrefined")
