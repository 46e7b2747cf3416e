"""How a grid is cut: every point in one tile, every (λ, σ) in one tile that has its columns."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bikestab import yamltext
from bikestab.config.file import parse_config
from bikestab.fields import AXES, FIELDS
from bikestab.routh import CONDITIONS
from bikestab.scan.plan import _TILE_BYTES, Plan

ALL_FIELDS = "fields: [conditions, growth_rate, violated, stable]\n"


def plan_of(shape, more=""):
    n, m, k = shape
    text = (
        f"bicycle: dikarev1981\ngrid:\n  lam: {{start: 0, stop: 0.3, num: {n}}}\n"
        f"  sigma: {{start: 0, stop: 0.15, num: {m}}}\n  V: {{start: 0, stop: 15, num: {k}}}\n"
        f"output: out\n{more}"
    )
    return Plan(parse_config(yamltext.parse(text, "scan.yaml")))


SWEEP = "sweep: {delta: [0, 1, 5], m1: [70, 80]}\n"
SMALL = "sweep: {delta: [0, 1, 5], m1: {start: 70, stop: 80, num: 17}, h1: {start: 0.8, stop: 1, num: 31}}\n"
PLANS = {
    "one tile": plan_of((4, 5, 6)),
    "two of everything": plan_of((65, 129, 3000), ALL_FIELDS),
    "many speeds": plan_of((2, 2, 20_000), "fields: [stable]\n"),
    "many tilts": plan_of((700, 3, 5)),
    "a border in each": plan_of((70, 300, 333), ALL_FIELDS),
    "sweep": plan_of((70, 130, 40), SWEEP),
    "sweep of small grids": plan_of((4, 5, 6), SMALL),
    "sweep of grids of some chunks": plan_of((40, 50, 3), SMALL),
    "sweep of columns": plan_of((2, 2, 5000), ALL_FIELDS + SMALL),
}


@pytest.mark.parametrize("plan", PLANS.values(), ids=PLANS)
def test_tiles_cover_the_grid_exactly_once(plan):
    seen = np.zeros(plan.shape, np.int8)
    axes = [plan.config.grid.values(name) for name in AXES]
    for number in range(len(plan)):
        place, tile = plan.place(number), plan[number]
        seen[tuple(slice(i, i + n) for i, n in zip(place, tile.shape, strict=True))] += 1
        for values, axis, i in zip((tile.x, tile.y, tile.V), axes, place[-3:], strict=True):
            np.testing.assert_array_equal(values, axis[i : i + len(values)])
    assert seen.min() == seen.max() == 1
    assert seen.size == plan.points


@pytest.mark.parametrize("plan", PLANS.values(), ids=PLANS)
def test_places_are_at_borders_of_chunks(plan):
    assert plan.tile != plan.chunk or len(plan) == 1 or plan.lead
    for number in range(len(plan)):
        place = plan.place(number)
        assert all(i % n == 0 for i, n in zip(place, plan.chunk, strict=True))
        assert plan.cell(number) == place[-3:-1]
        assert all(type(i) is int for i in place)
    places = [plan.place(number) for number in range(len(plan))]
    assert places == sorted(set(places))


@pytest.mark.parametrize("plan", PLANS.values(), ids=PLANS)
def test_each_column_is_in_one_tile_that_has_it(plan):
    """And that is the tile of the lowest speeds; ``lowest`` finds these, row by row."""
    assert plan.members == int(np.prod(plan.lead))
    having = [number for number in range(len(plan)) if plan[number].lowest]
    if not plan.whole:
        found = [plan.lowest(member) for member in range(plan.members)]
        assert [number for numbers in found for number in numbers] == having
        for member, numbers in enumerate(found):
            assert {(*plan.members_of(number),) for number in numbers} == {(member,)}
    seen = np.zeros(plan.shape[:-1], int)
    for number in having:
        place, shape = plan.place(number), plan[number].shape
        seen[tuple(slice(i, i + n) for i, n in zip(place[:-1], shape[:-1], strict=True))] += 1
        assert place[-1] == 0
        assert plan[number].whole == plan.whole == (shape[-3:-1] == plan.config.grid.shape[:2])
    assert np.all(seen == 1)


@pytest.mark.parametrize("plan", PLANS.values(), ids=PLANS)
def test_a_tile_has_the_machines_of_its_place(plan):
    bicycles = [member.bicycle for member in plan.config.members]
    numbers = np.arange(plan.members).reshape(plan.lead)
    for number in range(len(plan)):
        tile, place = plan[number], plan.place(number)
        own = numbers[tuple(slice(i, i + n) for i, n in zip(place, tile.block, strict=False))]
        assert list(plan.members_of(number)) == own.ravel().tolist()
        if tile.swept:
            assert tile.family.bicycle == plan.config.machine
            assert {*tile.swept} == {*plan.config.sweep}
        for name in ("delta", "m1", "h1", "c"):
            expected = np.array([getattr(bicycles[i], name) for i in own.ravel()])
            machines = tile.swept.get(name, getattr(tile.family.bicycle, name))
            np.testing.assert_array_equal(np.ravel(machines) + 0 * expected, expected)


@pytest.mark.parametrize("plan", PLANS.values(), ids=PLANS)
def test_a_tile_knows_the_last_speed_of_the_one_before(plan):
    V = plan.config.grid.values("V")
    for number in range(len(plan)):
        k, tile = plan.place(number)[-1], plan[number]
        assert tile.above == (V[k - 1] if k else 0)


def test_small_grids_share_tiles_and_chunks():
    plan = PLANS["sweep of small grids"]
    assert plan.chunk == (1, 8, 31, 4, 5, 6)
    assert plan.tile == (1, 8, 31, 4, 5, 6)
    assert PLANS["sweep of grids of some chunks"].tile == (1, 1, 4, 40, 50, 3)
    columns = PLANS["sweep of columns"]
    assert (columns.chunk[:3], columns.tile[:3]) == ((1, 1, 1), (1, 1, 15))


def test_each_machine_of_a_sweep_has_its_own_tiles():
    plan = PLANS["sweep"]
    assert plan.lead == (3, 2)
    assert plan.shape == (3, 2, 70, 130, 40)
    assert len(plan) == 6 * 4
    for number in range(len(plan)):
        i, j = plan.place(number)[:2]
        bicycle = plan[number].family.bicycle
        assert (bicycle.delta, bicycle.m1) == ([0, 1, 5][i], [70, 80][j])


def test_fields_are_in_the_order_of_the_file():
    assert plan_of((2, 2, 2)).fields == ("stable", "violated", "growth_rate")
    assert plan_of((2, 2, 2), ALL_FIELDS).fields == ("stable", "violated", "growth_rate", *CONDITIONS)
    assert plan_of((2, 2, 2), "fields: [growth_rate]\n").fields == ("growth_rate",)
    assert set(FIELDS) >= {"stable", "violated", "growth_rate", *CONDITIONS}


# --- memory and time


def bytes_of(plan):
    """The largest tile's fields before compression."""
    sizes = [np.dtype(FIELDS[name].dtype).itemsize for name in plan.fields]
    return max(int(np.prod(plan[number].shape)) for number in (0, len(plan) - 1)) * sum(sizes)


@settings(deadline=None, max_examples=100, derandomize=True)
@given(
    shape=st.tuples(*(st.integers(2, 4000) for _ in range(3))),
    fields=st.sets(st.sampled_from(["stable", "violated", "growth_rate", "conditions"]), min_size=1),
)
def test_a_tile_is_no_larger_than_memory_bears(shape, fields):
    plan = plan_of(shape, f"fields: [{', '.join(sorted(fields))}]\n")
    assert bytes_of(plan) <= _TILE_BYTES
    assert all(n <= whole for n, whole in zip(plan.tile, shape, strict=True))
    assert all(
        n % chunk == 0 or n == whole for n, chunk, whole in zip(plan.tile, plan.chunk, shape, strict=True)
    )


def test_tiles_of_a_large_grid_are_not_small():
    """Else the calls would cost more than the numbers."""
    for more in ("fields: [stable]\n", ALL_FIELDS):
        plan = plan_of((500, 500, 3000), more)
        assert bytes_of(plan) > 0.5 * _TILE_BYTES


def test_seconds_grow_with_the_work():
    base = plan_of((50, 50, 100)).seconds()
    assert base > 0
    for shape in ((51, 50, 100), (50, 51, 100), (50, 50, 101)):
        assert plan_of(shape).seconds() > base
    assert plan_of((50, 50, 100), ALL_FIELDS).seconds() > base
    assert plan_of((50, 50, 100), "fields: [stable]\n").seconds() < base
    assert plan_of((50, 50, 100), SWEEP).seconds() == pytest.approx(6 * base)
    ensemble = "ensemble: {m1: {normal: [80, 8]}, samples: %d, seed: 1}\n"
    few, many = (plan_of((50, 50, 100), ensemble % n).seconds() for n in (10, 1000))
    assert base < few < many


def test_narrow_grids_have_long_tiles():
    """Every tile finds the roots of its columns anew."""
    assert len(plan_of((2, 2, 400_000), "fields: [stable, violated]\n")) == 1
