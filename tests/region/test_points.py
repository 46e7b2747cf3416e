"""The points where the skeleton's curves meet or end: in 40 digits, with the eigenvalues of their names."""

import numpy as np
import pytest
from mpmath import mp, mpf

import bikestab as bs
from bikestab.family import Family
from bikestab.limits import MOST_SPEED
from bikestab.model import characteristic_table
from bikestab.region.curves import trace
from bikestab.region.events import Box
from bikestab.region.pieces import LOST
from bikestab.region.points import WITHIN, _solved, points_of
from bikestab.region.space import SPATIAL, Space
from bikestab.region.spans import _left
from bikestab.spectrum import growth_rate_of
from tests.references.generate_speeds import BENCHMARK, PAPER, at, condition_polynomials, polynomial
from tests.references.verify_meshes import pairs
from tests.region.test_curves import derivative
from tests.region.test_damping import random_machine

BOX = (0.0, 0.6), (-0.1, 0.3)
MACHINES = {
    "1981": (bs.Bicycle.preset("dikarev1981"), PAPER),
    "2007": (bs.Bicycle.preset("meijaard2007"), BENCHMARK),
}


@pytest.fixture(scope="module")
def found():
    result = {}
    for name, (bicycle, _) in MACHINES.items():
        for delta in (0.0, 1.0):
            family = Family(bicycle.with_delta(delta))
            result[name, delta] = points_of(family, trace(family, *BOX), *BOX)
    return result


def test_their_names(found):
    assert {key: sorted(point.name for point in points) for key, points in found.items()} == {
        ("1981", 0.0): ["double zero", "ends at infinity", "ends at infinity", "triple zero"],
        ("1981", 1.0): ["double zero", "ends at infinity", "triple zero", "triple zero", "zero-Hopf"],
        ("2007", 0.0): ["triple zero"],
        ("2007", 1.0): ["triple zero", "zero-Hopf"],
    }
    assert found["1981", 1.0][0].curves == ("fold", "weave meets capsize")


@pytest.mark.parametrize("which", [("1981", 0.0), ("1981", 1.0), ("2007", 0.0), ("2007", 1.0)], ids=str)
def test_eigenvalues_are_what_the_names_say(found, which):
    """Of each three eigenvalues that meet at zero rounding moves each by its cube root."""
    bicycle = MACHINES[which[0]][0].with_delta(which[1])
    for point in found[which]:
        if not np.isfinite(point.V):
            continue
        s = bs.eigenvalues(bicycle, point.V, point.x, point.y)
        zero, axis = np.abs(s) < 1e-4, (np.abs(s.real) < 1e-6) & (np.abs(s.imag) > 0.1)
        expected = {"double zero": (2, 0), "triple zero": (3, 0), "zero-Hopf": (1, 2)}[point.name]
        assert (zero.sum(), axis.sum()) == expected, point


def equations(machine, delta, point):
    """The conditions that vanish together at a point, in 40 digits."""
    names = WITHIN.get(point.name)

    def within(lam, sigma, V):
        table = polynomial(machine, lam, sigma, delta, "refined")
        h = condition_polynomials(table)["hurwitz3"]
        p = {f"p{k}": at({j: x for (i, j), x in table.items() if i == k}, V) for k in range(5)}
        own = {**p, "q": p["p2"] * p["p3"] - p["p4"] * p["p1"], "h": at(h, V), "h'": at(derivative(h), V)}
        return [own[name] for name in names]

    def at_infinity(lam, sigma):
        poly = condition_polynomials(polynomial(machine, lam, sigma, delta, "refined"))
        h, p0 = (poly[name] for name in ("hurwitz3", "p0"))
        powers = sorted(j for j, x in h.items() if x.value)  # without damping every other one
        other = p0[max(p0)] if "capsize at infinity" in point.curves else h[powers[-2]]
        return [h[max(h)].value, other.value]

    return within if names else at_infinity


@pytest.mark.parametrize("which", [("1981", 0.0), ("1981", 1.0), ("2007", 0.0), ("2007", 1.0)], ids=str)
def test_places_in_40_digits(found, which):
    machine = MACHINES[which[0]][1]
    for point in found[which]:
        with mp.workdps(40):
            start = [mpf(point.x), mpf(point.y)] + ([mpf(point.V)] if np.isfinite(point.V) else [])
            exact = mp.findroot(
                equations(machine, which[1], point), start, tol=1e-25, verify=False, maxsteps=15
            )
            away = [abs(a - b) for a, b in zip(exact, start, strict=True)]
        assert max(away) < 1e-10, (point, [float(x) for x in away])


CUSP = bs.Bicycle.preset("dikarev1981").replaced(
    {
        "c": 1.414332, "m1": 217.4492, "l1": 0.4797552, "h1": 0.615696, "A1": 21.62, "B1": 21.06941,
        "D1": -1.735447, "C1": 1.050759, "R1": 0.3048, "m2": 30.6472, "l2": 1.359504, "h2": 0.4164403,
        "A2": 1.070599, "B2": 0.605192, "D2": 0.3202889, "C2": 0.7185835, "R2": 0.3048,
    }
)  # fmt: skip


def cusp_apart(bicycle, point):
    """How far a cusp is from where three weave speeds meet in 40 digits: in tilt, σ and speed."""
    exact = {name: mpf(x) for name, x in bicycle.numbers().items() if x is not None}

    def equations(lam, sigma, V):
        h = condition_polynomials(polynomial(exact, lam, sigma, bicycle.delta, "refined"))["hurwitz3"]
        return [at(h, V), at(derivative(h), V), at(derivative(derivative(h)), V)]

    with mp.workdps(40):
        start = [point.x, point.y, point.V]
        found = mp.findroot(equations, start, tol=1e-25, verify=False, maxsteps=15)
        return [float(abs(a - b)) for a, b in zip(found, start, strict=True)]


def ends_at(curves, point):
    """The pieces that end at a point, and whether an interval closes there."""
    return sorted(
        (curve.name, curve.closes)
        for curve in curves
        for i in (0, -1)
        if np.hypot(curve.x[i] - point.x, curve.y[i] - point.y) < 1e-10
    )


@pytest.mark.parametrize(
    "box",
    [BOX, ((0.0, 0.03), (0.05, 0.1)), ((0.009, 0.0098), (0.083, 0.087))],
    ids=["whole", "near", "close"],
)
def test_a_cusp_of_the_fold_in_40_digits(box):
    """A motorcycle with less roll inertia: three weave speeds meet at λ = 0.0094, σ = 0.0859, 4.63 m/s.

    The two folds that meet there are closer to each other than a grid's step over some way; they were traced
    in up to 60 pieces, none of which ended at the cusp.
    """
    family = Family(CUSP.with_delta(1.0))
    curves = trace(family, *box, samples=121)
    points = points_of(family, curves, *box)
    assert "not resolved" not in {point.name for point in points}
    (cusp,) = [point for point in points if point.name == "cusp of the fold"]
    assert (cusp.x, cusp.y, cusp.V) == pytest.approx((0.009428984, 0.085854403, 4.629176), rel=1e-7)
    assert ends_at(curves, cusp) == [("fold", False), ("fold", True)]
    assert len([curve for curve in curves if curve.name == "fold"]) == (3 if box is BOX else 2)
    s = bs.eigenvalues(family.bicycle, cusp.V, cusp.x, cusp.y)
    assert sorted(np.abs(s.real) < 1e-4) == [False, False, True, True]
    assert max(s.real) < 1e-4
    away = cusp_apart(family.bicycle, cusp)
    assert max(away[:2]) < 1e-10
    assert away[2] < 1e-8  # of a triple root


def test_cusps_of_variants_in_40_digits():
    """Some motorcycles with other roll inertias, masses and dampings have a cusp, too."""
    random, cusps = np.random.default_rng(16), 0
    for _ in range(6):
        values = {"A1": 21.62 * random.uniform(0.9, 1.1), "m1": 217 * random.uniform(0.95, 1.05)}
        bicycle = CUSP.replaced(values).with_delta(random.uniform(0.6, 1.6))
        curves = trace(Family(bicycle), *BOX, samples=61)
        for point in points_of(Family(bicycle), curves, *BOX):
            assert point.name != "not resolved"
            if point.name == "cusp of the fold":
                cusps += 1
                assert ends_at(curves, point) == [("fold", False), ("fold", True)]
                assert max(cusp_apart(bicycle, point)[:2]) < 1e-10
    assert cusps >= 2


@pytest.mark.parametrize(
    ("given", "plane", "box"),
    [
        ({"k_phidot": 5.0}, ("lam", "sigma"), BOX),
        ({"lam": 0.02, "sigma": 0.08}, ("k_phidot", "k_delta"), ((-20.0, 20.0), (-20.0, 20.0))),
        ({"lam": 0.02}, ("delta", "sigma"), ((0.0, 4.0), (-0.1, 0.3))),
    ],
    ids=["a gain", "a plane of gains", "damping and trail"],
)
def test_cusps_in_other_planes_and_with_feedback(given, plane, box):
    """At a cusp a pair is on the axis, and there the real part of it has no first and second slope by V."""
    family = Family(CUSP.replaced(given).with_delta(1.0), x=plane[0], y=plane[1])
    curves = trace(family, *box, samples=81)
    points = points_of(family, curves, *box)
    assert "not resolved" not in {point.name for point in points}
    (cusp,) = [point for point in points if point.name == "cusp of the fold"]
    assert ends_at(curves, cusp) == [("fold", False), ("fold", True)]
    lam, sigma, machine = family.geometry(cusp.x, cusp.y)
    table = characteristic_table(machine, lam, sigma)
    h = 0.02
    rates = [growth_rate_of(table, cusp.V + k * h) for k in (-2, -1, 0, 1, 2)]
    slopes = np.array([rates, np.gradient(rates, h)])
    assert abs(rates[2]) < 1e-9
    assert abs(slopes[1, 2]) < 1e-3
    assert abs(rates[3] - 2 * rates[2] + rates[1]) < 1e-6


def test_random_damped_machines_leave_nothing_unresolved():
    """Through designs with an eigenvalue 0 at every speed, which lie on λ = 0, and to infinity.

    Of the first 80 machines of this row, in 121 × 121 designs, 116 points were not resolved, and now 2.
    """
    names = []
    for seed in (2, 5, 15, 23, 24, 26, 34, 44, 50, 59):
        random = np.random.default_rng([16, seed])
        delta = 10 ** random.uniform(-2, 2)
        family = Family(random_machine(random, delta))
        names += [point.name for point in points_of(family, trace(family, *BOX, samples=61), *BOX)]
    assert "not resolved" not in names
    assert len(names) > 15


class Resonant:
    """p4 = 1, p3 = V − 2 + x, p2 = 2 + x + y, p1 = V − 2 + y, p0 = 1: at x = y = 0 and V = 2 (s² + 1)²."""

    def table(self, x, y):
        x, y = np.broadcast_arrays(x, y)
        table = np.zeros((5, 4, *x.shape))
        table[4, 0], table[0, 0], table[2, 0] = 1, 1, 2 + x + y
        table[3, :2] = x - 2, np.ones(x.shape)
        table[1, :2] = y - 2, np.ones(x.shape)
        return table


def test_a_double_hopf_point_of_a_bicycle_in_40_digits():
    """One without feedback, at a negative trail: two pairs of eigenvalues are equal on the axis."""
    random = np.random.default_rng([16, 42])
    delta = 10 ** random.uniform(-2, 2)
    bicycle = random_machine(random, delta)
    assert not bicycle.warnings
    box = (0.0, 0.1), (-0.25, -0.15)
    points = points_of(Family(bicycle), trace(Family(bicycle), *box, samples=61), *box)
    (point,) = [point for point in points if point.name == "double Hopf"]
    s = bs.eigenvalues(bicycle, point.V, point.x, point.y)
    assert np.abs(s.real).max() < 1e-6
    assert np.abs(s.imag) == pytest.approx([1.08608157] * 4, abs=1e-6)
    exact = {name: mpf(x) for name, x in bicycle.numbers().items() if x is not None}

    def equations(lam, sigma, V):
        table = polynomial(exact, lam, sigma, delta, "refined")
        p = [at({j: x for (i, j), x in table.items() if i == k}, V) for k in range(5)]
        return [p[1], p[3], p[2] ** 2 - 4 * p[4] * p[0]]

    with mp.workdps(40):
        start = [mpf(point.x), mpf(point.y), mpf(point.V)]
        found = mp.findroot(equations, start, tol=1e-25, verify=False, maxsteps=15)
        assert max(abs(a - b) for a, b in zip(found, start, strict=True)) < 1e-10


def test_a_double_hopf_point():
    point = _solved(Resonant(), np.array([0.004, -0.007]), 2.1, ("fold",), np.array([1.0, 1.0]))
    assert point.name == "double Hopf"
    assert np.abs([point.x, point.y, point.V - 2]).max() < 1e-10
    p = Resonant().table(point.x, point.y) @ point.V ** np.arange(4.0)
    assert np.abs(np.abs(np.roots(p[::-1]).imag) - 1).max() < 1e-4


@pytest.mark.parametrize(
    ("name", "delta", "pieces"),
    [
        ("dikarev1981", 1e-12, 7),
        ("dikarev1981", 1e-9, 8),
        ("dikarev1981", 1e-3, 9),
        ("meijaard2007", 1e6, 2),
        ("meijaard2007", 1e9, 0),
        ("sharp1971", 1e9, 3),
    ],
)
def test_hardly_any_and_huge_damping(name, delta, pieces):
    """Curves go on to speeds at which 1 − w is tiny, and none is told of at speeds that are not allowed.

    Where a step left the box by a face that the curve does not meet it was given up: with δ = 10⁻¹² at
    239 m/s. With δ = 10⁹ there were 22 pieces of one curve at 10⁹ m/s, where rounding says what closes.
    """
    family = Family(bs.Bicycle.preset(name).with_delta(delta))
    curves = trace(family, *BOX, samples=61)
    assert len(curves) == pieces
    assert "not resolved" not in {point.name for point in points_of(family, curves, *BOX)}
    assert not any(LOST in curve.ends for curve in curves)
    V = np.concatenate([np.zeros(1), *(curve.V for curve in curves)])
    assert V[np.isfinite(V)].max() <= MOST_SPEED
    for curve in curves:  # the middle of a fold from a double zero: two intervals on one of its sides
        if curve.name == "fold" and not curve.closes:
            i = len(curve.x) // 2
            aside = [curve.x[i], curve.x[i]], [curve.y[i] - 1e-5, curve.y[i] + 1e-5]
            number = bs.stable_intervals(family.bicycle, lam=aside[0], sigma=aside[1]).number
            assert sorted(number.tolist()) == [1, 2]


def test_what_gets_stuck_is_no_fold():
    """A line that ends inside the box ends on a fold only where p1 = p3 = 0, else it was not followed."""
    space = Space(
        Box(Family(bs.Bicycle.preset("sharp1971").with_delta(1.0)), np.array(BOX), (0, np.inf)), 5.0
    )
    for curve in range(len(SPATIAL)):
        assert _left(space, curve, np.array([0.4, 0.5, 0.6])) == LOST


def test_no_fold_is_at_infinity():
    """p1 and p3 of infinite speeds have no signs, and numpy warned of them."""
    family, box = list(pairs(160, 1))[159]
    assert trace(family, *box, samples=41)
    space = Space(Box(family, np.array(box[:2]), (0, np.inf)), 5.0)
    assert not space.crossed(np.array([[0.3], [0.05], [1.0]])).any()
