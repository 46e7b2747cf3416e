"""model.py and docs/theory.md against the derivation from first principles, term by term."""

from functools import cache
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings

from bikestab import letters as letters_module
from bikestab import model as model_module
from bikestab.bicycle import Bicycle
from bikestab.model import MODELS, characteristic_table, coefficients
from bikestab.speeds import CAPSIZE, UNBOUNDED, intervals_of
from tests import theory_page as page
from tests.references import derive_equations as derived
from tests.strategies import lams, machines, sigmas

BLOCKS = page.blocks()
PARAMETERS = {str(symbol): symbol for symbol in derived.PARAMETERS}
LETTERS = PARAMETERS | {"V": derived.V, "delta": derived.delta}
AB = {name: sp.Symbol(name) for name in model_module.Coefficients._fields}
s, V, c, delta = sp.Symbol("s"), derived.V, derived.c, derived.delta


# -- model.py ---------------------------------------------------------------------------------------------


@pytest.fixture
def symbols_for_numbers(monkeypatch):
    def number(value):
        return sp.nsimplify(np.asarray(value).item())

    monkeypatch.setattr(letters_module, "Twofold", number)
    monkeypatch.setattr(
        letters_module, "exact_sum", lambda a, b: letters_module.Twofold(a) + letters_module.Twofold(b)
    )
    monkeypatch.setattr(letters_module, "sine_cosine", lambda lam: (sp.sin(lam), sp.cos(lam)))


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.usefixtures("symbols_for_numbers")
def test_table_of_model_py(monkeypatch, model):
    """Its code, run with symbols for its letters: simplified as it is, the determinant of (1.5)."""
    bicycle = SimpleNamespace(**PARAMETERS, delta=delta)
    own = letters_module.letters_of(bicycle, derived.lam, derived.sigma, model)
    n = SimpleNamespace(**{name: sp.Symbol(name) for name in vars(own) if name != "p"}, p=SimpleNamespace())
    pitch = own.W - own.C2 * own.sin - own.S  # what the refinement adds to S
    n.missing = None if model == "refined" else n.h * sp.Symbol("pitch")
    more = 0 if model == "refined" else sp.Symbol("pitch")
    n.U, n.W = n.S - n.h * n.sin, n.S + more + n.C2 * n.sin
    assert derived.same(own.U, own.S - own.h * own.sin)
    assert derived.same(pitch, 0 if model == "refined" else own.missing / own.h)
    assert derived.same(letters_module.determinant(own), own.c**2 * (own.J1 * own.M22 - own.M12**2))
    monkeypatch.setattr(model_module, "letters_of", lambda *_: n)
    names = {AB[name]: value for name, value in coefficients(bicycle, 0, 0, model=model)._asdict().items()}
    found = model_module.entries_of(n)
    for k, j in np.ndindex(5, 4):
        entry = determinant().coeff(s, k).coeff(V, j).subs({c: n.c, delta: n.delta}).subs(names)
        assert sp.expand(found.get((k, j), sp.Integer(0)) - entry) == 0, (k, j)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.usefixtures("symbols_for_numbers")
def test_model_py_term_by_term(model):
    """The code of ``coefficients`` itself, run with symbols for numbers."""
    bicycle = SimpleNamespace(**PARAMETERS, delta=delta)
    found = coefficients(bicycle, derived.lam, derived.sigma, model=model)
    expected = derived.derive(model).coefficients
    assert expected["damping"] == c * delta
    for name in AB:
        assert derived.same(getattr(found, name), expected[name]), name


@pytest.mark.parametrize("model", MODELS)
@settings(deadline=None, max_examples=50, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas)
def test_numbers_of_model_py(model, machine, lam, sigma):
    """To 1e-13 of the summed absolute values of each coefficient's terms."""
    bicycle = Bicycle.from_mapping(machine)
    numbers = {name: value or 0.0 for name, value in bicycle.numbers().items()} | {"lam": lam, "sigma": sigma}
    with mpmath.workdps(
        30
    ):  # terms that cancel in the derivation's own form leave nothing of its last digits
        expected = in_numbers(model)(*(mpmath.mpf(numbers[name]) for name in PARAMETERS))
    for found, value in zip(coefficients(bicycle, lam, sigma, model=model), expected, strict=True):
        assert abs(found.value - value) <= 1e-13 * found.size + 1e-300  # products of tiny tilts underflow


@cache
def in_numbers(model):
    return sp.lambdify(
        derived.PARAMETERS, [derived.derive(model).coefficients[name] for name in AB], "mpmath"
    )


def test_models_differ_in_the_gravity_terms_by_the_pitch():
    refined, unrefined = (derived.derive(model).coefficients for model in MODELS)
    l = derived.m1 * derived.l1 + derived.m2 * derived.l2  # noqa: E741  # the paper's letter
    c1 = derived.sigma * c * sp.cos(derived.lam)
    more = derived.g * l * c1
    difference = {name: sp.expand(refined[name] - unrefined[name]) for name in refined}
    assert {name for name, value in difference.items() if value != 0} == {"a4", "b3", "b6"}
    assert derived.same(difference["a4"], more)
    assert derived.same(difference["b6"], more)
    assert derived.same(difference["b3"], more * sp.sin(derived.lam))


# -- docs/theory.md ---------------------------------------------------------------------------------------


def known():
    """What the formulas of the page may use."""
    names = {**LETTERS}
    for name in derived.COORDINATES:
        names |= {name: derived.Q[name], f"{name}_t": derived.QDOT[name], f"{name}_tt": derived.QDDOT[name]}
    return names | page.formulas(BLOCKS["definitions"], names)


def agrees(name, text):
    """Whether a block of the page says what the derivation does."""
    return all(CHECKS[name](text))


def check_definitions(text):
    """That its names are those of the other blocks, which use them."""
    names = {**LETTERS}
    own = known() | page.formulas(text, names)
    found = page.formulas(BLOCKS["coefficients"], own)
    yield from (derived.same(found[name], derived.derive().coefficients[name]) for name in AB)
    yield from check_lagrange(BLOCKS["lagrange"], own)


def check_pitch(text):
    yield derived.same(page.formulas(text, known())["phi"], derived.derive().pitch)


def check_positions(text):
    found = page.formulas(text, known())
    for i, part in enumerate(derived.placed(derived.derive().pitch), 1):
        for axis, expected, order in zip("xyz", part.centre, (1, 2, 2), strict=True):
            yield derived.same(found[f"{axis}{i}"], derived.cut(expected, order))


def check_energies(text):
    """T up to what has no part in Lagrange's equations, so these are compared."""
    found = page.formulas(text, known())
    yield derived.same(found["U"], derived.derive().potential - derived.g * sp.sympify(REST))
    T = found["T1"] + found["T2"]
    for name in ("x", "theta", "chi", "psi"):
        got = derived.lagrange(name, T, found["U"])
        yield derived.same(got, derived.derive().lagrange[name])


REST = derived.m1 * derived.h1 + derived.m2 * derived.h2  # potential energy upright, divided by g


def check_lagrange(text, names=None):
    found = page.formulas(text, names or known())
    yield len(found) == 4
    for name in ("x", "theta", "chi", "psi"):
        yield f"L_{name}" in found and derived.same(found[f"L_{name}"], derived.derive().lagrange[name])


def check_rolling(text):
    found = page.formulas(text, known())
    yield derived.same(found["x_t"], -V * derived.theta)
    yield derived.same(found["theta_t"], derived.derive().yaw_rate)


def check_coefficients(text):
    for model in MODELS:
        names = known()
        if model == "unrefined":
            names["S"] = names["m2"] * names["d"]
        found = page.formulas(text, names)
        yield set(found) == set(AB)
        yield from (derived.same(found[name], derived.derive(model).coefficients[name]) for name in AB)


def determinant():
    """Of the equations (1.5), for motion as exp(s t)."""
    n = SimpleNamespace(**AB)
    lean = n.a0 * s**2 - n.a1, -n.a2 * s**2 - n.a3 * V * s + n.a4 - n.a5 * V**2
    steer = (
        -n.b4 * s**2 + n.b5 * V * s + n.b6,
        n.b0 * s**2 + (n.b1 * V + c * delta) * s + n.b2 * V**2 - n.b3,
    )
    return sp.expand(lean[0] * steer[1] - lean[1] * steer[0])


def check_table(text):
    found = page.formulas(text, AB | LETTERS)
    for k in range(5):
        yield sp.expand(found[f"p{k}"] - determinant().coeff(s, k)) == 0


def check_alphas(text):
    """In the paper's b1 the damping is included."""
    found = page.formulas(text, AB | {"V": V})
    p = sp.Symbol("p")
    undamped = determinant().subs(delta, 0).subs(s, p * V)
    yield sp.expand(found["f"] * V**4 - undamped) == 0


def check_speeds(text):
    """The conditions without damping, as polynomials in V²."""
    found = page.formulas(text, AB | {"V": V})
    p0, p1, p2, p3, p4 = (determinant().subs(delta, 0).coeff(s, k) for k in range(5))
    hurwitz3 = p1 * (p2 * p3 - p4 * p1) - p0 * p3**2
    expected = {
        "f": p0.coeff(V, 2), "f0": p0.coeff(V, 0), "e": p1.coeff(V, 3), "e0": p1.coeff(V, 1),
        "q": p2.coeff(V, 2), "q0": p2.coeff(V, 0), "k": p3.coeff(V, 1), "p4": p4,
    }  # fmt: skip
    expected |= {f"w{n}": sp.expand(hurwitz3).coeff(V, 2 * n + 2) for n in range(3)}
    yield set(found) == set(expected)
    yield from (sp.expand(found[name] - value) == 0 for name, value in expected.items())


def check_capsize(text):
    """The refined model's p0 = f V² + f0."""
    found = page.formulas(text, known())
    n = SimpleNamespace(**derived.derive().coefficients)
    f, f0 = n.a5 * n.b6 - n.a1 * n.b2, n.a1 * n.b3 - n.a4 * n.b6
    yield derived.same(found["f"], f)
    yield derived.same(found["f0"], f0)
    yield derived.same(found["Vc**2"], -f0 / f)


def check_front(text):
    """The printed d is an identity exactly if the frame, of length L, ends on the steering axis."""
    lam, d, L, phi0, R, c1 = sp.symbols("lam d L phi0 R c1")
    found = page.formulas(text, {"lam": lam})
    printed = found["h2"] * sp.sin(lam) + (found["l2"] - c) * sp.cos(lam) - c1
    on_axis = L * sp.cos(phi0 + lam) + R * sp.sin(lam) - c * sp.cos(lam) - c1
    yield sp.simplify(sp.expand_trig(printed - d - on_axis)) == 0


def check_short(text):
    """What is left of the refined model's differences where terms cancel identically."""
    found = page.formulas(text, known())
    n = SimpleNamespace(**derived.derive().coefficients)
    expected = {
        "a3": n.a3, "b5": n.b5, "b1": n.b1, "k": n.a0 * n.b1 + n.a2 * n.b5 - n.a3 * n.b4, "e": n.a5 * n.b5,
        "e0": n.a3 * n.b6 - n.a1 * n.b1 - n.a4 * n.b5, "f": n.a5 * n.b6 - n.a1 * n.b2,
        "f0": n.a1 * n.b3 - n.a4 * n.b6,
    }  # fmt: skip
    yield set(found) == {*expected, "Q", "T", "U", "N"}
    yield from (derived.same(found[name], value) for name, value in expected.items())


CHECKS = {
    "definitions": check_definitions, "pitch": check_pitch, "positions": check_positions,
    "energies": check_energies, "lagrange": check_lagrange, "rolling": check_rolling,
    "coefficients": check_coefficients, "table": check_table, "alphas": check_alphas,
    "speeds": check_speeds, "capsize": check_capsize, "front": check_front, "short": check_short,
}  # fmt: skip


@pytest.mark.parametrize("name", CHECKS)
def test_page(name):
    assert agrees(name, BLOCKS[name])


def test_every_block_has_a_check():
    assert set(BLOCKS) == set(CHECKS)


@pytest.mark.parametrize(("scanned", "repaired"), page.errors())
def test_scanned_readings_fail(scanned, repaired):
    """Each repaired formula stands in a checked block, which the scanned reading makes wrong."""
    places = [name for name, text in BLOCKS.items() if repaired in text]
    assert places
    for name in places:
        assert not agrees(name, BLOCKS[name].replace(repaired, scanned))


# -- claims of docs/theory.md about speeds ------------------------------------------------------------------


@pytest.mark.parametrize("damping", [0, 1])
@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("preset", ["dikarev1981", "meijaard2007"])
def test_condition_for_no_upper_limit(preset, model, damping):
    """Section 9, at every one of 121 × 121 designs; damping has no part in it."""
    bicycle = Bicycle.preset(preset).with_delta(damping)
    lam, sigma = np.linspace(-0.2, 0.8, 121)[:, np.newaxis], np.linspace(-0.1, 0.5, 121)
    found = intervals_of(characteristic_table(bicycle, lam, sigma, model=model))
    n = coefficients(bicycle, lam, sigma, model=model)
    p4, e, f = n.a0 * n.b0 - n.a2 * n.b4, n.a5 * n.b5, n.a5 * n.b6 - n.a1 * n.b2
    k, q = n.a0 * n.b1 + n.a2 * n.b5 - n.a3 * n.b4, n.a0 * n.b2 + n.a3 * n.b5 - n.a5 * n.b4
    expected = np.all(np.broadcast_arrays(*(x.value > 0 for x in (p4, e, k, f, k * q - p4 * e))), axis=0)
    assert np.array_equal((found.upper == UNBOUNDED).any(axis=-1), expected)
    assert expected.any()


def test_capsize_speed_in_closed_form():
    """Section 8, refined model: c g S (S − h sin λ) / …, to the conditioning of its differences."""
    b = Bicycle.preset("meijaard2007").with_delta(0.5)
    lam, sigma = np.linspace(0, 0.8, 41)[:, np.newaxis], np.linspace(0, 0.3, 41)
    found = intervals_of(characteristic_table(b, lam, sigma))
    l, h = b.m1 * b.l1 + b.m2 * b.l2, b.m1 * b.h1 + b.m2 * b.h2  # noqa: E741  # the paper's letters
    K1, K2 = b.C1 / b.R1, b.C2 / b.R2
    c1 = sigma * b.c * np.cos(lam)
    d = b.h2 * np.sin(lam) + (b.l2 - b.c) * np.cos(lam) - c1
    S = b.m2 * d + l * c1 / b.c
    square = b.c * b.g * S * (S - h * np.sin(lam)) / np.cos(lam) / ((K1 + K2) * S - h * K2 * np.sin(lam))
    *cell, interval = np.nonzero(found.upper == CAPSIZE)
    assert len(interval) > 100
    assert found.V2[*cell, interval] ** 2 == pytest.approx(square[*cell], rel=1e-9)
