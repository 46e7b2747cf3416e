"""report.md from the data of report.json: a template in words, and tables; no number comes from elsewhere."""

from __future__ import annotations

import string
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bikestab.paper1981.claims import FAILS, HOLDS, LIMITS

Numbers = dict[str, Any]
TEMPLATE = Path(__file__).with_name("reproduction.md")
_SHORT = {HOLDS: "+", LIMITS: "±", FAILS: "−"}
_MODELS = {  # row of the table that compares them: key and format
    "volume of the stable region [rad m/s]": ("volume", ".6f"),
    "its share of the box": ("volume_share", "3p"),
    "designs with p0 > 0 at some speed": ("p0_somewhere", "3p"),
    "designs with p0 > 0 at all high speeds": ("p0_rising", "3p"),
    "designs with p0 > 0 and p1 > 0 at the same speed": ("p0_and_p1", "3p"),
    "lowest speed with p1 > 0 [m/s]": ("p1_lowest", ".3f"),
    "designs with a stable speed, in a box twice as long and wide": ("stable_in_wider_box", "3p"),
}
_KEYS = {
    "1": "no upper limit for {shares[unbounded]:3p} of the designs, {unbounded_of_stable:3p} of the stable",
    "2": "right from σ = {sigma_from:.3f} on, to an optimum λ; no stability below {limits[lam_min]:.4f} rad",
    "3": "widest interval at λ = {optima[0][lam]:.3f} rad, fastest decay at {optima[1][lam]:.3f} rad",
    "4": "V2 never moves, the region does, markedly from δ = {judged_by[marked_from]:.3f} kg m²/s on",
}
_SHARES = {
    "no stable speed": "none", "bounded intervals only": "finite", "an unbounded interval": "unbounded",
    "more than one interval": "multiple",
}  # fmt: skip


class _Words(string.Formatter):
    """Formats numbers with a true minus, ``3p`` as percent with three significant digits, None as –."""

    def format_field(self, value: Any, format_spec: str) -> str:
        if value is None:
            return "–"
        if isinstance(value, str):
            return value
        if format_spec.endswith("p"):
            return f"{100 * value:.{format_spec[:-1]}g} %".replace("-", "−")
        return format(value, format_spec).replace("-", "−")

    def get_field(self, field_name: str, args: Any, kwargs: Any) -> Any:
        """As usual, but what is inside of nothing is nothing: a report without it still reads."""
        try:
            return super().get_field(field_name, args, kwargs)
        except (IndexError, TypeError):
            return None, field_name


def rendered(data: Numbers) -> str:
    """The report in Markdown."""
    conclusions = {int(number): part for number, part in data["conclusions"].items()}
    numbers = {f"n{number}": part["numbers"] for number, part in conclusions.items()}
    words = data | numbers | {"conclusions": conclusions, "tables": _tables(data)}
    return _Words().vformat(TEMPLATE.read_text("utf-8"), (), words)


def key_number(data: Numbers, number: str) -> str:
    """The numbers that decide about a conclusion, in a few words."""
    n = data["conclusions"][number]["numbers"]
    return _Words().vformat(_KEYS[number], (), n)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def _tables(data: Numbers) -> dict[str, str]:
    r = data["refinement"]
    models = [r["models"][name] for name in ("refined", "unrefined")]
    rows = [[words, *(_f(m[key], spec) for m in models)] for words, (key, spec) in _MODELS.items()]
    rows.insert(
        2, ["designs with a stable speed, in the box", *(_f(m["shares"]["some"], "3p") for m in models)]
    )
    rows.insert(3, ["S [kg m]", *(f"{_f(m['S'][0], '.3f')} … {_f(m['S'][1], '.3f')}" for m in models)])
    damped = f"the same with δ = {models[0]['damper']:g} kg m²/s"
    rows.append([damped, *(_f(m["stable_with_damper"], "3p") for m in models)])
    verdicts = [
        [number, part["claim"], f"**{part['verdict']}**", key_number(data, number)]
        for number, part in data["conclusions"].items()
    ]
    designs = [
        [f"{row['lam']:g}", f"{row['sigma']:g}", _intervals(row["intervals"])]
        for row in data["figure3"]["table"]
    ]
    return {
        "verdicts": table(["", "claim of the paper", "verdict", "key numbers"], verdicts),
        "parameters": ", ".join(f"{name} = {value:g}" for name, value in data["bicycle"].items()),
        "warnings": "; ".join(data["warnings"]) or "no",
        "family_lam": _listed(data["figure3"]["lam"]),
        "family_sigma": _listed(data["figure3"]["sigma"]),
        "designs": table(["λ [rad]", "σ", "stable speeds [m/s]"], designs),
        "changed_coefficients": _listed(r["changed_coefficients"]),
        "changed_terms": _listed(r["changed_terms"]),
        "models": table(["", "refined", "unrefined"], rows),
        **_first(data["conclusions"]["1"]["numbers"]),
        **_second(data["conclusions"]["2"]["numbers"]),
        **_third(data["conclusions"]["3"]["numbers"]),
        **_fourth(data["conclusions"]["4"]["numbers"]),
        **_readings(data["sensitivity"]),
    }


def _first(n: Numbers) -> dict[str, str]:
    boxes = (n["shares"], n["shares_wider_box"])
    shares = [[words, *(_f(box[key], "4p") for box in boxes)] for words, key in _SHARES.items()]
    examples = [
        [f"{e['lam']:g}", f"{e['sigma']:g}", _intervals(e["intervals"]), V, ", ".join(map(_complex, values))]
        for e in n["counterexamples"]
        for V, values in e["eigenvalues"].items()
    ]
    curves = [
        [f"*{c['name']}*", *(_point(c[end]) for end in ("from", "to"))] for c in n["curves_at_infinity"]
    ]
    return {
        "shares": table(["", "the paper's box", "wider box"], shares),
        "counterexamples": table(
            ["λ [rad]", "σ", "stable speeds [m/s]", "at V [m/s]", "eigenvalues"], examples
        ),
        "curves": table(["curve", "from", "to"], curves),
        "two_intervals": " and ".join(_interval(found) for found in n["two_intervals"]["intervals"]),
    }


def _second(n: Numbers) -> dict[str, str]:
    at_sigma = [
        [
            f"{row['sigma']:g}", _ranges(row["stable_lam"]), _ranges(row["unbounded_lam"]),
            _f(row["best_lam"], ".4f"), _f(row["width"], ".3f"), _f(row["width_at_largest_lam"], ".3f"),
        ]
        for row in n["lines"]["at_sigma"]
    ]  # fmt: skip
    at_lam = [
        [
            f"{row['lam']:g}",
            _ranges(row["stable_sigma"]),
            _f(row["best_sigma"], ".4f"),
            _f(row["width"], ".3f"),
        ]
        for row in n["lines"]["at_lam"]
    ]
    head = ["σ", "stable for λ [rad]", "no upper limit for λ [rad]", "widest at λ [rad]", "width there [m/s]"]
    return {
        "widths_at_sigma": table([*head, "width at the largest λ [m/s]"], at_sigma),
        "widths_at_lam": table(["λ [rad]", "stable for σ", "widest at σ", "width there [m/s]"], at_lam),
    }


def _third(n: Numbers) -> dict[str, str]:
    rows = [
        [
            d["criterion"], _f(d["lam"], ".4f"), _f(d["sigma"], ".4f"), _interval(d), _f(d["width"], ".3f"),
            _f(d["growth_rate"], ".4f"), _f(d["V"], ".3f"),
            d["at"].replace("lam", "λ").replace("sigma", "σ"),
        ]
        for d in n["optima"]
    ]  # fmt: skip
    head = ["margin", "λ [rad]", "σ", "stable speeds [m/s]", "width [m/s]"]
    return {"optima": table([*head, "growth rate [1/s]", "at V [m/s]", "where"], rows)}


def _fourth(n: Numbers) -> dict[str, str]:
    keys = ("volume_change", "V1_change_median", "V1_change_largest")
    sweep = [
        [f"{row['delta']:g}", *(_f(v, "3p") for v in (*(row[key] for key in keys), *row["sigma_min_change"]))]
        for row in n["sweep"]
        if row["delta"] in n["shown"]
    ]  # fmt: skip
    folds = [f"smallest stable σ at λ = {lam:g}" for lam in n["folds_at_lam"]]
    marked = [[name, _from(at), n["verdict_by_measure"][name]] for name, at in n["marked_from"].items()]
    single = []
    for d in n["single_designs"]:
        rows = {row["delta"]: row for row in d["sweep"]}
        cells = [_short_interval(row) for row in (d["without"], *(rows[delta] for delta in n["shown"]))]
        last = _from(d["marked_from"]) if d["without"]["V1"] else "–"
        single.append([f"{d['lam']:g}", f"{d['sigma']:g}", *cells, last])
    values = [f"δ = {delta:g}" for delta in (0, *n["shown"])]
    return {
        "sweep": table(["δ [kg m²/s]", "volume", "V1, median", "V1, largest change", *folds], sweep),
        "marked": table(["measure", "marked from δ [kg m²/s]", "verdict by it alone"], marked),
        "single": table(["λ [rad]", "σ", *values, "V1 marked from δ"], single),
    }


def _readings(s: Numbers) -> dict[str, str]:
    counts = [
        [f"conclusion {number}", *(str(found[v]) for v in _SHORT)] for number, found in s["counts"].items()
    ]
    rows = [
        [
            row["reading"], "yes" if row["rigid"] else "no", _f(row["shares"]["some"], "3p"),
            _f(row["shares"]["unbounded"], "3p"), _f(row["shares_wider_box"]["unbounded"], "3p"),
            _f(row["volume"], ".4f"), *(_SHORT[verdict] for verdict in row["verdicts"].values()),
        ]
        for row in s["readings"]
    ]  # fmt: skip
    head = ["reading", "rigid", "stable", "unbounded", "unbounded, wider box", "volume [rad m/s]"]
    firm = [number for number, found in s["counts"].items() if max(found.values()) == s["number"]]
    exceptions = [row["reading"] for row in s["readings"] if row["verdicts"]["1"] != FAILS]
    return {
        "counts": table(["", *_SHORT], counts),
        "readings": table([*head, *s["counts"]], rows),
        "firm": _listed(firm) or "none",
        "open": _listed([number for number in s["counts"] if number not in firm]) or "none",
        "exceptions": "; ".join(exceptions) or "none",
    }


def _f(value: float | None, spec: str) -> str:
    return _Words().format_field(value, spec)


def _listed(values: Sequence[Any]) -> str:
    return ", ".join(value if isinstance(value, str) else f"{value:g}" for value in values)


def _from(at: float | None) -> str:
    return "never" if at is None else f"{at:.3g}"


def _point(end: Numbers) -> str:
    place = "the edge of the box" if end["at"] == "box" else f"on *{end['at']}*"
    return f"({_f(end['lam'], '.7f')}, {_f(end['sigma'], '.7f')}), {place}"


def _ranges(ranges: Sequence[Sequence[float]]) -> str:
    return ", ".join(f"{low:.6g} … {high:.6g}" for low, high in ranges) or "none"


def _intervals(found: Sequence[Numbers]) -> str:
    return "; ".join(map(_interval, found)) or "none"


def _interval(found: Numbers) -> str:
    upper = "unbounded" if found["V2"] is None else f"{_f(found['V2'], '.4f')} ({found['upper']})"
    return f"{_f(found['V1'], '.4f')} ({found['lower']}) … {upper}"


def _short_interval(row: Numbers) -> str:
    if row["V1"] is None:
        return "none"
    return f"{_f(row['V1'], '.3f')} … {'unbounded' if row['V2'] is None else _f(row['V2'], '.3f')}"


def _complex(value: Sequence[float]) -> str:
    real, imaginary = value
    sign = "+" if imaginary > 0 else "−"
    return _f(real, ".4g") + (f" {sign} {abs(imaginary):.4g} i" if imaginary else "")
