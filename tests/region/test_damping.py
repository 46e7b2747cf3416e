"""Ranges along lines at every damping, none to 10⁶: against dense samples, and continuous towards none."""

import numpy as np
import pytest

from bikestab.bicycle import Bicycle
from bikestab.family import Family
from bikestab.region.lines import lowest_stable, stable_ranges
from bikestab.speeds import intervals_of

# a machine whose discriminant nearly has a double zero where its first stable σ is, at little damping
FIRST = {
    "c": 1.4313949127843066, "g": 11.863532537425652,
    "m1": 118.08616938734627, "l1": 0.8392596938140383, "h1": 1.0356670687974132, "A1": 2.7430035813082476,
    "B1": 5.074858242760697, "D1": 0.8054385751643309, "C1": 0.25555622089591784, "R1": 0.22418519017128552,
    "m2": 2.961997400907469, "l2": 1.2175380994832412, "h2": 0.5228553603993294, "A2": 0.07265851026541979,
    "B2": 0.33336774587782864, "D2": 0.0141519844472433, "C2": 0.041115181534156386,
    "R2": 0.36353947283032306,
}  # fmt: skip
# bisection in 60-digit arithmetic on the intervals of tests/references/generate_speeds.py
FIRST_SIGMA = {
    0.0: 0.010613891704002740233,
    1e-12: 0.01061389170397982398,
    2.1105140837696215e-11: 0.010613891703519089485,
    1e-10: 0.010613891701711114929,
    1e-6: 0.010613868787727473075,
}


@pytest.mark.parametrize("delta", FIRST_SIGMA)
def test_the_first_stable_trail_next_to_no_damping(delta):
    family = Family(Bicycle.from_mapping({**FIRST, "delta": delta}))
    found = lowest_stable(family, 0.0, 0.5, x=0.44106081293359956)
    assert found == pytest.approx(FIRST_SIGMA[delta], rel=1e-12)


def random_machine(rng, delta):
    u = rng.uniform
    c, m1, m2 = u(0.7, 1.8), u(10, 250), u(1, 30)
    n = {"c": c, "g": 9.81, "m1": m1, "m2": m2, "l1": c * u(0.1, 0.7), "h1": u(0.3, 1.5), "delta": delta}
    n |= {"l2": c * u(0.7, 1.2), "h2": u(0.2, 1.0)}
    for i, m, size in (("1", m1, 0.5), ("2", m2, 0.35)):
        A, B = m * (size * u(0.2, 1, 2)) ** 2
        R = u(0.15, 0.5)
        n |= {"A" + i: A, "B" + i: B, "D" + i: u(-0.9, 0.9) * np.sqrt(A * B), "R" + i: R}
        n["C" + i] = min(0.3 * m * R**2 * u(0.5, 1), A + B)
    return Bicycle.from_mapping(n)


def random_line(rng):
    """The one of (x, y) that has a value, that value, and the ends of the other."""
    if rng.integers(2):
        return "x", rng.uniform(-0.2, 0.9), (-0.5, 0.5)
    return "y", rng.uniform(-0.1, 0.5), (-0.2, 0.6)


def tables(family, fixed, at, values):
    return family.exact_table(at, values) if fixed == "x" else family.exact_table(values, at)


@pytest.mark.parametrize("part", range(5))
def test_random_lines_at_every_damping(part):
    """Stable designs among dense samples are those within the ranges, whose ends are stable themselves."""
    some = 0
    for seed in range(100 * part, 100 * part + 100):
        rng = np.random.default_rng([1981, seed])
        delta = 0.0 if seed % 10 == 0 else 10 ** rng.uniform(-13, 6)
        family = Family(random_machine(rng, delta))
        fixed, at, ends = random_line(rng)
        (ranges,) = stable_ranges(family, *ends, **{fixed: at})
        values = np.append(np.linspace(*ends, 401), rng.uniform(*ends, 400))
        inside = np.any([(values >= a) & (values <= b) for a, b in ranges] or [values != values], axis=0)
        stable = intervals_of(tables(family, fixed, at, values)).number > 0
        np.testing.assert_array_equal(stable, inside, err_msg=f"seed {seed}, delta {delta}")
        assert (intervals_of(tables(family, fixed, at, np.array(ranges))).number > 0).all()
        some += len(ranges)
    assert some > 40


def test_ranges_go_over_into_those_without_damping():
    """The share of a line on which two dampings differ goes to zero with the damping."""
    for seed in range(25):
        rng = np.random.default_rng([2007, seed])
        bicycle = random_machine(rng, 0.0)
        fixed, at, ends = random_line(rng)
        (plain,) = stable_ranges(Family(bicycle), *ends, **{fixed: at})
        for delta in (1e-13, 1e-11, 1e-9):
            (damped,) = stable_ranges(Family(bicycle.with_delta(delta)), *ends, **{fixed: at})
            assert differing(plain, damped) < 1e-13 + 100 * delta, (seed, delta)


def differing(a, b):
    """The length of what is in one of two lists of ranges alone."""
    cuts = np.unique(np.array([*sum(a, ()), *sum(b, ())]))
    middle, length = 0.5 * (cuts[1:] + cuts[:-1]), np.diff(cuts)
    inside = [
        np.any([(middle > p) & (middle < q) for p, q in of] or [middle != middle], axis=0) for of in (a, b)
    ]
    return length[inside[0] != inside[1]].sum()


def test_several_dampings_at_once():
    bicycle, delta = Bicycle.preset("dikarev1981"), [0.003, 0.3, 10.0]
    given = {"x": [0.1, 0.1, 0.3], "others": {"delta": np.array(delta)}}
    together = lowest_stable(Family(bicycle), 0.0, 0.15, **given)
    alone = [
        lowest_stable(Family(bicycle.with_delta(each)), 0.0, 0.15, x=lam)
        for each, lam in zip(delta, given["x"], strict=True)
    ]
    np.testing.assert_allclose(together, alone, rtol=1e-12)
    assert len(set(together)) == 3
