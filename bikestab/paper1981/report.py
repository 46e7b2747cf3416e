"""report.md: texts with places for the study's numbers and tables; no number comes from elsewhere."""

from __future__ import annotations

from pathlib import Path

from bikestab.paper1981.machine_tables import motorcycle_tables, readings_tables
from bikestab.paper1981.study import Study
from bikestab.paper1981.tables import (
    damping_tables,
    designs_table,
    finite_interval_tables,
    margin_tables,
    refinement_tables,
    widening_tables,
)  # fmt: skip
from bikestab.paper1981.words import Tables, Words, listed, table

_TEXTS = Path(__file__).with_name("texts")
_SECTIONS = (
    "opening", "figure3", "refinement", "conclusion1", "conclusion2", "conclusion3", "conclusion4",
    "readings", "motorcycle", "literature", "method",
)  # fmt: skip
_DECISIVE = {  # the numbers that decide about each conclusion
    1: "no upper limit for {shares.unbounded:3p} of the designs, {unbounded_of_stable:3p} of the stable, "
    "{forwards.shares.unbounded:3p} of those with b ≥ 0",
    2: "right from σ = {sigma_from:.3f} on, to an optimum λ; no stability below {limits.lam_min:.4f} rad; "
    "with b ≥ 0 the widest is at λ = {forwards.widest_lam:.3f} rad",
    3: "widest interval at λ = {optima[0][lam]:.3f} rad, fastest decay at {optima[1][lam]:.3f} rad; "
    "with b ≥ 0 at {forwards.optima[0].lam:.3f} and {forwards.optima[1].lam:.3f} rad",
    4: "V2 moves only where it is weave; the region does, markedly from δ = {everywhere.marked_from:.3f} "
    "kg m²/s on, with b ≥ 0 from {forwards.marked_from:.3f}",
}


def rendered(study: Study) -> str:
    """The report in Markdown."""
    conclusions = study.conclusions.by_number()
    words = {
        **vars(study),
        **{f"n{number}": judged.numbers for number, judged in conclusions.items()},
        "conclusions": conclusions,
        "tables": _tables(study),
    }
    text = "\n".join((_TEXTS / f"{name}.md").read_text("utf-8") for name in _SECTIONS)
    return Words().vformat(text, (), words)


def decisive_numbers(study: Study, conclusion: int) -> str:
    """The numbers that decide about a conclusion, in a few words."""
    numbers = study.conclusions.by_number()[conclusion].numbers
    return Words().vformat(_DECISIVE[conclusion], (), vars(numbers))


def _tables(study: Study) -> Tables:
    conclusions = study.conclusions
    verdicts = [
        [
            str(number), judged.claim, f"**{judged.verdict}**", f"**{judged.verdict_forwards}**",
            decisive_numbers(study, number),
        ]
        for number, judged in conclusions.by_number().items()
    ]  # fmt: skip
    head = ["", "claim of the paper", "verdict", "verdict, forks bent forwards", "key numbers"]
    return {
        "verdicts": table(head, verdicts),
        "parameters": ", ".join(f"{name} = {value:g}" for name, value in study.bicycle.items()),
        "warnings": "; ".join(study.warnings) or "no",
        "family_lam": listed(study.figure3.lam),
        "family_sigma": listed(study.figure3.sigma),
        "designs": designs_table(study.figure3.table),
        **refinement_tables(study.refinement),
        **finite_interval_tables(conclusions.finite_interval.numbers),
        **widening_tables(conclusions.widening.numbers),
        **margin_tables(conclusions.margin.numbers),
        **damping_tables(conclusions.damping.numbers),
        **readings_tables(study.sensitivity),
        **motorcycle_tables(study.motorcycle),
    }
