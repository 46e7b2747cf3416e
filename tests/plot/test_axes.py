"""What stands beside axes: words and numbers."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.plot.axes import label_family, label_of
from bikestab.plot.ticks import plain_numbers
from bikestab.variants import FRONT, parameter_of


@pytest.mark.parametrize("name", ["dikarev1981", "meijaard2007"])
def test_every_parameter_has_short_words_of_its_own(name):
    bicycle = Bicycle.preset(name)
    names = {**bicycle.notation, **FRONT}
    labels = {key: label_of(parameter_of(bicycle, key)) for key in names}
    assert len({*labels.values()}) == len(labels)
    for key, label in labels.items():
        assert len(label) < 45
        unit = "°" if key == "head_angle" else parameter_of(bicycle, key).unit
        assert label.endswith(f"[{unit}]") == (unit != "1")
        assert label.split().count(key) <= 1


def test_words_of_some():
    bicycle = Bicycle.preset("meijaard2007")
    words = {
        "mB": "body mass mB [kg]", "zH": "fork centre of mass zH [m]", "head_angle": "head angle [°]",
        "delta": "steering damping δ [kg m²/s]", "sigma": "trail / wheelbase σ",
    }  # fmt: skip
    assert {key: label_of(parameter_of(bicycle, key)) for key in words} == words


@pytest.mark.parametrize(
    ("ends", "label", "shown", "value"),
    [
        ((0.0, 1.0), "λ [rad]", "λ [rad]", lambda text: float(text)),
        ((0.1, 0.1001), "λ [rad]", "λ [rad]", lambda text: float(text)),
        ((0.1, 0.1000000001), "λ [rad]", "λ − 0.1 [10⁻¹⁰ rad]", lambda text: 0.1 + 1e-10 * float(text)),
        ((0.08, 0.0800001), "σ", "σ − 0.08 [10⁻⁷]", lambda text: 0.08 + 1e-7 * float(text)),
        ((-3e-6, 4e-6), "x [m]", "x [10⁻⁶ m]", lambda text: 1e-6 * float(text)),
        ((-2e8, 4e8), "x [m]", "x [10⁸ m]", lambda text: 1e8 * float(text)),
        (
            (-5.00000004, -5.00000001),
            "x [m]",
            "x + 5.0000001 [10⁻⁸ m]",
            lambda text: -5.0000001 + 1e-8 * float(text),
        ),
    ],
)
def test_numbers_say_all(ends, label, shown, value):
    ax = Figure().add_subplot()
    ax.set_xlim(ends)
    ax.set_xlabel(label)
    plain_numbers(ax.figure)
    ax.figure.draw_without_rendering()
    assert (ax.get_xlabel(), ax.xaxis.get_offset_text().get_text()) == (shown, "")
    ticks = [tick for tick in ax.get_xticks() if ends[0] <= tick <= ends[1]]
    told = [value(ax.xaxis.get_major_formatter()(tick).replace("−", "-")) for tick in ticks]
    assert np.ptp(ticks) > 0.5 * (ends[1] - ends[0])
    assert told == pytest.approx(ticks, rel=0, abs=1e-4 * (ends[1] - ends[0]))


@pytest.mark.parametrize("ends", [(60, 75), (71.5, 72.5), (45, 90), (70, 70.05)])
@pytest.mark.parametrize("way", ["x", "y"])
def test_head_angles_are_told_in_round_degrees(way, ends):
    """What is drawn is in rad: the numbers stand where their angles are."""
    family = Family(Bicycle.preset("meijaard2007"), "refined", "trail", "head_angle")
    ax = Figure().add_subplot()
    ax.set(**{f"{way}lim": np.radians(ends)})
    label_family(ax, *(("head_angle", "trail") if way == "x" else ("trail", "head_angle")), family)
    plain_numbers(ax.figure)
    ax.figure.draw_without_rendering()
    axis = getattr(ax, f"{way}axis")
    ticks = [tick for tick in axis.get_majorticklocs() if np.radians(ends[0]) <= tick <= np.radians(ends[1])]
    told = [float(axis.get_major_formatter()(tick)) for tick in ticks]
    assert len(told) >= 3
    assert told == pytest.approx(np.degrees(ticks), rel=1e-9)
    assert all(len(f"{angle:g}") <= 5 for angle in told)
    assert axis.get_label_text() == "head angle [°]"
