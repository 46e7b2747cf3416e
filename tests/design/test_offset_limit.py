"""Limits of the fork offset in a search for the best design, held against a dense grid."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.design.best import best_designs
from bikestab.design.wanted import Wanted
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.geometry import offset_of
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import intervals_of

BENCHMARK = Family(Bicycle.preset("meijaard2007"))
PAPER = Family(Bicycle.preset("dikarev1981"))


@settings(max_examples=50, deadline=None)
@given(
    st.tuples(st.floats(-0.4, 0.2), st.floats(0.001, 0.3)),
    st.lists(st.floats(-1, 1), min_size=2, max_size=2),
    st.sampled_from([BENCHMARK, PAPER]),
)  # fmt: skip
def test_points_are_moved_into_the_limits(offset, point, family):
    offset = offset[0], sum(offset)
    try:
        wanted = Wanted(family, offset=offset)
    except InputError as error:
        assert "no design of the box has an offset" in error.problem  # noqa: PT017
        return
    low, high = wanted.box
    lam, sigma = wanted.within(np.array([point]).T)[:, 0]
    bicycle = family.bicycle
    assert low[0] <= lam <= high[0]
    assert low[1] - 1e-12 <= sigma <= high[1] + 1e-12
    b = offset_of(lam, sigma, bicycle.c, bicycle.R2)
    assert offset[0] - 1e-12 <= b <= offset[1] + 1e-12
    for end, other in ((low[0], wanted.x[0]), (high[0], wanted.x[1])):  # no tilt is lost
        beyond = end + (1e-6 if end == high[0] else -1e-6)
        b = [offset_of(beyond, y, bicycle.c, bicycle.R2) for y in wanted.y]
        assert end == other or min(b) > offset[1] or max(b) < offset[0]


def test_the_widest_interval_of_forks_bent_forwards():
    wanted = Wanted(BENCHMARK, offset=(0.0, 0.08))
    best = best_designs(wanted)
    lam, sigma = np.meshgrid(np.linspace(0, 0.6, 301), np.linspace(0, 0.3, 301))
    found = intervals_of(BENCHMARK.table(lam, sigma))
    b = offset_of(lam, sigma, BENCHMARK.bicycle.c, BENCHMARK.bicycle.R2)
    wide = np.where(found.upper > 0, np.minimum(found.V2, 30) - found.V1, 0).max(axis=-1)
    wide[(b < 0) | (b > 0.08)] = 0
    assert best.widest["width"] == pytest.approx(wide.max(), abs=0.02)
    assert best.widest["width"] >= wide.max() - 1e-9
    for design in (best.widest, best.lowest_V1, best.fastest_decay, *best.pareto):
        assert -1e-9 <= design["offset"] <= 0.08 + 1e-9
    assert "limit of offset" in best.widest["at"]


def test_one_offset():
    best = best_designs(Wanted(BENCHMARK, offset=(0.045, 0.045), judged=(5, 5)))
    assert best.fastest_decay["offset"] == pytest.approx(0.045, abs=1e-12)
    assert best.own["at"] == "outside the box"
    lam = np.linspace(0.13, 0.6, 4001)
    sigma = (0.35 * np.sin(lam) - 0.045) / np.cos(lam) / 1.02
    rates = growth_rate_of(BENCHMARK.table(lam, sigma), 5.0)
    assert rates.min() - 1e-4 <= best.fastest_decay["growth_rate"] <= rates.min()  # at a kink


def test_no_design_without_upper_limit_has_a_fork_bent_forwards():
    """In the paper's box, on a grid: each that is stable from some speed on for all above has b < 0."""
    lam, sigma = np.meshgrid(np.linspace(0, 0.3, 241), np.linspace(0, 0.15, 241))
    open_above = np.isinf(intervals_of(PAPER.table(lam, sigma)).V2).any(axis=-1)
    assert open_above.any()
    assert offset_of(lam, sigma, PAPER.bicycle.c, PAPER.bicycle.R2)[open_above].max() < 0


@pytest.mark.parametrize(
    ("limits", "told"),
    [
        ({"offset": (5, 5)}, "offset: no design of the box has an offset of 5 ... 5 m"),
        ({"offset": (0.08, 0)}, "offset: the range 0.08:0 ends before it starts"),
        (
            {"offset": (0, 0.08), "x": (-1.5, 0)},
            "lam: with a limit of the offset, lam = -1.5 is",
        ),
    ],
)
def test_limits_that_cannot_be(limits, told):
    with pytest.raises(InputError) as caught:
        Wanted(PAPER, **limits)
    assert str(caught.value).startswith(told)
