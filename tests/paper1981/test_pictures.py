"""The pictures: ticks on the stable side, the arrow into the region, and that each is drawn."""

from itertools import pairwise

import numpy as np
import pytest
from matplotlib.text import Text

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import characteristic_table
from bikestab.paper1981.box import LAM, SIGMA, V
from bikestab.paper1981.damping import damping
from bikestab.paper1981.pictures.damping import draw_damping
from bikestab.paper1981.pictures.machine import PITCH, draw_machine
from bikestab.paper1981.pictures.places import PLACES
from bikestab.paper1981.pictures.ticks import oriented
from bikestab.paper1981.reproduce import figures_of_all, figures_of_others, figures_of_undamped
from bikestab.paper1981.study import ARROW, FIGURES
from bikestab.region.section import Section, edge_curves
from bikestab.routh import CONDITIONS, stable
from tests.small import TINY, halves


@pytest.mark.parametrize("fixed", ["lam", "sigma"])
@pytest.mark.parametrize("name", ["hurwitz3", "p0"])
def test_ticks_are_on_the_stable_side(fixed, name):
    """Beside the points of each oriented curve: stable at its left, not at its right."""
    value = {"lam": 0.2, "sigma": 0.12}[fixed]
    section = Section(Family(Bicycle.preset("dikarev1981")), fixed, value)
    ends = {"lam": LAM, "sigma": SIGMA, "V": V}
    width, height = (ends[axis][1] for axis in section.axes)
    for x, y in edge_curves(section, [name], np.linspace(0, width, 161), np.linspace(0, height, 161))[name]:
        for points in ((x, y), (x[::-1], y[::-1])):
            a, b = oriented(section, CONDITIONS, *points)
            along = np.diff(a) / width, np.diff(b) / height
            length = np.maximum(np.hypot(*along), 1e-12)
            middle = 0.5 * (a[1:] + a[:-1]), 0.5 * (b[1:] + b[:-1])
            normal = -1e-3 * width * along[1] / length, 1e-3 * height * along[0] / length
            left, right = (
                stable(*section.table_and_speed(middle[0] + s * normal[0], middle[1] + s * normal[1]))
                for s in (1, -1)
            )
            assert left.mean() > 0.9
            assert right.mean() < 0.1


def test_the_arrow_points_into_the_region():
    start, tip = ARROW
    for (lam, sigma, speed), expected in ((start, False), (tip, True)):
        table = characteristic_table(Bicycle.preset("dikarev1981"), lam, sigma)
        assert bool(stable(table, speed)) is expected
    assert start[:2] == tip[:2]  # the arrow's head is drawn for a vertical one


def test_figures_are_drawn():
    one, two = halves()
    bicycle = Bicycle.preset("dikarev1981")
    named = [
        *figures_of_undamped(bicycle, TINY, one), *figures_of_others(bicycle, two),
        *figures_of_all(bicycle, TINY),
    ]  # fmt: skip
    found = {name: draw() for name, draw in named}
    assert set(found) == set(FIGURES)
    left, right = found["figure3.png"].axes[:2]
    assert len(left.lines) > 12
    assert len(right.lines) > 12
    words = [t.get_text() for t in found["refinement.png"].findobj(Text)]
    assert "unrefined: conditions at λ = 0.3 rad, no stable motion" in words
    assert set(PICTURES.values()) == set(PLACES)
    words = {t.get_text() for t in found["machine.png"].findobj(Text)}
    assert {"φ0", "α", "β", "L", "d1", "λ"} <= words
    for name, picture in PICTURES.items():
        assert_in_place(found[name], picture)


PICTURES = {
    "machine.png": "machine", "figure3.png": "sections", "figure3_space.png": "space",
    "refinement.png": "refinement", "conclusion1.png": "kinds", "conclusion2.png": "widths",
    "conclusion4.png": "damping",
}  # fmt: skip


def assert_in_place(figure, picture):
    """Axes with their texts are inside the picture and apart, and about where matplotlib's layout has them.

    Only about: these are pictures of few samples, and with other labels it keeps other room free.
    """
    figure.draw_without_rendering()
    boxes = [ax.get_tightbbox() for ax in figure.axes]
    for box in boxes:
        assert min(box.x0, box.y0) >= -1
        assert box.x1 <= figure.bbox.x1 + 1
        assert box.y1 <= figure.bbox.y1 + 1
    assert all(one.x1 <= other.x0 + 1 for one, other in pairwise(boxes))
    for ax in figure.axes:
        ax.set_in_layout(True)  # which placing an axes ends
    figure.set_layout_engine("constrained")
    figure.draw_without_rendering()
    for ax, place in zip(figure.axes, PLACES[picture], strict=True):
        assert ax.get_position().bounds == pytest.approx(place, abs=0.05)


def test_the_frame_s_lengths_are_those_of_the_printed_block():
    """l1, h1, l2, h2 from the lines that are drawn, by the repaired block before (1.2)."""
    bicycle, lam, sigma = Bicycle.preset("dikarev1981"), 0.2, 0.08
    green = [line for line in draw_machine(bicycle, lam, sigma).axes[0].lines if line.get_marker() == "o"]
    green = [line.get_xydata() for line in green if line.get_color() == "#00795a"]
    L, alpha, beta, d1 = (float(np.hypot(*(line[1] - line[0]))) for line in green)
    assert bicycle.l1 == pytest.approx(alpha * np.cos(PITCH) + beta * np.sin(PITCH))
    assert bicycle.h1 == pytest.approx(bicycle.R1 - alpha * np.sin(PITCH) + beta * np.cos(PITCH))
    d = bicycle.h2 * np.sin(lam) + (bicycle.l2 - bicycle.c * (1 + sigma)) * np.cos(lam)
    assert bicycle.l2 == pytest.approx(L * np.cos(PITCH) + d * np.cos(lam) - d1 * np.sin(lam))
    assert bicycle.h2 == pytest.approx(bicycle.R1 - L * np.sin(PITCH) + d * np.sin(lam) + d1 * np.cos(lam))


def test_curves_against_damping_are_finer_than_the_study(bicycle):
    """Through the study's points, exactly, and with many between them."""
    numbers = damping(bicycle, 6, (0.01, 0.1, 1.0))
    left, right = draw_damping(bicycle, numbers).axes
    curves = {line.get_label(): line for line in left.lines if line.get_linewidth() == 1.8}
    for design in numbers.single_designs:
        delta, V1 = curves[f"λ = {design.lam:.2f}, σ = {design.sigma:.2f}"].get_data()
        assert len(delta) >= 200
        for row in design.sweep:
            near = np.interp(row.delta, delta, V1)
            assert near == pytest.approx(np.nan if row.V1 is None else row.V1, abs=2e-3, nan_ok=True)
    assert all(len(line.get_xdata()) == 3 for line in right.lines if line.get_marker() == "o")
