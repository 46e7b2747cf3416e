"""Numbers of 79 bits: a head of 26 bits, so that products of heads are exact, and a double behind it.

They take half of the operations of pairs of doubles, for values that need fewer digits. A tail is at most
2^−26 of its number. A product is right to 5 · 2^−79 of its size, a sum of such products to 4 · 2^−79 of its
terms' sizes, and what is halved to 2^−79 of itself.
"""

from __future__ import annotations

from typing import Any

from bikestab.twofold import Pair, head_of

Halved = tuple[Any, Any, Any]  # head, tail, and their sum as a double


def halved(a: Pair) -> Halved:
    """A pair of doubles value + rest, whose rest may be some 2^−25 of the terms that formed it."""
    whole = a[0] + a[1]
    head = head_of(whole)
    tail = a[0] - head
    tail += a[1]
    return head, tail, whole


def halved_double(a: Any, rest: Any = 0.0) -> Halved:
    """A double, with a rest below its last place."""
    head = head_of(a)
    tail = a - head
    tail += rest
    return head, tail, a


def product(a: Halved, b: Halved) -> Pair:
    """The product, with a rest that is no rounding error."""
    rest = a[0] * b[1]
    rest += a[1] * b[2]
    return a[0] * b[0], rest


def square(a: Halved) -> Pair:
    """The product with itself."""
    return a[0] * a[0], a[1] * (a[2] + a[0])
