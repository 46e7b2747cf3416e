"""bikestab check: whether the expectations of configs hold."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import TYPE_CHECKING

import click
from bikestab_cli.options import NAME, of_file
from bikestab_cli.output import certain, table

if TYPE_CHECKING:
    from bikestab.config.expectations import Outcome
    from bikestab.records import Interval


@click.command("check")
@click.argument("configs", type=NAME, nargs=-1, required=True, metavar="CONFIG...")
def command(configs: tuple[str, ...]) -> None:
    """Compare what configs expect with the exact speeds.

    For CI. Reads their 'expect' entries; needs no scan. Exit code 0 if all hold, 1 if one does not. An
    entry with V1 and/or V2 holds if one of the stable intervals has these ends within 'within' m/s;
    'stable: never' if there is none.

    \b
    Example:
      bikestab check configs/dikarev1981.yaml configs/meijaard2007.yaml
    """
    from bikestab.config.expectations import outcomes
    from bikestab.config.file import load_config

    rows, failed = [], 0
    for name in configs:
        with of_file(name):
            found = outcomes(load_config(name))
        failed += sum(not outcome.holds for outcome in found)
        rows += [[name, *_row(outcome)] for outcome in found]
    with suppress(BrokenPipeError):  # the exit code is wanted also by those who read no more
        click.echo(table(["config", "lam", "sigma", "expected [m/s]", "found [m/s]", ""], rows))
    if failed:
        click.echo(f"{failed} of {len(rows)} expectations failed", err=True)
        click.get_current_context().exit(1)


def _row(outcome: Outcome) -> list[str]:
    expected = outcome.expected
    wanted = "never" if expected.stable else f"{_text(expected.V1)} ... {_text(expected.V2)}"
    found = ", ".join(map(_found, outcome.found)) or "never"
    verdict = "holds" if outcome.holds else "FAILED"
    return [f"{outcome.lam:.6g}", f"{outcome.sigma:.6g}", wanted, found, verdict]


def _found(interval: Interval) -> str:
    V2 = "unbounded"
    if interval["V2"] is not None:
        V2 = certain(interval["V2"], interval["V2_error"], 13, "g")
    return f"{certain(interval['V1'], interval['V1_error'], 13, 'g')} ... {V2}"


def _text(V: float | None) -> str:
    return "any" if V is None else "unbounded" if math.isinf(V) else f"{V:.13g}"
