"""The four verdicts on any machine, from maps that are coarser than those of the paper's own."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.paper1981 import claims
from bikestab.paper1981.box import PAPER_BOX, DesignBox
from bikestab.paper1981.claims import Verdict
from bikestab.paper1981.damping import marked_from
from bikestab.paper1981.finite_interval import exceptions
from bikestab.paper1981.maps import Shares, map_designs, region_volume
from bikestab.paper1981.margin import margins_on_grid
from bikestab.paper1981.widening import Trends, trends


@dataclass(frozen=True)
class Verdicts:
    """The verdicts on the four conclusions."""

    finite_interval: Verdict = field(metadata={"key": "1"})
    widening: Verdict = field(metadata={"key": "2"})
    margin: Verdict = field(metadata={"key": "3"})
    damping: Verdict = field(metadata={"key": "4"})


@dataclass(frozen=True)
class Judgement:
    """The verdicts on a machine, and the numbers that they are drawn from."""

    shares: Shares
    shares_wider_box: Shares
    sigma_from: float | None
    larger_sigma_widens: float
    apart: float | None
    marked_from: float | None
    verdicts: Verdicts


@dataclass(frozen=True)
class JudgedMachine:
    """The verdicts on a machine in a box of designs, of all designs and of those with forks bent forwards."""

    box: DesignBox
    volume: float
    forwards_of_designs: float
    formula_disagreements: int
    everywhere: Judgement
    forwards: Judgement


def judge_machine(bicycle: Bicycle, n: int, box: DesignBox = PAPER_BOX) -> JudgedMachine:
    """The four verdicts from n × n designs, a third as many along each side for margin and damping."""
    inside, around = map_designs(bicycle, n, box), map_designs(bicycle, n, box.wider)
    all_margins, forward_margins = margins_on_grid(bicycle, n // 3, box)
    all_marked, forward_marked = marked_from(bicycle, n // 3, box)
    return JudgedMachine(
        box=box,
        volume=region_volume(inside, box),
        forwards_of_designs=float(inside.forwards.mean()),
        formula_disagreements=int(np.count_nonzero(inside.formula != inside.unbounded)),
        everywhere=_judgement(
            inside.shares, around.shares, trends(inside, inside.widest),
            all_margins.judged_by.apart, all_marked,
        ),
        forwards=_judgement(
            inside.shares_forwards, around.shares_forwards, trends(inside, inside.widest_forwards),
            forward_margins.judged_by.apart, forward_marked,
        ),
    )  # fmt: skip


def _judgement(
    inside: Shares, around: Shares, widths: Trends, apart: float | None, marked: float | None
) -> Judgement:
    found = exceptions(inside, around)
    return Judgement(
        inside, around, widths.sigma_from, widths.larger_sigma_widens, apart, marked,
        Verdicts(
            claims.judge_finite(found.in_box, found.beyond),
            judge_trends(widths),
            claims.judge_margin(apart),
            claims.judge_damping(marked),
        ),
    )  # fmt: skip


def judge_trends(widths: Trends) -> Verdict:
    """Conclusion 2 from the trends of the widths."""
    return claims.judge_widening(
        widths.larger_sigma_widens, widths.sigma_from, widths.reaches_zero, widths.widest_at_largest_lam
    )
