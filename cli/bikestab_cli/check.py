"""bikestab check: whether the expectations of configs hold."""

from __future__ import annotations

import math
from contextlib import suppress
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from bikestab_cli.options import FILE, NAME, check_files, json_option, of_file
from bikestab_cli.output import DESIGN_HEAD, certain, design_columns, print_json, table, tell_file
from bikestab_cli.streams import tell_error

from bikestab.errors import BikestabError, InputError

if TYPE_CHECKING:
    from bikestab.config.expectations import Outcome
    from bikestab.export.junit import Suite


class Checked(NamedTuple):
    """A config by its file's name: what was found of it, or why nothing was, and how many seconds it took."""

    name: str
    bicycle: str
    model: str
    outcomes: list[Outcome]
    error: BikestabError | None
    seconds: float


@click.command("check")
@click.argument("configs", type=NAME, nargs=-1, required=True, metavar="CONFIG...")
@click.option("--junit", type=FILE, metavar="FILE", help="Write the results as JUnit XML, for CI servers.")
@json_option
def command(configs: tuple[str, ...], junit: str | None, as_json: bool) -> None:
    """Compare what configs expect with the exact speeds.

    For CI. Reads their 'expect' entries; needs no scan, and no grid in the file: only 'bicycle' and 'expect'.
    An entry with V1 and/or V2 holds if one of the stable intervals has these ends within 'within', a speed
    or per cent of it ('1%'); 'stable: never' if there is none. Without lam and sigma it is of the bicycle's
    own design; any other parameters, such as mB: 85 or delta: 1, may have values of their own.

    Every file is looked at. Exit code 0 if all hold, 1 if one does not, 2 if a file cannot be used.

    \b
    Examples:
      bikestab check configs/dikarev1981.yaml configs/meijaard2007.yaml
      bikestab check configs/quick.yaml configs/sharp1971.yaml --junit results.xml
      bikestab check configs/quick.yaml --json
    """
    check_files(junit)
    for name in configs:
        if configs.count(name) > 1:
            raise click.UsageError(f"{name} is given twice", click.get_current_context())
    checked = [_checked(name) for name in configs]
    if junit:
        from bikestab.export.junit import save_junit

        save_junit([_suite(each) for each in checked], junit)
    failed = sum(not outcome.holds for each in checked for outcome in each.outcomes)
    number = sum(len(each.outcomes) for each in checked)
    with suppress(BrokenPipeError):  # the exit code is wanted also by those who read no more
        if as_json:
            results = [record for each in checked for record in _records(each)]
            print_json({"results": results, **({"files": {"junit": junit}} if junit else {})})
        else:
            if number:
                click.echo(_table(checked))
            if junit:
                tell_file(junit)
    codes = [0, *(2 if isinstance(each.error, InputError) else 3 for each in checked if each.error)]
    for each in checked:
        if each.error:
            tell_error(str(each.error))
    if failed:
        click.echo(f"{failed} of {number} expectations failed", err=True)
    click.get_current_context().exit(max(*codes, 1 if failed else 0))


def _checked(name: str) -> Checked:
    from bikestab.config.expectations import outcomes
    from bikestab.config.file import load_checked

    start = perf_counter()
    try:
        with of_file(name):
            config = load_checked(name)
            found = outcomes(config)
            return Checked(name, config.machine.name, config.model, found, None, perf_counter() - start)
    except BikestabError as error:
        return Checked(name, "", "", [], error, perf_counter() - start)


def _table(checked: list[Checked]) -> str:
    lam, sigma, offset = DESIGN_HEAD
    rows = []
    for each in checked:
        rows += [_row(each.name, outcome) for outcome in each.outcomes]
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
    return [f"{name} = {value:.6g}" for name, value in (outcome.expected.model_extra or {}).items()]


def _text(V: float | None) -> str:
    return "any" if V is None else "unbounded" if math.isinf(V) else f"{V:.13g}"


def _within(tolerance: float | str) -> str:
    return tolerance if isinstance(tolerance, str) else f"{tolerance:g}"


def _records(checked: Checked) -> list[dict[str, Any]]:
    if checked.error:
        return [{"config": checked.name, "error": str(checked.error)}]
    whose = {"config": checked.name, "bicycle": checked.bicycle, "model": checked.model}
    return [
        {
            **whose, **_over(outcome), **outcome.design, "expected": _expected(outcome),
            "intervals": outcome.found, "holds": outcome.holds,
        }
        for outcome in checked.outcomes
    ]  # fmt: skip


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


def _problem(outcome: Outcome) -> str:
    """What is wrong: the ends of the nearest interval that are not as expected; nothing where all is well."""
    from bikestab.config.expectations import missed

    expected, found = outcome.expected, outcome.found
    if outcome.holds:
        return ""
    if expected.stable:
        return "stable speeds were found, and none expected"
    if not found:
        return "no stable speed was found"
    nearest = min(
        (missed(expected, each) for each in found),
        key=lambda ends: sum(abs(V - wanted) for _, V, wanted in ends),
    )
    within = _within(expected.within)
    return "; ".join(
        f"{name} is {_text(V)}, not {_text(wanted)} within {within}{_apart(V - wanted, wanted)}"
        for name, V, wanted in nearest
    )


def _apart(difference: float, wanted: float) -> str:
    share = f", {difference / wanted:+.2%}" if wanted else ""
    return f": {difference:+.4g} m/s{share}" if math.isfinite(difference) else ""


def _suite(checked: Checked) -> Suite:
    from bikestab.export.junit import Case, Suite

    if checked.error:
        unusable = Case("config", "cannot be used", str(checked.error), checked.seconds, True)
        return Suite(checked.name, [unusable], checked.seconds)
    cases = []
    for number, outcome in enumerate(checked.outcomes):
        _, lam, sigma, wanted, found, _ = (cell.replace("\n", " ") for cell in _row("", outcome))
        others = _others(outcome)
        design = ", ".join([f"lam {lam.split()[0]}", f"sigma {sigma.split()[0]}", *others])
        text = f"expected [m/s]: {wanted}\nfound [m/s]: {found}"
        text = "\n".join([f"with {', '.join(others)}", text]) if others else text
        cases.append(Case(f"expect[{number}]: {design}", _problem(outcome), text, outcome.seconds))
    return Suite(checked.name, cases, checked.seconds)
