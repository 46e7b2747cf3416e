"""Machines of several that have no design: they are left out and told of, and the others are not."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import Any

import click
from bikestab_cli.several import Chosen
from bikestab_cli.streams import tell_error

_DESIGN = ("lam", "sigma", "head_angle_deg", "trail", "offset")


def lacking(machines: Sequence[Chosen], given: Collection[str]) -> list[str]:
    """What each lacks of a tilt and a trail where parameters of these names are ``given``; empty: nothing.

    One machine alone lacks nothing, for the library tells of it. Where none has a design it is an error.
    """
    if len(machines) == 1:
        return [""]
    lacks = [_lacks(machine, given) for machine in machines]
    if all(lacks):
        raise click.UsageError(_advice(machines, lacks), click.get_current_context())
    return lacks


def _lacks(machine: Chosen, given: Collection[str]) -> str:
    from bikestab.variants import fixed_by

    bicycle = machine.bicycle
    fixed = fixed_by(bicycle, given)
    own = (("tilt", bicycle.lam), ("trail", bicycle.sigma))
    words = [word for word, value in own if value is None and word not in fixed]
    return f"no {' and '.join(words)} of its own" if words else ""


def with_design(machines: Sequence[Chosen], lacks: Sequence[str]) -> list[Chosen]:
    """The machines that lack nothing."""
    return [machine for machine, lack in zip(machines, lacks, strict=True) if not lack]


def record_without(machine: Chosen, lacks: str) -> dict[str, Any]:
    """What JSON has of a machine without a design."""
    return {**dict.fromkeys(_DESIGN), "intervals": [], "error": _advice([machine], [lacks])}


def told_without(machines: Sequence[Chosen], lacks: Sequence[str]) -> list[str]:
    """A line for each machine without a design."""
    return [f"{machine.words}: {lack}" for machine, lack in zip(machines, lacks, strict=True) if lack]


def results_of_all(
    machines: Sequence[Chosen], lacks: Sequence[str], results: Iterable[list[dict[str, Any]]]
) -> list[list[dict[str, Any]]]:
    """Results of machines with a design, and in between what JSON has of those without one."""
    each = iter(results)
    return [
        [record_without(machine, lack)] if lack else next(each)
        for machine, lack in zip(machines, lacks, strict=True)
    ]


def end_of_all(machines: Sequence[Chosen], lacks: Sequence[str]) -> None:
    """Tell of those that were left out, and end with exit code 2 if there are some."""
    left_out = [(machine, lack) for machine, lack in zip(machines, lacks, strict=True) if lack]
    if left_out:
        tell_error(_advice(*zip(*left_out, strict=True)))
        click.get_current_context().exit(2)


def _advice(machines: Sequence[Chosen], lacks: Sequence[str]) -> str:
    """Why machines are left out, and what to do."""
    missing = [word for word in ("tilt", "trail") if any(word in each for each in lacks)]
    has = f"have no {' and '.join(missing)} of their own" if len(machines) > 1 else f"has {lacks[0]}"
    options = [option for option, word in (("--lam", "tilt"), ("--sigma", "trail")) if word in missing]
    words = ", ".join(machine.words for machine in machines)
    return f"{words} {has}: give {' and '.join(options)}, of all machines then, or files with their own"
