"""Numbers of 79 bits, and conditions formed of them and of pairs of doubles, against fractions."""

from fractions import Fraction

import numpy as np
import pytest

from bikestab.corrected import hurwitz3_at, hurwitz3_near, p1_at, p1_near
from bikestab.entries import DAMPED, EVEN, Entries
from bikestab.halved import halved, halved_double, product, square
from bikestab.rounding import COEFFICIENT, CONDITION_AT
from bikestab.twofold import Twofold, pair_difference, pair_sum

UNIT = Fraction(1, 2**79)
RNG = np.random.default_rng(5)


def numbers(n):
    """Pairs of doubles of either sign and of sizes between 2^−20 and 2^20."""
    a = RNG.uniform(-1, 1, n) * 2.0 ** RNG.integers(-20, 21, n)
    return a, a * RNG.uniform(-(2.0**-54), 2.0**-54, n)


def exact(*parts):
    return [sum(map(Fraction, each)) for each in zip(*(part.tolist() for part in parts), strict=True)]


def test_heads_have_26_bits_and_tails_the_rest():
    head, tail, whole = halved(numbers(500))
    for a, b, c in zip(head.tolist(), tail.tolist(), whole.tolist(), strict=True):
        assert (Fraction(a).numerator.bit_length()) <= 26
        assert abs(b) <= 2.0**-26 * abs(c)


def test_products_and_sums():
    a, b, c, d = (numbers(500) for _ in range(4))
    x, y, z, w = (exact(*each) for each in (a, b, c, d))
    p, q = product(halved(a), halved_double(*b)), product(halved_double(*c), halved(d))
    for pair, right, units in (
        (p, [i * j for i, j in zip(x, y, strict=True)], 7),  # 5, and 1 for each number that is halved
        (square(halved(a)), [i * i for i in x], 7),
    ):
        for found, true in zip(exact(*pair), right, strict=True):
            assert abs(found - true) <= units * UNIT * abs(true)
    for operation, sign in ((pair_sum, 1), (pair_difference, -1)):
        for found, i, j, k, m in zip(exact(*operation(p, q)), x, y, z, w, strict=True):
            assert abs(found - (i * j + sign * k * m)) <= 11 * UNIT * (abs(i * j) + abs(k * m))


def test_a_number_of_which_nearly_all_cancels_is_halved_without_a_loss():
    a, b, c, one = (halved_double(np.array([x])) for x in (3.1, 0.7, 2.17, 1.0))
    left = pair_difference(product(a, b), product(c, one))
    head, tail, whole = halved(left)
    assert abs(exact(head, tail)[0] - exact(*left)[0]) <= UNIT * abs(exact(whole)[0])
    assert abs(tail[0]) <= 2.0**-26 * abs(whole[0])


def value_of(name, n, V, sign):
    """A condition at V, with that sign before what is subtracted; hurwitz3 without damping divided by V²."""
    p0, p1, p2 = (n[k, j] + n[k, j + 2] * V * V for k, j in ((0, 0), (1, 1), (2, 0)))
    p3, p4 = n[3, 1], n[4, 0]
    if (3, 0) in n:
        p1, p3 = V * p1 + n[1, 0], V * p3 + n[3, 0]
    return p1 if name == "p1" else p1 * (p2 * p3 + sign * p4 * p1) + sign * p0 * p3 * p3


@pytest.mark.parametrize("damped", [False, True])
def test_conditions_at_a_speed_within_their_bounds(damped):
    n = 300
    own = {key: Twofold(*numbers(n)) for key in (DAMPED if damped else EVEN)}
    entries, V = Entries(own), RNG.uniform(0.1, 10, n)
    for near, at, name in ((hurwitz3_near, hurwitz3_at, "hurwitz3"), (p1_near, p1_at, "p1")):
        if name == "p1" and not damped:
            continue
        found = exact(*near(entries, V, slice(None))), exact(*at(entries, V))
        for i in range(n):
            exactly = {key: exact(a.value[i : i + 1], a.rest[i : i + 1])[0] for key, a in own.items()}
            sizes = {key: abs(a) for key, a in exactly.items()}
            value, size = (value_of(name, m, Fraction(V[i]), sign) for m, sign in ((exactly, -1), (sizes, 1)))
            for got, share in zip(found, (CONDITION_AT, COEFFICIENT), strict=True):
                assert abs(got[i] - value) <= Fraction(share) * size
