"""What a config says of parameters that are drawn at random."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BeforeValidator, ConfigDict, Field, model_validator

from bikestab.bicycle import PAPER, Bicycle
from bikestab.config.values import ABSENT, Number, Share, Strict, in_si, increasing, mistake
from bikestab.errors import nearest
from bikestab.machines import Machines, standard_normal, uniforms
from bikestab.model import Floats
from bikestab.notation import MEIJAARD
from bikestab.rider import RIDER
from bikestab.units import shown
from bikestab.variants import FRONT

MOST_SAMPLES = 1_000_000  # of an ensemble
BOTH = {**PAPER, **MEIJAARD, **RIDER}
VARIED = {**BOTH, **FRONT}
SWEPT = [name for name in BOTH if name not in ("lam", "sigma", "trail")]  # known in either notation


def _pair(words: str) -> BeforeValidator:
    def validate(value: object) -> object:
        if not isinstance(value, (list, tuple)) or len(value) != 2:
            raise mistake(f"{shown(value)} is no pair of numbers", f"allowed: [{words}]")
        return value

    return BeforeValidator(validate)


class Distribution(Strict):
    """How a parameter is drawn."""

    model_config = ConfigDict(json_schema_extra={"minProperties": 1, "maxProperties": 1})

    normal: Annotated[
        tuple[Number, Number],
        _pair("mean, standard deviation"),
        Field(description="mean, standard deviation"),
    ] = ABSENT
    uniform: Annotated[tuple[Number, Number], _pair("low, high"), Field(description="low, high")] = ABSENT

    @model_validator(mode="after")
    def _one(self) -> Distribution:
        if len(self.model_fields_set) != 1:
            raise mistake(
                "a parameter has one distribution",
                "allowed: {normal: [mean, standard deviation]}, or {uniform: [low, high]}",
            )
        if self.normal and not self.normal[1] > 0:
            raise mistake(f"the standard deviation {self.normal[1]:g} is not positive", "allowed: above 0")
        if self.uniform and not self.uniform[1] > self.uniform[0]:
            low, high = self.uniform
            raise mistake(f"high = {high:g} is not above low = {low:g}", "allowed: low < high")
        return self

    def values(self, uniform: Floats) -> Floats:
        """Its values for random numbers between 0 and 1."""
        if self.normal:
            mean, deviation = self.normal
            return mean + deviation * standard_normal(uniform)
        low, high = self.uniform
        return low + (high - low) * uniform


def with_units(given: Any, where: str) -> Any:
    """What a config says of parameters, ``where`` it does, with numbers for texts with units."""
    if not isinstance(given, dict):
        return given
    return {
        name: in_si(value, BOTH[name], (where, name)) if name in BOTH else value
        for name, value in given.items()
    }


class Ensemble(Strict):
    """Parameters drawn at random; the other keys are theirs."""

    model_config = ConfigDict(
        extra="allow",
        json_schema_extra={
            "propertyNames": {"enum": ["samples", "seed", "quantiles", *SWEPT]},
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

    @model_validator(mode="before")
    @classmethod
    def _keys(cls, given: Any) -> Any:
        for key, value in given.items() if isinstance(given, dict) else ():
            if key not in cls.model_fields and key not in SWEPT and not isinstance(value, dict):
                raise mistake(
                    "unknown key",
                    nearest(key, [*cls.model_fields, *SWEPT]),
                    ("ensemble", key),
                )
        return with_units(given, "ensemble")

    @model_validator(mode="after")
    def _something(self) -> Ensemble:
        if not self.parameters:
            raise mistake("no parameter is drawn", "for example m1: {normal: [80, 8]}")
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
        }

    @cached_property
    def drawn(self) -> dict[str, Floats]:
        """The samples of each parameter; shape (sample,)."""
        return {
            name: distribution.values(uniforms(self.seed, name, self.samples))
            for name, distribution in self.parameters.items()
        }

    def machines(self, bicycle: Bicycle) -> Machines:
        """The samples around a bicycle, drawn alike for every bicycle.

        Raises InputError where some are no machine.
        """
        return Machines.drawn(bicycle, self.drawn)
