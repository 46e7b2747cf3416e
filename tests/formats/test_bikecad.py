"""Designs of BikeCAD: what is read of them, what is missing, and what to type instead."""

import math

import pytest

import bikestab as bs
from bikestab.errors import InputError
from bikestab.formats.bikecad import geometry

DESIGN = {
    "Head angle": "71.0", "Stack": "600.0", "FCD textfield": "390.0", "CS textfield": "430.0",
    "BB textfield": "70.0", "FORK0R": "45.0", "Wheel diameter front": "680.0", "Wheel diameter rear": "700.0",
    "Top tube front center measure style": "3", "Fork type": "0", "FORK1R": "51.0", "Name": "a &amp; b",
}  # fmt: skip


def text(**changes):
    entries = {**DESIGN, **{key.replace("_", " "): value for key, value in changes.items()}}
    lines = [f'<entry key="{key}">{value}</entry>' for key, value in entries.items() if value is not None]
    head = '<?xml version="1.0" encoding="UTF-8" standalone="no"?>\n<!DOCTYPE properties SYSTEM "p.dtd">'
    return "\n".join([head, "<properties>", '<entry key="Empty"/>', *lines, "</properties>"])


def test_the_steering_axis():
    found = geometry(text())
    lam = math.radians(19)
    assert found["lam"] == pytest.approx(lam, rel=1e-15)
    assert (found["rF"], found["rR"], found["offset"]) == (0.34, 0.35, 0.045)
    assert found["c"] == pytest.approx((0.34 * math.sin(lam) - 0.045) / math.cos(lam), rel=1e-14)


def test_the_wheelbase_closes_the_frame():
    """From the top of the head tube, across the steering axis, the front axle is the fork's offset away."""
    n = {key: float(value) for key, value in DESIGN.items() if key != "Name"}
    drop, rear, front = n["BB textfield"], n["Wheel diameter rear"] / 2, n["Wheel diameter front"] / 2
    ahead = 1000 * geometry(text())["w"] - math.sqrt(n["CS textfield"] ** 2 - drop**2)  # of the bracket
    dx, dy = ahead - n["FCD textfield"], drop + front - rear - n["Stack"]
    angle = math.radians(n["Head angle"])
    assert dx * math.sin(angle) + dy * math.cos(angle) == pytest.approx(n["FORK0R"], rel=1e-12)
    height = str(rear - drop)
    assert geometry(text(BB_textfield=height, BB_measure_style="1")) == pytest.approx(geometry(text()))


@pytest.mark.parametrize(
    ("changes", "missing"),
    [
        ({"Top_tube_front_center_measure_style": "0"}, {"w"}),
        ({"CS_measure_style": "1"}, {"w"}),
        ({"Stack": None}, {"w"}),
        ({"CS_textfield": "60"}, {"w"}),
        ({"Wheel_diameter_front": "0"}, {"w", "c", "rF"}),
        ({"FORK0R": None}, {"w", "c", "offset"}),
        ({"FORK0R": "NaN"}, {"w", "c", "offset"}),
        ({"Head_angle": "tall"}, {"w", "c", "offset", "lam"}),
        ({"Head_angle": "180"}, {"w", "c", "offset", "lam"}),
    ],
)
def test_what_is_not_known_is_left_out(changes, missing):
    assert geometry(text()).keys() - geometry(text(**changes)).keys() == missing


def test_forks_of_other_types():
    assert geometry(text(Fork_type="1"))["offset"] == 0.051
    assert geometry(text(Fork_type=None))["offset"] == 0.045
    assert geometry(text(FORK0R=None, Fork_offset="38"))["offset"] == 0.038


def test_it_is_told_what_is_there_and_what_is_missing(tmp_path):
    path = tmp_path / "any.xml"
    path.write_text(text(), "utf-8")
    with pytest.raises(InputError) as caught:
        bs.Bicycle.load(str(path))
    assert "head angle 71°, fork offset 45 mm, trail 69.4785 mm, wheelbase 1047.79 mm" in str(caught.value)
    assert "missing: mR IRxx IRyy xB zB mB IBxx IBzz IBxz xH" in str(caught.value)
    path.write_text(text(Head_angle=None, Wheel_diameter_front=None, Wheel_diameter_rear=None), "utf-8")
    with pytest.raises(InputError, match=r"and moments of inertia\nmissing: [A-Za-z ]*$"):
        bs.Bicycle.load(str(path))
