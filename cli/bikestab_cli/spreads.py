"""How far designs' stable speeds are known, as --sd asks: notes and warnings told, and the spreads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click
from bikestab_cli.options import tell_once, tell_which, told_as_options
from bikestab_cli.several import Chosen, with_units

if TYPE_CHECKING:
    from bikestab.bicycle import Bicycle
    from bikestab.design.spread import Spread
    from bikestab.model import Model

MOST_SPREADS = 100  # designs at once
_NAMED = 5  # standard deviations in a picture


def spreads(
    bicycle: Bicycle,
    designs: Sequence[tuple[Bicycle, float, float]],
    model: Model,
    of_file: bool,
    given: dict[str, float],
) -> list[Spread]:
    """How far each design's stable speeds are known; none where no standard deviation is asked for.

    ``designs`` are machines, λ and σ: the ``bicycle``, or what it is with other values of some parameters.
    """
    if not (of_file or given):
        if any(sd > 0 for sd in bicycle.deviations.values()):
            text = "the file has standard deviations: --sd file tells what they leave of the digits"
            tell_once(f"note: {bicycle.name}: {text}")
        return []
    from bikestab_cli.spread_words import tell_rider

    from bikestab.design.sensitivity import sensitivity
    from bikestab.design.spread import own_spread
    from bikestab.plausible import deviation_doubts

    tell_which(bicycle, given)
    tell_rider(bicycle, {**(bicycle.deviations if of_file else {}), **given})
    for text in deviation_doubts(bicycle, given):
        tell_once(f"warning: {text}")
    if len(designs) > MOST_SPREADS:
        problem = f"--sd draws machines for each design, and {len(designs)} are too many"
        raise click.UsageError(f"{problem}; allowed: {MOST_SPREADS}", click.get_current_context())
    found = []
    with told_as_options():
        for machine, lam, sigma in designs:
            own = sensitivity(machine, lam, sigma, model=model)
            found.append(own_spread(own, of_file=of_file, given=given))
    if None in found:
        problem = f"the bicycle {bicycle.name!r} has no standard deviations in its file"
        raise click.BadParameter(f"{problem}; give some, for example --sd mB=1.5", param_hint="--sd")
    return [known for known in found if known]


def with_spreads(answers: Sequence[Mapping[str, Any]], known: Sequence[Spread]) -> list[dict[str, Any]]:
    """Records of designs with their spreads, where there are some."""
    from bikestab.design.spread import plain

    more = [{"spread": plain(spread)} for spread in known] or [{}] * len(answers)
    return [{**answer, **each} for answer, each in zip(answers, more, strict=True)]


def uncertain_words(machines: Sequence[Chosen], known: Sequence[Sequence[Spread]]) -> str:
    """The standard deviations that all spreads of a picture are of, or that they are many or differ."""
    every = [(m, spread["deviations"]) for m, own in zip(machines, known, strict=True) for spread in own[:1]]
    if not every:
        return ""
    machine, deviations = every[0]
    if any(own != deviations for _, own in every):
        return "each machine's own"
    if len(deviations) > _NAMED:
        return f"those of {len(deviations)} parameters"
    return with_units(Chosen(machine.bicycle, dict(deviations)))
