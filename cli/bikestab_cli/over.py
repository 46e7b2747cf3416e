"""Parameters that --over varies: the one along the axis, machines with each value of the other, meanings."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import product

import click
from bikestab_cli.several import Chosen, digits_of

from bikestab.variants import parameter_of

Over = Mapping[str, Sequence[float]]


def along(over: Over) -> str:
    """The parameter with the most values: it is what the others have a curve each against."""
    return max(over, key=lambda name: len(over[name]))


def beside(machine: Chosen, over: Over, axis: str) -> list[tuple[dict[str, float], Chosen]]:
    """Every combination of the values of what is not the ``axis``, and the machine that it is set in.

    The machines have as many digits as tell all of their values apart.
    """
    others = {name: [*dict.fromkeys(values)] for name, values in over.items() if name != axis}
    digits = max(machine.digits, digits_of(others))
    found = [dict(zip(others, values, strict=True)) for values in product(*others.values())]
    return [(each, Chosen(machine.bicycle, {**machine.set, **each}, digits)) for each in found]


def curves_of(over: Over) -> int:
    """How many curves a picture of one machine has."""
    return math.prod(len({*over[name]}) for name in over if name != along(over))


def check_meanings(machines: Sequence[Chosen], over: Over) -> None:
    """Refuse names that are not the same quantity in all machines."""
    for name in over:
        meanings: dict[str, str] = {}
        for machine in machines:
            try:
                _, _, meaning, unit = parameter_of(machine.bicycle, name)
            except KeyError:
                return  # the library tells of it
            meanings.setdefault(f"{meaning} [{unit}]", machine.bicycle.name)
        if len(meanings) > 1:
            told = ", ".join(f"the {meaning} of {whose}" for meaning, whose in meanings.items())
            instead = "vary trail, sigma or offset" if name == "c" else "ask of one machine at a time"
            raise click.BadParameter(f"{name} is {told}: {instead}", param_hint="--over")
