"""Growth rate and eigenvalues against 60-digit roots of the same coefficients."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from bikestab.bicycle import Bicycle
from bikestab.model import characteristic_table
from bikestab.routh import coefficients_at
from bikestab.spectrum import eigenvalues_of, growth_rate_of, quadratics
from bikestab.stability import eigenvalues
from tests.references.generate_speeds import roots
from tests.references.measure_coalescences import errors
from tests.strategies import lams, machines, sigmas, speeds

EPS = np.finfo(float).eps
# What the eigenvalues may be: exact for coefficients wrong by 128 ε ρ^(4−k), ρ the largest eigenvalue; a
# k-fold eigenvalue so moves by some (128 ε)^(1/k) ρ. A matrix's eigenvalues are no better.
BACKWARD = 128 * EPS
ROOT_EPS = EPS**0.5  # of the largest eigenvalue: how right each is where two meet, or two pairs
COALESCENCE = 0.68428307889246  # m/s, where two real eigenvalues of the benchmark bicycle meet


def table_of(coefficients):
    """A table whose polynomial is p0 + p1 s + … at every speed."""
    p = np.asarray(coefficients, float)
    table = np.zeros((5, 4, *p.shape[1:]))
    table[:, 0] = p
    return table


def coefficients_of(*roots_):
    """The double coefficients nearest to ∏ (s − root)."""
    p = [mpf(1)]
    for root in roots_:
        p = [low - root * high for low, high in zip([0, *p], [*p, 0], strict=True)]
    return [float(mp.re(x)) for x in p]


def exact_growth(p):
    """The largest real part in 60 digits, and how far rounding of size BACKWARD may move it."""
    with mp.workdps(60):
        p = [mpf(float(x)) for x in p]
        s = roots(p)
        right = max(s, key=mp.re)
        return mp.re(right), float(sensitivity(p, right, max(abs(x) for x in s)))


def sensitivity(p, s, largest):
    """How near to s a root stays: |Δs| ≤ (binom(4, k) |Δp| k!/|dᵏp/dsᵏ|)^(1/k) for every k."""
    bounds = []
    for k in range(1, 5):
        p = [j * x for j, x in enumerate(p)][1:]
        slope = abs(sum(x * s**j for j, x in enumerate(p)))
        if slope:
            moved = mp.binomial(4, k) * BACKWARD * largest**4 * mp.factorial(k) / slope
            bounds.append(moved ** (mpf(1) / k))
    return min(bounds)


def backward_error(p, s):
    """The largest error of the coefficients of ∏ (s − sₖ), in units of ρ^(4−k)."""
    with mp.workdps(60):
        largest = max(abs(complex(x)) for x in s) or 1.0
        product = [mpf(1)]
        for root in s:
            root = mp.mpc(complex(root))
            product = [low - root * high for low, high in zip([0, *product], [*product, 0], strict=True)]
        return max(
            float(abs(x - mpf(float(y)) / mpf(float(p[4]))) / mpf(largest) ** (4 - k))
            for k, (x, y) in enumerate(zip(product, p, strict=True))
        )


def forward_error(p, s):
    """The largest distance between an eigenvalue and its nearest in 60 digits, by the largest one's size."""
    with mp.workdps(60):
        exact = roots([mpf(float(x)) for x in p])
        distance = np.array([[float(abs(mp.mpc(complex(x)) - y)) for y in exact] for x in s])
        largest = float(max(abs(y) for y in exact)) or 1.0
    return max(distance.min(axis=0).max(), distance.min(axis=1).max()) / largest


def check(p):
    """Everything that is promised of one polynomial."""
    growth, s = float(growth_rate_of(table_of(p), 0.0)), eigenvalues_of(table_of(p), 0.0)
    expected, tolerance = exact_growth(p)
    assert abs(growth - expected) <= tolerance
    assert backward_error(p, s) <= BACKWARD
    # −half + root, and q divided by the other eigenvalue, are rounded once or twice each
    assert growth == pytest.approx(s.real.max(), abs=2 * EPS * np.abs(s).max())


@pytest.mark.parametrize("kind", ["two real", "two imaginary", "pair and real", "two pairs"])
def test_where_two_meet(kind):
    """√ε of the largest eigenvalue, whose distance from another is 1e-16 … 1e-2 of it."""
    rng = np.random.default_rng(3)
    for _ in range(40):
        x, y, z = rng.uniform(0.2, 1, 3) * rng.choice([-1, 1], 3)
        near = 10 ** rng.uniform(-16, -2)
        third, fourth = (x + 1.3, x - 1.7) if rng.random() < 0.5 else (complex(z, y), complex(z, -y))
        s = {
            "two real": (x, x * (1 + near), third, fourth),
            "two imaginary": (complex(x, near), complex(x, -near), third, fourth),
            "pair and real": (complex(x, near), complex(x, -near), x + 0.7, x - 0.4),
            "two pairs": (
                complex(x, y),
                complex(x, -y),
                complex(x + near, y + near),
                complex(x + near, -y - near),
            ),
        }[kind]
        p = coefficients_of(*(mp.mpmathify(each) for each in s))
        assert forward_error(p, eigenvalues_of(table_of(p), 0.0)) <= ROOT_EPS


DEGENERATE = {
    "two equal imaginary pairs": (1j, -1j, 1j, -1j),
    "two equal complex pairs": (-1 + 2j, -1 - 2j, -1 + 2j, -1 - 2j),
    "two pairs, same real part": (-1 + 2j, -1 - 2j, -1 + 3j, -1 - 3j),
    "two pairs, same size": (3 + 4j, 3 - 4j, 4 + 3j, 4 - 3j),
    "double and complex pair": (-1, -1, -1 + 1j, -1 - 1j),
    "two doubles": (1, 1, -2, -2),
    "triple": (-1, -1, -1, 2),
    "triple to the right": (3, 3, 3, 2),
    "quadruple": (-1, -1, -1, -1),
    "quadruple at zero": (0, 0, 0, 0),
    "triple at zero": (0, 0, 0, -1),
    "double at zero": (0, 0, 1j, -1j),
    "one zero": (0, -1, -2, -3),
    "biquadratic, imaginary": (2j, -2j, 3j, -3j),
    "biquadratic, real": (1, -1, 2, -2),
    "biquadratic, mixed": (1, -1, 2j, -2j),
    "fourth roots": (1 + 1j, 1 - 1j, -1 + 1j, -1 - 1j),
    "spread": (1e6, -1e-6, 1, -1e3),
    "one large": (-1e8, -1, 1e-8, 1e-4),
    "one large, triple": (-1e6, 1e-6, 1e-6, 1e-6),
    "one small, triple": (-1e6, -1e6, -1e6, 1e-6),
    "large and small pair": (1e6 + 1e6j, 1e6 - 1e6j, 1e-6j, -1e-6j),
}


@pytest.mark.parametrize("scale", [1, 1e6, 1e-6])
@pytest.mark.parametrize("name", DEGENERATE)
def test_degenerate_eigenvalues(name, scale):
    check(coefficients_of(*(mp.mpmathify(s) * scale for s in DEGENERATE[name])))


@pytest.mark.parametrize(
    "p",
    [
        [15.99975483665401, 0.2843426103809026, 8.001202035077455, 0.07108621962589994, 1.0],
        [3.0475781266696856e19, 402560.18884464103, 11040974824.11709, 7.292113152595671e-05, 1.0],
        [5.633508305301127e-14, 3.7976019672115285e-12, 4.74764255118622e-07, 1.5999999689246694e-05, 1.0],
    ],
)
def test_two_pairs_nearly_equal(p):
    """Pairs 1e-4 … 1e-8 of their size apart: one Newton step from the closed formulas is not enough."""
    check(p)


@st.composite
def nearly_degenerate(draw):
    """Two real or complex pairs of eigenvalues, some of them nearly equal, of very different sizes."""
    size = st.builds(lambda sign, power: sign * 10.0**power, st.sampled_from([-1, 1]), st.floats(-3, 3))
    near = st.builds(lambda power, x: 1 + 10.0**power * x, st.floats(-16, -1), st.floats(-1, 1))
    s = draw(size)
    if draw(st.booleans()):
        s = complex(s, draw(size))
        other = s * complex(draw(near), draw(near) - 1) if draw(st.booleans()) else complex(draw(size), 1)
        return [s, s.conjugate(), other, other.conjugate()]
    return [s, *(s * draw(near) if draw(st.booleans()) else draw(size) for _ in range(3))]


@settings(deadline=None, max_examples=120, derandomize=True)
@given(s=nearly_degenerate(), scale=st.sampled_from([1, 1e6, 1e-6]))
def test_nearly_degenerate_eigenvalues(s, scale):
    check(coefficients_of(*(mp.mpmathify(x) * scale for x in s)))


@settings(deadline=None, max_examples=40, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas, some=st.lists(speeds, min_size=4, max_size=4))
def test_random_machines(machine, lam, sigma, some):
    """To 1e-9 s⁻¹, save where eigenvalues so nearly meet that rounding the coefficients moves them more."""
    table = characteristic_table(Bicycle.from_mapping(machine), lam, sigma)
    V = np.array([*some, 0.0, 1e-3, 1e3])
    got, p = growth_rate_of(table[..., np.newaxis], V), np.array(coefficients_at(table[..., np.newaxis], V))
    for growth, coefficients in zip(got, p.T, strict=True):
        expected, tolerance = exact_growth(coefficients)
        assert abs(growth - expected) <= max(1e-9, tolerance)


@pytest.mark.parametrize("preset", ["dikarev1981", "meijaard2007", "sharp1971"])
def test_presets_to_1e_9_per_second(preset):
    table = characteristic_table(Bicycle.preset(preset), 0.3, 0.1)[..., np.newaxis]
    V = np.linspace(0, 50, 41)
    s, p = eigenvalues_of(table, V), np.array(coefficients_at(table, V))
    for i in range(len(V)):
        with mp.workdps(40):
            exact = [complex(x) for x in roots([mpf(x) for x in p[:, i]])]
        distance = np.abs(s[:, i, np.newaxis] - exact)
        assert distance.min(axis=0).max() < 1e-9
        assert distance.min(axis=1).max() < 1e-9
        assert abs(growth_rate_of(table, V)[i] - max(x.real for x in exact)) < 1e-9


@pytest.mark.parametrize("k", range(3, 17))
@pytest.mark.parametrize("side", [-1, 1])
def test_coalescence(side, k):
    """Two eigenvalues that meet move by the root of the coefficients' rounding; never by more."""
    own = Bicycle.preset("meijaard2007")
    table, V = characteristic_table(own, own.lam, own.sigma), COALESCENCE + side * 10.0**-k
    p = np.array(coefficients_at(table, V))
    expected, tolerance = exact_growth(p)
    assert abs(growth_rate_of(table, V) - expected) <= tolerance
    if k <= 7:
        assert abs(growth_rate_of(table, V) - expected) < 1e-9
    assert tolerance < 1e-5  # the bound says something: √(128 ε) times the largest eigenvalue


def test_machines_where_two_meet():
    """A sample of python -m tests.references.measure_coalescences 500 20."""
    assert errors(25, 6, seed=2).max() <= ROOT_EPS


def test_two_equal_to_seven_digits():
    """The doubles nearest to this design's table already move 41.620528824 to 41.620513631."""
    found = eigenvalues(Bicycle.preset("kooijman2011"), 8.553124125507454, "5deg", 0.15)
    assert found.real.max() == pytest.approx(41.620528824, rel=0, abs=1e-9)


def test_leading_coefficient_zero():
    """An eigenvalue is infinite then; the neighbours are not affected."""
    p = np.array([[1, 2, 3, 4, 0], [0, 0, 0, 0, 0], [2, 0, 3, 0, 1]], float).T
    assert growth_rate_of(table_of(p), 0.0).tolist() == [np.inf, np.inf, 0.0]


def test_eigenvalue_zero_is_exact():
    """p0 = 0 and the rest to the left: the growth rate is zero, not its rounding."""
    assert growth_rate_of(table_of(coefficients_of(0, -1, -2, -3)), 0.0) == 0


@settings(deadline=None, max_examples=50, derandomize=True)
@given(machine=machines, lam=lams, sigma=sigmas)
def test_factors_multiply_to_the_polynomial(machine, lam, sigma):
    table = characteristic_table(Bicycle.from_mapping(machine), lam, sigma)[..., np.newaxis]
    V = np.linspace(0, 50, 26)
    p0, p1, p2, p3, p4 = coefficients_at(table, V)
    (half, _, q), (other_half, _, t) = quadratics(table, V)
    p, r = 2 * half, 2 * other_half
    size = np.abs(eigenvalues_of(table, V)).max(axis=0)
    for k, got, expected in ((3, p + r, p3), (2, q + t + p * r, p2), (1, p * t + q * r, p1), (0, q * t, p0)):
        assert np.all(np.abs(got - expected / p4) <= BACKWARD * size ** (4 - k))


def test_shapes_broadcast_and_vectorised_equals_scalar():
    bicycle = Bicycle.preset("dikarev1981")
    lam, sigma, V = np.linspace(0, 0.6, 3)[:, np.newaxis], np.linspace(0, 0.3, 4), np.linspace(0, 9, 5)
    table = characteristic_table(bicycle, lam, sigma)
    growth, s = growth_rate_of(table[..., np.newaxis], V), eigenvalues_of(table[..., np.newaxis], V)
    assert growth.shape == (3, 4, 5)
    assert s.shape == (4, 3, 4, 5)
    for i, j, k in np.ndindex(3, 4, 5):
        one = characteristic_table(bicycle, lam[i, 0], sigma[j])
        assert np.shape(growth_rate_of(one, V[k])) == ()
        assert growth_rate_of(one, V[k]).tobytes() == growth[i, j, k].tobytes()


def test_no_points():
    assert growth_rate_of(np.zeros((5, 4, 0)), 1.0).shape == (0,)
