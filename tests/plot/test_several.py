"""Pictures of several machines: a curve each, every one with its name, none on another's."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.text import Text
from scipy.optimize import isotonic_regression

from bikestab.against import modes_against
from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.plot.ends import draw_ends
from bikestab.plot.growth import draw_growth, draw_growth_against
from bikestab.plot.sidelabels import MOST, Curve, label_curves, lines_for, spread
from bikestab.region.answers import stable_speeds, stable_speeds_over
from bikestab.stability import growth_rate


def presets(*names):
    return [(name, bike := Bicycle.preset(name), bike.lam, bike.sigma, "refined") for name in names]


def names_in(figure):
    return [text.get_text() for text in figure.axes[0].texts]


def test_growth_rates_have_a_curve_a_name_and_the_exact_ends():
    figure = draw_growth(presets("meijaard2007", "sharp1971", "kooijman2011"), 0, 10)
    assert names_in(figure) == ["meijaard2007", "sharp1971", "kooijman2011"]
    rings = [line for line in figure.axes[0].lines if line.get_marker() == "o"]
    dots = [line.get_xdata()[0] for line in rings]
    assert dots[:2] == pytest.approx([4.292382536341, 6.024262015388], abs=1e-11)
    assert len(dots) == 4  # two without an upper limit in the range
    assert rings[2].get_markersize() > rings[1].get_markersize() + 2  # next to each other, both seen
    assert rings[2].get_zorder() < rings[1].get_zorder()
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["V₁ or V₂"]


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


def test_curves_on_each_other_have_one_label_with_all_names():
    """Else the last one drawn would hide the others; its dashes let them be seen."""
    (_, *design), (_, *other) = presets("meijaard2007", "sharp1971")
    figure = draw_growth([("race", *design), ("touring", *design), ("motorcycle", *other)], 0, 10)
    assert names_in(figure) == ["race, touring", "motorcycle"]
    styles = [line.get_linestyle() for line in figure.axes[0].lines if line.get_linewidth() == 3]
    assert styles == ["-", "--", "--"]  # of matplotlib's names, "--" is all that is not solid
    near = [(name, design[0].replaced({"mB": mass}), *design[1:]) for name, mass in (("a", 85), ("b", 88))]
    assert names_in(draw_growth(near, 0, 10)) == ["a", "b"]


def test_each_end_of_several_machines_has_its_name_and_nothing_is_shaded():
    """Shades that lie on each other mix; damping moves V1 and leaves V2, where that is."""
    bike = Bicycle.preset("meijaard2007")
    machines = [
        (
            f"delta = {delta}",
            stable_speeds(bike.with_delta(delta), None, np.linspace(0.005, 0.15, 60), nearest=False),
        )
        for delta in (0, 2)
    ]
    figure = draw_ends(machines, "sigma")
    assert names_in(figure) == ["V₁: delta = 0", "V₂: delta = 0, delta = 2", "V₁: delta = 2"]
    assert not figure.axes[0].collections
    assert draw_ends(machines[:1], "sigma").axes[0].collections


def test_arrows_where_there_is_no_upper_limit():
    machines = [
        (name, stable_speeds(bike, lam, np.linspace(0, 0.02, 21), nearest=False))
        for name, bike, lam, _, _ in presets("meijaard2007", "kooijman2011")
    ]
    arrows = [line for line in draw_ends(machines, "sigma").axes[0].lines if line.get_marker() == "$\u2191$"]
    open_ = [a["sigma"] for a in machines[1][1] if a["intervals"] and a["intervals"][0]["V2"] is None]
    assert [len(line.get_xdata()) > 0 for line in arrows] == [False, True]
    assert all(min(open_) <= x <= max(open_) for x in arrows[1].get_xdata())


def test_ends_far_above_the_others_leave_the_axis_and_are_told():
    """With much damping one machine's weave speed is beyond 1000 m/s, the other's below 6 m/s."""
    damping = {"delta": np.linspace(0, 8, 17)}
    machines = [
        (name, [{**point, **answer} for point, answer in stable_speeds_over(bike, damping)])
        for name, bike, *_ in presets("meijaard2007", "kooijman2011")
    ]
    figure = draw_ends(machines, "delta", "damping")
    assert 6.1 < figure.axes[0].get_ylim()[1] < 40
    assert [name for name in names_in(figure) if "↑" in name] == ["V₁: kooijman2011 ↑ 1254 m/s"]
    (alone,) = draw_ends(machines[1:], "delta", "damping").axes
    assert alone.get_ylim()[1] > 1254


def test_what_rises_without_limit_leaves_the_axis():
    answers = stable_speeds(Bicycle.preset("dikarev1981"), np.linspace(0.048, 0.3, 4001), 0.15, nearest=False)
    ends = [V for a in answers for i in a["intervals"] for V in (i["V1"], i["V2"]) if V is not None]
    assert max(ends) > 200
    figure = draw_ends([("paper", answers)], "lam")
    assert 8 < figure.axes[0].get_ylim()[1] < 40
    assert not names_in(figure)
    assert figure.axes[0].get_title().endswith("\nσ = 0.15")


def test_growth_rates_against_a_parameter_are_those_of_the_machines():
    bikes = {name: Bicycle.preset(name) for name in ("meijaard2007", "sharp1971")}
    found = [(name, modes_against(bike, "delta", np.linspace(0, 8, 9), 7.0)) for name, bike in bikes.items()]
    (ax,) = draw_growth_against(found, 7.0, "damping").axes
    assert names_in(ax.figure) == [*bikes]
    lines = [line for line in ax.lines if line.get_marker() != "o"]
    for (name, against), unstable, stable in zip(found, lines[::2], lines[1::2], strict=False):
        for x, *rates in zip(stable.get_xdata(), stable.get_ydata(), unstable.get_ydata(), strict=True):
            rate = next(y for y in rates if np.isfinite(y))
            expected = float(growth_rate(bikes[name], 7.0, delta=x))
            assert rate == pytest.approx(expected, rel=1e-6, abs=1e-9)
        ends = [end for pair in against.stable for end in pair if 0 < end < 8]
        assert all(end in stable.get_xdata() for end in ends)


def test_neighbours_differ_in_greyscale():
    dashes = [line.ls for line in lines_for(MOST)]
    assert len({*dashes[:6]}) == 6
    assert all(len({*dashes[start : start + 3]}) == 3 for start in range(MOST - 2))


def test_too_many_curves():
    assert len({*lines_for(MOST)}) == MOST
    with pytest.raises(InputError, match=f"allowed: {MOST}"):
        lines_for(MOST + 1)


@given(st.lists(st.tuples(st.floats(0, 1), st.floats(0.01, 0.1)), min_size=1, max_size=9))
def test_labels_of_several_rows_do_not_overlap(boxes):
    wanted, heights = np.array(boxes).T
    places = spread(wanted, heights)
    order = np.argsort(wanted, kind="stable")
    half = 0.5 * heights[order]
    assert np.all(np.diff(places[order]) >= half[1:] + half[:-1] - 1e-12)
    above = np.concatenate([[0.0], np.cumsum(half[1:] + half[:-1])])
    nearest = isotonic_regression(wanted[order] - above).x  # of boxes without heights: least squares
    nearest = nearest.clip(half[0], 1 - half[-1] - above[-1]) + above
    assert places[order] == pytest.approx(nearest, abs=1e-12)
    assert min(places[order] - half) >= -1e-12  # in the axes, for all of them have room there
    assert max(places[order] + half) <= 1 + 1e-12


@given(st.lists(st.floats(0, 1), max_size=12))
def test_labels_are_apart_and_in_order(wanted):
    places = spread(np.array(wanted), 0.04)
    order = np.argsort(wanted, kind="stable")
    assert np.all(np.diff(places[order]) >= 0.04 - 1e-12)
    far = np.diff(np.array(wanted)[order], prepend=-math.inf, append=math.inf)
    alone = (far[:-1] > 0.5) & (far[1:] > 0.5)  # with room for all others
    assert places[order][alone] == pytest.approx(np.array(wanted)[order][alone], abs=0.25)


def test_a_curve_that_is_infinite_throughout_is_named_at_the_top():
    """A massless front with its mass in the axis has p4 = 0: an infinite eigenvalue at every speed."""
    parts = {"m1": 80, "l1": 0.4, "h1": 0.9, "A1": 3.3, "B1": 3.3, "D1": 0, "C1": 0.1, "m2": 1, "l2": 1}
    front = dict.fromkeys(("h2", "A2", "B2", "D2", "C2", "lam", "sigma", "delta"), 0)
    machine = Bicycle.from_mapping({"R": 0.3, "c": 1, "g": 9.8, **parts, **front})
    assert np.isinf(growth_rate(machine, [0, 5])).all()
    all_ = [("massless", machine, 0.0, 0.0, "refined"), *presets("meijaard2007")]
    for machines in (all_, all_[:1], all_[::-1]):
        names = names_in(draw_growth(machines, 0, 10))
        assert {*names} == {"massless: infinite\nthroughout" if n == "massless" else n for n, *_ in machines}


def test_a_curve_without_a_point_has_no_name():
    ax = Figure().add_subplot()
    x = np.linspace(0, 1, 3)
    label_curves(ax, [Curve("none", x, np.full(3, np.nan), "#4477AA")])
    assert not ax.texts
    label_curves(ax, [Curve("none", x, np.full(3, np.inf), "#4477AA"), Curve("one", x, x, "#4477AA")])
    assert [text.get_text() for text in ax.texts] == ["one"]


def test_as_many_names_as_there_may_be_are_in_the_picture():
    bike = Bicycle.preset("meijaard2007")
    own = [bike.replaced({"mB": 60 + i}) for i in range(MOST)]
    machines = [(f"machine {i}", each, each.lam, each.sigma, "refined") for i, each in enumerate(own)]
    figure = draw_growth(machines, 0, 10)
    figure.draw_without_rendering()
    (ax,) = figure.axes
    named = [text for text in ax.texts if text.get_text().startswith("machine")]
    boxes = [Text.get_window_extent(text) for text in named]  # without the tie to the curve
    assert len(boxes) == MOST
    assert min(box.y0 for box in boxes) > 0
    assert max(box.y1 for box in boxes) < figure.bbox.height
    bottoms = np.sort([box.y0 for box in boxes])
    assert np.diff(bottoms).min() > 0.9 * max(box.height for box in boxes)
