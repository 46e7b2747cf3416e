"""The bounds of stable speeds, against 80-digit values beside degenerate designs, and by properties."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from bikestab.bicycle import Bicycle
from bikestab.machines import Machines
from bikestab.model import characteristic_table, exact_table
from bikestab.spectrum import growth_rate_of
from bikestab.speeds import KINDS, REASONS, intervals_of
from tests.references import verify_speeds
from tests.strategies import lams, paper_machines, sigmas

EPS = np.finfo(float).eps
CASES = json.loads((Path(__file__).parent / "references" / "hard_speeds.json").read_text("utf-8"))["cases"]
FIRST = Path(__file__).parent / "references" / "first_sigma.json"
DIGITS = mpf(10) ** -23  # of the values in the file, which have 24 or 25


def found_for(case):
    bicycle = Bicycle.from_mapping(case["parameters"])
    return intervals_of(exact_table(bicycle, case["lam"], case["sigma"]))


@pytest.mark.parametrize("number", range(len(CASES)))
def test_hard_cases(number):
    """Each structure right or said to be marginal; each end within its bound, and to 2 ε.

    κ = Σ |x ∂V/∂x| / V is never below one half, as V² is proportional to g: 2 ε is at most 4 ε κ.
    """
    case, found = CASES[number], found_for(CASES[number])
    kinds = [(KINDS[a], KINDS[b]) for a, b in zip(found.lower, found.upper, strict=True)][: int(found.number)]
    if kinds != [(x["lower"], x["upper"]) for x in case["intervals"]]:
        assert REASONS[found.marginal[0]]
        return
    for i, right in enumerate(case["intervals"]):
        for name in ("V1", "V2"):
            V, error = float(getattr(found, name)[i]), float(getattr(found, f"{name}_error")[i])
            if right[name] in (None, "inf"):
                assert (V, error) == (np.inf, 0)
                continue
            exact = mpf(right[name])
            assert abs(mpf(V) - exact) <= error + DIGITS * exact
            assert abs(mpf(V) - exact) <= 2 * EPS * exact


def test_few_of_them_are_marginal():
    """Of 165, many within 1e-16 of a change of structure; each says why."""
    marginal = [found_for(case).marginal[0] for case in CASES]
    assert np.count_nonzero(marginal) <= 1


def test_bounds_are_no_larger_than_needed():
    """The rest beyond double precision is known, so that the bound is the error, but for 1e-3 of it."""
    ratios = []
    for case in CASES:
        found = found_for(case)
        for i, right in enumerate(case["intervals"][: int(found.number)]):
            if right["lower"] == "weave" and KINDS[found.lower[i]] == "weave":
                error = abs(mpf(float(found.V1[i])) - mpf(right["V1"]))
                ratios.append(float(found.V1_error[i] / error) if error else 1.0)
    assert np.median(ratios) < 1.001
    assert len(ratios) > 80


@pytest.mark.parametrize("shape", [(12,), (3, 4), (2, 3, 2), (1, 12)])
@settings(deadline=None, max_examples=8, derandomize=True)
@given(
    machine=paper_machines(),
    lam=st.lists(lams, min_size=12, max_size=12),
    sigma=st.lists(sigmas, min_size=12, max_size=12),
    delta=st.lists(st.just(0.0) | st.floats(1e-12, 1e3), min_size=12, max_size=12),
)
def test_the_same_design_gives_the_same_bits(shape, machine, lam, sigma, delta):
    """Alone, among others with and without damping, and in arrays of any shape."""
    tables = [
        exact_table(Bicycle.from_mapping({**machine, "delta": d}), a, b)
        for a, b, d in zip(lam, sigma, delta, strict=True)
    ]
    whole = type(tables[0])(
        *(np.stack(each, axis=-1).reshape(5, 4, *shape) for each in zip(*tables, strict=True))
    )
    together = intervals_of(whole)
    for cell, table in enumerate(tables):
        alone, place = intervals_of(table), np.unravel_index(cell, shape)
        number = int(alone.number)
        assert together.number[place] == number
        for many, one in zip(together, alone, strict=True):
            assert many[place][:number].tobytes() == one[:number].tobytes()
        assert together.marginal[place][0] == alone.marginal[0]


@settings(deadline=None, max_examples=20, derandomize=True)
@given(
    machine=paper_machines(),
    lam=st.lists(lams, min_size=5, max_size=5),
    sigma=st.lists(sigmas, min_size=3, max_size=3),
)
def test_a_table_has_the_same_bits_in_any_company(machine, lam, sigma):
    bicycle = Bicycle.from_mapping(machine)
    whole = exact_table(bicycle, np.array(lam)[:, np.newaxis], np.array(sigma))
    for i, k in np.ndindex(5, 3):
        for many, one in zip(whole, exact_table(bicycle, lam[i], sigma[k]), strict=True):
            assert many[:, :, i, k].tobytes() == one.tobytes()


@pytest.mark.parametrize(
    "table_of", [lambda *given: exact_table(*given), lambda *given: (characteristic_table(*given),)]
)
@pytest.mark.parametrize("preset", ["meijaard2007", "dikarev1981"])
def test_a_machine_of_a_sweep_has_the_bits_of_itself(preset, table_of):
    """Many machines at once, of either notation, in parts too, and each of them alone."""
    bicycle, number = Bicycle.preset(preset), 23
    rng = np.random.default_rng(3)
    names = rng.permutation([name for name in bicycle.given if name not in ("lam", "sigma", "delta")])[:6]
    names = [name for name in names if bicycle.given[name]]
    samples = {name: bicycle.given[name] * rng.uniform(0.95, 1.05, number) for name in names}
    samples["delta"] = rng.uniform(0, 2, number)
    machines = Machines.drawn(bicycle, samples)
    together = table_of(machines, 0.3, np.array([0.05, 0.08]))
    some = table_of(machines.part(slice(5, 9)), 0.3, np.array([0.05, 0.08]))
    for i in range(number):
        alone = table_of(bicycle.replaced({name: float(x[i]) for name, x in samples.items()}), 0.3, 0.08)
        for many, few, one in zip(together, some, alone, strict=True):
            assert many[:, :, i, 1].tobytes() == one.tobytes()
            if 5 <= i < 9:
                assert few[:, :, i - 5, 1].tobytes() == one.tobytes()


@pytest.mark.parametrize("delta", [1e-12, 1e-9, 1e-6])
def test_little_damping_goes_over_into_none(delta):
    """On the paper's box: as many intervals, and their ends within what so little damping moves them."""
    bicycle = Bicycle.preset("dikarev1981")
    lam, sigma = np.linspace(0.01, 0.3, 12)[:, np.newaxis], np.linspace(0.01, 0.15, 11)
    none = intervals_of(exact_table(bicycle, lam, sigma))
    little = intervals_of(exact_table(bicycle.with_delta(delta), lam, sigma))
    assert np.array_equal(none.number, little.number)
    assert np.array_equal(none.upper, little.upper)
    np.testing.assert_allclose(little.V1, none.V1, rtol=1e4 * delta, atol=1e-13)


def test_the_marginal_is_told_with_its_reason():
    """hurwitz3/V² = (V² − 1)²: whether there are two weave speeds or none no rounding error may decide."""
    table = np.zeros((5, 4))
    for (k, j), value in {
        (4, 0): 1,
        (3, 1): 1,
        (2, 2): 2,
        (2, 0): 1,
        (1, 3): 1,
        (0, 2): 3,
        (0, 0): -1,
    }.items():
        table[k, j] = value
    found = intervals_of(table)
    assert REASONS[found.marginal[0]] == "how many weave speeds there are is within rounding"
    with mp.workdps(30):
        assert abs(mpf(float(found.V1[0])) - 1 / mp.sqrt(3)) <= found.V1_error[0]


# next to a trail at which a weave speed leaves to rest or infinity; truth from verify_speeds, in 400 bits
UNDECIDED = [
    ("dikarev1981", {
        "c": 1.2811714089672557, "g": 9.81, "m1": 100.74925625856383, "m2": 1.2548133533445975,
        "l1": 0.7780460278055086, "h1": 0.7976850277945502, "l2": 1.1929650849595033,
        "h2": 0.6823841937162396, "A1": 6.489829370114563, "B1": 2.6638918832843164,
        "D1": 0.7163935550572883, "C1": 0.9217531511010721, "R1": 0.19441819923750522,
        "A2": 0.013959968244554912, "B2": 0.1536134656705493, "D2": 0.03902078921225231,
        "C2": 0.00668743037032771, "R2": 0.1691818813583107, "delta": 9.79249535847081e-10,
    }, -0.23486334624117444, 0.0034489643377604478, 0, None),
    ("dikarev1981", {
        "c": 1.5940371705825487, "g": 9.81, "m1": 224.2218305321198, "m2": 24.013143855301585,
        "l1": 0.7201967474567785, "h1": 0.7901496047717791, "l2": 1.2449915690424065,
        "h2": 0.9969660597119279, "A1": 3.767252933421783, "B1": 50.29894838449083,
        "D1": -8.024963666791967, "C1": 3.934500174808056, "R1": 0.300941310440645,
        "A2": 0.1970098657318493, "B2": 0.7964040471376304, "D2": 0.03778548721987952,
        "C2": 0.2074142699899348, "R2": 0.17767290158667093, "delta": 1.899742550805159e-08,
    }, 0.4669606961284858, 0.03984343284881196, 1, 11.833837977680504),
]  # fmt: skip


@pytest.mark.parametrize("case", UNDECIDED, ids=["at infinity", "at rest"])
def test_what_is_undecided_at_one_end_is_right_at_the_other(case):
    """Signs before and behind the zeros fit together, also where they are as rounding has them."""
    name, values, lam, sigma, number, V1 = case
    bicycle = Bicycle.preset(name).replaced(values)
    found = intervals_of(exact_table(bicycle, lam, sigma))
    assert REASONS[found.marginal[0]]
    assert found.number == number
    if number:
        assert (KINDS[found.lower[0]], KINDS[found.upper[0]]) == ("weave", "unbounded")
        assert abs(found.V1[0] - V1) <= 2 * EPS * V1


def test_signs_tell_what_slopes_do_not():
    """A weave speed of 7e-12 m/s appears within 1e-14: that it is one is certain, whatever its place is."""
    found = intervals_of(
        exact_table(Bicycle.preset("dikarev1981").with_delta(1e-9), 0.1, 0.10422909769221915)
    )
    assert found.number == found.marginal[0] == 0


def test_what_is_undecided_at_rest_with_feedback_in_proportion_to_speed():
    """Where hurwitz3 is zero at rest, its sign above rest and its zeros there fit together."""
    bicycle = Bicycle.preset("dikarev1981").replaced({"k_phi_V": -13.9, "delta": 10.0})
    lam, sigma = -0.09470734735335543, 0.20714816996977914 + np.linspace(-3e-12, 3e-12, 401)
    table = exact_table(bicycle, lam, sigma)
    for V in (0.1, 1.0, 3.0, 10.0, 100.0):
        assert growth_rate_of(table.value, V).min() > 0.1
    found = intervals_of(table)
    assert not found.number.any()
    assert 0 < np.count_nonzero(found.marginal) < 401


def test_a_sample_of_random_machines_in_400_bits():
    """Half of them beside a change of structure; docs/trust.md has the counts of a run of many more."""
    counts, ratios = verify_speeds.run(120, seed=5)
    assert counts["machines"] >= 120
    assert counts["beside a change"] > 30
    assert counts["WRONG STRUCTURE"] == counts["OUTSIDE"] == counts["BEYOND 4 ε κ"] == 0
    assert np.median(ratios) < 1.01


@pytest.mark.parametrize("delta", [0.0, 2e-11, 1e-12, 1e-10, 1e-6])
def test_the_first_trail_with_a_stable_speed(delta):
    """Right values by bisection in 70 digits; so little damping moves the trail by less than 1e-5."""
    (case,) = [x for x in json.loads(FIRST.read_text("utf-8"))["cases"] if "parameters" in x]
    bicycle = Bicycle.from_mapping({**case["parameters"], "delta": delta})
    below, above = (1 - 1e-5) * case["sigma_min"], (1 + 1e-5) * case["sigma_min"]
    found = intervals_of(exact_table(bicycle, case["lam"], np.array([0, 0.5 * below, below, above])))
    assert found.number.tolist() == [0, 0, 0, 1]
    assert not found.marginal.any()


def test_what_is_zero_in_a_whole_range_comes_to_an_end():
    """Point masses on an inertia matrix that is singular to 1e-16: hurwitz3 is rounding at all speeds."""
    p = {
        "c": 1.3856791557636723,
        "m1": 121.60195427244645,
        "l1": 0.7720000136408729,
        "h1": 1.3796534114675736,
    }
    p |= {"m2": 28.768936823835837, "l2": 1.2682592952685363, "h2": 0.9918933441261892, "delta": 1.5e-12}
    p |= {
        "C1": 7.210267969451847,
        "R1": 0.4622981149189026,
        "C2": 0.26340523481600886,
        "R2": 0.1928667866729702,
    }
    bicycle = Bicycle.from_mapping(p | {x + i: 0.0 for x in "AB" for i in "12"})
    found = intervals_of(exact_table(bicycle, 0.6835654138471613, 1.026927927631216))
    assert REASONS[found.marginal[0]]
