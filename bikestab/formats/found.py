"""What a reader found in a file: parameters by name, their uncertainties, and what it did with the rest."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from bikestab.errors import InputError


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
