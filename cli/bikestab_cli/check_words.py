"""What ``check`` found → the words of its table, its failures, its JSON and its JUnit file."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from bikestab_cli.output import DESIGN_HEAD, certain, design_columns, prose, table

from bikestab.errors import BikestabError, InputError

if TYPE_CHECKING:
    from bikestab.config.checks import Entry
    from bikestab.config.expectations import Edge, Outcome
    from bikestab.export.junit import Case, Suite


class Checked(NamedTuple):
    """A config by its file's name: what was found of it, or why nothing was, and how many seconds it took."""

    name: str
    bicycle: str
    model: str
    entries: list[Entry]
    error: BikestabError | None
    seconds: float

    @property
    def outcomes(self) -> list[tuple[str, int, Outcome]]:
        """The expectations that can be used, with the name and the line of each."""
        return [
            (f"expect[{i}]", line, result)
            for i, (line, result) in enumerate(self.entries)
            if not isinstance(result, BikestabError)
        ]

    @property
    def unusable(self) -> list[BikestabError]:
        """Why the others cannot be used."""
        return [each.result for each in self.entries if isinstance(each.result, BikestabError)]

    @property
    def errors(self) -> list[BikestabError]:
        """Why the file, or some of its entries, cannot be used."""
        return [self.error] if self.error else self.unusable


def verdict(checked: Sequence[Checked]) -> tuple[int, str]:
    """How many expectations failed; and in words, where there were any, also what cannot be used."""
    holds = [outcome.holds for each in checked for _, _, outcome in each.outcomes]
    failed = holds.count(False)
    counts = (
        (sum(bool(each.error) for each in checked), "file", "files"),
        (sum(len(each.unusable) for each in checked), "entry", "entries"),
    )
    unusable = [f"{number} {one if number == 1 else many}" for number, one, many in counts if number]
    if not failed and not (holds and unusable):
        return failed, ""
    others = f", {' and '.join(unusable)} cannot be used" if unusable else ""
    return failed, f"{failed} of {len(holds)} expectations failed{others}"


def outcome_table(checked: list[Checked]) -> str:
    lam, sigma, offset = DESIGN_HEAD
    rows = []
    for each in checked:
        for i, (line, result) in enumerate(each.entries):
            if isinstance(result, BikestabError):
                rows.append([f"{each.name}\nline {line}: expect[{i}]", "", "", "", "", "ERROR"])
            else:
                rows.append(_row(each.name, result))
        if each.error:
            rows.append([each.name, "", "", "", "", "ERROR"])
    return table(["config", lam, sigma + offset, "expected\n[m/s]", "found\n[m/s]", ""], rows, fold=0)


def _row(name: str, outcome: Outcome) -> list[str]:
    expected = outcome.expected
    lam, sigma, offset = design_columns(outcome.design)
    wanted = f"{_text(expected.V1)}\n{_text(expected.V2)}\nwithin {_within(expected.within)}"
    found = []
    for interval in outcome.found:
        V2 = "unbounded"
        if interval["V2"] is not None:
            V2 = certain(interval["V2"], interval["V2_error"], 13, "g")
        found += [certain(interval["V1"], interval["V1_error"], 13, "g"), V2]
    verdict = "holds" if outcome.holds else "FAILED"
    return [
        "\n".join([name, *_others(outcome)]),
        lam,
        sigma + offset,
        expected.stable or wanted,
        "\n".join(found) or "never",
        verdict,
    ]


def _others(outcome: Outcome) -> list[str]:
    """The other parameters that have values of their own in an expectation."""
    units = {name: "" if unit == "1" else f" {unit}" for name, unit in outcome.units.items()}
    others = outcome.expected.model_extra or {}
    return [f"{name} = {value:.6g}{units[name]}" for name, value in others.items()]


def _text(V: float | None) -> str:
    return "any" if V is None else "unbounded" if math.isinf(V) else f"{V:.13g}"


def _within(tolerance: float | str) -> str:
    return tolerance if isinstance(tolerance, str) else f"{tolerance:g}"


def outcome_records(checked: Checked) -> list[dict[str, Any]]:
    if checked.error:
        return [{"config": checked.name, **_problem_record(checked.error)}]
    whose = {"config": checked.name, "bicycle": checked.bicycle, "model": checked.model}
    return [
        {**whose, "line": line, **_problem_record(result)} if isinstance(result, BikestabError) else
        {
            **whose, "line": line, **_over(result), **result.design, "expected": _expected(result),
            "intervals": result.found, "nearest": result.nearest,
            "edges": [_edge_record(edge) for edge in result.edges], "holds": result.holds,
            "problem": problem_of(result),
        }
        for line, result in checked.entries
    ]  # fmt: skip


def _problem_record(error: BikestabError) -> dict[str, Any]:
    return {"error": str(error), "mistakes": [str(each) for each in _mistakes(error)]}


def _mistakes(error: BikestabError) -> Sequence[BikestabError]:
    return error.mistakes if isinstance(error, InputError) else [error]


def _over(outcome: Outcome) -> dict[str, Any]:
    others = outcome.expected.model_extra
    return {"over": others} if others else {}


def _expected(outcome: Outcome) -> dict[str, Any]:
    """As it may stand in a config; what is not asked for is left out."""
    expected = outcome.expected
    if expected.stable:
        return {"stable": expected.stable}
    ends = {"V1": expected.V1, "V2": "unbounded" if math.inf == expected.V2 else expected.V2}
    return {**{name: V for name, V in ends.items() if V is not None}, "within": expected.within}


def failures(checked: Sequence[Checked]) -> list[str]:
    """Lines for each expectation that failed: which it is, what was found, and what was expected."""
    return [
        prose(f"{each.name}, line {line}: {entry}{_with(outcome)}: {problem_of(outcome)}")
        for each in checked
        for entry, line, outcome in each.outcomes
        if not outcome.holds
    ]


def _with(outcome: Outcome) -> str:
    others = _others(outcome)
    return f" ({', '.join(others)})" if others else ""


def problem_of(outcome: Outcome) -> str:
    """The ends of the nearest interval that are not as expected, by how much; nothing where all is well."""
    if outcome.holds:
        return ""
    if outcome.expected.stable:
        return f"stable speeds were found, and none expected: {_spans(outcome)}"
    if outcome.nearest is None:
        wanted = ", ".join(f"{edge.name} {_text(edge.expected)}" for edge in outcome.edges)
        return f"no stable speed was found, and {wanted} expected"
    missed = [_missed(edge, outcome.expected.within) for edge in outcome.edges if not edge.holds]
    others = len(outcome.found) - 1
    of = f" (nearest of {others + 1} intervals: {_spans(outcome)})" if others else ""
    return "; ".join(missed) + of


def _missed(edge: Edge, within: float | str) -> str:
    found = "unbounded" if edge.found is None else _text(edge.found)
    text = f"{edge.name} is {found}, not {_text(edge.expected)} within {_within(within)}"
    if (difference := edge.difference) is None:
        return text
    reach = f" ({edge.allowed:.4g} m/s)" if isinstance(within, str) else ""
    share = f", {difference / edge.expected:+.2%}" if edge.expected else ""
    return f"{text}{reach}: {difference:+.4g} m/s{share}"


def _spans(outcome: Outcome) -> str:
    """All intervals, in a few digits."""
    ends = ((each["V1"], math.inf if each["V2"] is None else each["V2"]) for each in outcome.found)
    texts = (f"{V1:.6g} ... " + ("unbounded" if math.isinf(V2) else f"{V2:.6g}") for V1, V2 in ends)
    return ", ".join(texts) + " m/s"


def _edge_record(edge: Edge) -> dict[str, Any]:
    """Unbounded is told in this word, and null is what was not found, or what is no number."""
    unbounded, difference = math.isinf(edge.expected), edge.difference
    return {
        "name": edge.name,
        "expected": "unbounded" if unbounded else edge.expected,
        "found": "unbounded" if edge.found is not None and math.isinf(edge.found) else edge.found,
        "difference": difference,
        "percent": None if difference is None or not edge.expected else 100 * difference / edge.expected,
        "tolerance": None if unbounded else edge.allowed,
        "within": edge.holds,
    }


def suite_of(checked: Checked) -> Suite:
    from bikestab.export.junit import Suite

    if checked.error:
        return Suite(
            checked.name, [_unusable_case("config", checked.error, checked.seconds)], checked.seconds
        )
    cases = [
        _unusable_case(f"expect[{i}]", result, 0.0) if isinstance(result, BikestabError)
        else _case(f"expect[{i}]", result, f"{checked.name}, line {line}")
        for i, (line, result) in enumerate(checked.entries)
    ]  # fmt: skip
    return Suite(checked.name, cases, checked.seconds)


def _unusable_case(name: str, error: BikestabError, seconds: float) -> Case:
    from bikestab.export.junit import Case

    message = str(error).replace("\n", "; ")
    return Case(name, message, "\n".join(map(str, _mistakes(error))), seconds, True)


def _case(name: str, outcome: Outcome, place: str) -> Case:
    from bikestab.export.junit import Case

    _, lam, sigma, wanted, found, _ = (cell.replace("\n", " ") for cell in _row("", outcome))
    others = _others(outcome)
    design = ", ".join([f"lam {lam.split()[0]}", f"sigma {sigma.split()[0]}", *others])
    text = f"expected [m/s]: {wanted}\nfound [m/s]: {found}\nat {place}"
    text = "\n".join([f"with {', '.join(others)}", text]) if others else text
    return Case(f"{name}: {design}", problem_of(outcome), text, outcome.seconds)
