"""Steer torque by feedback against BicycleParameters' model with gains, and against stacked eigenvalues."""

from pathlib import Path

import numpy as np
import pytest
from bicycleparameters.models import Meijaard2007WithFeedbackModel
from bicycleparameters.parameter_dicts import meijaard2007_browser_jason
from bicycleparameters.parameter_sets import Meijaard2007ParameterSet
from scipy.optimize import linear_sum_assignment

import bikestab as bs
from bikestab.bicycle import Bicycle
from bikestab.config.expectations import outcome_of
from bikestab.config.file import load_config
from bikestab.design.free import Free, best_free
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.gains import GAINS
from bikestab.model import canonical_matrices, characteristic_table, exact_table
from bikestab.region.curves import trace
from bikestab.region.lines import stable_ranges
from bikestab.speeds import intervals_of
from tests.configs import load

BENCHMARK = Bicycle.preset("meijaard2007")
JASON = Bicycle.from_mapping(
    {k: v for k, v in meijaard2007_browser_jason.items() if k in BENCHMARK.given or k == "g"}
)
THEIRS = {"kTdel_phi": "k_phi", "kTdel_del": "k_delta", "kTdel_phid": "k_phidot", "kTdel_deld": "k_deltadot"}


@pytest.mark.parametrize(("ending", "power"), [("", 0), ("_V", 1), ("_per_V", -1)])
def test_eigenvalues_of_bicycleparameters(ending, power):
    """At each speed theirs has the constant gain that ours is there."""
    model = Meijaard2007WithFeedbackModel(Meijaard2007ParameterSet(meijaard2007_browser_jason, True))
    random = np.random.default_rng(0)
    for _ in range(60):
        gains, V = random.uniform(-60, 60, 4), random.uniform(0.3, 12)
        A, _ = model.form_state_space_matrices(v=V, **dict(zip(THEIRS, gains, strict=True)))
        expected = np.linalg.eigvals(A)
        names = [f"{name}{ending}" for name in THEIRS.values()]
        own = JASON.replaced(dict(zip(names, (gains * V**-power).tolist(), strict=True)))
        found = bs.eigenvalues(own, V)
        apart = np.abs(expected[:, np.newaxis] - found)
        assert apart[linear_sum_assignment(apart)].max() <= 1e-10 * np.abs(expected).max()


SIZES = {"ot_V": 0.1, "ta_V": 0.1, "hi_V": 0.1}  # of gains that grow with the speed


def growth(bicycle, V):
    """The largest real part at each V, by numpy, of the matrices with the feedback's own row."""
    M, C1, K0, K2 = canonical_matrices(bicycle, bicycle.lam, bicycle.sigma)
    k = dict.fromkeys(GAINS, 0.0) | dict(bicycle.gains)
    V = V[:, np.newaxis, np.newaxis]
    stiff, damp = (
        sum(
            V**power * [[0, 0], [k[f"k_phi{dot}{ending}"], k[f"k_delta{dot}{ending}"]]]
            for ending, power in (("", 0), ("_V", 1), ("_per_V", -1))
        )
        for dot in ("", "dot")
    )
    damp = damp + np.diag([0.0, bicycle.delta])
    A = np.zeros((len(V), 4, 4))
    A[:, :2, 2:] = np.eye(2)
    A[:, 2:, :2] = -np.linalg.solve(M, bicycle.g * K0 + V**2 * K2 + stiff)
    A[:, 2:, 2:] = -np.linalg.solve(M, V * C1 + damp)
    return np.linalg.eigvals(A).real.max(axis=1)


@pytest.mark.parametrize("seed", range(24))
def test_intervals_of_random_gains_are_where_numpy_says(seed):
    random = np.random.default_rng(seed)
    some = random.choice(list(GAINS), 3, replace=False)
    gains = {name: float(random.uniform(-30, 30) * SIZES.get(name[-4:], 1)) for name in some}
    own = (BENCHMARK if seed % 2 else JASON).replaced({**gains, "delta": float(seed % 3)})
    V = np.linspace(0.05, 15, 3000)
    found = bs.stable_intervals(own)
    inside = np.zeros(len(V), bool)
    for low, high in zip(found.V1, found.V2, strict=True):
        inside |= (low < V) & (high > V)
    rate = growth(own, V)
    clear = np.abs(rate) > 1e-9
    np.testing.assert_array_equal((rate < 0)[clear], inside[clear])
    for low, error in zip(found.V1, found.V1_error, strict=True):
        if low > 0:
            assert abs(growth(own, np.array([low]))[0]) < 1e-6
            assert error < 1e-9


@pytest.mark.parametrize("name", ["k_phidot", "k_delta", "k_phi_V", "k_deltadot_V", "k_phidot_per_V"])
def test_derivatives_by_gains(name):
    gains = {"k_phidot": -20.0, "k_delta": 2.0, "k_phi_V": 0.5, "k_deltadot_V": 0.3, "k_phidot_per_V": -5.0}
    own = BENCHMARK.replaced(gains)
    value, step = dict(own.gains)[name], 1e-4
    ends = [bs.stable_intervals(own.replaced({name: value + way * step})) for way in (1, -1)]
    found = bs.sensitivity(own)
    for slopes, key in ((found.dV1, "V1"), (found.dV2, "V2")):
        expected = (getattr(ends[0], key) - getattr(ends[1], key)) / (2 * step)
        np.testing.assert_allclose(slopes[name], expected, rtol=1e-6, atol=1e-9)


def test_a_family_over_gains():
    """Tables are those of single machines, and curves part dense random designs."""
    family = Family(BENCHMARK, x="k_phidot", y="k_deltadot")
    x, y = np.random.default_rng(1).uniform([-60, 0], [0, 8], (2000, 2)).T
    tables = family.table(x, y)
    for i in range(20):
        own = BENCHMARK.replaced({"k_phidot": x[i], "k_deltadot": y[i]})
        expected = exact_table(own, own.lam, own.sigma).value
        np.testing.assert_allclose(tables[..., i], expected, rtol=1e-13, atol=1e-13)
        np.testing.assert_allclose(
            characteristic_table(own, own.lam, own.sigma), expected, rtol=1e-11, atol=1e-9
        )
    number = intervals_of(tables).number
    assert {0, 1} <= {*number.tolist()} or number.min() == number.max()
    curves = trace(family, (-60.0, 0.0), (0.0, 8.0), samples=121)
    lines = np.linspace(-59, -1, 8)
    values = np.linspace(0.01, 7.99, 3000)
    found = intervals_of(family.table(lines[:, np.newaxis], values))
    for i, at in enumerate(lines):
        crossed = [np.empty(0)]
        for curve in curves:
            k = np.flatnonzero((curve.x[:-1] - at) * (curve.x[1:] - at) <= 0)
            crossed.append(0.5 * (curve.y[k] + curve.y[k + 1]))
        change = np.flatnonzero(np.diff(found.number[i]))
        near = np.abs(values[change][:, np.newaxis] - np.concatenate(crossed)).min(axis=1, initial=np.inf)
        assert np.all(near < 0.1)


def test_what_one_kind_of_gain_in_proportion_to_1_over_v_cancels():
    """The lowest powers of hurwitz3, whose sign at low speeds was then that of rounding."""
    for gains in (
        {"k_phi": -0.8, "k_deltadot": -1.4, "k_phi_per_V": -14.5, "k_phidot_per_V": -20.6, "delta": 1.0},
        {"k_delta": -29.0, "k_phidot_V": -2.1, "k_delta_V": 1.6, "k_delta_per_V": -4.0, "delta": 1.0},
    ):
        own = BENCHMARK.replaced(gains)
        found = bs.stable_intervals(own)
        assert not found.marginal.any()
        V = np.linspace(0.02, 8, 400)
        inside = sum(((low < V) & (high > V) for low, high in zip(found.V1, found.V2, strict=True)), V < 0)
        np.testing.assert_array_equal(growth(own, V) < 0, inside)


def test_gains_in_proportion_to_1_over_v_at_rest_and_beside_others():
    own = BENCHMARK.replaced({"k_phidot_per_V": -60.0, "k_deltadot": 1.0})
    for ask in (bs.eigenvalues, bs.growth_rate, bs.stable, bs.modes):
        with pytest.raises(InputError, match="k_phidot_per_V/V of the bicycle 'meijaard2007' is infinite"):
            ask(own, [0.0, 5.0])
    V = np.array([0.5, 2.0, 5.0, 9.0])
    np.testing.assert_array_equal(bs.stable(own, V), growth(own, V) < 0)
    np.testing.assert_allclose(bs.modes(own, V).eigenvalues.real.max(axis=0), growth(own, V), atol=1e-9)
    rate = bs.sensitivity(own).best
    speeds = np.linspace(0.2, 30, 2000)
    assert rate.value - 1e-9 <= growth(own, speeds).min() < rate.value + 0.05  # where two modes cross
    assert growth(own, np.array([rate.V]))[0] == pytest.approx(rate.value, abs=1e-9)
    tables = characteristic_table(own, own.lam, [0.05, 0.08])
    np.testing.assert_allclose(tables, exact_table(own, own.lam, [0.05, 0.08]).value, rtol=1e-11, atol=1e-9)


@pytest.mark.parametrize("y", ["k_delta_V", "k_delta_per_V"])
def test_two_capsize_speeds_meet(y):
    """With such gains p0 may have two zeros: where they meet an interval closes."""
    own = BENCHMARK.replaced({"k_phidot": -40.0, "k_deltadot": 3.0, "k_delta": 15.0, "k_delta_V": -4.0})
    family = Family(own, x="k_delta", y=y)
    curves = trace(family, (0.0, 40.0), (-8.0, 0.0) if y == "k_delta_V" else (-20.0, 20.0), samples=41)
    folds = [curve for curve in curves if curve.name == "fold of capsize" and curve.closes]
    curve = max(folds, key=lambda each: len(each.x))
    for k in np.linspace(1, len(curve.x) - 2, 5).astype(int):
        found = intervals_of(family.table(curve.x[k] + np.array([-1e-5, 1e-5]), curve.y[k]))
        V = curve.V[k]
        (narrow,) = np.flatnonzero(((found.V1 < V) & (found.V2 > V)).any(axis=-1))
        i = int(np.flatnonzero((found.V1[narrow] < V) & (found.V2[narrow] > V))[0])
        assert bs.KINDS[found.lower[narrow, i]] == bs.KINDS[found.upper[narrow, i]] == "capsize"
        assert found.V2[narrow, i] - found.V1[narrow, i] < 0.1 * V
    inside = Family(own, x="delta", y="k_delta")
    (ranges,) = stable_ranges(inside, 0.0, 40.0, x=0.0)
    values = np.linspace(0.005, 39.995, 4000)
    some = intervals_of(inside.table(0.0, values)).number > 0
    within = sum(((low <= values) & (high >= values) for low, high in ranges), values < 0)
    np.testing.assert_array_equal(some, within)


def test_a_scan_with_gains_in_proportion_to_1_over_v(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = """\
bicycle: ./own.yaml
grid:
  x: {name: k_phidot_per_V, values: [-80, -40, 0]}
  y: {name: k_deltadot, values: [0, 3]}
  V: {start: 0.5, stop: 8, num: 16}
fields: [stable, violated, growth_rate, dV1]
output: out
"""
    Path("own.yaml").write_text("".join(f"{k}: {v}\n" for k, v in BENCHMARK.given.items()))
    with bs.scan(load(text)).open() as volume:
        for i, gain in enumerate((-80.0, -40.0, 0.0)):
            own = BENCHMARK.replaced({"k_phidot_per_V": gain, "k_deltadot": 3.0})
            expected = growth(own, volume.axis("V"))
            np.testing.assert_allclose(volume.read("growth_rate")[i, 1], expected, rtol=1e-5, atol=1e-6)
            np.testing.assert_array_equal(volume.read("stable")[i, 1], expected < 0)
    with pytest.raises(InputError, match="k_phidot_per_V/V is infinite at V = 0"):
        load(text.replace("0.5, stop", "0, stop"))


def test_a_volume_keeps_gains(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("own.yaml").write_text(
        "".join(f"{k}: {v}\n" for k, v in BENCHMARK.given.items()) + "k_phidot: -20\n"
    )
    text = """\
bicycle: ./own.yaml
grid: {lam: {values: [16deg, 18deg]}, sigma: {values: [0.07, 0.08]}, V: {start: 0, stop: 8, num: 9}}
"""
    config = load(text)
    assert config.sha256 != load(text.replace("./own.yaml", "meijaard2007")).sha256
    with bs.scan(config).open() as volume:
        assert volume.bicycle.gains == (("k_phidot", -20.0),)
        expected = bs.stable_intervals(BENCHMARK.replaced({"k_phidot": -20.0}), "16deg", 0.07)
        np.testing.assert_allclose(volume.read("V1")[0, 0], expected.V1, rtol=1e-14)
    swept = load(text.replace("./own", "./own"), "sweep={k_deltadot: [0, 2]}", "output=out/swept")
    with bs.scan(swept).open() as volume:
        assert volume.at({"k_deltadot": 2}).bicycle.gains == (("k_phidot", -20.0), ("k_deltadot", 2.0))


def test_the_published_steer_assist():
    config = load_config(Path(__file__).parents[2] / "configs/steer_assist.yaml")
    assert all(outcome_of(config, expected, ()).holds for expected in config.expect)
    alone = bs.stable_intervals(config.machine.replaced({"k_phidot": 0.0}))
    assert alone.V1[0] == pytest.approx(4.087, abs=1e-3)
    V = np.array([0.70, 0.72, 6.25, 6.26])
    np.testing.assert_array_equal(growth(config.machine, V) < 0, [False, True, True, False])


def test_a_gain_of_zero_is_none():
    assert BENCHMARK.replaced({"k_phi": 0.0}) == BENCHMARK


def test_searches_know_gains_in_proportion_to_1_over_v():
    own = BENCHMARK.replaced({"k_phidot_per_V": -60.0, "delta": 1.0})
    free = Free(own, {"lam": (0.2, 0.4), "k_deltadot": (0.0, 5.0)}, judged=(4.0, 4.0))
    found = best_free(free)
    for design in (found.own, found.fastest_decay):
        machine = own.replaced({"k_deltadot": design["over"]["k_deltadot"], "lam": design["lam"]})
        assert growth(machine, np.array([4.0]))[0] == pytest.approx(design["growth_rate"], abs=1e-6)
    assert found.fastest_decay["growth_rate"] < found.own["growth_rate"]
