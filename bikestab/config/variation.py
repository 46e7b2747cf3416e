"""What a config says of parameters that are drawn at random."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BeforeValidator, ConfigDict, Field, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from bikestab import yamltext
from bikestab.bicycle import PAPER, Bicycle
from bikestab.config.correlation import check_pairs, correlations_read, pair_of
from bikestab.config.distributions import Distribution as Distribution
from bikestab.config.values import Share, Strict, all_of, in_si, increasing, mistake
from bikestab.draws import correlated
from bikestab.errors import InputError, nearest
from bikestab.gains import GAINS
from bikestab.machines import Machines, uniforms
from bikestab.model import Floats
from bikestab.notation import MEIJAARD
from bikestab.rider import RIDER
from bikestab.variants import FRONT, fixed_by, front_of

MOST_SAMPLES = 1_000_000  # of an ensemble
BOTH = {**PAPER, **MEIJAARD, **RIDER, **GAINS}
VARIED = {**BOTH, **FRONT}
SWEPT = [name for name in BOTH if name not in ("lam", "sigma", "trail")]  # known in either notation
DRAWN = list(VARIED)


def with_units(given: Any, where: str) -> Any:
    """What a config says of parameters, ``where`` it does, with numbers for texts with units."""
    if not isinstance(given, dict):
        return given
    found, mistakes = {}, []
    for name, value in given.items():
        try:
            found[name] = in_si(value, VARIED[name], (where, name)) if name in VARIED else value
        except PydanticCustomError as error:
            mistakes.append(error)
    if mistakes:
        raise all_of(mistakes)
    return found


class Ensemble(Strict):
    """Parameters drawn at random; the other keys are theirs."""

    model_config = ConfigDict(
        extra="allow",
        json_schema_extra={
            "propertyNames": {"enum": ["samples", "seed", "quantiles", "correlation", "covariance", *DRAWN]},
            "minProperties": 2,
        },
    )
    __pydantic_extra__: dict[str, Distribution]

    samples: Annotated[
        int, Field(ge=2, le=MOST_SAMPLES, strict=True, description="how many machines are drawn")
    ]
    seed: Annotated[int, Field(ge=0, strict=True, description="another one gives other samples")] = 0
    quantiles: Annotated[
        list[Share],
        Field(min_length=1, description="which quantiles of V1 and V2 are computed"),
        AfterValidator(increasing),
    ] = [0.05, 0.25, 0.5, 0.75, 0.95]

    correlation: Annotated[
        dict[str, float],
        Field(description="of pairs of parameters: {[mB, IBxx]: 0.8}"),
        BeforeValidator(correlations_read),
    ] = {}

    @model_validator(mode="before")
    @classmethod
    def _keys(cls, given: Any) -> Any:
        unknown = [
            mistake("unknown key", nearest(key, [*cls.model_fields, *DRAWN]), ("ensemble", key))
            for key, value in (given.items() if isinstance(given, dict) else ())
            if key not in cls.model_fields and key not in DRAWN and not isinstance(value, dict)
        ]
        if unknown:
            raise all_of(unknown)
        return with_units(given, "ensemble")

    @model_validator(mode="after")
    def _something(self) -> Ensemble:
        if not self.parameters:
            raise mistake("no parameter is drawn", "for example m1: {normal: [80, 8]}")
        check_pairs(self.pairs, list(self.parameters))
        return self

    @property
    def parameters(self) -> dict[str, Distribution]:
        """The parameters that are drawn."""
        return self.__pydantic_extra__

    @property
    def meaning(self) -> dict[str, Any]:
        """What decides which machines are drawn and what is computed of them."""
        return {
            "samples": self.samples,
            "seed": self.seed,
            "quantiles": np.array(self.quantiles),
            "parameters": {
                name: [[kind, np.array(pair)] for kind, pair in one.model_dump(exclude_unset=True).items()]
                for name, one in self.parameters.items()
            },
            **({"correlation": self._sorted} if self.correlation else {}),
        }

    @property
    def _sorted(self) -> list[list[Any]]:
        return sorted([*sorted(pair), np.array(r)] for pair, r in self.pairs.items())

    @cached_property
    def drawn(self) -> dict[str, Floats]:
        """The samples of each parameter; shape (sample,)."""
        pairs = self.pairs
        linked = [name for name in self.parameters if any(name in pair for pair in pairs)]
        normal = correlated(linked, pairs, self.samples, self.seed) if linked else {}
        return {
            name: one.of_normal(normal[name])
            if name in normal
            else one.values(uniforms(self.seed, name, self.samples))
            for name, one in self.parameters.items()
        }

    @property
    def pairs(self) -> dict[tuple[str, str], float]:
        """The correlations of pairs of parameters."""
        return {pair_of(key): r for key, r in self.correlation.items()}

    def parted(self, bicycle: Bicycle, axes: Iterable[str]) -> tuple[dict[str, Floats], dict[str, Floats]]:
        """The samples of what the grid leaves open; and how far those of tilt, trail and offset, which its
        ``axes`` give, are from their distribution's median.
        """
        on_grid = fixed_by(bicycle, axes)
        away = {name for name in self.parameters if front_of(bicycle, name) in on_grid}
        moves = {name: self.drawn[name] - self.parameters[name].median for name in away}
        return {name: x for name, x in self.drawn.items() if name not in away}, dict(sorted(moves.items()))

    def machines(self, bicycle: Bicycle) -> Machines:
        """The samples around a bicycle, drawn alike for every bicycle, but for their tilts and trails.

        Raises InputError where some are no machine.
        """
        numbers = {name: x for name, x in self.drawn.items() if not front_of(bicycle, name)}
        return Machines.drawn(bicycle, numbers or {"g": np.full(self.samples, bicycle.g)})


def ensemble_in(text: str) -> Ensemble | None:
    """The ensemble in a config's YAML text; None where there is none in it alone that this build reads."""
    try:
        return Ensemble.model_validate(yamltext.parse(text, "config").data["ensemble"])
    except (InputError, KeyError, ValidationError):
        return None
