"""What is known of products of entries in which nearly all cancels, against fractions."""

from fractions import Fraction

import numpy as np
import pytest

from bikestab.critical import _hurwitz3_even, _rows
from bikestab.entries import DAMPED, EVEN, Entries
from bikestab.rounding import CANCELLED, ENTRY
from bikestab.routh import hurwitz3_of
from bikestab.twofold import Twofold

NUMBER = 600


def entries_and_truth(keys, rng):
    """Entries of which up to all but 2^−100 cancels, and what they may truly be: as wrong as ENTRY allows."""
    numbers, truth = {}, {}
    for key in keys:
        size = 2.0 ** rng.integers(-10, 11, NUMBER)
        left = rng.uniform(0.5, 1, NUMBER) * 2.0 ** -rng.integers(0, 100, NUMBER)
        value = size * left * rng.choice([-1, 1], NUMBER)
        rest = value * rng.uniform(-1, 1, NUMBER) * 2.0**-54
        wrong = rng.choice([-1, 1], NUMBER) * ENTRY * size
        numbers[key] = Twofold(value, rest, size)
        parts = (value.tolist(), rest.tolist(), wrong.tolist())
        truth[key] = np.array([sum(map(Fraction, each)) for each in zip(*parts, strict=True)])
    return Entries(numbers), truth


class Exact:
    """Arrays of fractions that the formulas for numbers with sizes take."""

    def __init__(self, value):
        self.value = value

    def __add__(self, other):
        return Exact(self.value + other.value)

    def __sub__(self, other):
        return Exact(self.value - other.value)

    def __mul__(self, other):
        return Exact(self.value * other.value)

    def __neg__(self):
        return Exact(-self.value)


@pytest.mark.parametrize("damped", [False, True])
def test_coefficients_of_what_is_left(damped):
    """Each is right to CANCELLED of its size, and the worst is wrong by an eighth of that.

    An entry's error is 2^−71 of LEFT of its size; the test fails with a sixteenth of either constant.
    """
    entries, truth = entries_and_truth(DAMPED if damped else EVEN, np.random.default_rng(11))
    exact = {key: Exact(a) for key, a in truth.items()}
    found, right = (
        hurwitz3_of(_rows(n)) if damped else _hurwitz3_even(n) for n in (entries.cancelled(), exact)
    )
    worst = Fraction(0)
    for a, b in zip(found, right, strict=True):
        value, rest, size = (np.array([*map(Fraction, each.tolist())]) for each in (a.value, a.rest, a.size))
        worst = max(worst, *(abs(value + rest - b.value) / size))
    assert 1 / 16 < float(worst / Fraction(CANCELLED)) <= 1
