"""What parameters move of each of several machines, and how far their stable speeds are known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from bikestab_cli.chosen import Given, design_chosen
from bikestab_cli.options import tell_once, tell_which, told_as_options
from bikestab_cli.several import Chosen

if TYPE_CHECKING:
    from bikestab.design.sensitivity import Hold, Sensitivity
    from bikestab.design.spread import Spread
    from bikestab.model import Model
    from bikestab.region.first_sigma import FirstSigma


class Found(NamedTuple):
    """A machine's sensitivities, its smallest stable σ, what deviations leave, and all of it as a record."""

    machine: Chosen
    of: Sensitivity
    first: FirstSigma
    spread: Spread | None
    record: dict[str, Any]

    def result(self) -> dict[str, Any]:
        """What is of one result of JSON; the rest is said of all."""
        return {key: value for key, value in self.record.items() if key not in ("bicycle", "model", "delta")}


def found_of(
    machines: Sequence[Chosen], given: Given, hold: Hold | None, model: Model, deviations: Mapping[str, float]
) -> list[Found]:
    """The sensitivities of machines at their designs, in the paper's notation where theirs differ."""
    from bikestab.design.effects import sensitivity_record
    from bikestab.design.sensitivity import sensitivity, two_parts
    from bikestab.design.spread import own_spread, plain
    from bikestab.region.first_sigma import first_sigma, first_sigma_record

    bicycles = [each.bicycle for each in machines]
    if len({bicycle.bodies is None for bicycle in bicycles}) > 1:
        # c is the trail in one notation, and the wheelbase in the other
        bicycles = [two_parts(bicycle) for bicycle in bicycles]
    with told_as_options():
        found = [
            sensitivity(bicycle, *design_chosen(bicycle, given), hold=hold, model=model)
            for bicycle in bicycles
        ]
        firsts = [first_sigma(each.bicycle, each.lam, each.sigma, model=model) for each in found]
        _tell(bicycles, deviations)
        spreads = [own_spread(each, of_file=True, given=deviations) for each in found]
    records = [
        {**sensitivity_record(each), "sigma_min": first_sigma_record(first), "spread": known and plain(known)}
        for each, first, known in zip(found, firsts, spreads, strict=True)
    ]
    return [Found(*each) for each in zip(machines, found, firsts, spreads, records, strict=True)]


def _tell(bicycles: Sequence[Any], deviations: Mapping[str, float]) -> None:
    """Notes and warnings about standard deviations."""
    from bikestab_cli.spread_words import tell_rider

    from bikestab.plausible import deviation_doubts

    for bicycle in bicycles:
        tell_which(bicycle, deviations)
        tell_rider(bicycle, {**bicycle.deviations, **deviations})
        for text in deviation_doubts(bicycle, deviations):
            tell_once(f"warning: {bicycle.name}: {text}")
