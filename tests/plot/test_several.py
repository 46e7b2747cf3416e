"""Pictures of several machines: a curve each, every one with its name, none on another's."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.plot.ends import draw_ends
from bikestab.plot.growth import draw_growth
from bikestab.plot.sidelabels import MOST, lines_for, spread
from bikestab.region.answers import stable_speeds


def presets(*names):
    return [(name, bike := Bicycle.preset(name), bike.lam, bike.sigma, "refined") for name in names]


def names_in(figure):
    return [text.get_text() for text in figure.axes[0].texts]


def test_growth_rates_have_a_curve_a_name_and_the_exact_ends():
    figure = draw_growth(presets("meijaard2007", "sharp1971", "kooijman2011"), 0, 10)
    assert names_in(figure) == ["meijaard2007", "sharp1971", "kooijman2011"]
    dots = [line.get_xdata() for line in figure.axes[0].lines if line.get_marker() == "o"]
    assert dots[0] == pytest.approx([4.292382536341, 6.024262015388], abs=1e-11)
    assert len(dots[2]) == 1  # without an upper limit


def test_ends_over_a_range_and_as_bars():
    machines = [
        (name, stable_speeds(bike, lam, np.linspace(0.01, 0.1, 10), nearest=False))
        for name, bike, lam, _, _ in presets("meijaard2007", "kooijman2011")
    ]
    (ax,) = draw_ends(machines, "trail").axes
    V1 = ax.lines[0]
    assert V1.get_ydata()[3] == machines[0][1][3]["intervals"][0]["V1"]
    assert V1.get_xdata()[3] == pytest.approx(0.04 * 1.02)
    own = [
        (name, stable_speeds(bike, lam, sigma))
        for name, bike, lam, sigma, _ in presets("sharp1971", "meijaard2007")
    ]
    figure = draw_ends(own, "")
    assert [bar.get_x() for bar in figure.axes[0].patches] == [
        own[0][1][0]["intervals"][0]["V1"],
        pytest.approx(4.2923825),
    ]


def test_intervals_of_other_kinds_are_not_joined():
    """The paper's bicycle at σ = 0.15: from 0.048 rad on a second, separate interval is there."""
    answers = stable_speeds(Bicycle.preset("dikarev1981"), np.linspace(0.03, 0.1, 60), 0.15, nearest=False)
    (ax,) = draw_ends([("paper", answers)], "lam").axes
    runs = [line for line in ax.lines if line.get_linewidth() == 2.2]
    assert len(runs) >= 2
    for line in runs:
        assert np.abs(np.diff(line.get_ydata())).max(initial=0) < 12


def test_too_many_curves():
    assert len({*lines_for(MOST)}) == MOST
    with pytest.raises(InputError, match=f"allowed: {MOST}"):
        lines_for(MOST + 1)


@given(st.lists(st.floats(0, 1), max_size=12))
def test_labels_are_apart_and_in_order(wanted):
    places = spread(np.array(wanted), 0.04)
    order = np.argsort(wanted, kind="stable")
    assert np.all(np.diff(places[order]) >= 0.04 - 1e-12)
    far = np.diff(np.array(wanted)[order], prepend=-math.inf, append=math.inf)
    alone = (far[:-1] > 0.5) & (far[1:] > 0.5)  # with room for all others
    assert places[order][alone] == pytest.approx(np.array(wanted)[order][alone], abs=0.25)
