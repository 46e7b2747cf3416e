"""Numbers of twice double precision that are not put in order: their rules, and what they do to the table."""

from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from bikestab.letters import MODELS, PARAMETERS, determinant, letters
from bikestab.model import entries_of
from bikestab.notation import MEIJAARD, RIDER, reduced
from bikestab.rounding import ENTRY
from bikestab.twofold import Twofold
from bikestab.unordered import Unordered

U = Fraction(1, 2**53)
SINE = 64  # u² of its size, that of sine_cosine


class Worst:
    """How wrong a number may be, in u² of its size, and its rest, in u of it; as ``unordered`` has them."""

    def __init__(self, rest, error):
        self.rest, self.error = rest, error

    def __mul__(self, other):
        if isinstance(other, int):
            return self
        a, b = self, of(other)
        return Worst(a.rest + b.rest + 1, a.error + b.error + 3 * (a.rest + 1) * (b.rest + 1))

    def __add__(self, other):
        rest = max(self.rest, of(other).rest)
        return Worst(rest + 1, max(self.error, of(other).error) + 2 * rest + 1)

    def __truediv__(self, other):
        return Worst(1, self.error + other.error + 32 + 2)  # in order, as the quotient is

    def __neg__(self):
        return self

    __radd__, __rmul__, __sub__, __rsub__ = __add__, __mul__, __add__, __add__


def of(a):
    return a if isinstance(a, Worst) else Worst(0, 0)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("bodies", [(), [*MEIJAARD], [*MEIJAARD, *RIDER]], ids=["parts", "bodies", "rider"])
def test_entries_are_right_to_what_is_said(bodies, model):
    """The formulas of the table themselves, with the errors of their operations at worst."""
    numbers = {name: Worst(0, 0) for name in bodies or PARAMETERS}
    if bodies:
        numbers = {name: Worst(1, of(a).error) for name, a in reduced(numbers).items()}  # in order
    p = SimpleNamespace(**numbers, ahead=numbers["l2"] - numbers["c"])
    n = letters(p, Worst(1, SINE), Worst(1, SINE), Worst(0, 0), model)
    for entry in (*entries_of(n).values(), determinant(n)):
        assert entry.error <= ENTRY / U**2


@pytest.mark.parametrize("shapes", [((400,), (400,)), ((20, 1), (20,)), ((), (30,)), ((), ())])
def test_operations_are_right_to_their_rules(shapes):
    rng = np.random.default_rng(8)

    def number(shape):
        value = rng.uniform(-1, 1, shape) * 2.0 ** rng.integers(-30, 30, shape)
        rest = value * rng.uniform(-1, 1, shape) * 3 * 2.0**-53
        return Unordered(value, rest) if shape else Unordered(float(value), float(rest))

    a, b = (number(shape) for shape in shapes)
    shape = np.broadcast_shapes(*shapes)
    true = [[Fraction(x) + Fraction(y) for x, y in zip(*spread(each, shape), strict=True)] for each in (a, b)]
    for found, right, units in (
        (a * b, [x * y for x, y in zip(*true, strict=True)], 3 * 4 * 4),
        (a + b, [x + y for x, y in zip(*true, strict=True)], 2 * 3 + 1),
        (a - b, [x - y for x, y in zip(*true, strict=True)], 2 * 3 + 1),
    ):
        for result in (found, found.ordered()):
            got = [Fraction(x) + Fraction(y) for x, y in zip(*spread(result, shape), strict=True)]
            for x, y, size in zip(got, right, np.ravel(result.size).tolist(), strict=True):
                assert abs(x - y) <= units * U**2 * Fraction(size)
    assert spread(4 * a, shapes[0]) == [[4 * x for x in each] for each in spread(a, shapes[0])]


def spread(a, shape):
    return [np.broadcast_to(x, shape).ravel().tolist() for x in (a.value, a.rest)]


def test_in_order_the_value_is_the_nearest_double():
    a = Unordered(1.0, 2.0**-52) + Unordered(2.0**-53, -(2.0**-107))
    ordered = a.ordered()
    assert isinstance(ordered, Twofold)
    assert ordered.value == float(Fraction(a.value) + Fraction(a.rest)) != a.value
    assert Fraction(ordered.value) + Fraction(ordered.rest) == Fraction(a.value) + Fraction(a.rest)
