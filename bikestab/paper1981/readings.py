"""Other readings of the values that the source prints doubtfully, and what hangs on them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

from bikestab.bicycle import Bicycle
from bikestab.limits import least_with
from bikestab.paper1981 import claims
from bikestab.paper1981.any_machine import JudgedMachine, judge_each
from bikestab.paper1981.box import Sampling
from bikestab.paper1981.claims import Verdict

FRONT_A = (0.036, 0.36)  # kg m²: as printed, and with the point one digit further
SPINS = (0.05, 0.10, 0.175, 0.25, 0.50)  # kg m²: the last is printed; 0.175 if it is C° = C/R, in kg m
POSSIBLE = 0.05  # kg m²: the one that a wheel within the printed front part can have
OTHERS = {"m2": (2.0, 4.0), "h2": (0.4, 0.6), "l2": (0.85, 0.95)}  # kg, m: around the printed 2.7, 0.5, 0.9
PRODUCTS = 0.3  # of √(A B): the products of inertia that are tried, which are not printed
_VALUES = ("m2", "l2", "h2", "A1", "B1", "D1", "C1", "A2", "B2", "D2", "C2")


class Reading(NamedTuple):
    """A bicycle with other values than the printed ones, and words for what is different."""

    words: str
    bicycle: Bicycle
    printed: bool


@dataclass(frozen=True)
class JudgedReading:
    """One reading, whether rigid bodies can have its values, and what is judged by the same rules."""

    reading: str
    printed: bool
    possible: bool
    values: dict[str, float]
    judged: JudgedMachine


@dataclass(frozen=True)
class Counts:
    """For one conclusion how many readings with stable designs, and of the possible, give which verdict."""

    all: dict[Verdict, int]
    possible: dict[Verdict, int]
    forwards: dict[Verdict, int]
    forwards_possible: dict[Verdict, int]


@dataclass(frozen=True)
class Possible:
    """How many of the readings without products of inertia or other masses rigid bodies can have.

    With inertias that no body breaks and a wheel no heavier than its part; where a wheel's own inertia about
    a diameter counts as well; and where its mass and parallel axes do too. The last number is the largest C2
    [kg m²] of a wheel within the printed front part.
    """

    tried: int
    by_sums: int
    by_diameters: int
    by_parallel_axes: int
    largest_C2: float


@dataclass(frozen=True)
class Readings:
    """Every reading, and for each conclusion how many readings give which verdict."""

    products: float
    marked_from: list[float] | list[None]
    readings: list[JudgedReading]
    number: int
    number_possible: int
    possible: Possible
    designs_each: int
    counts: dict[str, Counts]
    unbounded_wider: int
    stable_nowhere: int


def readings(bicycle: Bicycle) -> list[Reading]:
    """A and B exchanged or not on either part, A2, C1 = C2; then one other value at a time.

    The latter with the printed C and with the possible one.
    """
    possible = replace(bicycle, C1=POSSIBLE, C2=POSSIBLE)
    return [
        *exchanged(bicycle),
        *_with_other_values(bicycle, ""),
        *_with_other_values(possible, f"C = {POSSIBLE:g}, "),
    ]


def exchanged(bicycle: Bicycle) -> Iterator[Reading]:
    """A and B of the rear or the front part exchanged, A2 and C1 = C2 replaced."""
    for rear, front, A2, C in product((False, True), (False, True), FRONT_A, SPINS[::-1]):
        other = replace(
            bicycle,
            A1=bicycle.B1 if rear else bicycle.A1,
            B1=bicycle.A1 if rear else bicycle.B1,
            A2=bicycle.B2 if front else A2,
            B2=A2 if front else bicycle.B2,
            C1=C,
            C2=C,
        )
        words = ["A1 ⇄ B1"] if rear else []
        words += ["A2 ⇄ B2"] if front else []
        words += [f"{'B2' if front else 'A2'} = {A2:g}"] if bicycle.A2 != A2 else []
        words += [f"C = {C:g}"] if bicycle.C2 != C else []
        yield Reading(", ".join(words) or "as printed", other, not words)


def _with_other_values(bicycle: Bicycle, words: str) -> Iterator[Reading]:
    for name, values in OTHERS.items():
        for value in values:
            yield Reading(f"{words}{name} = {value:g}", bicycle.replaced({name: value}), False)
    for part, sign in product("12", (1, -1)):
        D = sign * PRODUCTS * math.sqrt(getattr(bicycle, "A" + part) * getattr(bicycle, "B" + part))
        yield Reading(f"{words}D{part} = {D:+.3g}", bicycle.replaced({f"D{part}": D}), False)


def judge_all(chosen: Sequence[Reading], n: int) -> list[JudgedReading]:
    """The four verdicts on each reading, from n × n designs."""
    judged = judge_each([reading.bicycle for reading in chosen], n)
    return [
        JudgedReading(
            reading=reading.words,
            printed=reading.printed,
            possible=not reading.bicycle.warnings,
            values={name: getattr(reading.bicycle, name) for name in _VALUES},
            judged=verdicts,
        )
        for reading, verdicts in zip(chosen, judged, strict=True)
    ]


def judge_readings(bicycle: Bicycle, sampling: Sampling) -> Readings:
    """The verdicts on every reading of the printed values."""
    rows = judge_all(readings(bicycle), sampling.grid_readings)
    marked = [row.judged.everywhere.marked_from for row in rows]
    known = [delta for delta in marked if delta is not None]
    return Readings(
        products=PRODUCTS,
        marked_from=[min(known), max(known)] if known else [None, None],
        readings=rows,
        number=len(rows),
        number_possible=sum(row.possible for row in rows),
        possible=possible(bicycle),
        designs_each=sampling.grid_readings**2,
        counts={str(number): _counts(rows, number) for number in claims.CLAIMS},
        unbounded_wider=sum(row.judged.everywhere.shares_wider_box.unbounded > 0 for row in rows),
        stable_nowhere=sum(row.judged.everywhere.shares.none == 1 for row in rows),
    )


def _counts(rows: list[JudgedReading], number: int) -> Counts:
    def count(forwards: bool, chosen: list[JudgedReading]) -> dict[Verdict, int]:
        sides = [row.judged.forwards if forwards else row.judged.everywhere for row in chosen]
        sides = [
            side for side in sides if side.shares.some
        ]  # without stable designs there is nothing to judge
        verdicts = [list(vars(side.verdicts).values())[number - 1] for side in sides]
        return {verdict: verdicts.count(verdict) for verdict in claims.VERDICTS}

    some = [row for row in rows if row.possible]
    return Counts(count(False, rows), count(False, some), count(True, rows), count(True, some))


def possible(bicycle: Bicycle) -> Possible:
    """How many of the readings of A, B and C rigid bodies can have, by ever stricter conditions."""
    bicycles = [reading.bicycle for reading in exchanged(bicycle)]
    sums = [b for b in bicycles if b.C2 <= b.A2 + b.B2 and b.m2 * b.R2**2 >= b.C2]
    p = bicycle

    def room(C2: float) -> float:
        """How much of A2 or B2 is left beside a wheel of this spin inertia."""
        needs = (least_with(C2, p.m2, p.R2, away) for away in (p.R2 - p.h2, p.c - p.l2))
        return min(A - least for A, least in zip((p.A2, p.B2), needs, strict=True))

    return Possible(
        tried=len(bicycles),
        by_sums=len(sums),
        by_diameters=sum(2 * min(b.A2, b.B2) >= b.C2 for b in sums),
        by_parallel_axes=sum(not b.warnings for b in bicycles),
        largest_C2=_last(room, 0.0, 2 * min(p.A2, p.B2)),
    )


def _last(room: Callable[[float], float], low: float, high: float) -> float:
    """The largest number up to which there is room, which gets less; by halving to rounding."""
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (middle, high) if room(middle) >= 0 else (low, middle)
    return low
