"""The option --verify of ``certify``: a certificate before the checker."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from math import prod
from typing import Any

import click
from bikestab_cli.certify_words import told_verified
from bikestab_cli.output import print_json
from bikestab_cli.progress import progress

from bikestab.errors import InputError

MOST_BYTES = 50_000_000  # of a certificate, whose check would take weeks
LONG = 200  # blocks; their check is announced


def verify_certificate(name: str, quiet: bool, as_json: bool) -> None:
    """Check a certificate, and tell; the exit code is 1 where it does not hold."""
    from bikestab.formats.kinds import expected

    with expected("certificate", name):
        _verify(name, quiet, as_json)


def _verify(name: str, quiet: bool, as_json: bool) -> None:
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
            checked = check(certificate, lambda done: show(done, cells))
        record = {"file": name, "holds": True, "reason": "", **_proved(certificate)}
        if as_json:
            print_json(record)
        else:
            click.echo(told_verified(record, checked))
    except Refuted as error:
        click.echo(f"{name}: {error}", err=True)
        if as_json:
            print_json({"file": name, "holds": False, "reason": str(error)})
        click.get_current_context().exit(1)
    except (TypeError, LookupError, AttributeError, RecursionError, OverflowError, ValueError):
        hint = "'bikestab certify ... -o FILE' writes one"
        raise InputError("is no certificate of bikestab", place=name, hint=hint) from None


def _proved(certificate: Mapping[str, Any]) -> dict[str, Any]:
    """What the blocks of a certificate that holds say of its machine and box; else ValueError."""
    import numpy as np

    from bikestab.certify.proof import cells_of, fractions_of, verdict_of
    from bikestab.certify.search import Decided

    edges = [np.array([float.fromhex(text) for text in axis]) for axis in certificate["edges"]]
    shape = tuple(len(axis) - 1 for axis in edges)
    blocks = np.array([block for block, _ in certificate["blocks"]], dtype=np.int64).reshape(
        -1, len(shape), 2
    )
    verdicts = np.array([verdict for _, verdict in certificate["blocks"]], dtype=np.uint8)
    decided = Decided(shape, blocks, verdicts, ())
    cells = cells_of(decided)
    with np.errstate(all="ignore"):
        undecided, stable, unstable = fractions_of(cells, edges)
    if not math.isfinite(undecided + stable + unstable):
        raise ValueError("a box that is too large")
    names = ("lam", "sigma", "V", *certificate["varied"])
    unused = ("c",) if certificate["notation"] == "four bodies" else ()
    numbers = {"g": (9.81).hex(), "delta": (0.0).hex(), **certificate["machine"]}
    return {
        "model": certificate["model"],
        "notation": certificate["notation"],
        "machine": {
            name: float.fromhex(text) for name, text in numbers.items() if name not in (*names, *unused)
        },
        "box": {name: [float(e[0]), float(e[-1])] for name, e in zip(names, edges, strict=True)},
        "cells": list(cells.shape),
        "blocks": len(blocks),
        "verdict": verdict_of(decided.on_cells()),
        "proved_stable": stable,
        "proved_unstable": unstable,
        "undecided": undecided,
    }
