"""The picture of several machines' fronts: each has marks of its own, and its own design the same."""

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
