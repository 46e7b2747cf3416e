"""What a reader found in a file: parameters by name, their uncertainties, and what it did with the rest."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from typing import Any

from bikestab.errors import InputError, nearest
from bikestab.limits import require
from bikestab.units import quantity, units_in


@dataclass(frozen=True)
class Found:
    """The parameters in a file, in one of the notations, and where a mistake in one of them stands.

    ``deviations`` are standard deviations of parameters, in their units; ``correlations`` those of pairs of
    them, as far as they are known. ``notes`` say in a sentence each what was left out or worked out.
    """

    values: Mapping[Any, Any]
    located: Callable[[InputError], InputError]  # the same mistake with the file and the line in front
    deviations: Mapping[str, float] = field(default_factory=dict)
    correlations: Mapping[tuple[str, str], float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def quantities(
    values: Mapping[Any, Any],
    known: Mapping[str, str],
    *,
    optional: Collection[str],
    ignored: Collection[str],
) -> dict[str, float]:
    """The numbers in SI of another notation, whose ``known`` keys have meanings with units in brackets.

    InputError, with its key, for a mistake.
    """
    for key in values:
        if key not in known and key not in ignored:
            raise InputError("unknown parameter", key=(str(key),), hint=nearest(str(key), known))
    require(values, [key for key in known if key not in optional], known)
    given = {key: value for key, value in values.items() if key in known}
    return {key: quantity(value, units_in(known[key]), key=(key,)) for key, value in given.items()}
