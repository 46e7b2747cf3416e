"""Bicycles that JBike6 saved, by their own names: x forward, y up, diameters, principal moments, u and v.

No file of the program's own is here: these are written by hand with the names and the meanings that its
published sources have; the right answer follows from another notation or from tensors in three dimensions.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bikestab as bs
from bikestab.errors import InputError

# Meijaard et al. (2007): principal moments of few digits, at angles with rational tangents
BENCHMARK = {
    "wheelbase": "1.02", "trail": ".08", "head_angle": "pi/2-pi/10", "gravity": "9.81",
    "Drearwheel": "0.6", "mrearwheel": "2", "Irearwheel": "[0.0603 0.0603 0.12]", "alphaIrearwheel": "0",
    "Dfrontwheel": "7d-1", "mfrontwheel": "3", "Ifrontwheel": "[0.1405, 0.1405, 0.28]",
    "mframe": "85", "xcmframe": "0.3", "ycmframe": "0.9", "Iframe": "[10 2 11]", "alphaIframe": "-atan(1/3)",
    "mfork": "4", "ucmfork": "-0.2*cos(pi/10)+0.7*sin(pi/10)", "vcmfork": "0.2*sin(pi/10)+0.7*cos(pi/10)",
    "Ifork": "0.06.*[1 1/10 1]", "alphaIfork": "atan(1/7)",
    "mrider": "0", "xcmrider": "0", "ycmrider": "0", "Irider": "[0 0 0]", "alphaIrider": "0",
    "mrack": "0", "xcmrack": "0", "ycmrack": "0", "Irack": "[0.00 0.00 0.00]", "alphaIrack": "0",
    "mbasket": "0", "ucmbasket": "0", "vcmbasket": "0", "Ibasket": "[0 0 0]", "alphaIbasket": "0",
}  # fmt: skip


def text(**changes):
    values = {**BENCHMARK, **{key: str(value) for key, value in changes.items()}}
    lines = [f"{key} = {value}; % remark" for key, value in values.items() if value != "None"]
    return "\n".join(["% JBini_made.m", "name = 'made, by; hand'", "", *lines])


@pytest.fixture
def loaded(tmp_path):
    def load(**changes):
        (tmp_path / "JBini_made.m").write_text(text(**changes), "utf-8")
        return bs.Bicycle.load(str(tmp_path / "JBini_made.m"))

    return load


def test_the_benchmark(loaded):
    found, expected = loaded(), bs.Bicycle.preset("meijaard2007")
    for key, value in expected.given.items():
        assert found.given[key] == pytest.approx(value, rel=1e-14, abs=1e-16), key
    assert (found.name, found.notes, found.warnings) == ("made, by; hand", (), ())
    own = bs.stable_intervals(found)
    assert (own.V1[0], own.V2[0]) == pytest.approx((4.29238253634111, 6.02426201538837), rel=1e-13)


def test_gravity_is_that_of_the_program(loaded):
    found = loaded(gravity=None)
    assert found.g == 9.80665
    assert found.notes == ("gravity is JBike6's own, 9.80665 m/s²",)


DEGREES = {"head_angle": "72", "alphaIframe": "-atan(1/3)*180/pi", "alphaIfork": "atan(1/7)*180/pi"}


@pytest.mark.parametrize(
    ("angles", "note"),
    [
        ({}, ()),
        ({"angle_units": 1}, ()),
        (DEGREES, ("angles are in degrees",)),
        ({**DEGREES, "angle_units": 2}, ("angles are in degrees",)),
        ({"angle_units": 2}, ("angles are in radians, as angle_units = 2 tells what JBike6 shows",)),
        ({"head_angle": None, "lambda": "pi/10"}, ()),
    ],
)
def test_degrees_or_radians(loaded, angles, note):
    found, expected = loaded(**angles), loaded()
    assert found.notes == note
    for key, value in expected.given.items():
        assert found.given[key] == pytest.approx(value, rel=1e-14, abs=1e-16), key


def tensor(mass, x, h, moments, alpha):
    """Mass, place, and inertia tensor in axes forward, up and to the right."""
    sin, cos = math.sin(alpha), math.cos(alpha)
    turn = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
    return mass, np.array([x, h, 0.0]), turn @ np.diag(moments) @ turn.T


def together(*bodies):
    """Bodies as one: mass, centre of mass, and the tensor about it."""
    mass = sum(body[0] for body in bodies)
    place = sum(body[0] * body[1] for body in bodies) / mass
    total = np.zeros((3, 3))
    for m, at, own in bodies:
        r = at - place
        total += own + m * (r @ r * np.eye(3) - np.outer(r, r))
    return mass, place, total


@settings(deadline=None, max_examples=25, derandomize=True)
@given(st.lists(st.floats(0.1, 1.0), min_size=35, max_size=35), st.floats(1.0, 1.4))
def test_any_bodies(tmp_path_factory, numbers, head_angle):
    """Frame and rack are one body, fork and basket another, and the rider stays apart."""
    folder = tmp_path_factory.getbasetemp()
    n, changes, bodies = iter(numbers), {"head_angle": head_angle}, {}
    lam, foot = math.pi / 2 - head_angle, 1.02 + 0.08
    for name in ("frame", "rack", "rider", "fork", "basket"):
        mass, a, b, I11, extra, spread, alpha = (next(n) for _ in range(7))
        moments = (I11, I11 + extra, extra + spread * 2 * I11)  # as rigid bodies have
        axes = "uv" if name in ("fork", "basket") else "xy"
        changes |= {f"m{name}": mass, f"{axes[0]}cm{name}": a, f"{axes[1]}cm{name}": b}
        changes |= {f"I{name}": "[" + " ".join(map(repr, moments)) + "]", f"alphaI{name}": alpha}
        if axes == "uv":
            a, b = foot + a * math.cos(lam) - b * math.sin(lam), a * math.sin(lam) + b * math.cos(lam)
        bodies[name] = tensor(mass, a, b, moments, alpha)
    (folder / "any.m").write_text(text(**changes), "utf-8")
    found = bs.Bicycle.load(str(folder / "any.m"))
    assert "frame and rack are joined as B" in found.notes
    assert "fork and basket are joined as H" in found.notes
    for inertia, (m, x, z), joined in (
        ("IB", ("mB", "xB", "zB"), together(bodies["frame"], bodies["rack"])),
        ("IH", ("mH", "xH", "zH"), together(bodies["fork"], bodies["basket"])),
        ("rider.I", ("rider.m", "rider.x", "rider.z"), bodies["rider"]),
    ):
        mass, place, t = joined
        expected = {m: mass, x: place[0], z: -place[1]}
        expected |= {"xx": t[0, 0], "yy": t[2, 2], "zz": t[1, 1], "xz": -t[0, 1]}  # z is down, and up is here
        for key, value in expected.items():
            key = key if key in (m, x, z) else inertia + key
            assert found.given[key] == pytest.approx(value, rel=1e-12, abs=1e-14), key


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"wheelbase": None}, "wheelbase: is missing\na bicycle of JBike6 has"),
        ({"head_angle": None}, "head_angle: is missing"),
        ({"mfork": None}, "mfork: is missing"),
        (
            {"Dfrontwheel": "big"},
            "line 12: Dfrontwheel: 'big' is not a number\nallowed: a number, or arithmetic",
        ),
        ({"trail": "2^3^2"}, r"trail: '2\^3\^2' is not a number"),
        ({"trail": "1e999"}, "trail: '1e999' is not a number"),
        ({"trail": "sqrt(-1)"}, r"trail: 'sqrt\(-1\)' is not a number"),
        ({"trail": "0x10"}, "trail: '0x10' is not a number"),
        ({"trail": "(" * 240}, "trail: '((((((((((((((((((((((((((( ... "),
        (
            {"Iframe": "[1 2]"},
            r"Iframe: \(1.0, 2.0\) is not three moments\nallowed: three numbers in brackets",
        ),
        (
            {"Irearwheel": "[1 2 3]"},
            "Irearwheel: a wheel has one moment about all its diameters, not 1 and 2",
        ),
        ({"mframe": "-85"}, "line 15: mframe: -85 kg is negative"),
        ({"mrearwheel": "-2"}, "line 9: mrearwheel: -2 is not non-negative"),
        ({"head_angle": "72", "angle_units": 1}, "head_angle: 72 is no angle in radians"),
        (
            {"head_angle": "0"},
            r"head_angle: a steering axis tilted by 1.5708 rad does not meet the ground",
        ),
        ({"Ifork(1:2)": "3"}, r"line 40: 'Ifork\(1:2\) = 3' is no assignment\nallowed: NAME = VALUE"),
        ({"mrider": "80", "xcmrider": None}, "xcmrider: is missing"),
    ],
)
def test_mistakes(loaded, changes, message):
    with pytest.raises(InputError, match=message.replace("(" * 27, r"\({27}")):
        loaded(**changes)


def test_what_nobody_asks_for_may_be_anything(loaded):
    """Colours, text and functions of the script are no reason to refuse it."""
    found = loaded(work_dir="'a%b'", axis_color="[0 0 0]", speeds="linspace(0, 10)", offset="0.044")
    assert found.given == loaded().given
