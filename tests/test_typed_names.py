"""Values that no machine can have are told of by the parameter that was given, without a warning of numpy."""

import re
import warnings

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab import Bicycle
from bikestab.errors import InputError
from bikestab.notation import MEIJAARD
from bikestab.rider import RIDER
from bikestab.variants import FRONT, check_values, machine_at

BIKE = Bicycle.preset("meijaard2007")
PAPER = Bicycle.preset("dikarev1981").replaced({"lam": 0.2, "sigma": 0.08})
RIDDEN = Bicycle.from_mapping(
    {**BIKE.given, **dict.fromkeys(RIDER, 1.0), "rider.m": 75, "rider.z": -1.1, "rider.Ixz": 0.0}
)
PARTS = [*PAPER.given, "R"]
NAMES = [
    *((bicycle, name) for bicycle in (BIKE, PAPER, RIDDEN) for name in sorted({*bicycle.given, *FRONT})),
    *((BIKE, name) for name in PARTS if name not in MEIJAARD),
    (PAPER, "R"),
]
VALUES = st.sampled_from(
    [0.0, -0.5, -1.0, 1e-320, 1e-60, 1e-5, 1.0, 30.0, 1e5, 1e9, 1000000001.0, 1e12, 1e300]
)


def told(bicycle, values):
    """The mistake in these values, if there is one."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            check_values(bicycle, values)
            machine_at(bicycle, values)
        except InputError as error:
            return error.mistakes[0]
    return None


@pytest.mark.parametrize(("bicycle", "name"), NAMES, ids=lambda x: x if isinstance(x, str) else x.name)
def test_a_value_that_cannot_be_is_named_as_it_was_given(bicycle, name):
    """The limit that is told is one: the value that is named is beyond it."""
    for value in (0.0, -1.0, 1e-320, 1e5, 1e9, 1000000001.0, 1e300):
        error = told(bicycle, {name: value})
        if error:
            assert error.key == (name,)
            assert "nan" not in error.problem
            found, limit = re.search(r"(\S+) is out of range$", error.problem), "allowed: up to 1e+09"
            if found and error.hint == limit:
                assert abs(float(found[1])) > 1e9
    assert told(bicycle, {name: 2e9})


@settings(max_examples=150, deadline=None)
@given(st.sampled_from((BIKE, PAPER, RIDDEN)), st.data())
def test_of_several_values_one_that_was_given_is_named(bicycle, data):
    names = sorted(bicycle.given.keys() - {"lam", "sigma"})
    values = data.draw(st.dictionaries(st.sampled_from(names), VALUES, min_size=1, max_size=4))
    error = told(bicycle, values)
    assert error is None or error.key[0] in values


@pytest.mark.parametrize(
    ("values", "problem", "hint"),
    [
        ({"w": 0.0}, "0 is not positive (wheelbase [m])", "w > 0"),
        ({"mB": 1e9}, "1e+09 is too much: the rear part's m1 = 1000000002 is out of range", "up to 1e+09"),
        ({"mB": 1000000001.0}, "1000000001 is out of range", "up to 1e+09"),
        ({"xB": 1e12}, "1e+12 is out of range", "up to 1e+09"),
        ({"rF": 0.0}, "rF = 0 (a skate) cannot spin, but IFyy = 0.28", "rF > 0, or IFyy = 0"),
        ({"IBxx": 0.0}, "0 does not go with IBxz: |2.4| is more than √(IBxx IBzz) = 0", "|IBxz| <= 0 kg m²"),
        ({"A1": 0.0}, "0 does not go with D1: |2.75172| is more than √(A1 B1) = 0", "|D1| <= 0 kg m²"),
        (
            {"w": 5e-4},
            "with w = 0.0005: a trail of 160 wheelbases is out of range",
            "-100 ... 100; sigma = trail / wheelbase",
        ),
        ({"R": 0.0}, "R1 = 0 (a skate) cannot spin, but C1 = 0.12", "R1 > 0, or C1 = 0"),
    ],
)
def test_what_is_said(values, problem, hint):
    assert str(told(BIKE, values)) == f"{next(iter(values))}: {problem}\nallowed: {hint}"


def test_sigma_is_the_trail_of_25_parameters_too():
    """Divided by the wheelbase that is put in with it."""
    assert BIKE.replaced({"sigma": 0.05}).given["c"] == pytest.approx(0.05 * 1.02, rel=1e-15)
    wider = BIKE.replaced({"sigma": 0.05, "w": 1.1})
    assert (wider.given["c"], wider.sigma) == pytest.approx((0.055, 0.05), rel=1e-15)
    with pytest.raises(InputError, match="a trail of 200 wheelbases is out of range"):
        BIKE.replaced({"sigma": 200.0})
    for other in ("trail", "c"):
        with pytest.raises(InputError, match="are both given"):
            BIKE.replaced({"sigma": 0.08, other: 0.06})
