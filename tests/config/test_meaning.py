"""Configs that mean the same have one identity, and one built in Python has a text that gives it again."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab import yamltext
from bikestab.bicycle import Bicycle
from bikestab.config.file import parse_config
from bikestab.config.scanconfig import ScanConfig
from bikestab.identity import digest
from bikestab.limits import LEAST
from tests.configs import GOOD, IN_PLACE, change, load
from tests.strategies import machines

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")


def again(config):
    """The config that its text gives."""
    return parse_config(yamltext.parse(config.text, "scan.yaml"))


# --- one meaning, many spellings

ENSEMBLE = "ensemble: {m1: {normal: [80, 8]}, m2: {uniform: [2, 3]}, samples: 10, seed: 1}\n"
SAME = {
    "comments": (GOOD, "# a remark\n" + GOOD.replace("\n", "  # and one here\n")),
    "layout": (GOOD, change("{start: 0, stop: 10, num: 6}", "\n    num: 6\n    start: 0.0\n    stop: 1e1")),
    "order": (GOOD, "\n".join([*GOOD.splitlines()[1:], GOOD.splitlines()[0]])),
    "what is not computed": (
        GOOD,
        GOOD + "title: a title\nslices: [{lam: 0.2}]\nexpect: [{stable: never}]\noutput: elsewhere\n",
    ),
    "defaults": (GOOD, GOOD + "model: refined\nfields: [stable, violated, growth_rate]\nsweep: {}\n"),
    "order of fields": (GOOD, GOOD + "fields: [growth_rate, stable, violated, stable]\n"),
    "own damping": (GOOD, GOOD + "delta: 0\n"),
    "degrees": (change("stop: 0.3", "stop: 18deg"), change("stop: 0.3", f"stop: {math.radians(18)!r}")),
    "speeds": (change("stop: 10", "stop: 36 km/h"), change("stop: 10", f"stop: {36 / 3.6!r}")),
    "values": (GOOD, change("{start: 0, stop: 10, num: 6}", "{values: [0, 2, 4, 6, 8, 10]}")),
    "minus zero": (GOOD, change("{start: 0, stop: 10", "{start: -0.0, stop: 10")),
    "in place": (GOOD, IN_PLACE),
    "its name": (IN_PLACE, IN_PLACE.replace("mine", "yours")),
    "two radii": (
        IN_PLACE,
        IN_PLACE.replace("R: 0.35", "R1: 0.35\n  R2: 0.35"),
    ),
    "a sweep's values": (
        GOOD + "sweep: {m1: [70, 80]}\n",
        GOOD + "sweep: {m1: {start: 70, stop: 80, num: 2}}\n",
    ),
    "an ensemble's order": (
        GOOD + ENSEMBLE,
        GOOD + "ensemble: {seed: 1, m2: {uniform: [2.0, 3]}, samples: 10, m1: {normal: [8e1, 8]}}\n",
    ),
    "an ensemble's bicycle": (GOOD + ENSEMBLE, IN_PLACE + ENSEMBLE),
}  # fmt: skip


@pytest.mark.parametrize(("one", "other"), SAME.values(), ids=SAME)
def test_what_means_the_same_has_one_identity(one, other):
    assert one != other
    assert load(one).sha256 == load(other).sha256


OTHER = {
    "a step": change("num: 6", "num: 7"),
    "a bit": change("stop: 10", f"stop: {math.nextafter(10, 11)!r}"),
    "the lowest bit of an angle": change("stop: 0.3", f"stop: {math.nextafter(0.3, 1)!r}"),
    "axes changed for each other": GOOD.replace("lam:", "x:")
    .replace("sigma:", "lam:")
    .replace("x:", "sigma:"),
    "fields": GOOD + "fields: [stable, violated]\n",
    "conditions": GOOD + "fields: [stable, violated, growth_rate, conditions]\n",
    "model": GOOD + "model: unrefined\n",
    "damping": GOOD + "delta: 1.0e-50\n",
    "bicycle": GOOD.replace("dikarev1981", "meijaard2007"),
    "a sweep of one": GOOD + "sweep: {m1: [80]}\n",
    "a sweep of another": GOOD + "sweep: {m2: [2.7]}\n",
    "order of a sweep": GOOD + "sweep: {m1: [80], m2: [2.7]}\n",
    "the other order": GOOD + "sweep: {m2: [2.7], m1: [80]}\n",
    "an ensemble": GOOD + ENSEMBLE,
    "its seed": GOOD + ENSEMBLE.replace("seed: 1", "seed: 2"),
    "its samples": GOOD + ENSEMBLE.replace("samples: 10", "samples: 11"),
    "its distribution": GOOD + ENSEMBLE.replace("uniform: [2, 3]", "normal: [3, 0.1]"),
    "its quantiles": GOOD + ENSEMBLE.replace("seed: 1", "seed: 1, quantiles: [0.5]"),
    "its width": GOOD + ENSEMBLE.replace("[80, 8]", "[80, 9]"),
}


def test_what_means_something_else_has_another_identity():
    identities = {name: load(text).sha256 for name, text in {"itself": GOOD, **OTHER}.items()}
    assert len(set(identities.values())) == len(identities)


@settings(deadline=None, max_examples=50, derandomize=True)
@given(
    start=st.floats(-0.5, 0.5), width=st.floats(1e-3, 0.5), num=st.integers(2, 40),
    order=st.permutations(["bicycle", "grid", "title", "fields"]), degrees=st.booleans(),
)  # fmt: skip
def test_spellings_of_random_grids(start, width, num, order, degrees):
    """Degrees or radians, a range or its values, keys in any order."""
    stop = start + width
    values = np.linspace(start, stop, num)
    ends = [f"{end!r}" for end in (start, stop)]
    if degrees:
        ends = [f"{math.degrees(end)!r}deg" for end in (start, stop)]
        values = np.linspace(*(math.radians(math.degrees(end)) for end in (start, stop)), num)

    def text(axis, order, fields):
        parts = {
            "bicycle": "bicycle: dikarev1981",
            "grid": f"grid: {{V: {{start: 0, stop: 5, num: 3}}, lam: {axis}, sigma: {{values: [0, 1]}}}}",
            "title": f"title: '{order}'".replace("['", "").replace("']", "").replace("', '", " "),
            "fields": f"fields: [{fields}]",
        }
        return parse_config(yamltext.parse("\n".join(parts[key] for key in order) + "\n", "scan.yaml"))

    one = text(f"{{start: {ends[0]}, stop: {ends[1]}, num: {num}}}", order, "stable, violated")
    other = text(f"{{values: {values.tolist()}}}", order[::-1], "violated, stable")
    assert one.sha256 == other.sha256
    longer = text(f"{{values: {[*values.tolist(), stop + 0.1]}}}", order, "violated, stable")
    assert one.sha256 != longer.sha256


def test_a_digest_depends_on_values_alone():
    assert digest({"a": np.array([0.0, 1.0]), "b": "x"}) == digest({"b": "x", "a": np.array([-0.0, 1.0])})
    assert digest({"a": np.array([[0.0, 1.0]])}) != digest({"a": np.array([[0.0], [1.0]])})
    assert digest({"a": np.array([1.0])}) != digest({"a": np.array([1.0 + 2**-52])})
    assert digest({"a": [np.array([1.0]), "x"]}) != digest({"a": ["x", np.array([1.0])]})


# --- built in Python

PLAIN = {
    "lam": {"start": 0, "stop": 0.3, "num": 4},
    "sigma": {"values": [0.1, 0.2]},
    "V": {"start": 0, "stop": 9, "num": 4},
}
FULL = {
    "title": "null: '1.5' # \"quoted\"",
    "model": "unrefined",
    "fields": ["conditions", "stable"],
    "sweep": {"g": [9.8, 9.81], "delta": {"start": 0, "stop": 1, "num": 2}},
    "slices": [{"lam": 0.2}, {"V": 5}],
    "expect": [{"V1": 3, "V2": "unbounded", "within": 0.5}, {"lam": 0.1, "sigma": 0.1, "stable": "never"}],
}  # fmt: skip


def same(one, other):
    """Whether two configs are the same in every value."""
    without = {"exclude": {"bicycle"}}
    return one.sha256 == other.sha256 and one.model_dump(**without) == other.model_dump(**without)


@pytest.mark.parametrize("more", [{}, FULL], ids=["least", "most"])
@pytest.mark.parametrize("bicycle", ["dikarev1981", "meijaard2007"])
def test_a_config_built_in_python_has_a_text(bicycle, more):
    config = ScanConfig(bicycle=Bicycle.preset(bicycle), grid=PLAIN, output="out", **more)
    assert same(again(config), config)
    assert (again(config).bicycle, again(config).warnings) == (config.bicycle, config.warnings)
    assert again(config).text == config.text


@settings(deadline=None, max_examples=60, derandomize=True)
@given(
    numbers=machines, title=st.text(st.characters(exclude_categories=["C"]), max_size=30),
    ends=st.tuples(*[st.tuples(st.floats(-1, 0), st.floats(1e-3, 1), st.integers(2, 9))] * 2),
    V=st.lists(st.just(0.0) | st.floats(LEAST, 1e6), min_size=2, max_size=6, unique=True),
    mass=st.tuples(st.floats(60, 70), st.floats(1e-9, 1e-3)), quantile=st.floats(1e-6, 0.999999),
)  # fmt: skip
def test_the_text_of_a_random_config_gives_it_again(numbers, title, ends, V, mass, quantile):
    bicycle = Bicycle.from_mapping({**numbers, "name": "any", "source": title})
    mean, deviation = mass
    lam, sigma = ({"start": low, "stop": low + width, "num": num} for low, width, num in ends)
    drawn = {"mB" if "w" in numbers else "m1": {"normal": [mean, deviation]}}
    config = ScanConfig(
        title=title, bicycle=bicycle, output="out/x",
        grid={"lam": lam, "sigma": sigma, "V": {"values": sorted(V)}},
        ensemble={**drawn, "samples": 3, "quantiles": [quantile]},
    )  # fmt: skip
    assert same(again(config), config)
    assert again(config).bicycle == bicycle
    assert again(config).bicycle.given == bicycle.given


def test_a_copy_with_other_values_is_another_config():
    """Neither the text nor the machines of the first stick to it."""
    config = load(GOOD)
    assert config.members[0].bicycle.delta == 0
    other = config.model_copy(update={"delta": 2.0})
    assert other.members[0].bicycle.delta == 2
    assert other.sha256 != config.sha256
    assert same(again(other), other)
    assert config.model_copy().text == config.text
