"""Other readings of the values that the source prints doubtfully, and what hangs on them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.paper1981 import claims
from bikestab.paper1981.box import WIDER_LAM, WIDER_SIGMA, Sampling
from bikestab.paper1981.claims import Verdict
from bikestab.paper1981.damping import marked_from
from bikestab.paper1981.maps import Shares, map_designs, region_volume
from bikestab.paper1981.margin import apart_on_grid
from bikestab.paper1981.widening import trends

FRONT_A = (0.036, 0.36)  # kg m²: as printed, and with the point one digit further
SPINS = (0.05, 0.10, 0.25, 0.50)  # kg m²: the last is printed
PRODUCTS = 0.3  # of √(A B): the products of inertia that are tried
_VALUES = ("A1", "B1", "D1", "C1", "A2", "B2", "D2", "C2")


class Reading(NamedTuple):
    """A bicycle with other values than the printed ones, and words for what is different."""

    words: str
    bicycle: Bicycle
    printed: bool


@dataclass(frozen=True)
class JudgedReading:
    """One reading: the stable region in the paper's box, and the four verdicts by the same rules."""

    reading: str
    printed: bool
    rigid: bool
    values: dict[str, float]
    shares: Shares
    shares_wider_box: Shares
    volume: float
    sigma_from: float | None
    larger_sigma_widens: float
    apart: float | None
    marked_from: float | None
    formula_disagreements: int
    verdicts: dict[str, Verdict]


@dataclass(frozen=True)
class Readings:
    """Every reading, and for each conclusion how many readings give which verdict."""

    products: float
    marked_from: list[float] | list[None]
    readings: list[JudgedReading]
    number: int
    rigid: int
    designs_each: int
    counts: dict[str, dict[Verdict, int]]
    stable_nowhere: int


def readings(bicycle: Bicycle) -> list[Reading]:
    """A and B exchanged or not on either part, A2, C1 = C2; then D1 and D2, of the printed values."""
    return [
        *(
            _exchanged(bicycle, *choice)
            for choice in product((False, True), (False, True), FRONT_A, SPINS[::-1])
        ),
        *(_with_product(bicycle, part, sign) for part in "12" for sign in (1, -1)),
    ]


def _exchanged(bicycle: Bicycle, rear: bool, front: bool, A2: float, C: float) -> Reading:
    """A and B of the rear or the front part exchanged, A2 and C1 = C2 replaced."""
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
    return Reading(", ".join(words) or "as printed", other, not words)


def _with_product(bicycle: Bicycle, part: str, sign: int) -> Reading:
    D = sign * PRODUCTS * math.sqrt(getattr(bicycle, "A" + part) * getattr(bicycle, "B" + part))
    other = replace(bicycle, D1=D) if part == "1" else replace(bicycle, D2=D)
    return Reading(f"D{part} = {D:+.3g}", other, False)


def judge_reading(reading: Reading, n: int) -> JudgedReading:
    """The four verdicts on one reading, from n × n designs."""
    bicycle = reading.bicycle
    inside = map_designs(bicycle, n)
    around = map_designs(bicycle, n, lam=WIDER_LAM, sigma=WIDER_SIGMA)
    width = trends(inside)
    apart = apart_on_grid(bicycle, n // 3)
    marked = marked_from(bicycle, n // 3)
    in_box, beyond = (shares.unbounded + shares.multiple for shares in (inside.shares, around.shares))
    return JudgedReading(
        reading=reading.words,
        printed=reading.printed,
        rigid=not bicycle.warnings,
        values={name: getattr(bicycle, name) for name in _VALUES},
        shares=inside.shares,
        shares_wider_box=around.shares,
        volume=region_volume(inside),
        sigma_from=width.sigma_from,
        larger_sigma_widens=width.larger_sigma_widens,
        apart=apart,
        marked_from=marked,
        formula_disagreements=int(np.count_nonzero(inside.formula != inside.unbounded)),
        verdicts={
            "1": claims.judge_finite(in_box, beyond),
            "2": claims.judge_widening(width.larger_sigma_widens, width.sigma_from, width.reaches_zero),
            "3": claims.judge_margin(apart),
            "4": claims.judge_damping(marked),
        },
    )


def judge_readings(bicycle: Bicycle, sampling: Sampling) -> Readings:
    """The verdicts on every reading of the printed values."""
    rows = [
        judge_reading(reading, sampling.grid_readings) for reading in readings(bicycle)[:: sampling.every]
    ]
    marked = [row.marked_from for row in rows if row.marked_from is not None]
    return Readings(
        products=PRODUCTS,
        marked_from=[min(marked), max(marked)] if marked else [None, None],
        readings=rows,
        number=len(rows),
        rigid=sum(row.rigid for row in rows),
        designs_each=sampling.grid_readings**2,
        counts={
            number: {
                verdict: sum(row.verdicts[number] == verdict for row in rows) for verdict in claims.VERDICTS
            }
            for number in ("1", "2", "3", "4")
        },
        stable_nowhere=sum(row.shares.none == 1 for row in rows),
    )
