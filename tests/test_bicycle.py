"""Parameters, their checks and messages, both notations, presets and files."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle, parameters
from bikestab.errors import InputError
from bikestab.limits import LEAST, check_speed, check_tilt
from bikestab.model import characteristic_table
from bikestab.presets import preset_names, preset_text
from tests.strategies import machines, meijaard_machines

PAPER = {
    "R": 0.35, "c": 1.04, "g": 9.8, "delta": 0, "m1": 80, "l1": 0.4, "h1": 0.9, "A1": 3.3, "B1": 6.7,
    "C1": 0.5, "m2": 2.7, "l2": 0.9, "h2": 0.5, "A2": 0.036, "B2": 0.22, "C2": 0.5,
}  # fmt: skip
SOUND = {**PAPER, "A2": 0.3, "C2": 0.2}  # front inertias of a rigid body
BENCHMARK = {
    "w": 1.02, "c": 0.08, "lam": math.pi / 10, "g": 9.81, "rR": 0.3, "mR": 2, "IRxx": 0.0603, "IRyy": 0.12,
    "xB": 0.3, "zB": -0.9, "mB": 85, "IBxx": 9.2, "IByy": 11, "IBzz": 2.8, "IBxz": 2.4,
    "xH": 0.9, "zH": -0.7, "mH": 4, "IHxx": 0.05892, "IHyy": 0.06, "IHzz": 0.00708, "IHxz": -0.00756,
    "rF": 0.35, "mF": 3, "IFxx": 0.1405, "IFyy": 0.28,
}  # fmt: skip


def make(base=PAPER, **changes):
    """A bicycle with some values changed, or left out where None."""
    values = {**base, **changes}
    return Bicycle.from_mapping({key: value for key, value in values.items() if value is not None})


def refused(base, key, **changes):
    """The InputError that a change gives, after a check of the key it names."""
    with pytest.raises(InputError) as caught:
        make(base, **changes)
    assert caught.value.key == ((key,) if key else ())
    return caught.value


# --- the two notations


def test_paper_notation():
    bicycle = make(SOUND, D1=0.1, D2=-0.02)
    assert bicycle.numbers() == {
        **{key: float(value) for key, value in SOUND.items() if key != "R"},
        "R1": 0.35, "R2": 0.35, "D1": 0.1, "D2": -0.02, "lam": None, "sigma": None,
    }  # fmt: skip


def test_defaults():
    bicycle = make(g=None, delta=None)
    assert (bicycle.g, bicycle.delta, bicycle.D1, bicycle.D2) == (9.81, 0, 0, 0)
    assert (bicycle.lam, bicycle.sigma, bicycle.name, bicycle.source) == (None, None, "bicycle", "")


@settings(deadline=None, max_examples=60, derandomize=True)
@given(n=meijaard_machines())
def test_reduction_by_parallel_axes(n):
    """About the rear contact the moments of the bodies add up; x forward, up positive, z down."""
    bicycle = Bicycle.from_mapping(n)
    bodies = {
        "1": [("R", 0, n["rR"], n["IRxx"], 0), ("B", n["xB"], -n["zB"], n["IBzz"], n["IBxz"])],
        "2": [("H", n["xH"], -n["zH"], n["IHzz"], n["IHxz"]), ("F", n["w"], n["rF"], n["IFxx"], 0)],
    }
    for i, pair in bodies.items():
        m, l, h, A, B, D = (getattr(bicycle, letter + i) for letter in "mlhABD")  # noqa: E741  # the paper's letters
        expected = [
            sum(n["m" + b] for b, *_ in pair),
            sum(n["m" + b] * x for b, x, *_ in pair),
            sum(n["m" + b] * up for b, _, up, *_ in pair),
            sum(n[f"I{b}xx"] + n["m" + b] * up**2 for b, _, up, *_ in pair),
            sum(zz + n["m" + b] * x**2 for b, x, _, zz, _ in pair),
            sum(xz + n["m" + b] * x * up for b, x, up, _, xz in pair),
        ]
        product = D if i == "1" else -D  # D2 is minus their product of inertia
        found = [m, m * l, m * h, A + m * h**2, B + m * l**2, product + m * l * h]
        # sums of two or three terms, none larger than the moment about the contact
        assert found == pytest.approx(expected, rel=1e-14, abs=1e-14 * expected[3])
    same = {"c": "w", "R1": "rR", "R2": "rF", "C1": "IRyy", "C2": "IFyy", "g": "g", "lam": "lam"}
    assert all(getattr(bicycle, key) == n[theirs] for key, theirs in same.items())
    assert bicycle.sigma * bicycle.c == pytest.approx(n["c"], rel=1e-15)


def test_benchmark_by_hand():
    bicycle = make(BENCHMARK)
    assert (bicycle.m1, bicycle.m2) == (87, 7)
    pair1, pair2 = 2 * 85 / 87, 4 * 3 / 7  # reduced masses: each times the distances of its two bodies
    expected = {
        "l1": 85 * 0.3 / 87,
        "h1": (2 * 0.3 + 85 * 0.9) / 87,
        "A1": 9.2 + 0.0603 + pair1 * 0.6**2,
        "B1": 2.8 + 0.0603 + pair1 * 0.3**2,
        "D1": 2.4 + pair1 * 0.3 * 0.6,
        "D2": 0.00756 - pair2 * 0.12 * (0.35 - 0.7),
    }
    assert {key: getattr(bicycle, key) for key in expected} == pytest.approx(expected, rel=1e-14)


def test_trail_or_sigma():
    assert make(trail=0.0832, lam="12deg").sigma == pytest.approx(0.08, rel=1e-15)
    assert make(sigma=0.08).sigma == 0.08
    assert (
        str(refused(PAPER, "trail", trail=0.1, sigma=0.1))
        == "trail: trail and sigma are both given, and differ: 0.1 m and 0.104 m\ngive one of them"
    )


def test_radii():
    """One radius or two; only C/R enters the equations, so a wheel may be scaled with its inertia."""
    assert (make(R=None, R1=0.3, R2=0.4).R1, make(R=None, R1=0.3, R2=0.4).R2) == (0.3, 0.4)
    assert "give R, or R1 and R2" in str(refused(PAPER, "R2", R2=0.3))
    assert "missing parameter: R2" in str(refused(PAPER, "", R=None, R1=0.3))
    assert "missing parameter: R\n" in str(refused(PAPER, "", R=None))
    equal, other = (
        characteristic_table(make(SOUND, R=None, R1=0.35, R2=r, C2=r * 0.4), 0.2, 0.1) for r in (0.35, 0.2)
    )
    assert other == pytest.approx(equal, rel=1e-13)


@pytest.mark.parametrize("key", ["R1", "R2"])
def test_skates(key):
    """A wheel that does not spin may have any radius, even none."""
    C = "C" + key[1]
    n = {**SOUND, "R": None, "R1": 0.35, "R2": 0.35, C: 0}
    skate, still = make(n, **{key: 0}), make(n)
    assert np.array_equal(characteristic_table(skate, 0.2, 0.1), characteristic_table(still, 0.2, 0.1))
    error = refused(n, key, **{key: 0, C: 0.1})
    assert (
        str(error) == f"{key}: {key} = 0 (a skate) cannot spin, but {C} = 0.1\nallowed: {key} > 0, or {C} = 0"
    )


def test_massless_wheels():
    bicycle = make(BENCHMARK, mR=0, IRxx=0, IRyy=0, mF=0, IFxx=0, IFyy=0)
    assert (bicycle.m1, bicycle.l1, bicycle.h1, bicycle.A1) == pytest.approx((85, 0.3, 0.9, 9.2))
    assert (bicycle.m2, bicycle.l2, bicycle.h2, bicycle.D2) == pytest.approx((4, 0.9, 0.7, 0.00756))


def test_two_notations_mixed():
    error = refused(PAPER, "mB", mB=3)
    assert "unknown parameter (a key of the other notation)" in str(error)
    assert "unknown parameter (a key of the other notation)" in str(refused(BENCHMARK, "m2", m2=3))


# --- what is refused


@pytest.mark.parametrize(
    ("base", "key", "value", "limit"),
    [
        *((PAPER, key, value, "> 0") for key in ("c", "m1", "m2", "g") for value in (0, -1)),
        *((PAPER, key, -1e-9, ">= 0") for key in ("A1", "B1", "C1", "A2", "B2", "C2", "delta")),
        *((BENCHMARK, key, value, "> 0") for key in ("w", "g") for value in (0, -1)),
        *((BENCHMARK, key, -1, ">= 0") for key in ("mR", "mB", "mH", "mF", "rR", "rF", "delta")),
        *((BENCHMARK, f"I{body}{axes}", -1, ">= 0") for body in "RF" for axes in ("xx", "yy")),
        *((BENCHMARK, f"I{body}{axes}", -1, ">= 0") for body in "BH" for axes in ("xx", "yy", "zz")),
    ],
)
def test_sign(base, key, value, limit):
    """The message names the key as the user wrote it, its meaning and what is allowed."""
    error = refused(base, key, **{key: value})
    assert error.hint == f"allowed: {key} {limit}"
    assert f"{value:g} is not {'positive' if limit == '> 0' else 'non-negative'} (" in error.problem


@pytest.mark.parametrize("key", ["l1", "h1", "l2", "D1", "sigma", "trail", "lam"])
def test_what_may_be_negative(key):
    assert make(**{key: -0.01}) is not None


@pytest.mark.parametrize(("base", "key", "limit"), [
    (PAPER, "D1", math.sqrt(3.3 * 6.7)), (PAPER, "D2", math.sqrt(0.036 * 0.22)),
    (BENCHMARK, "IBxz", math.sqrt(9.2 * 2.8)), (BENCHMARK, "IHxz", math.sqrt(0.05892 * 0.00708)),
])  # fmt: skip
def test_product_of_inertia(base, key, limit):
    """|D| ≤ √(A B): at the limit it is a body in a line, beyond it is none."""
    for sign in (1, -1):
        assert make(base, **{key: sign * limit}) is not None
        error = refused(base, key, **{key: sign * limit * 1.001})
        assert error.hint == f"allowed: |{key}| <= {limit:.6g} kg m²"


@pytest.mark.parametrize("base", [PAPER, BENCHMARK])
def test_tilt(base):
    for lam in (math.pi / 2, -2, "90deg"):
        error = refused(base, "lam", lam=lam)
        assert "does not meet the ground" in error.problem
        assert "between -90deg and 90deg" in error.hint
    assert make(base, lam="18deg", **({} if "w" in base else {"sigma": 0})).lam == pytest.approx(math.pi / 10)
    with pytest.raises(InputError):
        check_tilt(math.nan, ("lam",))


@pytest.mark.parametrize(("bodies", "part"), [(("mR", "mB"), "rear"), (("mH", "mF"), "front")])
def test_part_without_mass(bodies, part):
    error = refused(BENCHMARK, bodies[1], **dict.fromkeys(bodies, 0))
    assert str(error) == f"{bodies[1]}: the {part} part has no mass\nallowed: {' + '.join(bodies)} > 0"


@pytest.mark.parametrize("value", [True, "heavy", "", [80], math.nan, math.inf, "80m", {}])
@pytest.mark.parametrize(("base", "key"), [(PAPER, "m1"), (BENCHMARK, "mB")])
def test_no_number(base, key, value):
    assert "allowed: a number" in refused(base, key, **{key: value}).hint
    assert refused(base, key, **{key: 10**400}).hint == "allowed: up to 1e+09 kg"


@pytest.mark.parametrize("value", ["1e400", 10**400])
@pytest.mark.parametrize(("base", "key"), [(PAPER, "m1"), (BENCHMARK, "mB")])
def test_a_number_that_no_double_holds(base, key, value):
    assert refused(base, key, **{key: value}).hint == "allowed: up to 1e+09 kg"


def test_no_number_for_none():
    with pytest.raises(InputError, match="m1: nothing is not a number"):
        Bicycle.from_mapping({**PAPER, "m1": None})


def test_text_keys():
    bicycle = make(name="tandem", source="a book")
    assert (bicycle.name, bicycle.source) == ("tandem", "a book")
    assert "3 is not text" in str(refused(PAPER, "name", name=3))


@pytest.mark.parametrize("key", [key for key in PAPER if key not in ("g", "delta", "R")])
def test_missing_in_the_papers_notation(key):
    assert f"missing parameter: {key}\n{key}: " in str(refused(PAPER, "", **{key: None}))


@pytest.mark.parametrize("key", [key for key in BENCHMARK if key not in ("w", "g", "IByy", "IHyy")])
def test_missing_in_meijaards_notation(key):
    assert f"missing parameter: {key}\n{key}: " in str(refused(BENCHMARK, "", **{key: None}))


def test_missing_several():
    with pytest.raises(InputError, match="missing parameters: B1, C2\nB1: rear central inertia"):
        make(B1=None, C2=None)


def test_unknown_key_suggests_a_known_one():
    assert str(refused(PAPER, "lambda", **{"lambda": 0.3})).startswith("lambda: unknown parameter\n")
    assert "did you mean 'IHzz'?" in str(refused(BENCHMARK, "IHZZ", IHZZ=0))
    assert "did you mean 'delta'?" in str(refused(PAPER, "Delta", Delta=0))


def test_constructor_checks_too():
    numbers = {key: value for key, value in make().numbers().items() if value is not None}
    with pytest.raises(InputError, match="m1: -1 is not positive"):
        Bicycle(**{**numbers, "m1": -1})
    with pytest.raises(InputError, match="delta: -1 is not non-negative"):
        make().with_delta(-1)


# --- what is warned of


def test_warnings_of_the_papers_values():
    """Computed with all the same; the sentences carry the numbers."""
    assert make().warnings == (
        "no rigid front part has A2 + B2 < C2: 0.036 + 0.22 = 0.256 < 0.5 kg m²",
        "no wheel within the front part has C2 > m2 R2²: 0.5 > 0.33075 kg m²",
    )
    assert make(SOUND).warnings == ()
    assert make(BENCHMARK).warnings == ()


@pytest.mark.parametrize(
    ("base", "changes", "words"),
    [
        (SOUND, {"C1": 11, "m1": 100}, "rear part has A1 + B1 < C1"),
        (SOUND, {"C1": 9.9}, "no wheel within the rear part has C1 > m1 R1²"),
        (SOUND, {"A2": 0.02}, "no front part with a wheel of C2 = 0.2 has A2 = 0.02 < 0.1929 kg m²"),
        (SOUND, {"B2": 0.03}, "no front part with a wheel of C2 = 0.2 has B2 = 0.03 < 0.1809 kg m²"),
        (SOUND, {"h1": -0.1}, "the rear centre of mass is below the ground: h1 = -0.1 m"),
        (SOUND, {"h2": -0.1, "A2": 3}, "the front centre of mass is below the ground: h2 = -0.1 m"),
        (BENCHMARK, {"IRyy": 0.1209}, "no rigid rear wheel has IRyy > 2 IRxx"),
        (BENCHMARK, {"IFyy": 0.2813}, "no rigid front wheel has IFyy > 2 IFxx"),
        (BENCHMARK, {"IByy": 12.3}, "no rigid body has IByy = 12.3"),
        (BENCHMARK, {"IByy": 7}, "allowed 8 ... 12; IByy itself does not matter here, the others do"),
        (BENCHMARK, {"IHyy": 0.0661}, "no rigid fork has IHyy = 0.0661"),
    ],
)
def test_warnings(base, changes, words):
    (warning,) = make(base, **changes).warnings
    assert words in warning


@settings(max_examples=200, deadline=None)
@given(
    st.floats(0.5, 1), st.floats(0.5, 1), st.floats(0.01, 0.99), st.floats(-1, 1), st.floats(-1, 1),
    st.floats(0.2, 0.5),
)  # fmt: skip
def test_a_wheel_and_a_point_mass_are_a_possible_front_part(rim, thickness, share, x, z, R):
    """Put together by the parallel-axis theorem; with less inertia than a rim and a point mass it is not."""
    R *= 1.0123456789012345  # numbers of 16 digits, whose last one is no reason to look away
    m, wheel, rest = 10.0, share * 10.0, (1 - share) * 10.0
    l2, h2 = PAPER["c"] - rest / m * x, R + rest / m * z  # the wheel's centre is at (c, R)
    assume(h2 >= 0)
    C2 = rim * wheel * R**2
    A2, B2 = (thickness * C2 + wheel * rest / m * away**2 for away in (z, x))
    values = {**SOUND, "m2": m, "R": R, "C1": 0, "C2": C2, "A2": A2, "B2": B2, "l2": l2, "h2": h2}
    assert make(values).warnings == ()
    least = C2 / 2 + C2 / R**2 * m / (m - C2 / R**2) * (R - h2) ** 2
    assume(least + B2 > (1 + 1e-6) * C2)  # or else that is what is told
    assert make({**values, "A2": (1 + 1e-8) * least}).warnings == ()
    (warning,) = make({**values, "A2": (1 - 1e-8) * least}).warnings
    assert "no front part with a wheel of C2 = " in warning


def test_pitch_inertias_are_optional_and_without_effect():
    with_, without = make(BENCHMARK), make(BENCHMARK, IByy=None, IHyy=None)
    assert with_ == without


@settings(deadline=None, max_examples=60, derandomize=True)
@given(machine=machines)
def test_possible_machines_pass(machine):
    """The only remarks may be about the geometry, and in the paper's notation about the wheels in a part."""
    about_a_wheel = ("no wheel within", "part with a wheel of") if "A2" in machine else ()
    about_a_wheel += ("the wheels overlap", "is a head angle of")
    warnings = Bicycle.from_mapping(machine).warnings
    assert not [text for text in warnings if not any(words in text for words in about_a_wheel)]


# --- presets, files, identity


def test_presets():
    assert preset_names() == ["dikarev1981", "kooijman2011", "meijaard2007", "sharp1971"]
    printed = make(name="dikarev1981")
    assert dataclasses.replace(Bicycle.preset("dikarev1981"), source="") == printed
    benchmark = make(BENCHMARK, name="meijaard2007")
    assert dataclasses.replace(Bicycle.preset("meijaard2007"), source="") == benchmark
    for name in preset_names():
        assert "19" in Bicycle.preset(name).source or "20" in Bicycle.preset(name).source
        assert preset_text(name).startswith("# The ")


def test_unknown_preset():
    with pytest.raises(InputError, match="there is no bicycle 'meijard2007'\ndid you mean 'meijaard2007'"):
        Bicycle.preset("meijard2007")
    with pytest.raises(InputError, match="known: dikarev1981, kooijman2011, meijaard2007"):
        Bicycle.load("penny-farthing")


def test_load_prefers_presets_to_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for file in ("dikarev1981", "mine", "mine.yaml"):
        (tmp_path / file).write_text(preset_text("meijaard2007").replace("name: meijaard2007\n", ""), "utf-8")
    assert Bicycle.load("dikarev1981") == Bicycle.preset("dikarev1981")
    assert Bicycle.load("./dikarev1981").m1 == 87
    assert Bicycle.load("mine").name == "mine"
    assert Bicycle.load("mine.yaml").name == "mine"
    with pytest.raises(InputError, match=r"other\.yaml: there is no such file"):
        Bicycle.load("other.yaml")


def test_error_in_a_file_names_the_line(tmp_path):
    file = tmp_path / "mine.yaml"
    text = preset_text("dikarev1981")
    line = 1 + next(i for i, row in enumerate(text.splitlines()) if row.startswith("m2:"))
    file.write_text(text.replace("m2: 2.7 ", "m2: -2.7"), "utf-8")
    with pytest.raises(InputError) as caught:
        Bicycle.from_file(file)
    assert caught.value.place == f"{file}, line {line}"
    assert str(caught.value).startswith(
        f"{file}, line {line}: m2: -2.7 is not positive (mass of the front part [kg])"
    )


def test_a_derived_value_is_reported_at_the_users_key(tmp_path):
    """Meijaard's keys are checked before the reduction, so the message never names a key not written."""
    file = tmp_path / "mine.yaml"
    file.write_text(preset_text("meijaard2007").replace("IHxz: -0.00756", "IHxz: -0.5"), "utf-8")
    with pytest.raises(InputError, match=r"mine.yaml, line \d+: IHxz: "):
        Bicycle.from_file(file)


def test_immutable_and_hashable():
    bicycle = make()
    with pytest.raises(dataclasses.FrozenInstanceError):
        bicycle.m1 = 3
    assert hash(bicycle) == hash(make())


def test_with_delta():
    bicycle = make(delta=2)
    assert bicycle.with_delta(None) is bicycle
    assert bicycle.with_delta(0.5) == make(delta=0.5)
    assert bicycle.delta == 2


def test_with_delta_keeps_the_notation_and_its_warnings():
    bodies = {**BENCHMARK, "IRyy": 0.13}
    damped = Bicycle.from_mapping(bodies).with_delta(0.5)
    assert damped == Bicycle.from_mapping({**bodies, "delta": 0.5})
    assert damped.given == {**damped.given, **bodies, "delta": 0.5}
    assert any("IRyy > 2 IRxx" in warning for warning in damped.warnings)


def test_replaced_in_either_notation():
    bicycle = Bicycle.preset("dikarev1981")
    assert bicycle.notation["m1"] == "mass of the rear part with rider [kg]"
    assert bicycle.replaced({"m1": 70}) == dataclasses.replace(bicycle, m1=70)
    assert bicycle.replaced({"R": 0.3}) == dataclasses.replace(bicycle, R1=0.3, R2=0.3)
    benchmark = Bicycle.preset("meijaard2007")
    assert benchmark.notation["mB"] == "body mass [kg]"
    expected = Bicycle.from_mapping({**BENCHMARK, "mB": 70, "source": benchmark.source}, name="meijaard2007")
    assert benchmark.replaced({"mB": 70}) == expected
    assert benchmark.replaced({"mB": 70}).replaced({"mB": BENCHMARK["mB"]}) == benchmark
    with pytest.raises(InputError, match=r"^mB: -70 is not non-negative"):
        benchmark.replaced({"mB": -70})
    with pytest.raises(InputError, match=r"^mB: unknown parameter"):
        bicycle.replaced({"mB": 70})


def test_a_reduced_bicycle_with_another_mass_is_one_in_the_papers_notation():
    changed = dataclasses.replace(Bicycle.preset("meijaard2007"), m1=90)
    assert changed.replaced({"m2": 8}).m1 == 90


def test_every_parameter_says_its_unit_and_meaning():
    for p in parameters():
        assert p.metadata["unit"]
        assert p.metadata["meaning"]
    assert [p.name for p in parameters()] == list(make().numbers())


@pytest.mark.parametrize("name", ["delta", "R1", "R2", "g"])
def test_numbers_whose_products_would_underflow(name):
    given = dict(Bicycle.preset("dikarev1981").given)
    Bicycle.from_mapping({**given, name: LEAST})
    with pytest.raises(InputError, match=rf"{name}: 1e-160 is out of range\nallowed: 0, or from 1e-50 on"):
        Bicycle.from_mapping({**given, name: 1e-160})


def test_speeds_whose_products_would_underflow():
    check_speed(0.0, ("V",))
    check_speed(LEAST, ("V",))
    with pytest.raises(InputError, match=r"V: 1e-160 m/s is out of range"):
        check_speed(1e-160, ("V",))
