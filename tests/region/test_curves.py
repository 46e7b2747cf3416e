"""The traced curves: on their equations in 40 digits, complete, and with the right ends."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from mpmath import mp, mpf

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.model import characteristic_table
from bikestab.region.curves import NAMES, trace
from bikestab.region.lines import stable_ranges
from bikestab.region.onto import between
from bikestab.speeds import intervals_of
from tests.references.generate_speeds import BENCHMARK, PAPER, at, condition_polynomials, polynomial
from tests.references.verify_meshes import pairs
from tests.strategies import machines

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
LAM, SIGMA = (0.0, 0.6), (0.0, 0.5)


@pytest.fixture(scope="module")
def curves():
    return {
        (name, delta): trace(Family(bicycle.with_delta(delta)), LAM, SIGMA, samples=241)
        for name, bicycle in (("1981", DIKAREV), ("2007", MEIJAARD))
        for delta in (0.0, 1.0)
    }


def conditions_40(machine, delta, lam, sigma):
    return condition_polynomials(polynomial(machine, lam, sigma, delta, "refined"))


def derivative(poly):
    return {j - 1: j * x for j, x in poly.items() if j}


def exact_point(machine, delta, name, lam, sigma, V):
    """The point of a curve at the same λ, or at the same σ, that 40-digit arithmetic finds; the nearer."""

    def equations(lam, sigma, V=None):
        found = conditions_40(machine, delta, lam, sigma)
        if name in ("capsize at infinity", "weave at infinity"):
            poly = found["p0" if name.startswith("capsize") else "hurwitz3"]
            return [poly[max(poly)].value]
        second = derivative(found["hurwitz3"]) if name == "fold" else found["p0"]
        return [at(found["hurwitz3"], V), at(second, V)]

    with mp.workdps(40):
        start = [] if np.isinf(V) else [mpf(V)]
        found = []
        for fixed in ("lam", "sigma"):
            run, free = (mpf(sigma), mpf(lam)) if fixed == "lam" else (mpf(lam), mpf(sigma))

            def function(x, *V, fixed=fixed, free=free):
                return equations(free, x, *V) if fixed == "lam" else equations(x, free, *V)

            solution = mp.findroot(function, [run, *start], tol=1e-25, verify=False, maxsteps=12)
            found.append(abs(solution[0] - run))
        return float(min(found))


@pytest.mark.parametrize("which", [("1981", 0.0), ("1981", 1.0), ("2007", 0.0)], ids=str)
def test_points_satisfy_the_defining_equations_in_40_digits(curves, which):
    machine = {"1981": PAPER, "2007": BENCHMARK}[which[0]]
    for curve in curves[which]:
        for i in np.unique(np.linspace(1, len(curve.x) - 2, 5).astype(int)):
            point = float(curve.x[i]), float(curve.y[i]), float(curve.V[i])
            assert exact_point(machine, which[1], curve.name, *point) < 1e-10, (curve.name, point)


def test_the_curves_of_the_papers_bicycle(curves):
    """The short fold, the three infinite and rest curves and where they meet; found once, kept by value."""
    found = curves["1981", 0.0]
    fold = [curve for curve in found if curve.name == "fold"]
    assert len(fold) == 1
    assert set(fold[0].ends) == {"weave at infinity", "weave meets capsize"}
    ends = sorted((float(fold[0].x[i]), float(fold[0].y[i])) for i in (0, -1))
    np.testing.assert_allclose(ends, [[0.0469790, 0.1515630], [0.0496178, 0.1533011]], atol=1e-6)
    for name in ("capsize at infinity", "weave at infinity"):
        (curve,) = [curve for curve in found if curve.name == name]
        corner = [(x, y) for x, y in zip(curve.x, curve.y, strict=True) if abs(x - 0.0881670) < 1e-6]
        np.testing.assert_allclose(corner, [[0.0881669521, 0.1107011842]], atol=1e-9)
        assert np.all(np.isinf(curve.V))


def test_ends_meet_what_they_name(curves):
    for found in curves.values():
        for curve in found:
            for name, at_ in zip(curve.ends, (0, -1), strict=True):
                here = curve.x[at_], curve.y[at_]
                if name == "box":
                    edges = [here[0] - LAM[0], LAM[1] - here[0], here[1] - SIGMA[0], SIGMA[1] - here[1]]
                    assert min(edges) == 0
                elif name != "closed":
                    others = [c for c in found if c.name == name and c is not curve]
                    gap = min(np.hypot(c.x - here[0], c.y - here[1]).min() for c in others)
                    assert gap < 2e-3, (curve.name, name)  # a point of the other within a step of its samples


@pytest.mark.parametrize("which", [("1981", 0.0), ("1981", 1.0), ("2007", 0.0), ("2007", 1.0)], ids=str)
def test_nothing_is_missing(curves, which):
    """Every end of a stable range on random lines, found without the grid, lies on a traced closing curve."""
    bicycle = {"1981": DIKAREV, "2007": MEIJAARD}[which[0]].with_delta(which[1])
    assert_ends_of_ranges_are_on(curves[which], Family(bicycle))


@pytest.mark.parametrize("delta", [1e-12, 1e-6, 1e-3])
def test_nothing_is_missing_at_little_damping(delta):
    """Where events at V > 0 and at V < 0 nearly fall together."""
    family = Family(DIKAREV.with_delta(delta))
    assert_ends_of_ranges_are_on(trace(family, LAM, SIGMA, samples=241), family)


def assert_ends_of_ranges_are_on(found, family):
    lam = np.random.default_rng(3).uniform(0, 0.6, 40)
    closing = [curve for curve in found if curve.closes or "infinity" in curve.name]
    for value, ranges in zip(lam, stable_ranges(family, *SIGMA, x=lam), strict=True):
        for end in {x for ends in ranges for x in ends} - set(SIGMA):
            gaps = []
            for curve in closing:
                i = np.flatnonzero((curve.x[:-1] - value) * (curve.x[1:] - value) <= 0)
                t = (value - curve.x[i]) / (curve.x[i + 1] - curve.x[i])
                gaps.extend(np.abs(curve.y[i] + t * (curve.y[i + 1] - curve.y[i]) - end))
            assert min(gaps, default=np.inf) < 1e-4, (value, end)  # of the chord between two of its points


@pytest.mark.parametrize("which", [("1981", 0.0), ("2007", 1.0)], ids=str)
def test_what_happens_across(curves, which):
    """An interval appears across a closing curve; across the others only the kinds of its ends change."""
    bicycle = {"1981": DIKAREV, "2007": MEIJAARD}[which[0]].with_delta(which[1])
    long = [curve for curve in curves[which] if len(curve.x) > 20]
    assert len(long) >= 5
    for curve in long:
        along = np.array([np.gradient(curve.x), np.gradient(curve.y)])[:, 3:-3]
        aside = np.array([-along[1], along[0]]) / np.hypot(*along) * 1e-6
        sides = [
            intervals_of(characteristic_table(bicycle, curve.x[3:-3] + x, curve.y[3:-3] + y))
            for x, y in (aside, -aside)
        ]
        number = np.abs(sides[0].number - sides[1].number)
        if curve.closes:
            assert np.median(number) == 1, curve.name
        elif curve.name == "weave meets capsize":
            assert np.median(number) == 0
        else:
            infinite = [np.isposinf(side.V2).any(axis=-1) for side in sides]
            assert np.mean(infinite[0] != infinite[1]) > 0.9, curve.name


@pytest.mark.parametrize("which", ["1981", "2007"])
def test_no_unbounded_interval_outside_its_curves(curves, which):
    """A million random designs: to infinity only between weave and capsize at infinity."""
    bicycle = {"1981": DIKAREV, "2007": MEIJAARD}[which]
    lam, sigma = np.random.default_rng(5).uniform(0, [[0.6], [0.5]], (2, 1_000_000))
    infinite = np.isposinf(intervals_of(characteristic_table(bicycle, lam, sigma)).V2).any(axis=-1)
    named = {curve.name: curve for curve in curves[which, 0.0]}
    ends = []
    for name in ("weave at infinity", "capsize at infinity"):
        order = np.argsort(named[name].y)
        ends.append(np.interp(sigma, named[name].y[order], named[name].x[order]))
    left, right = ends
    left[sigma > named["weave at infinity"].y.max()] = -np.inf  # the curve has left the box through λ = 0
    corner = max(curve.y.min() for curve in named.values() if "infinity" in curve.name)
    expected = (lam > left) & (lam < right) & (sigma > corner)
    near = np.minimum(np.abs(lam - left), np.abs(lam - right)) < 1e-4  # chords of the curves
    np.testing.assert_array_equal(infinite[~near], expected[~near])
    assert 0.005 < infinite.mean() < 0.5


@settings(max_examples=5, deadline=None)
@given(machines)
def test_random_machines(machine):
    bicycle = Bicycle.from_mapping(machine)
    found = trace(Family(bicycle), LAM, (0.0, 0.3), samples=61)
    for curve in found:
        assert curve.name in NAMES.values()
        assert len(curve.x) == len(curve.y) == len(curve.V) > 1
        assert np.all(np.isfinite(curve.x) & np.isfinite(curve.y))
        assert not curve.closes or "infinity" not in curve.name
    sigma = 0.1234
    (ranges,) = stable_ranges(Family(bicycle), *LAM, y=sigma)
    for a, b in ranges:
        if b - a > 0.05:  # what the coarse grid cannot miss
            for end in {a, b} - set(LAM):
                i = [
                    np.abs(np.interp(sigma, c.y[k : k + 2], c.x[k : k + 2]) - end)
                    for c in found
                    for k in np.flatnonzero((c.y[:-1] - sigma) * (c.y[1:] - sigma) <= 0)
                ]
                assert min(i, default=np.inf) < 0.02


def test_zeros_and_jumps_within_brackets():
    """Roots of cubics, known from their factors, flat ones, and a jump, each in a bracket of its own."""
    root = np.array([0.1, 0.5, 0.9, 1 / 3, 0.25, 0.7])

    def function(points, row):
        x = points[0]
        r = root[row]
        smooth = (x - r) * (1 + x**2)
        return np.select([row == 3, row == 4], [(x - r) ** 3, np.where(x < r, -1.0, 2.0)], smooth)

    rows = np.arange(6.0)
    found = between(function, np.array([np.zeros(6), rows]), np.array([np.ones(6), rows]))
    np.testing.assert_array_equal(found[1], rows)
    np.testing.assert_allclose(found[0][[0, 1, 2, 4, 5]], root[[0, 1, 2, 4, 5]], atol=2e-16, rtol=0)
    assert found[0][3] == pytest.approx(root[3], abs=1e-5)  # its cube is 1e-15 there


def test_a_fold_that_turns_within_a_cell_of_the_grid():
    """It ends where it touches the curve on which weave meets capsize, and not on the chord of the cell."""
    family, ends = next(islice(pairs(320, seed=1), 280, None))
    found = trace(family, *ends, samples=201)
    low, size = np.array(ends[:2])[:, 0], np.ptp(ends[:2], axis=1)
    fold = next(c for c in found if c.name == "fold")
    assert fold.ends == ("box", "weave meets capsize")
    places = np.column_stack([(np.array([c.x, c.y]).T - low).T / size[:, np.newaxis] for c in found])
    assert places.min() >= 0
    assert places.max() <= 1
    met = [c for c in found if c.ends == ("box", "fold")]
    assert (met[0].x[-1], met[0].y[-1]) == (fold.x[-1], fold.y[-1])
    around = ((a, a + 0.01 * d) for a, d in zip(low + (0, 0.185) * size, size * (1, 2), strict=True))
    finer = next(c for c in trace(family, *around, ends[2], samples=101) if c.name == "fold")
    np.testing.assert_allclose([fold.x[-1], fold.y[-1]], [finer.x[-1], finer.y[-1]], rtol=0, atol=1e-9)
