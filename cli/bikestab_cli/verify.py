"""The option --verify of ``certify``: a certificate before the checker."""

from __future__ import annotations

import json
from math import prod

import click
from bikestab_cli.progress import progress

from bikestab.errors import InputError

MOST_BYTES = 50_000_000  # of a certificate, whose check would take weeks
LONG = 200  # blocks; their check is announced


def verify_certificate(name: str, quiet: bool) -> None:
    """Check a certificate, and tell; the exit code is 1 where it does not hold."""
    from bikestab.formats.kinds import expected

    with expected("certificate", name):
        _verify(name, quiet)


def _verify(name: str, quiet: bool) -> None:
    from bikestab.certify.checker import Refuted, check
    from bikestab.texts import read_text

    text = read_text(name, MOST_BYTES)
    try:
        certificate = json.loads(text)
        if certificate["format"] != "bikestab certificate 2":
            raise ValueError
        number, cells = len(certificate["blocks"]), prod(len(axis) - 1 for axis in certificate["edges"])
        if number > LONG:
            click.echo(f"note: {name}: {number} blocks, 0.05 to 5 s each", err=True)
        with progress("verify", quiet) as show:
            show(0, cells)
            told = check(certificate, lambda done: show(done, cells))
        click.echo(f"{name}: {told}")
    except Refuted as error:
        click.echo(f"{name}: {error}", err=True)
        click.get_current_context().exit(1)
    except (TypeError, LookupError, AttributeError, RecursionError, OverflowError, ValueError):
        hint = "'bikestab certify ... -o FILE' writes one"
        raise InputError("is no certificate of bikestab", place=name, hint=hint) from None
