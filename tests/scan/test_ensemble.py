"""An ensemble's statistics against loops over single bicycles, and against exact shares."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.machines import uniforms
from bikestab.model import MODELS, characteristic_table
from bikestab.routh import conditions, stable
from bikestab.scan import ensemble
from bikestab.scan.ensemble import ensemble_statistics
from bikestab.speeds import Intervals, intervals_of
from tests.strategies import lams, machines, sigmas

QUANTILES = [0.05, 0.25, 0.5, 0.75, 0.95]
# Cells of dikarev1981 with no interval, a bounded one, one without upper limit, and several.
LAM = np.array([0.0, 0.02, 0.05, 0.08, 0.1, 0.2, 0.3, 0.2])
SIGMA = np.array([0.0, 0.15, 0.15, 0.15, 0.08, 0.08, 0.1, -0.05])
V = np.linspace(0, 15, 61)


def between(name, number, low, high, seed=1):
    return low + (high - low) * uniforms(seed, name, number)


def dikarev(number=40, seed=1):
    samples = {
        "m1": between("m1", number, 60, 100, seed),
        "h1": between("h1", number, 0.8, 1.0, seed),
        "A2": between("A2", number, 0.03, 0.3, seed),
        "C2": between("C2", number, 0.0, 0.5, seed),
        "delta": between("delta", number, 0, 1, seed),
    }
    return Bicycle.preset("dikarev1981"), samples


def one_by_one(bicycle, samples):
    return [bicycle.replaced({k: float(v[i]) for k, v in samples.items()}) for i in range(number_of(samples))]


def number_of(samples):
    return len(next(iter(samples.values())))


def inverted(values, q):
    """The smallest value that at least the share q of the values does not exceed."""
    ordered = sorted(values)
    return next(x for i, x in enumerate(ordered, 1) if i >= q * len(ordered)) if ordered else math.nan


def by_loops(bicycles, lam, sigma, V, model):
    """The same statistics, one machine, cell and speed after another."""
    shape = (len(lam), len(QUANTILES))
    out = {"probability": np.zeros((len(lam), len(V))), "V1": np.empty(shape), "V2": np.empty(shape)}
    out |= {"somewhere": np.zeros(len(lam)), "unbounded": np.zeros(len(lam))}
    for j in range(len(lam)):
        ends = []
        for bicycle in bicycles:
            table = characteristic_table(bicycle, lam[j], sigma[j], model=model)
            out["probability"][j] += stable(table[..., np.newaxis], V)
            found = intervals_of(table)
            pairs = list(zip(found.V1[: found.number], found.V2[: found.number], strict=True))
            out["somewhere"][j] += bool(pairs)
            out["unbounded"][j] += any(math.isinf(V2) for _, V2 in pairs)
            if pairs:
                ends.append(max(pairs, key=lambda pair: (pair[1] - pair[0], -pair[0])))
        for k, q in enumerate(QUANTILES):
            out["V1"][j, k] = inverted([V1 for V1, _ in ends], q)
            out["V2"][j, k] = inverted([V2 for _, V2 in ends], q)
    for name in ("probability", "somewhere", "unbounded"):
        out[name] /= len(bicycles)
    return out


def assert_equal_to_loops(found, expected):
    """Counts are equal. Speeds are those of one machine, whose squares Python rounds otherwise than numpy."""
    np.testing.assert_array_equal(found.probability, expected["probability"].astype(np.float32))
    np.testing.assert_array_equal(found.somewhere, expected["somewhere"])
    np.testing.assert_array_equal(found.unbounded, expected["unbounded"])
    np.testing.assert_allclose(found.V1, expected["V1"], rtol=1e-9)
    np.testing.assert_allclose(found.V2, expected["V2"], rtol=1e-9)


@pytest.mark.parametrize("model", MODELS)
def test_one_machine_after_another(model):
    bicycle, samples = dikarev()
    found = ensemble_statistics(Family(bicycle, model), samples, LAM, SIGMA, V, QUANTILES)
    expected = by_loops(one_by_one(bicycle, samples), LAM, SIGMA, V, model)
    assert_equal_to_loops(found, expected)
    if model == "refined":  # the cells are worth something
        assert 0 < found.unbounded.max() < 1
        assert np.any((found.probability > 0) & (found.probability < 1))
        assert found.somewhere.min() == 0
        assert found.somewhere.max() == 1
        assert np.isinf(found.V2).any()
        assert np.isnan(found.V1).any()


@settings(deadline=None, max_examples=40, derandomize=True)
@given(machine=machines, data=st.data(), cells=st.lists(st.tuples(lams, sigmas), min_size=1, max_size=3))
def test_random_machines(machine, data, cells):
    bicycle = Bicycle.from_mapping(machine)
    given = bicycle.given
    mass, height = ("mB", "zB") if "mB" in given else ("m1", "h1")
    spread = data.draw(st.floats(0.01, 0.5), label="spread")
    samples = {
        name: between(name, 7, given[name] * (1 - spread), given[name] * (1 + spread))
        for name in (mass, height)
    }
    lam, sigma = np.array(cells).T
    found = ensemble_statistics(Family(bicycle), samples, lam, sigma, V, QUANTILES)
    assert_equal_to_loops(found, by_loops(one_by_one(bicycle, samples), lam, sigma, V, "refined"))


@pytest.mark.parametrize("name", ["dikarev1981", "meijaard2007", "kooijman2011", "sharp1971"])
def test_a_narrow_ensemble_is_the_machine_itself(name):
    bicycle = Bicycle.preset(name)
    lam = np.array([bicycle.lam or 0.1, 0.1, 0.3])
    sigma = np.array([bicycle.sigma or 0.15, 0.15, 0.08])
    samples = {"g": np.nextafter(bicycle.g, [0, bicycle.g, 100])}
    found = ensemble_statistics(Family(bicycle), samples, lam, sigma, V[1:], QUANTILES)
    table = characteristic_table(bicycle, lam, sigma)
    np.testing.assert_array_equal(found.probability, stable(table[..., np.newaxis], V[1:]))
    exact = intervals_of(table)
    np.testing.assert_array_equal(found.somewhere, exact.number > 0)
    np.testing.assert_array_equal(found.unbounded, np.isinf(exact.V2).any(axis=-1))
    single = exact.number == 1
    assert single.any()
    for ends, own in ((found.V1, exact.V1), (found.V2, exact.V2)):
        expected = np.repeat(own[single, :1], len(QUANTILES), axis=1)
        np.testing.assert_allclose(ends[single], expected, rtol=1e-9)


@pytest.mark.parametrize(
    ("bicycle", "name", "low", "high", "lam", "sigma"),
    [
        ("dikarev1981", "C2", 0.0, 0.5, 0.2, 0.08),
        ("dikarev1981", "delta", 0.0, 5.0, 0.2, 0.08),
        ("meijaard2007", "mB", 10.0, 150.0, math.pi / 10, 0.08 / 1.02),
        ("meijaard2007", "xB", 0.1, 0.6, math.pi / 10, 0.08 / 1.02),
    ],
)
def test_the_exact_share_of_one_uniform_parameter(bicycle, name, low, high, lam, sigma):
    """Within five standard deviations of a binomial count; the share from roots in the parameter."""
    bicycle, number = Bicycle.preset(bicycle), 20_000
    speeds = np.array([2.0, 3.0, 3.45, 3.6, 3.8, 4.5, 5.0, 6.0, 8.0, 12.0])
    samples = {name: between(name, number, low, high)}
    found = ensemble_statistics(Family(bicycle), samples, np.array([lam]), np.array([sigma]), speeds, [0.5])
    between_0_and_1 = 0
    for V, share in zip(speeds, found.probability[0], strict=True):
        exact = exact_share(bicycle, name, low, high, lam, sigma, V)
        deviation = math.sqrt(exact * (1 - exact) / number)
        assert share == pytest.approx(exact, abs=5 * deviation + 1e-7)  # float32
        between_0_and_1 += 0.01 < exact < 0.99
    assert between_0_and_1 >= 2


def exact_share(bicycle, name, low, high, lam, sigma, V):
    """The share of low … high in which all six conditions hold, its ends found as roots of each of them."""

    def values(x):
        return np.array(conditions(characteristic_table(bicycle.replaced({name: x}), lam, sigma), V))

    grid = np.linspace(low, high, 201)
    on_grid = np.array([values(x) for x in grid])
    cuts = {low, high}
    for k in range(6):
        for i in np.flatnonzero(np.diff(np.sign(on_grid[:, k])) != 0):
            cuts.add(brentq(lambda x, k=k: values(x)[k], grid[i], grid[i + 1], xtol=1e-12))
    return sum(b - a for a, b in pairwise(sorted(cuts)) if np.all(values(0.5 * (a + b)) > 0)) / (high - low)


@pytest.mark.parametrize("pairs", [1, 7, 40, 100, 1 << 20])
def test_the_division_of_the_work_does_not_matter(pairs, monkeypatch):
    bicycle, samples = dikarev(number=37)
    whole = ensemble_statistics(Family(bicycle), samples, LAM, SIGMA, V, QUANTILES)
    monkeypatch.setattr(ensemble, "_PAIRS", pairs)
    divided = ensemble_statistics(Family(bicycle), samples, LAM, SIGMA, V, QUANTILES)
    for a, b in zip(whole, divided, strict=True):
        np.testing.assert_array_equal(a, b)


def test_cells_and_speeds_do_not_matter_to_each_other():
    bicycle, samples = dikarev()
    family = Family(bicycle)
    whole = ensemble_statistics(family, samples, LAM, SIGMA, V, QUANTILES)
    for i in range(len(LAM)):
        part = LAM[i : i + 1], SIGMA[i : i + 1], V[10:20]
        alone = ensemble_statistics(family, samples, *part, QUANTILES)
        np.testing.assert_array_equal(alone.probability[0], whole.probability[i, 10:20])
        np.testing.assert_array_equal(alone.V1[0], whole.V1[i])
        np.testing.assert_array_equal(alone.V2[0], whole.V2[i])


def test_the_order_of_the_parameters_does_not_matter():
    bicycle, samples = dikarev()
    backwards = dict(reversed(samples.items()))
    first, second = (
        ensemble_statistics(Family(bicycle), s, LAM, SIGMA, V, QUANTILES) for s in (samples, backwards)
    )
    for a, b in zip(first, second, strict=True):
        np.testing.assert_array_equal(a, b)


def fake_intervals(monkeypatch, *of_each_machine):
    """Let the machines of one cell have these intervals."""
    most = max(len(pairs) for pairs in of_each_machine)
    V1, V2 = np.full((2, len(of_each_machine), 1, max(most, 1)), np.nan)
    for i, pairs in enumerate(of_each_machine):
        for j, (a, b) in enumerate(pairs):
            V1[i, 0, j], V2[i, 0, j] = a, b
    kind = np.isfinite(V1).astype(np.uint8)
    error = np.zeros_like(V1)
    known = Intervals(V1, V2, kind, kind, error, error, 0 * kind)
    monkeypatch.setattr(ensemble, "intervals_of", lambda _: known)
    samples = {"m1": np.linspace(60, 90, len(of_each_machine))}

    def statistics(V, quantiles):
        return ensemble_statistics(
            Family(Bicycle.preset("dikarev1981")), samples, LAM[:1], SIGMA[:1], np.array(V), quantiles
        )

    return statistics


def test_speeds_at_an_end_are_not_stable(monkeypatch):
    statistics = fake_intervals(monkeypatch, [(0.0, 2.0), (3.0, math.inf)], [(2.0, 3.0)], [(2.2, 2.4)], [])
    found = statistics([0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 1e6], [0.5])
    np.testing.assert_array_equal(found.probability[0] * 4, [0, 1, 0, 1, 0, 1, 1])
    assert (found.somewhere[0], found.unbounded[0]) == (0.75, 0.25)


def test_the_widest_interval_and_the_lower_of_equal_ones(monkeypatch):
    statistics = fake_intervals(monkeypatch, [(1.0, 2.0), (3.0, 4.0)], [(1.5, 2.0), (5.0, 9.0)], [])
    found = statistics([1.0, 2.0], [0.5, 0.51])
    assert found.V1.tolist() == [[1.0, 5.0]]
    assert found.V2.tolist() == [[2.0, 9.0]]


def test_quantiles_between_unbounded_intervals_are_no_nan(monkeypatch):
    statistics = fake_intervals(monkeypatch, [(1, math.inf)], [(2, math.inf)], [(3, math.inf)], [(4, 5)])
    found = statistics([1.0, 2.0], [0.01, 0.25, 0.26, 0.5, 0.75, 0.99])
    assert found.V1.tolist() == [[1, 1, 2, 2, 3, 4]]
    assert found.V2.tolist() == [[5, 5, *[math.inf] * 4]]


def test_quantiles_of_a_hundred_are_the_hundredths(monkeypatch):
    """Where the product of share and number is a whole number, whatever its rounding."""
    statistics = fake_intervals(monkeypatch, *([(float(i), 200.0)] for i in range(1, 101)))
    shares = [0.01, 0.07, 0.14, 0.28, 0.29, 0.55, 0.56, 0.57, 0.58, 0.95]
    assert statistics([1.0, 2.0], shares).V1[0].tolist() == [1, 7, 14, 28, 29, 55, 56, 57, 58, 95]


def test_no_machine_is_ever_stable(monkeypatch):
    found = fake_intervals(monkeypatch, [], [])([1.0, 2.0], [0.1, 0.9])
    assert (found.somewhere[0], found.unbounded[0]) == (0, 0)
    assert np.isnan([found.V1, found.V2]).all()
    assert not found.probability.any()
