"""The tables of the report."""

from __future__ import annotations

from bikestab.paper1981.claims import FAILS, HOLDS, LIMITS, VERDICTS
from bikestab.paper1981.damping import Damping
from bikestab.paper1981.finite_interval import CurveEnd, DesignIntervals, FiniteInterval
from bikestab.paper1981.margin import Margin
from bikestab.paper1981.readings import Readings
from bikestab.paper1981.refinement import Refinement
from bikestab.paper1981.widening import Widening
from bikestab.paper1981.words import (
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

_SIGNS = {HOLDS: "+", LIMITS: "±", FAILS: "−"}
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
Tables = dict[str, str]


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
    boxes = (n.shares, n.shares_wider_box)
    shares = [[words, *(number(getattr(box, key), "4p") for box in boxes)] for words, key in _SHARES.items()]
    examples = [
        [
            f"{e.lam:g}", f"{e.sigma:g}", intervals(e.intervals), V,
            ", ".join(map(complex_number, values)),
        ]
        for e in n.counterexamples
        for V, values in e.eigenvalues.items()
    ]  # fmt: skip
    curves = [[f"*{c.name}*", _end(c.start), _end(c.stop)] for c in n.curves_at_infinity]
    head = ["λ [rad]", "σ", "stable speeds [m/s]", "at V [m/s]", "eigenvalues"]
    return {
        "shares": table(["", "the paper's box", "wider box"], shares),
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
    return {"optima": table([*head, "growth rate [1/s]", "at V [m/s]", "where"], rows)}


def damping_tables(n: Damping) -> Tables:
    """The sweep over δ, from where each measure is marked, and single designs."""
    sweep = [
        [
            f"{row.delta:g}", number(row.volume_change, "3p"), number(row.V1_change_median, "3p"),
            number(row.V1_change_largest, "3p"), *(number(change, "3p") for change in row.sigma_min_change),
        ]
        for row in n.sweep
        if row.delta in n.shown
    ]  # fmt: skip
    folds = [f"smallest stable σ at λ = {lam:g}" for lam in n.folds_at_lam]
    marked = [[name, from_delta(at), n.verdict_by_measure[name]] for name, at in n.marked_from.items()]
    single = []
    for d in n.single_designs:
        by_delta = {row.delta: row for row in d.sweep}
        cells = [short_interval(d.without), *(short_interval(by_delta[delta]) for delta in n.shown)]
        last = from_delta(d.marked_from) if d.without.V1 else "–"
        single.append([f"{d.lam:g}", f"{d.sigma:g}", *cells, last])
    values = [f"δ = {delta:g}" for delta in (0, *n.shown)]
    return {
        "sweep": table(["δ [kg m²/s]", "volume", "V1, median", "V1, largest change", *folds], sweep),
        "marked": table(["measure", "marked from δ [kg m²/s]", "verdict by it alone"], marked),
        "single": table(["λ [rad]", "σ", *values, "V1 marked from δ"], single),
    }


def readings_tables(s: Readings) -> Tables:
    """How many readings give which verdict, and each reading."""
    counts = [
        [f"conclusion {key}", *(str(count[verdict]) for verdict in VERDICTS)]
        for key, count in s.counts.items()
    ]
    rows = [
        [
            row.reading, "yes" if row.rigid else "no", number(row.shares.some, "3p"),
            number(row.shares.unbounded, "3p"), number(row.shares_wider_box.unbounded, "3p"),
            number(row.volume, ".4f"), *(_SIGNS[verdict] for verdict in row.verdicts.values()),
        ]
        for row in s.readings
    ]  # fmt: skip
    head = ["reading", "rigid", "stable", "unbounded", "unbounded, wider box", "volume [rad m/s]"]
    firm = [key for key, count in s.counts.items() if max(count.values()) == s.number]
    exceptions = [row.reading for row in s.readings if row.verdicts["1"] != FAILS]
    return {
        "counts": table(["", *VERDICTS], counts),
        "readings": table([*head, *s.counts], rows),
        "firm": listed(firm) or "none",
        "open": listed([key for key in s.counts if key not in firm]) or "none",
        "exceptions": "; ".join(exceptions) or "none",
    }
