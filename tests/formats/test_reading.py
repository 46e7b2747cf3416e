"""Files of other programs, read as bicycles: what is kept, left out, and refused."""

import math

import pytest

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError

BENCHMARK = {
    "w": 1.02, "c": 0.08, "lam": math.pi / 10, "g": 9.81, "rR": 0.3, "mR": 2, "IRxx": 0.0603, "IRyy": 0.12,
    "xB": 0.3, "zB": -0.9, "mB": 85, "IBxx": 9.2, "IByy": 11, "IBzz": 2.8, "IBxz": 2.4,
    "xH": 0.9, "zH": -0.7, "mH": 4, "IHxx": 0.05892, "IHyy": 0.06, "IHzz": 0.00708, "IHxz": -0.00756,
    "rF": 0.35, "mF": 3, "IFxx": 0.1405, "IFyy": 0.28,
}  # fmt: skip
PRESET = Bicycle.preset("meijaard2007")


@pytest.fixture(params=["text", "flat", "values"])
def load(request, tmp_path):
    """A bicycle from a file of these keys in one of the formats."""

    def loaded(values):
        if request.param == "text":
            path, text = tmp_path / "b.txt", "".join(f"{k}={v!r}\n" for k, v in values.items())
        else:
            path, text = tmp_path / "b.yml", "".join(f"{k}: {v!r}\n" for k, v in values.items())
            if request.param == "values":
                inner = "".join(f"  {line}\n" for line in text.splitlines())
                head = "parameterization: Meijaard2007\ndescription: ''\nparameters: ''\nrider: null\n"
                text = f"{head}values:\n{inner}"
        path.write_text(text, "utf-8")
        return Bicycle.load(str(path))

    return loaded


def test_the_same_machine(load):
    assert load(BENCHMARK).numbers() == PRESET.numbers()
    assert load(dict(reversed(BENCHMARK.items()))).given == {k: float(v) for k, v in BENCHMARK.items()}
    assert load(BENCHMARK).notes == ()


def test_pitch_inertias_may_be_missing(load):
    found = load({k: v for k, v in BENCHMARK.items() if k not in ("IByy", "IHyy", "g")})
    assert found.numbers() == PRESET.numbers()


def test_extra_keys_are_told_of_once(load):
    lam, w, c = BENCHMARK["lam"], 1.02, 0.08
    extra = {
        "v": 5.0, "yB": 2.77e-08, "yH": 0.0, "IRzz": 0.0603, "IFzz": 0.1405, "xcl": 0.55, "lcs": 0.46,
        "d1": math.cos(lam) * (w + c - 0.3 * math.tan(lam)),
        "d3": 0.35 * math.sin(lam) - c * math.cos(lam),  # the fork's offset
    }  # fmt: skip
    found = load({**extra, **BENCHMARK})
    assert found.numbers() == PRESET.numbers()
    (note,) = found.notes
    assert note == (
        "not in the equations, left out: v, xcl, lcs; "
        "follow from the others, and agree: yB, yH, IRzz, IFzz, d1, d3"
    )


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("IRzz", 0.07, "0.07 is not what the others say, IRxx = 0.0603"),
        ("IFzz", 0.14, "0.14 is not what the others say, IFxx = 0.1405"),
        ("yB", 0.01, "0.01 is not what the others say, 0 = 0"),
        ("d3", 0.05, "0.05 is not what the others say, cos(lam) (rF tan(lam) - c) = 0.0320714267"),
        ("d1", 1.0, "1 is not what the others say, cos(lam) (w + c - rR tan(lam)) = 0.95345707"),
        ("kTphi_phid", -50.0, "-50 is not what the others say, 0 = 0"),
    ],
)
def test_extra_keys_that_contradict(load, key, value, words):
    with pytest.raises(InputError, match=key) as caught:
        load({**BENCHMARK, key: value})
    assert caught.value.problem == words
    assert caught.value.place.partition(", ")[2] in (
        f"line {len(BENCHMARK) + 1}",
        f"line {len(BENCHMARK) + 6}",
    )


def test_extra_keys_beside_units_and_uncertainties(tmp_path):
    """They are compared in SI units; what could not be compared is not said to agree."""
    path = tmp_path / "b.yaml"

    def load(**changes):
        path.write_text("".join(f"{k}: {v}\n" for k, v in {**BENCHMARK, **changes}.items()), "utf-8")
        return Bicycle.load(str(path))

    assert load(w="1020mm", lam="18deg", xF=1.02).notes == ("follow from the others, and agree: xF",)
    for changes in ({"w": "1.02m", "d1": 99}, {"lam": "18deg", "d3": 5}, {"w": '"1.02 +/- 0.01"', "xF": 5}):
        with pytest.raises(InputError, match="is not what the others say"):
            load(**changes)
    assert load(kRbb=0.1).notes == ("cannot be compared with the others, left out: kRbb",)
    for key in ("mB", "xF", "yB", "nonsense"):
        for digits in (309, 400, 401):
            with pytest.raises(InputError, match=key if digits <= 400 else "401 characters"):
                load(**{key: digits * "9"})


def test_no_number(load):
    with pytest.raises(InputError) as caught:
        load({**BENCHMARK, "mB": math.nan})
    assert "mB" in str(caught.value)
    with pytest.raises(InputError) as caught:
        load({**BENCHMARK, "IBxy": math.nan})
    assert "IBxy" in str(caught.value)


def test_deviations(tmp_path):
    lines = [f"{k} = {v!r}+/-{0.01 * abs(v)!r}\n" for k, v in BENCHMARK.items() if k not in ("g", "lam")]
    path = tmp_path / "measured.txt"
    path.write_text("".join(lines) + "lam = pi/10 +/- 0.0\nv = 5 +/- 0.1\n", "utf-8")
    bicycle = Bicycle.load(str(path))
    assert bicycle.deviations == {
        k: 0.01 * abs(v) for k, v in BENCHMARK.items() if k not in ("g", "lam")
    }  # what is not known to vary, or is no parameter, has none
    assert (bicycle.name, bicycle.numbers()) == ("measured", PRESET.numbers())
    heavier = bicycle.replaced({"mB": 100})
    assert heavier.deviations == {k: sd for k, sd in bicycle.deviations.items() if k != "mB"}
    assert bicycle.with_delta(1.0).deviations == bicycle.deviations
    assert bicycle == Bicycle.from_mapping(BENCHMARK | {"name": "measured"})


PAPER = {k: v for k, v in Bicycle.preset("dikarev1981").numbers().items() if v is not None and k != "sigma"}


def uncertain(tmp_path, values):
    """A bicycle from a file of these."""
    path = tmp_path / "u.yaml"
    path.write_text("".join(f"{k}: {v}\n" for k, v in values.items()), "utf-8")
    return Bicycle.load(str(path))


def test_uncertainties_of_keys_that_stand_for_others(tmp_path):
    rest = {k: v for k, v in BENCHMARK.items() if k not in ("lam", "c")}
    found = uncertain(tmp_path, {**rest, "head_angle": "1.2566 +/- 0.017", "trail": "0.08 +/- 0.002"})
    assert found.deviations == pytest.approx({"lam": 0.017, "c": 0.002}, rel=1e-9)
    assert found.correlations == {}
    assert found.replaced({"head_angle": 1.2}).deviations == pytest.approx({"c": 0.002}, rel=1e-9)

    radii = {k: v for k, v in PAPER.items() if k not in ("R1", "R2")}
    both = uncertain(tmp_path, {**radii, "R": "0.35 +/- 0.01"})
    assert both.deviations == {"R1": 0.01, "R2": 0.01}
    assert both.correlations == {("R1", "R2"): pytest.approx(1, abs=1e-15)}

    own = uncertain(tmp_path, {**PAPER, "c": "1.04 +/- 0.01", "trail": "0.08 +/- 0.002"})  # σ = trail/c
    parts = (0.002 / 1.04, 0.08 * 0.01 / 1.04**2)
    assert own.deviations == pytest.approx({"c": 0.01, "sigma": math.hypot(*parts)}, rel=1e-8)
    assert own.correlations["c", "sigma"] == pytest.approx(-parts[1] / math.hypot(*parts), rel=1e-8)


def test_an_uncertain_offset(tmp_path):
    """The trail is (rF sin λ − b)/cos λ; by derivatives worked out by hand."""
    rest = {k: v for k, v in BENCHMARK.items() if k != "c"}
    lam, b = rest["lam"], 0.032
    found = uncertain(
        tmp_path, {**rest, "lam": f"{lam} +/- 0.01", "offset": f"{b} +/- 0.001", "mB": "85 +/- 1"}
    )
    by_lam = 0.01 * (0.35 - b * math.sin(lam)) / math.cos(lam) ** 2
    by_b = 0.001 / math.cos(lam)
    assert found.deviations == pytest.approx({"lam": 0.01, "mB": 1, "c": math.hypot(by_lam, by_b)}, rel=1e-8)
    assert list(found.correlations.values()) == pytest.approx([by_lam / math.hypot(by_lam, by_b)], rel=1e-8)
    with pytest.raises(InputError, match=r"line 27: offset: its uncertainty changes nothing"):
        uncertain(
            tmp_path, {**rest, "head_angle": math.pi / 2 - lam, "offset": "0.03207 +/- 0.001", "trail": 0.08}
        )


def test_a_rider_with_uncertainties(tmp_path):
    rider = "{m: 10 +/- 2, x: 0.3, z: -1 +/- 0.1, Ixx: 1, Izz: 1, Ixz: 0, scale_inertia: true}"
    found = uncertain(tmp_path, {**BENCHMARK, "rider": rider})
    assert found.deviations == {"rider.m": 2, "rider.z": 0.1}
    assert found.given["rider.inertia_mass"] == 10
    with pytest.raises(InputError, match=r"rider\.inertia_mass: is a mass to compare with"):
        uncertain(
            tmp_path, {**BENCHMARK, "rider": rider.replace("scale_inertia: true", "inertia_mass: 10 +/- 2")}
        )
