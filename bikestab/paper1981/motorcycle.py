"""Whether everything in the paper holds for motorcycles: the verdicts on one, and its own design."""

from __future__ import annotations

from dataclasses import dataclass

from bikestab.bicycle import Bicycle
from bikestab.paper1981.any_machine import JudgedMachine, judge_each
from bikestab.paper1981.box import PAPER_BOX
from bikestab.paper1981.forks import offset
from bikestab.paper1981.one_design import Interval, intervals

PRESET = "sharp1971"


@dataclass(frozen=True)
class OwnDesign:
    """The machine as it is built: its design, fork offset b [m], damper δ [kg m²/s], and stable speeds."""

    lam: float
    sigma: float
    offset: float
    delta: float
    intervals: list[Interval]
    without_damper: list[Interval]


@dataclass(frozen=True)
class Motorcycle:
    """A motorcycle judged without its damper, in the paper's box and in one that has its own design in it."""

    name: str
    source: str
    designs_each: int
    own: OwnDesign
    paper_box: JudgedMachine
    wider_box: JudgedMachine


def judge_motorcycle(n: int) -> Motorcycle:
    """Sharp's standard machine, from n × n designs of each box."""
    machine = Bicycle.preset(PRESET)
    bare = machine.with_delta(0.0)
    lam, sigma = machine.lam or 0.0, machine.sigma or 0.0
    return Motorcycle(
        name=machine.name,
        source=machine.source,
        designs_each=n * n,
        own=OwnDesign(
            lam, sigma, float(offset(machine, lam, sigma)), machine.delta,
            intervals(machine, lam, sigma), intervals(bare, lam, sigma),
        ),
        paper_box=judge_each([bare], n)[0],
        wider_box=judge_each([bare], n, PAPER_BOX.wider)[0],
    )  # fmt: skip
