"""The mask from exact roots against the conditions evaluated at every point."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab.bicycle import Bicycle
from bikestab.critical import critical
from bikestab.model import characteristic_table, exact_table
from bikestab.routh import CONDITIONS, conditions, violated
from bikestab.scan.signs import ALL, NEAR, _runs, violated_between
from tests.onecell import table_of
from tests.strategies import lams, machines, sigmas

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
GRIDS = {
    "from rest": np.linspace(0, 15, 301),
    "not from rest": np.linspace(0.7, 12, 77),
    "two": np.array([0.0, 30.0]),
    "two, not from rest": np.array([3.0, 5.0]),
    "many": np.linspace(0, 60, 500),
    "uneven": np.concatenate([[0, 1e-6, 1e-3], np.geomspace(0.1, 1000, 40)]),
}
# A condition this small beside the sum of its terms' sizes has no sign: about 16 roundings on the way to it,
# and hurwitz3 as a polynomial drops coefficients below 64 ε of theirs.
NO_SIGN = 128 * np.finfo(float).eps


def box(bicycle, n=12, model="refined"):
    """The table (5, 4, cell) of the paper's box."""
    lam, sigma = np.linspace(0, 0.6, n), np.linspace(0, 0.3, n + 1)
    return characteristic_table(bicycle, lam[:, np.newaxis], sigma, model=model).reshape(5, 4, -1)


def both(table, V):
    """The mask by either way, and where a condition that is not zero to rounding has two signs."""
    V = np.asarray(V, float)
    runs, values = violated_between(table, critical(table), V), conditions(table[..., np.newaxis], V)
    rough = violated_between(table, critical(table, rough=True), V, rough=True)
    np.testing.assert_array_equal(rough, runs)
    points = violated(values)
    p0, p1, p2, p3, p4, _ = conditions(np.abs(table)[..., np.newaxis], V)
    sizes = [p0, p1, p2, p3, p4, p1 * (p2 * p3 + p4 * p1) + p0 * p3**2]
    wrong = np.zeros(runs.shape, bool)
    for bit, (value, size) in enumerate(zip(values, sizes, strict=True)):
        wrong |= (((runs ^ points) >> bit) & 1 == 1) & ~(np.abs(value) <= NO_SIGN * size)
    assert runs.dtype == np.uint8
    assert runs.shape == (table.shape[-1], len(V))
    return runs, points, wrong


@pytest.mark.parametrize("grid", GRIDS)
@pytest.mark.parametrize(
    ("bicycle", "model"),
    [
        (DIKAREV, "refined"),
        (DIKAREV, "unrefined"),
        (MEIJAARD, "refined"),
        (DIKAREV.with_delta(2.0), "refined"),
        (MEIJAARD.with_delta(0.1), "unrefined"),
        (Bicycle.preset("sharp1971"), "refined"),
        (Bicycle.preset("kooijman2011"), "refined"),
    ],
    ids=["1981", "1981 unrefined", "2007", "1981 damped", "2007 damped unrefined", "motorcycle", "skates"],
)
def test_every_point_has_the_same_mask(bicycle, model, grid):
    runs, points, _ = both(box(bicycle, model=model), GRIDS[grid])
    np.testing.assert_array_equal(runs, points)
    if len(GRIDS[grid]) > 2:
        assert len(np.unique(runs)) > 3


@settings(deadline=None, max_examples=80, derandomize=True)
@given(
    machine=machines,
    lam=st.lists(lams, min_size=2, max_size=4),
    sigma=sigmas,
    start=st.just(0.0) | st.floats(0, 5),
    step=st.floats(1e-3, 20),
    num=st.integers(2, 60),
)
def test_random_machines(machine, lam, sigma, start, step, num):
    table = characteristic_table(Bicycle.from_mapping(machine), np.array(lam), sigma)
    _, _, wrong = both(table, start + step * np.arange(num))
    assert not wrong.any()


def test_rough_speeds_are_as_near_as_they_say():
    for bicycle in (DIKAREV, MEIJAARD):
        table = box(bicycle, 40)
        fine, rough = critical(table).zeros, critical(table, rough=True).zeros
        for name in CONDITIONS:
            V, known = rough[name].V, rough[name].sure
            np.testing.assert_array_equal(np.isnan(V[:, known]), np.isnan(fine[name].V[:, known]))
            assert not np.any(
                np.abs(V - fine[name].V)[:, known] > (rough[name].radius + fine[name].radius)[:, known]
            )
            assert known.mean() > 0.99
            if len(V):
                assert np.nanmedian(rough[name].radius / V) < 1e-13


@settings(deadline=None, max_examples=60, derandomize=True)
@given(st.data())
def test_runs_are_what_their_steps_say(data):
    num, rows = data.draw(st.integers(1, 70)), data.draw(st.integers(1, 5))
    places = data.draw(st.lists(st.lists(st.integers(0, num), min_size=rows, max_size=rows), max_size=7))
    bits = [np.uint8(1 << data.draw(st.integers(0, 5))) for _ in places]
    first = np.arange(rows, dtype=np.uint8)
    steps = [np.array(place, np.intp) << 6 | bit for place, bit in zip(places, bits, strict=True)]
    expected = np.repeat(first[:, np.newaxis], num, axis=1)
    for place, bit in zip(places, bits, strict=True):
        for row, start in zip(expected, place, strict=True):
            row[start:] ^= bit
    np.testing.assert_array_equal(_runs(first, steps, num), expected)


# --- tiles, of which all but the lowest have rough speeds


def in_tiles(table, V, size):
    """The mask as tiles of so many speeds have it."""
    parts = []
    for i in range(0, len(V), size):
        outside = V[i - 1] if i else 0.0, V[i + size] if i + size < len(V) else np.inf
        exact = critical(table, rough=i > 0)
        parts.append(violated_between(table, exact, V[i : i + size], outside, rough=i > 0))
    return np.hstack(parts)


def folds(bicycle, lam):
    """Trails next to those at which two speeds of hurwitz3 meet, at various distances on both sides."""

    def number(sigma):
        found = critical(exact_table(bicycle, lam, sigma), ["hurwitz3"]).speeds["hurwitz3"]
        return np.isfinite(found).sum(axis=0)

    sigma = np.linspace(-0.3, 0.5, 400)
    counts = number(sigma)
    at = np.flatnonzero(np.abs(np.diff(counts)) == 2)
    low, high = sigma[at], sigma[at + 1]
    for _ in range(60):
        middle = (low + high) / 2
        same = number(middle) == counts[at]
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    away = 10.0 ** np.arange(-16, -9)
    away = np.concatenate([-away, [0], away])
    return np.unique(np.add.outer([*low, *high], away))


def assert_tiles_leave_no_trace(table):
    """Of one cell, at speeds around those where hurwitz3 has its zeros."""
    fine = critical(table)
    w = np.ravel(fine.speeds["hurwitz3"])
    w = w[np.isfinite(w)] if np.isfinite(w).any() else [5.0]
    for centre, step in product((np.mean(w), w[0]), (1e-7, 1e-9, 1e-11, 2.0**-52)):
        V = centre * (1 + step * np.arange(-150, 151))
        np.testing.assert_array_equal(in_tiles(table, V, 80), violated_between(table, fine, V))


def test_a_pair_that_double_precision_cannot_tell_is_there_in_every_tile():
    """Between two zeros of hurwitz3 that are 1.5e-7 of their speed apart it holds, but next to a zero."""
    table = exact_table(DIKAREV, 0.2, [0.019139067260335877])
    one, other = np.ravel(critical(table).speeds["hurwitz3"])
    assert 1e-7 < other / one - 1 < 5e-7
    V = np.linspace(one * (1 - 1e-7), other * (1 + 1e-7), 50_001)
    bit = in_tiles(table, V, 8192)[0] >> 5 & 1
    inside = np.clip(V, one, other) == V
    assert np.count_nonzero((bit == 1) == inside) <= 2
    assert_tiles_leave_no_trace(table)


def test_tiles_next_to_a_fold():
    """Of sure zeros rough ones are elsewhere, and tiles end beside zeros."""
    for sigma in folds(DIKAREV, 0.2):
        assert_tiles_leave_no_trace(exact_table(DIKAREV, 0.2, [sigma]))


@settings(deadline=None, max_examples=4, derandomize=True)
@given(machine=machines, lam=lams, delta=st.sampled_from([0.0, 0.0, 1.0]))
def test_tiles_next_to_folds(machine, lam, delta):
    bicycle = Bicycle.from_mapping(machine).with_delta(delta)
    for sigma in folds(bicycle, lam)[::19]:
        assert_tiles_leave_no_trace(exact_table(bicycle, lam, [sigma]))


# --- speeds at and around the roots


@pytest.mark.parametrize("bicycle", [DIKAREV, MEIJAARD.with_delta(1.0)], ids=["1981", "2007 damped"])
@pytest.mark.parametrize("shift", [0, 1e-15, -1e-15, 1e-12, -1e-12, 0.9 * NEAR, -1.1 * NEAR, 1e-7])
def test_speeds_on_roots(bicycle, shift):
    """At a root of one cell, and as close to it as rounding can tell; the others' are far away."""
    table = box(bicycle, 5)
    roots = [root for speeds in critical(table).speeds.values() for root in speeds.ravel()]
    V = np.unique(np.array([root for root in roots if root < 50]) * (1 + shift))
    assert len(V) > 50
    for some in (V, np.concatenate([[0.0], V])):
        runs, points, _ = both(table, some)
        np.testing.assert_array_equal(runs, points)


def test_several_roots_between_two_neighbouring_speeds():
    """p4 has one, p3 two and p0 three between 1 and 4; hurwitz3 has its own."""
    table = table_of(p0=[-6.6, 12.11, -6.6, 1.1], p3=[7.25, -5.0, 0.85], p4=[-2.5, 1.0])
    roots = critical(table).speeds
    assert [len(roots[name]) for name in ("p0", "p3", "p4")] == [3, 2, 1]
    assert np.all((roots["p3"] > 1) & (roots["p3"] < 4))
    for V in ([1.0, 4.0], [0.0, 1.0, 4.0, 9.0], [0.0, 9.0], np.linspace(0, 9, 400)):
        runs, points, _ = both(table, V)
        np.testing.assert_array_equal(runs, points)
    assert len(np.unique(both(table, np.linspace(0, 9, 400))[0])) >= 6


def test_a_pair_between_two_neighbouring_speeds_leaves_the_mask_as_it_was():
    table = table_of(p2=[6.25 - 1e-6, -5.0, 1.0])  # zero at 2.5 ± 0.001
    runs, points, _ = both(table, [2.0, 3.0, 4.0])
    np.testing.assert_array_equal(runs, points)
    assert not (runs >> CONDITIONS.index("p2") & 1).any()


def test_a_double_root_changes_nothing_even_on_a_speed():
    """p2 = (V − 2)² is no critical speed. At 2 it is zero, which the points call violated: it has no sign."""
    table = table_of(p2=[4.0, -4.0, 1.0])
    runs, points, wrong = both(table, [0.0, 1.0, 2.0, 3.0])
    assert (runs >> 2 & 1).tolist() == [[0, 0, 0, 0]]
    assert (points >> 2 & 1).tolist() == [[0, 0, 1, 0]]
    assert not wrong.any()


def test_where_two_roots_have_nearly_met_the_ways_differ_by_rounding_only():
    """p0 = (V − 2)² − ε²: within a few 1e-8 m/s of 2 its sign is rounding."""
    V = 2 + np.arange(-40, 41) * 1e-9
    for width in (0, 1e-9, 1e-8, 3e-8):
        assert not both(table_of(p0=[4 - width**2, -4.0, 1.0]), V)[2].any()
    far = both(table_of(p0=[4 - 1e-6, -4.0, 1.0]), V)
    np.testing.assert_array_equal(far[0], far[1])


# --- conditions that are nothing


def test_what_is_no_number_is_violated():
    table = box(DIKAREV, 3)
    table[..., 4] = np.nan
    for V in ([0.0, 5.0, 9.0], [1.0, 2.0]):
        runs, points, _ = both(table, V)
        np.testing.assert_array_equal(runs, points)
        assert np.all(runs[4] == ALL)


@pytest.mark.parametrize("name", CONDITIONS[:-1])
def test_a_condition_that_is_zero_everywhere_is_violated(name):
    runs, points, _ = both(table_of(**{name: [0.0]}), [0.0, 1.0, 50.0])
    np.testing.assert_array_equal(runs, points)
    assert np.all(runs >> CONDITIONS.index(name) & 1)


def test_hurwitz3_that_cancels_exactly():
    """(s² + a²)(s² + k V s + b²) in numbers without rounding: zero at every speed."""
    a2, b2, k = 0.625, 2.5, 1.75
    table = np.zeros((5, 4, 1))
    table[4, 0], table[3, 1], table[2, 0], table[1, 1], table[0, 0] = 1, k, a2 + b2, a2 * k, a2 * b2
    runs, _, wrong = both(table, np.linspace(0, 20, 200))
    assert not wrong.any()
    assert np.all(runs >> CONDITIONS.index("hurwitz3") & 1)


def test_a_cell_does_not_depend_on_its_company():
    table, V = box(DIKAREV.with_delta(0.5), 6), GRIDS["from rest"]
    whole = violated_between(table, critical(table), V)
    for cell in (0, 17, table.shape[-1] - 1):
        alone = table[..., cell : cell + 1]
        np.testing.assert_array_equal(violated_between(alone, critical(alone), V)[0], whole[cell])
