"""Families of designs: any two parameters vary, and what is found in them agrees with one machine."""

import numpy as np
import pytest

from bikestab.bicycle import PAPER, Bicycle
from bikestab.errors import InputError
from bikestab.family import Family
from bikestab.model import characteristic_table, exact_table
from bikestab.region.curves import trace
from bikestab.region.lines import stable_ranges
from bikestab.speeds import intervals_of
from bikestab.variants import FRONT, own_value

DIKAREV, MEIJAARD = Bicycle.preset("dikarev1981"), Bicycle.preset("meijaard2007")
OWN = DIKAREV.replaced({"lam": 0.3, "sigma": 0.1})
# family, box: those of the acceptance, and some of each kind of parameter
FAMILIES = {
    "lam delta": (Family(MEIJAARD, x="lam", y="delta"), (0.1, 0.5), (0.0, 3.0)),
    "mB xB": (Family(MEIJAARD, x="mB", y="xB"), (40.0, 140.0), (0.0, 0.8)),
    "head_angle trail": (Family(MEIJAARD, x="head_angle", y="trail"), (1.1, 1.5), (0.0, 0.2)),
    "w zB": (Family(MEIJAARD, x="w", y="zB"), (0.8, 1.4), (-1.2, -0.4)),
    "h1 trail": (Family(OWN, x="h1", y="trail"), (0.5, 1.3), (0.0, 0.2)),
    "R m2 unrefined": (Family(OWN, "unrefined", "R", "m2"), (0.2, 0.6), (1.0, 9.0)),
    "m1 of 25": (Family(MEIJAARD, x="m1", y="lam"), (50.0, 150.0), (0.1, 0.5)),
}
each_family = pytest.mark.parametrize(("family", "x", "y"), FAMILIES.values(), ids=FAMILIES)


def one(family, x, y):
    """The machine and its own design, by the checks and reductions of single machines."""
    values = {family.x: x, family.y: y}
    bicycle = family.bicycle
    if "head_angle" in values:
        values["lam"] = np.pi / 2 - values.pop("head_angle")
    if bicycle.bodies is not None:
        if "trail" in values:
            values["c"] = values.pop("trail")
        if "m1" in values:
            lam = values.get("lam", bicycle.lam)
            return Bicycle.from_mapping({**bicycle.numbers(), "m1": values["m1"], "lam": lam})
    elif "trail" in values:
        values["sigma"] = values.pop("trail") / bicycle.c
    return bicycle.replaced(values)


@each_family
def test_tables_are_those_of_single_machines(family, x, y):
    rng = np.random.default_rng(1)
    X, Y = rng.uniform(*x, 20), rng.uniform(*y, 20)
    tables = family.table(X, Y)
    assert tables.shape == (5, 4, 20)
    for i in range(20):
        machine = one(family, X[i], Y[i])
        expected = exact_table(machine, machine.lam, machine.sigma, model=family.model).value
        np.testing.assert_allclose(tables[..., i], expected, rtol=1e-12, atol=1e-13 * np.abs(expected).max())
        quick = family.quick_table(X[i], Y[i])
        np.testing.assert_allclose(quick, expected, rtol=1e-12, atol=1e-13 * np.abs(expected).max())
        lam, sigma, found = family.geometry(X[i], Y[i])
        assert (lam, sigma, found.c) == pytest.approx((machine.lam, machine.sigma, machine.c), rel=1e-14)
    np.testing.assert_array_equal(family.table(X[:, None], Y[:3]).shape, (5, 4, 20, 3))
    np.testing.assert_array_equal(family.table(X[:, None], Y)[:, :, np.arange(20), np.arange(20)], tables)


def test_tilt_and_trail_are_those_of_the_model_itself():
    lam, sigma = np.linspace(0, 0.5, 7)[:, None], np.linspace(0, 0.3, 5)
    for bicycle, model in ((DIKAREV, "refined"), (MEIJAARD, "unrefined")):
        family = Family(bicycle, model)
        expected = exact_table(bicycle, lam, sigma, model=model).value
        np.testing.assert_array_equal(family.table(lam, sigma), expected)
        expected = characteristic_table(bicycle, lam, sigma, model=model)
        np.testing.assert_array_equal(family.quick_table(lam, sigma), expected)


@each_family
def test_ranges_along_lines_agree_with_dense_random_designs(family, x, y):
    rng = np.random.default_rng(2)
    lines, each = 40, 2500
    for runs, ends, fixed in (("y", y, rng.uniform(*x, lines)), ("x", x, rng.uniform(*y, lines))):
        values = rng.uniform(*ends, (lines, each))
        ranges = stable_ranges(family, *ends, **{"x" if runs == "y" else "y": fixed})
        inside = np.array(
            [
                np.any([(row > a) & (row < b) for a, b in found] or [row != row], axis=0)
                for row, found in zip(values, ranges, strict=True)
            ]
        )
        design = (fixed[:, None], values) if runs == "y" else (values, fixed[:, None])
        np.testing.assert_array_equal(intervals_of(family.table(*design)).number > 0, inside)


@pytest.mark.parametrize("name", ["lam delta", "mB xB", "head_angle trail"])
def test_traced_curves_part_dense_random_designs(name):
    """Along lines the number of intervals and the kinds of ends change only where a traced curve crosses."""
    family, x, y = FAMILIES[name]
    curves = trace(family, x, y, samples=201)
    assert curves
    rng = np.random.default_rng(3)
    lines = np.sort(rng.uniform(*x, 12))
    values = np.sort(rng.uniform(*y, (12, 10_000)), axis=1)
    found = intervals_of(family.table(lines[:, None], values))
    same = np.all([np.all(a[:, 1:] == a[:, :-1], axis=-1) for a in (found.lower, found.upper)], axis=0)
    for i, at in enumerate(lines):
        crossed = np.concatenate([_crossed(curve, at) for curve in curves])
        change = np.flatnonzero(~same[i])
        near = np.abs(0.5 * (values[i, change] + values[i, change + 1])[:, None] - crossed)
        # chords of the curves, and the step between two neighbours
        assert np.all(near.min(axis=1, initial=np.inf) < 2e-3 * (y[1] - y[0])), (at, values[i, change])


def _crossed(curve, at):
    i = np.flatnonzero((curve.x[:-1] - at) * (curve.x[1:] - at) <= 0)
    t = (at - curve.x[i]) / np.where(curve.x[i + 1] == curve.x[i], 1, curve.x[i + 1] - curve.x[i])
    return curve.y[i] + t * (curve.y[i + 1] - curve.y[i])


def test_own_values():
    assert Family(MEIJAARD, x="mB", y="trail").own == (85.0, pytest.approx(0.08))
    assert Family(MEIJAARD, x="head_angle", y="m1").own == (pytest.approx(np.radians(72)), 87.0)
    assert Family(OWN, x="R", y="delta").own == (0.35, 0.0)
    assert Family(DIKAREV).own == (None, None)


def test_what_parameters_are_called():
    x, y = Family(MEIJAARD, x="lam", y="c").parameters
    assert (x.name, x.symbol, x.unit) == ("lam", "λ", "rad")
    assert (y.name, y.symbol, y.unit, y.meaning) == ("c", "c", "m", "trail along the ground")
    assert Family(OWN, x="c", y="lam").parameters[0].meaning == "wheelbase"


@pytest.mark.parametrize(
    ("bicycle", "x", "y", "key", "words"),
    [
        (MEIJAARD, "lam", "mb", "y", "no parameter 'mb'\ndid you mean 'mB'?"),
        (DIKAREV, "mB", "sigma", "x", "no parameter 'mB'\nknown: c, m1"),
        (MEIJAARD, "lam", "head_angle", "y", "lam and head_angle are one parameter"),
        (MEIJAARD, "c", "trail", "y", "c and trail are one parameter"),
        (OWN, "R", "R2", "y", "R and R2 are one parameter"),
        (DIKAREV, "delta", "sigma", "lam", "has no lam of its own"),
        (DIKAREV, "delta", "lam", "sigma", "has no sigma of its own"),
    ],
)
def test_what_is_no_family(bicycle, x, y, key, words):
    with pytest.raises(InputError) as error:
        Family(bicycle, x=x, y=y)
    assert error.value.key == (key,)
    assert words in str(error.value)


@pytest.mark.parametrize(
    ("family", "x", "y", "key"),
    [
        (Family(MEIJAARD), 1.6, 0.1, "lam"),
        (Family(MEIJAARD, x="head_angle", y="trail"), 0.0, 0.1, "head_angle"),
        (Family(MEIJAARD, x="head_angle", y="trail"), 1.2, 1e3, "trail"),
        (Family(MEIJAARD, x="mB", y="xB"), -1.0, 0.3, "mB"),
        (Family(MEIJAARD, x="m1", y="xB"), -1.0, 0.3, "m1"),
        (Family(OWN, x="A1", y="D1"), 1.0, 1e3, "D1"),
    ],
)
def test_values_that_no_machine_has(family, x, y, key):
    with pytest.raises(InputError) as error:
        family.check(x, y)
    assert error.value.key == (key,)


def test_any_two_of_the_25_broadcast_in_either_order():
    """A table over rows of one parameter and columns of another is that of their pairs."""
    names = ["w", "lam", "rR", "mR", "IRxx", "xB", "zB", "mB", "IBxx", "IBxz", "mH", "IHzz", "rF", "IFyy"]
    for x in names:
        for y in names:
            if x == y:
                continue
            family = Family(MEIJAARD, x=x, y=y)
            X, Y = (
                MEIJAARD.bodies[name] * np.array(factors)
                for name, factors in ((x, [1, 1.01]), (y, [1, 1.02, 1.04]))
            )
            table = family.exact_table(X[:, np.newaxis], Y).value
            pairs = family.exact_table(np.repeat(X, 3), np.tile(Y, 2)).value
            np.testing.assert_array_equal(table.reshape(5, 4, -1), pairs, err_msg=f"{x} {y}")


def test_whatever_is_offered_can_be_used():
    """Each name, alone and with another, at the bicycle's own value or one beside it."""
    for bicycle in (OWN, MEIJAARD):
        for name in {**PAPER, **bicycle.notation, **FRONT}:
            own = own_value(bicycle, name)
            x = 0.33 if own is None else own
            for other in ("g", "delta"):
                if name != other:
                    Family(bicycle, x=name, y=other).check(x, 1.0)
                    Family(bicycle, x=other, y=name).check(1.0, x)


def test_one_radius_of_both_wheels_of_25_numbers():
    family = Family(MEIJAARD, x="R", y="mB")
    family.check(0.34, 90.0)
    numbers = MEIJAARD.replaced({"mB": 90.0}).numbers()
    machine = Bicycle.from_mapping({**numbers, "R1": 0.34, "R2": 0.34})
    expected = exact_table(machine, MEIJAARD.lam, MEIJAARD.sigma).value
    np.testing.assert_allclose(
        family.table(0.34, 90.0), expected, rtol=1e-12, atol=1e-13 * np.abs(expected).max()
    )
    with pytest.raises(InputError, match="R"):
        family.check(-0.34, 90.0)
