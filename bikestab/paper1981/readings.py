"""Other readings of the values that the source prints doubtfully, and what hangs on them."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple

from bikestab.bicycle import Bicycle
from bikestab.paper1981 import box as paper
from bikestab.paper1981 import claims
from bikestab.paper1981.box import LAM, SIGMA, WIDER, Size
from bikestab.paper1981.damping import FEW, damping
from bikestab.paper1981.evidence import margin_on_grid, widening

Numbers = dict[str, Any]
FRONT_A = (0.036, 0.36)  # kg m²: as printed, and with the point one digit further
SPINS = (0.05, 0.10, 0.25, 0.50)  # kg m²: the last is printed
PRODUCTS = 0.3  # of √(A B): the products of inertia that are tried


class Reading(NamedTuple):
    """A bicycle with other values than the printed ones, and words for what is different."""

    words: str
    bicycle: Bicycle
    printed: bool


def readings(bicycle: Bicycle) -> list[Reading]:
    """A and B exchanged or not on either part, A2, C1 = C2; then D1 and D2, of the printed values."""
    found = []
    for rear, front, A2, C in product((False, True), (False, True), FRONT_A, reversed(SPINS)):
        values: Numbers = {"A1": bicycle.A1, "B1": bicycle.B1, "A2": A2, "B2": bicycle.B2, "C1": C, "C2": C}
        words = []
        if rear:
            values["A1"], values["B1"] = values["B1"], values["A1"]
            words.append("A1 ⇄ B1")
        if front:
            values["A2"], values["B2"] = values["B2"], values["A2"]
            words.append("A2 ⇄ B2")
        words += [f"{'B2' if front else 'A2'} = {A2:g}"] if bicycle.A2 != A2 else []
        words += [f"C = {C:g}"] if bicycle.C2 != C else []
        found.append(Reading(", ".join(words) or "as printed", replace(bicycle, **values), not words))
    for i in ("1", "2"):
        most = math.sqrt(getattr(bicycle, "A" + i) * getattr(bicycle, "B" + i))
        for sign in (1, -1):
            D = sign * PRODUCTS * most
            value: Numbers = {f"D{i}": D}
            found.append(Reading(f"D{i} = {D:+.3g}", replace(bicycle, **value), False))
    return found


def judged(reading: Reading, size: Size) -> Numbers:
    """One reading: the stable region in the paper's box, and the four verdicts by the same rules."""
    bicycle = reading.bicycle
    inside = paper.designs(bicycle, size.grid_readings)
    around = paper.designs(
        bicycle, size.grid_readings,
        lam=(LAM[0], WIDER * LAM[1]), sigma=(SIGMA[0], WIDER * SIGMA[1]),
    )  # fmt: skip
    width = widening(inside)
    apart = margin_on_grid(bicycle, size.grid_readings // 3)
    marked = damping(bicycle, size.grid_readings // 3, FEW)["judged_by"]["marked_from"]
    in_box, beyond = (found.shares["unbounded"] + found.shares["multiple"] for found in (inside, around))
    return {
        "reading": reading.words,
        "printed": reading.printed,
        "rigid": not bicycle.warnings,
        "values": {name: getattr(bicycle, name) for name in ("A1", "B1", "D1", "C1", "A2", "B2", "D2", "C2")},
        "shares": inside.shares,
        "shares_wider_box": around.shares,
        "volume": paper.volume(inside),
        "sigma_from": width["sigma_from"],
        "larger_sigma_widens": width["larger_sigma_widens"],
        "apart": apart,
        "marked_from": marked,
        "formula_disagreements": int((inside.formula != inside.unbounded).sum()),
        "verdicts": {
            "1": claims.judge_finite(in_box, beyond),
            "2": claims.judge_widening(
                width["larger_sigma_widens"], width["sigma_from"], width["reaches_zero"]
            ),
            "3": claims.judge_margin(apart),
            "4": claims.judge_damping(marked),
        },
    }


def sensitivity(bicycle: Bicycle, size: Size) -> Numbers:
    """Every reading, and for each conclusion how many readings give which verdict."""
    rows = [judged(reading, size) for reading in readings(bicycle)[:: size.every]]
    counts = {
        number: {
            verdict: sum(row["verdicts"][number] == verdict for row in rows)
            for verdict in (claims.HOLDS, claims.LIMITS, claims.FAILS)
        }
        for number in ("1", "2", "3", "4")
    }
    rigid = [row for row in rows if row["rigid"]]
    marked = [row["marked_from"] for row in rows if row["marked_from"] is not None]
    return {
        "products": PRODUCTS,
        "marked_from": [min(marked), max(marked)] if marked else [None, None],
        "readings": rows,
        "number": len(rows),
        "rigid": len(rigid),
        "designs_each": size.grid_readings**2,
        "counts": counts,
        "stable_nowhere": sum(row["shares"]["none"] == 1 for row in rows),
    }
