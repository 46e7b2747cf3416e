"""The whole study: every number of the report, and the verdicts that the rules draw from them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any, Generic, TypeVar

from bikestab import __version__
from bikestab.bicycle import Bicycle
from bikestab.paper1981 import claims
from bikestab.paper1981.any_machine import judge_trends
from bikestab.paper1981.box import LAM, SIGMA, Range, Sampling, V
from bikestab.paper1981.claims import Verdict
from bikestab.paper1981.damping import Damping, damping
from bikestab.paper1981.finite_interval import DesignIntervals, FiniteInterval, finite_interval
from bikestab.paper1981.forks import offset
from bikestab.paper1981.maps import map_designs
from bikestab.paper1981.margin import Margin, margin
from bikestab.paper1981.motorcycle import Motorcycle, judge_motorcycle
from bikestab.paper1981.one_design import intervals
from bikestab.paper1981.readings import Readings, judge_readings
from bikestab.paper1981.refinement import Refinement, refinement
from bikestab.paper1981.widening import Widening, widening

FAMILY_LAM = (0.05, 0.10, 0.15, 0.20, 0.25, 0.30)  # rad: the planes in which the boundaries are drawn
FAMILY_SIGMA = (0.06, 0.08, 0.10, 0.12, 0.14, 0.15)
ARROW = ((0.22, 0.125, 12.5), (0.22, 0.125, 4.9))  # λ, σ, V: from outside into the stable region
TABLE = ((0.20, 0.08), (0.30, 0.10), (0.05, 0.15), (0.015, 0.1475), (0.10, 0.08))  # (λ, σ)
FIGURES = {
    "machine.png": "the machine from its side, to scale, with its symbols",
    "figure3.png": "boundaries in (σ, V) at several λ and in (λ, V) at several σ",
    "figure3_space.png": "the region in three dimensions",
    "refinement.png": "the refined and the unrefined model side by side",
    "conclusion1.png": "which designs have an upper limit of the stable speed",
    "conclusion2.png": "the width of the interval along λ and along σ",
    "conclusion3.png": "the best designs",
    "conclusion4.png": "the boundaries against damping",
}
BUILT = ("meijaard2007", "sharp1971")  # presets with a tilt and a trail of their own
Progress = Callable[[str], None]
T = TypeVar("T")


@dataclass(frozen=True)
class Box:
    """The paper's ranges of λ [rad], σ and V [m/s]."""

    lam: Range = LAM
    sigma: Range = SIGMA
    V: Range = V


@dataclass(frozen=True)
class Figure3:
    """The planes and the arrow of figure 3, and the stable speeds of some designs."""

    lam: list[float]
    sigma: list[float]
    arrow: list[list[float]]
    table: list[DesignIntervals]


@dataclass(frozen=True)
class Judged(Generic[T]):
    """A claim, the rule it is judged by, the verdicts, and the numbers that they are drawn from.

    The second verdict is by the same rule on forks that are bent forwards, b >= 0.
    """

    claim: str
    rule: str
    verdict: Verdict
    verdict_forwards: Verdict
    numbers: T


@dataclass(frozen=True)
class Conclusions:
    """The paper's four conclusions, judged."""

    finite_interval: Judged[FiniteInterval] = field(metadata={"key": "1"})
    widening: Judged[Widening] = field(metadata={"key": "2"})
    margin: Judged[Margin] = field(metadata={"key": "3"})
    damping: Judged[Damping] = field(metadata={"key": "4"})

    def by_number(self) -> dict[int, Judged[Any]]:
        """The conclusions by their number in the paper."""
        return dict(enumerate((self.finite_interval, self.widening, self.margin, self.damping), 1))


@dataclass(frozen=True)
class Study:
    """All numbers of the report; ``built`` has the fork offset b [m] of other machines as they are built."""

    bikestab: str
    source: str
    bicycle: dict[str, float]
    warnings: list[str]
    box: Box
    sampling: Sampling
    thresholds: dict[str, float]
    figures: dict[str, str]
    figure3: Figure3
    refinement: Refinement
    built: dict[str, float]
    conclusions: Conclusions
    sensitivity: Readings
    motorcycle: Motorcycle


@dataclass(frozen=True)
class Undamped:
    """The half of the numbers for which conclusions 1, 2 and 3 are drawn, and the refinement's."""

    refined: Refinement
    finite: FiniteInterval
    wide: Widening
    best: Margin


@dataclass(frozen=True)
class Others:
    """The other half: damping, other readings and a motorcycle."""

    damped: Damping
    doubtful: Readings
    motorcycle: Motorcycle


def undamped(bicycle: Bicycle, sampling: Sampling, progress: Progress) -> Undamped:
    """What needs nothing of ``others``."""
    progress("map of the stable speeds")
    designs = map_designs(bicycle, sampling.grid)
    progress("the refinement")
    refined = refinement(bicycle, designs, sampling)
    progress("conclusions 1 and 2")
    finite = finite_interval(bicycle, designs, sampling)
    wide = widening(bicycle, designs, 5 * sampling.picture)
    progress("conclusion 3")
    return Undamped(refined, finite, wide, margin(bicycle, sampling.search, sampling.points))


def others(bicycle: Bicycle, sampling: Sampling, progress: Progress) -> Others:
    """What needs nothing of ``undamped``."""
    progress("conclusion 4")
    damped = damping(bicycle, sampling.grid_damping)
    progress("other readings of the printed values")
    doubtful = judge_readings(bicycle, sampling)
    progress("a motorcycle")
    return Others(damped, doubtful, judge_motorcycle(sampling.grid_readings))


def joined(bicycle: Bicycle, sampling: Sampling, one: Undamped, two: Others) -> Study:
    """Both halves, judged."""
    return Study(
        bikestab=__version__,
        source=bicycle.source,
        bicycle={name: value for name, value in bicycle.numbers().items() if value is not None},
        warnings=list(bicycle.warnings),
        box=Box(),
        sampling=sampling,
        thresholds=claims.THRESHOLDS,
        figures=FIGURES,
        figure3=_figure3(bicycle),
        refinement=one.refined,
        built={name: _own_offset(name) for name in BUILT},
        conclusions=_judged(one.finite, one.wide, one.best, two.damped),
        sensitivity=two.doubtful,
        motorcycle=two.motorcycle,
    )


def _own_offset(name: str) -> float:
    machine = Bicycle.preset(name)
    return float(offset(machine, machine.lam, machine.sigma))


def _figure3(bicycle: Bicycle) -> Figure3:
    return Figure3(
        list(FAMILY_LAM),
        list(FAMILY_SIGMA),
        [list(end) for end in ARROW],
        [DesignIntervals(lam, sigma, intervals(bicycle, lam, sigma)) for lam, sigma in TABLE],
    )


def _judged(finite: FiniteInterval, wide: Widening, best: Margin, damped: Damping) -> Conclusions:
    def judged(number: int, numbers: T, everywhere: Verdict, forwards: Verdict) -> Judged[T]:
        return Judged(claims.CLAIMS[number], claims.RULES[number], everywhere, forwards, numbers)

    exceptions = finite.judged_by, finite.forwards.judged_by
    return Conclusions(
        judged(1, finite, *(claims.judge_finite(found.in_box, found.beyond) for found in exceptions)),
        judged(2, wide, judge_trends(wide), judge_trends(wide.forwards)),
        judged(3, best, *(claims.judge_margin(m.judged_by.apart) for m in (best, best.forwards))),
        judged(
            4, damped, *(claims.judge_damping(s.marked_from) for s in (damped.everywhere, damped.forwards))
        ),
    )


def plain(value: Any) -> Any:
    """Records as mappings and sequences as lists, as JSON has them."""
    if is_dataclass(value):
        return {f.metadata.get("key", f.name): plain(getattr(value, f.name)) for f in fields(value)}
    if isinstance(value, dict):
        return {key: plain(part) for key, part in value.items()}
    return [plain(part) for part in value] if isinstance(value, list | tuple) else value
