"""The picture of several machines' fronts: each has marks of its own, and its own design the same."""

import math

import pytest

from bikestab.bicycle import Bicycle
from bikestab.design import best, search
from bikestab.design.best import best_designs
from bikestab.design.criteria import Wanted
from bikestab.family import Family
from bikestab.plot.fronts import draw_fronts


@pytest.fixture(autouse=True)
def coarse(monkeypatch):
    monkeypatch.setattr(best, "GRID", 21)
    monkeypatch.setattr(search, "ROUNDS", 6)
    monkeypatch.setattr(search, "ROUNDS_TOGETHER", 4)


def test_marks_tell_the_machines_apart():
    found = []
    for name in ("meijaard2007", "sharp1971", "dikarev1981"):
        wanted = Wanted(Family(Bicycle.preset(name), "refined"), (0.1, 0.4), (0.02, 0.12))
        found.append((name, wanted, best_designs(wanted)))
    (ax,) = draw_fronts(found).axes
    *lines, _ = ax.lines  # the last is zero
    fronts = [line for line in lines if len(line.get_xdata()) > 1]
    assert [len(line.get_xdata()) for line in fronts] == [len(each.pareto) for *_, each in found]
    assert [line.get_marker() for line in fronts] == ["o", "s", "^"]
    own = [line for line in lines if line not in fronts]
    assert [line.get_marker() for line in own] == ["o", "s"]  # the paper's bicycle has none
    assert [(*line.get_xdata(), *line.get_ydata()) for line in own] == [
        (each.own["width"], each.own["growth_rate"]) for *_, each in found[:2]
    ]
    assert {text.get_text() for text in ax.texts} == {"meijaard2007", "sharp1971", "dikarev1981"}


def test_an_own_design_that_was_not_searched_is_hollow_and_said_to_be():
    """It may be better in both than all of the front, which is then no contradiction of the title."""
    found = []
    for name in ("meijaard2007", "sharp1971"):
        family = Family(Bicycle.preset(name), "refined", "trail", "head_angle")
        wanted = Wanted(family, (0.02, 0.08), (math.radians(60), math.radians(75)))
        found.append((name, wanted, best_designs(wanted)))
    assert [each.own["at"] for *_, each in found] == ["", "outside the box"]
    front = max(found[1][2].pareto, key=lambda each: each["width"])
    assert found[1][2].own["width"] > front["width"]
    figure = draw_fronts(found)
    (ax,) = figure.axes
    own = [line for line in ax.lines if len(line.get_xdata()) == 1]
    assert [line.get_markerfacecolor() == "white" for line in own] == [False, True]
    (legend,) = figure.legends
    told = {
        text.get_text(): mark.get_markerfacecolor()
        for text, mark in zip(legend.texts, legend.legend_handles, strict=True)
    }
    assert told == {"own design of each, in its mark": "0.6", "own design, outside the box": "white"}
