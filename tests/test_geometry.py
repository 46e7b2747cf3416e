"""Head angle, trail and fork offset."""

import math

import numpy as np
import pytest
from bicycleparameters.bicycle import trail as trail_of_another_code
from hypothesis import assume, given
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.geometry import design_given, offset_of, tilt_from, tilt_of, trail_from
from bikestab.units import ANGLE, quantity

BENCHMARK = Bicycle.preset("meijaard2007")
PAPER = Bicycle.preset("dikarev1981")
tilts, radii = st.floats(-1.2, 1.2), st.floats(0.05, 1)
offsets, wheelbases = st.floats(-0.9, 0.9), st.floats(0.3, 3)  # offsets: parts of the radius


@given(tilts, radii, offsets)
def test_trail_as_bicycleparameters_has_it(lam, R, part):
    along_the_ground, mechanical = trail_of_another_code(R, lam, part * R)
    assert trail_from(lam, part * R, R) == pytest.approx(along_the_ground, rel=1e-14, abs=1e-14)
    c = 1.1
    b = offset_of(lam, along_the_ground / c, c, R)
    assert b == pytest.approx(R * math.sin(lam) - mechanical, rel=1e-12, abs=1e-12)


@given(tilts, radii, offsets, wheelbases)
def test_any_two_of_tilt_trail_and_offset_give_the_third(lam, R, part, c):
    b = part * R
    trail = trail_from(lam, b, R)
    assume(abs(trail) < 50 * c)
    assert tilt_from(trail, b, R) == pytest.approx(lam, abs=1e-6)
    whole = {"head_angle": math.pi / 2 - lam, "trail": trail, "offset": b}
    for left_out in whole:
        two = {name: value for name, value in whole.items() if name != left_out}
        found = design_given(two, c, R)
        assert found == pytest.approx((lam, trail / c), abs=1e-6)
    assert design_given(whole, c, R) == pytest.approx((lam, trail / c), abs=1e-6)


def test_published_offset_of_a_motorcycle():
    """Sharp's machine: its fork offset is what wheel radius 1 ft, 27° and mechanical trail 0.38 ft leave."""
    sharp = Bicycle.preset("sharp1971")
    b = offset_of(sharp.lam, sharp.sigma, sharp.c, sharp.R2)
    assert b == pytest.approx((math.sin(math.radians(27)) - 0.38) * 0.3048, abs=1e-6)


@pytest.mark.parametrize("degrees", [*range(45, 100), 71.5, 72.5, 70.25])
def test_a_head_angle_in_degrees_is_the_double_of_its_tilt(degrees):
    tilt = quantity(f"{90 - degrees}deg", ANGLE)
    assert tilt_of(quantity(f"{degrees}deg", ANGLE)) == pytest.approx(tilt, rel=0, abs=2.3e-16)


def keys(bicycle, **given):
    values = {k: v for k, v in bicycle.given.items() if k not in ("lam", "sigma", *given)}
    if bicycle.bodies:
        values.pop("c")
    return Bicycle.from_mapping({**values, **given})


@pytest.mark.parametrize("bicycle", [BENCHMARK, PAPER], ids=["bodies", "parts"])
@pytest.mark.parametrize(
    "two",
    [
        {"head_angle": "71deg", "trail": "55mm"},
        {"head_angle": "71deg", "offset": "{b}"},
        {"trail": "5.5cm", "offset": "{b}"},
        {"lam": "19deg", "offset": "{b}"},
        {"lam": "19deg", "head_angle": "71deg", "trail": 0.055},
        {"head_angle": "71.00deg", "trail": "55.0mm", "offset": "{b}"},
    ],
)
def test_keys_of_a_bicycle(bicycle, two):
    b = float(bicycle.R2 * np.sin(np.radians(19)) - 0.055 * np.cos(np.radians(19)))
    found = keys(bicycle, **{k: b if v == "{b}" else v for k, v in two.items()})
    assert found.lam == pytest.approx(math.radians(19), abs=1e-12)
    assert found.sigma * found.c == pytest.approx(0.055, abs=1e-12)
    assert keys(found, lam=found.lam, trail=found.sigma * found.c).lam == found.lam


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (
            {"head_angle": "72deg", "trail": "55mm", "offset": "45mm"},
            "offset: a head angle of 72° and an offset of 45 mm give a trail of 66.4061 mm, not 55 mm\n",
        ),
        (
            {"head_angle": "71deg", "lam": "18deg", "trail": 0.05},
            "head_angle: head_angle and lam are both given, and differ: 0.331613 rad and 0.314159 rad\n",
        ),
        (
            {"trail": "55mm", "offset": "45cm"},
            "offset: no head angle gives this trail with an offset",
        ),
        (
            {"head_angle": 71, "trail": "55mm"},
            "head_angle: a head angle of 71 rad is out of range",
        ),
        ({"head_angle": "71mm"}, "head_angle: '71mm' is not a number: it is a length, not an angle"),
        ({"head_angel": "71deg"}, "head_angel: unknown parameter\ndid you mean 'head_angle'?"),
        ({"offset": "45mm"}, "missing parameters: c, lam\nc: trail along the ground [m]"),
        ({"head_angle": "72deg"}, "missing parameter: c\n"),
    ],
)
def test_refused_keys(given, told):
    with pytest.raises(InputError) as caught:
        keys(BENCHMARK, **given)
    assert str(caught.value).startswith(told)


def test_an_offset_alone_keeps_the_own_tilt():
    lam, sigma = design_given({"offset": 0.04}, BENCHMARK.c, BENCHMARK.R2, (BENCHMARK.lam, BENCHMARK.sigma))
    assert lam == BENCHMARK.lam
    assert offset_of(lam, sigma, BENCHMARK.c, BENCHMARK.R2) == pytest.approx(0.04, abs=1e-15)
    lam, sigma = design_given({"offset": 0.04}, BENCHMARK.c, BENCHMARK.R2, (None, BENCHMARK.sigma))
    assert sigma == BENCHMARK.sigma
    assert offset_of(lam, sigma, BENCHMARK.c, BENCHMARK.R2) == pytest.approx(0.04, abs=1e-15)
    assert design_given({"offset": 0.04}, BENCHMARK.c, BENCHMARK.R2) == (None, None)


def test_a_skate_has_no_tilt_of_trail_and_offset():
    with pytest.raises(InputError, match="no head angle gives this trail"):
        design_given({"trail": 0.1, "offset": -0.05}, 1.0, 0.0)


def test_trail_and_sigma_that_differ():
    with pytest.raises(InputError, match=r"trail and sigma are both given, and differ: 0.06 m and 0.05 m"):
        design_given({"trail": 0.06, "sigma": 0.05}, 1.0, 0.3)


@pytest.mark.parametrize("bicycle", [BENCHMARK, Bicycle.preset("sharp1971")], ids=["bodies", "parts"])
@pytest.mark.parametrize(
    "values",
    [
        {"head_angle": 1.25}, {"trail": 0.06}, {"offset": 0.05}, {"head_angle": 1.25, "offset": 0.05},
        {"trail": 0.06, "offset": 0.05}, {"lam": 0.32, "offset": 0.05}, {"head_angle": 1.25, "trail": 0.06},
    ],
)  # fmt: skip
def test_values_that_replace_the_own_ones(bicycle, values):
    """What is not given stays: the tilt with an offset alone, else the trail along the ground."""
    found = bicycle.replaced(values)
    trail = found.sigma * found.c
    seen = {"lam": found.lam, "head_angle": math.pi / 2 - found.lam, "trail": trail}
    seen["offset"] = offset_of(found.lam, found.sigma, found.c, found.R2)
    assert {name: seen[name] for name in values} == pytest.approx(values, abs=1e-12)
    if values.keys() <= {"trail", "offset"} and len(values) == 1:
        assert found.lam == bicycle.lam
    if values.keys() == {"head_angle"}:
        assert trail == pytest.approx(bicycle.sigma * bicycle.c, rel=1e-14)
