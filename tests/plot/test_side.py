"""The side view: what is drawn is where the parameters say."""

import numpy as np
import pytest
from matplotlib.patches import Circle

from bikestab.bicycle import Bicycle
from bikestab.plot.side import draw_side


@pytest.mark.parametrize(
    ("name", "lam", "sigma"), [("dikarev1981", 0.2, 0.08), ("sharp1971", 0.4712, 0.0919)]
)
def test_lengths(name, lam, sigma):
    bicycle = Bicycle.preset(name)
    ax = draw_side(bicycle, lam, sigma).axes[0]
    assert ax.get_aspect() == 1
    rear, front = (patch for patch in ax.patches if isinstance(patch, Circle))
    assert (rear.center, rear.radius) == ((0, bicycle.R1), bicycle.R1)
    assert (front.center, front.radius) == ((bicycle.c, bicycle.R2), bicycle.R2)
    (axis,) = (
        line
        for line in ax.lines
        if line.get_color() == "0.35"
        and len(line.get_xdata()) == 2
        and line.get_xdata()[0] != line.get_xdata()[1]
    )
    (x0, x1), (y0, y1) = axis.get_data()
    assert (x0, y0) == pytest.approx((bicycle.c * (1 + sigma), 0))
    assert np.arctan2(x0 - x1, y1 - y0) == pytest.approx(lam)
    along = np.array([x1 - x0, y1 - y0]) / np.hypot(x1 - x0, y1 - y0)
    drawn = [line.get_data() for line in ax.lines if line.get_color() == "0.1"]
    assert len(drawn) == 3  # c1, b and d, each at a right angle to the axis and ending on it
    for (a, b), (c, d) in drawn:
        assert abs(np.dot([b - a, d - c], along)) < 1e-12
        assert abs((b - x0) * along[1] - (d - y0) * along[0]) < 1e-12


def test_words():
    words = {text.get_text() for text in draw_side(Bicycle.preset("dikarev1981"), 0.2, 0.08).axes[0].texts}
    assert {
        "c1 = 0.0815 m",
        "b = −0.012 m",
        "d = −0.119 m",
        "c2 = σ c = 0.0832 m",
        "R = 0.35 m",
        "λ",
    } <= words


def test_skates_have_no_wheels():
    bicycle = Bicycle.preset("kooijman2011")
    ax = draw_side(bicycle, bicycle.lam, bicycle.sigma).axes[0]
    assert not [text for text in ax.texts if text.get_text().startswith("R")]
