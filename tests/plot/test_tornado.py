"""The tornado picture: its bars are the elasticities, the largest on top."""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.design.effects import effects
from bikestab.design.sensitivity import sensitivity, two_parts
from bikestab.plot.effects import Machine, draw_effects
from bikestab.plot.tornado import Bar, Panel, draw_bars, draw_tornado


def test_bars_are_elasticities():
    found = sensitivity(Bicycle.preset("meijaard2007"))
    (ax,) = draw_tornado(["meijaard2007"], effects(found, 0)).axes
    names = [label.get_text().split(" = ")[0] for label in ax.get_yticklabels()]
    assert names[:2] == ["xH", "w"]
    assert "IByy" not in names
    assert names[-4:] == ["delta", "measures of the front:", "head_angle", "offset"]
    assert [text.get_text() for text in ax.texts] == ["V₁ +0.0113 m/s per kg m²/s"]
    values = dict(label.get_text().split(" = ") for label in ax.get_yticklabels() if "=" in label.get_text())
    assert (values["lam"], values["c"], values["zB"], values["delta"]) == (
        "18°",
        "80 mm",
        "−900 mm",
        "0 kg m²/s",
    )
    names.remove("measures of the front:")
    for container, which in zip(ax.containers, (0, 1), strict=True):
        for name, bar in zip(names, container, strict=True):
            assert bar.get_width() == pytest.approx(found.elasticity(name)[which][0])
    tops = [bar.get_y() for bar in ax.containers[0]]
    assert tops == sorted(tops)
    assert ax.get_ylim()[0] > ax.get_ylim()[1]
    (empty,) = draw_tornado(["none"], []).axes
    assert "no stable speed" in empty.get_title()


def test_legend_has_the_results_that_there_are():
    for name, results in (("kooijman2011", ["V₁"]), ("meijaard2007", ["V₁", "V₂"])):
        rows = effects(sensitivity(Bicycle.preset(name)), 0)  # the first has no upper limit
        assert _legend(draw_tornado([name], rows)) == results
    assert draw_tornado(["none"], []).legends == []


def _legend(figure):
    (legend,) = figure.legends
    return [text.get_text() for text in legend.get_texts()]


def test_one_result_has_no_legend():
    bars = [Bar("c", 1.02, "m", (0.05,)), Bar("sigma", 0.08, "1", (-0.01,))]
    (ax,) = draw_bars(Panel(["a", "held"], bars, ""), "change of σ").axes
    (empty,) = draw_bars(Panel(["b"], [], "no such σ"), "change of σ").axes
    assert [bar.get_width() for bar in ax.containers[0]] == [0.05, -0.01]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["c = 1020 mm", "sigma = 0.08"]
    assert ax.figure.legends == []
    assert (ax.get_title(), empty.get_title(), ax.get_xlabel()) == ("a\nheld", "b: no such σ", "change of σ")


def test_what_says_the_same_of_the_front_is_left_out_and_what_is_zero_has_its_slope():
    bars = [
        Bar("c", 0.08, "m", (0.5,), (6.0,)), Bar("D1", 0.0, "kg m²", (0.0,), (-0.25,)),
        Bar("A1", 0.0, "kg m²", (0.0,), (0.0,)), Bar("trail", 0.08, "m", (0.5,), (6.0,), True),
        Bar("lam", 0.0, "rad", (0.0,), (3.0,)), Bar("offset", 0.03, "m", (-0.2,), (2.0,), True),
    ]  # fmt: skip
    (ax,) = draw_bars(Panel(["a"], bars, ""), "growth", unit="1/s").axes
    names = [label.get_text().split(" =")[0] for label in ax.get_yticklabels()]
    assert names == ["c", "D1", "lam", "measures of the front:", "offset"]
    assert [text.get_text() for text in ax.texts] == ["−0.25 1/s per kg m²", "+0.0524 1/s per deg"]
    assert ax.get_ylim() == (4.5, -0.5)


def test_machines_side_by_side_are_on_one_scale_with_what_each_moves():
    names = ["meijaard2007", "sharp1971", "kooijman2011"]
    found = {name: sensitivity(two_parts(Bicycle.preset(name))) for name in names}
    machines = [
        Machine(
            name,
            {row["name"]: (row["elasticity_V1"], row["elasticity_V2"]) for row in effects(each, 0)},
        )
        for name, each in found.items()
    ]
    figure = draw_effects(machines, ["l2", "sigma", "c", "trail", "B1"], "title", ["V₁", "V₂"])
    lower, upper = figure.axes
    assert lower.get_xlim() == upper.get_xlim()
    rows = [label.get_text() for label in lower.get_yticklabels()]
    assert rows == ["l2", "sigma, trail", "c", "B1"]
    for k, ax in enumerate(figure.axes):
        for name, line in zip(names, ax.lines, strict=False):
            for row, x in zip(rows, line.get_xdata(), strict=True):
                expected = found[name].elasticity(row.split(",")[0])[k][0]
                assert x == pytest.approx(expected) or (np.isnan(x) and not np.isfinite(expected))
    assert [text.get_text() for text in figure.legends[0].get_texts()] == names
    assert figure._suptitle.get_text() == "title"
    many = [machines[0]] * 24
    assert 9 * 16 / 2.54 / draw_effects(many, ["l2"], "title", ["V₁", "V₂"]).get_figwidth() > 6  # points


def test_rows_that_show_nothing_are_counted():
    machines = [Machine("a", {f"p{i}": (1.0 + i,) for i in range(20)} | {"none": (0.0,)}), Machine("b", {})]
    figure = draw_effects(machines, [*machines[0].effects], "title", [""])
    assert len(figure.axes[0].get_yticklabels()) == 16
    assert figure._suptitle.get_text() == "title\n5 more parameters have less effect"
