"""Conditions on blocks from their values and exact derivatives in the middles: for many tolerances at once.

A number is value + Σ slopes e, wrong by at most ``rest``, for all e from −1 to 1, one for each axis of the
block. The slopes are exact derivatives times half a width; ``rest`` has all products of two of them, so that
it shrinks with the square of the widths, and all rounding (docs/trust.md). The formulas are those of
``letters`` and ``model``, as everywhere.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bikestab.bicycle import Bicycle
from bikestab.certify.bernstein import SPEED, Floats
from bikestab.certify.grid import Grid
from bikestab.certify.search import ORDER, STABLE, UNSTABLE, Blocks
from bikestab.letters import PARAMETERS, Model, letters
from bikestab.model import entries_of
from bikestab.notation import reduced
from bikestab.sines import sine_cosine

_UNIT = 2.0**-53
_UP = 1 + 2.0**-48  # more than the roundings of a rest itself
_TINY = 1e-300  # more than what products lose below the smallest doubles
_SIZE = 1 << 17  # numbers worked on at a time, which fit the cache


class Centred:
    """value + Σ slopes e ± rest; shapes (block,), (axis, block) and (block,), or one block for all."""

    __slots__ = ("reach", "rest", "slopes", "value")
    __array_ufunc__ = None  # an array times such a number is one

    def __init__(self, value: Floats, slopes: Floats, rest: Floats) -> None:
        self.value, self.slopes, self.rest = value, slopes, rest
        self.reach = np.abs(slopes).sum(axis=0) * _UP

    def __add__(self, other: Any) -> Centred:
        if not isinstance(other, Centred):
            other = self._constant(other)
        out = Centred(self.value + other.value, self.slopes + other.slopes, (self.rest + other.rest) * _UP)
        out.rest = out.rest + 2 * _UNIT * (np.abs(out.value) + out.reach)
        return out

    def __mul__(self, other: Any) -> Centred:
        if not isinstance(other, Centred):
            other = self._constant(other)
        a, b = self.value, other.value
        squares = 0.5 * self.slopes * other.slopes  # of e², which is from 0 to 1
        value, slopes = a * b + squares.sum(axis=0), a * other.slopes + b * self.slopes
        most, others = np.abs(a) + self.reach, np.abs(b) + other.reach
        pairs = self.reach * other.reach - np.abs(squares).sum(axis=0)
        rest = pairs + most * other.rest + (others + other.rest) * self.rest
        rounding = (2 * len(slopes) + 16) * _UNIT
        return Centred(value, slopes, rest * _UP + (rounding * most * others + _TINY))

    def __truediv__(self, other: Centred) -> Centred:
        """By what is not zero on the block; where it may be, nothing is known of the quotient."""
        v = np.abs(other.value)
        share = (other.reach + other.rest) / v * _UP
        inverse, over = 1 / other.value, 1 / (v * v)
        left = np.where(share < 0.5, share * share / (1 - share), np.inf)
        rest = (other.rest * over + left / v) * _UP + (2 * len(other.slopes) + 16) * _UNIT * (1 + share) / v
        return self * Centred(inverse, -other.slopes * over, rest + _TINY)

    def __neg__(self) -> Centred:
        return Centred(-self.value, -self.slopes, self.rest)

    def __sub__(self, other: Any) -> Centred:
        return self + -other

    def __rsub__(self, other: Any) -> Centred:
        return -self + other

    __radd__, __rmul__ = __add__, __mul__

    def ends(self) -> tuple[Floats, Floats]:
        """Lower and upper bounds."""
        wide = (self.reach + self.rest) * _UP + 4 * _UNIT * np.abs(self.value)
        return self.value - wide, self.value + wide

    def _constant(self, value: Any) -> Centred:
        return Centred(np.atleast_1d(float(value)), np.zeros((len(self.slopes), 1)), np.zeros(1))


class CentredProver:
    """The six conditions of a machine, with what varies of it, on any block of a grid's cells."""

    def __init__(self, bicycle: Bicycle, varied: tuple[str, ...], model: Model, grid: Grid) -> None:
        self.grid, self._bicycle, self._model, self._varied = grid, bicycle, model, varied
        self._damped = bicycle.delta > 0 or "delta" in varied

    def verdicts(self, blocks: Blocks, positive: NDArray[np.bool_]) -> NDArray[np.uint8]:
        """Whether blocks are stable or unstable throughout; ``positive`` as in ``Prover``."""
        verdicts = np.zeros(len(blocks), np.uint8)
        step = max(1, _SIZE // (64 * len(self.grid.cells)))
        for start in range(0, len(blocks), step):
            some = slice(start, start + step)
            with np.errstate(all="ignore"):  # what is no number decides nothing
                sides = self._conditions(blocks[some])
                for i, name in enumerate(ORDER):
                    low, high = sides[name].ends()
                    positive[some, i] |= low > 0
                    verdicts[some][positive[some, 0] & (high < 0)] = UNSTABLE  # p4 is first
        at_rest = (not self._damped) & (self.grid.edges[SPEED][blocks[:, SPEED, 0]] == 0)
        verdicts[positive.all(axis=1) & ~at_rest] = STABLE
        return verdicts

    def _conditions(self, blocks: Blocks) -> dict[str, Centred]:
        number = len(self.grid.cells)
        spans = [_span(edges, blocks[:, i]) for i, edges in enumerate(self.grid.edges)]

        def along(axis: int, value: Any, slope: Any, rest: Any = 0.0) -> Centred:
            value = np.atleast_1d(value)
            slopes = np.zeros((number, len(value)))
            slopes[axis] = slope
            return Centred(value, slopes, np.broadcast_to(rest, value.shape))

        bicycle = self._bicycle
        own = bicycle.bodies or {name: getattr(bicycle, name) for name in PARAMETERS}
        numbers: dict[str, Any] = {name: along(0, float(value), 0.0) for name, value in own.items()}
        numbers |= {name: along(3 + i, *spans[3 + i]) for i, name in enumerate(self._varied)}
        still = [i for i, spin in zip("12", ("IRyy", "IFyy") if bicycle.bodies else ("C1", "C2"), strict=True)
                 if own[spin] == 0 and spin not in self._varied]  # fmt: skip
        if bicycle.bodies:
            numbers = reduced(numbers)
        numbers = {
            name: x if isinstance(x, Centred) else along(0, float(x), 0.0) for name, x in numbers.items()
        }
        numbers |= {f"R{i}": along(0, 1.0, 0.0) for i in still}  # what never spins may be a skate
        lam, r = spans[0]
        bend = 0.5 * r * r * _UP
        sine, cosine = (x.value for x in sine_cosine(lam))
        sin = along(0, sine, cosine * r, bend + 4 * _UNIT)
        cos = along(0, cosine, -sine * r, bend + 4 * _UNIT)
        p = SimpleNamespace(**numbers, ahead=numbers["l2"] - numbers["c"])
        entries = entries_of(letters(p, sin, cos, along(1, *spans[1]), self._model))
        return self._sides(entries, along(2, *spans[2]))

    def _sides(self, entries: Mapping[tuple[int, int], Centred], V: Centred) -> dict[str, Centred]:
        """p0 … hurwitz3; without damping p1 and p3 are over V, and hurwitz3 over its square."""
        p: list[Any] = [0.0] * 5
        for (k, j), entry in entries.items():
            if self._damped or j >= k % 2:
                for _ in range(j if self._damped else j - k % 2):
                    entry = entry * V
                p[k] = entry + p[k]
        hurwitz3 = p[1] * (p[2] * p[3] - p[4] * p[1]) - p[0] * p[3] * p[3]
        return {**{f"p{k}": side for k, side in enumerate(p)}, "hurwitz3": hurwitz3}


def _span(edges: Floats, ends: NDArray[np.int64]) -> tuple[Floats, Floats]:
    """Middles and half widths of blocks along an axis; one where they are the same for all."""
    if np.ptp(ends[:, 0]) == np.ptp(ends[:, 1]) == 0:
        ends = ends[:1]
    low, high = edges[ends[:, 0]], edges[ends[:, 1]]
    middle = 0.5 * low + 0.5 * high
    return middle, np.maximum(high - middle, middle - low) * (1 + 2.0**-50)
