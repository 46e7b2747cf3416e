"""Random numbers that depend on nothing but seed, name and number; many machines at once."""

import re
from statistics import NormalDist

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.errors import InputError
from bikestab.gains import GAINS
from bikestab.machines import Machines, standard_normal, uniforms
from tests.strategies import machines

STORED = [0.6953051066799408, 0.9202015870424572, 0.42071454588531376]


def test_the_first_numbers_of_a_stream_are_the_same_however_many_are_drawn():
    many = uniforms(1, "m1", 10_000)
    for number in (2, 3, 5, 1000):
        np.testing.assert_array_equal(uniforms(1, "m1", number), many[:number])


def test_streams_differ_by_seed_and_by_name():
    streams = [uniforms(seed, name, 10_000) for seed, name in ((1, "m1"), (2, "m1"), (1, "m2"), (11, "1"))]
    correlation = np.corrcoef(streams)[np.triu_indices(4, 1)]
    assert np.abs(correlation).max() < 5 / np.sqrt(10_000)


def test_the_numbers_stay_those_of_the_first_release():
    """Philox and SHA-256 are the same on every machine; stored scans rely on that."""
    np.testing.assert_array_equal(uniforms(1, "m1", 3), STORED)


def test_uniform_numbers_are_evenly_spread_and_never_at_an_end():
    values = uniforms(5, "m1", 100_000)
    assert values.min() > 0
    assert values.max() < 1
    counts, _ = np.histogram(values, bins=50, range=(0, 1))
    chi_squared = np.sum((counts - 2000) ** 2 / 2000)
    assert chi_squared < 49 + 5 * np.sqrt(2 * 49)


def test_standard_normal_is_the_inverse_distribution():
    p = np.array([2.0**-53, 0.025, 0.5, 0.8413447460685429, 1 - 2.0**-53])
    np.testing.assert_array_equal(standard_normal(p), [NormalDist().inv_cdf(x) for x in p])
    assert standard_normal(p)[3] == pytest.approx(1, abs=1e-12)


@settings(deadline=None, max_examples=200, derandomize=True)
@given(machine=machines, data=st.data())
def test_many_machines_have_the_limits_of_one(machine, data):
    """Replace some parameters by values that may be impossible, and ask both."""
    bicycle = Bicycle.from_mapping(machine)
    known = sorted({*bicycle.given, *GAINS})
    names = data.draw(st.lists(st.sampled_from(known), min_size=1, max_size=3, unique=True))
    names = [name for name in names if name != "lam"] or ["delta"]
    values = {
        name: data.draw(st.sampled_from([-1e10, -1.0, 0.0, 1e-60, 1e-3, 0.5, 2.0, 1e9, 1e10]), label=name)
        for name in names
    }
    samples = {name: np.array([bicycle.given.get(name, 0.0), value]) for name, value in values.items()}
    try:
        one = bicycle.replaced(values)
    except InputError as error:
        why = re.escape(error.problem)
        with pytest.raises(InputError, match=f"1 of 2 samples is no machine; the first has .*: {why}"):
            Machines.drawn(bicycle, samples)
        return
    drawn = Machines.drawn(bicycle, samples)
    for name, value in one.numbers().items():
        if name in GAINS:
            np.testing.assert_array_equal(drawn.gains[name][:, 0], samples[name])
        elif name not in ("lam", "sigma"):
            column = np.broadcast_to(getattr(drawn, name), drawn.shape)[:, 0]
            assert column == pytest.approx([getattr(bicycle, name), value], rel=1e-14, abs=1e-14)


def test_both_radii_at_once():
    drawn = Machines.drawn(Bicycle.preset("dikarev1981"), {"R": np.array([0.3, 0.4])})
    np.testing.assert_array_equal(drawn.R1, [[0.3], [0.4]])
    np.testing.assert_array_equal(drawn.R2, drawn.R1)
    with pytest.raises(InputError, match=r"the first has R = -0.1: -0.1 is not non-negative") as caught:
        Machines.drawn(Bicycle.preset("dikarev1981"), {"R": np.array([0.3, -0.1])})
    assert caught.value.key == ("R",)


def test_a_part_of_the_machines():
    drawn = Machines.drawn(Bicycle.preset("dikarev1981"), {"m1": np.arange(1.0, 8.0)})
    part = drawn.part(slice(2, 5))
    assert (part.number, part.shape, part.m2) == (3, (3, 1), drawn.m2)
    np.testing.assert_array_equal(part.m1[:, 0], [3, 4, 5])
    assert drawn.part(slice(5, 100)).number == 2
