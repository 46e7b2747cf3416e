"""The four verdicts on any machine, from maps that are coarser than those of the paper's own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from bikestab.bicycle import Bicycle
from bikestab.paper1981 import claims
from bikestab.paper1981.box import PAPER_BOX, DesignBox
from bikestab.paper1981.claims import Verdict
from bikestab.paper1981.damping import marked_from_each
from bikestab.paper1981.finite_interval import exceptions
from bikestab.paper1981.maps import DesignMap, Shares, map_each, region_volume
from bikestab.paper1981.margin import GridMargin, margins_on_grid
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


def judge_each(bicycles: Sequence[Bicycle], n: int, box: DesignBox = PAPER_BOX) -> list[JudgedMachine]:
    """The four verdicts on each bicycle, from n × n designs.

    Margin and damping are from a third as many along each side.
    """
    found = (
        map_each(bicycles, n, box), map_each(bicycles, n, box.wider), marked_from_each(bicycles, n // 3, box),
        [margins_on_grid(bicycle, n // 3, box) for bicycle in bicycles],
    )  # fmt: skip
    return [_judged(box, *each) for each in zip(*found, strict=True)]


def _judged(
    box: DesignBox,
    inside: DesignMap,
    around: DesignMap,
    marked: tuple[float | None, float | None],
    margins: tuple[GridMargin, GridMargin],
) -> JudgedMachine:
    return JudgedMachine(
        box=box,
        volume=region_volume(inside, box),
        forwards_of_designs=float(inside.forwards.mean()),
        formula_disagreements=int(np.count_nonzero(inside.formula != inside.unbounded)),
        everywhere=_judgement(
            inside.shares, around.shares, trends(inside, inside.widest),
            margins[0].judged_by.apart, marked[0],
        ),
        forwards=_judgement(
            inside.shares_forwards, around.shares_forwards, trends(inside, inside.widest_forwards),
            margins[1].judged_by.apart, marked[1],
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
