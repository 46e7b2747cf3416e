"""Sweeps and ensembles in a config: the machines that follow, and one message for each mistake."""

import math

import jsonschema
import numpy as np
import pytest
from ruamel.yaml import YAML

from bikestab.bicycle import Bicycle
from bikestab.config.file import config_schema
from tests.configs import GOOD, IN_PLACE, load, message

MEIJAARD = GOOD.replace("dikarev1981", "meijaard2007")
plain_yaml = YAML(typ="safe", pure=True)


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def fits_the_schema(text):
    return jsonschema.Draft202012Validator(config_schema()).is_valid(plain_yaml.load(text))


# --- sweeps


def test_the_members_of_a_sweep_with_the_last_axis_fastest():
    config = load(GOOD + "sweep: {delta: [0, 1, 5], m1: {start: 60, stop: 120, num: 3}}\n")
    expected = [{"delta": d, "m1": m} for d in (0, 1, 5) for m in (60, 90, 120)]
    assert [member.values for member in config.members] == expected
    printed = Bicycle.preset("dikarev1981").numbers()
    for values, bicycle in config.members:
        assert bicycle.numbers() == {**printed, **values}
        assert bicycle.name == "dikarev1981"


def test_no_sweep_is_one_member():
    config = load(GOOD + "delta: 2\n")
    assert config.members == [({}, config.machine)]
    assert (config.axes, config.ensemble) == ([], None)


def test_the_other_members_keep_the_damping_of_the_config():
    assert [m.bicycle.delta for m in load(GOOD + "delta: 2\nsweep: {m1: [60, 70]}\n").members] == [2, 2]


def test_axes_with_unit_and_meaning():
    axes = load(MEIJAARD + "sweep: {IByy: [11], delta: {start: 0, stop: 2, num: 5}}\n").axes
    assert [(a.name, a.unit, a.meaning) for a in axes] == [
        ("IByy", "kg m²", "body inertia, pitch; not in the equations"),
        ("delta", "kg m²/s", "viscous damping of the steering"),
    ]
    np.testing.assert_array_equal(axes[0].values, [11])
    np.testing.assert_array_equal(axes[1].values, [0, 0.5, 1, 1.5, 2])


def test_a_sweep_in_the_notation_of_meijaard_moves_what_depends_on_it():
    config = load(MEIJAARD + "delta: 0.5\nsweep: {mB: [70, 85]}\n")
    light, same = (member.bicycle for member in config.members)
    assert same == config.machine == Bicycle.preset("meijaard2007").with_delta(0.5)
    assert light.m1 == 70 + 2
    assert light.h1 == pytest.approx((2 * 0.3 + 70 * 0.9) / 72, rel=1e-15)
    assert light.A1 != same.A1


def test_c_is_the_wheelbase_in_the_papers_notation_only():
    assert [m.bicycle.c for m in load(GOOD + "sweep: {c: [1, 1.1]}\n").members] == [1, 1.1]
    assert message(MEIJAARD + "sweep: {c: [0.1]}\n") == (
        "scan.yaml, line 6: sweep.c: the grid has the trail\ngive its values in grid.sigma"
    )


def test_both_radii_at_once():
    for values, bicycle in load(GOOD + "sweep: {R: [0.3, 0.4]}\n").members:
        assert (values["R"], values["R"]) == (bicycle.R1, bicycle.R2)


def test_a_swept_parameter_of_a_bicycle_in_place():
    (member,) = load(IN_PLACE + "sweep:\n  m1:\n    values: [70]\n").members
    assert member.bicycle == load(IN_PLACE, "bicycle.m1=70").machine


@pytest.mark.parametrize(
    ("given", "values"),
    [("[0, 1]", [0, 1]), ("{values: [3]}", [3]), ("{start: 0, stop: 3, num: 4}", [0, 1, 2, 3])],
)
def test_a_sweep_from_the_command_line(given, values):
    assert [m.values["delta"] for m in load(GOOD, f"sweep.delta={given}").members] == values


# --- ensembles


def test_an_ensemble():
    config = load(GOOD + "ensemble: {m1: {normal: [80, 8]}, l1: {uniform: [0.35, 0.45]}, samples: 50}\n")
    ensemble = config.ensemble
    assert (ensemble.samples, ensemble.seed) == (50, 0)
    assert ensemble.quantiles == [0.05, 0.25, 0.5, 0.75, 0.95]
    assert list(ensemble.parameters) == ["m1", "l1"]
    machines = ensemble.machines(config.machine)
    np.testing.assert_array_equal(machines.m1[:, 0], ensemble.drawn["m1"])
    assert machines.h1 == 0.9


def test_an_ensemble_is_alike_around_every_member():
    text = "ensemble: {m1: {normal: [80, 8]}, samples: 50, seed: 3}\n"
    config = load(GOOD + text + "sweep: {m2: [2, 3]}\n")
    machines = [config.ensemble.machines(member.bicycle) for member in config.members]
    assert [m.m2 for m in machines] == [2, 3]
    np.testing.assert_array_equal(machines[0].m1, machines[1].m1)
    np.testing.assert_array_equal(machines[0].m1, load(GOOD + text).ensemble.machines(config.machine).m1)


def test_distributions():
    """Mean and spread of 100 000 samples, within five standard errors."""
    text = GOOD + "ensemble: {m1: {normal: [80, 8]}, l1: {uniform: [0.35, 0.45]}, samples: 100000}\n"
    drawn = load(text).ensemble.drawn
    n = 100_000
    assert drawn["m1"].mean() == pytest.approx(80, abs=5 * 8 / math.sqrt(n))
    assert drawn["m1"].std() == pytest.approx(8, abs=5 * 8 / math.sqrt(2 * n))
    assert np.mean(drawn["m1"] > 80 + 1.959964 * 8) == pytest.approx(0.025, abs=5 * math.sqrt(0.025 / n))
    assert drawn["l1"].min() >= 0.35
    assert drawn["l1"].max() <= 0.45
    assert drawn["l1"].mean() == pytest.approx(0.4, abs=5 * 0.1 / math.sqrt(12 * n))
    assert drawn["l1"].std() == pytest.approx(0.1 / math.sqrt(12), rel=0.01)


def test_an_ensemble_from_the_command_line():
    ensemble = load(GOOD, "ensemble.m1.normal=[80, 8]", "ensemble.samples=10").ensemble
    assert ensemble.parameters["m1"].normal == (80, 8)


# --- mistakes

NORMAL = "m1: {normal: [80, 8]}, samples: 100"


@pytest.mark.parametrize(
    ("line", "problem", "hint"),
    [
        # axes of a sweep
        ("sweep: 3", "sweep: 3 is not keys with values", "parameters of the bicycle"),
        ("sweep: {m1: 3}", "sweep.m1: 3 is not a list", "a list of values, or {start: ..., stop: ..., num:"),
        ("sweep: {m1: []}", "sweep.m1: [] is not", "at least 1"),
        ("sweep: {m1: {values: []}}", "sweep.m1.values: [] is not", "at least 1"),
        ("sweep: {m1: {values: 3}}", "sweep.m1.values: 3 is not a list", "allowed: a list"),
        ("sweep: {m1: [70, 60]}", "sweep.m1: 60.0 does not come after 70.0", "values that increase"),
        ("sweep: {m1: {values: [7, 7]}}", "sweep.m1: 7.0 does not come after 7.0", "values that increase"),
        ("sweep: {m1: [60, heavy]}", "sweep.m1[1]: 'heavy' is not a number", "a number"),
        ("sweep: {m1: {stat: 3, stop: 4, num: 2}}", "sweep.m1.stat: unknown key", "did you mean 'start'?"),
        ("sweep: {m1: {start: 60, stop: 70}}", "sweep.m1.num: missing", "start, stop, num"),
        ("sweep: {m1: {start: 60, stop: 70, num: 1}}", "sweep.m1.num: 1 is not", "at least 2"),
        ("sweep: {m1: {start: 60, stop: 60, num: 2}}", "sweep.m1: stop = 60.0 is not above", "start < stop"),
        ("sweep: {m1: {values: [1], num: 3}}", "sweep.m1.num: unknown key", "known: values"),
        ("sweep: {m1: {start: 1, stop: 2, num: 10001}}", "sweep: 10001 machines are too many", "10000"),
        ("sweep: {m1: {start: 1, stop: 2, num: 200}, m2: {start: 1, stop: 2, num: 1000000000}}",
         "sweep: 200 × 1000000000 machines are too many", "allowed: up to 10000"),
        # names
        ("sweep: {lam: [0.1]}", "sweep.lam: the grid has the tilt", "grid.lam"),
        ("sweep: {sigma: [0.1]}", "sweep.sigma: the grid has the trail", "grid.sigma"),
        ("sweep: {trail: [0.1]}", "sweep.trail: the grid has the trail", "grid.sigma"),
        ("sweep: {dleta: [0.1]}", "sweep.dleta: unknown parameter", "did you mean 'delta'?"),
        ("sweep: {mB: [70]}", "sweep.mB: unknown parameter (a key of the other notation)", "known: c, m1,"),
        ("sweep: {R: [0.3], R2: [0.3]}", "sweep.R2: sweep.R varies it already", "once"),
        ("sweep: {m1: [70]}\nensemble: {" + NORMAL + "}", "ensemble.m1: sweep.m1 varies it already", "once"),
        ("delta: 0\nsweep: {delta: [0, 1]}", "sweep.delta: delta is given for the whole config", "one of"),
        ("delta: 0\nensemble: {delta: {uniform: [0, 1]}, samples: 9}", "ensemble.delta: delta is given", ""),
        # values that no machine has
        ("sweep: {m1: [-3, 60]}", "sweep.m1: -3 is not positive (mass of the rear part", "m1 > 0"),
        ("sweep: {R: [0, 0.3]}", "sweep.R: R1 = 0 (a skate) cannot spin, but C1 = 0.5", "R1 > 0"),
        ("sweep: {D1: [0, 9]}", "sweep.D1: |9| is more than √(A1 B1) = 4.702", "|D1| <="),
        ("sweep: {m1: [1.e10]}", "sweep.m1: 1e+10 is out of range", "up to 1e+09"),
        # keys of an ensemble
        ("ensemble: 3", "ensemble: 3 is not keys with values", "samples, seed, quantiles"),
        ("ensemble: {samples: 9}", "ensemble: no parameter is drawn", "m1: {normal: [80, 8]}"),
        ("ensemble: {m1: {normal: [80, 8]}}", "ensemble.samples: missing", "needed here"),
        ("ensemble: {m1: {normal: [80, 8]}, sample: 9}", "ensemble.sample: unknown key", "'samples'?"),
        ("ensemble: {m1: {normal: [80, 8]}, samples: 1}", "ensemble.samples: 1 is not", "at least 2"),
        ("ensemble: {m1: {normal: [80, 8]}, samples: 1000001}", "ensemble.samples: 1000001 is not",
         "at most 1000000"),
        ("ensemble: {m1: {normal: [80, 8]}, samples: 9.5}", "ensemble.samples: 9.5 is not a whole", ""),
        ("ensemble: {" + NORMAL + ", seed: -1}", "ensemble.seed: -1 is not at least 0", "at least 0"),
        ("ensemble: {" + NORMAL + ", quantiles: []}", "ensemble.quantiles: [] is not", "at least 1"),
        ("ensemble: {" + NORMAL + ", quantiles: [0.5, 1]}", "ensemble.quantiles[1]: 1 is no share", "and 1"),
        ("ensemble: {" + NORMAL + ", quantiles: [0.5, 0.2]}", "ensemble.quantiles: 0.2 does not come after",
         "values that increase"),
        ("ensemble: {lam: {uniform: [0, 3]}, samples: 9}", "ensemble.lam: some samples have a", "narrower"),
        ("ensemble: {m11: {uniform: [0, 1]}, samples: 9}", "ensemble.m11: unknown parameter", "'m1'?"),
        ("sweep: {m1: {start: 1, stop: 2, num: 1000}}\nensemble: {m2: {uniform: [1, 2]}, samples: 100001}",
         "ensemble.samples: 100001 samples of each of 1000 machines are too many", "up to 100000 with"),
        # distributions
        ("ensemble: {m1: 80, samples: 9}", "ensemble.m1: 80 is not keys with values", "normal, uniform"),
        ("ensemble: {m1: {}, samples: 9}", "ensemble.m1: a parameter has one distribution", "{uniform: [low"),
        ("ensemble: {m1: {normal: [80, 8], uniform: [70, 90]}, samples: 9}", "ensemble.m1: a parameter", ""),
        ("ensemble: {m1: {normall: [80, 8]}, samples: 9}", "ensemble.m1.normall: unknown key", "'normal'?"),
        ("ensemble: {m1: {normal: 80}, samples: 9}", "ensemble.m1.normal: 80 is no pair", "[mean, standard"),
        ("ensemble: {m1: {uniform: [80]}, samples: 9}", "ensemble.m1.uniform: [80] is no pair", "[low,"),
        ("ensemble: {m1: {normal: [80, wide]}, samples: 9}", "ensemble.m1.normal[1]: 'wide' is not a", ""),
        ("ensemble: {m1: {normal: [80, 0]}, samples: 9}", "ensemble.m1: the standard deviation 0", "0"),
        ("ensemble: {m1: {uniform: [8, 8]}, samples: 9}", "ensemble.m1: high = 8 is not above low = 8", "<"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_with_its_place(line, problem, hint):
    first, *rest = message(GOOD + line + "\n").splitlines()
    assert first.startswith(f"scan.yaml, line {6 + line.count(chr(10))}: {problem}")
    assert len(rest) <= 1
    assert hint in "".join(rest)


@pytest.mark.parametrize(
    ("override", "expected"),
    [
        ("sweep.dleta=[0, 1]", "sweep.dleta: unknown parameter\ndid you mean 'delta'?"),
        (
            "sweep.m1=[-1, 1]",
            "sweep.m1: -1 is not positive (mass of the rear part with rider [kg])\nallowed: m1",
        ),
        ("sweep.lam=[0]", "sweep.lam: the grid has the tilt\n"),
    ],
)
def test_a_bad_override_is_quoted(override, expected):
    assert message(GOOD, override).startswith(f"--set {override}: {expected}")


def test_a_parameter_that_makes_another_impossible():
    assert message(MEIJAARD + "sweep: {IBxx: [0.25, 9]}\n") == (
        "scan.yaml, line 6: sweep.IBxx: 0.25 does not go with IBxz: "
        "|2.4| is more than √(IBxx IBzz) = 0.83666\nallowed: |IBxz| <= 0.83666 kg m²"
    )
    assert message(MEIJAARD + "ensemble: {IBxx: {uniform: [0.1, 0.2]}, samples: 7}\n").startswith(
        "scan.yaml, line 6: ensemble.IBxx: 7 of 7 samples are no machines; the first has IBxx = 0.1"
    )


def test_samples_that_no_machine_has_are_counted():
    text = GOOD + "ensemble: {m1: {normal: [80, 40]}, samples: 1000}\n"
    masses = load(text.replace("40]", "8]")).ensemble.drawn["m1"]
    impossible = 80 + 5 * (masses - 80) <= 0
    assert 5 < impossible.sum() < 60  # the tail below two standard deviations has 2.3 %
    first = 80 + 5 * (masses[impossible][0] - 80)
    assert message(text) == (
        f"scan.yaml, line 6: ensemble.m1: {impossible.sum()} of 1000 samples are no machines; "
        f"the first has m1 = {first:.6g}: {first:.6g} is not positive "
        "(mass of the rear part with rider [kg])\n"
        "allowed: m1 > 0; take a narrower distribution, or uniform: [low, high]"
    )
    assert message(text + "sweep: {m2: [2, 3]}\n").startswith(
        f"scan.yaml, line 6: ensemble.m1: at m2 = 2, {impossible.sum()} of 1000 samples are no machines; "
    )


def test_samples_and_axes_whose_products_would_underflow():
    assert message(GOOD + "ensemble: {delta: {lognormal: [1.0e-49, 3]}, samples: 20}\n") == (
        "scan.yaml, line 6: ensemble.delta: 7 of 20 samples are no machines; the first has "
        "delta = 1.79892e-52: 1.79892e-52 is out of range\n"
        "allowed: 0, or from 1e-50 on; take a narrower distribution, or uniform: [low, high]"
    )
    grid = (
        "grid: {x: {name: delta, values: [0, 1.0e-60, 1]}, y: {name: sigma, start: 0.01, stop: 0.1, num: 3}"
    )
    text = f"bicycle: meijaard2007\n{grid}, V: {{start: 0, stop: 10, num: 5}}}}\noutput: o\n"
    assert message(text) == (
        "scan.yaml, line 2: grid.x: at delta = 1e-60, sigma = 0.01: 1e-60 is out of range\n"
        "allowed: 0, or from 1e-50 on"
    )


# --- the schema


@pytest.mark.parametrize(
    "line",
    [
        "sweep: {delta: [0], m1: {start: 60, stop: 120, num: 7}, c: {values: [1]}}",
        "ensemble: {m1: {normal: [80, 8]}, l1: {uniform: [0.3, 0.4]}, samples: 9, seed: 3, quantiles: [0.5]}",
    ],
)
def test_what_loads_fits_the_schema(line):
    load(GOOD + line + "\n")
    assert fits_the_schema(GOOD + line + "\n")


@pytest.mark.parametrize(
    "line",
    [
        "sweep: [1]",
        "sweep: {m3: [1]}",
        "sweep: {lam: [1]}",
        "sweep: {m1: 1}",
        "sweep: {m1: []}",
        "sweep: {m1: {values: []}}",
        "sweep: {m1: {start: 1, stop: 2, num: 1}}",
        "sweep: {m1: {start: 1, stop: 2, nun: 3}}",
        "ensemble: {samples: 10}",
        "ensemble: {m1: {normal: [80, 8]}}",
        "ensemble: {m3: {normal: [80, 8]}, samples: 10}",
        "ensemble: {m1: {normal: [80]}, samples: 10}",
        "ensemble: {m1: {normal: [80, 8], uniform: [1, 2]}, samples: 10}",
        "ensemble: {m1: {}, samples: 10}",
        "ensemble: {m1: {normal: [80, 8]}, samples: 1}",
        "ensemble: {m1: {normal: [80, 8]}, samples: 10, seed: -1}",
        "ensemble: {m1: {normal: [80, 8]}, samples: 10, quantiles: [1]}",
    ],
)
def test_what_the_schema_refuses_does_not_load(line):
    assert not fits_the_schema(GOOD + line + "\n")
    message(GOOD + line + "\n")


WITH_UNITS = """\
bicycle: meijaard2007
delta: 1 N m s
grid: {lam: {values: [0, 18deg]}, sigma: {values: [0, 0.1]}, V: {start: 0, stop: 20mph, num: 2}}
sweep: {mB: {start: 60000 g, stop: 100kg, num: 3}, zB: [-90cm, -0.8]}
ensemble: {IFyy: {normal: [2.8e5 kg mm², 0.01]}, samples: 2}
"""


def test_numbers_of_a_variation_may_have_units():
    config = load(WITH_UNITS)
    assert config.sweep["mB"].points.tolist() == [60, 80, 100]
    assert config.sweep["zB"].points.tolist() == [-0.9, -0.8]
    assert config.notes == [
        "sweep.zB: -0.8 has no unit, so in a list it is in SI units",
        "ensemble.IFyy.normal: 0.01 has no unit, so in a list it is in SI units",
    ]
    assert config.ensemble.parameters["IFyy"].normal == (0.28, 0.01)
    jsonschema.validate(YAML(typ="safe").load(WITH_UNITS), config_schema())


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("100kg", "100m", "line 4: sweep.mB.stop: '100m' is not a number: it is a length, not a mass"),
        ("-90cm", "-90kg", "line 4: sweep.zB[0]: '-90kg' is not a number: it is a mass, not a length"),
        ("2.8e5 kg mm²", "3 m", "line 5: ensemble.IFyy.normal[0]: '3 m' is not a number: it is a length"),
        ("1 N m s", "1 kg", "line 2: delta: '1 kg' is not a number: it is a mass, not a damping"),
    ],
)
def test_wrong_units_are_told_with_their_place(old, new, told):
    assert message(WITH_UNITS.replace(old, new)).startswith(f"scan.yaml, {told}")
