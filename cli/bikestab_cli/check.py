"""bikestab check: whether the expectations of configs hold."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import TYPE_CHECKING

import click
from bikestab_cli.options import table

from bikestab.errors import InputError

if TYPE_CHECKING:
    from bikestab.config.scanconfig import Expectation, ScanConfig


@click.command("check")
@click.argument("configs", nargs=-1, required=True, metavar="CONFIG...")
def command(configs: tuple[str, ...]) -> None:
    """Compare what configs expect with the exact speeds.

    For CI. Reads their 'expect' entries; needs no scan. Exit code 0 if all hold, 1 if one does not. An
    entry with V1 and/or V2 holds if one of the stable intervals has these ends within 'within' m/s;
    'stable: never' if there is none.

    \b
    Example:
      bikestab check configs/dikarev1981.yaml configs/meijaard2007.yaml
    """
    from bikestab.config.file import load_config

    rows, failed = [], 0
    for name in configs:
        config = load_config(name)
        if not config.expect:
            raise InputError("has no expectations", place=name, hint="add 'expect:', see 'bikestab init'")
        for i, expectation in enumerate(config.expect):
            found, holds = _compare(name, config, expectation, i)
            failed += not holds
            rows.append([name, *found, "holds" if holds else "FAILED"])
    with suppress(BrokenPipeError):  # the exit code is wanted also by those who read no more
        click.echo(table(["config", "lam", "sigma", "expected [m/s]", "found [m/s]", ""], rows))
    if failed:
        click.echo(f"{failed} of {len(rows)} expectations failed", err=True)
        click.get_current_context().exit(1)


def _compare(name: str, config: ScanConfig, expected: Expectation, i: int) -> tuple[list[str], bool]:
    from bikestab.model import characteristic_table
    from bikestab.speeds import intervals_of

    lam = config.machine.lam if expected.lam is None else expected.lam
    sigma = config.machine.sigma if expected.sigma is None else expected.sigma
    if lam is None or sigma is None:
        raise InputError(
            f"the bicycle {config.machine.name!r} has no own {'lam' if lam is None else 'sigma'}",
            key=("expect", i), place=name, hint="give lam and sigma in the entry",
        )  # fmt: skip
    intervals = intervals_of(characteristic_table(config.machine, lam, sigma, model=config.model))
    found = list(zip(intervals.V1, intervals.V2, strict=True))[: int(intervals.number)]
    holds = not found
    if expected.stable is None:
        holds = any(
            _near(V1, expected.V1, expected.within) and _near(V2, expected.V2, expected.within)
            for V1, V2 in found
        )
    wanted = "never" if expected.stable else f"{_text(expected.V1)} ... {_text(expected.V2)}"
    shown = ", ".join(f"{_text(V1)} ... {_text(V2)}" for V1, V2 in found) or "never"
    return [f"{lam:.6g}", f"{sigma:.6g}", wanted, shown], holds


def _near(found: float, wanted: float | None, within: float) -> bool:
    return wanted is None or found == wanted or abs(found - wanted) <= within


def _text(V: float | None) -> str:
    return "any" if V is None else "unbounded" if math.isinf(V) else f"{V:.13g}"
