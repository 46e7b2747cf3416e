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
        ("kTdel_phid", -50.0, "-50 is not what the others say, 0 = 0"),
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
