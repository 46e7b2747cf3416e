"""The picture of the region in three dimensions."""

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.text import Text

from bikestab.bicycle import Bicycle
from bikestab.config.file import load_config
from bikestab.plot.region import SHEETS, draw_region
from bikestab.scan.run import run_scan
from bikestab.stability import stable_intervals
from bikestab.volume import Volume

CONFIG = """
title: a box
bicycle: {bicycle}
model: {model}
grid:
  lam: {lam}
  sigma: {{start: 0, stop: 0.15, num: 3}}
  V: {{start: 0, stop: 12, num: 3}}
fields: [stable]
output: {output}
"""


@pytest.fixture
def drawn(tmp_path):
    def draw(bicycle="dikarev1981", model="refined", lam="{start: 0, stop: 0.3, num: 3}"):
        path = tmp_path / "c.yaml"
        text = CONFIG.format(bicycle=bicycle, model=model, output=tmp_path / (bicycle + lam[8:11]), lam=lam)
        path.write_text(text)
        with Volume(run_scan(load_config(path)).path) as volume:
            return draw_region(volume)

    return draw


def words(figure):
    return [text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text"))]


def test_two_sheets_in_two_colours(drawn):
    """Each pixel has the colour of one of them, lit: no mix of the two."""
    figure = drawn()
    ((surface,),) = (figure.axes[0].images,)
    colours = surface.get_array().reshape(-1, 4)
    assert {*np.unique(colours[:, 3])} == {0, 1}
    colours = colours[colours[:, 3] > 0, :3]
    hue = colours / np.linalg.norm(colours, axis=1, keepdims=True)
    seen = np.zeros(len(hue), bool)
    for colour, name, _, _ in SHEETS.values():
        expected = np.array(to_rgb(colour)) / np.linalg.norm(to_rgb(colour))
        there = np.isclose(hue, expected, atol=1e-6).all(axis=1)
        assert there.sum() > 100
        assert f"{name}: lower limit" in words(figure)
        seen |= there
    assert "capsize: upper limit (striped)" in words(figure)
    assert seen.mean() > 0.999  # but for what closes gaps


def test_axes_are_the_volumes_box(drawn):
    ax = drawn("meijaard2007").axes[0]
    assert (ax.get_xlim(), ax.get_ylim(), ax.get_zlim()) == ((0, 0.3), (0, 0.15), (0, 12))
    assert "λ [rad]" in ax.get_xlabel()
    assert "[m/s]" in ax.get_zlabel()
    assert ax.get_title().startswith("a box\nmeijaard2007")


def test_the_own_design_has_its_stable_speeds(drawn):
    figure = drawn("sharp1971", lam="{start: 0.3, stop: 0.6, num: 3}")
    (line,) = (each for each in figure.axes[0].lines if each.get_marker() == "o")
    x, y, V = (np.asarray(values) for values in line.get_data_3d())
    sharp = Bicycle.preset("sharp1971")
    found = stable_intervals(sharp)
    assert pytest.approx([found.V1[0], found.V2[0]], abs=1e-9) == V
    assert (set(x), set(y)) == ({sharp.lam}, {sharp.sigma})
    assert "own design" in words(figure)
    assert "own design" not in words(drawn("sharp1971"))


def test_all_is_within_the_picture(drawn):
    figure = drawn("sharp1971")
    figure.draw_without_rendering()
    whole = figure.bbox
    ticks = {tick for axis in figure.axes[0]._axis_map.values() for tick in axis.get_majorticklabels()}
    for text in set(figure.findobj(Text)) - ticks:
        box = text.get_window_extent()
        assert not text.get_text() or ((box.min >= whole.min).all() and (box.max <= whole.max).all()), text


def test_forks_are_straight_on_a_line_of_the_floor(drawn):
    """There R2 sin λ − σ c cos λ, which is b in the paper, is zero."""
    figure = drawn()
    (line,) = (each for each in figure.axes[0].lines if each.get_linestyle() not in ("None", "-"))
    lam, sigma, V = (np.asarray(values) for values in line.get_data_3d())
    bicycle, on = Bicycle.preset("dikarev1981"), ~np.isnan(sigma)
    offset = bicycle.R2 * np.sin(lam) - sigma * bicycle.c * np.cos(lam)
    assert on.sum() > 50
    assert offset[on] == pytest.approx(0, abs=1e-15)
    assert set(V) == {0.0}
    assert "fork offset b = 0" in words(figure)


def test_a_vertical_wall(drawn):
    figure = drawn("kooijman2011")
    assert "weave: lower limit" in words(figure)
    assert "capsize: lower limit" in words(figure)
    assert "the region goes on beyond the box" in words(figure)


def test_nothing_stable(drawn):
    figure = drawn(model="unrefined")
    assert "no stable motion in this box" in words(figure)
    assert "unrefined model" in figure.axes[0].get_title().replace("\n", " ")
    assert not list(figure.axes[0].images)
