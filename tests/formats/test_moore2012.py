"""Axes along the steering axis, held against the conversion that BicycleParameters itself uses."""

import json
import math

import pytest
from dtk.bicycle import benchmark_parameters, benchmark_to_moore
from hypothesis import given, settings
from hypothesis import strategies as st

import bikestab as bs
from bikestab.errors import InputError
from bikestab.notation import MEIJAARD

BENCHMARK = {key: float(value) for key, value in benchmark_parameters().items()}
KEYS = [key for key in MEIJAARD if key not in ("delta", "g")]


def load(values, folder):
    path = folder / "m.yml"
    path.write_text(json.dumps({"parameterization": "Moore2012", "values": values}), "utf-8")
    return bs.Bicycle.load(str(path))


def test_the_benchmark(tmp_path):
    found = load({**benchmark_to_moore(BENCHMARK), "v": 3.0}, tmp_path)
    for key in (*KEYS, "g"):
        assert found.given[key] == pytest.approx(BENCHMARK[key], rel=1e-13, abs=1e-15), key
    assert found.notes == ("from axes along the steering axis",)
    own = bs.stable_intervals(found)
    assert (own.V1[0], own.V2[0]) == pytest.approx((4.29238253634111, 6.02426201538837), rel=1e-12)


@settings(deadline=None, max_examples=30, derandomize=True)
@given(st.lists(st.floats(0.1, 1.0), min_size=len(KEYS), max_size=len(KEYS)), st.floats(-0.3, 1.0))
def test_any_machine(tmp_path_factory, numbers, lam):
    benchmark = dict(zip(KEYS, numbers, strict=True)) | {"lam": lam, "g": 9.81}
    benchmark["w"] += 2.0  # wheels of any sizes stand on the ground then
    benchmark |= {key: -benchmark[key] for key in ("zB", "zH")}
    benchmark |= {key: 0.09 * benchmark[key] for key in ("IBxz", "IHxz")}  # of rigid bodies
    found = load(benchmark_to_moore(benchmark), tmp_path_factory.getbasetemp())
    for key in KEYS:
        assert found.given[key] == pytest.approx(benchmark[key], rel=1e-11, abs=1e-13), key


def test_the_fork_about_the_steering_axis(tmp_path):
    """The published I_λλ of the front assembly, M_δδ without what the trail adds: 0.1 … from e33 and f33."""
    n = benchmark_to_moore(BENCHMARK)
    found = load(n, tmp_path)
    about = n["ie33"] + n["me"] * (n["d3"] + n["l3"]) ** 2 + n["if11"] + n["mf"] * n["d3"] ** 2
    b = found  # the paper's two parts, of which the front one turns about the axis through the trail's foot
    foot = b.c * (1 + b.sigma)
    u = (b.l2 - foot) * math.cos(b.lam) + b.h2 * math.sin(b.lam)
    own = (
        b.A2 * math.sin(b.lam) ** 2
        + b.B2 * math.cos(b.lam) ** 2
        - 2 * b.D2 * math.sin(b.lam) * math.cos(b.lam)
    )
    assert own + b.m2 * u * u == pytest.approx(about, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"d2": None}, "missing parameter: d2"),
        ({"ie331": 1.0}, "values.ie331: unknown parameter\ndid you mean"),
        ({"ie12": 0.1}, "values.ie12: 0.1 is not what the equations have\nallowed: 0, as of bodies"),
        ({"id33": 0.9}, "values.id33: 0.9 is not what the equations have\nallowed: id11 = 0.0603"),
        (
            {"d2": 0.0, "d1": 0.0, "d3": 0.0},
            "values.d2: with these d1, d2 and d3 wheels of 0.3 and 0.35 m cannot",
        ),
        ({"mc": -1.0}, "mB: -1 is not non-negative"),
        ({"mc": "much"}, "values.mc: 'much' is not a number"),
    ],
)
def test_mistakes(tmp_path, change, message):
    values = {k: v for k, v in (benchmark_to_moore(BENCHMARK) | change).items() if v is not None}
    with pytest.raises(InputError, match=message):
        load(values, tmp_path)


def test_uncertainties_are_told(tmp_path):
    values = benchmark_to_moore(BENCHMARK)
    found = load(values | {"d1": f"{values['d1']} +/- 0.001"}, tmp_path)
    assert found.notes[-1] == "not carried to other axes, left out: the uncertainties of d1"
    flat = "\n".join(f"{key} = {value}" for key, value in values.items())
    (tmp_path / "flat.txt").write_text(flat, "utf-8")
    assert bs.Bicycle.load(str(tmp_path / "flat.txt")).given == pytest.approx(load(values, tmp_path).given)
