"""The tables of the report."""

from __future__ import annotations

from bikestab.paper1981.claims import MARKED, THRESHOLDS
from bikestab.paper1981.damping import Change, Damping, Sweep
from bikestab.paper1981.finite_interval import CurveEnd, DesignIntervals, FiniteInterval
from bikestab.paper1981.margin import Margin
from bikestab.paper1981.refinement import Refinement
from bikestab.paper1981.widening import Widening
from bikestab.paper1981.words import (
    Tables,
    complex_number,
    from_delta,
    interval,
    intervals,
    listed,
    number,
    ranges,
    short_interval,
    table,
)  # fmt: skip

_MODELS = {  # rows of the table that compares them: key and format
    "volume of the stable region [rad m/s]": ("volume", ".6f"),
    "its share of the box": ("volume_share", "3p"),
    "designs with p0 > 0 at some speed": ("p0_somewhere", "3p"),
    "designs with p0 > 0 at all high speeds": ("p0_rising", "3p"),
    "designs with p0 > 0 and p1 > 0 at the same speed": ("p0_and_p1", "3p"),
    "lowest speed with p1 > 0 [m/s]": ("p1_lowest", ".3f"),
    "designs with a stable speed, in a box twice as long and wide": ("stable_in_wider_box", "3p"),
}
_SHARES = {
    "no stable speed": "none", "bounded intervals only": "finite", "an unbounded interval": "unbounded",
    "more than one interval": "multiple",
}  # fmt: skip


def designs_table(designs: list[DesignIntervals]) -> str:
    """The stable speeds of some designs."""
    rows = [[f"{d.lam:g}", f"{d.sigma:g}", intervals(d.intervals)] for d in designs]
    return table(["λ [rad]", "σ", "stable speeds [m/s]"], rows)


def refinement_tables(r: Refinement) -> Tables:
    """Both models side by side, and what is changed."""
    models = (r.models["refined"], r.models["unrefined"])
    rows = [
        [words, *(number(getattr(m, key), spec) for m in models)] for words, (key, spec) in _MODELS.items()
    ]
    rows.insert(
        2, ["designs with a stable speed, in the box", *(number(m.shares.some, "3p") for m in models)]
    )
    rows.insert(3, ["S [kg m]", *(f"{number(m.S[0], '.3f')} … {number(m.S[1], '.3f')}" for m in models)])
    damped = f"the same with δ = {models[0].damper:g} kg m²/s"
    rows.append([damped, *(number(m.stable_with_damper, "3p") for m in models)])
    return {
        "changed_coefficients": listed(r.changed_coefficients),
        "changed_terms": listed(r.changed_terms),
        "models": table(["", "refined", "unrefined"], rows),
    }


def finite_interval_tables(n: FiniteInterval) -> Tables:
    """Shares of designs, counterexamples and curves at infinity."""
    kinds = (n.shares, n.shares_wider_box, n.forwards.shares, n.forwards.shares_wider_box)
    shares = [[words, *(number(getattr(of, key), "4p") for of in kinds)] for words, key in _SHARES.items()]
    examples = [
        [
            f"{e.lam:g}", f"{e.sigma:g}", number(e.offset, ".3f"), intervals(e.intervals), V,
            ", ".join(map(complex_number, values)),
        ]
        for e in n.counterexamples
        for V, values in e.eigenvalues.items()
    ]  # fmt: skip
    curves = [[f"*{c.name}*", _end(c.start), _end(c.stop)] for c in n.curves_at_infinity]
    head = ["λ [rad]", "σ", "b [m]", "stable speeds [m/s]", "at V [m/s]", "eigenvalues"]
    columns = ["the paper's box", "wider box", "the paper's, b ≥ 0", "wider, b ≥ 0"]
    return {
        "shares": table(["", *columns], shares),
        "counterexamples": table(head, examples),
        "curves": table(["curve", "from", "to"], curves),
        "two_intervals": intervals(n.two_intervals.intervals, between=" and "),
    }


def _end(end: CurveEnd) -> str:
    place = "the edge of the box" if end.at == "box" else f"on *{end.at}*"
    return f"({number(end.lam, '.7f')}, {number(end.sigma, '.7f')}), {place}"


def widening_tables(n: Widening) -> Tables:
    """Widths along lines of constant σ and of constant λ."""
    at_sigma = [
        [
            f"{row.sigma:g}", ranges(row.stable_lam), ranges(row.unbounded_lam),
            number(row.best_lam, ".4f"), number(row.width, ".3f"), number(row.width_at_largest_lam, ".3f"),
        ]
        for row in n.lines.at_sigma
    ]  # fmt: skip
    at_lam = [
        [f"{row.lam:g}", ranges(row.stable_sigma), number(row.best_sigma, ".4f"), number(row.width, ".3f")]
        for row in n.lines.at_lam
    ]
    head = ["σ", "stable for λ [rad]", "no upper limit for λ [rad]", "widest at λ [rad]", "width there [m/s]"]
    return {
        "widths_at_sigma": table([*head, "width at the largest λ [m/s]"], at_sigma),
        "widths_at_lam": table(["λ [rad]", "stable for σ", "widest at σ", "width there [m/s]"], at_lam),
    }


def margin_tables(n: Margin) -> Tables:
    """The best designs."""
    rows = [
        [
            d["criterion"], number(d["lam"], ".4f"), number(d["sigma"], ".4f"),
            interval(d["V1"], d["lower"], d["V2"], d["upper"]), number(d["width"], ".3f"),
            number(d["growth_rate"], ".4f"), number(d["V"], ".3f"),
            d["at"].replace("lam", "λ").replace("sigma", "σ"),
        ]
        for d in n.optima
    ]  # fmt: skip
    head = ["margin", "λ [rad]", "σ", "stable speeds [m/s]", "width [m/s]"]
    forwards = [
        [
            d.criterion, number(d.lam, ".4f"), number(d.sigma, ".4f"), number(d.offset, ".4f"),
            number(d.width, ".3f"), number(d.growth_rate, ".4f"),
        ]
        for d in n.forwards.optima
    ]  # fmt: skip
    columns = ["margin, b ≥ 0", "λ [rad]", "σ", "b [m]", "width [m/s]", "growth rate [1/s]"]
    return {
        "optima": table([*head, "growth rate [1/s]", "at V [m/s]", "where"], rows),
        "optima_forwards": table(columns, forwards),
        "controllability": _controllability(n),
    }


def _controllability(n: Margin) -> str:
    """Modal controllability of the best design, and of those of greatest margin with their ranks."""
    rows = []
    for at in n.controllability:
        where = f"λ = {number(at.lam, '.3f')}, σ = {number(at.sigma, '.3f')}"
        best = f"{number(at.controllability, '.4f')} at {where}"
        margins = [
            "–"
            if r.controllability is None
            else f"{number(r.controllability, '.4f')} ({number(r.better_than, '3p')})"
            for r in at.of_margins
        ]
        rows.append([f"{at.V:g}", str(at.designs), best, *margins])
    head = [
        "V [m/s]",
        "stable designs",
        "best of the grid",
        *(r.design for r in n.controllability[0].of_margins),
    ]
    return table(head, rows)


def damping_tables(n: Damping) -> Tables:
    """The sweep over δ, from where each measure is marked, and single designs."""
    folds = [f"smallest stable σ at λ = {lam:g}" for lam in n.folds_at_lam]
    single = []
    for d in n.single_designs:
        by_delta = {row.delta: row for row in d.sweep}
        cells = [short_interval(d.without), *(short_interval(by_delta[delta]) for delta in n.shown)]
        marked = [from_delta(d.V1_marked_from) if d.without.V1 else "–"]
        marked += [from_delta(d.V2_marked_from) if d.without.V2 else "–"]
        single.append([f"{d.lam:g}", f"{d.sigma:g}", *cells, *marked])
    values = [f"δ = {delta:g}" for delta in (0, *n.shown)]
    return {
        "sweep": table(
            ["δ [kg m²/s]", "volume", "V1, median", "V1, largest change", *folds],
            [_change(row) for row in n.everywhere.changes if row.delta in n.shown],
        ),
        "marked": _marked(n.everywhere),
        "marked_forwards": _marked(n.forwards),
        "single": table(["λ [rad]", "σ", *values, "V1 marked from δ", "V2 marked from δ"], single),
    }


def _change(row: Change) -> list[str]:
    shares = (row.volume_change, row.V1_change_median, row.V1_change_largest, *row.sigma_min_change)
    return [f"{row.delta:g}", *(number(share, "3p") for share in shares)]


def _marked(sweep: Sweep) -> str:
    """From which δ each measure is marked, by what counts as marked."""
    head = ["measure", *(f"{number(THRESHOLDS[key], '3p')} from δ" for key in MARKED), "verdict by it alone"]
    rows = [
        [name, *(from_delta(by[key]) for key in MARKED), sweep.verdict_by_measure[name]]
        for name, by in sweep.marked_by_measure.items()
    ]
    return table(head, rows)
