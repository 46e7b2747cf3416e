"""The tornado picture: its bars are the elasticities, the largest on top."""

import pytest

from bikestab.bicycle import Bicycle
from bikestab.design.effects import effects
from bikestab.design.sensitivity import sensitivity
from bikestab.plot.tornado import Bar, Panel, draw_bars, draw_tornado


def test_bars_are_elasticities():
    found = sensitivity(Bicycle.preset("meijaard2007"))
    figure = draw_tornado([("meijaard2007", effects(found, 0)), ("none", [])])
    ax, empty = figure.axes
    names = [label.get_text().split(" = ")[0] for label in ax.get_yticklabels()]
    assert names[:2] == ["xH", "w"]
    assert "IByy" not in names
    assert "offset" not in names
    for container, which in zip(ax.containers, (0, 1), strict=True):
        for name, bar in zip(names, container, strict=True):
            assert bar.get_width() == pytest.approx(found.elasticity(name)[which][0])
    tops = [bar.get_y() for bar in ax.containers[0]]
    assert tops == sorted(tops)
    assert ax.get_ylim()[0] > ax.get_ylim()[1]
    assert "no stable speed" in empty.get_title()


def test_legend_has_the_results_of_all_machines():
    names = ("kooijman2011", "meijaard2007")  # the first has no upper limit
    machines = [(name, effects(sensitivity(Bicycle.preset(name)), 0)) for name in names]
    assert _legend(draw_tornado(machines)) == _legend(draw_tornado(machines[1:])) == ["V₁", "V₂"]
    assert _legend(draw_tornado(machines[:1])) == ["V₁"]
    assert draw_tornado([("none", [])]).legends == []


def _legend(figure):
    (legend,) = figure.legends
    return [text.get_text() for text in legend.get_texts()]


def test_one_result_has_no_legend():
    bars = [Bar("c", 1.02, "m", (0.05,)), Bar("sigma", 0.08, "1", (-0.01,))]
    ax, empty = draw_bars([Panel("a", bars, ""), Panel("b", [], "no such σ")], "change of σ").axes
    assert [bar.get_width() for bar in ax.containers[0]] == [0.05, -0.01]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["c = 1.02 m", "sigma = 0.08"]
    assert ax.figure.legends == []
    assert (ax.get_title(), empty.get_title(), ax.get_xlabel()) == ("a", "b: no such σ", "change of σ")
