"""How a parameter of a config is drawn at random: its distributions."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import BeforeValidator, ConfigDict, Field, model_validator

from bikestab.config.values import ABSENT, Number, Strict, mistake
from bikestab.draws import share_below
from bikestab.machines import standard_normal
from bikestab.model import Floats
from bikestab.units import shown

KINDS = (
    "allowed: {normal: [mean, standard deviation]}, {uniform: [low, high]}, "
    "{lognormal: [median, standard deviation of the logarithm]}, "
    "or {truncated: [mean, standard deviation, low, high]}"
)


def _numbers(words: str) -> BeforeValidator:
    number = words.count(",") + 1

    def validate(value: object) -> object:
        if not isinstance(value, (list, tuple)) or len(value) != number:
            what = "pair of numbers" if number == 2 else f"{number} numbers"
            raise mistake(f"{shown(value)} is no {what}", f"allowed: [{words}]")
        return value

    return BeforeValidator(validate)


class Distribution(Strict):
    """How a parameter is drawn."""

    model_config = ConfigDict(json_schema_extra={"minProperties": 1, "maxProperties": 1})

    normal: Annotated[
        tuple[Number, Number],
        _numbers("mean, standard deviation"),
        Field(description="mean, standard deviation"),
    ] = ABSENT
    uniform: Annotated[tuple[Number, Number], _numbers("low, high"), Field(description="low, high")] = ABSENT
    lognormal: Annotated[
        tuple[Number, Number],
        _numbers("median, standard deviation of the logarithm"),
        Field(description="median, standard deviation of the logarithm"),
    ] = ABSENT
    truncated: Annotated[
        tuple[Number, Number, Number, Number],
        _numbers("mean, standard deviation, low, high"),
        Field(description="normal between low and high: mean, standard deviation, low, high"),
    ] = ABSENT

    @model_validator(mode="after")
    def _one(self) -> Distribution:
        if len(self.model_fields_set) != 1:
            raise mistake("a parameter has one distribution", KINDS)
        for each in (self.normal, self.lognormal, self.truncated):
            if each and not each[1] > 0:
                raise mistake(f"the standard deviation {each[1]:g} is not positive", "allowed: above 0")
        if self.lognormal and not self.lognormal[0] > 0:
            raise mistake(f"the median {self.lognormal[0]:g} is not positive", "allowed: above 0")
        for ends in (self.uniform, self.truncated[2:] if self.truncated else None):
            if ends and not ends[1] > ends[0]:
                raise mistake(f"high = {ends[1]:g} is not above low = {ends[0]:g}", "allowed: low < high")
        if self.truncated and not self._share[1] - self._share[0] > _LEAST:
            low, high = self.truncated[2:]
            problem = f"hardly any number of this normal distribution is between {low:g} and {high:g}"
            raise mistake(problem, "allowed: low and high around the mean")
        return self

    @property
    def median(self) -> float:
        """Half of its values are below; the mean of a normal distribution, but for one with limits."""
        if self.normal:
            return self.normal[0]
        return float(self.values(np.array([0.5]))[0])

    @property
    def _share(self) -> Floats:
        """The shares of the normal distribution below both limits of a truncated one."""
        mean, deviation, *limits = self.truncated
        return share_below((np.array(limits) - mean) / deviation)

    def values(self, uniform: Floats) -> Floats:
        """Its values for random numbers between 0 and 1."""
        if self.uniform:
            low, high = self.uniform
            return low + (high - low) * uniform
        if self.truncated:
            below, above = self._share
            within = self.truncated[0] + self.truncated[1] * standard_normal(
                below + (above - below) * uniform
            )
            return np.clip(within, *self.truncated[2:])
        return self.of_normal(standard_normal(uniform))

    def of_normal(self, normal: Floats) -> Floats:
        """Its values for standard normal numbers, with the same ranks."""
        if self.normal:
            mean, deviation = self.normal
            return mean + deviation * normal
        if self.lognormal:
            median, deviation = self.lognormal
            return median * np.exp(deviation * normal)
        return self.values(share_below(normal))


_LEAST = 1e-9  # share of a normal distribution within the limits of a truncated one
