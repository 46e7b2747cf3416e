"""The picture of designs: widths, contours, curves, and what is marked."""

import functools

import numpy as np
import pytest
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from scipy.spatial.distance import pdist

from bikestab.bicycle import Bicycle
from bikestab.design import best as module
from bikestab.design import search
from bikestab.design.best import best_designs
from bikestab.design.criteria import Wanted
from bikestab.family import Family
from bikestab.model import characteristic_table
from bikestab.plot.designs import draw_designs
from bikestab.plot.optima import Mark, part
from bikestab.plot.placing import Room
from bikestab.region.curves import Curve
from bikestab.speeds import intervals_of

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
SPEED = (5.0, 5.0)
PAPER, BENCHMARK = Wanted(Family(DIKAREV), judged=SPEED), Wanted(Family(MEIJAARD), judged=SPEED)
found = functools.cache(best_designs)


@pytest.fixture(autouse=True)
def coarse(monkeypatch):
    monkeypatch.setattr(module, "GRID", 31)
    monkeypatch.setattr(search, "ROUNDS", 12)
    monkeypatch.setattr(search, "ROUNDS_TOGETHER", 6)


def picture(wanted, curves=()):
    figure = draw_designs(wanted, found(wanted), curves)
    return figure, [text.get_text() for box in figure.legends for text in box.get_texts()]


def test_colours_are_the_widths():
    figure, legend = picture(PAPER)
    ax = figure.axes[0]
    (mesh,) = (item for item in ax.collections if isinstance(item, QuadMesh))
    values, corners = mesh.get_array(), mesh.get_coordinates()
    middle = (corners[1:, 1:] + corners[:-1, :-1]) / 2
    V1, V2, *_ = intervals_of(characteristic_table(DIKAREV, middle[..., 0], middle[..., 1]))
    width = np.where(V1 < 30, np.minimum(V2, 30) - V1, 0).max(axis=-1)
    assert values.filled(0) == pytest.approx(width, abs=1e-6)
    assert np.array_equal(np.ma.getmaskarray(values), width == 0)
    assert legend[:4] == ["V₂ above 30 m/s or unbounded", "V₁ [m/s]", "V₂ [m/s]", "no stable speed"]
    assert legend[4] == "fork offset b = 0 (below: forwards)"
    assert legend[5:] == ["width-decay front", "widest interval", "lowest V₁", "fastest decay at 5 m/s"]
    assert (ax.get_xlim(), ax.get_ylim()) == ((0, 0.6), (0, 0.3))


def test_optima_and_own_design_are_marked():
    figure, legend = picture(BENCHMARK)
    assert "own design" in legend
    marks = {line.get_label(): line.get_data() for line in figure.axes[0].lines}
    best = found(BENCHMARK)
    for label, mark in (("own design", best.own), ("lowest V₁", best.lowest_V1)):
        assert [list(values) for values in marks[label]] == [[mark["lam"]], [mark["sigma"]]]


def test_curves_have_names_and_their_own_lines():
    lam = np.linspace(0.1, 0.5, 5)
    names = ("fold", "weave meets capsize", "something new", "fold")
    curves = [Curve(name, lam, lam / (2 + i), lam, False, ("box", "box")) for i, name in enumerate(names)]
    figure, legend = picture(BENCHMARK, curves)
    assert [label for label in legend if label in names] == list(names[:3])
    (handles,) = (box.legend_handles for box in figure.legends)
    styles = {(h.get_color(), str(h._dash_pattern)) for h in handles if h.get_label() in names}
    assert len(styles) == 3
    drawn = [line for line in figure.axes[0].lines if np.array_equal(line.get_ydata(), lam / 3)]
    assert [line.get_color() for line in drawn] == ["white", handles[legend.index(names[1])].get_color()]


def test_what_is_not_as_asked_is_hatched():
    _, legend = picture(Wanted(Family(MEIJAARD), trail=(0.02, 0.2), judged=SPEED, stable=(5.0, 6.0)))
    assert "not stable from 5 to 6 m/s or trail outside 0.02 … 0.2 m" in legend


def test_a_picture_of_nothing():
    wanted = Wanted(Family(MEIJAARD), x=(0.0, 0.1), judged=(5.0, 5.0))
    figure, legend = picture(wanted)
    assert [text.get_text() for text in figure.axes[0].texts] == ["no stable speed below 30 m/s"]
    assert "closest" in legend


def test_numbers_on_lines_say_whose_they_are():
    figure, _ = picture(BENCHMARK)
    texts = [text.get_text() for text in figure.axes[0].texts]
    assert {text.split()[0] for text in texts if " " in text} == {"V₁", "V₂"}
    assert all(float(text.split()[-1]) > 0 for text in texts)


def test_an_arrow_points_from_a_mark_to_the_place_that_another_has():
    ax = Figure(figsize=(5, 5)).add_subplot(xlim=(0, 1), ylim=(0, 1))
    places = [(1.0, 1.0), (1.0, 1.0), (0.99, 1.0), (0.5, 0.5)]
    marks = [Mark(ax.plot(*place, "v", ms=9)[0], place) for place in places]
    part(ax, marks, Room(ax))
    assert [tuple(arrow.xy) for arrow in ax.texts] == places[1:3]
    drawn = [mark.line.get_transform().transform(mark.place) for mark in marks]
    assert drawn[0] == pytest.approx(ax.transData.transform(places[0]))
    assert drawn[3] == pytest.approx(ax.transData.transform(places[3]))
    assert pdist(drawn).min() > 9 * ax.figure.dpi / 72
    assert all(ax.bbox.contains(*place) for place in drawn[1:])
