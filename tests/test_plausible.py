"""Likely mistakes in a machine's numbers are named, and real machines are not doubted."""

import math

import pytest

from bikestab.bicycle import Bicycle
from bikestab.limits import half_digit
from bikestab.plausible import design_doubts
from bikestab.presets import preset_names
from tests.configs import GOOD, load

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")

BENCHMARK = Bicycle.preset("meijaard2007")
PAPER = Bicycle.preset("dikarev1981")
SOUND = PAPER.replaced({"A2": 0.3, "B2": 0.3, "C2": 0.1, "lam": 0.3, "sigma": 0.05})


def scaled(bicycle, unit, factor):
    """All numbers of a unit in another one."""
    return {k: v * factor for k, v in bicycle.given.items() if bicycle.notation[k].endswith(f"[{unit}]")}


@pytest.mark.parametrize("bicycle", [BENCHMARK, SOUND], ids=["bodies", "parts"])
@pytest.mark.parametrize(
    ("unit", "factor", "words"),
    [
        ("m", 1000, "millimetres are written"),
        ("m", 100, "centimetres are written"),
        ("m", 1 / 0.0254, "inches are written"),
        ("kg", 1000, "grams are written"),
    ],
)
def test_other_units_are_one_warning(bicycle, unit, factor, words):
    assert bicycle.warnings == ()
    (text,) = bicycle.replaced(scaled(bicycle, unit, factor)).warnings
    assert words in text


def test_one_number_in_another_unit():
    (text,) = BENCHMARK.replaced({"zB": -900}).warnings
    assert text == "zB = -900 m: no bicycle has that; millimetres are written -900mm"
    (text,) = BENCHMARK.replaced({"c": 55}).warnings
    assert text == "c = 55 m: no bicycle has that; millimetres are written 55mm"
    (text,) = BENCHMARK.replaced({"rR": 30, "rF": 35}).warnings
    assert text.endswith("no bicycle has that; centimetres are written 30cm")
    (text,) = BENCHMARK.replaced({"g": 9810}).warnings
    assert text == "g = 9810 m/s²: no planet has that; it is about 9.81 m/s² here"
    (text,) = BENCHMARK.replaced({"mF": 3000}).warnings
    assert text == "mF = 3000 kg: no bicycle has that; grams are written 3000g"


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"c": 1.3}, "a trail of 1.3 m is longer than the wheelbase of 1.02 m"),
        ({"lam": math.radians(72)}, "λ = 72° is a head angle of 18°"),
        ({"lam": 1.239}, "is a head angle of 19.01"),
        ({"xB": -0.3, "xH": -0.9}, "the centre of mass is 0.277 m behind the rear contact"),
        ({"rF": 0.7, "rR": 0.6}, "the wheels overlap: radii of 0.6 and 0.7 m need a wheelbase of 1.296 m"),
    ],
)
def test_geometry(values, words):
    texts = BENCHMARK.replaced(values).warnings
    assert sum(words in text for text in texts) == 1


def test_wheels_that_touch_do_not_overlap():
    assert not BENCHMARK.replaced({"rR": 1.02 / 2, "rF": 1.02 / 2, "mF": 8.0, "zH": -0.5}).warnings


def test_a_thin_wheel_has_half_its_spin_inertia_about_a_diameter():
    (text,) = SOUND.replaced({"A2": 0.04}).warnings
    assert text.startswith("no front part with a wheel of C2 = 0.1 has A2 = 0.04 < ")


@pytest.mark.parametrize(
    ("xx", "yy", "doubted"),
    [
        (0.0644, 0.1289, False),
        (0.0644, 0.1291, True),
        (0.047, 0.095, False),
        (0.1, 0.3, True),
        (1, 2.1, True),
    ],
)
def test_the_last_printed_digit_is_no_reason_for_doubt(xx, yy, doubted):
    point = dict.fromkeys(("IHxx", "IHyy", "IHzz", "IHxz"), 0.0)
    texts = BENCHMARK.replaced({"IFxx": xx, "IFyy": yy, **point}).warnings
    assert any("IFyy > 2 IFxx" in text for text in texts) == doubted


@pytest.mark.parametrize(
    ("number", "half"),
    [
        (0.1289, 5e-5),
        (2.5, 0.05),
        (3, 0),
        (3.0, 0),
        (0.5, 0.01),
        (-0.047, 5e-4),
        (1e-20, 0),
    ],
)
def test_half_a_digit(number, half):
    assert half_digit(number) == pytest.approx(half, rel=1e-12)


@pytest.mark.parametrize("name", preset_names())
def test_real_machines_are_not_doubted(name):
    found = Bicycle.preset(name).warnings
    assert len(found) == (2 if name == "dikarev1981" else 0)  # what the paper printed


def test_a_grid_of_head_angles():
    grid = GOOD.replace("{start: 0, stop: 0.3, num: 4}", "{start: 68deg, stop: 74deg, num: 4}")
    assert load(grid).warnings[0].startswith("grid: λ = 68° is a head angle of 22°")
    grid = GOOD.replace("{start: 0, stop: 0.15, num: 5}", "{start: 40, stop: 80, num: 5}")
    assert load(grid).warnings[0].startswith("grid: a trail of 41.6 m is longer than the wheelbase")
    assert len(load(GOOD).warnings) == 2


def test_designs():
    assert (
        design_doubts(None, None, 1.0) == design_doubts(0.7, 1.0, 1.0) == design_doubts(-1.2, -1, 1.0) == []
    )
    assert len(design_doubts(0.8, -1.1, 1.0)) == 2
