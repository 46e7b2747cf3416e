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


def test_a_machine_of_25_parameters_has_their_symbols():
    bicycle = Bicycle.preset("meijaard2007")
    ax = draw_side(bicycle, bicycle.lam, bicycle.sigma).axes[0]
    words = {text.get_text() for text in ax.texts}
    assert {
        "B: mB = 85 kg\nxB = 0.3 m\nzB = −0.9 m", "H: mH = 4 kg\nxH = 0.9 m\nzH = −0.7 m",
        "rR = 0.3 m\nmR = 2 kg", "rF = 0.35 m\nmF = 3 kg", "w = 1.02 m", "c = 0.08 m", "b = 0.0321 m",
    } <= words  # fmt: skip
    assert not any(word.startswith(("M1", "M2", "c1", "d =")) for word in words)
    masses = [line.get_data() for line in ax.lines if line.get_marker() == "+"]
    assert [(x[0], y[0]) for x, y in masses] == [(0.3, 0.9), (0.9, 0.7)]


def test_a_rider_apart_is_a_body_of_its_own():
    given = Bicycle.preset("meijaard2007").given
    rider = {
        "rider.m": 75.0,
        "rider.x": 0.35,
        "rider.z": -1.1,
        "rider.Ixx": 8.0,
        "rider.Izz": 2.4,
        "rider.Ixz": -1.9,
    }
    bicycle = Bicycle.from_mapping({**given, "mB": 15.0, **rider})
    ax = draw_side(bicycle, bicycle.lam, bicycle.sigma).axes[0]
    assert "rider: rider.m = 75 kg\nrider.x = 0.35 m\nrider.z = −1.1 m" in {
        text.get_text() for text in ax.texts
    }
    assert ax.get_ylim()[1] > 1.1
